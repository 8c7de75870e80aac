// A summary of each image of a dataset, by which images are filtered: read once from the file of annotations.
import { request } from "../api/client";
import type { ImageRecord } from "./coco";
import { readLines } from "./lines";

export const kMaxIndexBytes = 256 * 2 ** 20;
const kPerson = 1; ///< category

export interface Bins {
  labels: string[];
  of: (value: number) => number;
}

/** Bins from one limit to the next; the last one has no end. `text` names one by its limits. */
function binsOf(limits: number[], text: (from: number, to: number | undefined) => string): Bins {
  return {
    labels: limits.map((from, index) => text(from, limits[index + 1])),
    of: (value) =>
      Math.max(
        0,
        limits.findLastIndex((limit) => value >= limit),
      ),
  };
}

export const kCounts = binsOf([0, 1, 2, 5, 10, 20, 50, 100, 200, 500], (from, to) =>
  to === undefined ? `${from} or more` : to - from === 1 ? String(from) : `${from} to ${to - 1}`,
);
export const kVisibility = binsOf([0, 0.2, 0.4, 0.6, 0.8], (from, to) => `${Math.round(100 * from)} to ${Math.round(100 * (to ?? 1))} %`);
export const kHeights = binsOf([0, 8, 16, 32, 64, 128, 256, 512], (from, to) =>
  to === undefined ? `${from} px or more` : `${from} to ${to} px`,
);
/** Elevation of the sun, degrees. */
export const kLight: Bins = { ...binsOf([-90, -6, 0, 15], () => ""), labels: ["night", "twilight", "low sun", "day"] };

export interface ImageSummary {
  path: string;
  run: string;
  camera: string;
  frame: number;
  count: number; ///< bin of kCounts
  light: number | null; ///< bin of kLight
  /** One per combination that occurs: bins of kVisibility and kHeights, and the place of the state in `states`. */
  people: { visibility: number; height: number; state: number }[];
}

export interface ImageIndex {
  images: ImageSummary[]; ///< in the order of their paths
  states: string[];
}

/** Reads the lines of a file of annotations (docs/formats_coco.md). */
export async function indexOf(lines: AsyncIterable<string>): Promise<ImageIndex> {
  const byId = new Map<number, ImageSummary>();
  const seen = new Map<number, Set<number>>();
  const states: string[] = [];
  for await (const line of lines) {
    if (line.startsWith('{"id":') && line.includes('"file_name":"images/')) {
      const image = JSON.parse(line.replace(/,$/, "")) as ImageRecord & { file_name: string };
      const sun = image.environment?.sun_elevation_deg;
      byId.set(image.id, {
        path: image.file_name,
        run: image.run,
        camera: image.camera_id,
        frame: image.frame,
        count: 0,
        light: sun === undefined ? null : kLight.of(sun),
        people: [],
      });
      seen.set(image.id, new Set());
      if (image.counts) byId.get(image.id)!.count = image.counts.visible;
      continue;
    }
    const member = /^\{"id":\d+,"image_id":(\d+),"category_id":(\d+),"bbox":\[[^,]+,[^,]+,[^,]+,([^\]]+)\]/.exec(line);
    if (!member || Number(member[2]) !== kPerson) continue;
    const image = byId.get(Number(member[1]));
    if (!image) continue;
    const name = /"state":"(\w+)"/.exec(line)?.[1] ?? "unknown";
    if (!states.includes(name)) states.push(name);
    const person = {
      visibility: kVisibility.of(Number(/"visibility":([\d.e-]+)/.exec(line)?.[1] ?? 1)),
      height: kHeights.of(Number(member[3])),
      state: states.indexOf(name),
    };
    const key = (person.visibility * kHeights.labels.length + person.height) * 64 + person.state;
    const keys = seen.get(Number(member[1]))!;
    if (!keys.has(key)) image.people.push(person);
    keys.add(key);
  }
  const images = [...byId.values()].map((image) => ({ ...image, count: kCounts.of(image.count) }));
  return { images: images.sort((a, b) => (a.path < b.path ? -1 : 1)), states };
}

/** Throws ApiError; 404: the dataset has no annotations of COCO. An Error names a file that is too large. */
export async function readIndex(job: string, signal: AbortSignal, onShare: (share: number) => void): Promise<ImageIndex> {
  const response = await request(`/v1/jobs/${job}/files/annotations/instances.json`, { signal });
  const bytes = Number(response.headers.get("Content-Length") ?? 0);
  if (bytes > kMaxIndexBytes) {
    await response.body?.cancel();
    throw new Error(
      `the annotations have ${Math.round(bytes / 1e6)} MB; filters by their contents read up to ${Math.round(kMaxIndexBytes / 1e6)} MB`,
    );
  }
  let read = 0;
  return indexOf(readLines(response.body!, (count) => onShare(Math.min(1, (read += count) / Math.max(1, bytes)))));
}
