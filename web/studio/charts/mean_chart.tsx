// Running means over a number of runs, with their intervals.
import { useId } from "preact/hooks";
import type { RunningMean } from "../study/running";
import { type Scale, scaleOf, shareOn, signedText } from "./scale";
import { useWidth } from "./time_frame";

const kHeight = 260;
const kLeft = 52;
const kRight = 12;
const kTop = 10;
const kAxisHeight = 40;
const kFewRuns = 4;
const kMinBounded = 3; ///< the interval of two runs is thirteen times their distance

export interface MeanSeries {
  title: string;
  index: number;
  means: RunningMean[];
}

/** Means of few runs have intervals that would hide all others: they may be cut off by the frame. */
function rangeOf(series: MeanSeries[], isDifference: boolean): Scale {
  const later = (means: RunningMean[]) => means.slice(Math.min(means.length - 1, Math.max(kFewRuns, Math.floor(means.length / 4))));
  const ends = series.flatMap(({ means }) => later(means).flatMap(({ mean, margin }) => [mean - (margin ?? 0), mean + (margin ?? 0)]));
  const values = [...ends, ...series.flatMap(({ means }) => means.map(({ mean }) => mean))];
  return scaleOf(values, 5, isDifference);
}

export function MeanChart({
  series,
  runs,
  isDifference,
  label,
}: {
  series: MeanSeries[];
  runs: number;
  isDifference: boolean;
  label: string;
}) {
  const { element, width } = useWidth();
  const frame = useId(); // a page may have several of these charts
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
          <clipPath id={frame}>
            <rect x={kLeft} y={kTop} width={inner} height={kHeight - kTop} />
          </clipPath>
          {scale.ticks.map((tick) => (
            <g key={tick}>
              <line
                class={isDifference && tick === 0 ? "chart-cursor" : "chart-grid"}
                x1={kLeft}
                x2={width - kRight}
                y1={toY(tick)}
                y2={toY(tick)}
              />
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
          <g clip-path={`url(#${frame})`}>
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
              <polyline
                key={index}
                class={`series series-${index}`}
                points={means.map(({ count, mean }) => `${toX(count)},${toY(mean)}`).join(" ")}
              />
            ))}
          </g>
        </svg>
      )}
    </div>
  );
}
