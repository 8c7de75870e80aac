// Histograms of a dataset's images; each bar is a filter.
import { useEffect, useMemo, useState } from "preact/hooks";
import { servicePath } from "../api/base";
import { type ApiError, asApiError } from "../api/client";
import { useSession } from "../api/session";
import { Progress } from "../parts/elements";
import { navigate } from "../parts/router";
import { type Choice, type Facet, histogramOf } from "./facets";
import { type ImageIndex, readIndex } from "./image_index";

const kPercent = 100;

export interface IndexState {
  index: ImageIndex | null;
  share: number; ///< read so far
  error: ApiError | null;
}

/** Reads the index once it is wanted. */
export function useIndex(job: string, isWanted: boolean): IndexState {
  const [state, setState] = useState<IndexState>({ index: null, share: 0, error: null });
  const { round } = useSession();
  useEffect(() => {
    if (!isWanted) return;
    const controller = new AbortController();
    const onShare = (share: number) =>
      setState((last) => (Math.floor(kPercent * share) === Math.floor(kPercent * last.share) ? last : { ...last, share }));
    readIndex(job, controller.signal, onShare).then(
      (index) => setState({ index, share: 1, error: null }),
      (reason: unknown) => controller.signal.aborted || setState({ index: null, share: 0, error: asApiError(reason) }),
    );
    return () => controller.abort();
  }, [job, isWanted, round]);
  return state;
}

function Histogram({
  facet,
  counts,
  chosen,
  onToggle,
}: {
  facet: Facet;
  counts: number[];
  chosen: ReadonlySet<number>;
  onToggle: (bin: number) => void;
}) {
  const most = Math.max(1, ...counts);
  return (
    <div role="group" aria-label={facet.label} class="histogram">
      <h3>{facet.label}</h3>
      {facet.bins.map((label, bin) =>
        counts[bin] === 0 && !chosen.has(bin) ? null : (
          <button key={label} type="button" class="bar" aria-pressed={chosen.has(bin)} onClick={() => onToggle(bin)}>
            <span class="bar-label">{label}</span>
            <span class="bar-track">
              <span style={{ width: `${(100 * counts[bin]!) / most}%` }} />
            </span>
            <span class="bar-count">
              {counts[bin]!.toLocaleString("en-US")}
              <span class="hidden"> {counts[bin] === 1 ? "image" : "images"}</span>
            </span>
          </button>
        ),
      )}
    </div>
  );
}

interface FiltersProps {
  state: IndexState;
  facets: Facet[];
  choice: Choice;
  query: URLSearchParams;
}

export function Filters({ state, facets, choice, query }: FiltersProps) {
  const { index, share, error } = state;
  const histograms = useMemo(
    () => (index ? facets.map((facet) => histogramOf(index, facets, choice, facet)) : []),
    [index, facets, choice],
  );
  const toggle = (facet: Facet, bin: number) => {
    const label = facet.bins[bin]!;
    const next = new URLSearchParams(query);
    next.delete("page");
    const labels = next.getAll(facet.name);
    next.delete(facet.name);
    const kept = labels.includes(label) ? labels.filter((other) => other !== label) : [...labels, label];
    kept.forEach((other) => next.append(facet.name, other));
    navigate(`${servicePath(location.pathname)}?${next}`, { replace: true });
  };
  if (error)
    return error.status === 401 ? null : (
      <p class="notice warn">
        {error.status === 404 ? "This dataset has no COCO annotations, so there is nothing else to filter by." : `${error.message}.`}
      </p>
    );
  if (!index) return <Progress done={Math.round(kPercent * share)} total={kPercent} label="reading the annotations" />;
  return (
    <>
      <div class="histograms">
        {facets.map((facet, at) =>
          histograms[at]!.some((count) => count > 0) || choice.get(facet.name)!.size > 0 ? (
            <Histogram
              key={facet.name}
              facet={facet}
              counts={histograms[at]!}
              chosen={choice.get(facet.name)!}
              onToggle={(bin) => toggle(facet, bin)}
            />
          ) : null,
        )}
      </div>
      <p class="quiet-text">Bars count images. An image fits if one of its people has all that is chosen of people.</p>
    </>
  );
}
