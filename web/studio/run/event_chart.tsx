// Events of a run as marks over its time, and as a list that leads to them.

import { kLeft, TimeFrame } from "../charts/time_frame";
import { countText } from "../parts/format";
import { collisionText, eventsOf, type RunEvent } from "./events";
import type { Metrics } from "./metrics";

const kRowHeight = 22;
const kNames: Record<RunEvent["kind"], string> = { alarm: "alarm", hurt: "hurt", drone: "drones", clog: "clogs" };
const kManyEvents = 12;

interface EventChartProps {
  metrics: Metrics;
  time_s: number;
  end_s: number;
  onTime: (time_s: number) => void;
}

export function EventChart({ metrics, ...chart }: EventChartProps) {
  const events = eventsOf(metrics);
  const kinds = [...new Set(events.map((event) => event.kind))];
  const collisions = collisionText(metrics);
  return (
    <>
      {events.length > 0 && (
        <TimeFrame {...chart} height={kinds.length * kRowHeight} label={`${countText(events.length, "event")} of the run`}>
          {(toX) => (
            <>
              {kinds.map((kind, row) => (
                <g key={kind}>
                  <text x={kLeft - 8} y={row * kRowHeight + 15} text-anchor="end">
                    {kNames[kind]}
                  </text>
                  {events
                    .filter((event) => event.kind === kind && event.time_s <= chart.end_s)
                    .map((event) => (
                      <path
                        key={`${event.time_s} ${event.text}`}
                        class={`event event-${kind}`}
                        transform={`translate(${toX(event.time_s)} ${row * kRowHeight + 11})`}
                        d="M0-7L6 0L0 7L-6 0Z"
                      >
                        <title>
                          {event.text}, {event.time_s.toFixed(1)} s
                        </title>
                      </path>
                    ))}
                </g>
              ))}
            </>
          )}
        </TimeFrame>
      )}
      {events.length > 0 && (
        <details class="events" open={events.length <= kManyEvents}>
          <summary>{countText(events.length, "event")}</summary>
          <ol class="plain-list">
            {events.map((event) => (
              <li key={`${event.time_s} ${event.text}`}>
                <button type="button" class="link" onClick={() => chart.onTime(event.time_s)}>
                  {event.time_s.toFixed(1)} s
                </button>{" "}
                {event.text}
              </li>
            ))}
          </ol>
        </details>
      )}
      {events.length === 0 && <p class="quiet-text">Nobody was hurt, no drone fell, and no exit clogged.</p>}
      {collisions && <p class="quiet-text">Collisions of drones: {collisions}.</p>}
    </>
  );
}
