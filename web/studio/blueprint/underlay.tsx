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

/** The scale, from two points that the user shows in the plan and their distance. */
function ScaleByPoints({ underlay, onChange, points, onPoints }: Omit<UnderlayPanelProps, "widthM" | "underlay"> & { underlay: Underlay }) {
  const [distance, setDistance] = useState("10");
  if (points === null) {
    return (
      <button type="button" class="button small" onClick={() => onPoints([])}>
        Set the scale by two points
      </button>
    );
  }
  const apply = () => {
    if (points.length === 2) onChange(scaled(underlay, points as [Point, Point], Number(distance)));
    onPoints(null);
  };
  return (
    <>
      <p aria-live="polite">
        {points.length < 2 ? `Click the ${points.length === 0 ? "first" : "second"} point in the plan.` : "How far apart are they?"}
      </p>
      <div class="row">
        <label class="row grow">
          Distance
          <input class="short" inputMode="decimal" value={distance} onInput={(event) => setDistance(event.currentTarget.value)} /> m
        </label>
        <button type="button" class="button small" disabled={points.length < 2 || !(Number(distance) > 0)} onClick={apply}>
          Apply
        </button>
      </div>
    </>
  );
}

interface EditedProps {
  underlay: Underlay;
  onChange: (underlay: Underlay) => void;
}

function Opacity({ underlay, onChange }: EditedProps) {
  return (
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
  );
}

const kExtents = { x: "Left", y: "Top", width: "Width" };

function Extent({ underlay, onChange }: EditedProps) {
  const set = (key: keyof typeof kExtents, value: number) => {
    if (!Number.isFinite(value) || (key === "width" && value <= 0)) return;
    const height = key === "width" ? (underlay.height * value) / underlay.width : underlay.height;
    onChange({ ...underlay, height, [key]: value });
  };
  return (
    <div class="fields">
      {(Object.keys(kExtents) as (keyof typeof kExtents)[]).map((key) => (
        <label key={key} class="field">
          <span class="field-name">
            {kExtents[key]}
            <span class="unit"> m</span>
          </span>
          <input
            inputMode="decimal"
            value={String(Math.round(100 * underlay[key]) / 100)}
            onChange={(event) => set(key, Number(event.currentTarget.value))}
          />
        </label>
      ))}
    </div>
  );
}

export function UnderlayPanel({ underlay, onChange, points, onPoints, widthM }: UnderlayPanelProps) {
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
            <Opacity underlay={underlay} onChange={onChange} />
            <ScaleByPoints {...{ underlay, onChange, points, onPoints }} />
            <Extent underlay={underlay} onChange={onChange} />
            <button type="button" class="button small danger-text" onClick={() => onChange(null)}>
              Remove the image
            </button>
          </>
        )}
      </div>
    </details>
  );
}
