// The images of a dataset: a grid by pages, and one image with its labels.
import { useEffect, useMemo, useRef } from "preact/hooks";
import { servicePath } from "../api/base";
import { request } from "../api/client";
import { useJson } from "../api/resource";
import type { ImageList, Job } from "../api/types";
import { Empty, ErrorBox } from "../parts/elements";
import { countText } from "../parts/format";
import { GoneJob } from "../parts/gone";
import { navigate, useAddress, withQuery } from "../parts/router";
import { type ImageName, imageOf } from "./coco";
import { choiceOf, chosenImages, type Facet, facetsOf } from "./facets";
import { Filters, useIndex } from "./filters";
import { useDataset } from "./stage";
import { Viewer } from "./viewer";

const kPage = 48;
const kThumbnailPx = 320;
const kMaxFetches = 4;

let fetches = 0;
const waiting: (() => void)[] = [];

/** Runs few at a time: the rest of the page shares the connections. */
async function inTurn<T>(work: () => Promise<T>): Promise<T> {
  if (fetches >= kMaxFetches) await new Promise<void>((resolve) => waiting.push(resolve));
  ++fetches;
  try {
    return await work();
  } finally {
    --fetches;
    waiting.shift()?.();
  }
}

/** A small copy of an image, made when it comes into view: whole ones would take the memory of the tab. */
function Thumbnail({ address, alt }: { address: string; alt: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const controller = new AbortController();
    const draw = async () => {
      if (controller.signal.aborted) return;
      const response = await request(address, { signal: controller.signal });
      const bitmap = await createImageBitmap(await response.blob(), { resizeWidth: kThumbnailPx, resizeQuality: "medium" });
      const target = canvas.current;
      if (target) {
        target.width = bitmap.width;
        target.height = bitmap.height;
        target.getContext("2d")!.drawImage(bitmap, 0, 0);
        target.dataset["drawn"] = "yes";
      }
      bitmap.close();
    };
    const observer = new IntersectionObserver(([entry]) => {
      if (!entry!.isIntersecting) return;
      observer.disconnect();
      void inTurn(draw).catch(() => canvas.current && (canvas.current.dataset["drawn"] = "failed"));
    });
    observer.observe(canvas.current!);
    return () => {
      observer.disconnect();
      controller.abort();
    };
  }, [address]);
  return <canvas ref={canvas} class="image" role="img" aria-label={alt} />;
}

function Filter({ label, name, values, query }: { label: string; name: string; values: string[]; query: URLSearchParams }) {
  return (
    <label class="row">
      {label}
      <select
        value={query.get(name) ?? ""}
        onChange={(event) => navigate(withQuery(query, { [name]: event.currentTarget.value, page: null }))}
      >
        <option value="">all</option>
        {values.map((value) => (
          <option key={value}>{value}</option>
        ))}
      </select>
    </label>
  );
}

const sorted = (values: Iterable<string>) => [...new Set(values)].sort();
const frameText = (image: { frame: number }) => String(image.frame).padStart(6, "0");

/** The service's parameters for a page of the grid. */
function pageAddress(id: string, query: URLSearchParams, page: number): string {
  const parameters = new URLSearchParams({ limit: String(kPage), offset: String((page - 1) * kPage) });
  for (const name of ["run", "camera"]) if (query.get(name)) parameters.set(name, query.get(name)!);
  return `/v1/jobs/${id}/images?${parameters}`;
}

interface GridProps {
  id: string;
  query: URLSearchParams;
}

const pageOf = (query: URLSearchParams) => Math.max(1, Number(query.get("page") ?? 1) || 1);

interface ThumbnailsProps extends GridProps {
  images: { path: string; run: string; camera: string; frame: number }[]; ///< of the page
  total: number;
}

