// The shapes that pass between modules.
type Box = ArrayLike<number> & Iterable<number>;
/** Coordinates [x0, y0, x1, y1, …]. */
type Points = ArrayLike<number>;
type Point = [x: number, y: number];
type Size = { width: number; height: number };
/** Maps the plane to the screen: X = x + scale · px, Y = y − scale · py. */
type Placement = { scale: number; x: number; y: number };
/** A polyline [x0, y0, x1, y1, …], without a repeated first point if it is closed. */
type Outline = { points: Float64Array; closed: boolean };
/** z → (re + i·im) z̃ + (x + iy), where z̃ is the conjugate of z if mirrored, else z. */
type Similarity = { mirror: boolean; re: number; im: number; x: number; y: number };
type Matrix = [number, number, number, number, number, number];
type AtlasFiles = ReturnType<typeof import("./data/atlas.js").openAtlas>;
type Atlas = ReturnType<typeof import("./kernel/linkages.js").withLinkages>;
/** A linkage that a plate can begin with: of the catalogue with a manifest, or of a family of the atlas. */
type NewLinkage = Record<"id" | "legend" | "manifest", string> & { family?: string };
type Kernel = import("./kernel/kernel.js").Kernel;
/** A kernel whose answers may be promises (kernel/worker.js). */
type SearchKernel = { readonly instance: object; call(request: object, lent?: string): any };
type Waiting = { resolve: (answer: any) => void; reject: (error: Error) => void };
type KernelStudy = import("./kernel/study.js").KernelStudy;
type Place = { pass: number; input: number; isBeyond?: boolean };
/** What the address of a plate says of it (view/plate/plate-query.js). */
type PlateState = {
  changes: Map<string, number>;
  requestedCircuit: number | null;
  on: Set<string>;
  at: Place | null;
  locked: Set<string>;
  motion: MotionState;
};
/** What a plate shows of the motion: of a joint, a graph, at a speed of the input, against a load. */
type MotionState = { joint: string | null; graph: string; rpm: number | null; load: string | null };
/** The motion of a joint at places (crates/coupler-kernel/src/request.rs). */
type JointMotion = Record<
  "passes" | "inputs" | "positions" | "velocities" | "accelerations",
  Float64Array
> & {
  links: { joints: string[]; velocities: Float64Array; accelerations: Float64Array }[];
  transmission_angles: Float64Array | null;
  torques: Float64Array | null;
  torque: Record<"peak" | "peak_input" | "min" | "max", number | string> | null;
};
/** A joint that dimensions move, with their names (crates/coupler-kernel/src/request.rs). */
type HandleAnswer = { joint: number; names: string[]; nearest: string[] };
type Handle = HandleAnswer & { element: SVGElement };
type DragAnswer = { changes: [string, number][]; distance: number; is_held: boolean };
type Timeline = ReturnType<typeof import("./view/plate/timeline.js").timelineOf>;
type Parameter = ReturnType<typeof import("./view/plate/parameters.js").changeableParameters>[number];
type Histogram = ReturnType<typeof import("./find/histogram.js").histogramOf>;
type DrawnCurve = ReturnType<typeof import("./view/page-picture.js").curvesOnPaper>[number];
type SolvedCurve = NonNullable<ReturnType<typeof import("./view/curve-reading.js").solveCurve>>;
/** A part of a family that is searched, with the pieces of its data; an index that is not kept is built again. */
type SearchedPart = { family: Family; first: number; count: number; pieces: Piece[]; isKept: boolean };
type ComparisonQuery = ReturnType<typeof import("./view/compare/align.js").parseComparisonQuery>;
type ShapeQuery = ReturnType<typeof import("./view/shape/query.js").parseShapeQuery>;
type FindView = import("./view/find/find-view.js").FindView;
type ShapeView = import("./view/shape/shape-view.js").ShapeView;
type MovingLayer = import("./view/plate/moving-layer.js").MovingLayer;
type FindQuery = ReturnType<typeof import("./find/query.js").parseFindQuery>;
type CurveData = ReturnType<typeof import("./view/plate/paths.js").pathsOfStudy>;
type JointName = ReturnType<typeof import("./view/plate/joint-names.js").namesOfStudy>[number];
/** The controls of a parameter. */
type SliderRow = Record<"range" | "field", HTMLInputElement> &
  Record<"button" | "name", HTMLButtonElement> & {
    parameter: Parameter;
    element: HTMLElement;
    number: import("./view/number-field.js").NumberField;
  };
