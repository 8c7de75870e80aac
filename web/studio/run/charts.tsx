// Escape curve and exits over the time of a run; a click moves the time.
import type { TargetedPointerEvent } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { type ExitHistory, kExitStates, stateAt } from "./exit_states";

interface ChartProps {
  time_s: number;
  end_s: number;
  onTime: (time_s: number) => void;
}

export const kLeft = 74;
const kRight = 14;
const kTop = 10;
const kCurveHeight = 170;
const kRowHeight = 22;
const kAxisHeight = 26;
const kFullTicks = 9;

export function useWidth() {
  const element = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(0);
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => setWidth(entry!.contentRect.width));
    observer.observe(element.current!);
    return () => observer.disconnect();
  }, []);
  return { element, width };
}

/** 1, 2 or 5 times a power of ten, so that there are few ticks. */
export function stepOf(end_s: number, count: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(end_s, 1) / count));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => end_s / step <= count) ?? 10 * power;
}

interface FrameProps extends ChartProps {
  height: number;
  label: string;
  children: (toX: (time_s: number) => number, width: number) => preact.JSX.Element;
}

/** A chart over time with its axis and a cursor. */
export function TimeFrame({ time_s, end_s, onTime, height, label, children }: FrameProps) {
  const { element, width } = useWidth();
  const inner = Math.max(1, width - kLeft - kRight);
  const toX = (value: number) => kLeft + (inner * value) / end_s;
  const pick = (event: TargetedPointerEvent<SVGSVGElement>) => {
    if (event.buttons !== 1) return;
    const x = event.clientX - event.currentTarget.getBoundingClientRect().left;
    onTime(Math.min(end_s, Math.max(0, ((x - kLeft) / inner) * end_s)));
  };
  const step = stepOf(end_s, Math.max(2, Math.min(kFullTicks, Math.floor(inner / 70))));
  const ticks = Array.from({ length: Math.floor(end_s / step + 1e-9) + 1 }, (_, index) => index * step);
  return (
    <div ref={element}>
      {width > 0 && (
        <svg class="chart" width={width} height={height + kAxisHeight} role="img" aria-label={label} onPointerDown={pick} onPointerMove={pick}>
          {ticks.map((tick) => (
            <g key={tick}>
              <line class="chart-grid" x1={toX(tick)} x2={toX(tick)} y1="0" y2={height} />
              <text x={toX(tick)} y={height + 17} text-anchor="middle">
                {Number(tick.toFixed(3))} s
              </text>
            </g>
          ))}
          {children(toX, width)}
          <line class="chart-cursor" x1={toX(time_s)} x2={toX(time_s)} y1="0" y2={height} />
        </svg>
      )}
    </div>
  );
}

/** Places of shares from 0 to 1 in a chart of a height. */
export const shareToY = (height: number) => (share: number) => kTop + (height - kTop) * (1 - share);

export function ShareAxis({ width, toY }: { width: number; toY: (share: number) => number }) {
  return (
    <>
      {[0, 0.25, 0.5, 0.75, 1].map((share) => (
        <g key={share}>
          <line class="chart-grid" x1={kLeft} x2={width - kRight} y1={toY(share)} y2={toY(share)} />
          <text x={kLeft - 8} y={toY(share) + 4} text-anchor="end">
            {100 * share} %
          </text>
        </g>
      ))}
    </>
  );
}

interface CurveProps extends ChartProps {
  shares: number[]; ///< by 0, 1, 2, ... s
  alarm_s: number | null;
}

export function EscapeCurve({ shares, alarm_s, ...chart }: CurveProps) {
  const toY = shareToY(kCurveHeight);
  const now = shares[Math.min(shares.length - 1, Math.round(chart.time_s))] ?? 0;
  return (
    <TimeFrame {...chart} height={kCurveHeight} label={`Share of the people who have escaped: ${Math.round(100 * now)} % at ${chart.time_s.toFixed(1)} s`}>
      {(toX, width) => (
        <>
          <ShareAxis width={width} toY={toY} />
          {alarm_s !== null && alarm_s <= chart.end_s && (
            <>
              <line class="chart-mark" x1={toX(alarm_s)} x2={toX(alarm_s)} y1="0" y2={kCurveHeight} />
              <text class="chart-mark-text" x={toX(alarm_s) + 5} y={kTop + 9}>
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
                  <rect key={span.from_s} class={`exit-${span.state}`} x={toX(span.from_s)} y={row * kRowHeight + 3} width={Math.max(1, toX(span.to_s) - toX(span.from_s))} height={kRowHeight - 6}>
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
