// Positions of the points of all views in the image, their residuals, and the camera that follows from them.
import { type Camera, coveredCells, type FoundPoints, kColumns, kRows, type Parameter, parametersOf, valueText } from "./camera";

/** The image's area with all points; cells without points are shaded. */
export function CoverageFigure({ found, scale }: { found: FoundPoints; scale: number | null }) {
  const { width, height, views } = found;
  const cells = coveredCells(found);
  const covered = cells.filter(Boolean).length;
  const radius = width / 250;
  const points = views.flatMap((view) => view.points);
  return (
    <figure class="coverage">
      <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label={`${covered} of ${cells.length} parts of the image hold points`}>
        {cells.map((isCovered, cell) => (
          <rect
            key={cell}
            class={isCovered ? "cell-covered" : "cell-empty"}
            x={((cell % kColumns) * width) / kColumns}
            y={(Math.floor(cell / kColumns) * height) / kRows}
            width={width / kColumns}
            height={height / kRows}
            stroke-width={width / 800}
          />
        ))}
        {points.map(({ pixel: [u, v], residual_px, used }, index) => {
          const [du, dv] = residual_px ?? [null, null];
          return (
            <g key={index} class={used ? "board-point" : "board-outlier"}>
              <circle cx={u + 0.5} cy={v + 0.5} r={radius} />
              {scale !== null && used && du !== null && dv !== null && (
                <line x1={u + 0.5} y1={v + 0.5} x2={u + 0.5 + scale * du} y2={v + 0.5 + scale * dv} stroke-width={radius / 2} />
              )}
            </g>
          );
        })}
      </svg>
      <figcaption>
        {Math.round((100 * covered) / cells.length)} % of the image ({covered} of {cells.length} parts) hold points; the shaded parts hold
        none.
        {scale !== null && ` Residuals are drawn ${scale.toLocaleString("en-US")} times as long.`}
      </figcaption>
    </figure>
  );
}

function ParameterRow({ parameter }: { parameter: Parameter }) {
  const [value, deviation] = valueText(parameter);
  return (
    <tr>
      <th scope="row">
        <code>{parameter.name}</code>
      </th>
      <td class="number">{value}</td>
      <td class="number">{deviation}</td>
    </tr>
  );
}

export function ParameterTable({ camera }: { camera: Camera }) {
  return (
    <table class="compared">
      <thead>
        <tr>
          <th scope="col">Parameter</th>
          <th scope="col" class="number">
            Value
          </th>
          <th scope="col" class="number">
            Standard deviation
          </th>
        </tr>
      </thead>
      <tbody>
        {parametersOf(camera).map((parameter) => (
          <ParameterRow key={parameter.name} parameter={parameter} />
        ))}
      </tbody>
    </table>
  );
}

export function LensTable({ models }: { models: NonNullable<Camera["models"]> }) {
  return (
    <table class="compared">
      <caption class="quiet-text">All lenses, fitted to the same points; the one with the least BIC is taken.</caption>
      <thead>
        <tr>
          <th scope="col">Lens</th>
          <th scope="col" class="number">
            RMS
          </th>
          <th scope="col" class="number">
            BIC
          </th>
        </tr>
      </thead>
      <tbody>
        {models.map((model) => (
          <tr key={model.lens}>
            <th scope="row">{model.lens}</th>
            <td class="number">{model.rms_px.toFixed(4)} px</td>
            <td class="number">{model.bic.toFixed(1)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** RMS of each image as a bar; a click leads to the image. */
export function ResidualList({ camera, idOf }: { camera: Camera; idOf: (image: string) => string }) {
  const most = Math.max(...camera.views.map((view) => view.rms_px ?? 0), 1e-9);
  const show = (image: string) => {
    const figure = document.getElementById(idOf(image));
    figure?.scrollIntoView({ block: "center" });
    figure?.focus({ preventScroll: true });
  };
  return (
    <ul class="plain-list residual-list">
      {camera.views.map((view) => (
        <li key={view.image}>
          <button type="button" class="link" onClick={() => show(view.image)}>
            {view.image}
          </button>
          <span class="residual-bar" aria-hidden="true">
            <span style={{ width: `${(100 * (view.rms_px ?? 0)) / most}%` }} />
          </span>
          <span class="residual-value">
            {view.rms_px === null ? "–" : `${view.rms_px.toFixed(3)} px`}
            {view.outliers.length > 0 && `, ${view.outliers.length} left out`}
          </span>
        </li>
      ))}
    </ul>
  );
}
