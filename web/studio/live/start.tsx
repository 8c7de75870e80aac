// Start of a flight: the draft, a preset or a job; and flights that go on.
import { useState } from "preact/hooks";
import presets from "presets";
import { type ApiError, asApiError, getJson, sendJson } from "../api/client";
import { useJson } from "../api/resource";
import type { Job, JobList, LiveFlight } from "../api/types";
import { storedDraft } from "../form/draft";
import type { Json, JsonObject } from "../form/json";
import { ErrorBox } from "../parts/elements";
import { durationText } from "../parts/format";
import { navigate, useAddress } from "../parts/router";

const kPresets = presets as { file: string; job: JsonObject }[];
const kDraft = "draft";

async function jobOf(source: string): Promise<Json> {
  if (source === kDraft) return storedDraft()?.value ?? {};
  if (source.startsWith("clone=")) return (await getJson<Job>(`/v1/jobs/${source.slice(6)}`)).job as Json;
  const preset = kPresets.find((entry) => `preset=${entry.file}` === source);
  return preset?.job ?? {};
}

/** The source that the address names. */
function sourceIn(query: URLSearchParams): string {
  for (const name of ["clone", "preset"]) {
    const value = query.get(name);
    if (value) return `${name}=${value}`;
  }
  return storedDraft() ? kDraft : "preset=city_square/demo.job.json";
}

export function StartFlight() {
  const { query } = useAddress();
  const [source, setSource] = useState(() => sourceIn(query));
  const [error, setError] = useState<ApiError | null>(null);
  const [isBusy, setBusy] = useState(false);
  const [isRecorded, setRecorded] = useState(false);
  const jobs = useJson<JobList>("/v1/jobs?limit=20");
  const live = useJson<{ flights: LiveFlight[] }>("/v1/live");
  const flights = (live.value?.flights ?? []).filter((flight) => flight.state === "flying" || flight.state === "starting");
  const begin = async () => {
    setBusy(true);
    setError(null);
    try {
      const flight = await sendJson<LiveFlight>("POST", "/v1/live", JSON.stringify({ job: await jobOf(source), record: isRecorded }));
      navigate(`/fly?flight=${flight.id}`);
    } catch (reason) {
      setError(asApiError(reason));
      setBusy(false);
    }
  };
  return (
    <div class="screen">
      <h1>Live flight</h1>
      <p class="measure">
        Fly a job's drones through its crowd by keyboard, gamepad or touch. The flight is logged: afterwards a job repeats it exactly and
        makes a dataset of it.
      </p>
      <ErrorBox error={error && error.status !== 401 ? error : null} />
      <form
        class="row wrap"
        onSubmit={(event) => {
          event.preventDefault();
          void begin();
        }}
      >
        <label class="row wrap fly-source">
          Job
          <select value={source} onChange={(event) => setSource(event.currentTarget.value)}>
            {storedDraft() && <option value={kDraft}>the job that is being written (New job)</option>}
            <optgroup label="Presets">
              {kPresets.map((preset) => (
                <option key={preset.file} value={`preset=${preset.file}`}>
                  {String(preset.job["name"] ?? preset.file)} ({preset.file.replace(".job.json", "")})
                </option>
              ))}
            </optgroup>
            <optgroup label="Jobs">
              {(jobs.value?.jobs ?? []).map((job) => (
                <option key={job.id} value={`clone=${job.id}`}>
                  {job.name} ({job.id})
                </option>
              ))}
              {source.startsWith("clone=") && !(jobs.value?.jobs ?? []).some((job) => `clone=${job.id}` === source) && (
                <option value={source}>{source.slice(6)}</option>
              )}
            </optgroup>
          </select>
        </label>
        <label class="row">
          <input type="checkbox" checked={isRecorded} onChange={(event) => setRecorded(event.currentTarget.checked)} />
          Record as MCAP (ROS 2, Foxglove)
        </label>
        <button type="submit" class="button primary" disabled={isBusy}>
          {isBusy ? "Starting …" : "Fly"}
        </button>
      </form>
      {flights.length > 0 && (
        <section>
          <h2>Flights under way</h2>
          <ul class="plain-list">
            {flights.map((flight) => (
              <li key={flight.id}>
                <a href={`/fly?flight=${flight.id}`}>{flight.name || flight.id}</a>{" "}
                <span class="quiet-text">{durationText(flight.time_s)} flown</span>
              </li>
            ))}
          </ul>
        </section>
      )}
    </div>
  );
}
