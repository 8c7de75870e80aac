// A followed person: which cameras see them at this time, and the next frame with them.
import { useEffect, useState } from "preact/hooks";
import type { Annotation, Dataset, ImageName } from "./coco";

const kMaxSearched = 60; // frames that are looked through in one step

export interface Sighting {
  image: ImageName;
  annotation: Annotation | null; ///< null: this camera does not see them
}

async function sightingIn(dataset: Dataset, image: ImageName, track: number): Promise<Sighting> {
  const { annotations } = await dataset.labelsOf(image);
  return { image, annotation: annotations.find((entry) => entry.track_id === track) ?? null };
}

/** A person in all cameras at the time of an image. */
export async function sightingsAt(dataset: Dataset, { run, frame }: ImageName, track: number): Promise<Sighting[]> {
  const images = dataset.camerasOf(run).map(({ camera }) => dataset.imageAt(run, camera, frame));
  return Promise.all(images.filter((image): image is ImageName => image !== null).map((image) => sightingIn(dataset, image, track)));
}

/** The nearest image before (step -1) or after (1) that shows them; the camera stays where it can. */
export async function nextSighting(dataset: Dataset, from: ImageName, track: number, step: 1 | -1): Promise<ImageName | null> {
  let at = from;
  for (let count = 0; count < kMaxSearched; ++count) {
    const next = dataset.neighbor(at, step, 0);
    if (!next) return null;
    const seen = (await sightingsAt(dataset, next, track)).filter((sighting) => sighting.annotation);
    const best = seen.find((sighting) => sighting.image.camera === from.camera) ?? seen[0];
    if (best) return best.image;
    at = next;
  }
  return null;
}

interface FollowProps {
  dataset: Dataset;
  image: ImageName;
  track: number;
  onSelect: (image: ImageName) => void;
  onEnd: () => void;
}

export function Follow({ dataset, image, track, onSelect, onEnd }: FollowProps) {
  const [sightings, setSightings] = useState<Sighting[]>([]);
  const [note, setNote] = useState("");
  useEffect(() => {
    let isCurrent = true;
    setNote("");
    sightingsAt(dataset, image, track).then(
      (found) => isCurrent && setSightings(found),
      () => isCurrent && setSightings([]),
    );
    return () => void (isCurrent = false);
  }, [dataset, image.run, image.frame, track]);
  const search = async (step: 1 | -1) => {
    const found = await nextSighting(dataset, image, track, step).catch(() => null);
    if (found) onSelect(found);
    else setNote(`No camera sees them in the ${kMaxSearched} frames ${step > 0 ? "after" : "before"} this one.`);
  };
  return (
    <section aria-label="Followed person" class="follow">
      <p>
        Following track <strong>{track}</strong>
      </p>
      <ul class="plain-list">
        {sightings.map(({ image: place, annotation }) => (
          <li key={place.camera} class="row">
            <button type="button" class="chip" aria-pressed={place.camera === image.camera} onClick={() => onSelect(place)}>
              {place.camera}
            </button>
            <span class="quiet-text">{annotation ? `${Math.round(100 * annotation.visibility)} % visible` : "not seen"}</span>
          </li>
        ))}
      </ul>
      <div class="actions">
        <button type="button" class="button small" onClick={() => void search(-1)}>
          ← Seen before
        </button>
        <button type="button" class="button small" onClick={() => void search(1)}>
          Seen next →
        </button>
        <button type="button" class="button small" onClick={onEnd}>
          Stop
        </button>
      </div>
      <p class="quiet-text" role="status">
        {note}
      </p>
    </section>
  );
}
