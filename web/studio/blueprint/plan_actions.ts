// Actions of pointer and keys in the plan of a blueprint.
import type { RefObject, TargetedKeyboardEvent, TargetedPointerEvent } from "preact";
import { useState } from "preact/hooks";
import type { JsonObject } from "../form/json";
import { added, type Element, moved, removed, withCorner, withoutCorner } from "./elements";
import type { History } from "./history";
import type { Point } from "./kinds";
import { focusElement, kindOfTool, type Tool } from "./tools";
import { middleOf, pointAt, snapped, type View, zoomed } from "./view";

/** The state of the editor that the actions read and change. */
export interface Editing {
  history: History<JsonObject>;
  onSelect: (pointer: string | null) => void;
  tool: Tool;
  onTool: (tool: Tool) => void;
  grid: number; ///< m; 0: none
  view: View;
  onView: (view: View | null) => void;
  onUnderlayPoint: ((point: Point) => void) | null; ///< two points of the underlay are being shown
}

export type Drag =
  | { what: "element"; element: Element; from: Point; document: JsonObject }
  | { what: "corner"; element: Element; index: number; document: JsonObject }
  | { what: "new"; from: Point; to: Point }
  | { what: "view"; from: Point };

type Svg = RefObject<SVGSVGElement | null>;

const kArrows: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const kUsualSize: Record<string, Point> = { polygon: [10, 8], segment: [4, 0], point: [0, 0] };
const kSmallDrag = 0.01; ///< of the view's width
const kManySteps = 10;
const kFineStepM = 0.1; ///< of the arrow keys, without a grid
const kWheelZoom = 1.2;

/** Adds elements of the chosen tool: between two points, or of a usual size. */
function adding({ history, onSelect, tool, onTool, grid }: Editing) {
  const between = (from: Point, to: Point) => {
    const next = added(history.present, kindOfTool(tool), from, to, tool === "wall");
    history.change(next.document);
    const pointer = `/${next.path.join("/")}`;
    onSelect(pointer);
    onTool("select");
    // So that the arrow keys move it.
    requestAnimationFrame(() => focusElement(pointer));
  };
  const usual = (at: Point) => {
    const size = kUsualSize[tool === "wall" ? "segment" : kindOfTool(tool).shape]!;
    const from = snapped([at[0] - size[0] / 2, at[1] - size[1] / 2], grid);
    between(from, [from[0] + size[0], from[1] + size[1]]);
  };
  return { between, usual };
}

/** Changes what is dragged, with the pointer at a place. Returns the drag after it. */
function dragged({ history, grid, view, onView }: Editing, drag: Drag, at: Point): Drag {
  if (drag.what === "new") return { ...drag, to: snapped(at, grid) };
  if (drag.what === "view") onView({ ...view, x: view.x - (at[0] - drag.from[0]), y: view.y + (at[1] - drag.from[1]) });
  else if (drag.what === "corner") history.preview(withCorner(drag.document, drag.element, drag.index, snapped(at, grid)));
  else {
    // The grabbed element lies on the grid afterwards, wherever in it the pointer is.
    const [x, y] = drag.element.points[0] ?? [0, 0];
    const [nextX, nextY] = snapped([x + at[0] - drag.from[0], y + at[1] - drag.from[1]], grid);
    history.preview(moved(drag.document, drag.element, [nextX - x, nextY - y]));
  }
  return drag;
}

function finishNew(editing: Editing, { from, to }: { from: Point; to: Point }): void {
  const { tool, view } = editing;
  const { shape } = kindOfTool(tool);
  const isClick = Math.hypot(to[0] - from[0], to[1] - from[1]) < kSmallDrag * view.width;
  const isFlat = shape === "polygon" && tool !== "wall" && (to[0] === from[0] || to[1] === from[1]);
  const add = adding(editing);
  if (shape === "point") add.between(to, to);
  else if (isClick || isFlat) add.usual(from);
  else add.between(from, to);
}

/** Pointer and wheel: draws, moves and reshapes elements, and moves the view. */
export function usePlanPointer(svg: Svg, editing: Editing) {
  const { history, onSelect, tool, grid, view, onView, onUnderlayPoint } = editing;
  const [drag, setDrag] = useState<Drag | null>(null);
  const place = (event: MouseEvent) => pointAt(svg.current!, event.clientX, event.clientY);
  const begin = (event: PointerEvent, next: Drag) => {
    event.preventDefault();
    event.stopPropagation();
    svg.current?.setPointerCapture(event.pointerId);
    setDrag(next);
  };
  const onDown = (event: TargetedPointerEvent<SVGSVGElement>) => {
    if (event.button !== 0) return;
    const at = place(event);
    if (onUnderlayPoint) return onUnderlayPoint(at);
    if (tool !== "select") return begin(event, { what: "new", from: snapped(at, grid), to: snapped(at, grid) });
    onSelect(null);
    if (event.pointerType === "mouse") begin(event, { what: "view", from: at });
  };
  const onUp = () => {
    if (drag?.what === "new") finishNew(editing, drag);
    else if (drag) history.commit();
    setDrag(null);
  };
  return {
    drag,
    place,
    begin,
    onDown,
    onUp,
    onMove: (event: PointerEvent) => drag && setDrag(dragged(editing, drag, place(event))),
    onWheel: (event: WheelEvent) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      onView(zoomed(view, event.deltaY > 0 ? kWheelZoom : 1 / kWheelZoom, place(event)));
    },
  };
}

const isDelete = (event: KeyboardEvent) => event.key === "Delete" || event.key === "Backspace";

function taken(event: KeyboardEvent): void {
  event.preventDefault();
  event.stopPropagation();
}

/** Keys of the plan, of its elements and of their corners. */
export function planKeys(svg: Svg, editing: Editing) {
  const { history, onSelect, tool, grid, view, onView } = editing;
  const { present } = history;
  const stepOf = (event: KeyboardEvent) => (grid > 0 ? grid : kFineStepM) * (event.shiftKey ? kManySteps : 1);
  const onPlan = (event: TargetedKeyboardEvent<SVGSVGElement>) => {
    if (event.target !== event.currentTarget) return;
    const arrow = kArrows[event.key];
    if (event.key === "Enter" && tool !== "select") adding(editing).usual(middleOf(view));
    else if (arrow) onView({ ...view, x: view.x + 0.1 * arrow[0] * view.width, y: view.y - 0.1 * arrow[1] * view.height });
    else return;
    event.preventDefault();
  };
  const onElement = (event: KeyboardEvent, element: Element) => {
    const arrow = kArrows[event.key];
    if (arrow) history.change(moved(present, element, [arrow[0] * stepOf(event), arrow[1] * stepOf(event)]));
    else if (isDelete(event)) {
      history.change(removed(present, element));
      onSelect(null);
      svg.current?.focus();
    } else if (event.key === "Enter" || event.key === " ") {
      onSelect(element.pointer);
      requestAnimationFrame(() => svg.current?.querySelector<SVGElement>(".plan-handle")?.focus());
    } else return;
    taken(event);
  };
  const onCorner = (event: KeyboardEvent, element: Element, index: number) => {
    const arrow = kArrows[event.key];
    const [x, y] = element.points[index]!;
    if (arrow) history.change(withCorner(present, element, index, [x + arrow[0] * stepOf(event), y + arrow[1] * stepOf(event)]));
    else if (isDelete(event)) history.change(withoutCorner(present, element, index));
    else if (event.key === "Escape") focusElement(element.pointer);
    else return;
    taken(event);
  };
  return { onPlan, onElement, onCorner };
}
