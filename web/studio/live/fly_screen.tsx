// Live flight: a drone is flown through the crowd; the service simulates and renders, this page steers and shows.
import { useEffect, useRef, useState } from "preact/hooks";
import { type ApiError, asApiError } from "../api/client";
import type { LiveResult } from "../api/types";
import { ErrorBox, Figures } from "../parts/elements";
import { Lazy } from "../parts/lazy";
import { useAddress } from "../parts/router";
import { type Action, Controls } from "./controls";
import { Connection, hovering, stopFlight } from "./flight";
import type { FlightEvent, Hello, World } from "./messages";
import { Pads } from "./pads";
import { kColors } from "./people";
import { PlanView } from "./plan_view";
import { FlightResult } from "./result";
import { StartFlight } from "./start";

const loadScene = () => import("./scene_view").then((module) => module.SceneView);
const kFactors = [0.25, 0.5, 1, 2, 4];
const kFigureMs = 250;
const kEventMs = 6000;

type View = "camera" | "scene" | "plan";
const kViews: { id: View; label: string }[] = [
  { id: "camera", label: "Camera" },
  { id: "scene", label: "3-D" },
  { id: "plan", label: "Plan" },
];

interface Shown {
  world: World | null;
  delayMs: number | null;
  imagesPerS: number;
  hasGamepad: boolean;
}

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

