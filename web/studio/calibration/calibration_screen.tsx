// One calibration: progress, points found in its images, the camera, and what limits its accuracy.
import { useState } from "preact/hooks";
import { ApiError, asApiError } from "../api/client";
import { useInterval, useJson } from "../api/resource";
import type { Calibration, Mistake } from "../api/types";
import { Confirmation, ErrorBox, Figures, Mistakes, Progress, type Question, StateBadge } from "../parts/elements";
import { countText } from "../parts/format";
import { navigate } from "../parts/router";
import { isAtWork, nameOf, removeCalibration } from "./calibrations_screen";
import { type Camera, type FoundPoints, residualScale } from "./camera";
import { CoverageFigure, LensTable, ParameterTable, ResidualList } from "./figures";
import { PoseTable } from "./pose_table";
import { imagePath } from "./request";
import { ViewFigure } from "./view_figure";
import { warningText } from "./warnings";

const kPollMs = 700;
const kPercent = 1000;
const idOf = (image: string) => `view-${image.replace(/[^A-Za-z0-9]/g, "-")}`;
const imagesOf = (calibration: Calibration) => (calibration.request["images"] ?? []) as string[];

/** Of a file that the service names by its path or by its name. */
const isAbout = (mistake: Mistake, image: string) => (mistake.source ?? "").split("/").at(-1) === image;

