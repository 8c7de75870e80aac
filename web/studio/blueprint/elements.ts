// Elements of a blueprint: where they are, and blueprints in which one is added, moved or removed.
import { isObject, type Json, type JsonObject, type Path, pointerOf, valueAt, withValue } from "../form/json";
import { type Kind, kKinds, type Point } from "./kinds";

export interface Element {
  kind: Kind;
  path: Path;
  pointer: string; ///< RFC 6901, of the blueprint
  label: string;
  points: Point[]; ///< corners, two ends, or one place; empty: it has none of its own
  value: JsonObject;
}

const kWallThicknessM = 0.4;
const kDroneHeightM = 25;
const kMinCorners = 3;

const isPoint = (value: Json | undefined): value is number[] =>
  Array.isArray(value) && value.length >= 2 && value.every((part) => typeof part === "number");
const pointOf = (value: Json | undefined): Point[] => (isPoint(value) ? [[value[0]!, value[1]!]] : []);
const centimeters = (value: number) => Math.round(100 * value) / 100;
const rounded = ([x, y]: Point): Point => [centimeters(x), centimeters(y)];

export function boxCorners([x0, y0, x1, y1]: readonly [number, number, number, number]): Point[] {
  return [
    [x0, y0],
    [x1, y0],
    [x1, y1],
    [x0, y1],
  ];
}

function pointsOf(kind: Kind, value: JsonObject): Point[] {
  if (kind.shape === "point") return pointOf(value[kind.place!]);
  if (kind.shape === "segment") return [...pointOf(value["from"]), ...pointOf(value["to"])];
  const box = value["box"];
  if (Array.isArray(box) && box.length === 4 && box.every((part) => typeof part === "number"))
    return boxCorners(box as [number, number, number, number]);
  const outline = value[kind.outline!];
  return Array.isArray(outline) ? outline.flatMap(pointOf) : [];
}

/** With all that the plan writes beside it. */
function labelOf(kind: Kind, value: JsonObject, number: number): string {
  const name = value["id"] ?? value["kind"] ?? value["material"] ?? value["doing"];
  const count = value["count"] ?? value["per_minute"];
  const words = [name, count].filter((word) => typeof word === "string" || typeof word === "number");
  return `${kind.label} ${words.length > 0 ? words.join(" ") : number + 1}`;
}

/** All elements, in the order in which they are drawn: what people stand on first. */
export function elementsOf(document: JsonObject): Element[] {
  const order = ["area", "marking", "scatter", "group", "building", "row", "prop", "queue", "exit", "source", "hazard", "drone"];
  return order.flatMap((name) => {
    const kind = kKinds.find((entry) => entry.name === name)!;
    const list = valueAt(document, kind.list);
    if (!Array.isArray(list)) return [];
    return list.flatMap((value, index): Element[] => {
      if (!isObject(value)) return [];
      const path = [...kind.list, index];
      return [{ kind, path, pointer: pointerOf(path), label: labelOf(kind, value, index), points: pointsOf(kind, value), value }];
    });
  });
}

/** The element that a finding is about: the one whose pointer it begins with. */
export function elementAt(elements: Element[], pointer: string): Element | undefined {
  return elements.find((element) => pointer === element.pointer || pointer.startsWith(`${element.pointer}/`));
}

function isBox(points: Point[]): boolean {
  const [a, b, c, d] = points;
  return points.length === 4 && a![1] === b![1] && b![0] === c![0] && c![1] === d![1] && d![0] === a![0];
}

/** The element with these corners. A box stays one as long as it is one; corners are counter-clockwise from above. */
function withPoints(element: Element, points: Point[]): JsonObject {
  const { kind, value } = element;
  const next: JsonObject = { ...value };
  if (kind.shape === "segment") [next["from"], next["to"]] = points as [Point, Point];
  else if (kind.shape === "point") {
    const old = value[kind.place!];
    next[kind.place!] = [...points[0]!, ...(Array.isArray(old) ? old.slice(2) : [])];
  } else if ("box" in value && isBox(points)) {
    const xs = points.map(([x]) => x);
    const ys = points.map(([, y]) => y);
    next["box"] = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  } else {
    delete next["box"];
    next[kind.outline!] = signedArea(points) < 0 ? [...points].reverse() : points;
  }
  return next;
}

export function signedArea(points: Point[]): number {
  return points.reduce((sum, [x, y], i) => {
    const [nextX, nextY] = points[(i + 1) % points.length]!;
    return sum + (x * nextY - nextX * y) / 2;
  }, 0);
}

const replaced = (document: JsonObject, element: Element, value: JsonObject) => withValue(document, element.path, value) as JsonObject;

