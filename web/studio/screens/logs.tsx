// Ends of a job's logs.
import { useEffect, useRef, useState } from "preact/hooks";
import { getRange, messageOf } from "../api/client";
import { isActive } from "../api/jobs";
import { useInterval, useJson } from "../api/resource";
import type { Job, LogList } from "../api/types";

const kTailBytes = 64 * 1024;
const kMaxLines = 1000;
const kPollMs = 2000;

/** The last lines of a log, without the one that the range cuts. */
async function tailOf(href: string, bytes: number): Promise<string> {
  if (bytes === 0) return "";
  const first = Math.max(0, bytes - kTailBytes);
  const { text } = await getRange(href, first, bytes + kTailBytes);
  const lines = text.trimEnd().split("\n");
  return lines.slice(Math.max(first > 0 ? 1 : 0, lines.length - kMaxLines)).join("\n");
}

export function Logs({ job }: { job: Job }) {
  const [isOpen, setOpen] = useState(false);
  const list = useJson<LogList>(isOpen || job.error ? `/v1/jobs/${job.id}/logs` : null);
  const [name, setName] = useState<string | null>(null);
  const [text, setText] = useState("");
  const box = useRef<HTMLPreElement>(null);
  const logs = list.value?.logs ?? [];
  const log = logs.find((entry) => entry.name === name) ?? logs.at(-1);
  useInterval(list.reload, isOpen && isActive(job) ? kPollMs : 0);
  useEffect(() => {
    if (!log) return;
    let isCurrent = true;
    tailOf(log.href, log.bytes).then(
      (tail) => isCurrent && setText(tail),
      (error: unknown) => isCurrent && setText(messageOf(error)),
    );
    return () => void (isCurrent = false);
  }, [log?.href, log?.bytes]);
  useEffect(() => box.current?.scrollTo(0, box.current.scrollHeight), [text]);
  return (
    <details class="source" open={isOpen} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>Logs</summary>
      {logs.length > 0 && (
        <label class="row wrap">
          File
          <select value={log?.name} onChange={(event) => setName(event.currentTarget.value)}>
            {logs.map((entry) => (
              <option key={entry.name}>{entry.name}</option>
            ))}
          </select>
        </label>
      )}
      <pre ref={box} class="log" tabIndex={0} aria-label="end of the log">
        {list.value && logs.length === 0 ? "There are no logs yet." : text || " "}
      </pre>
    </details>
  );
}
