// Two to six jobs or runs side by side: their fields, escape curves, figures and images.
import { useEffect, useMemo, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson } from "../api/client";
import { useJson } from "../api/resource";
import { useSession } from "../api/session";
import type { Job, JobList } from "../api/types";
import { Swatch } from "../charts/share_curves";
import type { Json } from "../form/json";
import { Empty, ErrorBox } from "../parts/elements";
import { navigate, useAddress } from "../parts/router";
import type { Metrics } from "../run/metrics";
import { type Difference, differencesOf } from "./differences";
import { FigureTable } from "./figures";
import { Curves } from "./job_curves";
import { addressOf, type Choice, choiceOf, choicesOf, keyOf, kMaxSubjects, nameOf, pageOf, runsOf, type Subject } from "./subjects";
import { Swipe } from "./swipe";

interface Compared {
  keys: string;
  subjects: Subject[];
}

async function subjectOf({ id, run }: Choice, signal: AbortSignal): Promise<Subject> {
  const job = await getJson<Job>(`/v1/jobs/${id}`, signal);
  const runs =
    run === null
      ? (await getJson<{ runs: Metrics[] }>(`/v1/jobs/${id}/metrics`, signal)).runs
      : [await getJson<Metrics>(`/v1/jobs/${id}/runs/${run}/metrics`, signal)];
  return { id, run, name: nameOf(job, run), job, runs };
}

function useSubjects(choices: Choice[]) {
  const [state, setState] = useState<Compared | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const { round } = useSession();
  const wanted = choices.map(keyOf).join();
  useEffect(() => {
    const controller = new AbortController();
    const { signal } = controller;
    const load = async () => {
      setState({ keys: wanted, subjects: await Promise.all(choices.map((choice) => subjectOf(choice, signal))) });
      setError(null);
    };
    load().catch((reason: unknown) => signal.aborted || setError(asApiError(reason)));
    return () => controller.abort();
  }, [wanted, round]);
  return { compared: state?.keys === wanted ? state : null, error };
}

/** Runs of the chosen jobs that are not chosen yet. */
function otherRuns(choices: Choice[], jobs: Job[]): { choice: Choice; name: string }[] {
  const chosen = choices.map(keyOf);
  const ids = [...new Set(choices.map((choice) => choice.id))];
  const known = ids.flatMap((id) => jobs.filter((job) => job.id === id).slice(0, 1));
  const all = known.flatMap((job) =>
    Array.from({ length: runsOf(job) }, (_, run) => ({ choice: { id: job.id, run }, name: nameOf(job, run) })),
  );
  return all.filter(({ choice }) => !chosen.includes(keyOf(choice)));
}

