// Findings of the service about a blueprint, a moment after each change.
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, asApiError, sendJson } from "../api/client";
import { useSession } from "../api/session";
import type { Mistake, Upload } from "../api/types";
import type { JsonObject } from "../form/json";

const kPauseMs = 600;

export interface Finding {
  severity: "error" | "warning";
  pointer: string;
  text: string;
  remedy: string;
}

export interface BlueprintCheck {
  isPending: boolean;
  findings: Finding[];
  message: string | null; ///< why it could not be checked
}

const sentence = ({ found, expected, message }: Mistake) => (found ? `found ${found}, expected ${expected}` : message);

function findingsOf(upload: Upload): Finding[] {
  return (upload.findings ?? []).map((finding) => ({
    severity: finding.severity,
    pointer: finding.pointer,
    text: sentence(finding),
    remedy: finding.remedy,
  }));
}

/** No upload has this name: a check that is not kept needs one. */
const checkName = () => `check_${Math.random().toString(36).slice(2, 12)}`;

export function useCheckedBlueprint(document: JsonObject): BlueprintCheck {
  const [check, setCheck] = useState<BlueprintCheck>({ isPending: true, findings: [], message: null });
  const controller = useRef<AbortController | null>(null);
  const { round } = useSession();
  useEffect(() => {
    setCheck((last) => ({ ...last, isPending: true }));
    const timer = setTimeout(() => {
      controller.current?.abort();
      const { signal } = (controller.current = new AbortController());
      sendJson<Upload>("POST", `/v1/scenarios?dry_run&name=${checkName()}`, JSON.stringify(document), signal).then(
        (upload) => setCheck({ isPending: false, findings: findingsOf(upload), message: null }),
        (reason: unknown) => {
          if (signal.aborted) return;
          const error = reason instanceof ApiError ? reason : asApiError(reason);
          const findings = error.errors.map(
            (entry): Finding => ({ severity: "error", pointer: entry.pointer, text: sentence(entry), remedy: "" }),
          );
          setCheck({ isPending: false, findings, message: findings.length > 0 ? null : error.message });
        },
      );
    }, kPauseMs);
    return () => clearTimeout(timer);
  }, [document, round]);
  return check;
}
