// The document of a new study: a preset, a file or a copy, checked by the service as it is typed.
import { useEffect, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson, sendJson } from "../api/client";
import type { Study, StudyPlan } from "../api/types";
import { type Draft, draftOf, type DraftPlace, forgetDraft, storedDraft, useCheck } from "../form/draft";
import { type Json, textOf } from "../form/json";
import type { JsonEditorProps } from "../form/json_editor";
import { ErrorBox, FileButton, Mistakes } from "../parts/elements";
import { countText } from "../parts/format";
import { Lazy } from "../parts/lazy";
import { navigate, usePlace, withQuery } from "../parts/router";
import { kPresets } from "./presets";

const kPlace: DraftPlace = { path: "/v1/studies?dry_run", storage: "throng.study" };
const loadEditor = () => import("../form/json_editor").then((module) => module.JsonEditor);

const firstDraft = () => storedDraft(kPlace.storage) ?? draftOf(textOf(kPresets[0]!.study));

function Sources({ onDraft }: { onDraft: (draft: Draft) => void }) {
  const [error, setError] = useState<string | null>(null);
  const readFile = async (file: File) => {
    const draft = draftOf(await file.text());
    setError(draft.value ? null : `${file.name} holds no JSON object`);
    if (draft.value) onDraft(draft);
  };
  const choose = (id: string) => onDraft(draftOf(textOf(kPresets.find((preset) => preset.id === id)!.study)));
  return (
    <div class="row wrap sources">
      <label class="row">
        Start from
        <select value="" onChange={(event) => choose(event.currentTarget.value)}>
          <option value="" disabled>
            a shipped study
          </option>
          {kPresets.map((preset) => (
            <option key={preset.id} value={preset.id}>
              {preset.title}
            </option>
          ))}
        </select>
      </label>
      <FileButton accept=".json,application/json" onFiles={([file]) => void readFile(file!)}>
        Open a file
      </FileButton>
      {error && (
        <span class="field-error" role="alert">
          {error}
        </span>
      )}
    </div>
  );
}

/** With `?from=ID` the document of another study, to be changed. */
export function NewStudy() {
  const { query } = usePlace();
  const from = query.get("from");
  const [draft, setDraft] = useState<Draft>(firstDraft);
  const [focus, setFocus] = useState<string | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const [isBusy, setBusy] = useState(false);
  const check = useCheck<StudyPlan>(draft, kPlace);
  useEffect(() => {
    if (!from) return;
    let isLatest = true;
    getJson<Study>(`/v1/studies/${from}`).then(
      (source) => {
        if (!isLatest) return;
        setDraft(draftOf(textOf((source.study ?? {}) as Json)));
        navigate(withQuery(new URLSearchParams(location.search), { from: null }), { replace: true });
      },
      (reason: unknown) => isLatest && setError(asApiError(reason)),
    );
    return () => {
      isLatest = false;
    };
  }, [from]);
  const submit = async () => {
    setBusy(true);
    try {
      const study = await sendJson<Study>("POST", "/v1/studies", draft.text);
      forgetDraft(kPlace.storage);
      navigate(`/studies/${study.id}`);
    } catch (reason) {
      setError(asApiError(reason));
      setBusy(false);
    }
  };
  const { plan, errors, message } = check;
  const editor: JsonEditorProps = { what: "The study", text: draft.text, errors, focus, onChange: (text) => setDraft(draftOf(text)) };
  return (
    <section class="stack" aria-labelledby="new-study">
      <div class="row wrap">
        <h2 id="new-study" class="grow">
          New study
        </h2>
        <Sources onDraft={setDraft} />
      </div>
      <Lazy load={loadEditor} props={editor} />
      <div class="submit-bar" role="region" aria-label="Check and start">
        <div class="grow" aria-live="polite">
          {check.isPending && !plan && errors.length === 0 && <span class="quiet-text">checking …</span>}
          {plan && (
            <>
              <strong>{countText(plan.simulations, "simulation")}</strong>: {countText(plan.cases.length, "case")} × {countText(plan.policies.length, "policy", "policies")} × {countText(plan.runs, "run")}
            </>
          )}
          {errors.length > 0 && (
            <details open>
              <summary class="field-error">{countText(errors.length, "error")}</summary>
              <Mistakes list={errors} onSelect={setFocus} />
            </details>
          )}
          {message && <span class="field-error">{message}</span>}
        </div>
        <button type="button" class="button primary" disabled={isBusy || !plan || check.isPending} onClick={() => void submit()}>
          Start the study
        </button>
        {error && error.status !== 401 && <ErrorBox error={error} />}
      </div>
    </section>
  );
}
