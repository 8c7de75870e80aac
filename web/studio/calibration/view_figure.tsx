// An image of a board with the points that were found in it.
import { ServiceImage } from "../parts/elements";
import { countText } from "../parts/format";
import type { FoundPoint } from "./camera";

interface ViewFigureProps {
  id: string;
  image: string;
  path: string | null; ///< null: the points came in a table
  points: FoundPoint[] | null; ///< null: none were found
  size: [width: number, height: number];
  scale: number; ///< residuals are drawn so many times as long
  rmsPx: number | null;
  reason?: string; ///< why the image was left out
}

function captionOf({ points, rmsPx, reason }: ViewFigureProps): string {
  if (reason) return `left out: ${reason}`;
  if (!points) return "no points";
  const rejected = points.filter((point) => !point.used).length;
  const parts = [countText(points.length, "point")];
  if (rejected > 0) parts.push(countText(rejected, "outlier"));
  if (rmsPx !== null) parts.push(`RMS ${rmsPx.toFixed(3)} px`);
  return parts.join(", ");
}

export function ViewFigure(props: ViewFigureProps) {
  const { id, image, path, points, size, scale } = props;
  const [width, height] = size;
  const radius = width / 110;
  // The image's top left corner is half a pixel from the middle of the top left pixel.
  const places = (points ?? []).map(({ pixel: [u, v] }) => [u + 0.5, v + 0.5] as const);
  return (
    <figure id={id} tabIndex={-1}>
      <div class="board-view" style={{ aspectRatio: `${width} / ${height}` }}>
        {path && <ServiceImage path={path} alt={image} className="whole" />}
        {points && (
          <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label={`${points.length} points found in ${image}`}>
            <polyline class="board-order" points={places.map((place) => place.join(",")).join(" ")} stroke-width={radius / 4} />
            {points.map(({ residual_px, used }, index) => {
              const [x, y] = places[index]!;
              const [du, dv] = residual_px ?? [null, null];
              return (
                <g key={index} class={used ? "board-point" : "board-outlier"}>
                  {used ? (
                    <circle cx={x} cy={y} r={index === 0 ? 1.7 * radius : radius} stroke-width={radius / 3} />
                  ) : (
                    <path
                      d={`M ${x - radius} ${y - radius} l ${2 * radius} ${2 * radius} m 0 ${-2 * radius} l ${-2 * radius} ${2 * radius}`}
                      stroke-width={radius / 2}
                    />
                  )}
                  {du !== null && dv !== null && used && (
                    <line x1={x} y1={y} x2={x + scale * du} y2={y + scale * dv} stroke-width={radius / 2} />
                  )}
                </g>
              );
            })}
          </svg>
        )}
      </div>
      <figcaption>
        <strong>{image}</strong>: {captionOf(props)}
      </figcaption>
    </figure>
  );
}
