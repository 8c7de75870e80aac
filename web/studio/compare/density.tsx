// Density maps of two images in the same colors, over the images.
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, messageOf } from "../api/client";
import type { Dataset, ImageName } from "../dataset/coco";
import { fetchRaster, type Raster } from "../dataset/raster";
import { pixelsOf, type Scale, scaleOf } from "../dataset/raster_colors";

export interface Densities {
  rasters: [Raster, Raster];
  scale: Scale; ///< of both
  people: [number, number]; ///< integrals of the maps
}

type Side = { dataset: Dataset; image: ImageName };

async function densitiesOf(sides: [Side, Side]): Promise<Densities> {
  const [left, right] = await Promise.all(sides.map(({ dataset, image }) => fetchRaster(dataset.job, image, "density")));
  const scale = { min: 0, max: Math.max(scaleOf(left!).max, scaleOf(right!).max) };
  const sum = ({ values }: Raster) => values.reduce((total, value) => total + value, 0);
  return { rasters: [left!, right!], scale, people: [sum(left!), sum(right!)] };
}

/** Both maps, or why there are none; null while they are fetched. */
export function useDensities(left: Side | null, right: Side | null, isWanted: boolean): Densities | string | null {
  const [state, setState] = useState<{ key: string; value: Densities | string } | null>(null);
  const key = `${left?.dataset.job} ${left?.image.path} ${right?.dataset.job} ${right?.image.path}`;
  useEffect(() => {
    if (!isWanted || !left || !right) return;
    let isCurrent = true;
    const settle = (value: Densities | string) => isCurrent && setState({ key, value });
    densitiesOf([left, right]).then(settle, (error: unknown) =>
      settle(
        error instanceof ApiError && error.status === 404
          ? "One of the datasets has no density maps: its job did not ask for density in outputs.annotations."
          : messageOf(error),
      ),
    );
    return () => void (isCurrent = false);
  }, [key, isWanted]);
  return isWanted && state?.key === key ? state.value : null;
}

interface MapProps {
  raster: Raster;
  scale: Scale;
  label: string;
  clip: string; ///< CSS clip-path
}

export function DensityMap({ raster, scale, label, clip }: MapProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const { width, height } = raster;
    Object.assign(canvas.current!, { width, height });
    canvas.current!.getContext("2d")!.putImageData(new ImageData(pixelsOf(raster, scale), width, height), 0, 0);
  }, [raster, scale]);
  return <canvas ref={canvas} class="overlay density" role="img" aria-label={label} style={{ clipPath: clip }} />;
}
