// The plan of a blueprint, in which elements are drawn, moved and reshaped by pointer or keyboard.
import type { TargetedKeyboardEvent, TargetedPointerEvent } from "preact";
import { useMemo, useRef, useState } from "preact/hooks";
import type { JsonObject } from "../form/json";
import {
  added,
  boxCorners,
  type Element,
  insideCorners,
  moved,
  rectangleOf,
  removed,
  withCorner,
  withNewCorner,
  withoutCorner,
} from "./elements";
import type { History } from "./history";
import { type Kind, kindNamed, type Point } from "./kinds";
import { placedNames } from "./names";
import { Name, Shape } from "./shapes";
import type { Underlay } from "./underlay";
import { middleOf, pointAt, snapped, useUnit, type View, zoomed } from "./view";

export type Tool = "select" | "wall" | Kind["name"];

interface PlanEditorProps {
  history: History<JsonObject>;
  elements: Element[];
  selected: Element | undefined;
  onSelect: (pointer: string | null) => void;
  tool: Tool;
  onTool: (tool: Tool) => void;
  grid: number; ///< m; 0: none
  view: View;
  onView: (view: View | null) => void;
  underlay: Underlay | null;
  onUnderlayPoint: ((point: Point) => void) | null; ///< two points of the underlay are being shown
}

type Drag =
  | { what: "element"; element: Element; from: Point; document: JsonObject }
  | { what: "corner"; element: Element; index: number; document: JsonObject }
  | { what: "new"; from: Point; to: Point }
  | { what: "view"; from: Point };

const kArrows: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const kUsualSize: Record<string, Point> = { polygon: [10, 8], segment: [4, 0], point: [0, 0] };
const kSmallDrag = 0.01; ///< of the view's width
const kManySteps = 10;
const kWheelZoom = 1.2;

/** Gives the focus to an element of the plan, if it is drawn. */
export function focusElement(pointer: string): void {
  document.querySelector<SVGGElement>(`[data-pointer="${CSS.escape(pointer)}"]`)?.focus();
}

export const kindOfTool = (tool: Tool): Kind => kindNamed(tool === "wall" ? "building" : tool);

function Ground({ document, unit }: { document: JsonObject; unit: number }) {
  const ground = rectangleOf(document, "ground");
  const inside = insideCorners(document).map(([x, y]) => `${x},${-y}`);
  const box = ([x0, y0, x1, y1]: [number, number, number, number]) => ({ x: x0, y: -y1, width: x1 - x0, height: y1 - y0 });
  return (
    <>
      {ground && <rect class="plan-ground" {...box(ground)} />}
      {inside.length > 2 && (
        <polygon class="plan-inside" points={inside.join(" ")} stroke-width={0.2 * unit} stroke-dasharray={`${unit} ${0.6 * unit}`} />
      )}
    </>
  );
}

