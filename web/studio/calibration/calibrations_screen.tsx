// Calibrations: those that there are, and a new one from images of a board.
import { useEffect, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson, request } from "../api/client";
import { useInterval, useJson } from "../api/resource";
import type { Calibration, CalibrationList } from "../api/types";
import type { Schema } from "../form/schema";
import { Confirmation, Empty, ErrorBox, type Question, StateBadge, Tabs } from "../parts/elements";
import { agoText, countText } from "../parts/format";
import { navigate, useAddress, withQuery } from "../parts/router";
import { BoardFields } from "./board_fields";
import { ImageChoice } from "./image_choice";
import { PoseForm } from "./pose_form";
import {
  type ChosenImage,
  kMaxBytes,
  type Settings,
  sendCalibration,
  sentImages,
  settingsOf,
  storedSettings,
  storeSettings,
} from "./request";

const kPollMs = 2000;
const kMinImages = 2;
const kForms = [
  { id: "lens", label: "Lens, from images of a board" },
  { id: "poses", label: "Poses, from control points" },
];

export const removeCalibration = (id: string) => request(`/v1/calibrations/${id}`, { method: "DELETE" });
export const nameOf = (calibration: Calibration) => calibration.name || `calibration ${calibration.id}`;
export const isAtWork = ({ state }: Calibration) => state === "queued" || state === "running";

function imagesText(calibration: Calibration): string {
  const images = calibration.request["images"];
  return Array.isArray(images) ? countText(images.length, "image") : "a table of points";
}

/** With `?from=ID`, the settings and images of another calibration, to be changed. */
function NewCalibration({ schema }: { schema: Schema }) {
  const { query } = useAddress();
  const from = query.get("from");
  const [settings, setSettings] = useState<Settings>(storedSettings);
  const [images, setImages] = useState<ChosenImage[]>([]);
  const [error, setError] = useState<ApiError | null>(null);
  const [isBusy, setBusy] = useState(false);
  useEffect(() => {
    if (!from) return;
    let isLatest = true;
    const fetchAll = async () => {
      const source = await getJson<Calibration>(`/v1/calibrations/${from}`);
      const sent = await sentImages(source);
      if (!isLatest) return;
      setSettings(settingsOf(source.request));
      setImages(sent);
      navigate(withQuery(new URLSearchParams(location.search), { from: null }), { replace: true });
    };
    fetchAll().catch((reason: unknown) => isLatest && setError(asApiError(reason)));
    return () => {
      isLatest = false;
    };
  }, [from]);
  const change = (next: Partial<Settings>) => {
    const all = { ...settings, ...next };
    setSettings(all);
    storeSettings(all);
  };
  const submit = async (event: Event) => {
    event.preventDefault();
    setBusy(true);
    try {
      const calibration = await sendCalibration(settings, images);
      images.forEach((image) => URL.revokeObjectURL(image.url));
      navigate(`/calibrations/${calibration.id}`);
    } catch (reason) {
      setError(asApiError(reason));
      setBusy(false);
    }
  };
  const isTooLarge = images.reduce((sum, image) => sum + image.file.size, 0) > kMaxBytes;
  return (
    <form class="stack" aria-label="New calibration" onSubmit={submit}>
      <ImageChoice images={images} onChange={setImages} />
      <BoardFields settings={settings} schema={schema} errors={error?.errors ?? []} onChange={change} />
      {error && error.status !== 401 && <ErrorBox error={error} />}
      <div class="actions end">
        {images.length > 0 && images.length < kMinImages && (
          <span class="quiet-text">{kMinImages} different views are needed at least.</span>
        )}
        <button type="submit" class="button primary" disabled={isBusy || images.length === 0 || isTooLarge}>
          {isBusy ? "Sending …" : "Calibrate"}
        </button>
      </div>
    </form>
  );
}

interface TableProps {
  list: Calibration[];
  onRemove: (calibration: Calibration) => void;
}

function CalibrationTable({ list, onRemove }: TableProps) {
  return (
    <table class="jobs">
      <thead>
        <tr>
          <th scope="col">Camera</th>
          <th scope="col">State</th>
          <th scope="col">Input</th>
          <th scope="col">Sent</th>
          <th scope="col">
            <span class="hidden">Actions</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {list.map((calibration) => (
          <tr key={calibration.id} class="plain">
            <td class="name">
              <a href={`/calibrations/${calibration.id}`}>{nameOf(calibration)}</a>
            </td>
            <td>
              <StateBadge state={calibration.state} />
            </td>
            <td>{imagesText(calibration)}</td>
            <td>{agoText(calibration.created_at)}</td>
            <td>
              <button
                type="button"
                class="button small danger-text"
                aria-label={`Delete ${nameOf(calibration)}`}
                onClick={() => onRemove(calibration)}
              >
                Delete
              </button>
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function CalibrationsScreen() {
  const { query } = useAddress();
  const after = query.get("after");
  const form = query.get("form") === "poses" ? "poses" : "lens";
  const list = useJson<CalibrationList>(`/v1/calibrations?limit=20${after ? `&after=${encodeURIComponent(after)}` : ""}`);
  const [question, setQuestion] = useState<Question | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const calibrations = list.value?.calibrations ?? [];
  useInterval(list.reload, calibrations.some(isAtWork) ? kPollMs : 0);
  const remove = (calibration: Calibration) =>
    setQuestion({
      title: `Delete ${nameOf(calibration)}?`,
      text: "Its images and results are deleted. Jobs that were made with it keep the camera.",
      action: "Delete the calibration",
      isDangerous: true,
      confirm: () => void removeCalibration(calibration.id).then(list.reload, (reason: unknown) => setError(asApiError(reason))),
    });
  return (
    <div class="screen">
      <div class="heading">
        <h1>Calibrations of cameras</h1>
        <p class="quiet-text">Images of a board give the lens of a real camera, so that a dataset has exactly that camera.</p>
      </div>
      <ErrorBox error={error ?? (list.error?.status !== 401 ? list.error : null)} />
      {list.value && (
        <>
          <Tabs
            label="New calibration"
            tabs={kForms}
            selected={form}
            onSelect={(id) => navigate(withQuery(query, { form: id === "lens" ? null : id }), { replace: true })}
          />
          <div id="panel" role="tabpanel" aria-labelledby={`tab-${form}`}>
            {form === "lens" ? (
              <NewCalibration schema={list.value.schema as Schema} />
            ) : (
              <PoseForm calibrations={calibrations.filter((entry) => entry.state === "succeeded")} nameOf={nameOf} />
            )}
          </div>
        </>
      )}
      <section aria-labelledby="calibrations">
        <h2 id="calibrations">Calibrations</h2>
        {list.value && calibrations.length === 0 && <Empty title="No calibrations yet" />}
        {calibrations.length > 0 && <CalibrationTable list={calibrations} onRemove={remove} />}
        {(after || list.value?.next) && (
          <div class="row pages">
            {after && (
              <a class="button" href={withQuery(query, { after: null })}>
                Newest
              </a>
            )}
            {list.value?.next && (
              <a class="button" href={withQuery(query, { after: list.value.next })}>
                Older
              </a>
            )}
          </div>
        )}
      </section>
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}
