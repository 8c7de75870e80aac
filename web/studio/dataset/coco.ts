// A dataset's images and their annotations (docs/formats.md). The file of annotations may have gigabytes; it is searched by
// ranges: its lines are ordered by section, and within one by run, frame and camera.
import { ApiError, getJson, getRange } from "../api/client";
import type { ImageList } from "../api/types";
import type { CameraRecord } from "./camera";
import { type Line, LineFile } from "./line_file";
import type { Mask } from "./rle";

export interface ImageName {
  run: string;
  camera: string;
  frame: number;
  path: string; ///< in the dataset
}

export interface Annotation {
  id: number;
  image_id: number;
  category_id: number;
  bbox: [number, number, number, number];
  bbox_amodal: [number, number, number, number];
  area: number;
  visibility: number;
  truncation?: number;
  segmentation: Mask;
  track_id: number;
  position: [number, number, number];
  velocity: [number, number];
  heading?: number;
  box_3d?: [number, number, number, number, number, number];
  head?: [number, number] | null;
  keypoints?: number[];
  state?: string;
  exit?: string;
  difficulty?: { contrast: number; edge_contrast: number; blur_px: number; visible_keypoints: number };
  occluded_by?: [number, number][]; ///< instance and share
}

export interface ExitRecord {
  id: string;
  state: string;
  queue?: number;
  door: [number, number][];
  zone: [number, number][];
}

export interface ImageRecord {
  id: number;
  width: number;
  height: number;
  run: string;
  camera_id: string;
  frame: number;
  time_s: number;
  camera?: CameraRecord;
  counts?: { all: number; visible: number; truncated: number };
  hidden?: { track_id: number; bbox_amodal: [number, number, number, number] }[];
  exits?: ExitRecord[];
  environment?: { weather?: string; time_of_day?: string; sun_elevation_deg?: number };
}

export interface Track {
  id: number;
  group?: number | null; ///< of people
  attributes?: Record<string, string | number>;
  vehicle?: string; ///< car or train
  prop?: number;
}

export interface Labels {
  image: ImageRecord;
  annotations: Annotation[];
}

const kAnnotations = "annotations/instances.json";

/** The image of a path such as "images/run000/d1/000012.jpg". */
export function imageOf(path: string): ImageName | null {
  const parts = /^images\/([^/]+)\/([^/]+)\/(\d+)\.\w+$/.exec(path);
  return parts && { run: parts[1]!, camera: parts[2]!, frame: Number(parts[3]), path };
}

/** Another image of the dataset: names differ in run, camera and frame alone. */
function moved({ path: example }: ImageName, run: string, camera: string, frame: number): ImageName {
  const [, digits, suffix] = /(\d+)(\.\w+)$/.exec(example)!;
  return { run, camera, frame, path: `images/${run}/${camera}/${String(frame).padStart(digits!.length, "0")}${suffix}` };
}

function parsed<T>(line: string): T {
  return JSON.parse(line.replace(/,$/, "")) as T;
}

/** Where a line lies in the file: by section, then by its place there. */
type Order = readonly number[];

function compare(a: Order, b: Order): number {
  for (let i = 0; i < Math.max(a.length, b.length); ++i) {
    const difference = (a[i] ?? -1) - (b[i] ?? -1);
    if (difference !== 0) return difference;
  }
  return 0;
}

const kHeader = 0;
const kTracks = 1;
const kImages = 2;
const kMembers = 3;
const kEnd = 4;

const runNumber = (name: string) => Number(name.replace(/\D+/, ""));

interface Layout {
  cameras: string[]; ///< in the order of the job
  stride: number; ///< difference of the ids of neighbors among them, at the same time
}

export class Dataset {
  private layout: Promise<Layout> | null = null;

  private constructor(
    readonly job: string,
    readonly runs: ImageList["runs"],
    private readonly example: ImageName | null,
    private readonly file: LineFile | null,
  ) {}

  static async open(job: string): Promise<Dataset> {
    const { runs, images } = await getJson<ImageList>(`/v1/jobs/${job}/images?limit=1`);
    const path = `/v1/jobs/${job}/files/${kAnnotations}`;
    const example = images[0] ? imageOf(images[0].path) : null;
    try {
      return new Dataset(job, runs, example, new LineFile(path, (await getRange(path, 0, 0)).size));
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return new Dataset(job, runs, example, null);
      throw error;
    }
  }

  camerasOf(run: string): ImageList["runs"][number]["cameras"] {
    return this.runs.find((entry) => entry.run === run)?.cameras ?? [];
  }

