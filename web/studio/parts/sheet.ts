// Positions of the world in the drawing of a floor plan.

import { layouts } from "./layouts";

const {
  plan_px: kPlanPx,
  border_px: kBorderPx,
  title_px: kTitlePx,
  legend_line_px: kLegendLinePx,
  legend_column_px: kLegendColumnPx,
  legend_entries: kLegendEntries,
  min_width_px: kMinWidthPx,
} = layouts.plan;

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
