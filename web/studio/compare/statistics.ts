// Summaries over the runs of a job.

const kCoverage = 0.95;

/** The quantile of a sample by linear interpolation between its order statistics; `share` is from 0 to 1. */
export function quantileOf(sample: readonly number[], share: number): number {
  const sorted = [...sample].sort((a, b) => a - b);
  const at = share * (sorted.length - 1);
  const low = Math.floor(at);
  const high = Math.min(sorted.length - 1, low + 1);
  return sorted[low]! + (at - low) * (sorted[high]! - sorted[low]!);
}

/** Probability that |T| < t, where T has Student's distribution (Abramowitz and Stegun, 26.7.3 and 26.7.4). */
function centralProbability(t: number, degrees: number): number {
  const angle = Math.atan(t / Math.sqrt(degrees));
  const cos = Math.cos(angle);
  const isOdd = degrees % 2 === 1;
  let term = isOdd ? cos : 1;
  let sum = degrees === 1 ? 0 : term;
  for (let power = isOdd ? 3 : 2; power <= degrees - 2; power += 2) {
    term *= ((power - 1) / power) * cos * cos;
    sum += term;
  }
  return isOdd ? (2 / Math.PI) * (angle + Math.sin(angle) * sum) : Math.sin(angle) * sum;
}

/** The t below which |T| is with probability 0.95. */
export function studentQuantile(degrees: number): number {
  let low = 0;
  let high = 1;
  while (centralProbability(high, degrees) < kCoverage) high *= 2;
  for (let step = 0; step < 60; ++step) {
    const middle = (low + high) / 2;
    if (centralProbability(middle, degrees) < kCoverage) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

export interface Summary {
  count: number;
  mean: number;
  /** Half the width of the mean's interval of 95 % (Student's t); null for a single value. */
  margin: number | null;
}

export function summaryOf(sample: readonly number[]): Summary {
  const count = sample.length;
  const mean = sample.reduce((sum, value) => sum + value, 0) / count;
  if (count < 2) return { count, mean, margin: null };
  const variance = sample.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (count - 1);
  return { count, mean, margin: studentQuantile(count - 1) * Math.sqrt(variance / count) };
}

export interface Band {
  median: number[];
  low: number[]; ///< first quartile
  high: number[]; ///< third quartile
}

/** Median and quartiles at each second; a curve that ends earlier keeps its last value. */
export function bandOf(curves: readonly (readonly number[])[]): Band {
  const length = Math.max(0, ...curves.map((curve) => curve.length));
  const band: Band = { median: [], low: [], high: [] };
  for (let second = 0; second < length; ++second) {
    const values = curves.filter((curve) => curve.length > 0).map((curve) => curve[Math.min(second, curve.length - 1)]!);
    band.median.push(quantileOf(values, 0.5));
    band.low.push(quantileOf(values, 0.25));
    band.high.push(quantileOf(values, 0.75));
  }
  return band;
}
