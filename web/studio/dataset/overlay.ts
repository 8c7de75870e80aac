// Labels of an image on a canvas over it.

import { cornersOf, type Point2, type Point3, projectionOf } from "./camera";
import type { Annotation, Labels } from "./coco";
import { forEachRun } from "./rle";

export interface Layer {
  id: string;
  key: string; ///< on the keyboard
  label: string;
}

export const kLayers: Layer[] = [
  { id: "boxes", key: "b", label: "Boxes" },
  { id: "amodal", key: "a", label: "Amodal boxes" },
  { id: "masks", key: "m", label: "Masks" },
  { id: "keypoints", key: "k", label: "Keypoints" },
  { id: "ids", key: "i", label: "Ids" },
  { id: "exits", key: "e", label: "Exits" },
  { id: "hidden", key: "h", label: "Hidden" },
  { id: "boxes3d", key: "3", label: "3-D boxes" },
  { id: "density", key: "d", label: "Density" },
  { id: "depth", key: "x", label: "Depth" },
  { id: "flow", key: "f", label: "Flow" },
];

export const kColorings = ["track", "state", "visibility", "contrast"] as const;
export type Coloring = (typeof kColorings)[number];

export interface Drawing {
  layers: ReadonlySet<string>;
  coloring: Coloring;
  opacity: number; ///< of masks and values per pixel
  selected: number | null; ///< a track
}

/** Of categories that are not people's: drones, cars, trains. */
const kObjectColors: Record<number, string> = { 2: "#00e5ff", 3: "#ffe14d", 4: "#ff9a4d" };
const kHues = 47; ///< degrees between neighbors in a list: far apart
const kStateColors: Record<string, string> = {
  waiting: "#6ea8ff",
  walking: "#46c46a",
  running: "#ffb020",
  following: "#c77dff",
  panicking: "#ff5a4f",
  lying: "#b8860b",
  falling: "#e0702c",
  getting_up: "#d9c27a",
  sitting: "#5fb8b0",
  squatting: "#b07ab0",
};
const kExitColors: Record<string, string> = {
  idle: "#c9d1d7",
  flowing: "#5bd184",
  congested: "#ffc24d",
  clogged: "#ff6b60",
  closed: "#9aa3aa",
};
/** Of COCO's 17 keypoints. */
const kLimbs = [
  [15, 13],
  [13, 11],
  [16, 14],
  [14, 12],
  [11, 12],
  [5, 11],
  [6, 12],
  [5, 6],
  [5, 7],
  [6, 8],
  [7, 9],
  [8, 10],
  [1, 2],
  [0, 1],
  [0, 2],
] as const;

/** Red where a person is hard to distinguish from the surroundings, green from a CIELAB difference of 30 on. */
function colorOfContrast({ difficulty }: Annotation): string {
  if (!difficulty) return "#cccccc";
  const contrast = Math.max(difficulty.contrast, difficulty.edge_contrast);
  return `hsl(${Math.round(4 * Math.min(contrast, 30))} 90% 50%)`;
}

export function colorOf(annotation: Annotation, coloring: Coloring): string {
  const object = kObjectColors[annotation.category_id];
  if (object) return object;
  if (coloring === "state") return kStateColors[annotation.state ?? ""] ?? "#cccccc";
  if (coloring === "visibility") return `hsl(${Math.round(120 * annotation.visibility)} 90% 50%)`;
  if (coloring === "contrast") return colorOfContrast(annotation);
  return `hsl(${(annotation.track_id * kHues) % 360} 85% 60%)`;
}

function drawMasks(context: CanvasRenderingContext2D, annotations: Annotation[], drawing: Drawing, scale: number): void {
  context.globalAlpha = drawing.opacity;
  for (const annotation of annotations) {
    context.fillStyle = colorOf(annotation, drawing.coloring);
    // Pixel i covers [i, i + 1).
    forEachRun(annotation.segmentation, (x, y, length) => context.fillRect(x * scale, y * scale, scale, length * scale));
  }
  context.globalAlpha = 1;
}

function drawBox(context: CanvasRenderingContext2D, [x, y, width, height]: readonly number[], scale: number): void {
  context.strokeRect(x! * scale, y! * scale, width! * scale, height! * scale);
}

function drawKeypoints(context: CanvasRenderingContext2D, points: number[], color: string, scale: number, radius: number): void {
  const at = (index: number) => ({ x: points[3 * index]! * scale, y: points[3 * index + 1]! * scale, seen: points[3 * index + 2]! });
  context.strokeStyle = color;
  context.lineWidth = radius * 0.8;
  for (const [from, to] of kLimbs) {
    const [a, b] = [at(from), at(to)];
    if (!a.seen || !b.seen) continue;
    context.beginPath();
    context.moveTo(a.x, a.y);
    context.lineTo(b.x, b.y);
    context.stroke();
  }
  for (let index = 0; index < points.length / 3; ++index) {
    const point = at(index);
    if (!point.seen) continue;
    context.beginPath();
    context.arc(point.x, point.y, radius, 0, 2 * Math.PI);
    context.fillStyle = point.seen === 2 ? "#ffffff" : "#000000";
    context.fill();
  }
}

/** Pairs of the corners of camera.ts: the lower face, the upper one, and the edges between. */
const kBoxEdges = [0, 1, 2, 3].flatMap((corner) => {
  const next = (corner + 1) % 4;
  return [
    [corner, next],
    [corner + 4, next + 4],
    [corner, corner + 4],
  ] as const;
});
const kEdgeParts = 6; // straight edges of the world are bent by lenses

