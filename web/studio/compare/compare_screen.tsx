// Two to six jobs side by side: their fields, escape curves, figures and images.
import { useEffect, useMemo, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson } from "../api/client";
import { useJson } from "../api/resource";
import { useSession } from "../api/session";
import type { Job, JobList } from "../api/types";
import type { Json } from "../form/json";
import { Empty, ErrorBox } from "../parts/elements";
import { navigate, usePlace } from "../parts/router";
import type { Metrics } from "../run/metrics";
import { type Curve, Curves, Swatch } from "./curves";
import { type Difference, differencesOf } from "./differences";
import { FigureTable } from "./figures";
import { Swipe } from "./swipe";

const kMaxJobs = 6;

interface Compared {
  ids: string;
  jobs: Job[];
  runs: Metrics[][];
}

function useJobs(ids: string[]) {
  const [state, setState] = useState<Compared | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const { round } = useSession();
  const wanted = ids.join();
  useEffect(() => {
    const controller = new AbortController();
    const { signal } = controller;
    const load = async () => {
      const jobs = await Promise.all(ids.map((id) => getJson<Job>(`/v1/jobs/${id}`, signal)));
      const metrics = await Promise.all(ids.map((id) => getJson<{ runs: Metrics[] }>(`/v1/jobs/${id}/metrics`, signal)));
      setState({ ids: wanted, jobs, runs: metrics.map((entry) => entry.runs) });
      setError(null);
    };
    load().catch((reason: unknown) => signal.aborted || setError(asApiError(reason)));
    return () => controller.abort();
  }, [wanted, round]);
  return { compared: state?.ids === wanted ? state : null, error };
}

function addressOf(ids: string[], time_s?: number): string {
  const query = new URLSearchParams(ids.map((id) => ["job", id]));
  if (time_s !== undefined) query.set("t", String(Math.round(10 * time_s) / 10));
  return `/compare?${query}`;
}

function Chosen({ ids, jobs }: { ids: string[]; jobs: Job[] }) {
  const list = useJson<JobList>("/v1/jobs?state=succeeded&state=partial&limit=50");
  const others = (list.value?.jobs ?? []).filter((job) => !ids.includes(job.id));
  return (
    <div class="row wrap">
      {ids.map((id, index) => (
        <span key={id} class="chosen">
          <Swatch index={index} /> <a href={`/jobs/${id}`}>{jobs.find((job) => job.id === id)?.name ?? id}</a>
          <button type="button" class="link" aria-label={`Leave out ${jobs.find((job) => job.id === id)?.name ?? id}`} onClick={() => navigate(addressOf(ids.filter((other) => other !== id)))}>
            ×
          </button>
        </span>
      ))}
      {ids.length < kMaxJobs && others.length > 0 && (
        <select aria-label="Add a job" value="" onChange={(event) => navigate(addressOf([...ids, event.currentTarget.value]))}>
          <option value="" disabled>
            Add a job
          </option>
          {others.map((job) => (
            <option key={job.id} value={job.id}>
              {job.name} ({job.id})
            </option>
          ))}
        </select>
      )}
    </div>
  );
}

const valueText = (value: Json | undefined) => (value === undefined ? "–" : typeof value === "string" ? value : JSON.stringify(value));