export function PlanEditor(props: PlanEditorProps) {
  const { history, elements, selected, onSelect, tool, onTool, grid, view, onView, underlay, onUnderlayPoint } = props;
  const { present } = history;
  const svg = useRef<SVGSVGElement>(null);
  const [drag, setDrag] = useState<Drag | null>(null);
  const unit = useUnit(svg, view);
  const names = useMemo(() => placedNames(elements, selected ?? null, unit), [elements, selected, unit]);
  const step = grid > 0 ? grid : 0.1;
  const place = (event: PointerEvent) => pointAt(svg.current!, event.clientX, event.clientY);

  const begin = (event: PointerEvent, next: Drag) => {
    event.preventDefault();
    event.stopPropagation();
    svg.current?.setPointerCapture(event.pointerId);
    setDrag(next);
  };
  const add = (from: Point, to: Point) => {
    const next = added(present, kindOfTool(tool), from, to, tool === "wall");
    history.change(next.document);
    const pointer = `/${next.path.join("/")}`;
    onSelect(pointer);
    onTool("select");
    // So that the arrow keys move it.
    requestAnimationFrame(() => focusElement(pointer));
  };
  const addUsual = (at: Point) => {
    const size = kUsualSize[tool === "wall" ? "segment" : kindOfTool(tool).shape]!;
    const from = snapped([at[0] - size[0] / 2, at[1] - size[1] / 2], grid);
    add(from, [from[0] + size[0], from[1] + size[1]]);
  };
  const onDown = (event: TargetedPointerEvent<SVGSVGElement>) => {
    if (event.button !== 0) return;
    const at = place(event);
    if (onUnderlayPoint) return onUnderlayPoint(at);
    if (tool !== "select") return begin(event, { what: "new", from: snapped(at, grid), to: snapped(at, grid) });
    onSelect(null);
    if (event.pointerType === "mouse") begin(event, { what: "view", from: at });
  };
  const onMove = (event: TargetedPointerEvent<SVGSVGElement>) => {
    if (!drag) return;
    const at = place(event);
    if (drag.what === "new") setDrag({ ...drag, to: snapped(at, grid) });
    else if (drag.what === "view") onView({ ...view, x: view.x - (at[0] - drag.from[0]), y: view.y + (at[1] - drag.from[1]) });
    else if (drag.what === "corner") history.preview(withCorner(drag.document, drag.element, drag.index, snapped(at, grid)));
    else {
      // The grabbed element lies on the grid afterwards, wherever in it the pointer is.
      const [x, y] = drag.element.points[0] ?? [0, 0];
      const [nextX, nextY] = snapped([x + at[0] - drag.from[0], y + at[1] - drag.from[1]], grid);
      history.preview(moved(drag.document, drag.element, [nextX - x, nextY - y]));
    }
  };
  const onUp = () => {
    if (drag?.what === "new") {
      const isClick = Math.hypot(drag.to[0] - drag.from[0], drag.to[1] - drag.from[1]) < kSmallDrag * view.width;
      const isFlat =
        kindOfTool(tool).shape === "polygon" && tool !== "wall" && (drag.to[0] === drag.from[0] || drag.to[1] === drag.from[1]);
      if (kindOfTool(tool).shape === "point") add(drag.to, drag.to);
      else if (isClick || isFlat) addUsual(drag.from);
      else add(drag.from, drag.to);
    } else if (drag) history.commit();
    setDrag(null);
  };
  const onKey = (event: TargetedKeyboardEvent<SVGSVGElement>) => {
    if (event.target !== event.currentTarget) return;
    const arrow = kArrows[event.key];
    if (event.key === "Enter" && tool !== "select") addUsual(middleOf(view));
    else if (arrow) onView({ ...view, x: view.x + 0.1 * arrow[0] * view.width, y: view.y - 0.1 * arrow[1] * view.height });
    else return;
    event.preventDefault();
  };
  const onElementKey = (event: TargetedKeyboardEvent<SVGGElement>, element: Element) => {
    const arrow = kArrows[event.key];
    const size = step * (event.shiftKey ? kManySteps : 1);
    if (arrow) history.change(moved(present, element, [arrow[0] * size, arrow[1] * size]));
    else if (event.key === "Delete" || event.key === "Backspace") {
      history.change(removed(present, element));
      onSelect(null);
      svg.current?.focus();
    } else if (event.key === "Enter" || event.key === " ") {
      onSelect(element.pointer);
      requestAnimationFrame(() => svg.current?.querySelector<SVGElement>(".plan-handle")?.focus());
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const onCornerKey = (event: TargetedKeyboardEvent<SVGCircleElement>, element: Element, index: number) => {
    const arrow = kArrows[event.key];
    const size = step * (event.shiftKey ? kManySteps : 1);
    const [x, y] = element.points[index]!;
    if (arrow) history.change(withCorner(present, element, index, [x + arrow[0] * size, y + arrow[1] * size]));
    else if (event.key === "Delete" || event.key === "Backspace") history.change(withoutCorner(present, element, index));
    else if (event.key === "Escape") focusElement(element.pointer);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const onWheel = (event: WheelEvent) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    onView(zoomed(view, event.deltaY > 0 ? kWheelZoom : 1 / kWheelZoom, pointAt(svg.current!, event.clientX, event.clientY)));
  };
  const canGrab = tool === "select" && !onUnderlayPoint;
  return (
    <svg
      ref={svg}
      class={`plan-editor ${canGrab ? "" : "drawing"}`}
      viewBox={`${view.x} ${view.y} ${view.width} ${view.height}`}
      role="application"
      aria-label="Plan. Enter adds an element of the chosen tool in the middle; arrow keys move the view, or the element that has the focus. Enter on an element leads to its corners."
      tabindex={0}
      onPointerDown={onDown}
      onPointerMove={onMove}
      onPointerUp={onUp}
      onPointerCancel={onUp}
      onKeyDown={onKey}
      onWheel={onWheel}
    >
      <Ground document={present} unit={unit} />
      {underlay && (
        <image
          href={underlay.url}
          x={underlay.x}
          y={-underlay.y}
          width={underlay.width}
          height={underlay.height}
          opacity={underlay.opacity}
          preserveAspectRatio="none"
        />
      )}
      {elements.map((element) =>
        element.points.length === 0 ? null : (
          <g
            key={element.pointer}
            class={`plan-element ${element === selected ? "selected" : ""}`}
            tabindex={0}
            role="button"
            aria-label={element.label}
            aria-pressed={element === selected}
            data-pointer={element.pointer}
            onFocus={() => onSelect(element.pointer)}
            onPointerDown={(event) => {
              if (!canGrab || event.button !== 0) return;
              event.currentTarget.focus({ preventScroll: true });
              begin(event, { what: "element", element, from: place(event), document: present });
            }}
            onKeyDown={(event) => onElementKey(event, element)}
          >
            <Shape element={element} unit={unit} />
          </g>
        ),
      )}
      {/* Above all elements, whose labels say the same. */}
      <g aria-hidden="true">
        {[...names].map(([element, name]) => (
          <Name key={element.pointer} name={name} unit={unit} />
        ))}
      </g>
      {canGrab && selected && selected.kind.shape !== "point" && (
        <Handles
          element={selected}
          unit={unit}
          onGrab={(event, index) => begin(event, { what: "corner", element: selected, index, document: present })}
          onKey={(event, index) => onCornerKey(event, selected, index)}
          onSplit={(edge) => history.change(withNewCorner(present, selected, edge))}
        />
      )}
      {drag?.what === "new" && (
        <polygon
          class="plan-new"
          stroke-width={0.3 * unit}
          points={newOutline(tool, drag.from, drag.to)
            .map(([x, y]) => `${x},${-y}`)
            .join(" ")}
        />
      )}
    </svg>
  );
}

function newOutline(tool: Tool, from: Point, to: Point): Point[] {
  return tool === "wall" || kindOfTool(tool).shape === "segment" ? [from, to] : boxCorners([from[0], from[1], to[0], to[1]]);
}

interface HandlesProps {
  element: Element;
  unit: number;
  onGrab: (event: PointerEvent, index: number) => void;
  onKey: (event: TargetedKeyboardEvent<SVGCircleElement>, index: number) => void;
  onSplit: (edge: number) => void;
}

/** Corners of the selected element, and the middles of its edges, where a corner is added. */
function Handles({ element, unit, onGrab, onKey, onSplit }: HandlesProps) {
  const { points, kind } = element;
  return (
    <g>
      {points.map(([x, y], index) => (
        <circle
          key={`corner${index}`}
          class="plan-handle"
          tabindex={0}
          role="button"
          aria-label={`Corner ${index + 1} of ${element.label} at ${x}, ${y}`}
          cx={x}
          cy={-y}
          r={0.9 * unit}
          stroke-width={0.25 * unit}
          onPointerDown={(event) => onGrab(event, index)}
          onKeyDown={(event) => onKey(event, index)}
        />
      ))}
      {kind.shape === "polygon" &&
        points.map(([x, y], edge) => {
          const [nextX, nextY] = points[(edge + 1) % points.length]!;
          return (
            <circle
              key={`edge${edge}`}
              class="plan-split"
              tabindex={0}
              role="button"
              aria-label={`Add a corner after corner ${edge + 1}`}
              cx={(x + nextX) / 2}
              cy={-(y + nextY) / 2}
              r={0.55 * unit}
              stroke-width={0.2 * unit}
              onPointerDown={(event) => {
                event.stopPropagation();
                onSplit(edge);
              }}
              onKeyDown={(event) => {
                if (event.key !== "Enter" && event.key !== " ") return;
                event.preventDefault();
                event.stopPropagation();
                onSplit(edge);
              }}
            />
          );
        })}
    </g>
  );
}
