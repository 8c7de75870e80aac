// Parts of the drawn plan of a blueprint: its ground, its elements, and the corners of the selected one.
import type { TargetedKeyboardEvent, TargetedPointerEvent } from "preact";
import type { JsonObject } from "../form/json";
import { boxCorners, type Element, insideCorners, rectangleOf } from "./elements";
import type { Point } from "./kinds";
import { Shape } from "./shapes";
import { kindOfTool, type Tool } from "./tools";
import type { Underlay } from "./underlay";

export function Ground({ document, unit }: { document: JsonObject; unit: number }) {
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

export function UnderlayImage({ underlay }: { underlay: Underlay }) {
  return (
    <image
      href={underlay.url}
      x={underlay.x}
      y={-underlay.y}
      width={underlay.width}
      height={underlay.height}
      opacity={underlay.opacity}
      preserveAspectRatio="none"
    />
  );
}

interface PlanElementProps {
  element: Element;
  unit: number;
  isSelected: boolean;
  onSelect: () => void;
  onGrab: (event: TargetedPointerEvent<SVGGElement>) => void;
  onKey: (event: TargetedKeyboardEvent<SVGGElement>) => void;
}

export function PlanElement({ element, unit, isSelected, onSelect, onGrab, onKey }: PlanElementProps) {
  return (
    <g
      class={`plan-element ${isSelected ? "selected" : ""}`}
      tabindex={0}
      role="button"
      aria-label={element.label}
      aria-pressed={isSelected}
      data-pointer={element.pointer}
      onFocus={onSelect}
      onPointerDown={onGrab}
      onKeyDown={onKey}
    >
      <Shape element={element} unit={unit} />
    </g>
  );
}

/** The outline of an element that is being drawn. */
export function NewElement({ tool, from, to, unit }: { tool: Tool; from: Point; to: Point; unit: number }) {
  const isLine = tool === "wall" || kindOfTool(tool).shape === "segment";
  const outline = isLine ? [from, to] : boxCorners([from[0], from[1], to[0], to[1]]);
  return <polygon class="plan-new" stroke-width={0.3 * unit} points={outline.map(([x, y]) => `${x},${-y}`).join(" ")} />;
}

interface HandlesProps {
  element: Element;
  unit: number;
  onGrab: (event: PointerEvent, index: number) => void;
  onKey: (event: TargetedKeyboardEvent<SVGCircleElement>, index: number) => void;
  onSplit: (edge: number) => void;
}

/** Corners of the selected element, and the middles of its edges, where a corner is added. */
export function Handles({ element, unit, onGrab, onKey, onSplit }: HandlesProps) {
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
