// The floor plan, with the job's drones to move and the ground that their cameras see.
import type { TargetedKeyboardEvent, TargetedPointerEvent } from "preact";
import { useRef, useState } from "preact/hooks";
import { useSource } from "../api/resource";
import type { Scenario } from "../api/types";
import { sheetOf } from "../parts/sheet";
import type { Form } from "./draft";
import { footprint } from "./footprint";
import { isObject, type Json, valueAt } from "./json";

const kStepM = 1;
const kColors = ["#b3261e", "#0b57d0", "#7b1fa2", "#00695c", "#8d4b00", "#37474f"];

interface Drone {
  id: string;
  start: [number, number, number];
  yawDeg: number;
  pitchDeg: number;
  hfovDeg: number;
  aspect: number;
}

const numberAt = (value: Json | undefined, usual: number) => (typeof value === "number" ? value : usual);

export function dronesOf(form: Form, scenario: Scenario): Drone[] {
  const defaults = (scenario.drones ?? []) as { id: string; start_m: [number, number, number]; yaw_deg?: number }[];
  const listed = valueAt(form.value, ["drones"]);
  const list: Json[] = Array.isArray(listed) ? listed : defaults.map((drone) => ({ id: drone.id }));
  return list.filter(isObject).map((drone) => {
    const own = drone["start"];
    const isPosition = Array.isArray(own) && own.length === 3 && own.every((value) => typeof value === "number");
    const known = defaults.find((entry) => entry.id === drone["id"]);
    const camera = (path: string, value: number) => numberAt(valueAt(drone, ["camera", path]), value);
    return {
      id: String(drone["id"] ?? ""),
      start: isPosition ? (own as [number, number, number]) : (known?.start_m ?? [0, 0, 30]),
      // The camera turns with the drone, which heads as the scenario's of this name.
      yawDeg: (known?.yaw_deg ?? 0) + camera("yaw_deg", 0),
      pitchDeg: camera("pitch_deg", -50),
      hfovDeg: camera("hfov_deg", 78),
      aspect: camera("width", 1280) / camera("height", 720),
    };
  });
}

export function Plan({ form, scenario }: { form: Form; scenario: Scenario }) {
  const source = useSource(`/v1/scenarios/${scenario.id}?format=svg`);
  const svg = useRef<SVGSVGElement>(null);
  const [dragged, setDragged] = useState<number | null>(null);
  if (!scenario.ground_m) return null;
  const sheet = sheetOf(scenario.ground_m as [number, number, number, number]);
  const drones = dronesOf(form, scenario);
  const move = (index: number, x: number, y: number) => {
    const place = [Math.round(10 * x) / 10, Math.round(10 * y) / 10, drones[index]!.start[2]];
    // The scenario's drones become the job's own with the first change.
    if (!Array.isArray(valueAt(form.value, ["drones"]))) {
      form.change(
        ["drones"],
        drones.map((drone, i): Json => (i === index ? { id: drone.id, start: place } : { id: drone.id })),
      );
    } else form.change(["drones", index, "start"], place);
  };
  const onPointerMove = (event: TargetedPointerEvent<SVGSVGElement>) => {
    const matrix = svg.current?.getScreenCTM();
    if (dragged === null || !matrix) return;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    move(dragged, ...sheet.toMeters(point.x, point.y));
  };
  const onKey = (event: TargetedKeyboardEvent<SVGGElement>, index: number) => {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    const [x, y] = drones[index]!.start;
    move(index, x + kStepM * step[0], y + kStepM * step[1]);
  };
  return (
    <figure class="plan">
      <div class="plan-sheet">
        {source && <img src={source} alt={`floor plan of ${scenario.name ?? scenario.id}`} width={sheet.width} height={sheet.height} />}
        <svg
          ref={svg}
          viewBox={`0 0 ${sheet.width} ${sheet.height}`}
          onPointerMove={onPointerMove}
          onPointerUp={() => setDragged(null)}
          onPointerLeave={() => setDragged(null)}
        >
          {drones.map((drone, index) => {
            const [x, y, height] = drone.start;
            const color = kColors[index % kColors.length]!;
            const [px, py] = sheet.toPx(x, y);
            const ground = footprint({ ...drone, x, y, height }).map(([gx, gy]) => sheet.toPx(gx, gy).join(","));
            return (
              <g key={index}>
                <polygon
                  points={ground.join(" ")}
                  fill={color}
                  fill-opacity="0.14"
                  stroke={color}
                  stroke-width="2.5"
                  stroke-dasharray="10 5"
                  pointer-events="none"
                />
                <g
                  class="drone"
                  tabindex={0}
                  role="button"
                  aria-label={`Drone ${drone.id} at ${x}, ${y}; height ${height} m. Arrow keys move it.`}
                  transform={`translate(${px} ${py})`}
                  onPointerDown={(event) => {
                    event.preventDefault();
                    setDragged(index);
                  }}
                  onKeyDown={(event) => onKey(event, index)}
                >
                  <circle r="30" fill="transparent" />
                  <circle r="17" fill={color} stroke="#fff" stroke-width="4" />
                  <text
                    y="50"
                    text-anchor="middle"
                    font-size="26"
                    font-weight="700"
                    fill={color}
                    stroke="#fff"
                    stroke-width="6"
                    paint-order="stroke"
                  >
                    {drone.id}
                  </text>
                </g>
              </g>
            );
          })}
        </svg>
      </div>
      <figcaption>
        Drag a drone, or move it with the arrow keys. The dashed area is the ground that its camera sees at the start.
      </figcaption>
    </figure>
  );
}
