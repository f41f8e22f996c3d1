// What the page's scripts say to each other and find in the browser, loosely: parts of the state are in parts.d.ts.
interface Window {
  RX: typeof RX;
  rotorScene: any;
  rotorDisk: any;
  rotorWipe: any;
  makeStory: any;
  __viserMutable: any;  // viser's client.
}
declare const rotorScene: any, rotorWipe: any;
// An element is HTML or SVG by its use, and scripts keep their own values on it.
interface EventTarget { [name: string]: any }
interface Event { [name: string]: any }
