// Differences to the baseline with their 95 % intervals: the forest plot of a study.
import type { StudyPlan, StudySummary } from "../api/types";
import { type Scale, scaleOf, shareOn, signedText } from "../charts/scale";
import { rowOf } from "./grid";

type Mean = StudySummary["rows"][number]["restricted_means"][number];

const percent = (scale: Scale, value: number) => `${100 * shareOn(scale, value)}%`;

function pText(p: number | null): string {
  if (p === null) return "–";
  return p < 0.001 ? "< 0.001" : p.toFixed(3);
}

/** Fewer than two pairs have no interval worth drawing. */
function hasInterval(mean: Mean, runs: number): boolean {
  return runs > 1 && mean.difference_95_s.every((end) => end !== null);
}

function Interval({ mean, runs, scale }: { mean: Mean; runs: number; scale: Scale }) {
  const [low, high] = mean.difference_95_s;
  const isClear = hasInterval(mean, runs) && (low! > 0 || high! < 0);
  return (
    <div class={`forest-plot ${isClear ? "clear" : ""}`} aria-hidden="true">
      <i class="forest-zero" style={{ left: percent(scale, 0) }} />
      {hasInterval(mean, runs) && (
        <i
          class="forest-interval"
          style={{ left: percent(scale, low!), width: `${100 * (shareOn(scale, high!) - shareOn(scale, low!))}%` }}
        />
      )}
      {mean.difference_s !== null && <i class="forest-point" style={{ left: percent(scale, mean.difference_s) }} />}
    </div>
  );
}

function PolicyRows({ title, means, runs, scale }: { title: string; means: Mean[]; runs: number; scale: Scale }) {
  return (
    <>
      {means.map((mean, index) => (
        <tr key={mean.until_s}>
          {index === 0 && (
            <th scope="row" rowSpan={means.length}>
              {title}
            </th>
          )}
          <td class="forest-horizon">to {mean.until_s.toFixed(0)} s</td>
          <td class="forest-cell">
            <Interval mean={mean} runs={runs} scale={scale} />
          </td>
          <td class="number forest-text">
            {signedText(mean.difference_s)}
            {hasInterval(mean, runs) && ` [${signedText(mean.difference_95_s[0])}, ${signedText(mean.difference_95_s[1])}]`}
          </td>
          <td class="number forest-p">{pText(mean.holm_p)}</td>
        </tr>
      ))}
    </>
  );
}

function CaseRows({
  one,
  plan,
  summary,
  scale,
}: {
  one: StudyPlan["cases"][number];
  plan: StudyPlan;
  summary: StudySummary;
  scale: Scale;
}) {
  const rows = plan.policies
    .filter((policy) => policy.id !== plan.baseline)
    .map((policy) => ({ policy, row: rowOf(summary, one.id, policy.id) }));
  const runs = Math.max(0, ...rows.map(({ row }) => row?.runs ?? 0));
  return (
    <tbody>
      <tr class="forest-case">
        <th colSpan={5} scope="rowgroup">
          {one.title} <span class="quiet-text">{runs === 1 ? "1 pair" : `${runs} pairs`}</span>
        </th>
      </tr>
      {rows.map(
        ({ policy, row }) =>
          row && <PolicyRows key={policy.id} title={policy.title} means={row.restricted_means} runs={row.runs} scale={scale} />,
      )}
    </tbody>
  );
}

export function Forest({ plan, summary }: { plan: StudyPlan; summary: StudySummary }) {
  const others = summary.rows.filter((row) => row.policy !== plan.baseline);
  const ends = others.flatMap((row) =>
    row.restricted_means.flatMap((mean) => [mean.difference_s, ...(hasInterval(mean, row.runs) ? mean.difference_95_s : [])]),
  );
  const scale = scaleOf(ends.filter((end): end is number => end !== null));
  const baseline = plan.policies.find((policy) => policy.id === plan.baseline)?.title ?? plan.baseline;
  if (others.length === 0) return <p class="quiet-text">A study with one policy has nothing to compare.</p>;
  return (
    <>
      <p class="quiet-text">
        Mean of the times up to either horizon, less that of “{baseline}” in the same pairs (s). Left of the line people are out sooner.
        Lines are 95 % intervals by bootstrap; p is Wilcoxon's, adjusted by Holm for all comparisons of the study.
      </p>
      <table class="forest">
        <thead>
          <tr>
            <th scope="col">Policy</th>
            <th scope="col">Mean</th>
            <th scope="col" class="forest-cell">
              <span class="hidden">Interval</span>
              <span class="forest-axis" aria-hidden="true">
                {scale.ticks.map((tick) => (
                  <span key={tick} style={{ left: percent(scale, tick) }}>
                    {signedText(tick, Number.isInteger(tick) ? 0 : 2)}
                  </span>
                ))}
              </span>
            </th>
            <th scope="col" class="number">
              Difference [95 %]
            </th>
            <th scope="col" class="number">
              p (Holm)
            </th>
          </tr>
        </thead>
        {plan.cases.map(
          (one) =>
            summary.rows.some((row) => row.case === one.id) && (
              <CaseRows key={one.id} one={one} plan={plan} summary={summary} scale={scale} />
            ),
        )}
      </table>
    </>
  );
}
