// Made by `python -m tests.tools.page_types` from explorer/parts and presses.PRESSES: change those.

interface RxState {
  assessed: RxAssessedPart | null;
  bar: RxBarPart;
  big: boolean;
  coarse: number;
  dial: RxDialPart | null;
  dial_front: RxDrawnChart | null;
  dial_matrix: RxDialMatrix | null;
  earns: RxEarnsPart | null;
  field: RxFieldPart;
  flight: RxFlightPart | null;
  hand: RxHandPart | null;
  hub_labels: RxSceneLabel[];
  idle: number;
  inset: RxInsetPart;
  lecture: RxLecturePart | null;
  line: RxLinePart;
  lifted_labels: RxSceneLabel[];
  notice: RxNoticePart | null;
  plan: RxPlanPart | null;
  power: RxPowerPart;
  prices: Record<string, RxRegionPrice> | null;
  probe_label: RxSceneLabel[];
  prompt: RxSceneLabel | null;
  ride: RxRidePart | null;
  twisting: RxTwistingPart | null;
  steps: RxStepPart[];
  strip: RxStripChart[];
  suppose: RxSupposePart | null;
  turn: RxTurnPart;
  twist: RxTwistPart;
  vibration: RxVibrationPart | null;
  views: RxViewsPart;
  wipe: boolean;
  worth: Record<string, RxSliderSaving>;
}

interface RxPresses {
  pin: null;
  swap: null;
  back: null;
  undo: null;
  redo: null;
  play: null;
  apply: null;
  discard: null;
  halt: null;
  nearest: null;
  aim: null;
  taken: null;
  beat: null;
  game_link: null;
  game_take: null;
  game_end: null;
  feasible: null;
  unstall: null;
  along: boolean;
  hold: boolean;
  seen: boolean;
  field: string;
  region: string;
  mode: string;
  drawer: string;
  task: string;
  opened: string;
  rotor: string;
  flown: string;
  default: string;
  kind: string;
  story: number;
  guess: number;
  stop: number;
  dial_front: number;
  grab_at: number;
  twist_by_hand: number;
  difference: 'on' | 'off';
  more: 'on' | 'off';
  ride: 'off' | RxSectionPress | null;
  section: RxSectionPress;
  slide: RxSlidePress;
  azimuth: number;
  fly: number;
  against: 'same-blade' | 'best-fixed';
  state: 'set' | 'schedule' | 'stopped';
  suppose: 'on' | 'off' | RxSupposePress;
  balance: 'here' | 'flight';
  map_at: RxMapPress;
  pull: number | null;
  covered: RxCoveredPress;
  scene: 'drawn' | 'none' | 'lost';
  view: 'actuator' | '3d' | 'disk' | 'blade' | 'top' | 'side';
  colours: 'Rescale' | 'Default';
  lecture: 'back' | 'next' | 'end';
  idle: RxIdlePress;
  knot: RxKnotPress;
  dial: 'start' | 'end' | RxWavePress[];
}

interface RxAssessedPart {
  tip: string;
  reach: string;
  mass: string;
  masses: [string, string][];
  flight: string;
  flights: string;
  vibration: string;
  problem: string;
  over: string[];
  required: string[];
  feasible: string;
  against: string;
  baselines: [string, string][];
  sentence: string;
  pays: string[];
  range: number;
  kilograms: number;
}

interface RxBarPart {
  rotors: [string, string][];
  rotor: string;
  mode: string;
  drawer: string;
  undo: boolean;
  redo: boolean;
  pinned: RxPinnedRow | null;
}

interface RxPinnedRow {
  title: string;
  power: string;
  along: boolean;
}

interface RxDialPart {
  harmonics: number[];
  now: [number, number, number][];
  reach: number;
  whole: number;
  room: number;
  rings: [number, string][];
  words: string;
  computing: boolean;
  settled: RxModelChanges | null;
  problem: string;
  against: string;
  where: string;
  unit: string;
  per_watt: number;
  front: [number, number, number[]][];
  exaggerated: string;
  shake: number;
}

interface RxModelChanges {
  power: number[];
  index: number[];
}

interface RxDrawnChart {
  title: string;
  x: RxDrawnAxis;
  y: RxDrawnAxis;
  series: (RxDrawnLine | RxDrawnPoints | RxDrawnBand)[];
  value: string;
  note: string;
  rules?: RxRule[];
}

