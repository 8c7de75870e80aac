// State of the page of a live flight: what its stream says, what the pilot has chosen, how it ended.
import type { RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { type ApiError, asApiError } from "../api/client";
import type { LiveResult } from "../api/types";
import { type Action, Controls } from "./controls";
import { Connection, hovering, stopFlight } from "./flight";
import type { CameraImage, FlightEvent, Hello, World } from "./messages";

const kFigureMs = 250;
const kEventMs = 6000;

/** Figures of the flight, a few times a second. */
export interface Shown {
  world: World | null;
  delayMs: number | null;
  imagesPerS: number;
  hasGamepad: boolean;
}

/** The newest event, for a few seconds. */
function useNote() {
  const [note, setNote] = useState<FlightEvent | null>(null);
  useEffect(() => {
    if (!note) return;
    const timer = setTimeout(() => setNote(null), kEventMs);
    return () => clearTimeout(timer);
  }, [note]);
  return [note, setNote] as const;
}

const draw = (canvas: HTMLCanvasElement | null, image: CameraImage) =>
  void createImageBitmap(image.jpeg).then((bitmap) => {
    canvas?.getContext("2d")?.drawImage(bitmap, 0, 0);
    bitmap.close();
  });

/** The stream and the controls of a flight. `onEnd` receives an error or null; `act` is called for keys and buttons. */
function useStream(id: string, act: RefObject<(action: Action) => void>, onEnd: (error: string | null) => void) {
  const [hello, setHello] = useState<Hello | null>(null);
  const [isLost, setLost] = useState(false);
  const [note, setNote] = useNote();
  const [shown, setShown] = useState<Shown>({ world: null, delayMs: null, imagesPerS: 0, hasGamepad: false });
  const world = useRef<World | null>(null);
  const image = useRef<HTMLCanvasElement>(null);
  const connection = useRef<Connection | null>(null);
  const controls = useRef<Controls | null>(null);
  useEffect(() => {
    const pilot = (controls.current = new Controls((action) => act.current?.(action)));
    const flight = (connection.current = new Connection(id, pilot, {
      hello: setHello,
      world: (value) => (world.current = value),
      image: (value) => draw(image.current, value),
      event: setNote,
      lost: setLost,
      ended: (error) => {
        setLost(false);
        onEnd(error);
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
  return { hello, isLost, note, shown, world, image, connection, controls };
}

/** The pilot's choices. Each is sent as a command. */
function usePilot(hello: Hello | null, connection: RefObject<Connection | null>) {
  const [drone, setDrone] = useState(0);
  const [factor, setFactor] = useState(1);
  const [isPaused, setPaused] = useState(false);
  const [beacons, setBeacons] = useState<boolean[]>([]);
  const hasBeacon = beacons[drone] ?? false;
  return {
    drone,
    factor,
    isPaused,
    hasBeacon,
    choose: (index: number) => {
      if (!hello || !connection.current) return;
      connection.current.command({ ...hovering(hello.drones[drone]!.id), view: hello.drones[index]!.id });
      connection.current.drone = index;
      setDrone(index);
    },
    pause: (value: boolean) => {
      connection.current?.command({ paused: value });
      setPaused(value);
    },
    setSpeed: (value: number) => {
      connection.current?.command({ factor: value });
      setFactor(value);
    },
    switchBeacon: () => {
      if (!hello) return;
      connection.current?.command({ drones: [{ id: hello.drones[drone]!.id, beacon: !hasBeacon }] });
      setBeacons(hello.drones.map((_, index) => (index === drone ? !hasBeacon : (beacons[index] ?? false))));
    },
    goHome: () => hello && connection.current?.command({ drones: [{ id: hello.drones[drone]!.id, return_home: true }] }),
  };
}

export type Pilot = ReturnType<typeof usePilot>;

/** A flight: its stream, its pilot, and its end. `swapViews` is the page's part of the pilot's actions. */
export function useFlight(id: string, swapViews: () => void) {
  const [failure, setFailure] = useState<string | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const [result, setResult] = useState<LiveResult | null>(null);
  const [isStopping, setStopping] = useState(false);
  const act = useRef<(action: Action) => void>(() => {});
  const showResult = () =>
    stopFlight(id).then(
      (flight) => {
        setResult(flight.result ?? null);
        if (flight.error) setFailure(flight.error.message);
      },
      (reason: unknown) => setError(asApiError(reason)),
    );
  const stream = useStream(id, act, (message) => {
    if (message === null) void showResult();
    else setFailure(message);
  });
  const pilot = usePilot(stream.hello, stream.connection);
  act.current = (action) => {
    if (action === "pause") pilot.pause(!pilot.isPaused);
    else if (action === "beacon") pilot.switchBeacon();
    else if (action === "home") pilot.goHome();
    else if (action === "swap") swapViews();
    else if (stream.hello) pilot.choose((pilot.drone + 1) % stream.hello.drones.length);
  };
  const stop = async () => {
    setStopping(true);
    setError(null);
    await showResult();
    setStopping(false);
  };
  return { ...stream, pilot, failure, error, result, isStopping, stop };
}

export type FlightState = ReturnType<typeof useFlight>;
