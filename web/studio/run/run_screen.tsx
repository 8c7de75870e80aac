// One run over time: every camera, the plan, the escape curve and the exits share one time.
import { useEffect, useMemo, useState } from "preact/hooks";
import { ApiError, request } from "../api/client";
import { useInterval, useJson, useSource } from "../api/resource";
import type { Job, Scenario } from "../api/types";
import { EscapeCurve } from "../charts/escape_curve";
import { ExitChart } from "../charts/exit_chart";
import { addressOf, runsOf } from "../compare/subjects";
import type { Dataset, ImageName, Labels } from "../dataset/coco";
import type { Drawing } from "../dataset/overlay";
import { LabelCanvas, useDataset, useLabels } from "../dataset/stage";
import { ErrorBox, Figures } from "../parts/elements";
import { GoneJob } from "../parts/gone";
import { useKeys } from "../parts/keys";
import { navigate, useAddress, withQuery } from "../parts/router";
import { type Capture, captureOf, frameAt, timeOf } from "./capture";
import { Defined } from "./definitions";
import { EventChart } from "./event_chart";
import { type ExitHistory, historiesOf } from "./exit_states";
import type { Metrics } from "./metrics";
import { TopView } from "./top_view";
import { useTrajectories } from "./trajectories";

const kPlayMs = 600;

function Camera({
  dataset,
  image,
  drawing,
  onLabels,
}: {
  dataset: Dataset;
  image: ImageName;
  drawing: Drawing;
  onLabels: (camera: string, labels: Labels | null) => void;
}) {
  const source = useSource(dataset.address(image));
  const { labels } = useLabels(dataset, image);
  useEffect(() => onLabels(image.camera, labels), [labels]);
  return (
    <figure>
      <div class="stage">
        {source && <img src={source} alt={`camera ${image.camera}, frame ${image.frame}`} />}
        <LabelCanvas labels={labels} drawing={drawing} />
      </div>
      <figcaption class="row">
        <span class="grow">{image.camera}</span>
        <a href={`/jobs/${dataset.job}/images?image=${encodeURIComponent(image.path)}`}>open</a>
      </figcaption>
    </figure>
  );
}

function useExits(address: string, end_s: number | undefined): ExitHistory[] {
  const [histories, setHistories] = useState<ExitHistory[]>([]);
  useEffect(() => {
    if (end_s === undefined) return;
    // A job that did not ask for exits has no such file.
    request(address).then(
      async (response) => setHistories(historiesOf(await response.text(), end_s)),
      () => setHistories([]),
    );
  }, [address, end_s]);
  return histories;
}

type Figure = [preact.JSX.Element, string];

const defined = (anchor: string, name: string) => <Defined anchor={anchor}>{name}</Defined>;

/** Everybody once: the numbers add up to the people. Older files have two numbers only. */
function countsOf({ people, not_escaped, people_counts: counts, exits }: Metrics): Figure[] {
  const count = (name: string, value: number): Figure => [defined("people_counts", name), String(value)];
  if (!counts) return [count("people", people), count("not escaped", not_escaped)];
  const others: Figure[] = [
    count("by no exit", counts.left_by_no_exit),
    count("casualties", counts.casualties),
    count("vanished inside", counts.vanished_inside),
    count("turned back", counts.turned_back),
    count("never inside", counts.never_inside),
  ];
  return [
    count("people", people),
    ...counts.left_by_exit.map(({ id, people: out }): Figure => {
      const states = exits?.find((exit) => exit.id === id)?.time_in_state;
      const isClosed = out === 0 && states && Object.entries(states).every(([state, time_s]) => state === "closed_s" || time_s === 0);
      return [defined("people_counts", `left by ${id}`), isClosed ? "closed" : String(out)];
    }),
    count("inside at the end", counts.inside),
    ...others.filter(([, value]) => value !== "0"),
  ];
}