interface RxDrawnAxis {
  range: [number, number];
  ticks: [number, string][];
  label: string;
  log?: boolean;
  ends?: boolean;
  whole?: RxDrawnScale | null;
}

interface RxDrawnScale {
  range: [number, number];
  ticks: [number, string][];
}

interface RxDrawnLine {
  kind: 'line';
  label: string;
  colour: string;
  x: (number | null)[];
  y: (number | null)[];
  width: number;
  dashes?: string | null;
  dots?: boolean;
  filled?: boolean;
}

interface RxDrawnPoints {
  kind: 'points';
  label: string;
  colour: string;
  x: (number | null)[];
  y: (number | null)[];
  mark: 'dot' | 'cross' | 'ring';
  size: number;
  words?: string[];
  action?: string;
  press?: string[];
  names?: string[];
  faint?: boolean[];
  name_place?: 'above' | 'below' | null;
  scatter?: (number | null)[];
}

interface RxDrawnBand {
  kind: 'band';
  label: string;
  colour: string;
  x: (number | null)[];
  low: (number | null)[];
  high: (number | null)[];
}

interface RxRule {
  at: number;
  to: number | null;
  label: string;
  along: 'x' | 'y';
  colour: string;
  dashes: string;
}

interface RxDialMatrix {
  base: number[];
  slopes: number[][];
  second: number[][][];
  gains: number[];
  power: number;
  index: number;
  inflows: RxDialNumbers[];
}

interface RxDialNumbers {
  base: number[];
  slopes: number[][];
  second: number[][][];
  gains: number[];
  power: number;
  index: number;
}

interface RxEarnsPart {
  kind: 'ready' | 'computing' | 'problem';
  unit: string;
  here: boolean;
  where: string;
  bars: RxPowerBar[];
  fuel: string;
  fuel_kind: '' | 'gain' | 'loss';
  fuel_note: string;
}

interface RxPowerBar {
  name: string;
  value: number;
  text: string;
  kind: '' | 'gain' | 'loss';
  total: boolean;
  band: number;
  title: string;
}

interface RxFieldPart {
  fields: string[];
  field: string;
  unit: string;
  colours: string[];
  ticks: [number, string][];
  faded: boolean;
  fitted: boolean;
  regions: Record<string, boolean>;
  shares: Record<string, string>;
  difference: boolean | null;
  wipe: boolean;
  beyond: [boolean, boolean];
}

interface RxFlightPart {
  legs: [string, string][];
  at: number;
  kind: 'ready' | 'computing' | 'problem';
  words: string;
  state: string;
  states: [string, string][];
  tip: string;
  chart: RxDrawnChart;
}

interface RxHandPart {
  power: string;
  change: string;
  now: number;
  before: number;
  digits: number;
  place: string;
  best: RxLeastPower | null;
  optimised: number | null;
}

interface RxLeastPower {
  theta: number;
  power: number;
  held: boolean;
}

interface RxSceneLabel {
  text: string;
  node: string;
  at: number[];
  title: string;
  kind: string;
}

interface RxInsetPart {
  times: number;
  r: number[];
  datum: number;
  overlay_datum: number;
  theta: number[];
  overlay: number[] | null;
  cuts: RxInsetSection[];
  name: string;
  name_hint: string;
  overlay_name: string;
  overlay_hint: string;
}

interface RxInsetSection {
  r: number;
  outline: number[][];
  theta: number;
  overlay: number | null;
}

interface RxLecturePart {
  at: number;
  guess: number | null;
  answer: RxStepAnswer | null;
  stop: number;
  figures: [string, string, string][];
  busy: boolean;
  problem: string;
}

interface RxStepAnswer {
  right: number;
  open: number[];
  answer: string;
  chart: RxDrawnChart;
  dots: [number, number, string][][];
}

interface RxLinePart {
  pieces: RxLinePiece[];
  status: RxStatus;
  named_sliders: string[];
  problem: string;
}

interface RxLinePiece {
  text: string;
  part: string;
  kind: '' | 'good' | 'bad';
  stale: boolean;
  title: string;
  control: RxLineControl | null;
}

