// Positions of the world in the drawing of a floor plan.

// As world/scenarios/plan/plan_drawing.cpp draws it: the longer side, and where the ground begins in the drawing.
const kPlanPx = 1200;
const kBorderPx = 20;
const kTitlePx = 30;
const kLegendLinePx = 22;
const kLegendColumnPx = 200;
const kLegendEntries = 10;
const kMinWidthPx = 640;

export interface Sheet {
  width: number;
  height: number;
  toPx: (x: number, y: number) => [number, number];
  toMeters: (x: number, y: number) => [number, number];
}

export function sheetOf([minX, minY, maxX, maxY]: [number, number, number, number]): Sheet {
  const scale = kPlanPx / Math.max(maxX - minX, maxY - minY);
  const planHeight = Math.ceil((maxY - minY) * scale);
  const width = Math.max(kMinWidthPx, Math.ceil((maxX - minX) * scale) + 2 * kBorderPx);
  const legendRows = Math.ceil(kLegendEntries / Math.floor((width - kBorderPx) / kLegendColumnPx));
  return {
    width,
    height: kTitlePx + planHeight + 2 * kBorderPx + (legendRows + 1) * kLegendLinePx,
    toPx: (x, y) => [kBorderPx + (x - minX) * scale, kTitlePx + kBorderPx + planHeight - (y - minY) * scale],
    toMeters: (x, y) => [(x - kBorderPx) / scale + minX, (kTitlePx + kBorderPx + planHeight - y) / scale + minY],
  };
}
