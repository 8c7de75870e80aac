// Cases times policies: how many runs of each are finished, and what they come to so far.
import type { Study, StudyPlan, StudySummary } from "../api/types";

interface GridProps {
  study: Study;
  plan: StudyPlan;
  summary: StudySummary | null;
}

export const rowOf = (summary: StudySummary | null, one: string, policy: string) =>
  summary?.rows.find((row) => row.case === one && row.policy === policy) ?? null;

function Cell({ done, runs, mean_s, until_s }: { done: number; runs: number; mean_s: number | null; until_s: number }) {
  return (
    <td class={`study-cell ${done >= runs ? "full" : ""}`}>
      <span class="study-fill" style={{ height: `${(100 * done) / runs}%` }} aria-hidden="true" />
      <span class="study-count">
        {done} of {runs}
      </span>
      {mean_s !== null && (
        <span class="study-mean" title={`Mean of the times up to ${until_s} s`}>
          {mean_s.toFixed(1)} s
        </span>
      )}
    </td>
  );
}

export function StudyGrid({ study, plan, summary }: GridProps) {
  const cells = study.progress.cells ?? [];
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Finished runs of each case and policy">
      <table class="study-grid">
        <thead>
          <tr>
            <th scope="col">Case</th>
            {plan.policies.map((policy) => (
              <th key={policy.id} scope="col">
                {policy.title}
                {policy.id === plan.baseline && <span class="quiet-text"> (baseline)</span>}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {plan.cases.map((one, row) => (
            <tr key={one.id}>
              <th scope="row">{one.title}</th>
              {plan.policies.map((policy, column) => {
                const mean = rowOf(summary, one.id, policy.id)?.restricted_means.at(-1);
                return (
                  <Cell
                    key={policy.id}
                    done={cells[row]?.[column] ?? 0}
                    runs={plan.runs}
                    mean_s={mean?.mean_s ?? null}
                    until_s={mean?.until_s ?? 0}
                  />
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
