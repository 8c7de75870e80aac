// Before a study is started: its simulations, memory and expected time, or its mistakes.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, sendJson } from "../api/client";
import { useJson } from "../api/resource";
import type { Study, StudyList, StudyPlan } from "../api/types";
import { type Check, type Draft, type DraftTarget, forgetDraft } from "../form/draft";
import { ErrorBox, Mistakes } from "../parts/elements";
import { bytesText, countText, durationText, secondsBetween } from "../parts/format";
import { navigate } from "../parts/router";

const kMiB = 2 ** 20;

/** People times simulated seconds, which the time of a study goes with. */
export const workOf = (plan: StudyPlan) =>
  plan.people * plan.runs * plan.policies.length * plan.cases.reduce((sum, one) => sum + one.duration_s, 0);

/** As long as the newest finished study took for its work; runs that end early, and others' jobs, make it rough. */
function Forecast({ plan }: { plan: StudyPlan }) {
  const list = useJson<StudyList>("/v1/studies?limit=50");
  const last = list.value?.studies.find((study) => study.state === "succeeded");
  const done = useJson<Study>(last ? `/v1/studies/${last.id}` : null).value;
  if (!list.value) return null;
  if (!last) return <span class="quiet-text">. The time is estimated once a study has been done.</span>;
  if (!done?.plan) return null;
  const seconds = (secondsBetween(done.started_at, done.ended_at) * workOf(plan)) / Math.max(1, workOf(done.plan));
  return (
    <span class="quiet-text">
      , about {durationText(Math.max(1, seconds))}, judging by <a href={`/studies/${done.id}`}>{done.name}</a>
    </span>
  );
}

interface StartBarProps {
  draft: Draft;
  place: DraftTarget;
  check: Check<StudyPlan>;
  onErrors: (pointer: string) => void;
}

export function StartBar({ draft, place, check, onErrors }: StartBarProps) {
  const [error, setError] = useState<ApiError | null>(null);
  const [isBusy, setBusy] = useState(false);
  const submit = async () => {
    setBusy(true);
    try {
      const study = await sendJson<Study>("POST", "/v1/studies", draft.text);
      forgetDraft(place.storage);
      navigate(`/studies/${study.id}`);
    } catch (reason) {
      setError(asApiError(reason));
      setBusy(false);
    }
  };
  const { plan, errors, message } = check;
  return (
    <div class="submit-bar" role="region" aria-label="Check and start">
      <div class="grow" aria-live="polite">
        {check.isPending && !plan && errors.length === 0 && <span class="quiet-text">checking …</span>}
        {plan && (
          <>
            <strong>{countText(plan.simulations, "simulation")}</strong>: {countText(plan.cases.length, "case")} ×{" "}
            {countText(plan.policies.length, "policy", "policies")} × {countText(plan.runs, "run")}
            <span class="quiet-text">
              {" "}
              of at most {plan.people.toLocaleString("en-US")} people, {bytesText(plan.memory_mib * kMiB)} of memory each
            </span>
            <Forecast plan={plan} />
          </>
        )}
        {errors.length > 0 && (
          <details open>
            <summary class="field-error">{countText(errors.length, "error")}</summary>
            <Mistakes list={errors} onSelect={onErrors} />
          </details>
        )}
        {message && <span class="field-error">{message}</span>}
      </div>
      <button type="button" class="button primary" disabled={isBusy || !plan || check.isPending} onClick={() => void submit()}>
        Start the study
      </button>
      {error && error.status !== 401 && <ErrorBox error={error} />}
    </div>
  );
}
