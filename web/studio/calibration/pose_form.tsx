// Poses of cameras from control points that are seen in their images, and a bundle that estimates the lens along with them.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, request } from "../api/client";
import type { Calibration } from "../api/types";
import { ErrorBox, FileButton } from "../parts/elements";
import { navigate } from "../parts/router";

const kTables = [
  { key: "gcp", label: "Control points", columns: "point,X,Y,Z, and sd where it is known", accept: ".csv,text/csv" },
  { key: "observations", label: "Observations", columns: "image,point,u,v", accept: ".csv,text/csv" },
] as const;
type Table = "gcp" | "observations" | "camera";

interface FileFieldProps {
  id: string;
  label: string;
  note: string;
  accept: string;
  file: File | null;
  onFile: (file: File) => void;
}

function FileField({ id, label, note, accept, file, onFile }: FileFieldProps) {
  return (
    <div class="field" role="group" aria-labelledby={id}>
      <span class="field-name" id={id}>
        {label}
      </span>
      <div class="row wrap">
        <FileButton accept={accept} onFiles={(files) => onFile(files[0]!)}>
          Choose {label.toLowerCase()}
        </FileButton>
        <span class="quiet-text">{file?.name ?? note}</span>
      </div>
    </div>
  );
}

interface PoseFormProps {
  /** Those with a camera. */
  calibrations: Calibration[];
  nameOf: (calibration: Calibration) => string;
}

export function PoseForm({ calibrations, nameOf }: PoseFormProps) {
  const [files, setFiles] = useState<Partial<Record<Table, File>>>({});
  const [from, setFrom] = useState("");
  const [name, setName] = useState("");
  const [isBundle, setBundle] = useState(false);
  const [error, setError] = useState<ApiError | null>(null);
  const [isBusy, setBusy] = useState(false);
  const set = (key: Table, file: File) => setFiles((known) => ({ ...known, [key]: file }));
  const send = async () => {
    const camera = from ? await (await request(`/v1/calibrations/${from}/camera`)).blob() : files.camera!;
    const form = new FormData();
    const named = { camera: "camera.json", gcp: "control_points.csv", observations: "observations.csv" };
    form.append("request", JSON.stringify({ kind: isBundle ? "bundle" : "pose", ...(name.trim() ? { name: name.trim() } : {}), ...named }));
    form.append("file", camera, named.camera);
    for (const { key } of kTables) form.append("file", files[key]!, named[key]);
    return (await request("/v1/calibrations", { method: "POST", body: form })).json() as Promise<Calibration>;
  };
  const submit = (event: Event) => {
    event.preventDefault();
    setBusy(true);
    send().then(
      (calibration) => navigate(`/calibrations/${calibration.id}`),
      (reason: unknown) => {
        setError(asApiError(reason));
        setBusy(false);
      },
    );
  };
  const isReady = kTables.every(({ key }) => files[key]) && (from !== "" || files.camera !== undefined);
  return (
    <form class="stack" aria-label="New poses" onSubmit={submit}>
      <fieldset class="stack">
        <legend>Control points and camera</legend>
        <p class="quiet-text">
          Surveyed points whose pixels are known in images of a camera give where it was and how it was turned: 4 points in an image at
          least.
        </p>
        {kTables.map(({ key, label, columns, accept }) => (
          <FileField
            key={key}
            id={`file-${key}`}
            label={label}
            note={`a table (CSV) with the columns ${columns}`}
            accept={accept}
            file={files[key] ?? null}
            onFile={(file) => set(key, file)}
          />
        ))}
        <label class="field">
          <span class="field-name">Camera</span>
          <select value={from} onChange={(event) => setFrom(event.currentTarget.value)}>
            <option value="">from a file</option>
            {calibrations.map((calibration) => (
              <option key={calibration.id} value={calibration.id}>
                {nameOf(calibration)}
              </option>
            ))}
          </select>
        </label>
        {from === "" && (
          <FileField
            id="file-camera"
            label="Camera file"
            note="a calibration's camera (JSON), or ROS', OpenCV's, Kalibr's or COLMAP's file"
            accept=".json,.yaml,.yml,.xml,.txt,.bin"
            file={files.camera ?? null}
            onFile={(file) => set("camera", file)}
          />
        )}
        <div class="fields">
          <label class="field">
            <span class="field-name">Name of the result</span>
            <input type="text" autocomplete="off" value={name} onInput={(event) => setName(event.currentTarget.value)} />
          </label>
          <label class="row check-field">
            <input type="checkbox" checked={isBundle} onChange={(event) => setBundle(event.currentTarget.checked)} />
            Estimate the lens and unknown points, too (bundle adjustment)
          </label>
        </div>
      </fieldset>
      {error && error.status !== 401 && <ErrorBox error={error} />}
      <div class="actions end">
        <button type="submit" class="button primary" disabled={isBusy || !isReady}>
          {isBusy ? "Sending …" : "Estimate poses"}
        </button>
      </div>
    </form>
  );
}
