// The record of one person in an image.
import { useEffect, useState } from "preact/hooks";
import { Figures } from "../parts/elements";
import type { Annotation, Dataset, Track } from "./coco";

const percent = (share: number) => `${Math.round(100 * share)} %`;
const fixed = (values: readonly number[]) => values.map((value) => value.toFixed(1)).join(", ");

/** Of a value of instances/*.png (docs/formats_pixels.md). */
function nameOfInstance(instance: number): string {
  if (instance >= 0xff0000) return "the ground";
  if (instance >= 0xe00000) return `drone ${instance - 0xe00000}`;
  if (instance >= 0xc00000) return `prop ${instance - 0xc00000}`;
  if (instance >= 0x800000) return `building ${instance - 0x800000}`;
  return instance >= 0x400000 ? `what person ${instance - 0x400000} holds or leads` : `person ${instance}`;
}

function rowsOf(annotation: Annotation, track: Track | null): [string, string][] {
  const rows: [string, string][] = [
    ["track", String(annotation.track_id)],
    ["visible", `${percent(annotation.visibility)}, ${annotation.area} px`],
    ["place", `${fixed(annotation.position.slice(0, 2))} m`],
    ["speed", `${Math.hypot(...annotation.velocity).toFixed(2)} m/s`],
  ];
  if (annotation.truncation) rows.push(["outside of the image", percent(annotation.truncation)]);
  if (annotation.state) rows.push(["state", annotation.state]);
  if (annotation.exit) rows.push(["exit", annotation.exit]);
  const difficulty = annotation.difficulty;
  if (difficulty) {
    rows.push(
      ["contrast", `${difficulty.contrast} around, ${difficulty.edge_contrast} at the outline`],
      ["motion blur", `${difficulty.blur_px} px`],
      ["visible keypoints", `${difficulty.visible_keypoints} of 17`],
    );
  }
  const hiding = annotation.occluded_by?.map(([instance, share]) => `${percent(share)} by ${nameOfInstance(instance)}`);
  if (hiding?.length) rows.push(["hidden", hiding.slice(0, 3).join(", ")]);
  if (track?.vehicle) rows.push(["vehicle", track.vehicle]);
  const about = track?.attributes;
  if (about) {
    rows.push(["person", `${about["sex"]}, ${about["age_years"]} years, ${about["stature_m"]} m`], ["wears", String(about["wears"])]);
    if (about["carries"] !== "nothing") rows.push(["carries", String(about["carries"])]);
  }
  if (track && (track.group ?? null) !== null) rows.push(["group", String(track.group)]);
  return rows;
}

export function PersonRecord({ dataset, annotation }: { dataset: Dataset; annotation: Annotation }) {
  const [track, setTrack] = useState<Track | null>(null);
  useEffect(() => {
    let isCurrent = true;
    dataset.trackOf(annotation.track_id).then(
      (found) => isCurrent && setTrack(found),
      () => isCurrent && setTrack(null),
    );
    return () => void (isCurrent = false);
  }, [dataset, annotation.track_id]);
  return <Figures className="record" list={rowsOf(annotation, track?.id === annotation.track_id ? track : null)} />;
}
