// Escape curves of several: medians, each with the band between its quartiles where it has one.
import { ShareAxis, shareToY, TimeFrame } from "./time_frame";

const kHeight = 240;

/** Shares from 0 to 1 at 0, 1, 2, … s. */
export interface Band {
  median: readonly number[];
  low?: readonly number[];
  high?: readonly number[];
}

/** Marks a curve's color and line. */
export function Swatch({ index }: { index: number }) {
  return (
    <svg class="series-swatch" width="26" height="10" aria-hidden="true">
      <line class={`series series-${index}`} x1="1" x2="25" y1="5" y2="5" />
    </svg>
  );
}

interface ShareCurvesProps {
  bands: readonly Band[];
  singles?: readonly (readonly number[])[]; ///< thin lines behind them
  end_s: number;
  time_s: number;
  label: string;
  onTime: (time_s: number) => void;
}

export function ShareCurves({ bands, singles = [], end_s, time_s, label, onTime }: ShareCurvesProps) {
  const toY = shareToY(kHeight);
  return (
    <TimeFrame time_s={Math.min(time_s, end_s)} end_s={end_s} onTime={onTime} height={kHeight} label={label}>
      {(toX, width) => {
        const points = (shares: readonly number[]) => shares.map((share, second) => `${toX(second)},${toY(share)}`);
        return (
          <>
            <ShareAxis width={width} toY={toY} />
            {singles.map((shares, index) => (
              <polyline key={index} class="series-single" points={points(shares).join(" ")} />
            ))}
            {bands.map(
              ({ low, high }, index) =>
                low &&
                high && (
                  <polygon
                    key={index}
                    class={`series-band series-${index}`}
                    points={[...points(high), ...points(low).reverse()].join(" ")}
                  />
                ),
            )}
            {bands.map(({ median }, index) => (
              <polyline key={index} class={`series series-${index}`} points={points(median).join(" ")} />
            ))}
          </>
        );
      }}
    </TimeFrame>
  );
}