type Plate = import("./view/plate/plate.js").Plate;
type Stage = import("./view/plate/stage.js").Stage;
type Drive = import("./view/plate/drive.js").Drive;
type Pose = import("./view/plate/study.js").Pose;
type Zoom = import("./view/zoom.js").Zoom;
type PageView = import("./view/page.js").PageView;
type CurveTable = import("./find/table.js").CurveTable;
type Filters = import("./find/filter.js").Filters;
type Series = import("./data/series.js").Series;
type Store<S extends object> = import("./view/store.js").Store<S>;

/** What all views share; an address is opened, or replaced without opening it. */
type App = {
  atlas: Atlas;
  kernel: import("./kernel/kernel.js").KernelLoader;
  pins: import("./view/pins.js").Pins;
} & Record<"announce" | "go" | "replace" | "commit", (text: string) => void>;
type Query = Map<string, string>;
type AddressQuery = import("./data/address.js").AddressQuery;
type Target = { path: string[]; query: AddressQuery };
/** A view of the gallery; `update` returns whether it handles a further address of its route. */
type View = {
  element: Element;
  title: string;
  update?(target: Target, isRetraced?: boolean): boolean;
} & ViewEvents;
type ViewEvents = Partial<Record<"shown" | "leave", () => void>>;
/** A route with a label is in the navigation; one without belongs to its `parent`. */
type Route = Partial<Record<"label" | "parent", string>> & {
  name: string;
  href?(app: App): string;
  matches(target: Target, app: App): boolean;
  open(app: App, target: Target): View | Promise<View>;
};
/** The keys of a command, as events name them, what it does, and a function that does it (keys.js). */
type KeyCommand = [keys: string, words: string, act?: (event: KeyboardEvent) => unknown];
type Measure = Record<"name" | "title" | "unit" | "definition", string> & Record<"word" | "is_input" | "is_more_better", boolean>;
/** A family as the summary of the atlas lists it; without a script it has no data. */
type ListedFamily = Record<"id" | "title" | "linkage", string> &
  Record<"cells" | "kept" | "not_assembled" | "curves" | "pages" | "bytes" | "table_bytes", number> &
  Record<"page_format" | "script" | "source", string | null>;
type AtlasSummary = { title: string; program: string; book: string[]; paper: Size } & Listed & {
    kernel: { script: string; sha256: string; module?: string };
    plate?: PlateOfFile;
  };
/** The file of a plate has the curve with this key only, and the address at which it was saved. */
type PlateOfFile = Record<"address" | "key", string> &
  Pick<Family, "id" | "title" | "manifest" | "ranges" | "free"> & { request: CurveRequest };
/** What the script of the kernel says: its module, compressed and in base64, and the digest of what is encoded. */
type KernelFile = { sha256: string; module: string };
/** Names of units, each with what to multiply a number in it by. */
type Units = Record<string, number>;
type Listed = { measures: Measure[]; families: ListedFamily[] };
type Words = { values: string[]; codes: Uint8Array };
/**
 * Cells by their index; `assignment` is the index of the list of names that a cell assigns, `status` 0 if
 * it is assembled, 1 in part, 2 not at all.
 */
type Cells = { count: number; number: Uint32Array; values: Float64Array } & CellCodes;
type CellCodes = { assignment: Uint16Array; status: Uint8Array };
/** Curves by their index, valid where a piece of the table is loaded; their cells are indices too. */
type Curves = Record<"trace" | "circuit", Uint16Array> & {
  count: number;
  cell: Uint32Array;
  closed: Uint8Array;
  measures: Record<string, Float64Array>;
  words: Record<string, Words>;
};
/** An entry of the index in a family's head; the numbers are those of the first and the last cell. */
type PieceEntry = Record<"bytes" | "cells" | "curves", number> & { pages?: number; traces?: number } & {
  numbers: [number, number];
  ranges?: ([number, number] | null)[];
};
/** What the program says of a family; its manifest is for the kernel. */
type FamilyHead = Record<"id" | "title" | "linkage" | "manifest", string> &
  Record<"names" | "measures" | "words", string[]> &
  Record<"source" | "legend", string | null> & {
    layout: "panels" | "chart" | "coupler-grid";
    /** The number of panels on a page; null if it does not say which cells a page has. */
    panels: number | null;
    sampling: { step?: number; samples?: number; spacing?: string };
    paths: string[];
    is_length: boolean;
    paper: Size & { is_dark: boolean };
    free: number[];
    /** The distinct lists of the indices that a cell assigns; `free` are all that cells assign. */
    assignments: number[][];
    pieces: { table: PieceEntry[]; curves: PieceEntry[] };
  };
