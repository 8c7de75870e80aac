// Home: the running job, the queue, and what has come out lately.
import { useState } from "preact/hooks";
import { messageOf } from "../api/client";
import { useEvents } from "../api/events";
import { cancelJob, prioritize, shareDone, stageText } from "../api/jobs";
import { useInterval, useJson } from "../api/resource";
import type { Job, JobList, PreviewList } from "../api/types";
import { ConnectionNote } from "../parts/connection";
import { Confirmation, Empty, ErrorBox, Figures, Progress, type Question, ServiceImage, StateBadge } from "../parts/elements";
import { agoText, bytesText, countText, durationText, secondsBetween } from "../parts/format";

const kPollMs = 1500;
const kMaxQueued = 50;
const kRecent = 8;

function RunningJob({ job }: { job: Job }) {
  const done = job.progress.frames_done ?? 0;
  const previews = useJson<PreviewList>(`/v1/jobs/${job.id}/previews#${Math.floor(done / 8)}`);
  const newest = previews.value?.previews.at(-1);
  const rate = job.progress.frames_per_s ?? 0;
  const left = job.progress.remaining_s ?? null;
  return (
    <article class="card running">
      <a href={`/jobs/${job.id}`} class="running-image" aria-label={`Open ${job.name}`}>
        <ServiceImage path={newest?.href ?? `/v1/jobs/${job.id}/plan`} alt={newest ? `newest image, ${newest.name}` : "floor plan"} />
      </a>
      <div class="running-text">
        <div class="row wrap">
          <StateBadge state={job.state} />
          <h3>
            <a href={`/jobs/${job.id}`}>{job.name}</a>
          </h3>
        </div>
        <p>{stageText(job.progress)}</p>
        <Progress done={Math.round(1000 * shareDone(job.progress))} total={1000} label={`progress of ${job.name}`} />
        <Figures
          list={[
            ["speed", rate > 0 ? `${rate.toFixed(1)} images/s` : "–"],
            ["time left", left === null ? "–" : durationText(left)],
            ["running for", durationText(secondsBetween(job.started_at, null))],
          ]}
        />
      </div>
    </article>
  );
}

function Queue({ jobs, onChange }: { jobs: Job[]; onChange: () => void }) {
  const [question, setQuestion] = useState<Question | null>(null);
  const [error, setError] = useState<string | null>(null);
  const perform = (action: Promise<unknown>) =>
    action.then(
      () => {
        setError(null);
        onChange();
      },
      (reason: unknown) => setError(messageOf(reason)),
    );
  const highest = Math.max(...jobs.map((job) => job.priority));
  const toFront = (job: Job) => void perform(prioritize(job.id, Math.min(100, highest + 1)));
  const askCancel = (job: Job) =>
    setQuestion({
      title: "Cancel this job?",
      text: `“${job.name}” will not be done. It can be queued again later.`,
      action: "Cancel the job",
      isDangerous: true,
      confirm: () => void perform(cancelJob(job.id)),
    });
  return (
    <>
      {error && (
        <p class="notice bad" role="alert">
          {error}
        </p>
      )}
      <ol class="queue">
        {jobs.map((job, index) => (
          <li key={job.id} class="row wrap">
            <span class="queue-number">{index + 1}</span>
            <a class="grow" href={`/jobs/${job.id}`}>
              {job.name}
            </a>
            {job.waiting_for && <span class="quiet-text">waits: {job.waiting_for}</span>}
            {job.priority !== 0 && <span class="quiet-text">priority {job.priority}</span>}
            {index > 0 && (
              <button type="button" class="button small" onClick={() => toFront(job)}>
                To the front
              </button>
            )}
            <button type="button" class="button small" onClick={() => askCancel(job)}>
              Cancel
            </button>
          </li>
        ))}
      </ol>
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </>
  );
}

