// Studies to begin with: those of scenarios/, and small parts of them that end within minutes.
import presets from "study_presets";
import { isObject, type Json, type JsonObject } from "../form/json";

export interface Preset {
  id: string;
  title: string;
  study: JsonObject;
}

const kSmallRuns = 6;
const kSmallDurationS = 300;

const itemsOf = (study: JsonObject, key: string) => ((study[key] ?? []) as Json[]).filter(isObject);

/** Some cases and policies of a study, by their places in it, with few runs of at most five minutes. */
function partOf(study: JsonObject, name: string, cases: number[], policies: number[]): JsonObject {
  const shortened = itemsOf(study, "cases").map((one) => ({
    ...one,
    duration_s: Math.min(kSmallDurationS, Number(one["duration_s"] ?? kSmallDurationS)),
  }));
  const baseline = study["baseline"];
  return {
    ...study,
    name,
    runs: kSmallRuns,
    cases: shortened.filter((_, index) => cases.includes(index)),
    policies: itemsOf(study, "policies").filter((policy, index) => policies.includes(index) || policy["id"] === baseline),
  };
}

function presetsOf({ file, study }: { file: string; study: JsonObject }): Preset[] {
  const title = String(study["name"] ?? file);
  const last = itemsOf(study, "cases").length - 1;
  const policies = itemsOf(study, "policies").length;
  return [
    {
      id: `${file} one`,
      title: `${title}: one case, one drone`,
      study: partOf(study, `${title}, one case`, [last], [Math.min(2, policies - 1)]),
    },
    {
      id: `${file} drones`,
      title: `${title}: two cases, numbers of drones`,
      study: partOf(study, `${title}, numbers of drones`, [last - 1, last], [2, 3, 4]),
    },
    { id: file, title: `${title}: the whole study`, study },
  ];
}

export const kPresets: Preset[] = (presets as { file: string; study: JsonObject }[]).flatMap(presetsOf);
