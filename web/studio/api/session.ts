// Sign-in. A key is entered once; the service keeps it behind a cookie that scripts cannot read, so that images and
// downloads are plain addresses.
import { useEffect, useState } from "preact/hooks";
import { onReturn } from "./reach";
import type { Session as ServiceSession } from "./types";

export interface Session {
  /** Rises with each sign-in and when a lost service is back: whatever failed before is fetched again. */
  round: number;
  needsKey: boolean;
  /** Why a key is asked for; null: whatever is known so far is enough. */
  demand: string | null;
}

let session: Session = { round: 0, needsKey: false, demand: null };
const listeners = new Set<() => void>();

function change(next: Session): void {
  session = next;
  listeners.forEach((listener) => listener());
}

export function noteSession({ needs_key }: ServiceSession): void {
  if (session.needsKey !== needs_key) change({ ...session, needsKey: needs_key });
}

export function noteSignIn(): void {
  change({ round: session.round + 1, needsKey: true, demand: null });
}

export function demandKey(reason: string): void {
  if (session.demand !== reason) change({ ...session, needsKey: true, demand: reason });
}

onReturn(() => change({ ...session, round: session.round + 1 }));

export function useSession(): Session {
  const [value, setValue] = useState(session);
  useEffect(() => {
    const listener = () => setValue(session);
    listeners.add(listener);
    listener();
    return () => void listeners.delete(listener);
  }, []);
  return value;
}
