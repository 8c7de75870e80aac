// The frame of charts over time: axes and a cursor, which a click moves. Studio and HTML reports draw with it.
import { createContext, type TargetedPointerEvent } from "preact";
import { useContext, useLayoutEffect, useRef, useState } from "preact/hooks";

export interface ChartProps {
  time_s: number;
  end_s: number;
  onTime: (time_s: number) => void;
}

export const kLeft = 74;
export const kRight = 14;
export const kTop = 10;
const kAxisHeight = 26;
const kFullTicks = 9;

/** The width of all charts in px where it is not that of their place: on paper. */
export const FixedWidth = createContext<number | null>(null);

export function useWidth() {
  const fixed = useContext(FixedWidth);
  const element = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(0);
  useLayoutEffect(() => {
    setWidth(element.current!.clientWidth);
    let frame = 0;
    // In the next frame: what is drawn changes the height of what is observed.
    const observer = new ResizeObserver(([entry]) => {
      frame = requestAnimationFrame(() => setWidth(entry!.contentRect.width));
    });
    observer.observe(element.current!);
    return () => {
      observer.disconnect();
      cancelAnimationFrame(frame);
    };
  }, []);
  return { element, width: fixed ?? width };
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
        <svg
          class="chart"
          width={width}
          height={height + kAxisHeight}
          role="img"
          aria-label={label}
          onPointerDown={pick}
          onPointerMove={pick}
        >
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

/** Positions of shares from 0 to 1 in a chart of a height. */
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
