// Running means over the runs of a case: whether more runs would change what the study says.
import { useMemo, useState } from "preact/hooks";
import type { StudyPlan, StudyValues } from "../api/types";
import { MeanChart, type MeanSeries } from "../charts/mean_chart";
import { signedText } from "../charts/scale";
import { Swatch } from "../charts/share_curves";
import { differencesOf, runningMeans } from "./running";

const kMaxSeries = 6; ///< that differ in color and line

export function Convergence({ plan, values }: { plan: StudyPlan; values: StudyValues }) {
  const [caseId, setCase] = useState(plan.cases[0]!.id);
  const [horizon, setHorizon] = useState(1);
  const others = plan.policies.filter((policy) => policy.id !== plan.baseline);
  const canCompare = others.length > 0;
  const [wantsDifference, setDifference] = useState(canCompare);
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());
  const isDifference = wantsDifference && canCompare;
  const one = values.cases.find((entry) => entry.id === caseId) ?? values.cases[0]!;
  const candidates = (isDifference ? others : plan.policies).slice(0, kMaxSeries);
  const series = useMemo<MeanSeries[]>(() => {
    const meansOf = (id: string) => one.policies.find((policy) => policy.id === id)?.means_s[horizon] ?? [];
    const baseline = meansOf(plan.baseline);
    return candidates.map((policy, index) => ({
      title: policy.title,
      index,
      means: runningMeans(isDifference ? differencesOf(meansOf(policy.id), baseline) : meansOf(policy.id)),
    }));
  }, [one, horizon, isDifference]);
  const shown = series.filter((_, index) => !hidden.has(candidates[index]!.id));
  const toggle = (id: string) => setHidden(new Set(hidden.has(id) ? [...hidden].filter((other) => other !== id) : [...hidden, id]));
  const latest = shown.map(
    ({ title, means }) => `${title} ${signedText(means.at(-1)?.mean)} ± ${means.at(-1)?.margin?.toFixed(1) ?? "?"} s`,
  );
  return (
    <div class="card run-charts convergence">
      <div class="row wrap">
        <label class="row">
          Case
          <select value={one.id} onChange={(event) => setCase(event.currentTarget.value)}>
            {plan.cases.map((entry) => (
              <option key={entry.id} value={entry.id}>
                {entry.title}
              </option>
            ))}
          </select>
        </label>
        <label class="row">
          Mean to
          <select value={String(horizon)} onChange={(event) => setHorizon(Number(event.currentTarget.value))}>
            {one.horizons_s.map((until_s, index) => (
              <option key={until_s} value={String(index)}>
                {until_s} s
              </option>
            ))}
          </select>
        </label>
        {canCompare && (
          <label class="row">
            <input type="checkbox" checked={isDifference} onChange={(event) => setDifference(event.currentTarget.checked)} />
            Difference to the baseline
          </label>
        )}
      </div>
      {one.runs.length === 0 ? (
        <p class="quiet-text">No pair of this case is finished yet.</p>
      ) : (
        <MeanChart
          series={shown}
          runs={Math.max(2, one.runs.length)}
          isDifference={isDifference}
          label={`Running mean up to ${one.horizons_s[horizon]} s after ${one.runs.length} runs: ${latest.join(", ")}`}
        />
      )}
      <div class="row wrap" role="group" aria-label="Policies in the chart">
        {candidates.map((policy, index) => (
          <label key={policy.id} class="row">
            <input type="checkbox" checked={!hidden.has(policy.id)} onChange={() => toggle(policy.id)} />
            <Swatch index={index} /> {policy.title}
          </label>
        ))}
      </div>
    </div>
  );
}
