// The part of the plan that is shown. Coordinates of the drawing are meters with y downwards.
import { useEffect, useState } from "preact/hooks";
import type { JsonObject } from "../form/json";
import { rectangleOf } from "./elements";
import type { Point } from "./kinds";

export interface View {
  x: number; ///< of the left edge, m
  y: number; ///< of the top edge, m, downwards
  width: number;
  height: number;
}

const kUsualGround: [number, number, number, number] = [-40, -30, 40, 30];
const kBorder = 0.03; ///< of the ground's size
const kUnitPx = 8;
const kMinWidthM = 2;
const kMaxWidthM = 5000;

export function wholeView(document: JsonObject): View {
  const [x0, y0, x1, y1] = rectangleOf(document, "ground") ?? kUsualGround;
  const border = kBorder * Math.max(x1 - x0, y1 - y0);
  return { x: x0 - border, y: -y1 - border, width: x1 - x0 + 2 * border, height: y1 - y0 + 2 * border };
}

/** Larger by a factor below 1, about a point that stays where it is. */
export function zoomed(view: View, factor: number, [x, y]: Point): View {
  const width = Math.min(kMaxWidthM, Math.max(kMinWidthM, view.width * factor));
  const scale = width / view.width;
  return { x: x + (view.x - x) * scale, y: -y + (view.y + y) * scale, width, height: view.height * scale };
}

export const middleOf = (view: View): Point => [view.x + view.width / 2, -(view.y + view.height / 2)];

export function useView(document: JsonObject): [View, (view: View | null) => void] {
  const [own, setOwn] = useState<View | null>(null);
  return [own ?? wholeView(document), setOwn];
}

/** Meters per sign's unit, of 8 px: signs and names are as large on every screen and at every zoom. */
export function useUnit(svg: { current: SVGSVGElement | null }, view: View): number {
  const [size, setSize] = useState<[number, number]>([800, 600]);
  useEffect(() => {
    if (!svg.current) return;
    const observer = new ResizeObserver(([entry]) => setSize([entry!.contentRect.width || 1, entry!.contentRect.height || 1]));
    observer.observe(svg.current);
    return () => observer.disconnect();
  }, [svg]);
  return kUnitPx / Math.min(size[0] / view.width, size[1] / view.height);
}

/** Where a pointer is in the plan, m, y to the north. */
export function pointAt(svg: SVGSVGElement, clientX: number, clientY: number): Point {
  const matrix = svg.getScreenCTM();
  if (!matrix) return [0, 0];
  const point = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
  return [point.x, -point.y];
}

/** The nearest point of the grid; `step` 0: the point itself, to a centimeter. */
export function snapped([x, y]: Point, step: number): Point {
  const grid = step > 0 ? step : 0.01;
  const near = (value: number) => Math.round(Math.round(value / grid) * grid * 1000) / 1000;
  return [near(x), near(y)];
}
