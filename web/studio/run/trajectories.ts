// Positions of everybody in a run, seen by cameras or not, fetched for some frames at once (docs/api.md).
import { useEffect, useRef, useState } from "preact/hooks";
import { request } from "../api/client";
import { layouts, RecordLayout } from "../parts/layouts";
import { type Capture, timeOf } from "./capture";

const kBlockFrames = 32;
const kHead = new RecordLayout(layouts.trajectories.head);
const kAgent = new RecordLayout(layouts.trajectories.agent);
const { person: kPerson, attacker: kAttacker, spectator: kSpectator } = layouts.agent_roles;
const kPeople = new Set([kPerson, kAttacker, kSpectator]); ///< roles of people in images
const kTracksPerRun = 1_000_000;

/** Everybody's positions at some times. */
export interface Positions {
  times: number;
  roles: Uint8Array; ///< per agent
  view: DataView; ///< of the positions
  origin: [number, number];
  step: number; ///< m
}

export function readPositions(buffer: ArrayBuffer): Positions {
  const view = new DataView(buffer);
  const number = (field: string, index = 0) => kHead.read(view, 0, field, index);
  const [times, agents] = [number("times"), number("agents")];
  const rolesAt = kHead.bytes + 8 * times;
  return {
    times,
    roles: new Uint8Array(buffer, rolesAt, agents),
    view: new DataView(buffer, rolesAt + agents),
    origin: [number("origin", 0), number("origin", 1)],
    step: number("step_m"),
  };
}

/** Positions (m) of the people at a time of the block who are not among the tracks that are `seen`. */
export function unseenAt(
  { times, roles, view, origin, step }: Positions,
  time: number,
  run: number,
  seen: ReadonlySet<number>,
): [number, number][] {
  const positions: [number, number][] = [];
  if (time >= times) return positions;
  roles.forEach((role, agent) => {
    const at = (time * roles.length + agent) * kAgent.bytes;
    const x = kAgent.read(view, at, "position", 0);
    if (x === layouts.trajectories.absent || !kPeople.has(role) || seen.has(agent + 1 + run * kTracksPerRun)) return;
    positions.push([origin[0] + step * x, origin[1] + step * kAgent.read(view, at, "position", 1)]);
  });
  return positions;
}

export interface FramePositions {
  positions: Positions;
  index: number; ///< of the frame's time among those of the positions
}

/** Null until they are there, and where the run has no trace any more. */
export function useTrajectories(job: string, run: number, capture: Capture, frame: number): FramePositions | null {
  const blocks = useRef(new Map<string, Positions>());
  const [, setCount] = useState(0);
  const first = Math.floor(frame / kBlockFrames) * kBlockFrames;
  const keyOf = (start: number) => `${job} ${run} ${start}`;
  const key = keyOf(first);
  useEffect(() => {
    const controller = new AbortController();
    const fetchBlock = async (start: number) => {
      if (blocks.current.has(keyOf(start))) return;
      const times = `from_s=${timeOf(capture, start)}&to_s=${timeOf(capture, start + kBlockFrames - 1)}&every_s=${1 / capture.rate_hz}`;
      const answer = await request(`/v1/jobs/${job}/runs/${run}/trajectories?${times}`, { signal: controller.signal });
      blocks.current.set(keyOf(start), readPositions(await answer.arrayBuffer()));
      setCount(blocks.current.size);
    };
    fetchBlock(first)
      .then(() => fetchBlock(first + kBlockFrames))
      .catch(() => {});
    return () => controller.abort();
  }, [key]);
  const positions = blocks.current.get(key);
  return positions ? { positions, index: frame - first } : null;
}
