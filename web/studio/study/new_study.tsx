// The document of a new study: a preset, a file or a copy; as fields and as JSON, checked by the service as it is typed.
import { useEffect, useMemo, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson } from "../api/client";
import { useJson } from "../api/resource";
import type { Study, StudyPlan } from "../api/types";
import { changedDraft, type Check, type Draft, draftOf, type DraftPlace, type Form, storedDraft, useCheck } from "../form/draft";
import { idOf } from "../form/field";
import { type Json, textOf } from "../form/json";
import type { JsonEditorProps } from "../form/json_editor";
import type { Schema } from "../form/schema";
import { ErrorBox, FileButton, Tabs } from "../parts/elements";
import { Lazy } from "../parts/lazy";
import { navigate, usePlace, withQuery } from "../parts/router";
import { kPresets } from "./presets";
import { StartBar } from "./start_bar";
import { StudyForm } from "./study_form";
import { type StudySchema, withJobParts } from "./study_schema";

const kPlace: DraftPlace = { path: "/v1/studies?dry_run", storage: "throng.study" };
const loadEditor = () => import("../form/json_editor").then((module) => module.JsonEditor);

const firstDraft = () => storedDraft(kPlace.storage) ?? draftOf(textOf(kPresets[0]!.study));

function Sources({ studies, onDraft }: { studies: Study[]; onDraft: (draft: Draft) => void }) {
  const [error, setError] = useState<string | null>(null);
  const readFile = async (file: File) => {
    const draft = draftOf(await file.text());
    setError(draft.value ? null : `${file.name} holds no JSON object`);
    if (draft.value) onDraft(draft);
  };
  const choose = (id: string) => {
    const preset = kPresets.find((entry) => entry.id === id);
    const study = preset?.study ?? studies.find((entry) => entry.id === id)?.study;
    if (study) onDraft(draftOf(textOf(study as Json)));
  };
  return (
    <div class="row wrap sources">
      <label class="row">
        Start from
        <select value="" onChange={(event) => choose(event.currentTarget.value)}>
          <option value="" disabled>
            a shipped study or a copy
          </option>
          <optgroup label="Shipped studies">
            {kPresets.map((preset) => (
              <option key={preset.id} value={preset.id}>
                {preset.title}
              </option>
            ))}
          </optgroup>
          <optgroup label="Copies of studies">
            {studies.map((study) => (
              <option key={study.id} value={study.id}>
                {study.name} ({study.id})
              </option>
            ))}
          </optgroup>
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

function useSchema(): Schema | null {
  const study = useJson<StudySchema>("/v1/schemas/study").value;
  const job = useJson<Schema>("/v1/schema").value;
  return useMemo(() => (study && job ? withJobParts(study, job) : null), [study, job]);
}

interface EditorProps {
  draft: Draft;
  check: Check<StudyPlan>;
  onDraft: (draft: Draft) => void;
}

/** Two views of one draft. */
function Editor({ draft, check, onDraft }: EditorProps) {
  const { query } = usePlace();
  const schema = useSchema();
  const [focus, setFocus] = useState<string | null>(null);
  const tab = query.get("tab") === "json" ? "json" : "form";
  const select = (id: string) => navigate(withQuery(query, { tab: id === "form" ? null : id }), { replace: true });
  const form: Form = { value: draft.value ?? {}, errors: check.errors, change: (path, value) => onDraft(changedDraft(draft, path, value)) };
  const showError = (pointer: string) => {
    setFocus(pointer);
    const field = tab === "form" ? document.getElementById(idOf(pointer.split("/").slice(1))) : null;
    if (field) {
      field.scrollIntoView({ block: "center" });
      field.focus();
    } else select("json");
  };
  const editor: JsonEditorProps = { what: "The study", text: draft.text, errors: check.errors, focus, onChange: (text) => onDraft(draftOf(text)) };
  const tabs = [
    { id: "form", label: "Form" },
    { id: "json", label: <>JSON{check.errors.length > 0 && <span class="count">{check.errors.length}</span>}</> },
  ];
  return (
    <>
      <Tabs label="Views of the study" tabs={tabs} selected={tab} onSelect={select} />
      <div id="panel" role="tabpanel" aria-labelledby={`tab-${tab}`}>
        {tab === "json" ? (
          <Lazy load={loadEditor} props={editor} />
        ) : draft.value === null ? (
          <div class="notice bad">
            <p>The text is not a JSON object, so it cannot be shown as fields.</p>
            <button type="button" class="button" onClick={() => select("json")}>
              Go to the text
            </button>
          </div>
        ) : (
          schema && <StudyForm form={form} schema={schema} />
        )}
      </div>
      <StartBar draft={draft} place={kPlace} check={check} onErrors={showError} />
    </>
  );
}

/** With `?from=ID` the document of another study, to be changed. `studies`: those that can be copied. */
export function NewStudy({ studies }: { studies: Study[] }) {
  const { query } = usePlace();
  const from = query.get("from");
  const [draft, setDraft] = useState<Draft>(firstDraft);
  const [error, setError] = useState<ApiError | null>(null);
  const check = useCheck<StudyPlan>(draft, kPlace);
  useEffect(() => {
    if (!from) return;
    let isLatest = true;
    getJson<Study>(`/v1/studies/${from}`).then(
      (source) => {
        if (!isLatest) return;
        setDraft(draftOf(textOf((source.study ?? {}) as Json)));
        navigate(withQuery(new URLSearchParams(location.search), { from: null }), { replace: true });
        document.getElementById("new-study")?.scrollIntoView();
      },
      (reason: unknown) => isLatest && setError(asApiError(reason)),
    );
    return () => {
      isLatest = false;
    };
  }, [from]);
  const href = useMemo(() => `data:application/json,${encodeURIComponent(draft.text)}`, [draft.text]);
  return (
    <section class="stack" aria-labelledby="new-study">
      <div class="row wrap">
        <h2 id="new-study" class="grow">
          New study
        </h2>
        <Sources studies={studies} onDraft={setDraft} />
        <a class="button" href={href} download="study.json">
          Save as a file
        </a>
      </div>
      {error && error.status !== 401 && <ErrorBox error={error} />}
      <Editor draft={draft} check={check} onDraft={setDraft} />
    </section>
  );
}
