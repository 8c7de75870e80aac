// Values of the service as hooks.
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { type ApiError, asApiError, getJson } from "./client";
import { useSession } from "./session";
import type { Scenario, ScenarioList } from "./types";

export interface Resource<T> {
  value: T | null;
  error: ApiError | null;
  reload: () => void;
}

/** A JSON answer; the last one stays while another is fetched. `null` as path: nothing is fetched.
 * Nothing behind a # is sent: another one fetches the same path again. */
export const useJson = <T>(path: string | null): Resource<T> => useFetched<T>(path, getJson);

/** As useJson(), with a function that fetches the value of a path; always the same function. */
function useFetched<T>(path: string | null, fetchAll: (path: string, signal: AbortSignal) => Promise<T>): Resource<T> {
  const [value, setValue] = useState<{ path: string | null; value: T | null }>({ path: null, value: null });
  const [error, setError] = useState<ApiError | null>(null);
  const [round, setRound] = useState(0);
  const { round: session } = useSession();
  useEffect(() => {
    if (path === null) return;
    const controller = new AbortController();
    fetchAll(path, controller.signal).then(
      (answer) => {
        setValue({ path, value: answer });
        setError(null);
      },
      (reason: unknown) => {
        if (!controller.signal.aborted) setError(asApiError(reason));
      },
    );
    return () => controller.abort();
  }, [path, round, session]);
  const reload = useCallback(() => setRound((count) => count + 1), []);
  return { value: value.path === path ? value.value : null, error, reload };
}

async function allScenarios(path: string, signal: AbortSignal): Promise<Scenario[]> {
  const all: Scenario[] = [];
  for (let next: string | null = ""; next !== null; ) {
    const query: string = next === "" ? "" : `?after=${encodeURIComponent(next)}`;
    const page: ScenarioList = await getJson<ScenarioList>(path + query, signal);
    all.push(...page.scenarios);
    next = page.next;
  }
  return all;
}

/** The scenarios that jobs can name, from all pages of their list. */
export const useScenarios = (): Resource<Scenario[]> => useFetched("/v1/scenarios", allScenarios);

/** Calls `action` every `periodMs` while the page is visible; 0: never. */
export function useInterval(action: () => void, periodMs: number): void {
  const handler = useRef(action);
  handler.current = action;
  useEffect(() => {
    if (periodMs <= 0) return;
    const timer = setInterval(() => document.hidden || handler.current(), periodMs);
    return () => clearInterval(timer);
  }, [periodMs]);
}

/** An address for <img>; null while a key is asked for, so that it is fetched again afterwards. */
export function useSource(path: string | null): string | null {
  const { demand } = useSession();
  return demand === null ? path : null;
}
