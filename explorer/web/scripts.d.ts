// What the page's scripts say to each other and find in the browser; parts of the state are in parts.d.ts.
declare const RX: {
  state: RxState;
  paint<N extends keyof RxState>(name: N, draw: (value: RxState[N]) => void): void;
  paint<N extends (keyof RxState)[]>(names: [...N], draw: (...values: {[K in keyof N]: RxState[N[K]]}) => void): void;
  // A part in a function that runs only while it is shown.
  shown<N extends keyof RxState>(name: N): NonNullable<RxState[N]>;
  again(...names: (keyof RxState)[]): void;
  send<N extends keyof RxPresses>(name: N, value?: RxPresses[N]): void;
  hold(after?: number): () => void;
  say(sentence: string): void;
  icon(name: string): string;
  price(region: string): string;
  part(name: string): any;
  small: MediaQueryList;
  covered: RxPresses['covered'];
  // Height [px] below which the strip of charts is folded.
  folded: number;
  showTab(name: string, wanted: boolean): void;
  openRail(wanted: boolean): void;
  along(share: number): string;
  foresee(matrix: RxDialNumbers, x: number[]): [number, number];
  // Python calls these, tests `idle`.
  set(parts: Partial<RxState>): void;
  begin(uuid: string): void;
  forget(): void;
  idle(wholly?: boolean): Promise<boolean>;
  facts(key: string): void;
  keep(name: string, text: string): void;
  address(query: string): void;
  copy(text: string): void;
  copyLink(query: string): void;
  dialog(content: string): void;
  awaitPlace(): void;
};
interface Window {
  RX: typeof RX;
  rotorScene: any;
  rotorDisk: any;
  rotorWipe: any;
  makeStory: any;
  __viserMutable: any;  // viser's client.
}
declare const rotorScene: any, rotorWipe: any;
// What a script asks for is in frame.html.
interface ParentNode { querySelector(selectors: string): HTMLElement }
interface Document { getElementById(id: string): HTMLElement }
// An element is HTML or SVG by its use, and scripts keep their own values on it.
interface EventTarget { [name: string]: any }
interface Event { [name: string]: any }