export function moved(document: JsonObject, element: Element, [dx, dy]: Point): JsonObject {
  if (element.points.length === 0) return document;
  return replaced(
    document,
    element,
    withPoints(
      element,
      element.points.map(([x, y]) => rounded([x + dx, y + dy])),
    ),
  );
}

/** With one corner elsewhere. Those of a box move with it, so that it stays a box. */
export function withCorner(document: JsonObject, element: Element, index: number, place: Point): JsonObject {
  const points = element.points.map((point): Point => [...point]);
  const [x, y] = rounded(place);
  if ("box" in element.value) {
    const opposite = points[(index + 2) % 4]!;
    if (opposite[0] === x || opposite[1] === y) return document;
    const neighbors = [(index + 1) % 4, (index + 3) % 4];
    for (const neighbor of neighbors) {
      // One of the two neighbors shares the corner's x, the other its y.
      const axis = points[neighbor]![0] === points[index]![0] ? 0 : 1;
      points[neighbor]![axis] = axis === 0 ? x : y;
    }
  }
  points[index] = [x, y];
  return replaced(document, element, withPoints(element, points));
}

/** With another corner in the middle of the edge that begins at a corner. */
export function withNewCorner(document: JsonObject, element: Element, edge: number): JsonObject {
  const [x0, y0] = element.points[edge]!;
  const [x1, y1] = element.points[(edge + 1) % element.points.length]!;
  const points = [...element.points];
  points.splice(edge + 1, 0, rounded([(x0 + x1) / 2, (y0 + y1) / 2]));
  return replaced(document, element, withPoints(element, points));
}

export function withoutCorner(document: JsonObject, element: Element, index: number): JsonObject {
  if (element.kind.shape !== "polygon" || element.points.length <= kMinCorners) return document;
  return replaced(
    document,
    element,
    withPoints(
      element,
      element.points.filter((_, i) => i !== index),
    ),
  );
}

export function removed(document: JsonObject, element: Element): JsonObject {
  return (withValue(document, element.path, undefined) ?? {}) as JsonObject;
}

function freeId(document: JsonObject, kind: Kind, prefix: string): string {
  const list = valueAt(document, kind.list);
  const ids = new Set((Array.isArray(list) ? list : []).map((entry) => (isObject(entry) ? entry["id"] : "")));
  let number = 1;
  while (ids.has(`${prefix}${number}`)) ++number;
  return `${prefix}${number}`;
}

/** The outline of a wall along a segment, to its left. */
function wallOutline([[x0, y0], [x1, y1]]: [Point, Point]): Point[] {
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [nx, ny] = [(-(y1 - y0) / length) * kWallThicknessM, ((x1 - x0) / length) * kWallThicknessM];
  return (
    [
      [x0, y0],
      [x1, y1],
      [x1 + nx, y1 + ny],
      [x0 + nx, y0 + ny],
    ] as Point[]
  ).map(rounded);
}

/** A blueprint with a new element from one point of the plan to another, and the path of that. A wall is a low building. */
export function added(document: JsonObject, kind: Kind, from: Point, to: Point, isWall = false): { document: JsonObject; path: Path } {
  const list = valueAt(document, kind.list);
  const path = [...kind.list, Array.isArray(list) ? list.length : 0];
  const value: JsonObject = { ...(kind.idPrefix ? { id: freeId(document, kind, isWall ? "wall" : kind.idPrefix) } : {}), ...kind.members };
  const [start, end] = [rounded(from), rounded(to)];
  if (isWall) {
    value["footprint"] = wallOutline([start, end]);
    value["height_m"] = 2;
  } else if (kind.shape === "point") value[kind.place!] = kind.name === "drone" ? [...start, kDroneHeightM] : start;
  else if (kind.shape === "segment") [value["from"], value["to"]] = [start, end];
  else value["box"] = [Math.min(start[0], end[0]), Math.min(start[1], end[1]), Math.max(start[0], end[0]), Math.max(start[1], end[1])];
  return { document: withValue(document, path, value) as JsonObject, path };
}

/** A rectangle of the blueprint: "ground" or "inside". */
export function rectangleOf(document: JsonObject, name: string): [number, number, number, number] | null {
  const [low] = pointOf(valueAt(document, [name, "min"]));
  const [high] = pointOf(valueAt(document, [name, "max"]));
  return low && high && low[0] < high[0] && low[1] < high[1] ? [...low, ...high] : null;
}

/** The corners of "inside": those of its rectangle or of its polygon; none while it has neither. */
export function insideCorners(document: JsonObject): Point[] {
  const rectangle = rectangleOf(document, "inside");
  if (rectangle) return boxCorners(rectangle);
  const corners = valueAt(document, ["inside", "corners"]);
  return Array.isArray(corners) ? corners.flatMap(pointOf) : [];
}
