// Messages of a live flight (docs/studio.md): the type, the number of bytes, the bytes.

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
  roles: number[]; ///< 0 a person, 1 a hazard, 2 absent, 3 an attacker
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

export const kPresent = 1;
export const kPanicked = 2;
export const kFallen = 4;
export const kFollowing = 8;

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

const kHeadBytes = 5;
const kStateHeadBytes = 24;
const kDroneBytes = 44;
const kPersonBytes = 12;
const kImageHeadBytes = 16;

function worldOf(bytes: Uint8Array): World {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const droneCount = view.getUint16(2, true);
  const count = view.getUint32(4, true);
  const drones = Array.from({ length: droneCount }, (_, index): DroneState => {
    const at = kStateHeadBytes + kDroneBytes * index;
    const number = (place: number) => view.getFloat32(at + 4 * place, true);
    const [w, x, y, z] = [number(3), number(4), number(5), number(6)];
    const flags = view.getUint32(at + 32, true);
    return {
      position: [number(0), number(1), number(2)],
      quaternion: [w, x, y, z],
      yaw: Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
      speed: number(7),
      hasBeacon: (flags & 1) !== 0,
      isOnMission: (flags & 2) !== 0,
      isRunning: (flags & 4) !== 0,
      gimbalDeg: [number(9), number(10)],
    };
  });
  const people = {
    x: new Float32Array(count),
    y: new Float32Array(count),
    yaw: new Float32Array(count),
    state: new Uint8Array(count),
    flags: new Uint8Array(count),
  };
  for (let index = 0, at = kStateHeadBytes + kDroneBytes * droneCount; index < count; ++index, at += kPersonBytes) {
    people.x[index] = view.getFloat32(at, true);
    people.y[index] = view.getFloat32(at + 4, true);
    people.yaw[index] = view.getInt16(at + 8, true) / 10_000;
    people.state[index] = view.getUint8(at + 10);
    people.flags[index] = view.getUint8(at + 11);
  }
  return {
    timeS: view.getFloat64(8, true),
    factor: view.getFloat32(16, true),
    sequence: view.getUint32(20, true),
    isPaused: (view.getUint8(1) & 1) !== 0,
    drones,
    people,
  };
}

function imageOf(bytes: Uint8Array): CameraImage {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const jpeg = new Blob([bytes.slice(kImageHeadBytes)], { type: "image/jpeg" });
  return { timeS: view.getFloat64(0, true), sequence: view.getUint32(8, true), drone: view.getUint32(12, true), jpeg };
}

function messageOf(type: string, bytes: Uint8Array): Message | null {
  if (type === "S") return { type: "world", value: worldOf(bytes) };
  if (type === "P") return { type: "image", value: imageOf(bytes) };
  if (type === "A") return null;
  const value = JSON.parse(new TextDecoder().decode(bytes));
  if (type === "H") return { type: "hello", value: value as Hello };
  if (type === "V") return { type: "event", value: value as FlightEvent };
  return { type: "end", error: type === "E" ? String(value.message) : null };
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
