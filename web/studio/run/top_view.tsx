// The floor plan with the people that some camera sees, all others, and the drones.
import { useEffect, useRef } from "preact/hooks";
import { useSource } from "../api/resource";
import type { Scenario } from "../api/types";
import type { Annotation, Labels } from "../dataset/coco";
import { colorOf } from "../dataset/overlay";
import { countText } from "../parts/format";
import { sheetOf } from "../parts/sheet";
import { type FramePositions, unseenAt } from "./trajectories";

const kPerson = 1; ///< category

/** Each person once, however many cameras see them. */
export function peopleOf(labels: (Labels | null)[]): Annotation[] {
  const people = new Map<number, Annotation>();
  for (const annotation of labels.flatMap((entry) => entry?.annotations ?? [])) {
    if (annotation.category_id === kPerson) people.set(annotation.track_id, annotation);
  }
  return [...people.values()];
}

interface TopViewProps {
  scenario: Scenario;
  labels: (Labels | null)[];
  run: number;
  trajectories: FramePositions | null;
}

/** Thousands of circles are slow as elements. */
function Dots({ positions, width, height }: { positions: [number, number][]; width: number; height: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = canvas.current!.getContext("2d")!;
    context.clearRect(0, 0, width, height);
    Object.assign(context, { fillStyle: "#fff", strokeStyle: "#555", lineWidth: 2 });
    context.beginPath();
    for (const [x, y] of positions) {
      context.moveTo(x + 5, y);
      context.arc(x, y, 5, 0, 2 * Math.PI);
    }
    context.fill();
    context.stroke();
  }, [positions, width, height]);
  return <canvas ref={canvas} class="unseen" width={width} height={height} data-count={positions.length} aria-hidden="true" />;
}

export function TopView({ scenario, run, labels, trajectories }: TopViewProps) {
  const source = useSource(`/v1/scenarios/${scenario.id}?format=svg`);
  const sheet = sheetOf(scenario.ground_m as [number, number, number, number]);
  const people = peopleOf(labels);
  const unseen = trajectories
    ? unseenAt(trajectories.positions, trajectories.index, run, new Set(people.map((person) => person.track_id)))
    : [];
  return (
    <figure>
      <div class="plan-sheet">
        {source && <img src={source} alt={`floor plan of ${scenario.name ?? scenario.id}`} width={sheet.width} height={sheet.height} />}
        <Dots positions={unseen.map(([x, y]) => sheet.toPx(x, y))} width={sheet.width} height={sheet.height} />
        <svg
          viewBox={`0 0 ${sheet.width} ${sheet.height}`}
          role="img"
          aria-label={`${countText(people.length + unseen.length, "person", "people")} on the plan`}
        >
          {people.map((person) => {
            const [x, y] = sheet.toPx(person.position[0], person.position[1]);
            return <circle key={person.track_id} cx={x} cy={y} r="6" fill={colorOf(person, "state")} stroke="#000" stroke-width="1.5" />;
          })}
          {labels.map((entry) => {
            const place = entry?.image.camera?.["centre"];
            if (!entry || !place) return null;
            const [x, y] = sheet.toPx(place[0], place[1]);
            return (
              <g key={entry.image.camera_id} transform={`translate(${x} ${y})`}>
                <path d="M-14 0H14M0-14V14" stroke="#000" stroke-width="5" />
                <text y="40" text-anchor="middle" font-size="24" font-weight="700" stroke="#fff" stroke-width="6" paint-order="stroke">
                  {entry.image.camera_id}
                </text>
              </g>
            );
          })}
        </svg>
      </div>
      <figcaption>
        {countText(people.length, "person", "people")} that a camera sees, colored by state; crosses are the drones.{" "}
        {trajectories
          ? `White: ${countText(unseen.length, "person", "people")} that no camera sees.`
          : "Others are shown while the run's trace is there."}
      </figcaption>
    </figure>
  );
}
