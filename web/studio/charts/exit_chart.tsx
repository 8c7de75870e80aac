// The states of the exits over the time of a run.
import { type ExitHistory, kExitStates, stateAt } from "../run/exit_states";
import { type ChartProps, kLeft, TimeFrame } from "./time_frame";

const kRowHeight = 22;

export function ExitChart({ histories, ...chart }: ChartProps & { histories: ExitHistory[] }) {
  const states = histories.map((history) => `${history.id} ${stateAt(history, chart.time_s) ?? "unknown"}`).join(", ");
  return (
    <>
      <TimeFrame {...chart} height={histories.length * kRowHeight} label={`States of the exits at ${chart.time_s.toFixed(1)} s: ${states}`}>
        {(toX) => (
          <>
            {histories.map((history, row) => (
              <g key={history.id}>
                <text x={kLeft - 8} y={row * kRowHeight + 15} text-anchor="end">
                  {history.id.length > 10 ? `${history.id.slice(0, 9)}…` : history.id}
                </text>
                {history.spans.map((span) => (
                  <rect
                    key={span.from_s}
                    class={`exit-${span.state}`}
                    x={toX(span.from_s)}
                    y={row * kRowHeight + 3}
                    width={Math.max(1, toX(span.to_s) - toX(span.from_s))}
                    height={kRowHeight - 6}
                  >
                    <title>
                      {history.id}: {span.state}, {span.from_s} to {span.to_s} s
                    </title>
                  </rect>
                ))}
              </g>
            ))}
          </>
        )}
      </TimeFrame>
      <ul class="legend">
        {kExitStates.map((state) => (
          <li key={state}>
            <i class={`swatch exit-${state}`} /> {state}
          </li>
        ))}
      </ul>
    </>
  );
}