/** Draws the edges of a body's box; the face ahead is crossed. */
function drawBox3d(
  context: CanvasRenderingContext2D,
  { box_3d, heading = 0 }: Annotation,
  project: (point: Point3) => Point2 | null,
  scale: number,
): void {
  if (!box_3d) return;
  const corners = cornersOf(box_3d, heading);
  const line = (from: Point3, to: Point3) => {
    let isDrawn = false;
    for (let part = 0; part <= kEdgeParts; ++part) {
      const pixel = project([0, 1, 2].map((axis) => from[axis]! + ((to[axis]! - from[axis]!) * part) / kEdgeParts) as unknown as Point3);
      if (pixel && isDrawn) context.lineTo(pixel[0] * scale, pixel[1] * scale);
      else if (pixel) context.moveTo(pixel[0] * scale, pixel[1] * scale);
      isDrawn = pixel !== null;
    }
  };
  context.beginPath();
  for (const [from, to] of kBoxEdges) line(corners[from]!, corners[to]!);
  line(corners[0]!, corners[5]!);
  line(corners[1]!, corners[4]!);
  context.stroke();
}

function drawPolygon(context: CanvasRenderingContext2D, corners: [number, number][], scale: number): void {
  if (corners.length < 2) return;
  context.beginPath();
  corners.forEach(([x, y], index) => (index ? context.lineTo(x * scale, y * scale) : context.moveTo(x * scale, y * scale)));
  context.closePath();
  context.stroke();
}

function drawText(context: CanvasRenderingContext2D, text: string, x: number, y: number, color: string): void {
  context.lineWidth = 3;
  context.strokeStyle = "rgb(0 0 0 / 80%)";
  context.strokeText(text, x, y);
  context.fillStyle = color;
  context.fillText(text, x, y);
}

function drawExits(context: CanvasRenderingContext2D, labels: Labels, scale: number): void {
  for (const exit of labels.image.exits ?? []) {
    const color = kExitColors[exit.state] ?? "#ffffff";
    context.strokeStyle = color;
    context.lineWidth = 2;
    drawPolygon(context, exit.zone, scale);
    context.strokeStyle = "#ffffff";
    drawPolygon(context, exit.door, scale);
    const first = exit.door[0] ?? exit.zone[0];
    const queue = exit.queue ? `, ${exit.queue} wait` : "";
    if (first) drawText(context, `${exit.id}: ${exit.state}${queue}`, first[0] * scale, first[1] * scale - 4, color);
  }
}

/** Draws values per pixel over the whole canvas; pixels stay squares. */
export function drawRasters(context: CanvasRenderingContext2D, images: CanvasImageSource[], opacity: number): void {
  const { canvas } = context;
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingEnabled = false;
  context.globalAlpha = opacity;
  for (const image of images) context.drawImage(image, 0, 0, canvas.width, canvas.height);
  context.globalAlpha = 1;
}

/** Draws the labels; `scale` are pixels of the canvas per pixel of the image. */
export function drawLabels(context: CanvasRenderingContext2D, labels: Labels, drawing: Drawing, scale: number): void {
  const has = (layer: string) => drawing.layers.has(layer);
  const line = Math.max(1.2, Math.min(2, scale));
  context.font = `600 ${Math.max(11, Math.round(5 * scale + 6))}px system-ui, sans-serif`;
  if (has("exits")) drawExits(context, labels, scale);
  if (has("masks")) drawMasks(context, labels.annotations, drawing, scale);
  if (has("hidden")) {
    context.strokeStyle = "#ffffff";
    context.lineWidth = line;
    context.setLineDash([2, 3]);
    for (const person of labels.image.hidden ?? []) drawBox(context, person.bbox_amodal, scale);
    context.setLineDash([]);
  }
  const project = has("boxes3d") && labels.image.camera ? projectionOf(labels.image.camera) : null;
  for (const annotation of labels.annotations) {
    const isSelected = annotation.track_id === drawing.selected;
    const color = isSelected ? "#ffffff" : colorOf(annotation, drawing.coloring);
    context.strokeStyle = color;
    context.lineWidth = isSelected ? 2.5 * line : line;
    if (has("boxes") || isSelected) drawBox(context, annotation.bbox, scale);
    if (has("amodal")) {
      context.setLineDash([5, 3]);
      drawBox(context, annotation.bbox_amodal, scale);
      context.setLineDash([]);
    }
    if (project) drawBox3d(context, annotation, project, scale);
    if (has("keypoints") && annotation.keypoints) drawKeypoints(context, annotation.keypoints, color, scale, Math.max(1.1, 0.8 * scale));
    if (has("ids")) drawText(context, String(annotation.track_id), annotation.bbox[0] * scale, annotation.bbox[1] * scale - 3, color);
  }
}

/** The smallest box at a point of the image. */
export function annotationAt(annotations: Annotation[], x: number, y: number): Annotation | null {
  const kSlack = 2;
  const hits = annotations.filter(
    ({ bbox: [left, top, width, height] }) =>
      x >= left - kSlack && x <= left + width + kSlack && y >= top - kSlack && y <= top + height + kSlack,
  );
  return hits.sort((a, b) => a.bbox[2] * a.bbox[3] - b.bbox[2] * b.bbox[3])[0] ?? null;
}
