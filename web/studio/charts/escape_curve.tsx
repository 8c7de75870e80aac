// The share of the people of one run who have escaped.
import { type ChartProps, kTop, ShareAxis, shareToY, TimeFrame } from "./time_frame";

const kCurveHeight = 170;

interface CurveProps extends ChartProps {
  shares: number[]; ///< by 0, 1, 2, ... s
  alarm_s: number | null;
}

export function EscapeCurve({ shares, alarm_s, ...chart }: CurveProps) {
  const toY = shareToY(kCurveHeight);
  const isLate = (time_s: number) => time_s > 0.8 * chart.end_s; // its name would leave the chart
  const now = shares[Math.min(shares.length - 1, Math.round(chart.time_s))] ?? 0;
  return (
    <TimeFrame
      {...chart}
      height={kCurveHeight}
      label={`Share of the people who have escaped: ${Math.round(100 * now)} % at ${chart.time_s.toFixed(1)} s`}
    >
      {(toX, width) => (
        <>
          <ShareAxis width={width} toY={toY} />
          {alarm_s !== null && alarm_s <= chart.end_s && (
            <>
              <line class="chart-mark" x1={toX(alarm_s)} x2={toX(alarm_s)} y1="0" y2={kCurveHeight} />
              <text
                class="chart-mark-text"
                x={toX(alarm_s) + (isLate(alarm_s) ? -5 : 5)}
                y={kTop + 9}
                text-anchor={isLate(alarm_s) ? "end" : "start"}
              >
                alarm
              </text>
            </>
          )}
          <polyline class="chart-line" points={shares.map((share, second) => `${toX(second)},${toY(share)}`).join(" ")} />
          <circle class="chart-point" cx={toX(chart.time_s)} cy={toY(now)} r="4.5" />
        </>
      )}
    </TimeFrame>
  );
}
