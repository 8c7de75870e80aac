// Controls of a pilot: keys, a gamepad and the pads of the page become one wish for the drone that is flown.

/** Shares of the most that the drone may do, -1 to 1. */
export interface Sticks {
  ahead: number;
  left: number;
  up: number;
  turn: number; ///< to the left
  tilt: number; ///< of the camera, up
  pan: number; ///< of the camera, to the left
}

export const kRest: Sticks = { ahead: 0, left: 0, up: 0, turn: 0, tilt: 0, pan: 0 };

type Axis = keyof Sticks;
const kKeys: Record<string, [Axis, number]> = {
  KeyW: ["ahead", 1],
  KeyS: ["ahead", -1],
  KeyA: ["left", 1],
  KeyD: ["left", -1],
  ArrowUp: ["up", 1],
  ArrowDown: ["up", -1],
  ArrowLeft: ["turn", 1],
  ArrowRight: ["turn", -1],
  KeyQ: ["turn", 1],
  KeyE: ["turn", -1],
  KeyR: ["tilt", 1],
  KeyF: ["tilt", -1],
  KeyZ: ["pan", 1],
  KeyX: ["pan", -1],
};

export type Action = "beacon" | "home" | "pause" | "swap" | "next";
const kActions: Record<string, Action> = { KeyB: "beacon", KeyH: "home", KeyP: "pause", KeyV: "swap", KeyN: "next" };
/** The directional pad of the standard gamepad: up, down, left, right. */
const kPadButtons: [number, Axis, number][] = [
  [12, "tilt", 1],
  [13, "tilt", -1],
  [14, "pan", 1],
  [15, "pan", -1],
];
/** Buttons of the standard gamepad: A, B, X, Y and Start. */
const kButtons: [number, Action][] = [
  [0, "beacon"],
  [1, "home"],
  [2, "swap"],
  [3, "next"],
  [9, "pause"],
];
const kDeadZone = 0.12;

/** Small deflections of a stick that nobody holds do not count. */
function deflection(value: number | undefined): number {
  const size = Math.abs(value ?? 0);
  return size < kDeadZone ? 0 : (Math.sign(value!) * (size - kDeadZone)) / (1 - kDeadZone);
}

function isField(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && (target.isContentEditable || ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName));
}

const clamped = (value: number) => Math.max(-1, Math.min(1, value));

export class Controls {
  private readonly held = new Set<string>();
  private readonly pressed = new Set<number>();
  /** What the pads of the page say. */
  touch: Sticks = { ...kRest };
  hasGamepad = false;

  constructor(private readonly onAction: (action: Action) => void) {}

  /** Listens until the returned function is called. */
  listen(): () => void {
    const down = (event: KeyboardEvent) => {
      if (event.ctrlKey || event.metaKey || event.altKey || isField(event.target) || document.querySelector("dialog[open]")) return;
      const action = kActions[event.code];
      if (!kKeys[event.code] && !action) return;
      event.preventDefault();
      if (action && !event.repeat) this.onAction(action);
      this.held.add(event.code);
    };
    const up = (event: KeyboardEvent) => this.held.delete(event.code);
    const release = () => this.held.clear();
    addEventListener("keydown", down);
    addEventListener("keyup", up);
    addEventListener("blur", release);
    return () => {
      removeEventListener("keydown", down);
      removeEventListener("keyup", up);
      removeEventListener("blur", release);
    };
  }

  /** The sticks now; buttons of the gamepad that have been pressed since the last call act. */
  read(): Sticks {
    const sticks = { ...this.touch };
    for (const code of this.held) {
      const key = kKeys[code];
      if (key) sticks[key[0]] += key[1];
    }
    const pad = [...navigator.getGamepads()].find((entry) => entry?.connected && entry.mapping === "standard");
    this.hasGamepad = Boolean(pad);
    if (pad) {
      // As most remote controls: left stick up and turn, right stick ahead and aside.
      sticks.turn -= deflection(pad.axes[0]);
      sticks.up -= deflection(pad.axes[1]);
      sticks.left -= deflection(pad.axes[2]);
      sticks.ahead -= deflection(pad.axes[3]);
      for (const [button, axis, sign] of kPadButtons) {
        if (pad.buttons[button]?.pressed) sticks[axis] += sign;
      }
      for (const [button, action] of kButtons) {
        const isDown = pad.buttons[button]?.pressed ?? false;
        const isNew = isDown && !this.pressed.has(button);
        // Before it acts: an action sends commands, which read the sticks again.
        if (isDown) this.pressed.add(button);
        else this.pressed.delete(button);
        if (isNew) this.onAction(action);
      }
    }
    for (const axis of Object.keys(sticks) as Axis[]) sticks[axis] = clamped(sticks[axis]);
    return sticks;
  }
}