function Actions({ calibration, onError }: { calibration: Calibration; onError: (error: ApiError) => void }) {
  const [question, setQuestion] = useState<Question | null>(null);
  const { id, links } = calibration;
  const remove = () =>
    setQuestion({
      title: `Delete ${nameOf(calibration)}?`,
      text: "Its images and results are deleted. Jobs that were made with it keep the camera.",
      action: "Delete the calibration",
      isDangerous: true,
      confirm: () =>
        void removeCalibration(id).then(
          () => navigate("/calibrations"),
          (error: unknown) => onError(asApiError(error)),
        ),
    });
  return (
    <div class="actions">
      {calibration.state === "succeeded" && (
        <a class="button primary" href={`/new?calibration=${id}`}>
          Use in a job
        </a>
      )}
      {imagesOf(calibration).length > 0 && (
        <a class="button" href={`/calibrations?from=${id}`}>
          Change and repeat
        </a>
      )}
      {links["camera"] && (
        <>
          <a class="button" href={links["camera"]} download={`${id}.json`}>
            Camera (JSON)
          </a>
          <a class="button" href={links["opencv"]} download={`${id}.opencv.yaml`}>
            OpenCV
          </a>
          <a class="button" href={links["ros"]} download={`${id}.ros.yaml`}>
            ROS
          </a>
        </>
      )}
      <button type="button" class="button danger-text" onClick={remove}>
        Delete
      </button>
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}

function Result({ camera, found }: { camera: Camera; found: FoundPoints | null }) {
  const figures: [string, string][] = [
    ["size", `${camera.width} × ${camera.height} px`],
    ["lens", camera.lens],
    ["RMS", camera.rms_px === null ? "–" : `${camera.rms_px.toFixed(4)} px`],
    ["of a coordinate (σ)", camera.sigma_px === null ? "–" : `${camera.sigma_px.toFixed(4)} px`],
    ["views", String(camera.views.length)],
    ["points", camera.points.toLocaleString("en-US")],
    ["outliers", camera.outliers.toLocaleString("en-US")],
    ["coverage", `${Math.round(100 * camera.coverage)} %`],
  ];
  return (
    <>
      <div class="card summary">
        <Figures list={figures} />
      </div>
      {camera.warnings.length > 0 && (
        <div class="notice warn">
          <strong>{countText(camera.warnings.length, "warning")}</strong>
          <ul class="mistakes">
            {camera.warnings.map((warning) => (
              <li key={warning}>{warningText(warning)}</li>
            ))}
          </ul>
        </div>
      )}
      {camera.kind && camera.kind !== "intrinsics" && (
        <section aria-labelledby="poses">
          <h2 id="poses">Poses</h2>
          <PoseTable camera={camera} />
        </section>
      )}
      <div class="calibration-result">
        <section aria-labelledby="parameters" class="stack">
          <h2 id="parameters">Camera</h2>
          <ParameterTable camera={camera} />
          {camera.models && <LensTable models={camera.models} />}
        </section>
        {found && (
          <section aria-labelledby="coverage" class="stack">
            <h2 id="coverage">Coverage and residuals</h2>
            <CoverageFigure found={found} scale={residualScale(camera)} />
            <ResidualList camera={camera} idOf={idOf} />
          </section>
        )}
      </div>
    </>
  );
}

interface ViewsProps {
  calibration: Calibration;
  camera: Camera | null;
  found: FoundPoints | null;
  mistakes: Mistake[];
}

function Views({ calibration, camera, found, mistakes }: ViewsProps) {
  const sent = imagesOf(calibration);
  const names = sent.length > 0 ? sent : (found?.views ?? []).map((view) => view.image);
  const size: [number, number] = found ? [found.width, found.height] : [4, 3];
  return (
    <div class="cards board-views">
      {names.map((image) => {
        const view = found?.views.find((entry) => entry.image.split("/").at(-1) === image);
        const mistake = mistakes.find((entry) => isAbout(entry, image));
        return (
          <ViewFigure
            key={image}
            id={idOf(image)}
            image={image}
            path={sent.length > 0 ? imagePath(calibration.id, image) : null}
            points={view?.points ?? null}
            size={size}
            scale={camera ? residualScale(camera) : 1}
            rmsPx={camera?.views.find((entry) => entry.image === view?.image)?.rms_px ?? null}
            {...(mistake ? { reason: mistake.found ? `found ${mistake.found}, expected ${mistake.expected}` : mistake.message } : {})}
          />
        );
      })}
    </div>
  );
}

export function CalibrationScreen({ id }: { id: string }) {
  const resource = useJson<Calibration>(`/v1/calibrations/${id}`);
  const [error, setError] = useState<ApiError | null>(null);
  const calibration = resource.value;
  const isActive = calibration !== null && isAtWork(calibration);
  useInterval(resource.reload, isActive ? kPollMs : 0);
  // Found points are there before the camera, and also if nothing can be estimated from them.
  const points = useJson<FoundPoints>(calibration && !isActive ? `/v1/calibrations/${id}/points` : null);
  if (!calibration) {
    if (resource.error?.status === 404) {
      return (
        <ErrorBox error={new ApiError(404, `There is no calibration ${id}: it has been removed, or the address is wrong.`)}>
          <a class="button" href="/calibrations">
            All calibrations
          </a>
        </ErrorBox>
      );
    }
    return resource.error && resource.error.status !== 401 ? <ErrorBox error={resource.error} /> : <p class="loading">Loading …</p>;
  }
  const camera = (calibration.camera ?? null) as Camera | null;
  const problems = calibration.error?.problems ?? [];
  const mistakes = [...(camera?.left_out ?? []), ...problems];
  const images = imagesOf(calibration);
  const others = problems.filter((problem) => !images.some((image) => isAbout(problem, image)));
  const progress = calibration.progress as { share?: number; stage?: string };
  return (
    <div class="screen">
      <div class="heading">
        <p class="breadcrumb">
          <a href="/calibrations">Calibrations</a> / <code>{id}</code>
        </p>
        <div class="row wrap">
          <h1>{nameOf(calibration)}</h1>
          <StateBadge state={calibration.state} />
        </div>
        <Actions calibration={calibration} onError={setError} />
      </div>
      <ErrorBox error={error ?? (resource.error && resource.error.status !== 401 ? resource.error : null)} />
      {isActive && (
        <div class="card summary" aria-live="polite">
          <p>{calibration.waiting_for ? `Waits: ${calibration.waiting_for}` : (progress.stage ?? "looking for the board")}</p>
          <Progress done={Math.round(kPercent * (progress.share ?? 0))} total={kPercent} label="progress" />
        </div>
      )}
      {calibration.error && (
        <div class="notice bad" role="alert">
          <p>{calibration.error.message}</p>
          <Mistakes list={others} />
        </div>
      )}
      {camera && <Result camera={camera} found={points.value} />}
      <section aria-labelledby="views">
        <h2 id="views">Images</h2>
        <Views calibration={calibration} camera={camera} found={points.value} mistakes={mistakes} />
      </section>
    </div>
  );
}