function ResultCard({ job }: { job: Job }) {
  const previews = useJson<PreviewList>(`/v1/jobs/${job.id}/previews`);
  const image = previews.value?.previews[0]; // early: in an evacuation the later ones may be empty
  return (
    <article class="card result">
      <a href={`/jobs/${job.id}/images`} aria-label={`Images of ${job.name}`}>
        <ServiceImage
          path={image ? `${image.href}?clean` : previews.value ? `/v1/jobs/${job.id}/plan` : null}
          alt={image ? `image of ${job.name}` : `floor plan of ${job.name}`}
        />
      </a>
      <div class="result-text">
        <h3>
          <a href={`/jobs/${job.id}`}>{job.name}</a>
        </h3>
        <p class="quiet-text">
          {countText(job.progress.frames_total ?? 0, "image")} · {bytesText(job.bytes)} · {agoText(job.ended_at)}
        </p>
        {job.state !== "succeeded" && <StateBadge state={job.state} />}
      </div>
    </article>
  );
}

/** The order in which the service takes jobs. */
function queueOrder(a: Job, b: Job): number {
  return b.priority - a.priority || Date.parse(a.created_at ?? "") - Date.parse(b.created_at ?? "");
}

export function Home() {
  const running = useJson<JobList>("/v1/jobs?state=running");
  const queued = useJson<JobList>(`/v1/jobs?state=queued&sort=oldest&limit=${kMaxQueued}`);
  const recent = useJson<JobList>(`/v1/jobs?state=succeeded&state=partial&limit=${kRecent}`);
  const failed = useJson<JobList>("/v1/jobs?state=failed&limit=3");
  const disk = useJson<{ free_bytes: number }>("/readyz");
  const reload = () => [running, queued, recent, failed, disk].forEach((list) => list.reload());
  const connection = useEvents("/v1/events", reload);
  const current = running.value?.jobs ?? [];
  useInterval(running.reload, current.length > 0 ? kPollMs : 0);
  const waiting = [...(queued.value?.jobs ?? [])].sort(queueOrder);
  const results = recent.value?.jobs ?? [];
  const isEmpty = running.value && queued.value && recent.value && current.length + waiting.length + results.length === 0;
  return (
    <div class="screen">
      <div class="row wrap heading">
        <h1 class="grow">Home</h1>
        {disk.value && <span class="quiet-text">{bytesText(disk.value.free_bytes)} free on disk</span>}
        <ConnectionNote state={connection} />
        <a class="button primary" href="/new">
          New job
        </a>
      </div>
      {running.error?.status !== 401 && <ErrorBox error={running.error} />}
      {disk.error?.status === 503 && <ErrorBox error={disk.error} />}
      {isEmpty && (
        <Empty title="No jobs yet">
          <p>A job makes a dataset: images of a crowd as drones see it, with exact labels.</p>
          <a class="button primary" href="/new">
            Make the first dataset
          </a>
        </Empty>
      )}
      {current.length > 0 && (
        <section aria-labelledby="running">
          <h2 id="running">Running</h2>
          {current.map((job) => (
            <RunningJob key={job.id} job={job} />
          ))}
        </section>
      )}
      {waiting.length > 0 && (
        <section aria-labelledby="queue">
          <h2 id="queue">Queue</h2>
          <Queue jobs={waiting} onChange={reload} />
        </section>
      )}
      {(failed.value?.jobs.length ?? 0) > 0 && (
        <section aria-labelledby="failed">
          <h2 id="failed">Failed</h2>
          <ul class="plain-list">
            {failed.value!.jobs.map((job) => (
              <li key={job.id} class="row wrap">
                <a href={`/jobs/${job.id}`}>{job.name}</a>
                <span class="quiet-text">
                  {job.error?.message} · {agoText(job.ended_at)}
                </span>
              </li>
            ))}
          </ul>
        </section>
      )}
      {results.length > 0 && (
        <section aria-labelledby="results">
          <h2 id="results">Results</h2>
          <div class="cards">
            {results.map((job) => (
              <ResultCard key={job.id} job={job} />
            ))}
          </div>
        </section>
      )}
    </div>
  );
}
