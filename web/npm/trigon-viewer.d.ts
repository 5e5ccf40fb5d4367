/** What is known of a model. */
export interface Facts {
  /** The path of the file that is shown. */
  path: string;
  /** The paths of all models among the files. */
  models: string[];
  format: string;
  files: string[];
  nodes: number;
  materials: number;
  textures: number;
  vertices: number;
  faces: number;
  triangles: number;
  /** Along X, Y and Z, in metres. */
  size: [number, number, number];
  animations: { name: string; duration: number }[];
  warnings: { file: string; message: string }[];
}

export type ErrorKind =
  | 'Read' | 'Unsupported' | 'Malformed' | 'Forbidden' | 'Limit' | 'Empty' | 'Cancelled' | 'Render' | 'Stopped';

/** Something could not be loaded or drawn; the message names the file, the place in it, and a remedy. */
export class TrigonError extends Error {
  readonly kind: ErrorKind;
  readonly file: string | null;
}

export type Display =
  | 'shaded' | 'matcap' | 'base-color' | 'normal' | 'geometric-normal' | 'uv' | 'metallic' | 'roughness' | 'occlusion'
  | 'emission' | 'alpha' | 'depth';
export type Surface = 'surface' | 'edges' | 'wireframe' | 'hidden-line';
export type Side = 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom' | 'isometric';

export interface Explanation {
  /** The name of what is visible; `null` for the background. */
  name: string | null;
  face: number | null;
  text: string;
}

/** A setting with what it costs. The first three are the values of the attributes that use it. */
export interface MeasuredSetting {
  samples: number;
  edgeSamples: number;
  glassBounces: number;
  name: string;
  /** The lower quartile, the median and the upper quartile. */
  milliseconds: [number, number, number];
  /** The root mean square in linear light against the reference, the best that the renderer does at this size. */
  error: number;
  /** Whether no other setting is as fast and as accurate. */
  standing: 'best' | 'uncertain' | 'dominated';
}

export interface Measured {
  /** A plot of error against time; its first circles are the dots in their order. */
  svg: string;
  dots: MeasuredSetting[];
}

/** An image that the element shows: its size in pixels, and how many milliseconds it took. */
export interface Shown {
  width: number;
  height: number;
  isDraft: boolean;
  time: number;
}

/** `<trigon-viewer src="model.glb" camera-controls>` */
export class TrigonViewerElement extends HTMLElement {
  readonly facts: Facts | null;
  level: 'simd128' | 'scalar';
  load(files: Map<string, Uint8Array> | Iterable<File>, path?: string): Promise<Facts>;
  toBlob(): Promise<Blob>;
  explain(x: number, y: number): Promise<Explanation>;
  measure(): Promise<Measured>;
  cancelMeasurement(): void;
  settled(): Promise<Shown>;
  memory(): Promise<number>;
  resetView(): void;
  lookFrom(side: Side): void;
  toggleOrthographic(): void;
}

export interface TrigonViewerEvents {
  load: CustomEvent<Facts>;
  error: CustomEvent<TrigonError>;
  render: CustomEvent<Shown>;
  /** The part of a measurement that is done, up to 1. */
  progress: CustomEvent<number>;
  'camera-change': CustomEvent<null>;
}

declare global {
  interface HTMLElementTagNameMap {
    'trigon-viewer': TrigonViewerElement;
  }
}
