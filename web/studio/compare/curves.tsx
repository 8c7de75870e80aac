// Escape curves of several jobs: the median of their runs, and a band between the quartiles.
import { useMemo } from "preact/hooks";
import { ShareAxis, shareToY, TimeFrame } from "../run/charts";
import type { Metrics } from "../run/metrics";
import { bandOf } from "./statistics";

const kHeight = 240;

export interface Curve {
  name: string;
  runs: Metrics[];
}

/** Marks a job's color and line. */
export function Swatch({ index }: { index: number }) {
  return (
    <svg class="series-swatch" width="26" height="10" aria-hidden="true">
      <line class={`series series-${index}`} x1="1" x2="25" y1="5" y2="5" />
    </svg>
  );
}

interface CurvesProps {
  curves: Curve[];
  time_s: number;
  onTime: (time_s: number) => void;
}

export function Curves({ curves, time_s, onTime }: CurvesProps) {
  const bands = useMemo(() => curves.map((curve) => bandOf(curve.runs.map((run) => run.escape_curve.escaped_share))), [curves]);
  const end_s = Math.max(1, ...bands.map((band) => band.median.length - 1));
  const toY = shareToY(kHeight);
  const now = bands.map((band, index) => `${curves[index]!.name} ${Math.round(100 * (band.median[Math.min(band.median.length - 1, Math.round(time_s))] ?? 0))} %`);
  return (
    <TimeFrame time_s={Math.min(time_s, end_s)} end_s={end_s} onTime={onTime} height={kHeight} label={`Median share of the people who have escaped at ${time_s.toFixed(1)} s: ${now.join(", ")}`}>
      {(toX, width) => {
        const points = (shares: number[]) => shares.map((share, second) => `${toX(second)},${toY(share)}`);
        return (
          <>
            <ShareAxis width={width} toY={toY} />
            {bands.map((band, index) => (
              <polygon key={index} class={`series-band series-${index}`} points={[...points(band.high), ...points(band.low).reverse()].join(" ")} />
            ))}
            {bands.map((band, index) => (
              <polyline key={index} class={`series series-${index}`} points={points(band.median).join(" ")} />
            ))}
          </>
        );
      }}
    </TimeFrame>
  );
}