/** A family; captions, points and pages, which may be dropped again, are read with data/family.js. */
type Family = Omit<FamilyHead, "measures" | "words" | "pieces"> &
  Record<"table" | "outlines", Series> & {
    cells: Cells;
    curves: Curves;
    pageCount: number;
    ranges: [number, number][];
    /** The greatest number of a traced point. */
    traces: number;
    measureNames: { numbers: string[]; words: string[] };
    load(piece: Piece): Promise<void>;
    used(piece: Piece): void;
  };
/** A view as the data have it, with the number of the cell, and traces and circuits in turn, and as it is drawn, with indices. */
type StoredView = { cell: number; scale: number; origin: Point; curves: number[] };
type PageDrawing = { cell: number; scale: number; origin: Point; curves: number[] };
/** The points of curves, and the texts of cells; `start` is the index of a curve's first point. */
type PieceData = Record<"caption" | "note" | "reason", string[]> & {
  box: Float64Array;
  start: Uint32Array;
  /** Where each curve begins in points that are packed as bytes. */
  places: Uint32Array;
  points: Uint8Array | Uint16Array;
  pages: Map<number, StoredView[]>;
  pageOfKey?: Map<string, number>;
};
/** A piece of a series; `data` are null until it is loaded, and empty for a piece of the table. */
type Piece = Record<"number" | "bytes" | "cells" | "curves" | "pages" | "holds", number> &
  Record<"firstCell" | "firstCurve" | "firstPage", number> & {
    name: "table" | "curves";
    file: string;
    numbers: [number, number];
    data: PieceData | null;
    loading: Promise<unknown> | null;
  };

/** A curve for the kernel (crates/coupler-kernel/src/request.rs), before its family has a handle. */
type CurveRequest = { cell: number; curve: Point } & Record<"values" | "changes", [string, number][]>;
type KernelCurve = { family: { handle: number }; curve: CurveRequest };
type FamilyDescription = Record<"is_length" | "has_all_circuits", boolean> & {
  family: number;
  names: (KernelName & Record<"is_whole" | "is_derived", boolean> & { unit: AngleUnit | null })[];
};
type KernelName = { name: string; min: number | null; max: number | null };
type AngleUnit = "deg" | "rad";
type Pass = { from: number; to: number; from_is_flat: boolean; to_is_flat: boolean; sides: number[] };
type Circuit = { passes: Pass[]; closed: boolean };
type Coordinate = { value: number; is_constant: boolean; is_parameter: boolean };
type MovablePoint = { name: string; along: Coordinate; across: Coordinate };
type Slot = { foot: number; through: number; base: [number, number]; near: Point; far: Point };
type Mechanism = Record<"bars" | "plates" | "guides", number[][]> &
  Record<"frame" | "fixed" | "pins", number[]> &
  Record<"fixed_at" | "frame_at", Float64Array> & {
    blocks: { at: number; line: [number, number] }[];
    slots: Slot[];
    actuators: [number, number][];
    wheels: [number, number, number][];
  };
/** What the kernel says of a curve that exists (crates/coupler-kernel/src/description.rs). */
type StudyAnswer = CurveValues &
  Record<"study" | "shown" | "joint", number> &
  Record<"is_length" | "is_mirrored" | "has_cognates" | "has_pole", boolean> &
  Record<"box" | "others_box" | "curve_box", Box> & {
    /** All circuits; `home` is the index of the curve's own, `shown` of the one that is shown. */
    circuits: Circuit[];
    home: number | null;
    shortfall: string | null;
    reason: null;
    joints: string[];
    traced: number[];
    others: { joint: number; points: Float64Array }[];
    crank: { pivot: number; pin: number; arc: Float64Array; limits: Float64Array; can_turn: boolean } | null;
    four_bar: { class: string; transmission_range: Point | null } | null;
    mechanism: Mechanism;
  };
/** What it says otherwise: why not. */
type MissingCurve = Pick<StudyAnswer, "circuits"> &
  Partial<Pick<StudyAnswer, "values" | "point">> & { study?: undefined; reason: string };
