// The form of a job: presets and copies, three views of one state, checked by the service as it is typed.
import { useEffect, useMemo, useState } from "preact/hooks";
import presets from "presets";
import { type ApiError, asApiError, getJson, sendJson } from "../api/client";
import { useJson } from "../api/resource";
import type { DryRun, Job, JobList } from "../api/types";
import { AllFields } from "../form/all_fields";
import { Basic } from "../form/basic";
import { calibratedDraft } from "../form/calibrated";
import { DocumentViews, OpenDraft } from "../form/document_views";
import { type Check, changedDraft, type Draft, draftOf, type Form, forgetDraft, storedDraft, useCheck } from "../form/draft";
import { type JsonObject, textOf } from "../form/json";
import { type Schema, withoutDefaults } from "../form/schema";
import { ErrorBox, Mistakes } from "../parts/elements";
import { bytesText, countText, durationText, secondsBetween } from "../parts/format";
import { navigate, useAddress, withQuery } from "../parts/router";

const kPresets = presets as { file: string; job: JsonObject }[];
const kSources = ["clone", "preset", "calibration", "scenario"];
const kFirstPreset = "city_square/demo.job.json";

/** What belongs to the place of the draft: drones fly where the next one has its own. */
function withoutScenario(draft: Draft): Draft {
  return ["drones", "crowd"].reduce((next, key) => changedDraft(next, [key], undefined), draft);
}

/** The draft of this tab (with another place, or with a calibrated camera), a preset or a copy, as the address says. */
async function firstDraft(query: URLSearchParams, schema: Schema): Promise<Draft> {
  const clone = query.get("clone");
  if (clone) {
    const source = await getJson<Job>(`/v1/jobs/${clone}`);
    return draftOf(textOf(withoutDefaults(source.job as JsonObject, schema)));
  }
  const preset = kPresets.find((entry) => entry.file === query.get("preset"));
  if (preset) return draftOf(textOf(preset.job));
  const draft = storedDraft() ?? draftOf(textOf(kPresets.find((entry) => entry.file === kFirstPreset)!.job));
  const calibration = query.get("calibration");
  const scenario = query.get("scenario");
  if (scenario) return changedDraft(withoutScenario(draft), ["scenario"], scenario);
  return calibration ? calibratedDraft(draft, calibration) : draft;
}

/** What the service expects of the job, and how long it takes at the pace of jobs that were done lately. */
function Forecast({ plan }: { plan: DryRun }) {
  const list = useJson<JobList>("/v1/jobs?state=succeeded&limit=5");
  const done = (list.value?.jobs ?? []).filter((job) => (job.progress.frames_total ?? 0) > 0);
  const total = done.reduce((sum, job) => sum + (job.progress.frames_total ?? 0), 0);
  const seconds = done.reduce((sum, job) => sum + secondsBetween(job.started_at, job.ended_at), 0);
  const { cpu_s, disk_bytes, basis } = plan.estimate;
  return (
    <span class="quiet-text">
      about {durationText(Math.max(1, cpu_s))} of one core of {basis === "this machine" ? "this" : "the reference"} machine and{" "}
      {bytesText(disk_bytes)} of disk
      {total > 0 &&
        `; ${durationText(Math.max(1, (plan.frames * seconds) / total))} at the pace of ${done.length === 1 ? "the last job" : `the last ${done.length} jobs`}`}
    </span>
  );
}

interface SubmitBarProps {
  draft: Draft;
  check: Check;
  onErrors: (pointer: string) => void;
}

