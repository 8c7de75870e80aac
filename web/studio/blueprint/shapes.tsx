// Elements of a blueprint as they are drawn. Sizes of signs are in units of the view, so that they stay as large.
import type { Element } from "./elements";
import type { Point } from "./kinds";
import { kNameSize, type PlacedName } from "./names";

interface ShapeProps {
  element: Element;
  unit: number; ///< m per 8 px
}

const at = ([x, y]: Point) => `${x},${-y}`;
const numberOf = (value: unknown, usual: number) => (typeof value === "number" ? value : usual);

function PointSign({ element, unit }: ShapeProps) {
  const [x, y] = element.points[0]!;
  const { name } = element.kind;
  if (name === "prop") return <circle class="plan-prop" cx={x} cy={-y} r={Math.max(0.5, 0.35 * unit)} />;
  if (name === "drone") {
    const yaw = (numberOf(element.value["yaw_deg"], 0) * Math.PI) / 180;
    const [dx, dy] = [2.2 * unit * Math.cos(yaw), -2.2 * unit * Math.sin(yaw)];
    return (
      <>
        <line class="plan-heading" x1={x} y1={-y} x2={x + dx} y2={-y + dy} stroke-width={0.3 * unit} />
        <circle class="plan-drone" cx={x} cy={-y} r={unit} stroke-width={0.2 * unit} />
      </>
    );
  }
  return (
    <>
      <circle class="plan-reach" cx={x} cy={-y} r={numberOf(element.value["radius_m"], 2)} stroke-width={0.2 * unit} />
      <path class="plan-hazard" d={`M ${x} ${-y - 1.2 * unit} l ${1.1 * unit} ${2 * unit} h ${-2.2 * unit} z`} />
    </>
  );
}

export function Shape({ element, unit }: ShapeProps) {
  const { kind, points } = element;
  if (kind.shape === "point") return <PointSign element={element} unit={unit} />;
  if (kind.shape === "segment") {
    const [from, to] = points as [Point, Point];
    const isClosed = kind.name === "exit" && element.value["open"] === false;
    return (
      <>
        {/* Wide enough to be hit. */}
        <line class="plan-hit" x1={from[0]} y1={-from[1]} x2={to[0]} y2={-to[1]} stroke-width={2.4 * unit} />
        <line
          class={`plan-${kind.name} ${isClosed ? "closed" : ""}`}
          x1={from[0]}
          y1={-from[1]}
          x2={to[0]}
          y2={-to[1]}
          stroke-width={0.7 * unit}
        />
      </>
    );
  }
  const material = kind.name === "area" ? `ground-${String(element.value["material"])}` : "";
  return <polygon class={`plan-${kind.name} ${material}`} points={points.map(at).join(" ")} stroke-width={0.2 * unit} />;
}

export function Name({ name, unit }: { name: PlacedName; unit: number }) {
  return (
    <text class="plan-name" x={name.x} y={name.y} font-size={kNameSize * unit} stroke-width={0.35 * unit}>
      {name.text}
    </text>
  );
}