function Differences({ list, names }: { list: Difference[]; names: string[] }) {
  if (list.length === 0) return <p class="quiet-text">All fields of the jobs are equal.</p>;
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Fields in which the jobs differ">
      <table class="compared">
        <thead>
          <tr>
            <th scope="col">Field</th>
            {names.map((name, index) => (
              <th key={index} scope="col">
                <Swatch index={index} /> {name}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {list.map((difference) => (
            <tr key={difference.pointer}>
              <th scope="row">
                <code>{difference.pointer}</code>
              </th>
              {difference.values.map((value, index) => (
                <td key={index}>
                  <code>{valueText(value)}</code>
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function SwipePair({ jobs, time_s }: { jobs: Job[]; time_s: number }) {
  const [pair, setPair] = useState<[number, number]>([0, 1]);
  const [left, right] = pair.map((index) => Math.min(index, jobs.length - 1)) as [number, number];
  const select = (label: string, value: number, change: (index: number) => void) => (
    <label class="row">
      {label}
      <select value={String(value)} onChange={(event) => change(Number(event.currentTarget.value))}>
        {jobs.map((job, index) => (
          <option key={job.id} value={String(index)}>
            {job.name}
          </option>
        ))}
      </select>
    </label>
  );
  return (
    <>
      {jobs.length > 2 && (
        <div class="row wrap">
          {select("Left", left, (index) => setPair([index, right]))}
          {select("Right", right, (index) => setPair([left, index]))}
        </div>
      )}
      <Swipe key={`${jobs[left]!.id} ${jobs[right]!.id}`} jobs={[jobs[left]!, jobs[right]!]} indices={[left, right]} time_s={time_s} />
    </>
  );
}

function Comparison({ compared, ids }: { compared: Compared; ids: string[] }) {
  const { query } = usePlace();
  const { jobs, runs } = compared;
  const curves: Curve[] = useMemo(() => jobs.map((job, index) => ({ name: job.name, runs: runs[index]! })), [compared]);
  const differences = useMemo(() => differencesOf(jobs.map((job) => job.job as Json)), [compared]);
  const end_s = Math.max(1, ...runs.flat().map((run) => run.duration_s));
  const time_s = Math.min(end_s, Math.max(0, Number(query.get("t") ?? 0) || 0));
  const onTime = (time: number) => navigate(addressOf(ids, time), { replace: true });
  return (
    <>
      <section class="card run-charts" aria-labelledby="curves">
        <h2 id="curves">Escaped by time</h2>
        <p class="quiet-text">Median of the runs; bands are from the first to the third quartile.</p>
        <Curves curves={curves} time_s={time_s} onTime={onTime} />
        <div class="row time-row">
          <input type="range" aria-label="Time" aria-valuetext={`${time_s.toFixed(1)} s`} min={0} max={end_s} step={0.5} value={time_s} onInput={(event) => onTime(Number(event.currentTarget.value))} />
          <output>{time_s.toFixed(1)} s</output>
        </div>
      </section>
      <section aria-labelledby="figures">
        <h2 id="figures">Figures</h2>
        <FigureTable curves={curves} />
        <p class="quiet-text table-note">± half the width of the mean's 95 % interval over the runs (Student's t). A figure that some run does not reach has no mean.</p>
      </section>
      <section aria-labelledby="images" class="swipe-section">
        <h2 id="images">Images at {time_s.toFixed(1)} s</h2>
        <SwipePair jobs={jobs} time_s={time_s} />
      </section>
      <section aria-labelledby="fields">
        <h2 id="fields">Different fields</h2>
        <Differences list={differences} names={jobs.map((job) => job.name)} />
      </section>
    </>
  );
}

export function Compare() {
  const { query } = usePlace();
  const ids = [...new Set(query.getAll("job"))].filter((id) => /^[a-z0-9]+$/.test(id)).slice(0, kMaxJobs);
  const { compared, error } = useJobs(ids);
  return (
    <div class="screen">
      <div class="heading">
        <h1>Compare</h1>
        <Chosen ids={ids} jobs={compared?.jobs ?? []} />
      </div>
      {error?.status !== 401 && <ErrorBox error={error} />}
      {ids.length < 2 && (
        <Empty title="Choose two to six finished jobs">
          <a class="button" href="/jobs?state=succeeded&state=partial">
            Select them in the list of jobs
          </a>
        </Empty>
      )}
      {ids.length >= 2 && !compared && !error && <p class="loading">Loading …</p>}
      {ids.length >= 2 && compared && <Comparison compared={compared} ids={ids} />}
    </div>
  );
}
