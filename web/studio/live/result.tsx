// The end of a flight: its pilot logs, and the job that repeats it.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, getJson } from "../api/client";
import type { LiveResult } from "../api/types";
import type { JsonObject } from "../form/json";
import { textOf } from "../form/json";
import { type Schema, withoutDefaults } from "../form/schema";
import { ErrorBox, Figures } from "../parts/elements";
import { bytesText } from "../parts/format";
import { navigate } from "../parts/router";

const csvAddress = (text: string) => `data:text/csv;charset=utf-8,${encodeURIComponent(text)}`;

export function FlightResult({ result, id }: { result: LiveResult; id: string }) {
  const [error, setError] = useState<ApiError | null>(null);
  const makeDataset = async () => {
    try {
      const schema = await getJson<Schema>("/v1/schema");
      sessionStorage.setItem("throng.draft", textOf(withoutDefaults(result.job as JsonObject, schema)));
      navigate("/new");
    } catch (reason) {
      setError(asApiError(reason));
    }
  };
  return (
    <div class="screen">
      <h1>Flight recorded</h1>
      <ErrorBox error={error && error.status !== 401 ? error : null} />
      <Figures
        list={[
          ["Duration", `${result.duration_s.toFixed(1)} s`],
          ["Steps", String(result.steps)],
          ["Drones", String(result.drones.length)],
        ]}
      />
      <div class="row wrap">
        <button type="button" class="button primary" onClick={() => void makeDataset()}>
          Make a dataset of this flight
        </button>
        {result.drones.map((drone) => (
          <a key={drone.id} class="button" href={csvAddress(drone.csv)} download={`${drone.id}.csv`}>
            Pilot log of {drone.id}
          </a>
        ))}
        {result.recording && result.recording.bytes > 0 && (
          <a class="button" href={`/v1/live/${id}/recording`} download>
            Recording (MCAP, {bytesText(result.recording.bytes)})
          </a>
        )}
        <a class="button" href="/fly">
          Fly again
        </a>
      </div>
      {result.recording?.problem && (
        <div class="notice warn">
          <p>
            The recording ends at {result.recording.complete_until_s.toFixed(1)} s: {result.recording.problem}.
          </p>
        </div>
      )}
      <p class="quiet-text measure">
        The job repeats the flight exactly: its trace has the SHA-256 <code class="wrap-anywhere">{result.trace_sha256}</code>. Flight {id}{" "}
        stays known for ten minutes.
      </p>
      {result.warnings.length > 0 && (
        <details>
          <summary>{result.warnings.length} warnings of the simulation</summary>
          <ul class="mistakes">
            {result.warnings.map((warning) => (
              <li key={warning}>{warning}</li>
            ))}
          </ul>
        </details>
      )}
    </div>
  );
}
