// Controls of an image: layers, colors, and steps to other images.
import { countText } from "../parts/format";
import type { ImageName, Labels } from "./coco";
import { type Coloring, kColorings, kLayers } from "./overlay";

interface ToolsProps {
  layers: Set<string>;
  coloring: Coloring;
  opacity: number;
  onToggle: (layer: string) => void;
  onColoring: (coloring: Coloring) => void;
  onOpacity: (opacity: number) => void;
}

export function Tools({ layers, coloring, opacity, onToggle, onColoring, onOpacity }: ToolsProps) {
  return (
    <div class="row wrap tools" role="group" aria-label="Labels">
      {kLayers.map((layer) => (
        <button
          key={layer.id}
          type="button"
          class="chip"
          aria-pressed={layers.has(layer.id)}
          aria-keyshortcuts={layer.key}
          onClick={() => onToggle(layer.id)}
        >
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
        Opacity
        <input
          type="range"
          min="0.1"
          max="1"
          step="0.1"
          value={opacity}
          onInput={(event) => onOpacity(Number(event.currentTarget.value))}
        />
      </label>
    </div>
  );
}

interface HeadProps {
  image: ImageName;
  labels: Labels | null;
  isPlaying: boolean;
  neighbor: (frames: number, cameras: number) => ImageName | null;
  onGo: (frames: number, cameras: number) => void;
  onPlay: () => void;
  onClose: () => void;
}

export function ViewerHead({ image, labels, isPlaying, neighbor, onGo, onPlay, onClose }: HeadProps) {
  const { counts } = labels?.image ?? {};
  return (
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
        <button
          type="button"
          class="button small"
          aria-label="Previous frame"
          aria-keyshortcuts="ArrowLeft"
          disabled={!neighbor(-1, 0)}
          onClick={() => onGo(-1, 0)}
        >
          ←
        </button>
        <button type="button" class="button small" aria-pressed={isPlaying} aria-keyshortcuts="Space" onClick={onPlay}>
          {isPlaying ? "Pause" : "Play"}
        </button>
        <button
          type="button"
          class="button small"
          aria-label="Next frame"
          aria-keyshortcuts="ArrowRight"
          disabled={!neighbor(1, 0)}
          onClick={() => onGo(1, 0)}
        >
          →
        </button>
        <button
          type="button"
          class="button small"
          aria-label="Previous camera"
          aria-keyshortcuts="ArrowUp"
          disabled={!neighbor(0, -1)}
          onClick={() => onGo(0, -1)}
        >
          ↑
        </button>
        <button
          type="button"
          class="button small"
          aria-label="Next camera"
          aria-keyshortcuts="ArrowDown"
          disabled={!neighbor(0, 1)}
          onClick={() => onGo(0, 1)}
        >
          ↓
        </button>
      </div>
    </div>
  );
}
