// A calibration's camera and points as the service sends them (docs/calibration.md).
import type { Mistake } from "../api/types";

export interface CameraView {
  image: string;
  points: number; ///< used
  rms_px: number | null;
  outliers: unknown[];
  "camera_centre": [number, number, number]; ///< in the frame of the points
  rotation_vector: [number, number, number]; ///< from that frame to the camera's
}

export interface Camera {
  kind?: "intrinsics" | "pose" | "bundle";
  lens: string;
  width: number;
  height: number;
  rms_px: number | null;
  sigma_px: number | null;
  points: number;
  outliers: number;
  coverage: number; ///< share of the cells of kColumns × kRows that hold a used point
  std: Record<string, number | null>;
  views: CameraView[];
  left_out: Mistake[];
  warnings: string[];
  models?: { lens: string; unknowns: number; rms_px: number; bic: number }[];
}

export interface FoundPoint {
  pixel: [number, number]; ///< counted from the middle of the top-left one
  residual_px: [number | null, number | null] | null; ///< shown - observed; null before anything is estimated
  used: boolean;
}

export interface FoundPoints {
  width: number;
  height: number;
  views: { image: string; points: FoundPoint[] }[];
}

export const kColumns = 8;
export const kRows = 6;

/** Cells of the grid over the image, row by row, and whether each holds a used point: as the service counts them. */
export function coveredCells({ width, height, views }: FoundPoints): boolean[] {
  const cells = Array.from({ length: kColumns * kRows }, () => false);
  for (const { pixel, used } of views.flatMap((view) => view.points)) {
    const column = Math.floor(((pixel[0] + 0.5) * kColumns) / width);
    const row = Math.floor(((pixel[1] + 0.5) * kRows) / height);
    if (used && column >= 0 && row >= 0 && column < kColumns && row < kRows) cells[row * kColumns + column] = true;
  }
  return cells;
}

export interface Parameter {
  name: string;
  value: number;
  deviation: number | null; ///< null: the data leave it open; 0: it was fixed
}

/** What the camera holds beside its size, in the order of its file. */
export function parametersOf(camera: Camera): Parameter[] {
  const values = camera as unknown as Record<string, unknown>;
  const own = Object.entries(camera.std).map(([name, deviation]) => ({ name, value: Number(values[name] ?? 0), deviation }));
  return own.filter(({ value, deviation }) => value !== 0 || deviation !== 0);
}

/** A value with as many digits as its deviation supports: 2 of the deviation. */
export function valueText({ value, deviation }: Parameter): [value: string, deviation: string] {
  if (deviation === null) return [Number(value.toPrecision(6)).toString(), "open"];
  if (deviation === 0) return [Number(value.toPrecision(6)).toString(), "fixed"];
  const digits = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(deviation))));
  return [value.toFixed(digits), `± ${deviation.toFixed(digits)}`];
}

/** How many times as long residuals are drawn, so that the usual one is a 40th of the image's width: 1, 2 or 5 times a power of 10. */
export function residualScale(camera: Camera): number {
  const wanted = camera.width / 40 / Math.max(camera.rms_px ?? 1, 1e-6);
  const power = 10 ** Math.floor(Math.log10(wanted));
  const steps = [5, 2, 1].map((step) => step * power);
  return Math.min(10_000, Math.max(1, steps.find((step) => step <= wanted) ?? power));
}

/** Where a camera looks in the frame of the points: degrees from +x to +y, and above the level. */
export function directionOf([x, y, z]: CameraView["rotation_vector"]): { heading: number; pitch: number } {
  const angle = Math.hypot(x, y, z);
  const [a, b, c] = angle > 0 ? [x / angle, y / angle, z / angle] : [0, 0, 1];
  // Rodrigues: the third row of the rotation is the camera's axis.
  const [sin, rest] = [Math.sin(angle), 1 - Math.cos(angle)];
  const axis = [c * a * rest - b * sin, c * b * rest + a * sin, Math.cos(angle) + c * c * rest] as const;
  const degrees = (radians: number) => (radians * 180) / Math.PI;
  return { heading: degrees(Math.atan2(axis[1], axis[0])), pitch: degrees(Math.asin(Math.max(-1, Math.min(1, axis[2])))) };
}
