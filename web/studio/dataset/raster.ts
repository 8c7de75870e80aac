// Values per pixel of an image: depth, flow and density (docs/formats.md).
import { decode } from "fast-png";
import { ApiError, request } from "../api/client";
import type { ImageName } from "./coco";
import { npyOf } from "./npy";
import { npzOf } from "./npz";

export type RasterKind = "depth" | "flow" | "density";

export interface Raster {
  kind: RasterKind;
  width: number;
  height: number;
  /** Depth in m, people per pixel, or the length of the flow in px; NaN where nothing is known. */
  values: Float32Array;
  /** Flow to the right and down, px. */
  dx?: Float32Array;
  dy?: Float32Array;
}

const kSuffixes: Record<RasterKind, string> = { depth: "png", flow: "png", density: "npz" };
const kFlowZero = 32_768;
const kFlowPerPixel = 64;

function depthOf(bytes: Uint8Array): Raster {
  const { width, height, data, depth } = decode(bytes);
  if (depth !== 16) throw new Error(`the depth has ${depth} bits, not 16`);
  return { kind: "depth", width, height, values: Float32Array.from(data, (centimeters) => (centimeters === 0 ? NaN : centimeters / 100)) };
}

function flowOf(bytes: Uint8Array): Raster {
  const { width, height, data, channels } = decode(bytes);
  if (channels !== 3) throw new Error(`the flow has ${channels} channels, not 3`);
  const count = width * height;
  const [values, dx, dy] = [new Float32Array(count), new Float32Array(count), new Float32Array(count)];
  for (let index = 0; index < count; ++index) {
    const isKnown = data[3 * index + 2]! > 0;
    dx[index] = isKnown ? (data[3 * index]! - kFlowZero) / kFlowPerPixel : NaN;
    dy[index] = isKnown ? (data[3 * index + 1]! - kFlowZero) / kFlowPerPixel : NaN;
    values[index] = Math.hypot(dx[index]!, dy[index]!);
  }
  return { kind: "flow", width, height, values, dx, dy };
}

async function densityOf(job: string, folder: string): Promise<Raster> {
  const read = async (path: string) => (await request(`/v1/jobs/${job}/files/${path}`)).arrayBuffer();
  const array = read(folder).then(npzOf, async (error: unknown) => {
    if (!(error instanceof ApiError) || error.status !== 404) throw error;
    return npyOf(await read(folder.replace(/z$/, "y"))); // a dataset of an earlier version
  });
  const { shape, values } = await array;
  return { kind: "density", width: shape[1]!, height: shape[0]!, values };
}

/** Throws ApiError 404 when the dataset does not have this kind. */
export async function fetchRaster(job: string, image: ImageName, kind: RasterKind): Promise<Raster> {
  const folder = image.path.replace(/^images/, kind).replace(/\.\w+$/, `.${kSuffixes[kind]}`);
  if (kind === "density") return densityOf(job, folder);
  const buffer = await (await request(`/v1/jobs/${job}/files/${folder}`)).arrayBuffer();
  return kind === "depth" ? depthOf(new Uint8Array(buffer)) : flowOf(new Uint8Array(buffer));
}

/** The value at a pixel in words; null where nothing is known. */
export function valueText(raster: Raster, x: number, y: number): string | null {
  const [column, row] = [Math.floor(x), Math.floor(y)];
  if (column < 0 || row < 0 || column >= raster.width || row >= raster.height) return null;
  const index = row * raster.width + column;
  const value = raster.values[index]!;
  if (Number.isNaN(value)) return null;
  if (raster.kind === "depth") return `depth ${value.toFixed(2)} m`;
  if (raster.kind === "flow") return `flow ${raster.dx![index]!.toFixed(2)}, ${raster.dy![index]!.toFixed(2)} px`;
  return `density ${value.toPrecision(3)} people/px`;
}
