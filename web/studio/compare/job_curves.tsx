// Escape curves of several jobs: the median of their runs, and a band between the quartiles.
import { useMemo } from "preact/hooks";
import { ShareCurves } from "../charts/share_curves";
import type { Metrics } from "../run/metrics";
import { bandOf } from "./statistics";

export interface Curve {
  name: string;
  runs: Metrics[];
}

interface CurvesProps {
  curves: Curve[];
  time_s: number;
  onTime: (time_s: number) => void;
}

export function Curves({ curves, time_s, onTime }: CurvesProps) {
  const bands = useMemo(() => curves.map((curve) => bandOf(curve.runs.map((run) => run.escape_curve.escaped_share))), [curves]);
  const end_s = Math.max(1, ...bands.map((band) => band.median.length - 1));
  const now = bands.map(
    (band, index) =>
      `${curves[index]!.name} ${Math.round(100 * (band.median[Math.min(band.median.length - 1, Math.round(time_s))] ?? 0))} %`,
  );
  return (
    <ShareCurves
      bands={bands}
      end_s={end_s}
      time_s={time_s}
      onTime={onTime}
      label={`Median share of the people who have escaped at ${time_s.toFixed(1)} s: ${now.join(", ")}`}
    />
  );
}
