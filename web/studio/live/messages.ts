// Messages of a live flight (docs/studio.md): the type, the number of bytes, the bytes.
import { layouts, RecordLayout } from "../parts/layouts";

/** Where smoke rises from; it reaches farther as it grows. */
export interface Danger {
  kind: "explosion" | "fire" | "collapse" | "gas";
  position: [number, number];
  start_s: number;
  radius_m: number;
  growth_mps: number;
  max_radius_m: number;
}

export interface Hello {
  scenario: string;
  dt_s: number;
  max_s: number;
  people: number;
  roles: number[]; ///< 0 a person, 1 a hazard, 2 absent, 3 an attacker, 4 a spectator
  states: string[];
  drones: {
    id: string;
    start: [number, number, number];
    yaw_deg: number;
    leads: boolean;
    camera: { hfov_deg: number; pitch_deg: number; yaw_deg: number; is_rigid: boolean };
  }[];
  ground: { min: [number, number]; max: [number, number] };
  inside: { min: [number, number]; max: [number, number] };
  buildings: { id: string; footprint: [number, number][]; height_m: number }[];
  exits: { id: string; from: [number, number]; to: [number, number]; open: boolean }[];
  smoke: number; ///< how much of it rises, 0 to 1
  dangers: Danger[];
  image: { width: number; height: number };
  max_speed_mps: number;
  max_climb_mps: number;
  max_yaw_deg_s: number;
  max_gimbal_deg_s: number;
  min_pitch_deg: number;
  max_pitch_deg: number;
}

export interface DroneState {
  position: [number, number, number]; ///< m
  quaternion: [number, number, number, number]; ///< w, x, y, z; body to world
  yaw: number; ///< rad from +x
  speed: number; ///< m/s
  hasBeacon: boolean;
  isOnMission: boolean;
  isRunning: boolean;
  gimbalDeg: [number, number]; ///< pitch above the horizon, yaw to the left of the heading
}

export interface World {
  timeS: number;
  sequence: number;
  factor: number; ///< simulated seconds per second that are reached
  isPaused: boolean;
  drones: DroneState[];
  people: { x: Float32Array; y: Float32Array; yaw: Float32Array; state: Uint8Array; flags: Uint8Array };
}

export const { present: kPresent, panicked: kPanicked, fallen: kFallen, following: kFollowing } = layouts.agent_flags;

export interface CameraImage {
  timeS: number;
  sequence: number;
  drone: number;
  jpeg: Blob;
}

export interface FlightEvent {
  time_s: number;
  type: string;
  drone: string;
}

export type Message =
  | { type: "hello"; value: Hello }
  | { type: "world"; value: World }
  | { type: "image"; value: CameraImage }
  | { type: "event"; value: FlightEvent }
  | { type: "end"; error: string | null };

const kHeadBytes = 5; ///< of a message: its type and its length
const kTypes: Record<string, string> = layouts.live.message_types;
const kDroneFlags = layouts.live.drone_flags;

const kStateHead = new RecordLayout(layouts.live.state_head);
const kDrone = new RecordLayout(layouts.live.drone);
const kPerson = new RecordLayout(layouts.live.person);
const kImageHead = new RecordLayout(layouts.live.image_head);

function readDrone(view: DataView, at: number): DroneState {
  const number = (field: string, index = 0) => kDrone.read(view, at, field, index);
  const [w, x, y, z] = [0, 1, 2, 3].map((index) => number("quaternion", index)) as [number, number, number, number];
  const flags = number("flags");
  return {
    position: [number("position", 0), number("position", 1), number("position", 2)],
    quaternion: [w, x, y, z],
    yaw: Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    speed: number("speed_mps"),
    hasBeacon: (flags & kDroneFlags.beacon) !== 0,
    isOnMission: (flags & kDroneFlags.on_mission) !== 0,
    isRunning: (flags & kDroneFlags.running) !== 0,
    gimbalDeg: [number("gimbal_deg", 0), number("gimbal_deg", 1)],
  };
}

function worldOf(bytes: Uint8Array): World {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const droneCount = kStateHead.read(view, 0, "drones");
  const count = kStateHead.read(view, 0, "people");
  const drones = Array.from({ length: droneCount }, (_, index) => readDrone(view, kStateHead.bytes + kDrone.bytes * index));
  const people = {
    x: new Float32Array(count),
    y: new Float32Array(count),
    yaw: new Float32Array(count),
    state: new Uint8Array(count),
    flags: new Uint8Array(count),
  };
  for (let index = 0, at = kStateHead.bytes + kDrone.bytes * droneCount; index < count; ++index, at += kPerson.bytes) {
    people.x[index] = kPerson.read(view, at, "position", 0);
    people.y[index] = kPerson.read(view, at, "position", 1);
    people.yaw[index] = kPerson.read(view, at, "yaw") / layouts.live.yaw_parts;
    people.state[index] = kPerson.read(view, at, "state");
    people.flags[index] = kPerson.read(view, at, "flags");
  }
  return {
    timeS: kStateHead.read(view, 0, "time_s"),
    factor: kStateHead.read(view, 0, "factor"),
    sequence: kStateHead.read(view, 0, "sequence"),
    isPaused: (kStateHead.read(view, 0, "flags") & layouts.live.state_flags.paused) !== 0,
    drones,
    people,
  };
}

function imageOf(bytes: Uint8Array): CameraImage {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const jpeg = new Blob([bytes.slice(kImageHead.bytes)], { type: "image/jpeg" });
  const number = (field: string) => kImageHead.read(view, 0, field);
  return { timeS: number("time_s"), sequence: number("sequence"), drone: number("drone"), jpeg };
}

function messageOf(type: string, bytes: Uint8Array): Message | null {
  const name = kTypes[type];
  if (name === "state") return { type: "world", value: worldOf(bytes) };
  if (name === "image") return { type: "image", value: imageOf(bytes) };
  if (name === "alive") return null;
  const value = JSON.parse(new TextDecoder().decode(bytes));
  if (name === "hello") return { type: "hello", value: value as Hello };
  if (name === "event") return { type: "event", value: value as FlightEvent };
  return { type: "end", error: name === "failure" ? String(value.message) : null };
}

/** The messages of a stream until it ends. */
export async function* messagesOf(body: ReadableStream<Uint8Array>): AsyncGenerator<Message> {
  const reader = body.getReader();
  let pending = new Uint8Array(0);
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const joined = new Uint8Array(pending.length + value.length);
    joined.set(pending);
    joined.set(value, pending.length);
    let at = 0;
    while (joined.length - at >= kHeadBytes) {
      const length = new DataView(joined.buffer, at + 1, 4).getUint32(0, true);
      if (joined.length - at < kHeadBytes + length) break;
      const message = messageOf(String.fromCharCode(joined[at]!), joined.subarray(at + kHeadBytes, at + kHeadBytes + length));
      if (message) yield message;
      at += kHeadBytes + length;
    }
    pending = joined.slice(at);
  }
}
