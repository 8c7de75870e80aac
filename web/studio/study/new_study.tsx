// The document of a new study: a preset, a file or a copy; as fields and as JSON, checked by the service as it is typed.
import { useEffect, useMemo, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson } from "../api/client";
import { useJson } from "../api/resource";
import type { Study, StudyPlan } from "../api/types";
import { DocumentViews, OpenDraft } from "../form/document_views";
import { type Check, type Draft, type DraftTarget, draftOf, type Form, storedDraft, useCheck } from "../form/draft";
import { type Json, textOf } from "../form/json";
import type { Schema } from "../form/schema";
import { ErrorBox } from "../parts/elements";
import { navigate, useAddress, withQuery } from "../parts/router";
import { kPresets } from "./presets";
import { StartBar } from "./start_bar";
import { StudyForm } from "./study_form";
import { type StudySchema, withJobParts } from "./study_schema";

const kTarget: DraftTarget = { path: "/v1/studies?dry_run", storage: "throng.study" };

const firstDraft = () => storedDraft(kTarget.storage) ?? draftOf(textOf(kPresets[0]!.study));

function Sources({ studies, onDraft }: { studies: Study[]; onDraft: (draft: Draft) => void }) {
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
      <OpenDraft onDraft={onDraft} />
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

function Editor({ draft, check, onDraft }: EditorProps) {
  const schema = useSchema();
  const views = [{ id: "form", label: "Form", show: (form: Form) => schema && <StudyForm form={form} schema={schema} /> }];
  return (
    <DocumentViews
      what="The study"
      views={views}
      draft={draft}
      check={check}
      onDraft={onDraft}
      bar={(onErrors) => <StartBar draft={draft} place={kTarget} check={check} onErrors={onErrors} />}
    />
  );
}

/** With `?from=ID` the document of another study, to be changed. `studies`: those that can be copied. */
export function NewStudy({ studies }: { studies: Study[] }) {
  const { query } = useAddress();
  const from = query.get("from");
  const [draft, setDraft] = useState<Draft>(firstDraft);
  const [error, setError] = useState<ApiError | null>(null);
  const check = useCheck<StudyPlan>(draft, kTarget);
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
