// Names of elements on the plan: those that would cover another are left out, until there is room or they are selected.
import type { Element } from "./elements";
import type { Point } from "./kinds";

/** In units of the view, y downwards. */
export interface PlacedName {
  text: string;
  x: number;
  y: number;
}

/** Height of a name, in units of 8 px. */
export const kNameSize = 1.5;
const kWidthOfLetter = 0.62; ///< of the height, in a bold sans-serif
const kLineHeight = 1.1;
// The first ones are those that a plan is read by.
const kOrder = ["exit", "hazard", "drone", "group", "source", "queue", "building"];

/** Where the name of an element is written: the middle of its corners. */
export function middleOfPoints(points: Point[]): Point {
  const sum = points.reduce(([x, y], point): Point => [x + point[0], y + point[1]], [0, 0] as Point);
  return [sum[0] / Math.max(1, points.length), sum[1] / Math.max(1, points.length)];
}

function nameOf(element: Element, unit: number): PlacedName | null {
  const { kind, points, value } = element;
  if (!kOrder.includes(kind.name) || points.length === 0) return null;
  const [x, y] = middleOfPoints(points);
  const count = value["count"] ?? value["per_minute"];
  const text = value["id"] ?? (kind.shape === "point" ? value["kind"] : `${String(value["doing"] ?? kind.label)} ${String(count ?? "")}`);
  return { text: String(text), x, y: -y + (kind.shape === "polygon" ? 0 : 3 * unit) };
}

function cover(a: PlacedName, b: PlacedName, unit: number): boolean {
  const height = kNameSize * unit;
  const width = 0.5 * kWidthOfLetter * height * (a.text.length + b.text.length);
  return Math.abs(a.x - b.x) < width && Math.abs(a.y - b.y) < kLineHeight * height;
}

/** The names to be drawn, by their elements; `unit` is m per 8 px. */
export function placedNames(elements: readonly Element[], selected: Element | null, unit: number): Map<Element, PlacedName> {
  const rank = (element: Element) => (element === selected ? -1 : kOrder.indexOf(element.kind.name));
  const placed = new Map<Element, PlacedName>();
  for (const element of [...elements].sort((a, b) => rank(a) - rank(b))) {
    const name = nameOf(element, unit);
    if (name && ![...placed.values()].some((other) => cover(name, other, unit))) placed.set(element, name);
  }
  return placed;
}
