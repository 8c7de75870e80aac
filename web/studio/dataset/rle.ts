// COCO's compressed run lengths (docs/formats.md).

export interface Mask {
  size: [number, number]; ///< height, width
  counts: string | number[];
}

/** Lengths of runs of 0, 1, 0, 1, ... down the columns. */
export function runLengths({ counts }: Mask): number[] {
  if (typeof counts !== "string") return counts;
  const runs: number[] = [];
  for (let i = 0; i < counts.length; ) {
    let value = 0;
    let shift = 0;
    let bits: number;
    do {
      bits = counts.charCodeAt(i++) - 48;
      value |= (bits & 31) << shift;
      shift += 5;
    } while (bits & 32);
    if (bits & 16) value |= -1 << shift;
    runs.push(runs.length > 2 ? value + runs[runs.length - 2]! : value);
  }
  return runs;
}

/** Calls `paint` for each run of the mask's pixels, within a column: its x, first y and length. */
export function forEachRun(mask: Mask, paint: (x: number, y: number, length: number) => void): void {
  const height = mask.size[0];
  let at = 0;
  runLengths(mask).forEach((length, index) => {
    if (index % 2 === 1) {
      for (let first = at, left = length; left > 0; ) {
        const y = first % height;
        const part = Math.min(left, height - y);
        paint(Math.floor(first / height), y, part);
        first += part;
        left -= part;
      }
    }
    at += length;
  });
}
