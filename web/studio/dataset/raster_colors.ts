// Colors of values per pixel.
import type { Raster } from "./raster";

type Rgb = readonly [number, number, number];

// Viridis at equal distances (van der Walt and Smith, CC0): even in lightness, also for the color-blind.
const kViridis: Rgb[] = [
  [68, 1, 84],
  [71, 44, 122],
  [59, 81, 139],
  [44, 113, 142],
  [33, 144, 141],
  [39, 173, 129],
  [92, 200, 99],
  [170, 220, 50],
  [253, 231, 37],
];
const kPercentile = 0.98;
const kMaxSamples = 20_000;
const kMinFlowPx = 0.05;

/** The color of a share from 0 to 1. */
export function colorAt(share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (kViridis.length - 1);
  const [low, high] = [kViridis[Math.floor(at)]!, kViridis[Math.ceil(at)]!];
  const part = at - Math.floor(at);
  return [0, 1, 2].map((channel) => Math.round(low[channel]! + part * (high[channel]! - low[channel]!))) as unknown as Rgb;
}

/** Directions are hues, as in the color wheel of optical flow: right is red, down is yellow-green. */
function hueColor(angle: number, share: number): Rgb {
  const wave = (offset: number) => 0.5 + 0.5 * Math.cos(angle - offset);
  const white = 1 - Math.min(1, share);
  return [0, (2 * Math.PI) / 3, (4 * Math.PI) / 3].map((offset) =>
    Math.round(255 * (white + (1 - white) * wave(offset))),
  ) as unknown as Rgb;
}

export interface Scale {
  min: number;
  max: number;
}

/** What most of the known values lie in: a few far ones would leave one color to the others. */
export function scaleOf({ values, kind }: Raster): Scale {
  const step = Math.max(1, Math.floor(values.length / kMaxSamples));
  const known: number[] = [];
  const least = kind === "flow" ? kMinFlowPx : -Infinity; // what stands still would leave no color to the rest
  for (let index = 0; index < values.length; index += step) if (values[index]! > least) known.push(values[index]!);
  known.sort((a, b) => a - b);
  const at = (share: number) => known[Math.floor(share * (known.length - 1))] ?? 0;
  if (kind === "density") return { min: 0, max: Math.max(1e-9, known.at(-1) ?? 0) };
  return { min: kind === "flow" ? 0 : at(1 - kPercentile), max: Math.max(kind === "flow" ? 0.1 : 0.01, at(kPercentile)) };
}

/** Pixels in RGBA; clear where nothing is known, nobody is and nothing moves. */
export function pixelsOf(raster: Raster, { min, max }: Scale): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * raster.values.length);
  raster.values.forEach((value, index) => {
    if (Number.isNaN(value)) return;
    const share = (value - min) / (max - min);
    const color =
      raster.kind === "flow"
        ? hueColor(Math.atan2(raster.dy![index]!, raster.dx![index]!), share)
        : colorAt(raster.kind === "depth" ? 1 - share : Math.sqrt(Math.max(0, share)));
    pixels.set(color, 4 * index);
    pixels[4 * index + 3] = raster.kind === "depth" ? 255 : Math.round(255 * Math.min(1, 4 * share));
  });
  return pixels;
}

/** The scale in words. */
export function scaleText({ kind }: Raster, { min, max }: Scale): string {
  if (kind === "depth") return `Depth: ${min.toFixed(1)} m (yellow) to ${max.toFixed(1)} m (violet)`;
  if (kind === "flow") return `Flow to the next frame: the hue is the direction, full color from ${max.toFixed(1)} px`;
  return `Density: up to ${max.toPrecision(2)} people per pixel (yellow)`;
}
