// Whether the service can be reached. While it cannot, it is asked again and again; once it answers, whatever failed is fetched
// once more.
import { useEffect, useState } from "preact/hooks";
import { browserAddress } from "./base";

const kFirstPauseMs = 500;
const kMaxPauseMs = 5000;

let isLost = false;
const listeners = new Set<() => void>();
const returns = new Set<() => void>();

function change(value: boolean): void {
  isLost = value;
  listeners.forEach((listener) => listener());
}

async function waitForReturn(): Promise<void> {
  for (let pause = kFirstPauseMs; ; pause = Math.min(2 * pause, kMaxPauseMs)) {
    await new Promise((resolve) => setTimeout(resolve, pause));
    const answer = await fetch(browserAddress("/healthz"), { cache: "no-store" }).catch(() => null);
    if (answer?.ok) break;
  }
  change(false);
  returns.forEach((listener) => listener());
}

/** To be called when a request got no answer. */
export function noteUnreachable(): void {
  if (isLost) return;
  change(true);
  void waitForReturn();
}

/** Calls `listener` whenever the service is back. */
export function onReturn(listener: () => void): void {
  returns.add(listener);
}

export function useLost(): boolean {
  const [value, setValue] = useState(isLost);
  useEffect(() => {
    const listener = () => setValue(isLost);
    listeners.add(listener);
    listener();
    return () => void listeners.delete(listener);
  }, []);
  return value;
}
