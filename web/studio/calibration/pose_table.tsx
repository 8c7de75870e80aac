// Poses of the cameras in the frame of the control points.
import { type Camera, directionOf } from "./camera";

export function PoseTable({ camera }: { camera: Camera }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Poses of the cameras">
      <table>
        <thead>
          <tr>
            <th scope="col">Image</th>
            {["X", "Y", "Z"].map((axis) => (
              <th key={axis} scope="col" class="number">
                {axis}
              </th>
            ))}
            <th scope="col" class="number">
              Heading
            </th>
            <th scope="col" class="number">
              Pitch
            </th>
            <th scope="col" class="number">
              Points
            </th>
            <th scope="col" class="number">
              RMS
            </th>
          </tr>
        </thead>
        <tbody>
          {camera.views.map((view) => {
            const { heading, pitch } = directionOf(view.rotation_vector);
            return (
              <tr key={view.image}>
                <th scope="row">{view.image}</th>
                {view["camera_centre"].map((value, axis) => (
                  <td key={axis} class="number">
                    {value.toFixed(3)}
                  </td>
                ))}
                <td class="number">{heading.toFixed(2)}°</td>
                <td class="number">{pitch.toFixed(2)}°</td>
                <td class="number">{view.points}</td>
                <td class="number">{view.rms_px === null ? "–" : `${view.rms_px.toFixed(3)} px`}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
      <p class="quiet-text table-note">
        In the frame of the control points; the heading counts from +X to +Y, the pitch is negative below the level.
      </p>
    </div>
  );
}
