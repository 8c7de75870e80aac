// A dataset and the labels of its images, fetched and drawn.
import type { TargetedPointerEvent } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, messageOf } from "../api/client";
import { useSession } from "../api/session";
import { type Annotation, Dataset, type ImageName, type Labels } from "./coco";
import { annotationAt, type Drawing, drawLabels } from "./overlay";

export function useDataset(id: string) {
  const [dataset, setDataset] = useState<Dataset | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const { round } = useSession();
  useEffect(() => {
    setError(null);
    Dataset.open(id).then(setDataset, (reason: unknown) => setError(reason instanceof ApiError ? reason : new ApiError(0, messageOf(reason))));
  }, [id, round]);
  return { dataset, error };
}

/** Labels of an image; null until they are there. */
export function useLabels(dataset: Dataset, image: ImageName) {
  const [state, setState] = useState<{ path: string; labels: Labels | null; error: string | null }>({ path: "", labels: null, error: null });
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

export interface LabelCanvasProps {
  labels: Labels | null;
  drawing: Drawing;
  onHover?: (found: Annotation | null) => void;
  onClick?: () => void;
}

/** A canvas over an image, of the size in which that is shown. */
export function LabelCanvas({ labels, drawing, onHover, onClick }: LabelCanvasProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [width, setWidth] = useState(0);
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => setWidth(Math.round(entry!.contentRect.width * devicePixelRatio)));
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    const context = canvas.current!.getContext("2d")!;
    const { image } = labels ?? {};
    canvas.current!.width = width;
    canvas.current!.height = image ? Math.round((width * image.height) / image.width) : 1;
    if (labels && image && width > 0) drawLabels(context, labels, drawing, width / image.width);
    canvas.current!.dataset["drawn"] = labels ? `${labels.image.id} ${[...drawing.layers].join(",")}` : "";
  }, [labels, drawing, width]);
  const onMove = (event: TargetedPointerEvent<HTMLCanvasElement>) => {
    if (!labels || !onHover) return;
    const box = event.currentTarget.getBoundingClientRect();
    const scale = labels.image.width / box.width;
    onHover(annotationAt(labels.annotations, (event.clientX - box.left) * scale, (event.clientY - box.top) * scale));
  };
  return <canvas ref={canvas} class="overlay" onPointerMove={onMove} onPointerDown={onMove} onPointerLeave={() => onHover?.(null)} onClick={onClick} />;
}
