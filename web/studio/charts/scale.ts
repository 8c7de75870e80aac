// Round numbers of an axis.
import { stepOf } from "./time_frame";

export interface Scale {
  low: number;
  high: number;
  ticks: number[];
}

/** Covers all values, and zero where nothing else is said, with about `count` ticks; the ends are ticks. */
export function scaleOf(values: readonly number[], count = 5, hasZero = true): Scale {
  const finite = values.filter(Number.isFinite);
  const known = hasZero || finite.length === 0 ? [0, ...finite] : finite;
  const least = Math.min(...known);
  const most = Math.max(...known);
  const span = most - least || 1;
  // stepOf() knows no steps of spans below 1.
  const zoom = span < 1 ? 1000 : 1;
  const step = stepOf(span * zoom, count) / zoom;
  const low = step * Math.floor(least / step + 1e-9);
  const high = step * Math.ceil(Math.max(most, least + span) / step - 1e-9);
  const ticks = Array.from({ length: Math.round((high - low) / step) + 1 }, (_, index) => Number((low + index * step).toPrecision(10)));
  return { low, high, ticks };
}

export const shareOn = (scale: Scale, value: number) => (value - scale.low) / (scale.high - scale.low);

/** A difference with its sign; "–" where there is none. */
export const signedText = (value: number | null | undefined, digits = 1) =>
  typeof value === "number" ? `${value > 0 ? "+" : value < 0 ? "−" : ""}${Math.abs(value).toFixed(digits)}` : "–";