type CurveValues = { values: Record<string, number>; point: MovablePoint | null };
type Candidates = Pick<StudyAnswer, "circuits" | "is_length"> & { home?: number | null; shown?: number };
/** A moving element of a plate; those of slots know their slot and its index. */
type MovingPart = { element: Element; shape?: Slot; slot?: number; data: PartData };
type PartData = (at: Float64Array, scale: number, ends: Float64Array, part: MovingPart) => string;
/** A study as a plate shows it; `box` is the area swept by the linkage. */
type Study = StudyAnswer & { kernel: KernelStudy; timeline: Timeline; size: number };
type CurvePath = { lead: Float64Array; dashes: Float64Array; starts: Float64Array };
type Measured = Record<string, number | string>;
type ComputedMeasures = { values: Measured; straight: StraightPortion | null };
type StraightPortion = { points: Float64Array; from: Place; to: Place };
type Lengths = Record<"frame" | "crank" | "coupler" | "rocker" | "along" | "across", number>;
type Cognates = { lengths: Lengths[]; pivots: Float64Array[]; reached: Float64Array };
type Centrodes = { fixed: Float64Array; moving: Float64Array; frame: [number, number] };
/** At a point of a curve: the speed is per radian or unit of length, `mu` in degrees. */
type Reading = { pass: number; input: number; place: Point; speed: number; mu: number | null };
type Column = Record<"name" | "title" | "unit" | "definition", string> & {
  group: ColumnGroup;
  kind: "words" | "numbers";
};
type DerivedColumn = Pick<Column, "title" | "unit" | "definition"> & {
  inputs: string[];
  compute(at: (measure: string) => number): number;
};
type ColumnGroup = "first" | "more" | "parameters";
type Bounds = { low?: number; high?: number };
/** A filter of a column: bounds, which are inclusive, or words. */
type Filter = Bounds | Set<string>;
/** How much of the tables of a search is loaded: curves, of all, and the size of all in bytes. */
type LoadState = { done: boolean; curves: number; total: number; bytes: number };
/** What the page makes of the kernel's text has `convert`, and the ending of its type. */
type ExportFormat = Record<"label" | "note" | "type" | "kernel", string> & Converted;
type Converted = {
  convert?(text: string, kernel: Kernel, onProgress: ExportProgress): Promise<Uint8Array<ArrayBuffer>>;
};
type ExportProgress = (done: number, all: number) => void;
/** An index in the kernel of the curves of a family from `first` on. */
type ShapeIndex = { family: Family; curves: number } & Record<"first" | "count", number>;
/** Curves for the kernel: their points one after another, the number of points of each, and whether it is closed. */
type GivenCurves = Record<"points" | "counts" | "closed", Float64Array<ArrayBuffer>>;
/** A curve with what is shown of it: the piece of its points may be dropped. */
type TakenCurve = CurveOfFamily & Record<"name" | "caption", string> & { outline: Outline };
/** What is searched for: `least` is the least part of a curve, `by` the deviation to rank by. */
type SearchOptions = { isPart: boolean; mirror: boolean; least: number; by: "rms" | "greatest" };
type CurveOfFamily = { family: Family; curve: number };
/** How a curve fits a path: deviations relative to its size, and the part of the curve's length that it matches. */
type Fit = {
  quality: string;
  rms: number;
  greatest: number;
  similarity: Similarity;
  from: number;
  to: number;
};
type FittedCurve = { fit: Fit | null; invariants: Float64Array };
type Match = TakenCurve & Fit & { invariants: Float64Array };
/** A match with the others that are the same curve. */
type MergedMatch = { match: Match; others: Match[] };
/** The answers of a search for four-bars so far, and how many curves of the index it looked the path up in. */
type FoundFourBars = Record<"size" | "index_count", number> & {
  answers: FourBarAnswer[];
  manifest: string;
} & {
  hindrances: string[];
};
/** A shape to search four-bars for, and a path to compare curves with, of the kinds of `find`. */
type NamedPath = { shape: Outline; isPart: boolean; name: string };
type SearchedPath = { points: Float64Array; kind: string };
/** A four-bar of `find --json` (docs/find.md) with its curve, and its joints at the first point of the path. */
type FourBarAnswer = { record: FourBarRecord; manifest: string; pose: Float64Array } & {
  degeneracy: string | null;
  curve: { closed: boolean; points: Float64Array } | null;
};
type FourBarRecord = FoundLinkage & { quality: string; in_order: boolean; cognates: FoundLinkage[] } & Record<
    "rank" | "rms" | "rms_relative" | "max",
    number
  >;
