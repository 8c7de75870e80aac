// One image with its labels; everything has a key.
import { useState } from "preact/hooks";
import { useInterval, useSource } from "../api/resource";
import { useKeys } from "../parts/keys";
import type { Annotation, Dataset, ImageName } from "./coco";
import { Follow, sightingsAt } from "./follow";
import { type Coloring, type Drawing, kLayers } from "./overlay";
import { PersonRecord } from "./person";
import { valueText } from "./raster";
import { useRasters } from "./rasters";
import { LabelCanvas, useLabels } from "./stage";
import { Tools, ViewerHead } from "./tools";

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

/** The layers that are drawn, kept in this browser. */
function useLayers() {
  const [layers, setLayers] = useState(storedLayers);
  const toggle = (layer: string) => {
    const next = new Set(layers);
    if (!next.delete(layer)) next.add(layer);
    localStorage.setItem(kStorage, [...next].join(","));
    setLayers(next);
  };
  return { layers, toggle };
}

/** Moves over frames and cameras, once or playing. Follows the selected person to another camera that sees them. */
function useMoves({ dataset, image, onSelect }: Pick<ViewerProps, "dataset" | "image" | "onSelect">, selected: number | null) {
  const [isPlaying, setPlaying] = useState(false);
  const neighbor = (frames: number, cameras: number) => dataset.neighbor(image, frames, cameras);
  const go = (frames: number, cameras: number) => {
    const next = neighbor(frames, cameras);
    if (next) onSelect(next);
    if (next && frames !== 0 && selected !== null && dataset.hasLabels) {
      void sightingsAt(dataset, next, selected).then(
        (found) => {
          const seen = found.filter((sighting) => sighting.annotation);
          if (seen.length > 0 && seen.every((sighting) => sighting.image.camera !== next.camera)) onSelect(seen[0]!.image);
        },
        () => {},
      );
    }
    return next !== null;
  };
  useInterval(() => go(1, 0) || setPlaying(false), isPlaying ? kPlayMs : 0);
  return { neighbor, go, isPlaying, play: () => setPlaying(!isPlaying) };
}

const kSteps: Record<string, [number, number]> = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] };

function useViewerKeys(moves: ReturnType<typeof useMoves>, toggle: (layer: string) => void, onClose: () => void) {
  useKeys((event) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || (target instanceof Element && target.matches("input, select, textarea"))) return;
    const layer = kLayers.find((entry) => entry.key === event.key.toLowerCase());
    const step = kSteps[event.key];
    if (layer) toggle(layer.id);
    else if (step) moves.go(...step);
    else if (event.key === "Escape") onClose();
    else if (event.key === " " && !(target instanceof HTMLButtonElement)) moves.play();
    else return;
    event.preventDefault();
  });
}

/** Problems of labels and rasters, and the legends of rasters. */
function Notes({ error, rasters }: { error: string | null; rasters: ReturnType<typeof useRasters> }) {
  return (
    <>
      {error && (
        <p class="notice bad" role="alert">
          {error}
        </p>
      )}
      {rasters.problems.map((problem) => (
        <p key={problem} class="notice warn" role="status">
          {problem}
        </p>
      ))}
      {rasters.list.map(({ raster, legend }) => (
        <p key={raster.kind} class="quiet-text">
          {legend}
        </p>
      ))}
    </>
  );
}

export function Viewer({ dataset, image, onSelect, onClose }: ViewerProps) {
  const source = useSource(dataset.address(image));
  const { labels, error } = useLabels(dataset, image);
  const { layers, toggle } = useLayers();
  const [coloring, setColoring] = useState<Coloring>("track");
  const [opacity, setOpacity] = useState(0.5);
  const [hovered, setHovered] = useState<Annotation | null>(null);
  const [selected, setSelected] = useState<number | null>(null);
  const [point, setPoint] = useState<[number, number] | null>(null);
  const rasters = useRasters(dataset, image, layers);
  const moves = useMoves({ dataset, image, onSelect }, selected);
  useViewerKeys(moves, toggle, onClose);
  const shown = hovered ?? labels?.annotations.find((entry) => entry.track_id === selected) ?? null;
  const drawing: Drawing = { layers, coloring, opacity, selected: shown?.track_id ?? selected };
  const values = point === null ? [] : rasters.list.map(({ raster }) => valueText(raster, ...point)).filter((text) => text !== null);
  return (
    <div class="viewer">
      <ViewerHead
        {...{ image, labels, onClose }}
        isPlaying={moves.isPlaying}
        neighbor={moves.neighbor}
        onGo={moves.go}
        onPlay={moves.play}
      />
      {dataset.hasLabels ? (
        <Tools {...{ layers, coloring, opacity }} onToggle={toggle} onColoring={setColoring} onOpacity={setOpacity} />
      ) : (
        <p class="notice warn">This dataset has no COCO annotations, so there are no labels to show.</p>
      )}
      <Notes error={error} rasters={rasters} />
      <div class="viewer-body">
        <div class={`stage ${shown ? "pointing" : ""}`}>
          {source && <img src={source} alt={`${image.run}, camera ${image.camera}, frame ${image.frame}`} />}
          <LabelCanvas
            {...{ labels, drawing }}
            rasters={rasters.list}
            onHover={setHovered}
            onPoint={setPoint}
            onClick={() => setSelected(hovered?.track_id ?? null)}
          />
        </div>
        <aside aria-label="Person" class="card person">
          {values.length > 0 && <p class="pixel-values">{values.join(" · ")}</p>}
          {selected !== null && <Follow {...{ dataset, image, onSelect }} track={selected} onEnd={() => setSelected(null)} />}
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
