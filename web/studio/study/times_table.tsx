// When half, nine tenths and 95 % of the people were out.
import type { StudyPlan, StudySummary } from "../api/types";

type Row = StudySummary["rows"][number];
const kTimes = [50, 90, 95];

const timeText = (value: number | null) => (value === null ? "never" : value.toFixed(0));

function spreadText(row: Row, percent: number): string {
  const spread = row.times[`t${percent}_s`];
  return spread ? `${timeText(spread.median)} [${timeText(spread.low)}–${timeText(spread.high)}]` : "–";
}

function CaseRows({ one, plan, rows }: { one: StudyPlan["cases"][number]; plan: StudyPlan; rows: Row[] }) {
  return (
    <tbody>
      <tr class="study-case">
        <th colSpan={kTimes.length + 5} scope="rowgroup">
          <span>{one.title}</span>
        </th>
      </tr>
      {rows.map((row) => (
        <tr key={row.policy}>
          <th scope="row">{plan.policies.find((policy) => policy.id === row.policy)?.title ?? row.policy}</th>
          <td class="number">{row.runs}</td>
          {kTimes.map((percent) => (
            <td key={percent} class="number">
              {spreadText(row, percent)}
            </td>
          ))}
          <td class="number">
            {row.all_out} of {row.runs}
          </td>
          <td class="number">{row.not_escaped.toFixed(1)}</td>
          <td class="number">{row.t90_to_bound === null ? "–" : row.t90_to_bound.toFixed(2)}</td>
        </tr>
      ))}
    </tbody>
  );
}

export function TimesTable({ plan, summary }: { plan: StudyPlan; summary: StudySummary }) {
  const leaks = summary.rows.filter((row) => (row.left_by_no_exit ?? 0) > 0);
  return (
    <>
      <div class="scroll" tabIndex={0} role="region" aria-label="Times at which shares of the people were out">
        <table class="compared study-times">
          <thead>
            <tr>
              <th scope="col">Policy</th>
              <th scope="col" class="number">
                Runs
              </th>
              {kTimes.map((percent) => (
                <th key={percent} scope="col" class="number">
                  T{percent} <span class="unit">s</span>
                </th>
              ))}
              <th scope="col" class="number">
                All out
              </th>
              <th scope="col" class="number">
                Left inside
              </th>
              <th scope="col" class="number">
                T90 / bound
              </th>
            </tr>
          </thead>
          {plan.cases.map((one) => {
            const rows = summary.rows.filter((row) => row.case === one.id);
            return rows.length > 0 && <CaseRows key={one.id} one={one} plan={plan} rows={rows} />;
          })}
        </table>
      </div>
      {leaks.map((row) => (
        <p key={row.case + row.policy}>
          Warning: {plan.cases.find((one) => one.id === row.case)?.title ?? row.case}: {row.left_by_no_exit?.toFixed(1)} people per run left
          where there is no exit.
        </p>
      ))}
    </>
  );
}
