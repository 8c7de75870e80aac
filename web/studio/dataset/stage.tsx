// A dataset and the labels of its images, fetched and drawn.
import type { TargetedPointerEvent } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { type ApiError, asApiError, messageOf } from "../api/client";
import { useSession } from "../api/session";
import { type Annotation, Dataset, type ImageName, type Labels } from "./coco";
import { annotationAt, type Drawing, drawLabels, drawRasters } from "./overlay";
import type { DrawnRaster } from "./rasters";

export function useDataset(id: string) {
  const [dataset, setDataset] = useState<Dataset | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const { round } = useSession();
  useEffect(() => {
    setError(null);
    Dataset.open(id).then(setDataset, (reason: unknown) => setError(asApiError(reason)));
  }, [id, round]);
  return { dataset, error };
}

/** Labels of an image; null until they are there. */
export function useLabels(dataset: Dataset, image: ImageName) {
  const [state, setState] = useState<{ path: string; labels: Labels | null; error: string | null }>({
    path: "",
    labels: null,
    error: null,
  });
  useEffect(() => {
    if (!dataset.hasLabels) return;
    let isCurrent = true;
    dataset.labelsOf(image).then(
      (labels) => isCurrent && setState({ path: image.path, labels, error: null }),
      (error: unknown) => isCurrent && setState({ path: image.path, labels: null, error: messageOf(error) }),
    );
    return () => void (isCurrent = false);
  }, [dataset, image.path]);
  return state.path === image.path ? state : { path: image.path, labels: null, error: null };
}

const kNoRasters: DrawnRaster[] = [];

export interface LabelCanvasProps {
  labels: Labels | null;
  drawing: Drawing;
  rasters?: DrawnRaster[];
  onHover?: (found: Annotation | null) => void;
  /** The pointer's place in pixels of the image; null: it has left. */
  onPoint?: (place: [x: number, y: number] | null) => void;
  onClick?: () => void;
}

/** A canvas over an image, of the size in which that is shown. */
export function LabelCanvas({ labels, drawing, rasters = kNoRasters, onHover, onPoint, onClick }: LabelCanvasProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [width, setWidth] = useState(0);
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => setWidth(Math.round(entry!.contentRect.width * devicePixelRatio)));
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    const context = canvas.current!.getContext("2d")!;
    const image = labels?.image ?? rasters[0]?.raster;
    canvas.current!.width = width;
    canvas.current!.height = image ? Math.round((width * image.height) / image.width) : 1;
    drawRasters(
      context,
      rasters.map((entry) => entry.image),
      drawing.opacity,
    );
    if (labels && width > 0) drawLabels(context, labels, drawing, width / labels.image.width);
    canvas.current!.dataset["drawn"] = labels ? `${labels.image.id} ${[...drawing.layers].join(",")}` : "";
    canvas.current!.dataset["rasters"] = rasters.map((entry) => entry.raster.kind).join();
  }, [labels, drawing, rasters, width]);
  const onMove = (event: TargetedPointerEvent<HTMLCanvasElement>) => {
    const width = labels?.image.width ?? rasters[0]?.raster.width;
    if (width === undefined) return;
    const box = event.currentTarget.getBoundingClientRect();
    const scale = width / box.width;
    const [x, y] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    onPoint?.([x, y]);
    if (labels) onHover?.(annotationAt(labels.annotations, x, y));
  };
  const onLeave = () => {
    onHover?.(null);
    onPoint?.(null);
  };
  return <canvas ref={canvas} class="overlay" onPointerMove={onMove} onPointerDown={onMove} onPointerLeave={onLeave} onClick={onClick} />;
}