type FoundLinkage = { parameters: Lengths; class: string; mu_worst_deg: number | null } & {
  crank_pivot: Point;
  rocker_pivot: Point;
  longest_link: number;
  meets_constraints: boolean;
};
/** A curve to compare; one with changes has what the kernel draws instead. */
type ComparedCurve = CurveOfFamily & ChangedCurve & { name: string; key: string; release(): void };
/** A picture of compared curves, as one or in elements of their own, whose lines are redrawn finer. */
type ComparedPicture = { scale: number; redraw(k: number, points: Points): void } & Partial<
  Record<"element", Element> & Record<"elements", Element[]>
>;
type ChangedCurve = { changes: Map<string, number>; requested?: KernelCurve; shown?: number | null };
type TypedArray = Uint8Array | Uint16Array | Uint32Array | Float64Array;
type PackedColumn = string | number | Float64Array | null;
type TypedArrayKind = { new (of: number | ArrayBuffer): TypedArray };
type Base64Decoder = { fromBase64(data: string): Uint8Array<ArrayBuffer> };
/** Statements of the scripts of a family: rows of the table, and captions and points of curves. */
/** The numbers of cells, how many curves each has, and which these are. */
type IdentityRows = Record<"number" | "curves" | "trace" | "circuit" | "closed", PackedColumn>;
type CurvePlace = Record<"cell" | "curve", number>;
type CellRows = IdentityRows & {
  count: number;
  status: PackedColumn;
  assignment?: PackedColumn;
  values: PackedColumn[];
  measures: PackedColumn[];
  words: { values: string[]; codes: PackedColumn }[];
};
type CurveRows = Record<"caption" | "note" | "reason", string[]> &
  Record<"cells" | "curves", number> &
  { count: PackedColumn; box: PackedColumn[]; points?: Float64Array; rows?: IdentityRows };
/** A family of a single cell. */
type CellStatements = { head: FamilyHead; cells: CellRows; curves: CurveRows };
type PageRows = { page: number; views: StoredView[] };
/** What the scripts of families and of the kernel call. */
type Statements = {
  begin(head: FamilyHead): void;
  piece(of: { id: string; series: string; number: number }): void;
  cells(rows: CellRows): void;
  curves(rows: CurveRows, comment: () => void): void;
  page(rows: PageRows): void;
  end(): void;
  kernel(file: KernelFile): void;
};
type Chunk = Pick<PieceData, "box" | "points" | "caption" | "note" | "reason"> & { counts: Uint16Array };
type KernelExports = Record<KernelFunction, (...of: number[]) => number> & { memory: WebAssembly.Memory };
type KernelFunction =
  `kernel_${"start" | "allocate" | "numbers" | "call" | "pose" | "joint_position"}` | KernelLength;
type KernelLength = "kernel_pose_length" | "kernel_panic_message" | "kernel_panic_length";
type TagOf<N extends string> = N extends `${infer T}.${string}` ? T : N;
type HtmlElementOf<N extends string> =
  TagOf<N> extends keyof HTMLElementTagNameMap ? HTMLElementTagNameMap[TagOf<N>] : HTMLElement;
type SvgElementOf<N extends string> =
  TagOf<N> extends keyof SVGElementTagNameMap ? SVGElementTagNameMap[TagOf<N>] : SVGElement;
/** An entry of a menu. */
type MenuEntry = [label: string, note: string, action: () => unknown];
/** What an element contains: nodes, texts and numbers, in lists of any depth, or nothing. */
type Content = Node | string | number | false | null | undefined | readonly Content[];
/** Attributes of an element; those that begin with "on" are listeners. */
type Attributes<E> = {
  [K in keyof HTMLElementEventMap as `on${K}`]?: (event: Heard<HTMLElementEventMap[K], E>) => unknown;
} & {
  [name: string]: unknown;
};
/** An event at an element: the target is a field itself, otherwise any element in it. */
type Heard<V, E> = V & { target: E extends HTMLInputElement | HTMLSelectElement ? E : Element };
/**
 * A grid of `count` tiles of at least `least` pixels, `gap` apart, with pictures of an aspect ratio, height to
 * width, and `below` pixels for text. `tile` creates a tile, an element with a link in it; `need` loads what it
 * shows, null if it is there; `fillTile` then adds its text, and `draw` what takes longer, when there is time.
 */
type TileOptions = Record<"count" | "least" | "gap" | "aspect" | "below", number> & {
  label: string;
  tile(k: number): HTMLElement;
  need(k: number): Promise<unknown> | null;
  isLoaded(): boolean;
  failed(message: string): void;
} & Record<"fillTile" | "draw", (element: HTMLElement, k: number) => void>;