function figuresOf(metrics: Metrics): Figure[] {
  const seconds = (value: number | null | undefined) => (value === null || value === undefined ? "–" : `${value.toFixed(1)} s`);
  return [
    [defined("escape_time_percentiles", "escape time, median"), seconds(metrics.escape_time_percentiles["t50_s"])],
    [defined("escape_time_percentiles", "90th percentile"), seconds(metrics.escape_time_percentiles["t90_s"])],
  ];
}

interface TimelineProps {
  dataset: Dataset;
  run: string;
  number: number;
  capture: Capture;
  scenario: Scenario | null;
}

/** The frame that all views of a run show: the one of the address, or the first. */
function useFrame(dataset: Dataset, run: string, capture: Capture) {
  const { query } = useAddress();
  const [isPlaying, setPlaying] = useState(false);
  const cameras = dataset.camerasOf(run);
  const first = Math.min(...cameras.map((camera) => camera.first));
  const last = Math.max(...cameras.map((camera) => camera.last));
  const inRange = (value: number) => Math.min(last, Math.max(first, value));
  const frame = inRange(Math.round(Number(query.get("frame") ?? first) || first));
  const show = (next: number) => navigate(withQuery(query, { frame: inRange(next) }), { replace: true });
  const play = () => setPlaying(!isPlaying);
  useInterval(() => (frame < last ? show(frame + 1) : setPlaying(false)), isPlaying ? kPlayMs : 0);
  useKeys((event) => {
    if (event.target instanceof Element && event.target.matches("input, select, button, a, summary")) return;
    if (event.key === " ") play();
    else if (event.key === "ArrowRight") show(frame + 1);
    else if (event.key === "ArrowLeft") show(frame - 1);
    else return;
    event.preventDefault();
  });
  return { cameras, first, last, frame, time_s: timeOf(capture, frame), show, isPlaying, play };
}

interface TimeBarProps {
  shown: ReturnType<typeof useFrame>;
  hasBoxes: boolean;
  onBoxes: (hasBoxes: boolean) => void;
}

function TimeBar({ shown, hasBoxes, onBoxes }: TimeBarProps) {
  return (
    <div class="time-bar card">
      <button type="button" class="button" aria-pressed={shown.isPlaying} onClick={shown.play}>
        {shown.isPlaying ? "Pause" : "Play"}
      </button>
      <input
        type="range"
        aria-label="Time"
        aria-valuetext={`${shown.time_s.toFixed(1)} s`}
        min={shown.first}
        max={shown.last}
        value={shown.frame}
        onInput={(event) => shown.show(Number(event.currentTarget.value))}
      />
      <output>{shown.time_s.toFixed(1)} s</output>
      <label class="row">
        <input type="checkbox" checked={hasBoxes} onChange={(event) => onBoxes(event.currentTarget.checked)} />
        Boxes
      </label>
    </div>
  );
}

interface ChartsProps {
  metrics: Metrics;
  exits: ExitHistory[];
  chart: { time_s: number; end_s: number; onTime: (time_s: number) => void };
}

function RunCharts({ metrics, exits, chart }: ChartsProps) {
  return (
    <section class="card run-charts" aria-labelledby="escape">
      <h2 id="escape">Escaped by time</h2>
      <Figures list={countsOf(metrics)} />
      <Figures list={figuresOf(metrics)} />
      {metrics.warnings?.map((warning) => (
        <p key={warning} class="run-warning">
          Warning: {warning}.
        </p>
      ))}
      <EscapeCurve {...chart} shares={metrics.escape_curve.escaped_share} alarm_s={metrics.alarm_s} />
      <h2>Events</h2>
      <EventChart {...chart} metrics={metrics} />
      {exits.length > 0 && (
        <>
          <h2>Exits</h2>
          <ExitChart {...chart} histories={exits} />
        </>
      )}
    </section>
  );
}

