// The connection to a live flight: its stream, commands, and how long these take until they are seen.
import { ApiError, asApiError, request, sendJson } from "../api/client";
import type { LiveCommands, LiveFlight } from "../api/types";
import { type Controls, kRest, type Sticks } from "./controls";
import { type CameraImage, type FlightEvent, type Hello, type Message, messagesOf, type World } from "./messages";

const kSendMs = 50;
const kRepeatMs = 400; ///< of the flight: drones whose pilot says nothing for a second of it hover
const kRetryMs = 1000;
const kKeptDelays = 9;

export interface Listener {
  hello: (hello: Hello) => void;
  world: (world: World) => void;
  image: (image: CameraImage) => void;
  event: (event: FlightEvent) => void;
  /** Lost: the connection broke and is tried again. */
  lost: (isLost: boolean) => void;
  /** The flight has ended; an error, or nothing. */
  ended: (error: string | null) => void;
}

const median = (values: number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? null;
const isEqual = (a: Sticks, b: Sticks) => (Object.keys(a) as (keyof Sticks)[]).every((axis) => a[axis] === b[axis]);
const clamp = (value: number, min: number, max: number) => Math.max(min, Math.min(max, value));
const kMaxPanDeg = 180;
const kTurnDegS = 30; ///< of a camera whose key is held

export class Connection {
  private readonly controller = new AbortController();
  private sequence = 0;
  private readonly sentAt = new Map<number, number>();
  private readonly delays: number[] = [];
  private readonly arrivals: number[] = [];
  private isSending = false;
  private last: Sticks = kRest;
  private lastSent = 0;
  private timer = 0;
  private queued: LiveCommands = {};
  private world: World | null = null;
  private readonly aims = new Map<number, [number, number]>(); ///< commanded directions of cameras, by drone
  private lastLooked = 0;
  hello: Hello | null = null;
  drone = 0; ///< that is flown

  constructor(
    readonly id: string,
    private readonly controls: Controls,
    private readonly listener: Listener,
  ) {}

  start(): void {
    void this.read();
    this.timer = window.setInterval(() => this.fly(), kSendMs);
  }

  close(): void {
    clearInterval(this.timer);
    this.controller.abort();
  }

  /** Milliseconds from a command to the image that shows it, in the median; null: none yet. */
  delayMs(): number | null {
    return median(this.delays);
  }

  imagesPerSecond(): number {
    const now = performance.now();
    while (this.arrivals.length > 0 && now - this.arrivals[0]! > 2000) this.arrivals.shift();
    return this.arrivals.length / 2;
  }

  /** Goes out with the next commands. */
  command(commands: LiveCommands): void {
    const drones = [...(this.queued.drones ?? []), ...(commands.drones ?? [])];
    this.queued = { ...this.queued, ...commands, ...(drones.length > 0 ? { drones } : {}) };
    this.fly();
  }

  private async read(): Promise<void> {
    while (!this.controller.signal.aborted) {
      try {
        const response = await request(`/v1/live/${this.id}/stream`, { signal: this.controller.signal });
        this.listener.lost(false);
        for await (const message of messagesOf(response.body!)) {
          if (this.take(message)) return;
        }
      } catch (error) {
        if (this.controller.signal.aborted) return;
        if (error instanceof ApiError && error.status === 404) {
          return this.listener.ended("this flight has ended: nobody looked at it, it was removed, or the service was restarted");
        }
      }
      if (this.controller.signal.aborted) return;
      this.listener.lost(true);
      await new Promise((resolve) => setTimeout(resolve, kRetryMs));
    }
  }

  /** Whether the flight has ended. */
  private take(message: Message): boolean {
    switch (message.type) {
      case "hello":
        this.hello = message.value;
        this.listener.hello(message.value);
        return false;
      case "world":
        this.world = message.value;
        this.listener.world(message.value);
        return false;
      case "event":
        this.listener.event(message.value);
        return false;
      case "image":
        this.noteImage(message.value);
        this.listener.image(message.value);
        return false;
      case "end":
        this.close();
        this.listener.ended(message.error);
        return true;
    }
  }

  private noteImage(image: CameraImage): void {
    const now = performance.now();
    this.arrivals.push(now);
    for (const [sequence, at] of this.sentAt) {
      if (sequence > image.sequence) continue;
      this.sentAt.delete(sequence);
      this.delays.push(now - at);
      if (this.delays.length > kKeptDelays) this.delays.shift();
    }
  }

  /** Where the camera of the drone that is flown is to look, if a key that turns it is held. */
  private turnCamera(hello: Hello, sticks: Sticks, now: number): [number, number] | null {
    const seconds = Math.min(0.2, (now - this.lastLooked) / 1000);
    this.lastLooked = now;
    const { is_rigid: isRigid, pitch_deg: pitchDeg, yaw_deg: yawDeg } = hello.drones[this.drone]!.camera;
    if (isRigid || (sticks.tilt === 0 && sticks.pan === 0)) return null;
    const [pitch, yaw] = this.aims.get(this.drone) ?? this.world?.drones[this.drone]?.gimbalDeg ?? [pitchDeg, yawDeg];
    const aim: [number, number] = [
      clamp(pitch + kTurnDegS * seconds * sticks.tilt, hello.min_pitch_deg, hello.max_pitch_deg),
      clamp(yaw + kTurnDegS * seconds * sticks.pan, -kMaxPanDeg, kMaxPanDeg),
    ];
    this.aims.set(this.drone, aim);
    return aim;
  }

  /** One request at a time: what is newest counts. */
  private fly(): void {
    const hello = this.hello;
    const id = hello?.drones[this.drone]?.id;
    if (!hello || !id) return;
    const sticks = this.controls.read();
    const now = performance.now();
    const aim = this.turnCamera(hello, sticks, now);
    const isNew = aim !== null || !isEqual(sticks, this.last) || Object.keys(this.queued).length > 0;
    const isDue = now - this.lastSent > kRepeatMs / Math.max(1, this.world?.factor ?? 1) && !isEqual(sticks, kRest);
    if (this.isSending || (!isNew && !isDue)) return;
    const sequence = ++this.sequence;
    this.sentAt.set(sequence, now);
    const { drones = [], ...others } = this.queued;
    this.queued = {};
    this.last = sticks;
    this.lastSent = now;
    this.isSending = true;
    const speed = hello.max_speed_mps;
    const wish = {
      id,
      velocity_mps: [speed * sticks.ahead, speed * sticks.left, hello.max_climb_mps * sticks.up],
      yaw_rate_deg_s: hello.max_yaw_deg_s * sticks.turn,
      ...(aim ? { gimbal_deg: aim } : {}),
    };
    const body: LiveCommands = { ...others, sequence, drones: [...drones, wish] };
    void sendJson<void>("POST", `/v1/live/${this.id}/commands`, JSON.stringify(body), this.controller.signal)
      .catch((error: unknown) => {
        this.sentAt.delete(sequence);
        // The stream says what became of a flight that has ended.
        if (![0, 404, 409].includes(asApiError(error).status)) console.warn(error);
      })
      .finally(() => {
        this.isSending = false;
      });
  }
}

/** A drone that is not flown any more stops. */
export function hovering(id: string): LiveCommands {
  return { drones: [{ id, velocity_mps: [0, 0, 0], yaw_rate_deg_s: 0 }] };
}

export async function stopFlight(id: string): Promise<LiveFlight> {
  return sendJson<LiveFlight>("POST", `/v1/live/${id}/stop`);
}
