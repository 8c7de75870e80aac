// The table of all jobs: filters are in the address, pages come from the service.
import { useEffect, useRef, useState } from "preact/hooks";
import { messageOf } from "../api/client";
import { useEvents } from "../api/events";
import { cancelJob, canRetry, hasDataset, isActive, keepJob, kStates, removeJob, retryJob, shareDone, stageText } from "../api/jobs";
import { useInterval, useJson } from "../api/resource";
import type { Job, JobList } from "../api/types";
import { ConnectionNote } from "../parts/connection";
import { Confirmation, Empty, ErrorBox, Progress, type Question, StateBadge } from "../parts/elements";
import { agoText, bytesText, countText, timeText } from "../parts/format";
import { navigate, useAddress, withQuery } from "../parts/router";

const kPage = 25;
const kPollMs = 2000;
const kMaxCompared = 6;
const kTypingPauseMs = 300;

function Filters({ query }: { query: URLSearchParams }) {
  const states = new Set(query.getAll("state"));
  const [name, setName] = useState(query.get("name") ?? "");
  const timer = useRef(0);
  const toggle = (state: string) => {
    const next = new URLSearchParams(query);
    next.delete("state");
    next.delete("after");
    if (states.has(state)) states.delete(state);
    else states.add(state);
    states.forEach((value) => next.append("state", value));
    navigate(`/jobs?${next}`);
  };
  const search = (text: string) => {
    setName(text);
    clearTimeout(timer.current);
    timer.current = setTimeout(() => navigate(withQuery(query, { name: text, after: null }), { replace: true }), kTypingPauseMs);
  };
  return (
    <div class="filters row wrap" role="search">
      <label class="search">
        <span class="hidden">Name contains</span>
        <input type="search" placeholder="Name contains" value={name} onInput={(event) => search(event.currentTarget.value)} />
      </label>
      <div class="chips" role="group" aria-label="States">
        {kStates.map((state) => (
          <button key={state} type="button" class="chip" aria-pressed={states.has(state)} onClick={() => toggle(state)}>
            {state}
          </button>
        ))}
      </div>
      {query.get("label") && (
        <a class="chip" href={withQuery(query, { label: null, after: null })}>
          label {query.get("label")} ✕
        </a>
      )}
      <label>
        <span class="hidden">Order</span>
        <select
          value={query.get("sort") ?? "newest"}
          onChange={(event) => navigate(withQuery(query, { sort: event.currentTarget.value === "oldest" ? "oldest" : null, after: null }))}
        >
          <option value="newest">Newest first</option>
          <option value="oldest">Oldest first</option>
        </select>
      </label>
    </div>
  );
}

function JobRow({ job, isSelected, onSelect }: { job: Job; isSelected: boolean; onSelect: (selected: boolean) => void }) {
  return (
    <tr class={isSelected ? "selected" : ""}>
      <td class="check">
        <input
          type="checkbox"
          aria-label={`Select ${job.name}`}
          checked={isSelected}
          onChange={(event) => onSelect(event.currentTarget.checked)}
        />
      </td>
      <td class="name" data-label="Name">
        <a href={`/jobs/${job.id}`}>{job.name}</a>
        <span class="labels">
          {job.labels.map((label) => (
            <a key={label} class="tag" href={`/jobs?label=${encodeURIComponent(label)}`}>
              {label}
            </a>
          ))}
          {job.keep && <span class="tag">kept</span>}
        </span>
      </td>
      <td data-label="State">
        <StateBadge state={job.state} />
      </td>
      <td data-label="Progress" class="progress-cell">
        {job.state === "running" ? (
          <>
            <Progress done={Math.round(1000 * shareDone(job.progress))} total={1000} label={`progress of ${job.name}`} />
            <span class="quiet-text">{stageText(job.progress)}</span>
          </>
        ) : (
          <span class="quiet-text">
            {job.error
              ? job.error.message
              : job.progress.frames_total
                ? countText(job.progress.frames_total, "image")
                : (job.waiting_for ?? "")}
          </span>
        )}
      </td>
      <td data-label="Disk" class="number">
        {job.bytes > 0 ? bytesText(job.bytes) : "–"}
      </td>
      <td data-label="Created" title={timeText(job.created_at)}>
        {agoText(job.created_at)}
      </td>
    </tr>
  );
}

interface BulkAction {
  label: string;
  applies: (job: Job) => boolean;
  perform: (id: string) => Promise<unknown>;
  question?: string;
}

const kActions: BulkAction[] = [
  { label: "Cancel", applies: isActive, perform: cancelJob, question: "Finished runs stay; the jobs can be retried." },
  { label: "Retry", applies: canRetry, perform: retryJob },
  { label: "Keep", applies: (job) => !job.keep, perform: (id) => keepJob(id, true) },
  { label: "Delete", applies: () => true, perform: removeJob, question: "All their files are deleted. This cannot be undone." },
];

