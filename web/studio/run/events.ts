// Events of a run, from its figures (docs/metrics.md).
import type { Metrics } from "./metrics";

export interface RunEvent {
  time_s: number;
  kind: "alarm" | "hurt" | "drone" | "clog";
  text: string;
}

/** In order of time. */
export function eventsOf(metrics: Metrics): RunEvent[] {
  const events: RunEvent[] = [];
  const add = (kind: RunEvent["kind"], time_s: number | null | undefined, text: string) => {
    if (time_s !== null && time_s !== undefined) events.push({ kind, time_s, text });
  };
  add("alarm", metrics.alarm_s, "alarm");
  metrics.by_person?.hurt_s?.forEach((time_s, index) => add("hurt", time_s, `person ${metrics.by_person!.agent[index]} is hurt`));
  for (const drone of metrics.drones ?? []) {
    add("drone", drone.falling_s, `drone ${drone.id} falls`);
    add("drone", drone.landed_s, `drone ${drone.id} lands`);
    add("drone", drone.battery_flat_s, `battery of drone ${drone.id} is flat`);
  }
  for (const exit of metrics.exits ?? []) {
    for (const clog of exit.clogs ?? [])
      add("clog", clog.from_s, `clog at ${exit.id}${clog.ended ? `, until ${clog.until_s.toFixed(1)} s` : ", not ended"}`);
  }
  return events.sort((a, b) => a.time_s - b.time_s);
}

/** Collisions of drones: figures hold how many there were of each kind, not when. */
export function collisionText(metrics: Metrics): string | null {
  const parts = (metrics.drones ?? []).flatMap((drone) =>
    Object.entries(drone.collisions ?? {}).map(([thing, count]) => `${drone.id} with ${thing} ${count}×`),
  );
  return parts.length > 0 ? parts.join(", ") : null;
}
