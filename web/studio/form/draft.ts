// The job that is being written: one state behind all tabs. The text is what is sent; its value is what fields show.
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, sendJson } from "../api/client";
import { useSession } from "../api/session";
import type { DryRun, Mistake } from "../api/types";
import { isObject, type Json, type JsonObject, type Path, textOf, withValue } from "./json";

const kStorage = "throng.draft";
const kPauseMs = 400;

export interface Draft {
  text: string;
  value: JsonObject | null; ///< null: the text is no JSON object
}

export function draftOf(text: string): Draft {
  try {
    const value = JSON.parse(text) as Json;
    return { text, value: isObject(value) ? value : null };
  } catch {
    return { text, value: null };
  }
}

export function storedDraft(storage = kStorage): Draft | null {
  const text = sessionStorage.getItem(storage);
  return text ? draftOf(text) : null;
}

export function forgetDraft(storage = kStorage): void {
  sessionStorage.removeItem(storage);
}

export interface Form {
  value: JsonObject;
  errors: Mistake[];
  change: (path: Path, value: Json | undefined) => void;
}

/** Changes of a field; the text is written again. */
export function changedDraft(draft: Draft, path: Path, value: Json | undefined): Draft {
  const next = (withValue(draft.value ?? {}, path, value) ?? {}) as JsonObject;
  return { text: textOf(next), value: next };
}

export interface Check<Plan = DryRun> {
  isPending: boolean;
  plan: Plan | null;
  errors: Mistake[];
  message: string | null; ///< of an error that belongs to no field
}

/** Where drafts are checked, and what keeps them for this tab's life. */
export interface DraftTarget {
  path: string;
  storage: string;
}

const kJobs: DraftTarget = { path: "/v1/jobs?dry_run", storage: kStorage };

/** Has the service check the draft (of a job, where nothing else is said) a moment after each change and after each sign-in, and keeps it for this tab's life. */
export function useCheck<Plan = DryRun>(draft: Draft | null, place = kJobs): Check<Plan> {
  const [check, setCheck] = useState<Check<Plan>>({ isPending: true, plan: null, errors: [], message: null });
  const [round, setRound] = useState(0);
  const { round: session } = useSession();
  const controller = useRef<AbortController | null>(null);
  useEffect(() => {
    if (!draft) return;
    sessionStorage.setItem(place.storage, draft.text);
    setCheck((last) => ({ ...last, isPending: true }));
    let retry = 0;
    const timer = setTimeout(() => {
      controller.current?.abort();
      const { signal } = (controller.current = new AbortController());
      sendJson<Plan>("POST", place.path, draft.text, signal).then(
        (plan) => setCheck({ isPending: false, plan, errors: [], message: null }),
        (error: unknown) => {
          if (signal.aborted) return;
          const errors = error instanceof ApiError ? error.errors : [];
          setCheck({ isPending: false, plan: null, errors, message: errors.length ? null : (error as Error).message });
          if (error instanceof ApiError && error.status === 0) retry = setTimeout(() => setRound(round + 1), 10 * kPauseMs);
        },
      );
    }, kPauseMs);
    return () => {
      clearTimeout(timer);
      clearTimeout(retry);
    };
  }, [draft?.text, round, session]);
  return check;
}