  private has(run: string, camera: string, frame: number): boolean {
    return this.camerasOf(run).some((entry) => entry.camera === camera && frame >= entry.first && frame <= entry.last);
  }

  imageAt(run: string, camera: string, frame: number): ImageName | null {
    return this.example && this.has(run, camera, frame) ? moved(this.example, run, camera, frame) : null;
  }

  /** The image some frames and cameras further, if there is one. */
  neighbor(image: ImageName, frames: number, cameras: number): ImageName | null {
    const list = this.camerasOf(image.run);
    const camera = list[list.findIndex((entry) => entry.camera === image.camera) + cameras]?.camera;
    const frame = image.frame + frames;
    return camera === undefined ? null : this.imageAt(image.run, camera, frame);
  }

  get hasLabels(): boolean {
    return this.file !== null;
  }

  address(image: ImageName): string {
    return `/v1/jobs/${this.job}/files/${image.path}`;
  }

  /** Sections begin with their name; records of each have other first keys. */
  private orderOf(line: string, layout: Layout): Order {
    const member = /^\{"id":\d+,"image_id":(\d+)/.exec(line);
    if (member) return [kMembers, ...this.placeOf(Number(member[1]), layout)];
    const image = /^\{"id":\d+,"file_name":"images\/([^/]+)\/([^/]+)\/(\d+)/.exec(line);
    if (image) return [kImages, runNumber(image[1]!), Number(image[3]), layout.cameras.indexOf(image[2]!)];
    const track = /^\{"id":(\d+),"run":/.exec(line);
    if (track) return [kTracks, Number(track[1])];
    if (line.startsWith('"tracks"')) return [kTracks];
    if (line.startsWith('"images"')) return [kImages];
    if (line.startsWith('"annotations"')) return [kMembers];
    return line.startsWith("]") ? [kEnd] : [kHeader];
  }

  /** Ids count all frames of a camera before the next camera's; lines are ordered by frame, then by camera. */
  private placeOf(id: number, { cameras, stride }: Layout): Order {
    const index = id - 1;
    if (cameras.length < 2) return [index];
    const camera = Math.floor(index / stride) % cameras.length;
    return [Math.floor(index / (stride * cameras.length)), index % stride, camera];
  }

  private find(order: Order, layout: Layout): Promise<Line | null> {
    const file = this.file!;
    return file.find(async (line) => {
      if (line.text !== "],") return compare(this.orderOf(line.text, layout), order) < 0;
      // The end of a section does not say of which: the line after it does.
      const next = await file.lineAt(line.end);
      return next !== null && compare(this.orderOf(next.text, layout), order) <= 0;
    });
  }

  private async readLayout(): Promise<Layout> {
    const cameras: string[] = [];
    const ids: number[] = [];
    let line = await this.find([kImages], { cameras: [], stride: 1 });
    for (line = line && (await this.file!.lineAt(line.end)); line; line = await this.file!.lineAt(line.end)) {
      if (!line.text.startsWith('{"id"')) break;
      const image = parsed<ImageRecord>(line.text);
      if (cameras.includes(image.camera_id)) break;
      cameras.push(image.camera_id);
      ids.push(image.id);
    }
    return { cameras, stride: ids.length > 1 ? ids[1]! - ids[0]! : 1 };
  }

  /** Throws an Error when the file does not hold the image. */
  async labelsOf(name: ImageName): Promise<Labels> {
    this.layout ??= this.readLayout();
    const layout = await this.layout;
    const place = [kImages, runNumber(name.run), name.frame, layout.cameras.indexOf(name.camera)];
    const found = await this.find(place, layout);
    if (!found?.text.includes(`"file_name":"${name.path}"`)) throw new Error("the annotations do not hold this image");
    const image = parsed<ImageRecord>(found.text);
    const annotations: Annotation[] = [];
    let line = await this.find([kMembers, ...this.placeOf(image.id, layout)], layout);
    while (line?.text.startsWith(`{"id":`) && line.text.includes(`"image_id":${image.id},`)) {
      annotations.push(parsed<Annotation>(line.text));
      line = await this.file!.lineAt(line.end);
    }
    return { image, annotations };
  }

  async trackOf(id: number): Promise<Track | null> {
    this.layout ??= this.readLayout();
    const line = await this.find([kTracks, id], await this.layout);
    return line?.text.startsWith(`{"id":${id},`) ? parsed<Track>(line.text) : null;
  }
}
