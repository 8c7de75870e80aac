// Positions of everybody in a run, seen by cameras or not (docs/formats_pixels.md).
import { useEffect, useState } from "preact/hooks";
import { getJson, request } from "../api/client";
import { npyOf } from "../dataset/npy";

interface Description {
  times_s: number[];
  track_ids: number[];
}

export interface Trajectories {
  tracks: number[];
  /** (frames, people, kValues): x and y come first; NaN where a person is absent. */
  values: Float32Array;
}

const kValues = 4;

/** Null until they are there, and for a job that did not ask for them. */
export function useTrajectories(job: string, run: string): Trajectories | null {
  const [found, setFound] = useState<Trajectories | null>(null);
  useEffect(() => {
    const base = `/v1/jobs/${job}/files/trajectories/${run}`;
    let isWanted = true;
    setFound(null);
    const fetchBoth = async () => {
      const { track_ids } = await getJson<Description>(`${base}.json`);
      const { values } = npyOf(await (await request(`${base}.npy`)).arrayBuffer());
      if (isWanted) setFound({ tracks: track_ids, values });
    };
    fetchBoth().catch(() => {});
    return () => {
      isWanted = false;
    };
  }, [job, run]);
  return found;
}

/** Positions (m) of the people of a frame who are not among `seen`. */
export function unseenAt({ tracks, values }: Trajectories, frame: number, seen: Set<number>): [number, number][] {
  const places: [number, number][] = [];
  tracks.forEach((track, person) => {
    const at = (frame * tracks.length + person) * kValues;
    const [x, y] = [values[at], values[at + 1]];
    if (x === undefined || y === undefined || Number.isNaN(x) || seen.has(track)) return;
    places.push([x, y]);
  });
  return places;
}