function Thumbnails({ id, query, images, total }: ThumbnailsProps) {
  const page = pageOf(query);
  const pages = Math.max(1, Math.ceil(total / kPage));
  return (
    <>
      {images.length === 0 && <Empty title="No image fits" />}
      <div class="cards small-cards">
        {images.map((image) => (
          <a key={image.path} class="card thumbnail" href={withQuery(query, { image: image.path })}>
            <Thumbnail address={`/v1/jobs/${id}/files/${image.path}`} alt={`${image.run}, camera ${image.camera}, frame ${image.frame}`} />
            <span class="quiet-text">
              {image.run} · {image.camera} · {frameText(image)}
            </span>
          </a>
        ))}
      </div>
      {pages > 1 && (
        <div class="row wrap pages">
          {page > 1 && (
            <a class="button" href={withQuery(query, { page: page - 1 })}>
              Previous page
            </a>
          )}
          <span class="quiet-text">
            page {page} of {pages}
          </span>
          {page < pages && (
            <a class="button" href={withQuery(query, { page: page + 1 })}>
              Next page
            </a>
          )}
        </div>
      )}
    </>
  );
}

/** Pages of the service: it filters by run and camera alone. */
function Grid({ id, query }: GridProps) {
  const list = useJson<ImageList>(pageAddress(id, query, pageOf(query)));
  if (!list.value)
    return list.error ? <ErrorBox error={list.error.status === 401 ? null : list.error} /> : <p class="loading">Loading …</p>;
  const { images, total, runs } = list.value;
  return (
    <>
      <div class="row wrap filters">
        <Filter label="Run" name="run" values={runs.map((entry) => entry.run)} query={query} />
        <Filter
          label="Camera"
          name="camera"
          values={sorted(runs.flatMap((entry) => entry.cameras.map((camera) => camera.camera)))}
          query={query}
        />
        <a class="button small" href={withQuery(query, { filters: "all", page: null })}>
          All filters
        </a>
        <span class="quiet-text">{countText(total, "image")}</span>
        {query.get("run") && (
          <a class="button small" href={`/jobs/${id}/runs/${Number(query.get("run")!.replace(/\D/g, ""))}`}>
            Timeline
          </a>
        )}
      </div>
      <Thumbnails {...{ id, query, images, total }} />
    </>
  );
}

const kNoFacets: Facet[] = [];

/** Images chosen by their labels, which the browser reads once. */
function FilteredGrid({ id, query }: GridProps) {
  const state = useIndex(id, true);
  const { index } = state;
  const facets = useMemo(() => (index ? facetsOf(index) : kNoFacets), [index]);
  const search = query.toString();
  const choice = useMemo(() => choiceOf(facets, query), [facets, search]);
  const images = useMemo(() => (index ? chosenImages(index, facets, choice) : []), [index, facets, choice]);
  const first = (pageOf(query) - 1) * kPage;
  return (
    <>
      <section class="card facets" aria-label="Filters">
        <div class="row wrap">
          <a class="button small" href={servicePath(location.pathname)}>
            No filters
          </a>
          <span class="quiet-text" role="status">
            {index && `${countText(images.length, "image")} of ${index.images.length.toLocaleString("en-US")}`}
          </span>
        </div>
        <Filters {...{ state, facets, choice, query }} />
      </section>
      {index && <Thumbnails {...{ id, query }} images={images.slice(first, first + kPage)} total={images.length} />}
    </>
  );
}

/** One image; the labels need what the grid does without. */
function Selected({ id, image, query }: { id: string; image: ImageName; query: URLSearchParams }) {
  const { dataset, error } = useDataset(id);
  if (!dataset) return error ? <ErrorBox error={error.status === 401 ? null : error} /> : <p class="loading">Loading …</p>;
  return (
    <Viewer
      dataset={dataset}
      image={image}
      onSelect={(next) => navigate(withQuery(query, { image: next.path }), { replace: true })}
      onClose={() => navigate(withQuery(query, { image: null }))}
    />
  );
}

export function Browser({ id }: { id: string }) {
  const { query } = useAddress();
  const job = useJson<Job>(`/v1/jobs/${id}`);
  const path = query.get("image");
  const image = path === null ? null : imageOf(path);
  if (job.error?.status === 404) return <GoneJob id={id} />;
  return (
    <div class="screen">
      <div class="heading">
        <p class="breadcrumb">
          <a href="/jobs">Jobs</a> / <a href={`/jobs/${id}`}>{job.value?.name ?? id}</a> / Images
        </p>
        {!path && <h1>Images of {job.value?.name ?? id}</h1>}
      </div>
      {image && <Selected id={id} image={image} query={query} />}
      {path !== null && !image && <Empty title="The address names no image" />}
      {path === null && (query.get("filters") ? <FilteredGrid id={id} query={query} /> : <Grid id={id} query={query} />)}
    </div>
  );
}
