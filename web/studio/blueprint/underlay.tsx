// An image below the plan, such as a photograph of a map, whose scale is given by two of its points and their distance.
import { useState } from "preact/hooks";
import { FileButton } from "../parts/elements";
import type { Point } from "./kinds";

export interface Underlay {
  url: string;
  x: number; ///< of its left edge, m
  y: number; ///< of its top edge, m, to the north
  width: number; ///< m
  height: number;
  opacity: number;
}

/** The underlay with another scale, so that two of its points are so far apart. The first stays where it is. */
export function scaled(underlay: Underlay, [a, b]: [Point, Point], distanceM: number): Underlay {
  const shown = Math.hypot(b[0] - a[0], b[1] - a[1]);
  if (!(shown > 0) || !(distanceM > 0)) return underlay;
  const factor = distanceM / shown;
  return {
    ...underlay,
    x: a[0] + (underlay.x - a[0]) * factor,
    y: a[1] + (underlay.y - a[1]) * factor,
    width: underlay.width * factor,
    height: underlay.height * factor,
  };
}

interface UnderlayPanelProps {
  underlay: Underlay | null;
  onChange: (underlay: Underlay | null) => void;
  points: Point[] | null; ///< being shown; null: none are asked for
  onPoints: (points: Point[] | null) => void;
  widthM: number; ///< of the ground, as wide as a new image is
}

export function UnderlayPanel({ underlay, onChange, points, onPoints, widthM }: UnderlayPanelProps) {
  const [distance, setDistance] = useState("10");
  const [error, setError] = useState<string | null>(null);
  const open = async (file: File) => {
    const url = URL.createObjectURL(file);
    const image = new Image();
    image.src = url;
    try {
      await image.decode();
      const height = (widthM * image.naturalHeight) / image.naturalWidth;
      onChange({ url, x: -widthM / 2, y: height / 2, width: widthM, height, opacity: 0.5 });
      setError(null);
    } catch {
      setError(`${file.name} is no image that this browser shows`);
    }
  };
  const apply = () => {
    if (underlay && points?.length === 2) onChange(scaled(underlay, points as [Point, Point], Number(distance)));
    onPoints(null);
  };
  return (
    <details class="part">
      <summary>Image below the plan</summary>
      <div class="stack">
        <p class="quiet-text">A map or a floor plan to draw over. It stays in this browser and is not part of the blueprint.</p>
        <FileButton accept="image/*" onFiles={([file]) => void open(file!)}>
          Choose an image
        </FileButton>
        {error && (
          <p class="field-error" role="alert">
            {error}
          </p>
        )}
        {underlay && (
          <>
            <label class="row">
              Opacity
              <input
                class="grow"
                type="range"
                min="0.1"
                max="1"
                step="0.05"
                value={underlay.opacity}
                onInput={(event) => onChange({ ...underlay, opacity: Number(event.currentTarget.value) })}
              />
            </label>
            {points === null ? (
              <button type="button" class="button small" onClick={() => onPoints([])}>
                Set the scale by two points
              </button>
            ) : (
              <>
                <p aria-live="polite">
                  {points.length < 2
                    ? `Click the ${points.length === 0 ? "first" : "second"} point in the plan.`
                    : "How far apart are they?"}
                </p>
                <div class="row">
                  <label class="row grow">
                    Distance
                    <input class="short" inputMode="decimal" value={distance} onInput={(event) => setDistance(event.currentTarget.value)} />{" "}
                    m
                  </label>
                  <button type="button" class="button small" disabled={points.length < 2 || !(Number(distance) > 0)} onClick={apply}>
                    Apply
                  </button>
                </div>
              </>
            )}
            <div class="fields">
              {(["x", "y", "width"] as const).map((key) => (
                <label key={key} class="field">
                  <span class="field-name">
                    {key === "width" ? "Width" : key === "x" ? "Left" : "Top"}
                    <span class="unit"> m</span>
                  </span>
                  <input
                    inputMode="decimal"
                    value={String(Math.round(100 * underlay[key]) / 100)}
                    onChange={(event) => {
                      const value = Number(event.currentTarget.value);
                      if (!Number.isFinite(value) || (key === "width" && value <= 0)) return;
                      onChange(
                        key === "width"
                          ? { ...underlay, width: value, height: (underlay.height * value) / underlay.width }
                          : { ...underlay, [key]: value },
                      );
                    }}
                  />
                </label>
              ))}
            </div>
            <button type="button" class="button small danger-text" onClick={() => onChange(null)}>
              Remove the image
            </button>
          </>
        )}
      </div>
    </details>
  );
}
