// Parts of the page of a live flight.
import { ErrorBox, Figures } from "../parts/elements";
import { Lazy } from "../parts/lazy";
import type { Hello } from "./messages";
import { kColors } from "./people";
import { PlanView } from "./plan_view";
import type { FlightState, Pilot } from "./use_flight";
import { kViews, type Views } from "./use_views";

const loadScene = () => import("./scene_view").then((module) => module.SceneView);
const kFactors = [0.25, 0.5, 1, 2, 4];

const kEventTexts: Record<string, string> = {
  collision: "collided",
  near_miss: "came too near to something",
  battery_low: "has a low battery and lands",
  battery_flat: "has no charge left",
  landed: "has landed",
  propeller_broken: "has lost a propeller",
  structure_broken: "is broken",
  falling: "falls",
};

interface FlightProps {
  flight: FlightState;
}

export function FlightHeading({ flight }: FlightProps) {
  const isPaused = flight.pilot.isPaused || flight.shown.world?.isPaused;
  return (
    <div class="row wrap heading">
      <h1 class="grow">Live flight</h1>
      {flight.hello && !flight.failure && (
        <span class={isPaused ? "badge" : "badge recording"} role="status">
          {isPaused ? "paused" : "recording"}
        </span>
      )}
      {flight.hello && (
        <button
          type="button"
          class="button primary"
          disabled={flight.isStopping || !flight.shown.world?.timeS}
          onClick={() => void flight.stop()}
        >
          {flight.isStopping ? "Stopping …" : "Stop"}
        </button>
      )}
    </div>
  );
}

export function FlightNotices({ flight }: FlightProps) {
  const { hello, failure, error, isLost } = flight;
  return (
    <>
      <ErrorBox error={error && error.status !== 401 ? error : null} />
      {failure && (
        <div class="notice bad" role="alert">
          <p>The flight is over: {failure}.</p>
          <a class="button" href="/fly">
            Fly again
          </a>
        </div>
      )}
      {isLost && !failure && (
        <div class="notice warn" role="status">
          <p>The connection to the flight is lost; trying again. Drones hover meanwhile.</p>
        </div>
      )}
      {!hello && !failure && <p class="loading">The flight is starting: crowd, people and place are loaded …</p>}
    </>
  );
}

interface StageProps {
  hello: Hello;
  flight: FlightState;
  views: Views;
}

export function FlightStage({ hello, flight, views }: StageProps) {
  const { world, image, pilot } = flight;
  return (
    <div class="fly-stage">
      <div class={views.classOf("camera")}>
        <canvas
          ref={image}
          class="fly-canvas"
          width={hello.image.width}
          height={hello.image.height}
          role="img"
          aria-label={`Camera of ${hello.drones[pilot.drone]!.id}`}
        />
      </div>
      {views.isShown("scene") && (
        <div class={views.classOf("scene")}>
          <Lazy load={loadScene} props={{ hello, world, drone: pilot.drone }} />
        </div>
      )}
      <div class={views.classOf("plan")}>
        <PlanView hello={hello} world={world} drone={pilot.drone} />
      </div>
    </div>
  );
}

interface BarProps {
  hello: Hello;
  pilot: Pilot;
  views: Views;
}

function ViewButtons({ views }: { views: Views }) {
  return (
    <>
      <div class="row" role="group" aria-label="Large view">
        {kViews.map((view) => (
          <button
            key={view.id}
            type="button"
            class="button small"
            aria-pressed={views.main === view.id}
            onClick={() => views.select(view.id)}
          >
            {view.label}
          </button>
        ))}
      </div>
      <button type="button" class="button small" onClick={views.swap}>
        Swap views <kbd>V</kbd>
      </button>
    </>
  );
}

export function FlightBar({ hello, pilot, views }: BarProps) {
  return (
    <div class="row wrap fly-bar">
      <ViewButtons views={views} />
      {hello.drones.length > 1 && (
        <label class="row">
          Drone
          <select value={pilot.drone} onChange={(event) => pilot.choose(Number(event.currentTarget.value))}>
            {hello.drones.map((entry, index) => (
              <option key={entry.id} value={index}>
                {entry.id}
              </option>
            ))}
          </select>
        </label>
      )}
      <button type="button" class="button small" aria-pressed={pilot.hasBeacon} onClick={pilot.switchBeacon}>
        Beacon <kbd>B</kbd>
      </button>
      <button type="button" class="button small" onClick={pilot.goHome}>
        Return home <kbd>H</kbd>
      </button>
      <button type="button" class="button small" aria-pressed={pilot.isPaused} onClick={() => pilot.pause(!pilot.isPaused)}>
        Pause <kbd>P</kbd>
      </button>
      <label class="row">
        Speed
        <select value={pilot.factor} onChange={(event) => pilot.setSpeed(Number(event.currentTarget.value))}>
          {kFactors.map((value) => (
            <option key={value} value={value}>
              {value} ×
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}

export function FlightFigures({ hello, flight }: { hello: Hello; flight: FlightState }) {
  const { shown, note } = flight;
  const state = shown.world?.drones[flight.pilot.drone];
  return (
    <>
      <Figures
        list={[
          ["Time", `${(shown.world?.timeS ?? 0).toFixed(1)} of ${hello.max_s} s`],
          ["Height", state ? `${state.position[2].toFixed(1)} m` : "–"],
          ["Speed", state ? `${state.speed.toFixed(1)} m/s` : "–"],
          ["Camera", state ? `${state.gimbalDeg[0].toFixed(0)}°` : "–"],
          ["Latency", shown.delayMs === null ? "–" : `${Math.round(shown.delayMs)} ms`],
          ["Images", `${shown.imagesPerS.toFixed(0)} per s`],
          ["Real time", shown.world ? `${shown.world.factor.toFixed(2)} ×` : "–"],
          ["Gamepad", shown.hasGamepad ? "connected" : "none"],
        ]}
      />
      <p class="fly-note" aria-live="polite">
        {note && `${note.time_s.toFixed(1)} s: ${note.drone} ${kEventTexts[note.type] ?? note.type.replace(/_/g, " ")}`}
        {state && !state.isOnMission && " This drone does not fly any more."}
      </p>
    </>
  );
}

export function FlightHelp() {
  return (
    <>
      <p class="quiet-text">
        Keys: W S ahead and back, A D aside, ↑ ↓ up and down, ← → (or Q E) turn, R F tilt the camera, Z X turn it, B beacon, H home, P
        pause, V swap views, N next drone. Gamepad: left stick up and turn, right stick ahead and aside, directional pad camera, A beacon, B
        home, X swap, Y next drone, Start pause.
      </p>
      <ul class="legend fly-legend" aria-label="Colors of people">
        {Object.entries(kColors).map(([name, color]) => (
          <li key={name}>
            <svg width="12" height="12" aria-hidden="true">
              <circle cx="6" cy="6" r="5" fill={color} stroke="currentColor" />
            </svg>{" "}
            {name}
          </li>
        ))}
      </ul>
    </>
  );
}
