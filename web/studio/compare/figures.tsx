// Figures of several jobs side by side, as means over their runs.

import { Swatch } from "../charts/share_curves";
import { countText } from "../parts/format";
import { Defined } from "../run/definitions";
import type { Metrics } from "../run/metrics";
import type { Curve } from "./job_curves";
import { summaryOf } from "./statistics";

interface Figure {
  label: string;
  anchor: string; ///< of its definition
  unit: string;
  digits: number;
  of: (run: Metrics) => number | null | undefined;
}

const percentile = (name: string) => (run: Metrics) => run.escape_time_percentiles[name];

export const kFigures: Figure[] = [
  { label: "People", anchor: "people_counts", unit: "", digits: 1, of: (run) => run.people },
  { label: "Not escaped", anchor: "not_escaped", unit: "", digits: 1, of: (run) => run.not_escaped },
  { label: "Casualties", anchor: "casualties", unit: "", digits: 1, of: (run) => run.casualties },
  { label: "Escape time, median", anchor: "escape_time_percentiles", unit: "s", digits: 1, of: percentile("t50_s") },
  { label: "Escape time, 90th percentile", anchor: "escape_time_percentiles", unit: "s", digits: 1, of: percentile("t90_s") },
  { label: "Escape time, 95th percentile", anchor: "escape_time_percentiles", unit: "s", digits: 1, of: percentile("t95_s") },
  {
    label: "Escape time, mean (censored)",
    anchor: "mean_escape_time_censored_s",
    unit: "s",
    digits: 1,
    of: (run) => run.mean_escape_time_censored_s,
  },
  {
    label: "Highest density",
    anchor: "exposure-max_density_2m2_per_m2",
    unit: "people/m²",
    digits: 2,
    of: (run) => run.exposure?.max_density_2m2_per_m2,
  },
  { label: "Balance of the exits (Jain)", anchor: "exit_balance-jain", unit: "", digits: 2, of: (run) => run.exit_balance?.jain },
];

/** "21.4 ± 0.8", or why there is no such figure: a mean of the runs that have it would be biased. */
export function figureText(figure: Figure, runs: Metrics[]): string {
  const values = runs.map((run) => figure.of(run)).filter((value): value is number => typeof value === "number");
  if (values.length === 0) return "–";
  if (values.length < runs.length) return `not reached in ${runs.length - values.length} of ${countText(runs.length, "run")}`;
  const { mean, margin } = summaryOf(values);
  return mean.toFixed(figure.digits) + (margin === null ? "" : ` ± ${margin.toFixed(figure.digits)}`);
}

export function FigureTable({ curves }: { curves: Curve[] }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Figures of the jobs">
      <table class="compared">
        <thead>
          <tr>
            <th scope="col">Mean over the runs</th>
            {curves.map((curve, index) => (
              <th key={index} scope="col" class="number">
                <Swatch index={index} /> {curve.name}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {kFigures.map((figure) => (
            <tr key={figure.label}>
              <th scope="row">
                <Defined anchor={figure.anchor}>{figure.label}</Defined> {figure.unit && <span class="unit">{figure.unit}</span>}
              </th>
              {curves.map((curve, index) => (
                <td key={index} class="number">
                  {figureText(figure, curve.runs)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
