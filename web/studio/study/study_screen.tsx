// One study: its grid that fills, the differences to the baseline, times, and whether there are runs enough.
import { useEffect, useState } from "preact/hooks";
import { ApiError, asApiError, sendJson } from "../api/client";
import { useEvents } from "../api/events";
import { useInterval, useJson } from "../api/resource";
import type { Study, StudyPlan, StudyValues } from "../api/types";
import { ConnectionNote } from "../parts/connection";
import { Confirmation, ErrorBox, Mistakes, Progress, type Question, StateBadge } from "../parts/elements";
import { countText, durationText, timeText } from "../parts/format";
import { navigate } from "../parts/router";
import { Convergence } from "./convergence";
import { Forest } from "./forest";
import { StudyGrid } from "./grid";
import { isAtWork, removalOf, removeStudy } from "./studies_screen";
import { TimesTable } from "./times_table";

const kPollMs = 3000;

interface ActionsProps {
  study: Study;
  onChange: () => void;
  onError: (error: ApiError) => void;
}

function Actions({ study, onChange, onError }: ActionsProps) {
  const [question, setQuestion] = useState<Question | null>(null);
  const { id, links, state } = study;
  const failed = (reason: unknown) => onError(asApiError(reason));
  const post = (action: string) => void sendJson<Study>("POST", `/v1/studies/${id}/${action}`).then(onChange, failed);
  const remove = () => setQuestion(removalOf(study, () => void removeStudy(id).then(() => navigate("/studies"), failed)));
  const keep = () => void sendJson<Study>("PATCH", `/v1/studies/${id}`, JSON.stringify({ keep: !study.keep })).then(onChange, failed);
  const files = `/v1/studies/${id}/files`;
  return (
    <div class="actions">
      {isAtWork(study) && (
        <button type="button" class="button" onClick={() => post("cancel")}>
          Cancel
        </button>
      )}
      {(state === "failed" || state === "cancelled") && (
        <button type="button" class="button primary" onClick={() => post("retry")}>
          Go on
        </button>
      )}
      <button type="button" class="button" aria-pressed={study.keep} onClick={keep}>
        {study.keep ? "Kept" : "Keep"}
      </button>
      {links["report"] && (
        <>
          <a class="button primary" href={links["report"]} target="_blank" rel="noreferrer">
            Report
          </a>
          {["summary.csv", "summary.json", "summary.md", "values.json"].map((name) => (
            <a key={name} class="button" href={`${files}/${name}`} download={`${id}_${name}`}>
              {name}
            </a>
          ))}
        </>
      )}
      <a class="button" href={`/studies?from=${id}`}>
        Change and repeat
      </a>
      <button type="button" class="button danger-text" onClick={remove}>
        Delete
      </button>
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}

function State({ study, plan }: { study: Study; plan: StudyPlan }) {
  const { progress } = study;
  const done = progress.runs_done ?? 0;
  const left = progress.remaining_s;
  return (
    <div class="card summary">
      <Progress done={done} total={plan.simulations} label="Finished runs" />
      <p aria-live="polite">
        {study.state === "running" ? `${progress.stage ?? "starting"}: ` : ""}
        {done.toLocaleString("en-US")} of {countText(plan.simulations, "run")}
        {study.state === "running" && typeof left === "number" && left > 0 && `, about ${durationText(left)} left`}
        {study.ended_at && `, ended ${timeText(study.ended_at)}`}
        {study.waiting_for && `; waits: ${study.waiting_for}`}
      </p>
    </div>
  );
}

function Results({ study, plan, values }: { study: Study; plan: StudyPlan; values: StudyValues | null }) {
  const summary = study.summary ?? null;
  return (
    <>
      <section aria-labelledby="runs">
        <h2 id="runs">Runs</h2>
        <StudyGrid study={study} plan={plan} summary={summary} />
        <p class="quiet-text table-note">
          Finished runs; below, the mean of the times up to the longer horizon, of the runs that every policy of the case has.
        </p>
      </section>
      {summary && summary.rows.length > 0 && (
        <>
          <section aria-labelledby="differences">
            <h2 id="differences">Difference to the baseline</h2>
            <Forest plan={plan} summary={summary} />
          </section>
          <section aria-labelledby="times">
            <h2 id="times">Times</h2>
            <TimesTable plan={plan} summary={summary} />
            <p class="quiet-text table-note">
              Medians [quartiles] over the runs, from the later of alarm and arrival. Left inside: unhurt at the end, mean.
            </p>
          </section>
        </>
      )}
      {values && (
        <section aria-labelledby="convergence">
          <h2 id="convergence">Convergence</h2>
          <Convergence plan={plan} values={values} />
          <p class="quiet-text table-note">
            Mean of the first runs with its 95 % interval (Student's t). A mean that still drifts wants more runs.
          </p>
        </section>
      )}
    </>
  );
}

export function StudyScreen({ id }: { id: string }) {
  const resource = useJson<Study>(`/v1/studies/${id}`);
  const [error, setError] = useState<ApiError | null>(null);
  const study = resource.value;
  const hasValues = Boolean(study?.summary);
  const values = useJson<StudyValues>(hasValues ? `/v1/studies/${id}/files/values.json` : null);
  const [live, setLive] = useState<Study["progress"] | null>(null);
  const isWorking = Boolean(study && isAtWork(study));
  const connection = useEvents(isWorking ? `/v1/studies/${id}/events` : null, ({ type, data }) => {
    if (type === "progress") setLive(JSON.parse(data) as Study["progress"]);
    else resource.reload();
  });
  useEffect(() => setLive(null), [isWorking]);
  // The summary is renewed as runs end; events tell the rest.
  useInterval(resource.reload, isWorking ? kPollMs : 0);
  // The values are those of the summary, and much larger.
  const runs = study?.summary?.rows.reduce((sum, row) => sum + row.runs, 0) ?? 0;
  useEffect(() => values.reload(), [runs, study?.state]);
  if (!study) {
    if (resource.error?.status === 404) {
      return (
        <ErrorBox error={new ApiError(404, `There is no study ${id}: it has been removed, or the address is wrong.`)}>
          <a class="button" href="/studies">
            All studies
          </a>
        </ErrorBox>
      );
    }
    return resource.error && resource.error.status !== 401 ? <ErrorBox error={resource.error} /> : <p class="loading">Loading …</p>;
  }
  const plan = study.plan!;
  const shown = isWorking && live ? { ...study, progress: live } : study;
  return (
    <div class="screen">
      <div class="heading">
        <p class="breadcrumb">
          <a href="/studies">Studies</a> / {id}
        </p>
        <div class="row wrap">
          <h1>{study.name}</h1>
          <StateBadge state={study.state} />
          {isWorking && <ConnectionNote state={connection} />}
        </div>
        <Actions study={study} onChange={resource.reload} onError={setError} />
      </div>
      <ErrorBox error={error} />
      {study.error && (
        <div class="notice bad" role="alert">
          <p>{study.error.message}</p>
          <Mistakes list={study.error.problems} />
        </div>
      )}
      <State study={shown} plan={plan} />
      <Results study={shown} plan={plan} values={values.value} />
    </div>
  );
}