function Flight({ id }: { id: string }) {
  const [hello, setHello] = useState<Hello | null>(null);
  const [drone, setDrone] = useState(0);
  const [main, setMain] = useState<View>("camera");
  const [inset, setInset] = useState<View>("plan");
  const [factor, setFactor] = useState(1);
  const [isPaused, setPaused] = useState(false);
  const [beacons, setBeacons] = useState<boolean[]>([]);
  const [isLost, setLost] = useState(false);
  const [failure, setFailure] = useState<string | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const [result, setResult] = useState<LiveResult | null>(null);
  const [isStopping, setStopping] = useState(false);
  const [shown, setShown] = useState<Shown>({ world: null, delayMs: null, imagesPerS: 0, hasGamepad: false });
  const [note, setNote] = useState<FlightEvent | null>(null);
  const world = useRef<World | null>(null);
  const image = useRef<HTMLCanvasElement>(null);
  const connection = useRef<Connection | null>(null);
  const controls = useRef<Controls | null>(null);
  const act = useRef<(action: Action) => void>(() => {});

  const showResult = () =>
    stopFlight(id).then(
      (flight) => {
        setResult(flight.result ?? null);
        if (flight.error) setFailure(flight.error.message);
      },
      (reason: unknown) => setError(asApiError(reason)),
    );

  useEffect(() => {
    const pilot = (controls.current = new Controls((action) => act.current(action)));
    const flight = (connection.current = new Connection(id, pilot, {
      hello: (value) => {
        setHello(value);
        setBeacons((last) => (last.length > 0 ? last : value.drones.map(() => false)));
      },
      world: (value) => (world.current = value),
      image: (value) =>
        void createImageBitmap(value.jpeg).then((bitmap) => {
          image.current?.getContext("2d")?.drawImage(bitmap, 0, 0);
          bitmap.close();
        }),
      event: setNote,
      lost: setLost,
      ended: (message) => {
        setLost(false);
        if (message === null) void showResult();
        else setFailure(message);
      },
    }));
    flight.start();
    const unlisten = pilot.listen();
    const timer = setInterval(
      () =>
        setShown({ world: world.current, delayMs: flight.delayMs(), imagesPerS: flight.imagesPerSecond(), hasGamepad: pilot.hasGamepad }),
      kFigureMs,
    );
    return () => {
      clearInterval(timer);
      unlisten();
      flight.close();
    };
  }, [id]);

  useEffect(() => {
    if (!note) return;
    const timer = setTimeout(() => setNote(null), kEventMs);
    return () => clearTimeout(timer);
  }, [note]);

  const choose = (index: number) => {
    if (!hello || !connection.current) return;
    connection.current.command({ ...hovering(hello.drones[drone]!.id), view: hello.drones[index]!.id });
    connection.current.drone = index;
    setDrone(index);
  };
  const pause = (value: boolean) => {
    connection.current?.command({ paused: value });
    setPaused(value);
  };
  const setBeacon = (value: boolean) => {
    if (!hello) return;
    connection.current?.command({ drones: [{ id: hello.drones[drone]!.id, beacon: value }] });
    setBeacons(beacons.map((last, index) => (index === drone ? value : last)));
  };
  const goHome = () => hello && connection.current?.command({ drones: [{ id: hello.drones[drone]!.id, return_home: true }] });
  const swap = () => {
    setMain(inset);
    setInset(main);
  };
  act.current = (action) => {
    if (action === "pause") pause(!isPaused);
    else if (action === "beacon") setBeacon(!beacons[drone]);
    else if (action === "home") goHome();
    else if (action === "swap") swap();
    else if (hello) choose((drone + 1) % hello.drones.length);
  };
  const stop = async () => {
    setStopping(true);
    setError(null);
    await showResult();
    setStopping(false);
  };

  if (result) return <FlightResult result={result} id={id} />;
  const state = shown.world?.drones[drone];
  const place = (view: View) => (view === main ? "fly-main" : view === inset ? "fly-inset" : "hidden");
  const select = (view: View) => {
    if (view === inset) setInset(main);
    setMain(view);
  };
  return (
    <div class="screen fly">
      <div class="row wrap heading">
        <h1 class="grow">Live flight</h1>
        {hello && !failure && (
          <span class={isPaused || shown.world?.isPaused ? "badge" : "badge recording"} role="status">
            {isPaused || shown.world?.isPaused ? "paused" : "recording"}
          </span>
        )}
        {hello && (
          <button type="button" class="button primary" disabled={isStopping || !shown.world?.timeS} onClick={() => void stop()}>
            {isStopping ? "Stopping …" : "Stop"}
          </button>
        )}
      </div>
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
      {hello && (
        <>
          <div class="fly-stage">
            <div class={place("camera")}>
              <canvas
                ref={image}
                class="fly-canvas"
                width={hello.image.width}
                height={hello.image.height}
                role="img"
                aria-label={`Camera of ${hello.drones[drone]!.id}`}
              />
            </div>
            {(main === "scene" || inset === "scene") && (
              <div class={place("scene")}>
                <Lazy load={loadScene} props={{ hello, world, drone }} />
              </div>
            )}
            <div class={place("plan")}>
              <PlanView hello={hello} world={world} drone={drone} />
            </div>
          </div>
          <div class="row wrap fly-bar">
            <div class="row" role="group" aria-label="Large view">
              {kViews.map((view) => (
                <button key={view.id} type="button" class="button small" aria-pressed={main === view.id} onClick={() => select(view.id)}>
                  {view.label}
                </button>
              ))}
            </div>
            <button type="button" class="button small" onClick={swap}>
              Swap views <kbd>V</kbd>
            </button>
            {hello.drones.length > 1 && (
              <label class="row">
                Drone
                <select value={drone} onChange={(event) => choose(Number(event.currentTarget.value))}>
                  {hello.drones.map((entry, index) => (
                    <option key={entry.id} value={index}>
                      {entry.id}
                    </option>
                  ))}
                </select>
              </label>
            )}
            <button type="button" class="button small" aria-pressed={beacons[drone] ?? false} onClick={() => setBeacon(!beacons[drone])}>
              Beacon <kbd>B</kbd>
            </button>
            <button type="button" class="button small" onClick={goHome}>
              Return home <kbd>H</kbd>
            </button>
            <button type="button" class="button small" aria-pressed={isPaused} onClick={() => pause(!isPaused)}>
              Pause <kbd>P</kbd>
            </button>
            <label class="row">
              Speed
              <select
                value={factor}
                onChange={(event) => {
                  const value = Number(event.currentTarget.value);
                  setFactor(value);
                  connection.current?.command({ factor: value });
                }}
              >
                {kFactors.map((value) => (
                  <option key={value} value={value}>
                    {value} ×
                  </option>
                ))}
              </select>
            </label>
          </div>
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
          <Pads
            onLeft={(right, up) => controls.current && Object.assign(controls.current.touch, { turn: -right, up })}
            onCamera={(right, up) => controls.current && Object.assign(controls.current.touch, { pan: -right, tilt: up })}
            onRight={(right, up) => controls.current && Object.assign(controls.current.touch, { left: -right, ahead: up })}
          />
          <p class="quiet-text">
            Keys: W S ahead and back, A D aside, ↑ ↓ up and down, ← → (or Q E) turn, R F tilt the camera, Z X turn it, B beacon, H home, P
            pause, V swap views, N next drone. Gamepad: left stick up and turn, right stick ahead and aside, directional pad camera, A
            beacon, B home, X swap, Y next drone, Start pause.
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
      )}
    </div>
  );
}

export function FlyScreen() {
  const { query } = useAddress();
  const id = query.get("flight");
  return id && /^[a-z0-9]+$/.test(id) ? <Flight key={id} id={id} /> : <StartFlight />;
}
