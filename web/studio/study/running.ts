// The mean of the first 1, 2, 3, … runs with its interval: whether there are runs enough.
import { studentQuantile } from "../compare/statistics";

export interface RunningMean {
  count: number;
  mean: number;
  margin: number | null; ///< half the width of the 95 % interval (Student's t); null for a single value
}

const quantiles = new Map<number, number>();

function quantileOf(degrees: number): number {
  const known = quantiles.get(degrees);
  if (known !== undefined) return known;
  const value = studentQuantile(degrees);
  quantiles.set(degrees, value);
  return value;
}

/** By Welford's recurrence, which keeps its digits. Values that are missing are left out. */
export function runningMeans(values: readonly (number | null)[]): RunningMean[] {
  const means: RunningMean[] = [];
  let mean = 0;
  let squares = 0;
  let count = 0;
  for (const value of values) {
    if (value === null) continue;
    ++count;
    const before = value - mean;
    mean += before / count;
    squares += before * (value - mean);
    means.push({ count, mean, margin: count < 2 ? null : quantileOf(count - 1) * Math.sqrt(squares / (count - 1) / count) });
  }
  return means;
}

/** Value by value; null where either is missing. */
export function differencesOf(values: readonly (number | null)[], baseline: readonly (number | null)[]): (number | null)[] {
  return values.map((value, index) => {
    const other = baseline[index] ?? null;
    return value === null || other === null ? null : value - other;
  });
}
