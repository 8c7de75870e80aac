// Sources and destinations of blueprints: files, blueprints of the service, an upload.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, getJson, request, sendJson } from "../api/client";
import { useScenarios } from "../api/resource";
import type { Scenario, Upload } from "../api/types";
import { isObject, type Json, type JsonObject, textOf } from "../form/json";
import { ErrorBox, FileButton } from "../parts/elements";
import { kFirstBlueprint } from "./kinds";

const kStorage = "throng.blueprint";

export function storedBlueprint(): JsonObject {
  try {
    const stored = JSON.parse(sessionStorage.getItem(kStorage) ?? "null") as Json;
    return isObject(stored) ? stored : kFirstBlueprint;
  } catch {
    return kFirstBlueprint;
  }
}

export const storeBlueprint = (document: JsonObject) => sessionStorage.setItem(kStorage, JSON.stringify(document));

/** A word for files and ids, of the name of the blueprint. */
export function wordOf(document: JsonObject): string {
  const name = typeof document["name"] === "string" ? document["name"] : "";
  return (
    name
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, "_")
      .replace(/^_+|_+$/g, "")
      .slice(0, 40) || "place"
  );
}

const isShipped = (scenario: Scenario) => !scenario.error && !scenario.uploaded;

/** Opens a file, a blueprint of the service, or the first one again. */
export function OpenBar({ document, onOpen }: { document: JsonObject; onOpen: (document: JsonObject) => void }) {
  const list = useScenarios();
  const [error, setError] = useState<string | null>(null);
  const scenarios = list.value ?? [];
  const open = async (id: string) => {
    try {
      onOpen(id ? await getJson<JsonObject>(`/v1/scenarios/${id}?format=blueprint`) : kFirstBlueprint);
      setError(null);
    } catch (reason) {
      setError(`${id}: ${asApiError(reason).message}`);
    }
  };
  const readFile = async (file: File) => {
    try {
      const value = JSON.parse(await file.text()) as Json;
      if (!isObject(value)) throw new Error("it holds no JSON object");
      if (typeof value["extends"] === "string") throw new Error(`it extends ${value["extends"]}: open that, and change it`);
      onOpen(value);
      setError(null);
    } catch (reason) {
      setError(`${file.name} cannot be opened: ${asApiError(reason).message}`);
    }
  };
  const groups: [string, Scenario[]][] = [
    ["Uploads", scenarios.filter((scenario) => !scenario.error && scenario.uploaded)],
    ["Shipped scenarios", scenarios.filter(isShipped)],
  ];
  return (
    <div class="row wrap sources">
      <label class="row">
        Start from
        <select
          value="-"
          onChange={(event) => {
            const id = event.currentTarget.value;
            event.currentTarget.value = "-";
            void open(id);
          }}
        >
          <option value="-" disabled>
            a blueprint
          </option>
          <option value="">a small yard</option>
          {groups.map(([label, entries]) => (
            <optgroup key={label} label={label}>
              {entries.map((scenario) => (
                <option key={scenario.id} value={scenario.id}>
                  {scenario.name} ({scenario.id})
                </option>
              ))}
            </optgroup>
          ))}
        </select>
      </label>
      <FileButton accept=".json,application/json" onFiles={([file]) => void readFile(file!)}>
        Open a file
      </FileButton>
      <a
        class="button"
        href={`data:application/json,${encodeURIComponent(textOf(document))}`}
        download={`${wordOf(document)}.blueprint.json`}
      >
        Save as a file
      </a>
      {error && (
        <span class="field-error" role="alert">
          {error}
        </span>
      )}
    </div>
  );
}

interface UploadPanelProps {
  document: JsonObject;
  canUpload: boolean;
}

/** Uploads the blueprint as a scenario that jobs can name. */
export function UploadPanel({ document, canUpload }: UploadPanelProps) {
  const [own, setOwn] = useState<string | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const [made, setMade] = useState<{ upload: Upload; document: JsonObject } | null>(null);
  const [isBusy, setBusy] = useState(false);
  const name = own ?? wordOf(document);
  const upload = async (isReplaced: boolean) => {
    setBusy(true);
    try {
      if (isReplaced) await request(`/v1/scenarios/${name}`, { method: "DELETE" });
      setMade({
        upload: await sendJson<Upload>("POST", `/v1/scenarios?name=${encodeURIComponent(name)}`, JSON.stringify(document)),
        document,
      });
      setError(null);
    } catch (reason) {
      setError(asApiError(reason));
    }
    setBusy(false);
  };
  const id = made?.upload.ids?.[0];
  return (
    <section class="card summary" aria-labelledby="upload">
      <h2 id="upload">Use it</h2>
      <label class="field">
        <span class="field-name">Name for jobs</span>
        <input value={name} spellcheck={false} autocomplete="off" onInput={(event) => setOwn(event.currentTarget.value)} />
      </label>
      <div class="actions">
        <button type="button" class="button primary" disabled={isBusy || !canUpload} onClick={() => void upload(false)}>
          Upload
        </button>
        {(error?.status === 409 || (id && made?.document !== document)) && (
          <button type="button" class="button" disabled={isBusy || !canUpload} onClick={() => void upload(true)}>
            Replace the upload {name}
          </button>
        )}
      </div>
      {!canUpload && <p class="quiet-text">Errors in red have to be corrected first.</p>}
      <ErrorBox error={error && error.status !== 401 ? error : null} />
      {id && !error && (
        <div class="notice">
          <p role="status">
            Uploaded as <code>{id}</code>
          </p>
          <a class="button" href={`/new?scenario=${id}`}>
            Make a job
          </a>
        </div>
      )}
    </section>
  );
}
