// Rasters of an image, fetched as they are switched on, and drawn as one image each.
import { useEffect, useMemo, useState } from "preact/hooks";
import { ApiError, messageOf } from "../api/client";
import type { Dataset, ImageName } from "./coco";
import { fetchRaster, type Raster, type RasterKind } from "./raster";
import { pixelsOf, scaleOf, scaleText } from "./raster_colors";

export interface DrawnRaster {
  raster: Raster;
  image: HTMLCanvasElement; ///< of the raster's size
  legend: string;
}

export const kRasterKinds: RasterKind[] = ["density", "depth", "flow"];

function drawn(raster: Raster): DrawnRaster {
  const image = document.createElement("canvas");
  image.width = raster.width;
  image.height = raster.height;
  const scale = scaleOf(raster);
  image.getContext("2d")!.putImageData(new ImageData(pixelsOf(raster, scale), raster.width, raster.height), 0, 0);
  return { raster, image, legend: scaleText(raster, scale) };
}

/** Why a raster is not there. */
function reasonOf(kind: RasterKind, error: unknown): string {
  if (error instanceof ApiError && error.status === 404)
    return `The dataset has no ${kind}: its job did not ask for it in outputs.annotations.`;
  return `${kind}: ${messageOf(error)}`;
}

export interface Rasters {
  list: DrawnRaster[]; ///< that are there
  problems: string[];
}

function useRaster(dataset: Dataset, image: ImageName, kind: RasterKind, isWanted: boolean): DrawnRaster | string | null {
  const [state, setState] = useState<{ path: string; value: DrawnRaster | string } | null>(null);
  useEffect(() => {
    if (!isWanted) return;
    let isCurrent = true;
    const settle = (value: DrawnRaster | string) => isCurrent && setState({ path: image.path, value });
    fetchRaster(dataset.job, image, kind)
      .then(drawn)
      .then(settle, (error: unknown) => settle(reasonOf(kind, error)));
    return () => void (isCurrent = false);
  }, [dataset, image.path, isWanted]);
  return isWanted && state?.path === image.path ? state.value : null;
}

/** The rasters of those layers that are rasters; earlier ones are drawn first. */
export function useRasters(dataset: Dataset, image: ImageName, layers: ReadonlySet<string>): Rasters {
  const values = kRasterKinds.map((kind) => useRaster(dataset, image, kind, layers.has(kind)));
  return useMemo(
    () => ({
      list: values.filter((value): value is DrawnRaster => value !== null && typeof value === "object"),
      problems: values.filter((value): value is string => typeof value === "string"),
    }),
    values,
  );
}
