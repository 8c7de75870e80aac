// Images of two jobs or runs by the same camera at the same time, one above the other; a slider moves the edge between them.
import { useState } from "preact/hooks";
import { useSource } from "../api/resource";
import type { Job } from "../api/types";
import { Swatch } from "../charts/share_curves";
import type { Dataset, ImageName } from "../dataset/coco";
import { useDataset } from "../dataset/stage";
import { captureOf, frameAt, timeOf } from "../run/capture";
import { DensityMap, useDensities } from "./density";
import { runName, type Subject } from "./subjects";

interface SwipeProps {
  subjects: [Subject, Subject];
  indices: [number, number]; ///< among those that are compared, which have their colors
  time_s: number;
}

function nearestImage(dataset: Dataset, job: Job, run: string, camera: string, time_s: number): ImageName | null {
  const known = dataset.camerasOf(run).find((entry) => entry.camera === camera);
  if (!known) return null;
  const frame = Math.min(known.last, Math.max(known.first, frameAt(captureOf(job), time_s)));
  return dataset.imageAt(run, camera, frame);
}

interface Pair {
  runs: [string, string];
  camera: string;
}

/** Cameras of the same name, in the chosen runs, or in runs of the same name. */
function commonCameras(datasets: [Dataset, Dataset], subjects: [Subject, Subject]): Pair[] {
  const nameOf = ({ run }: Subject) => (run === null ? null : runName(run));
  const [left, right] = [nameOf(subjects[0]), nameOf(subjects[1])];
  const first = datasets[0].runs.filter(({ run }) => left === null || run === left);
  // A single run is held against any run of a job.
  const second = (run: string) => (right !== null ? [right] : left !== null ? datasets[1].runs.map((entry) => entry.run) : [run]);
  return first.flatMap(({ run, cameras }) =>
    second(run).flatMap((other) =>
      cameras
        .filter(({ camera }) => datasets[1].camerasOf(other).some((entry) => entry.camera === camera))
        .map(({ camera }): Pair => ({ runs: [run, other], camera })),
    ),
  );
}

interface ImagesProps extends SwipeProps {
  datasets: [Dataset, Dataset];
}

function Images({ subjects, indices, datasets, time_s }: ImagesProps) {
  const [choice, setChoice] = useState(0);
  const [edge, setEdge] = useState(50);
  const cameras = commonCameras(datasets, subjects);
  const chosen = cameras[Math.min(choice, cameras.length - 1)];
  const images = datasets.map(
    (dataset, side) => chosen && nearestImage(dataset, subjects[side]!.job, chosen.runs[side]!, chosen.camera, time_s),
  );
  const [left, right] = images;
  const sources = [useSource(left ? datasets[0].address(left) : null), useSource(right ? datasets[1].address(right) : null)];
  const [hasDensity, setDensity] = useState(false);
  const sides = [left, right].map((image, side) => (image ? { dataset: datasets[side]!, image } : null));
  const densities = useDensities(sides[0] ?? null, sides[1] ?? null, hasDensity);
  const maps = typeof densities === "object" ? densities : null;
  if (!chosen || !left || !right) return <p class="quiet-text">These two have no run and camera of the same name.</p>;
  const caption = (side: 0 | 1, image: ImageName) => (
    <span>
      <Swatch index={indices[side]} /> {subjects[side].name}, {timeOf(captureOf(subjects[side].job), image.frame).toFixed(1)} s
    </span>
  );
  return (
    <>
      <label class="row">
        Run and camera
        <select value={String(choice)} onChange={(event) => setChoice(Number(event.currentTarget.value))}>
          {cameras.map(({ runs: [run, other], camera }, index) => (
            <option key={`${run} ${other} ${camera}`} value={String(index)}>
              {run === other ? run : `${run} and ${other}`}, {camera}
            </option>
          ))}
        </select>
      </label>
      <label class="row">
        <input type="checkbox" checked={hasDensity} onChange={(event) => setDensity(event.currentTarget.checked)} />
        Density
      </label>
      {typeof densities === "string" && (
        <p class="notice warn" role="status">
          {densities}
        </p>
      )}
      {maps && (
        <p class="quiet-text">
          Both maps have the same colors, up to {maps.scale.max.toPrecision(2)} people per pixel. People in the images:{" "}
          {maps.people[0].toFixed(1)} and {maps.people[1].toFixed(1)}.
        </p>
      )}
      <figure>
        <div class="stage swipe">
          {sources[0] && <img src={sources[0]} alt={`${subjects[0].name}: ${left.path}`} />}
          {sources[1] && (
            <img class="upper" src={sources[1]} alt={`${subjects[1].name}: ${right.path}`} style={{ clipPath: `inset(0 0 0 ${edge}%)` }} />
          )}
          {maps && (
            <DensityMap
              raster={maps.rasters[0]}
              scale={maps.scale}
              label={`density of ${subjects[0].name}`}
              clip={`inset(0 ${100 - edge}% 0 0)`}
            />
          )}
          {maps && (
            <DensityMap
              raster={maps.rasters[1]}
              scale={maps.scale}
              label={`density of ${subjects[1].name}`}
              clip={`inset(0 0 0 ${edge}%)`}
            />
          )}
          <div class="edge" style={{ left: `${edge}%` }} />
        </div>
        <figcaption class="row swipe-caption">
          {caption(0, left)}
          <input
            type="range"
            aria-label="Edge between the images"
            aria-valuetext={`${edge} %`}
            min="0"
            max="100"
            value={edge}
            onInput={(event) => setEdge(Number(event.currentTarget.value))}
          />
          {caption(1, right)}
        </figcaption>
      </figure>
    </>
  );
}

export function Swipe(props: SwipeProps) {
  const first = useDataset(props.subjects[0].id);
  const second = useDataset(props.subjects[1].id);
  if (first.error ?? second.error) return <p class="field-error">{(first.error ?? second.error)!.message}</p>;
  if (!first.dataset || !second.dataset) return <p class="loading">Loading …</p>;
  return <Images {...props} datasets={[first.dataset, second.dataset]} />;
}