function SubmitBar({ draft, check, onErrors }: SubmitBarProps) {
  const [error, setError] = useState<ApiError | null>(null);
  const [isBusy, setBusy] = useState(false);
  const submit = async () => {
    setBusy(true);
    try {
      const job = await sendJson<Job>("POST", "/v1/jobs", draft.text);
      forgetDraft();
      navigate(`/jobs/${job.id}`);
    } catch (reason) {
      setError(asApiError(reason));
      setBusy(false);
    }
  };
  const { plan, errors, message } = check;
  return (
    <div class="submit-bar" role="region" aria-label="Check and submit">
      <div class="grow" aria-live="polite">
        {check.isPending && !plan && errors.length === 0 && <span class="quiet-text">checking …</span>}
        {plan && (
          <>
            <strong>{countText(plan.frames, "image")}</strong> in {countText(plan.runs, "run")} <Forecast plan={plan} />
          </>
        )}
        {plan && plan.warnings.length > 0 && (
          <details>
            <summary>{countText(plan.warnings.length, "warning")}</summary>
            <Mistakes list={plan.warnings} onSelect={onErrors} />
          </details>
        )}
        {errors.length > 0 && (
          <details>
            <summary class="field-error">{countText(errors.length, "error")}</summary>
            <Mistakes list={errors} onSelect={onErrors} />
          </details>
        )}
        {message && <span class="field-error">{message}</span>}
      </div>
      <button type="button" class="button primary" disabled={isBusy || !plan || check.isPending} onClick={submit}>
        Submit
      </button>
      {error && error.status !== 401 && <ErrorBox error={error} />}
    </div>
  );
}

interface EditorProps {
  draft: Draft;
  check: Check;
  schema: Schema;
  onDraft: (draft: Draft) => void;
}

function Editor({ draft, check, schema, onDraft }: EditorProps) {
  const views = [
    { id: "basic", label: "Basic", show: (form: Form) => <Basic form={form} schema={schema} /> },
    { id: "all", label: "All fields", show: (form: Form) => <AllFields form={form} schema={schema} /> },
  ];
  return (
    <DocumentViews
      what="The job"
      views={views}
      draft={draft}
      check={check}
      onDraft={onDraft}
      bar={(onErrors) => <SubmitBar draft={draft} check={check} onErrors={onErrors} />}
    />
  );
}

function Sources({ onDraft }: { onDraft: (draft: Draft) => void }) {
  const recent = useJson<JobList>("/v1/jobs?limit=10");
  return (
    <div class="row wrap sources">
      <label class="row">
        Start from
        <select value="" onChange={(event) => navigate(event.currentTarget.value)}>
          <option value="" disabled>
            a preset or a job
          </option>
          <optgroup label="Presets">
            {kPresets.map((preset) => (
              <option key={preset.file} value={`/new?preset=${encodeURIComponent(preset.file)}`}>
                {String(preset.job["name"] ?? preset.file)} ({preset.file.replace(".job.json", "")})
              </option>
            ))}
          </optgroup>
          <optgroup label="Copies of jobs">
            {(recent.value?.jobs ?? []).map((job) => (
              <option key={job.id} value={`/new?clone=${job.id}`}>
                {job.name} ({job.id})
              </option>
            ))}
          </optgroup>
        </select>
      </label>
      <OpenDraft onDraft={onDraft} />
    </div>
  );
}

export function NewJob() {
  const { query } = useAddress();
  const schema = useJson<Schema>("/v1/schema");
  const [draft, setDraft] = useState<Draft | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const check = useCheck(draft);
  const source = kSources.map((name) => query.get(name) ?? "").join(" ");
  useEffect(() => {
    // The schema comes again after a lost connection: the draft that is there counts.
    if (!schema.value || (draft && !source.trim())) return;
    let isLatest = true;
    firstDraft(query, schema.value).then(
      (next) => {
        if (!isLatest) return;
        setDraft(next);
        setError(null);
        // From here on the draft counts, also after a reload.
        if (source.trim()) {
          sessionStorage.setItem("throng.draft", next.text);
          navigate(withQuery(new URLSearchParams(location.search), Object.fromEntries(kSources.map((name) => [name, null]))), {
            replace: true,
          });
        }
      },
      (reason: unknown) => isLatest && setError(asApiError(reason)),
    );
    return () => {
      isLatest = false;
    };
  }, [schema.value, source.trim()]);
  const href = useMemo(() => `data:application/json,${encodeURIComponent(draft?.text ?? "")}`, [draft?.text]);
  return (
    <div class="screen new-job">
      <div class="row wrap heading">
        <h1 class="grow">New job</h1>
        {/* Before the first draft is there, it would replace the file that was opened. */}
        {(draft || error) && <Sources onDraft={setDraft} />}
        {draft && (
          <a class="button" href={href} download="job.json">
            Save as a file
          </a>
        )}
      </div>
      <ErrorBox error={error ?? (schema.error?.status !== 401 ? schema.error : null)} />
      {draft && schema.value && <Editor draft={draft} check={check} schema={schema.value} onDraft={setDraft} />}
    </div>
  );
}
