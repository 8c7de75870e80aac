// One job: progress of its runs, images as they come, logs, errors, and its results.
import { useState } from "preact/hooks";
import { messageOf } from "../api/client";
import { type ServerEvent, useEvents } from "../api/events";
import { cancelJob, canRetry, editCopy, hasDataset, isActive, keepJob, removeJob, retryJob, shareDone, stageText } from "../api/jobs";
import { useInterval, useJson } from "../api/resource";
import type { Job, Progress as JobProgress, PreviewList } from "../api/types";
import { ConnectionNote } from "../parts/connection";
import { Confirmation, ErrorBox, Figures, Mistakes, Progress, type Question, ServiceImage, StateBadge } from "../parts/elements";
import { bytesText, durationText, secondsBetween, timeText } from "../parts/format";
import { GoneJob } from "../parts/gone";
import { navigate } from "../parts/router";
import { Logs } from "./logs";
import { Results } from "./results";

const kPollMs = 5000;
const kMaxPreviews = 12;

function Actions({ job, onChange }: { job: Job; onChange: () => void }) {
  const [question, setQuestion] = useState<Question | null>(null);
  const [error, setError] = useState<string | null>(null);
  const perform = (action: Promise<unknown>, then: () => void = onChange) =>
    void action.then(
      () => {
        setError(null);
        then();
      },
      (reason: unknown) => setError(messageOf(reason)),
    );
  const askCancel = () =>
    setQuestion({
      title: "Cancel this job?",
      text: "Finished runs stay; the job can be retried.",
      action: "Cancel the job",
      isDangerous: true,
      confirm: () => perform(cancelJob(job.id)),
    });
  const askRemove = () =>
    setQuestion({
      title: "Delete this job?",
      text: `“${job.name}” and all its files (${bytesText(job.bytes)}) are deleted. This cannot be undone.`,
      action: "Delete the job",
      isDangerous: true,
      confirm: () => perform(removeJob(job.id), () => navigate("/jobs")),
    });
  return (
    <div class="actions">
      {hasDataset(job) && (
        <a class="button primary" href={`/jobs/${job.id}/images`}>
          Browse images
        </a>
      )}
      {hasDataset(job) && (
        <a class="button" href={`/compare?job=${job.id}`}>
          Compare
        </a>
      )}
      {isActive(job) && (
        <button type="button" class="button" onClick={askCancel}>
          Cancel
        </button>
      )}
      {canRetry(job) && (
        <button type="button" class="button" onClick={() => perform(retryJob(job.id))}>
          Retry
        </button>
      )}
      <a class="button" href={`/fly?clone=${job.id}`}>
        Fly
      </a>
      <button type="button" class="button" onClick={() => editCopy(job.id)}>
        Copy and edit
      </button>
      <button type="button" class="button" aria-pressed={job.keep} onClick={() => perform(keepJob(job.id, !job.keep))}>
        {job.keep ? "Kept" : "Keep"}
      </button>
      <button type="button" class="button danger-text" onClick={askRemove}>
        Delete
      </button>
      {error && (
        <p class="field-error" role="alert">
          {error}
        </p>
      )}
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}

function JobErrorBox({ job }: { job: Job }) {
  if (!job.error) return null;
  const { kind, message, problems, runs } = job.error;
  return (
    <div class={`notice ${kind === "partial" ? "warn" : "bad"}`} role="alert">
      <p>
        <strong>{kind === "input" ? "The job is wrong" : kind === "partial" ? "Some runs failed" : "The work failed"}:</strong> {message}
      </p>
      <Mistakes list={problems} />
      {runs && (
        <ul class="mistakes">
          {runs.map((run) => (
            <li key={run.run}>
              <code>{run.run}</code> {run.task}: {run.message} (tried {run.attempts} times)
            </li>
          ))}
        </ul>
      )}
      {kind === "input" && (
        <button type="button" class="button" onClick={() => editCopy(job.id)}>
          Fix and retry
        </button>
      )}
    </div>
  );
}

function RunTable({ job }: { job: Job }) {
  const { progress } = job;
  const runs = progress.runs ?? [];
  const shards = progress.shards ?? [];
  return (
    <div class="scroll">
      <table class="runs">
        <thead>
          <tr>
            <th>Run</th>
            <th>Stage</th>
            <th>Simulated</th>
            <th>Images</th>
            <th class="wide-only">Rate</th>
            <th class="wide-only">Left</th>
          </tr>
        </thead>
        <tbody>
          {runs.map((run) => (
            <tr key={run.run}>
              <td>
                {hasDataset(job) && run.stage === "finished" ? (
                  <a href={`/jobs/${job.id}/runs/${Number(run.run.slice(3))}`}>
                    <code>{run.run}</code>
                  </a>
                ) : (
                  <code>{run.run}</code>
                )}
              </td>
              <td>{run.stage}</td>
              <td>
                {run.simulated_s.toFixed(0)} / {run.duration_s.toFixed(0)} s
              </td>
              <td>
                <Progress done={run.frames_done} total={run.frames_total} label={`images of ${run.run}`} />
                {run.frames_done} / {run.frames_total}
              </td>
              <td class="wide-only">{run.frames_per_s > 0 ? `${run.frames_per_s.toFixed(1)}/s` : "–"}</td>
              <td class="wide-only">{run.remaining_s === null ? "–" : durationText(run.remaining_s)}</td>
            </tr>
          ))}
          {shards.map((shard) => (
            <tr key={shard.shard} class="shard">
              <td colSpan={3}>
                <code>{shard.shard}</code>
              </td>
              <td>
                {shard.frames_done} / {shard.frames_total}
              </td>
              <td class="wide-only">{shard.frames_per_s > 0 ? `${shard.frames_per_s.toFixed(1)}/s` : "–"}</td>
              <td class="wide-only">{shard.remaining_s === null ? "–" : durationText(shard.remaining_s)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** `newest`: the name of the one that came last. */
function Previews({ job, newest }: { job: Job; newest: string }) {
  const step = Math.floor((job.progress.frames_done ?? 0) / 8);
  const previews = useJson<PreviewList>(`/v1/jobs/${job.id}/previews#${job.state}${step}${encodeURIComponent(newest)}`);
  const list = previews.value?.previews.slice(-kMaxPreviews) ?? [];
  return (
    <div class="cards small-cards">
      <figure>
        <ServiceImage path={`/v1/jobs/${job.id}/plan`} alt="floor plan with the paths of the drones" className="on-white" />
        <figcaption>floor plan</figcaption>
      </figure>
      {list.map((preview) => (
        <figure key={preview.name}>
          {hasDataset(job) ? (
            <a href={`/jobs/${job.id}/images?image=${encodeURIComponent(`images/${preview.name}`)}`}>
              <ServiceImage path={preview.href} alt={`labels on ${preview.name}`} />
            </a>
          ) : (
            <ServiceImage path={preview.href} alt={`labels on ${preview.name}`} />
          )}
          <figcaption>{preview.name}</figcaption>
        </figure>
      ))}
    </div>
  );
}

export function JobScreen({ id }: { id: string }) {
  const resource = useJson<Job>(`/v1/jobs/${id}`);
  const [live, setLive] = useState<JobProgress | null>(null);
  const [newest, setNewest] = useState("");
  const onEvent = (event: ServerEvent) => {
    if (event.type === "progress") setLive(JSON.parse(event.data) as JobProgress);
    else if (event.type === "preview") setNewest((JSON.parse(event.data) as { name: string }).name);
    else resource.reload();
  };
  const isRunning = resource.value ? isActive(resource.value) : false;
  // No event says that a job has been removed; one that is removed while it runs is cancelled first.
  useInterval(resource.reload, isRunning || resource.value?.state === "cancelled" ? kPollMs : 0);
  const connection = useEvents(isRunning ? `/v1/jobs/${id}/events` : null, onEvent);
  if (resource.error?.status === 404) return <GoneJob id={id} />;
  if (!resource.value) {
    return resource.error && resource.error.status !== 401 ? <ErrorBox error={resource.error} /> : <p class="loading">Loading …</p>;
  }
  const job = { ...resource.value, progress: isRunning && live ? live : resource.value.progress };
  return (
    <div class="screen">
      <div class="heading">
        <p class="breadcrumb">
          <a href="/jobs">Jobs</a> / <code>{job.id}</code>
        </p>
        <div class="row wrap">
          <h1>{job.name}</h1>
          <StateBadge state={job.state} />
          {isRunning && <ConnectionNote state={connection} />}
        </div>
        <Actions job={job} onChange={resource.reload} />
      </div>
      <ErrorBox error={resource.error && resource.error.status !== 401 ? resource.error : null} />
      <JobErrorBox job={job} />
      {job.waiting_for && <p class="notice warn">Waits: {job.waiting_for}</p>}
      <Summary job={job} />
      {(job.progress.runs?.length ?? 0) > 0 && (
        <section aria-labelledby="runs">
          <h2 id="runs">Runs</h2>
          <RunTable job={job} />
        </section>
      )}
      <section aria-labelledby="previews">
        <h2 id="previews">Previews</h2>
        <Previews job={job} newest={newest} />
      </section>
      {hasDataset(job) && <Results job={job} />}
      <Logs job={job} />
      <details class="source">
        <summary>The job with all its fields</summary>
        <pre tabIndex={0}>{JSON.stringify(job.job, null, 2)}</pre>
      </details>
    </div>
  );
}

function Summary({ job }: { job: Job }) {
  const rate = job.progress.frames_per_s ?? 0;
  const left = job.progress.remaining_s ?? null;
  const figures: [string, string][] = [
    ["created", timeText(job.created_at)],
    [job.ended_at ? "took" : "running for", job.started_at ? durationText(secondsBetween(job.started_at, job.ended_at)) : "–"],
  ];
  if (job.state === "running") {
    figures.push(["speed", rate > 0 ? `${rate.toFixed(1)} images/s` : "–"], ["time left", left === null ? "–" : durationText(left)]);
  } else if (job.ended_at) {
    figures.push(["disk", bytesText(job.bytes)]);
  }
  const { publishing } = job.progress;
  if (publishing && publishing.objects !== null) {
    figures.push(["published", `${publishing.address} (${publishing.objects} objects, ${bytesText(publishing.bytes_total)})`]);
  }
  if (job.attempt > 1) figures.push(["attempt", String(job.attempt)]);
  if (job.expires_at && !job.keep) figures.push(["removed", timeText(job.expires_at)]);
  return (
    <div class="card summary">
      {job.state === "running" && (
        <>
          <p>{stageText(job.progress)}</p>
          <Progress done={Math.round(1000 * shareDone(job.progress))} total={1000} label="progress" />
        </>
      )}
      <Figures list={figures} />
    </div>
  );
}
