// A document that is being written: views of fields, and its JSON, all of one draft; below them what the service says of it.
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { FileButton, Tabs } from "../parts/elements";
import { Lazy } from "../parts/lazy";
import { navigate, useAddress, withQuery } from "../parts/router";
import { type Check, changedDraft, type Draft, draftOf, type Form } from "./draft";
import { idOf } from "./field";
import type { JsonEditorProps } from "./json_editor";

const loadEditor = () => import("./json_editor").then((module) => module.JsonEditor);

interface View {
  id: string;
  label: string;
  show: (form: Form) => ComponentChildren;
}

interface DocumentViewsProps<Plan> {
  what: string; ///< "The job"
  views: View[]; ///< the first one is shown where the address names none
  draft: Draft;
  check: Check<Plan>;
  onDraft: (draft: Draft) => void;
  bar: (onError: (pointer: string) => void) => ComponentChildren; ///< leads to the place of an error
}

/** The address names the view. */
export function DocumentViews<Plan>({ what, views, draft, check, onDraft, bar }: DocumentViewsProps<Plan>) {
  const { query } = useAddress();
  const [focus, setFocus] = useState<string | null>(null);
  const first = views[0]!.id;
  const tab = query.get("tab") ?? first;
  const view = views.find(({ id }) => id === tab);
  const select = (id: string) => navigate(withQuery(query, { tab: id === first ? null : id }), { replace: true });
  const form: Form = { value: draft.value ?? {}, errors: check.errors, change: (path, value) => onDraft(changedDraft(draft, path, value)) };
  const showError = (pointer: string) => {
    setFocus(pointer);
    const field = view && document.getElementById(idOf(pointer.split("/").slice(1)));
    if (field) {
      field.scrollIntoView({ block: "center" });
      field.focus();
    } else select("json");
  };
  const editor: JsonEditorProps = { what, text: draft.text, errors: check.errors, focus, onChange: (text) => onDraft(draftOf(text)) };
  const tabs = [...views, { id: "json", label: <>JSON{check.errors.length > 0 && <span class="count">{check.errors.length}</span>}</> }];
  return (
    <>
      <Tabs label={`Views of ${what.toLowerCase()}`} tabs={tabs} selected={view ? tab : "json"} onSelect={select} />
      <div id="panel" role="tabpanel" aria-labelledby={`tab-${view ? tab : "json"}`}>
        {!view ? (
          <Lazy load={loadEditor} props={editor} />
        ) : draft.value === null ? (
          <div class="notice bad">
            <p>The text is not a JSON object, so it cannot be shown as fields.</p>
            <button type="button" class="button" onClick={() => select("json")}>
              Go to the text
            </button>
          </div>
        ) : (
          view.show(form)
        )}
      </div>
      {bar(showError)}
    </>
  );
}

/** Opens a file with a JSON object as the draft. */
export function OpenDraft({ onDraft }: { onDraft: (draft: Draft) => void }) {
  const [error, setError] = useState<string | null>(null);
  const readFile = async (file: File) => {
    const draft = draftOf(await file.text());
    setError(draft.value ? null : `${file.name} holds no JSON object`);
    if (draft.value) onDraft(draft);
  };
  return (
    <>
      <FileButton accept=".json,application/json" onFiles={([file]) => void readFile(file!)}>
        Open a file
      </FileButton>
      {error && (
        <span class="field-error" role="alert">
          {error}
        </span>
      )}
    </>
  );
}
