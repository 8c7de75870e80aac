// Running means over the runs of a case: whether more runs would change what the study says.
import { useMemo, useState } from "preact/hooks";
import type { StudyPlan, StudyValues } from "../api/types";
import { Swatch } from "../compare/curves";
import { useWidth } from "../run/charts";
import { differencesOf, type RunningMean, runningMeans } from "./running";
import { type Scale, scaleOf, shareOn, signedText } from "./scale";

const kHeight = 260;
const kLeft = 52;
const kRight = 12;
const kTop = 10;
const kAxisHeight = 40;
const kFewRuns = 4;
const kMinBounded = 3; ///< the interval of two runs is thirteen times their distance
const kMaxSeries = 6; ///< that differ in color and line

interface Series {
  title: string;
  index: number;
  means: RunningMean[];
}

/** Means of few runs have intervals that would hide all others: they may be cut off by the frame. */
function rangeOf(series: Series[], isDifference: boolean): Scale {
  const later = (means: RunningMean[]) => means.slice(Math.min(means.length - 1, Math.max(kFewRuns, Math.floor(means.length / 4))));
  const ends = series.flatMap(({ means }) => later(means).flatMap(({ mean, margin }) => [mean - (margin ?? 0), mean + (margin ?? 0)]));
  const values = [...ends, ...series.flatMap(({ means }) => means.map(({ mean }) => mean))];
  if (isDifference || values.length === 0) return scaleOf(values);
  const least = Math.min(...values);
  const shifted = scaleOf(values.map((value) => value - least));
  return { low: shifted.low + least, high: shifted.high + least, ticks: shifted.ticks.map((tick) => tick + least) };
}

function Chart({ series, runs, isDifference, label }: { series: Series[]; runs: number; isDifference: boolean; label: string }) {
  const { element, width } = useWidth();
  const scale = rangeOf(series, isDifference);
  const inner = Math.max(1, width - kLeft - kRight);
  const toX = (count: number) => kLeft + (inner * (count - 1)) / Math.max(1, runs - 1);
  const toY = (value: number) => kTop + (kHeight - kTop) * (1 - shareOn(scale, value));
  const step = Math.max(1, Math.ceil(runs / Math.max(2, Math.floor(inner / 60))));
  const ticks = Array.from({ length: Math.floor((runs - 1) / step) + 1 }, (_, index) => 1 + index * step);
  return (
    <div ref={element}>
      {width > 0 && (
        <svg class="chart still" width={width} height={kHeight + kAxisHeight} role="img" aria-label={label}>
          <clipPath id="convergence-frame">
            <rect x={kLeft} y={kTop} width={inner} height={kHeight - kTop} />
          </clipPath>
          {scale.ticks.map((tick) => (
            <g key={tick}>
              <line class={isDifference && tick === 0 ? "chart-cursor" : "chart-grid"} x1={kLeft} x2={width - kRight} y1={toY(tick)} y2={toY(tick)} />
              <text x={kLeft - 7} y={toY(tick) + 4} text-anchor="end">
                {isDifference ? signedText(tick, Number.isInteger(tick) ? 0 : 2) : Number(tick.toFixed(1))}
              </text>
            </g>
          ))}
          {ticks.map((tick) => (
            <text key={tick} x={toX(tick)} y={kHeight + 17} text-anchor="middle">
              {tick}
            </text>
          ))}
          <text x={kLeft + inner / 2} y={kHeight + 34} text-anchor="middle">
            runs
          </text>
          <g clip-path="url(#convergence-frame)">
            {series.map(({ index, means }) => {
              const bounded = means.filter(({ count, margin }) => margin !== null && count >= kMinBounded);
              const edge = (sign: number) => bounded.map(({ count, mean, margin }) => `${toX(count)},${toY(mean + sign * margin!)}`);
              return (
                <g key={index}>
                  <polygon class={`series-band series-${index}`} points={[...edge(1), ...edge(-1).reverse()].join(" ")} />
                  {[1, -1].map((sign) => (
                    <polyline key={sign} class={`series series-edge series-${index}`} points={edge(sign).join(" ")} />
                  ))}
                </g>
              );
            })}
            {series.map(({ index, means }) => (
              <polyline key={index} class={`series series-${index}`} points={means.map(({ count, mean }) => `${toX(count)},${toY(mean)}`).join(" ")} />
            ))}
          </g>
        </svg>
      )}
    </div>
  );
}

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
  const series = useMemo<Series[]>(() => {
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
  const latest = shown.map(({ title, means }) => `${title} ${signedText(means.at(-1)?.mean)} ± ${means.at(-1)?.margin?.toFixed(1) ?? "?"} s`);
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
        <Chart series={shown} runs={Math.max(2, one.runs.length)} isDifference={isDifference} label={`Running mean up to ${one.horizons_s[horizon]} s after ${one.runs.length} runs: ${latest.join(", ")}`} />
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
