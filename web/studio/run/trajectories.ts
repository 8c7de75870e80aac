// Positions of everybody in a run, seen by cameras or not, fetched for some frames at once (docs/api.md).
import { useEffect, useRef, useState } from "preact/hooks";
import { request } from "../api/client";
import { type Capture, timeOf } from "./capture";

const kBlockFrames = 32;
const kHeadBytes = 24;
const kPlaceBytes = 6;
const kAbsent = 0xffff;
const kPersonRole = 0;
const kAttackerRole = 3; ///< a person, too
const kTracksPerRun = 1_000_000;

/** Everybody's places at some times. */
export interface Places {
  times: number;
  roles: Uint8Array; ///< per agent
  view: DataView; ///< of the places
  origin: [number, number];
  step: number; ///< m
}

export function placesOf(buffer: ArrayBuffer): Places {
  const head = new DataView(buffer);
  const [times, people] = [head.getUint32(4, true), head.getUint32(8, true)];
  const first = kHeadBytes + 8 * times + people;
  return {
    times,
    roles: new Uint8Array(buffer, kHeadBytes + 8 * times, people),
    view: new DataView(buffer, first),
    origin: [head.getFloat32(12, true), head.getFloat32(16, true)],
    step: head.getFloat32(20, true),
  };
}

/** Positions (m) of the people at a time of the block who are not among the tracks that are `seen`. */
export function unseenAt(
  { times, roles, view, origin, step }: Places,
  time: number,
  run: number,
  seen: ReadonlySet<number>,
): [number, number][] {
  const places: [number, number][] = [];
  if (time >= times) return places;
  roles.forEach((role, agent) => {
    const at = (time * roles.length + agent) * kPlaceBytes;
    const x = view.getUint16(at, true);
    if (x === kAbsent || (role !== kPersonRole && role !== kAttackerRole) || seen.has(agent + 1 + run * kTracksPerRun)) return;
    places.push([origin[0] + step * x, origin[1] + step * view.getUint16(at + 2, true)]);
  });
  return places;
}

export interface FramePlaces {
  places: Places;
  index: number; ///< of the frame's time among those of the places
}

/** Null until they are there, and where the run has no trace any more. */
export function useTrajectories(job: string, run: number, capture: Capture, frame: number): FramePlaces | null {
  const blocks = useRef(new Map<string, Places>());
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
      blocks.current.set(keyOf(start), placesOf(await answer.arrayBuffer()));
      setCount(blocks.current.size);
    };
    fetchBlock(first)
      .then(() => fetchBlock(first + kBlockFrames))
      .catch(() => {});
    return () => controller.abort();
  }, [key]);
  const places = blocks.current.get(key);
  return places ? { places, index: frame - first } : null;
}