function Chosen({ choices, subjects }: { choices: Choice[]; subjects: Subject[] }) {
  const list = useJson<JobList>("/v1/jobs?state=succeeded&state=partial&limit=50");
  const keys = choices.map(keyOf);
  const others = (list.value?.jobs ?? []).filter((job) => !keys.includes(job.id));
  const runs = otherRuns(
    choices,
    subjects.map(({ job }) => job),
  );
  const add = (text: string) => navigate(addressOf([...choices, choiceOf(text)!]));
  return (
    <div class="row wrap">
      {choices.map((choice, index) => {
        const name = subjects[index]?.name ?? keyOf(choice);
        return (
          <span key={keyOf(choice)} class="chosen">
            <Swatch index={index} /> <a href={pageOf(choice)}>{name}</a>
            <button
              type="button"
              class="link"
              aria-label={`Leave out ${name}`}
              onClick={() => navigate(addressOf(choices.filter((other) => other !== choice)))}
            >
              ×
            </button>
          </span>
        );
      })}
      {choices.length < kMaxSubjects && others.length + runs.length > 0 && (
        <select aria-label="Add a job or a run" value="" onChange={(event) => add(event.currentTarget.value)}>
          <option value="" disabled>
            Add a job or a run
          </option>
          {runs.length > 0 && (
            <optgroup label="Single runs">
              {runs.map(({ choice, name }) => (
                <option key={keyOf(choice)} value={keyOf(choice)}>
                  {name} ({choice.id})
                </option>
              ))}
            </optgroup>
          )}
          <optgroup label="Jobs">
            {others.map((job) => (
              <option key={job.id} value={job.id}>
                {job.name} ({job.id})
              </option>
            ))}
          </optgroup>
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

function SwipePair({ subjects, time_s }: { subjects: Subject[]; time_s: number }) {
  const [pair, setPair] = useState<[number, number]>([0, 1]);
  const [left, right] = pair.map((index) => Math.min(index, subjects.length - 1)) as [number, number];
  const select = (label: string, value: number, change: (index: number) => void) => (
    <label class="row">
      {label}
      <select value={String(value)} onChange={(event) => change(Number(event.currentTarget.value))}>
        {subjects.map((subject, index) => (
          <option key={keyOf(subject)} value={String(index)}>
            {subject.name}
          </option>
        ))}
      </select>
    </label>
  );
  return (
    <>
      {subjects.length > 2 && (
        <div class="row wrap">
          {select("Left", left, (index) => setPair([index, right]))}
          {select("Right", right, (index) => setPair([left, index]))}
        </div>
      )}
      <Swipe
        key={`${keyOf(subjects[left]!)} ${keyOf(subjects[right]!)}`}
        subjects={[subjects[left]!, subjects[right]!]}
        indices={[left, right]}
        time_s={time_s}
      />
    </>
  );
}

function Comparison({ subjects }: { subjects: Subject[] }) {
  const { query } = useAddress();
  const differences = useMemo(() => differencesOf(subjects.map(({ job }) => job.job as Json)), [subjects]);
  const end_s = Math.max(1, ...subjects.flatMap(({ runs }) => runs.map((run) => run.duration_s)));
  const time_s = Math.min(end_s, Math.max(0, Number(query.get("t") ?? 0) || 0));
  const onTime = (time: number) => navigate(addressOf(subjects, time), { replace: true });
  const hasSeveral = subjects.some(({ runs }) => runs.length > 1);
  return (
    <>
      <section class="card run-charts" aria-labelledby="curves">
        <h2 id="curves">Escaped by time</h2>
        {hasSeveral && <p class="quiet-text">Of several runs the median; bands are from the first to the third quartile.</p>}
        <Curves curves={subjects} time_s={time_s} onTime={onTime} />
        <div class="row time-row">
          <input
            type="range"
            aria-label="Time"
            aria-valuetext={`${time_s.toFixed(1)} s`}
            min={0}
            max={end_s}
            step={0.5}
            value={time_s}
            onInput={(event) => onTime(Number(event.currentTarget.value))}
          />
          <output>{time_s.toFixed(1)} s</output>
        </div>
      </section>
      <section aria-labelledby="figures">
        <h2 id="figures">Figures</h2>
        <FigureTable curves={subjects} />
        {hasSeveral && (
          <p class="quiet-text table-note">
            ± half the width of the mean's 95 % interval over the runs (Student's t). A figure that some run does not reach has no mean.
          </p>
        )}
      </section>
      <section aria-labelledby="images" class="swipe-section">
        <h2 id="images">Images at {time_s.toFixed(1)} s</h2>
        <SwipePair subjects={subjects} time_s={time_s} />
      </section>
      <section aria-labelledby="fields">
        <h2 id="fields">Different fields</h2>
        <Differences list={differences} names={subjects.map(({ name }) => name)} />
      </section>
    </>
  );
}

export function Compare() {
  const { query } = useAddress();
  const choices = choicesOf(query);
  const { compared, error } = useSubjects(choices);
  return (
    <div class="screen">
      <div class="heading">
        <h1>Compare</h1>
        <Chosen choices={choices} subjects={compared?.subjects ?? []} />
      </div>
      {error?.status !== 401 && <ErrorBox error={error} />}
      {choices.length < 2 && (
        <Empty title="Choose two to six finished jobs or runs">
          <a class="button" href="/jobs?state=succeeded&state=partial">
            Select jobs in their list
          </a>
        </Empty>
      )}
      {choices.length >= 2 && !compared && !error && <p class="loading">Loading …</p>}
      {choices.length >= 2 && compared && <Comparison subjects={compared.subjects} />}
    </div>
  );
}