function BulkBar({ jobs, onDone, onClear }: { jobs: Job[]; onDone: () => void; onClear: () => void }) {
  const [question, setQuestion] = useState<Question | null>(null);
  const [errors, setErrors] = useState<string[]>([]);
  const perform = async (action: BulkAction, chosen: Job[]) => {
    const failures: string[] = [];
    for (const job of chosen) {
      await action.perform(job.id).catch((error: unknown) => failures.push(`${job.name}: ${messageOf(error)}`));
    }
    setErrors(failures);
    onDone();
  };
  const ask = (action: BulkAction) => {
    const chosen = jobs.filter(action.applies);
    if (!action.question) return void perform(action, chosen);
    setQuestion({
      title: `${action.label} ${countText(chosen.length, "job")}?`,
      text: action.question,
      action: `${action.label} ${countText(chosen.length, "job")}`,
      isDangerous: true,
      confirm: () => void perform(action, chosen),
    });
  };
  return (
    <div class="bulk row wrap" role="group" aria-label="Selected jobs">
      <span>{jobs.length} selected</span>
      {kActions.map((action) => (
        <button key={action.label} type="button" class="button small" disabled={!jobs.some(action.applies)} onClick={() => ask(action)}>
          {action.label}
        </button>
      ))}
      {jobs.length >= 2 && jobs.length <= kMaxCompared && jobs.every(hasDataset) && (
        <a class="button small" href={`/compare?${jobs.map((job) => `job=${job.id}`).join("&")}`}>
          Compare
        </a>
      )}
      <button type="button" class="button small quiet" onClick={onClear}>
        Clear selection
      </button>
      {errors.length > 0 && (
        <ul class="field-error" role="alert">
          {errors.map((error) => (
            <li key={error}>{error}</li>
          ))}
        </ul>
      )}
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}

/** The service's parameters in the page's address. */
function listAddress(query: URLSearchParams): string {
  const parameters = new URLSearchParams({ limit: String(kPage) });
  for (const name of ["state", "name", "label", "sort", "after"]) {
    query.getAll(name).forEach((value) => parameters.append(name, value));
  }
  return `/v1/jobs?${parameters}`;
}

export function Jobs() {
  const { query } = useAddress();
  const address = listAddress(query);
  const list = useJson<JobList>(address);
  const [selected, setSelected] = useState<Set<string>>(new Set());
  const connection = useEvents("/v1/events", list.reload);
  const jobs = list.value?.jobs ?? [];
  useInterval(list.reload, jobs.some((job) => job.state === "running") ? kPollMs : 0);
  useEffect(() => setSelected(new Set()), [address]);
  const isFiltered = ["state", "name", "label", "after"].some((name) => query.has(name));
  const chosen = jobs.filter((job) => selected.has(job.id));
  const select = (id: string, isSelected: boolean) => {
    const next = new Set(selected);
    if (isSelected) next.add(id);
    else next.delete(id);
    setSelected(next);
  };
  return (
    <div class="screen">
      <div class="row wrap heading">
        <h1 class="grow">Jobs</h1>
        <ConnectionNote state={connection} />
        <a class="button primary" href="/new">
          New job
        </a>
      </div>
      <Filters query={query} />
      {list.error?.status !== 401 && <ErrorBox error={list.error} />}
      {chosen.length > 0 && <BulkBar jobs={chosen} onDone={list.reload} onClear={() => setSelected(new Set())} />}
      {list.value && jobs.length === 0 && (
        <Empty title={isFiltered ? "No job fits" : "No jobs yet"}>
          <a class="button" href={isFiltered ? "/jobs" : "/new"}>
            {isFiltered ? "Show all jobs" : "Make the first dataset"}
          </a>
        </Empty>
      )}
      {jobs.length > 0 && (
        <table class="jobs">
          <thead>
            <tr>
              <th class="check">
                <input
                  type="checkbox"
                  aria-label="Select all jobs of this page"
                  checked={chosen.length === jobs.length}
                  onChange={(event) => setSelected(new Set(event.currentTarget.checked ? jobs.map((job) => job.id) : []))}
                />
              </th>
              <th>Name</th>
              <th>State</th>
              <th>Progress</th>
              <th class="number">Disk</th>
              <th>Created</th>
            </tr>
          </thead>
          <tbody>
            {jobs.map((job) => (
              <JobRow key={job.id} job={job} isSelected={selected.has(job.id)} onSelect={(value) => select(job.id, value)} />
            ))}
          </tbody>
        </table>
      )}
      <div class="row pages">
        {query.get("after") && (
          <a class="button" href={withQuery(query, { after: null })}>
            First page
          </a>
        )}
        {list.value?.next && (
          <a class="button" href={withQuery(query, { after: list.value.next })}>
            Next page
          </a>
        )}
      </div>
    </div>
  );
}