interface RxLineControl {
  name: string;
  label: string;
  words: string;
  value: number;
  low: number;
  high: number;
  step: number;
}

interface RxStatus {
  kind: 'converged' | 'care' | 'problem';
  words: string;
  title: string;
}

interface RxNoticePart {
  text: string;
  actions: [string, string][];
}

interface RxPlanPart {
  disk: RxPlanDisk;
  root: number;
  blades: number;
  field: string;
  unit: string;
  regions: RxPlanRegion[];
  sides: string[];
  flight: string;
  around: RxDrawnChart;
  mu: number;
  values: RxStationValues | null;
  before: RxStationValues | null;
  coloured: RxPackedTable | null;
  held: string | null;
  wiped: RxPlanDisk | null;
}

interface RxPlanDisk {
  radii: number;
  azimuths: number;
  values: string;
  flow: string | null;
  map: string;
  none: string;
}

interface RxPlanRegion {
  name: string;
  title: string;
  words: string;
  lines: number[][][];
  before: number[][][];
}

interface RxStationValues {
  r: number[];
  first: number;
  tables: Record<string, RxPackedTable>;
}

interface RxPackedTable {
  low: number;
  step: number;
  data: string;
}

interface RxPowerPart {
  parts: RxPowerShare[];
  ideal: number | null;
  ideal_title: string;
  why: string;
  coverage: string;
}

interface RxPowerShare {
  part: string;
  name: string;
  value: string;
  share: number;
  title: string;
}

interface RxRegionPrice {
  lines: string[];
  stale: boolean;
  press: string;
}

interface RxRidePart {
  r: number;
  psi: number;
  out: number;
  eye: number[];
  look: number[];
  view: number;
  section: string;
  outline: number[][];
  u: number[];
  theta: number[];
  phi: number[];
  alpha: number[];
  cl: number[];
  mach: number[];
  lift: number[];
  where: string[];
  region: string[];
  margin: (string | null)[];
  filled: (number | null)[];
  angles: number[];
  curves: number[][];
  chart: RxDrawnChart;
}

interface RxTwistingPart {
  press: number;
  knot: string;
  by: string;
  stations: number[];
  titles: string[];
  ends: [number, string][];
}

interface RxStepPart {
  name: string;
  title: string;
  watch: string;
  a: string;
  b: string;
  question: string;
  options: string[];
  todo: string;
  control: RxStepControl;
  last: boolean;
}

interface RxStepControl {
  label: string;
  kind: string;
  words: string[];
}

interface RxStripChart {
  name: string;
  kind: '' | 'good' | 'bad';
  faded: boolean;
  chart: RxDrawnChart;
  speeds: RxMarkedSpeeds | null;
}

interface RxMarkedSpeeds {
  mu: number;
  fastest: number;
}

interface RxSupposePart {
  words: string;
  kind: '' | 'gain' | 'loss';
  note: string;
  chart: RxDrawnChart | null;
  at: [number, number] | null;
}

interface RxTurnPart {
  psi: number;
  playing: boolean;
}

interface RxTwistPart {
  chart: RxDrawnChart;
  knots: RxKnot[];
  places: RxRoleLines;
}

interface RxKnot {
  name: string;
  title: string;
  r: number;
  theta: number;
}

interface RxRoleLines {
  this: number;
  reference: number;
}

interface RxVibrationPart {
  title: string;
  index: string;
  unit: string;
  at: string;
  sentence: string;
  band: string;
  change: string;
  kind: string;
}

interface RxViewsPart {
  all: [string, string][];
  now: string;
  missing: string;
}

interface RxSliderSaving {
  way: 'up' | 'down' | '';
  value: string;
  unit: string;
  size: number;
  sentence: string;
  stale: boolean;
}

type RxSectionPress = [r: number, psi: number];

type RxSlidePress = [name: string, place: number];

type RxSupposePress = [tip: number, mass: number];

type RxMapPress = [x: number, y: number];

type RxCoveredPress = [above: number, below: number];

type RxIdlePress = [serial: number, wholly: boolean];

type RxKnotPress = [name: string, change: 'start' | 'end' | 'undo' | RxKnotMove];

type RxKnotMove = [r: number | null, theta: number];

type RxWavePress = [per_rev: number, amplitude: number, phase: number];
