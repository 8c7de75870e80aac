// One image with its labels; everything has a key.
import { useEffect, useRef, useState } from "preact/hooks";
import { useInterval, useSource } from "../api/resource";
import { countText } from "../parts/format";
import type { Annotation, Dataset, ImageName } from "./coco";
import { type Coloring, type Drawing, kColorings, kLayers } from "./overlay";
import { PersonRecord } from "./person";
import { LabelCanvas, useLabels } from "./stage";

export interface ViewerProps {
  dataset: Dataset;
  image: ImageName;
  onSelect: (image: ImageName) => void;
  onClose: () => void;
}

const kStorage = "throng.layers";
const kPlayMs = 500;

function storedLayers(): Set<string> {
  const stored = localStorage.getItem(kStorage);
  return new Set(stored === null ? ["boxes", "masks"] : stored.split(",").filter(Boolean));
}

interface ToolsProps {
  layers: Set<string>;
  coloring: Coloring;
  opacity: number;
  onToggle: (layer: string) => void;
  onColoring: (coloring: Coloring) => void;
  onOpacity: (opacity: number) => void;
}

function Tools({ layers, coloring, opacity, onToggle, onColoring, onOpacity }: ToolsProps) {
  return (
    <div class="row wrap tools" role="group" aria-label="Labels">
      {kLayers.map((layer) => (
        <button key={layer.id} type="button" class="chip" aria-pressed={layers.has(layer.id)} aria-keyshortcuts={layer.key} onClick={() => onToggle(layer.id)}>
          {layer.label} <kbd>{layer.key.toUpperCase()}</kbd>
        </button>
      ))}
      <label class="row">
        Color by
        <select value={coloring} onChange={(event) => onColoring(event.currentTarget.value as Coloring)}>
          {kColorings.map((name) => (
            <option key={name}>{name}</option>
          ))}
        </select>
      </label>
      <label class="row">
        Mask opacity
        <input type="range" min="0.1" max="1" step="0.1" value={opacity} onInput={(event) => onOpacity(Number(event.currentTarget.value))} />
      </label>
    </div>
  );
}

export function Viewer({ dataset, image, onSelect, onClose }: ViewerProps) {
  const neighbor = (frames: number, cameras: number) => dataset.neighbor(image, frames, cameras);
  const source = useSource(dataset.address(image));
  const { labels, error } = useLabels(dataset, image);
  const [layers, setLayers] = useState(storedLayers);
  const [coloring, setColoring] = useState<Coloring>("track");
  const [opacity, setOpacity] = useState(0.5);
  const [hovered, setHovered] = useState<Annotation | null>(null);
  const [selected, setSelected] = useState<number | null>(null);
  const [isPlaying, setPlaying] = useState(false);
  const toggle = (layer: string) => {
    const next = new Set(layers);
    if (!next.delete(layer)) next.add(layer);
    localStorage.setItem(kStorage, [...next].join(","));
    setLayers(next);
  };
  const go = (frames: number, cameras: number) => {
    const next = neighbor(frames, cameras);
    if (next) onSelect(next);
    return next !== null;
  };
  useInterval(() => go(1, 0) || setPlaying(false), isPlaying ? kPlayMs : 0);
  const onKey = useRef<(event: KeyboardEvent) => void>(() => {});
  onKey.current = (event) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || (target instanceof Element && target.matches("input, select, textarea"))) return;
    const layer = kLayers.find((entry) => entry.key === event.key.toLowerCase());
    const steps: Record<string, [number, number]> = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] };
    const step = steps[event.key];
    if (layer) toggle(layer.id);
    else if (step) go(...step);
    else if (event.key === "Escape") onClose();
    else if (event.key === " " && !(target instanceof HTMLButtonElement)) setPlaying(!isPlaying);
    else return;
    event.preventDefault();
  };
  useEffect(() => {
    const listener = (event: KeyboardEvent) => onKey.current(event);
    addEventListener("keydown", listener);
    return () => removeEventListener("keydown", listener);
  }, []);
  const shown = hovered ?? labels?.annotations.find((entry) => entry.track_id === selected) ?? null;
  const drawing: Drawing = { layers, coloring, opacity, selected: shown?.track_id ?? selected };
  const { counts } = labels?.image ?? {};
  return (
    <div class="viewer">
      <div class="row wrap viewer-head">
        <button type="button" class="button small" onClick={onClose}>
          ← All images
        </button>
        <strong class="viewer-name">
          {image.run} · {image.camera} · {String(image.frame).padStart(6, "0")}
        </strong>
        <span class="quiet-text grow">
          {labels && `${labels.image.time_s} s`}
          {counts && ` · ${countText(counts.visible, "person", "people")} visible of ${counts.all}`}
        </span>
        <div class="actions">
          <button type="button" class="button small" aria-label="Previous frame" aria-keyshortcuts="ArrowLeft" disabled={!neighbor(-1, 0)} onClick={() => go(-1, 0)}>
            ←
          </button>
          <button type="button" class="button small" aria-pressed={isPlaying} aria-keyshortcuts="Space" onClick={() => setPlaying(!isPlaying)}>
            {isPlaying ? "Pause" : "Play"}
          </button>
          <button type="button" class="button small" aria-label="Next frame" aria-keyshortcuts="ArrowRight" disabled={!neighbor(1, 0)} onClick={() => go(1, 0)}>
            →
          </button>
          <button type="button" class="button small" aria-label="Previous camera" aria-keyshortcuts="ArrowUp" disabled={!neighbor(0, -1)} onClick={() => go(0, -1)}>
            ↑
          </button>
          <button type="button" class="button small" aria-label="Next camera" aria-keyshortcuts="ArrowDown" disabled={!neighbor(0, 1)} onClick={() => go(0, 1)}>
            ↓
          </button>
        </div>
      </div>
      {dataset.hasLabels ? (
        <Tools {...{ layers, coloring, opacity }} onToggle={toggle} onColoring={setColoring} onOpacity={setOpacity} />
      ) : (
        <p class="notice warn">This dataset has no COCO annotations, so there are no labels to show.</p>
      )}
      {error && (
        <p class="notice bad" role="alert">
          {error}
        </p>
      )}
      <div class="viewer-body">
        <div class={`stage ${shown ? "pointing" : ""}`}>
          {source && <img src={source} alt={`${image.run}, camera ${image.camera}, frame ${image.frame}`} />}
          <LabelCanvas labels={labels} drawing={drawing} onHover={setHovered} onClick={() => setSelected(hovered?.track_id ?? null)} />
        </div>
        <aside aria-label="Person" class="card person">
          {shown ? (
            <PersonRecord dataset={dataset} annotation={shown} />
          ) : (
            <p class="quiet-text">Point at a person to see their record; click to follow them over frames and cameras.</p>
          )}
        </aside>
      </div>
    </div>
  );
}