function Timeline({ dataset, run, number, capture, scenario }: TimelineProps) {
  const shown = useFrame(dataset, run, capture);
  const { cameras, frame } = shown;
  const metrics = useJson<Metrics>(`/v1/jobs/${dataset.job}/runs/${number}/metrics`);
  const [labels, setLabels] = useState<Record<string, Labels | null>>({});
  const [hasBoxes, setBoxes] = useState(true);
  const end_s = Math.max(metrics.value?.duration_s ?? 0, timeOf(capture, shown.last));
  const exits = useExits(`/v1/jobs/${dataset.job}/runs/${number}/metrics.csv`, metrics.value?.duration_s);
  const trajectories = useTrajectories(dataset.job, number, capture, frame);
  const drawing: Drawing = useMemo(
    () => ({ layers: new Set(hasBoxes ? ["boxes"] : []), coloring: "state", opacity: 0.5, selected: null }),
    [hasBoxes],
  );
  const chart = { time_s: shown.time_s, end_s, onTime: (time_s: number) => shown.show(frameAt(capture, time_s)) };
  return (
    <>
      <TimeBar shown={shown} hasBoxes={hasBoxes} onBoxes={setBoxes} />
      <div class="run-views">
        <div class="run-cameras">
          {cameras.map(({ camera }) => {
            const image = dataset.imageAt(run, camera, frame);
            return (
              image && (
                <Camera
                  key={camera}
                  {...{ dataset, image, drawing }}
                  onLabels={(name, value) => setLabels((known) => ({ ...known, [name]: value }))}
                />
              )
            );
          })}
        </div>
        {scenario?.ground_m && (
          <TopView
            scenario={scenario}
            run={number}
            trajectories={trajectories}
            labels={cameras.map(({ camera }) => labels[camera] ?? null)}
          />
        )}
      </div>
      {metrics.error && metrics.error.status !== 401 && <ErrorBox error={metrics.error} />}
      {metrics.value && <RunCharts metrics={metrics.value} exits={exits} chart={chart} />}
    </>
  );
}

export function RunScreen({ id, number }: { id: string; number: number }) {
  const job = useJson<Job>(`/v1/jobs/${id}`);
  const { dataset, error } = useDataset(id);
  const run = `run${String(number).padStart(3, "0")}`;
  const asked = job.value?.job?.["scenario"];
  const card = useJson<{ scenarios?: Record<string, string> }>(Array.isArray(asked) ? `/v1/jobs/${id}/files/dataset.json` : null);
  const place = Array.isArray(asked) ? card.value?.scenarios?.[run] : asked;
  const isShipped = typeof place === "string" && !place.startsWith("generated/");
  const scenario = useJson<Scenario>(isShipped ? `/v1/scenarios/${place}` : null);
  if (job.error?.status === 404) return <GoneJob id={id} />;
  const others = job.value ? Array.from({ length: runsOf(job.value) }, (_, other) => other).filter((other) => other !== number) : [];
  const hasRun = (dataset?.camerasOf(run).length ?? 0) > 0;
  return (
    <div class="screen">
      <div class="heading">
        <p class="breadcrumb">
          <a href="/jobs">Jobs</a> / <a href={`/jobs/${id}`}>{job.value?.name ?? id}</a> / {run}
        </p>
        <h1>
          {run} of {job.value?.name ?? id}
        </h1>
        {hasRun && (
          <div class="actions">
            <a class="button" href={addressOf([{ id, run: number }, ...others.slice(0, 1).map((other) => ({ id, run: other }))])}>
              Compare with {others.length > 0 ? "another run" : "a job or a run"}
            </a>
          </div>
        )}
      </div>
      {error?.status !== 401 && <ErrorBox error={error} />}
      {!dataset && !error && <p class="loading">Loading …</p>}
      {dataset && !hasRun && <ErrorBox error={new ApiError(404, `The dataset has no images of ${run}.`)} />}
      {dataset && hasRun && job.value && (
        <Timeline {...{ dataset, run, number }} capture={captureOf(job.value)} scenario={scenario.value} />
      )}
    </div>
  );
}
