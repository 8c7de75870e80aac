// The charts of Studio in an HTML report, whose figures are in the page (jobs/study/report_figures.h).
import { type JSX, render } from "preact";
import { useState } from "preact/hooks";
import { type ExitHistory, type ExitState, kExitStates, stateAt } from "../run/exit_states";
import { ExitChart } from "./exit_chart";
import { MeanChart, type MeanSeries } from "./mean_chart";
import { ShareCurves, Swatch } from "./share_curves";
import { FixedWidth } from "./time_frame";

/** A4 between usual margins, in px: during the layout for print, elements still report their width on the screen. */
const kPaperWidth = 690;
const kSeries = 8; ///< that differ in color and line
const kFirstCount = 2; ///< runs; of one there is no interval

type Shares = (number | null)[]; ///< in per cent, by 0, 1, 2, … s

interface Figures {
  escape: { runs: { name: string; share: Shares }[]; median: Shares; low: Shares; high: Shares };
  runs: { duration_s: number; exits: { id: string; states: [from_s: number, to_s: number, state: number][] }[] }[];
  cases: {
    curves: { name: string; share: Shares }[];
    convergence: { name: string; mean_s: (number | null)[]; low_s: (number | null)[]; high_s: (number | null)[] }[];
  }[];
}

const fractionsOf = (shares: Shares) => shares.map((share) => (share ?? 0) / 100);
const textAt = (shares: Shares, time_s: number) => `${(shares[Math.min(shares.length - 1, Math.round(time_s))] ?? 0).toFixed(1)} %`;

interface TimedProps {
  name: string;
  end_s: number;
  textOf: (time_s: number) => string; ///< what the chart shows at a time
  children: (time_s: number, onTime: (time_s: number) => void) => JSX.Element;
}

/** A chart with a time, chosen by a click in it or by the keyboard; on paper, at its end. */
function Timed({ name, end_s, textOf, children }: TimedProps) {
  const [time_s, setTime] = useState(end_s);
  return (
    <div class="report-chart">
      {children(time_s, setTime)}
      <label class="report-time">
        <span class="hidden">{name}: time in s</span>
        <input
          type="range"
          min="0"
          max={end_s}
          step="1"
          value={Math.round(time_s)}
          onInput={(event) => setTime(Number(event.currentTarget.value))}
        />
        <output>
          {Math.round(time_s)} s: {textOf(time_s)}
        </output>
      </label>
    </div>
  );
}

function Legend({ names }: { names: string[] }) {
  return (
    <ul class="legend">
      {names.map((name, index) => (
        <li key={name}>
          <Swatch index={index % kSeries} /> {name}
        </li>
      ))}
    </ul>
  );
}

function EscapeOfRuns({ escape: { runs, median, low, high } }: Figures) {
  const isOne = runs.length === 1;
  const end_s = Math.max(1, median.length - 1);
  const band = isOne ? { median: fractionsOf(median) } : { median: fractionsOf(median), low: fractionsOf(low), high: fractionsOf(high) };
  const textOf = (time_s: number) =>
    isOne ? textAt(median, time_s) : `median ${textAt(median, time_s)}, quartiles ${textAt(low, time_s)} to ${textAt(high, time_s)}`;
  return (
    <>
      <Legend names={[isOne ? runs[0]!.name : "median, with the band between the quartiles; thin: single runs"]} />
      <Timed name="People who have escaped" end_s={end_s} textOf={textOf}>
        {(time_s, onTime) => (
          <ShareCurves
            bands={[band]}
            singles={isOne ? [] : runs.map((run) => fractionsOf(run.share))}
            end_s={end_s}
            time_s={time_s}
            onTime={onTime}
            label={`Share of the people who have escaped at ${Math.round(time_s)} s: ${textOf(time_s)}`}
          />
        )}
      </Timed>
      <p class="chart-axis">time from the later of alarm and arrival</p>
    </>
  );
}

function EscapeOfPolicies({ cases }: Figures, element: HTMLElement) {
  const { curves } = cases[Number(element.dataset["case"])]!;
  const end_s = Math.max(1, ...curves.map((curve) => curve.share.length - 1));
  const textOf = (time_s: number) => curves.map((curve) => `${curve.name} ${textAt(curve.share, time_s)}`).join(", ");
  return (
    <>
      <Legend names={curves.map((curve) => curve.name)} />
      <Timed name="People out" end_s={end_s} textOf={textOf}>
        {(time_s, onTime) => (
          <ShareCurves
            bands={curves.map((curve) => ({ median: fractionsOf(curve.share) }))}
            end_s={end_s}
            time_s={time_s}
            onTime={onTime}
            label={`Share of the people out at ${Math.round(time_s)} s: ${textOf(time_s)}`}
          />
        )}
      </Timed>
      <p class="chart-axis">time since the alarm</p>
    </>
  );
}

function Convergence({ cases }: Figures, element: HTMLElement) {
  const { convergence } = cases[Number(element.dataset["case"])]!;
  const series = convergence.map((curve, index): MeanSeries => {
    // A run in which somebody never gets out has no time: nor has the mean from then on.
    const means = curve.mean_s.flatMap((mean, i) => {
      const [low, high] = [curve.low_s[i], curve.high_s[i]];
      return mean === null
        ? []
        : [{ count: i + kFirstCount, mean, margin: typeof low === "number" && typeof high === "number" ? (high - low) / 2 : null }];
    });
    return { title: curve.name, index: index % kSeries, means };
  });
  const last = series.flatMap(({ title, means }) =>
    means.slice(-1).map(({ mean, margin }) => `${title} ${mean.toFixed(1)} ± ${margin?.toFixed(1) ?? "?"} s`),
  );
  return (
    <>
      <Legend names={convergence.map((curve) => curve.name)} />
      <MeanChart
        series={series}
        runs={Math.max(2, ...series.flatMap(({ means }) => means.map(({ count }) => count)))}
        isDifference={false}
        label={`Running means, in s: ${last.join(", ")}`}
      />
    </>
  );
}

function Timeline({ runs }: Figures, element: HTMLElement) {
  const { exits, duration_s } = runs[Number(element.dataset["run"])]!;
  const histories = exits.map(
    ({ id, states }): ExitHistory => ({
      id,
      spans: states.map(([from_s, to_s, state]) => ({ from_s, to_s, state: kExitStates[state] as ExitState })),
    }),
  );
  return (
    <Timed
      name="State of the exits"
      end_s={duration_s}
      textOf={(time_s) => histories.map((history) => `${history.id} ${stateAt(history, time_s) ?? "unknown"}`).join(", ")}
    >
      {(time_s, onTime) => <ExitChart histories={histories} time_s={time_s} end_s={duration_s} onTime={onTime} />}
    </Timed>
  );
}

type Maker = (figures: Figures, element: HTMLElement) => JSX.Element;
const kMakers: Record<string, Maker> = { escape: EscapeOfRuns, policies: EscapeOfPolicies, convergence: Convergence, timeline: Timeline };

export const isReportChart = (name: string) => name in kMakers;

/** Draws the chart that the element names. Returns what to call when the page's width changes and around printing. */
export function drawReportChart(element: HTMLElement, figures: Figures): { resize: () => void; printing: (now: boolean) => void } {
  const name = element.dataset["chart"]!;
  const draw = (width: number | null) =>
    render(<FixedWidth.Provider value={width}>{kMakers[name]!(figures, element)}</FixedWidth.Provider>, element);
  element.replaceChildren();
  draw(null);
  return { resize: () => {}, printing: (now) => draw(now ? kPaperWidth : null) };
}
