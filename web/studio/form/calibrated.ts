// A calibrated camera in the job that is being written.
import { getJson } from "../api/client";
import type { Scenario } from "../api/types";
import { changedDraft, type Draft } from "./draft";
import { isObject, type Json, type JsonObject, valueAt } from "./json";

/** What a calibration says itself. */
const kReplaced = ["preset", "width", "height", "hfov_deg", "fx_px", "fy_px", "cx_px", "cy_px", "model", "distortion"];

export function withCalibration(drone: JsonObject, id: string): JsonObject {
  const camera = isObject(drone["camera"]) ? drone["camera"] : {};
  const kept = Object.entries(camera).filter(([key]) => !kReplaced.includes(key));
  return { ...drone, camera: { calibration: id, ...Object.fromEntries(kept) } };
}

/** The draft with this camera on all of its drones; those of its scenario, if it lists none. */
export async function calibratedDraft(draft: Draft, id: string): Promise<Draft> {
  const listed = valueAt(draft.value ?? {}, ["drones"]);
  let drones: Json[] = Array.isArray(listed) ? listed : [];
  const scenario = valueAt(draft.value ?? {}, ["scenario"]);
  if (drones.length === 0 && typeof scenario === "string") {
    const known = await getJson<Scenario>(`/v1/scenarios/${scenario}`).catch(() => null);
    drones = (known?.drones ?? []).map((drone) => ({ id: drone.id }));
  }
  if (drones.length === 0) drones = [{ id: "d1", start: [0, 0, 30] }];
  return changedDraft(
    draft,
    ["drones"],
    drones.map((drone) => (isObject(drone) ? withCalibration(drone, id) : drone)),
  );
}
