// Studies: those that there are, and a new one.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, request } from "../api/client";
import { useEvents } from "../api/events";
import { useInterval, useJson } from "../api/resource";
import type { Study, StudyList } from "../api/types";
import { ConnectionNote } from "../parts/connection";
import { Confirmation, Empty, ErrorBox, Progress, type Question, StateBadge } from "../parts/elements";
import { agoText } from "../parts/format";
import { useAddress, withQuery } from "../parts/router";
import { NewStudy } from "./new_study";

const kPollMs = 2000;

export const isAtWork = ({ state }: Study) => state === "queued" || state === "running";
export const removeStudy = (id: string) => request(`/v1/studies/${id}`, { method: "DELETE" });

export function removalOf(study: Study, confirm: () => void): Question {
  return {
    title: `Delete ${study.name}?`,
    text: "Its results are deleted. If it runs, it is ended.",
    action: "Delete the study",
    isDangerous: true,
    confirm,
  };
}

function StudyTable({ list, onRemove }: { list: Study[]; onRemove: (study: Study) => void }) {
  return (
    <table class="jobs">
      <thead>
        <tr>
          <th scope="col">Study</th>
          <th scope="col">State</th>
          <th scope="col">Runs</th>
          <th scope="col">Sent</th>
          <th scope="col">
            <span class="hidden">Actions</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {list.map((study) => {
          const { runs_done = 0, runs_total = 0 } = study.progress;
          return (
            <tr key={study.id} class="plain">
              <td class="name">
                <a href={`/studies/${study.id}`}>{study.name}</a>
              </td>
              <td>
                <StateBadge state={study.state} />
              </td>
              <td class="progress-cell">
                {runs_total > 0 && (
                  <>
                    <Progress done={runs_done} total={runs_total} label={`Runs of ${study.name}`} />
                    {runs_done} of {runs_total}
                  </>
                )}
              </td>
              <td>{agoText(study.created_at)}</td>
              <td>
                <a class="button small" href={`/studies?from=${study.id}`} aria-label={`Copy ${study.name}`}>
                  Copy
                </a>{" "}
                <button type="button" class="button small danger-text" aria-label={`Delete ${study.name}`} onClick={() => onRemove(study)}>
                  Delete
                </button>
              </td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

export function StudiesScreen() {
  const { query } = useAddress();
  const after = query.get("after");
  const list = useJson<StudyList>(`/v1/studies?limit=20${after ? `&after=${encodeURIComponent(after)}` : ""}`);
  const [question, setQuestion] = useState<Question | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const studies = list.value?.studies ?? [];
  const connection = useEvents("/v1/events", list.reload);
  useInterval(list.reload, studies.some(({ state }) => state === "running") ? kPollMs : 0);
  const remove = (study: Study) =>
    setQuestion(removalOf(study, () => void removeStudy(study.id).then(list.reload, (reason: unknown) => setError(asApiError(reason)))));
  return (
    <div class="screen">
      <div class="heading">
        <div class="row wrap">
          <h1 class="grow">Studies</h1>
          <ConnectionNote state={connection} />
        </div>
        <p class="quiet-text">Cases × policies × paired runs, simulated without images: what guidance changes, with intervals.</p>
      </div>
      <ErrorBox error={error ?? (list.error?.status !== 401 ? list.error : null)} />
      <section aria-labelledby="studies">
        <h2 id="studies">All studies</h2>
        {list.value && studies.length === 0 && <Empty title="No studies yet" />}
        {studies.length > 0 && <StudyTable list={studies} onRemove={remove} />}
        {(after || list.value?.next) && (
          <div class="row pages">
            {after && (
              <a class="button" href={withQuery(query, { after: null })}>
                Newest
              </a>
            )}
            {list.value?.next && (
              <a class="button" href={withQuery(query, { after: list.value.next })}>
                Older
              </a>
            )}
          </div>
        )}
      </section>
      <NewStudy studies={studies} />
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}
