// Server-Sent Events by fetch: the browser's EventSource cannot send a key.
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, getJson, request } from "./client";
import type { Job } from "./types";

export interface ServerEvent {
  type: string;
  data: string;
}

export type Connection = "connecting" | "live" | "lost" | "ended";

const kFirstPauseMs = 500;
const kMaxPauseMs = 10_000;

/** Events of a text/event-stream, in order; `onId` gets the numbers from which the stream can be resumed. */
export async function* readEvents(body: ReadableStream<Uint8Array>, onId: (id: string) => void): AsyncGenerator<ServerEvent> {
  const reader = body.pipeThrough(new TextDecoderStream() as unknown as TransformStream<Uint8Array, string>).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const blocks = (rest + value).split("\n\n");
    rest = blocks.pop() ?? "";
    for (const block of blocks) {
      const event = { type: "message", data: "" };
      for (const line of block.split("\n")) {
        const colon = line.indexOf(": ");
        const field = line.slice(0, colon);
        const text = line.slice(colon + 2);
        if (field === "id") onId(text);
        else if (field === "event") event.type = text;
        else if (field === "data") event.data += text;
      }
      if (event.data) yield event;
    }
  }
}

/** Whether a job's events have ended with the job, and not with the service. */
async function isOver(path: string, signal: AbortSignal): Promise<boolean> {
  try {
    const { state } = await getJson<Job>(path.replace(/\/events$/, ""), signal);
    return state !== "queued" && state !== "running";
  } catch (error) {
    return error instanceof ApiError && error.status === 404;
  }
}

async function follow(
  path: string,
  first: string,
  signal: AbortSignal,
  onEvent: (event: ServerEvent) => void,
  onConnection: (state: Connection) => void,
): Promise<void> {
  let last = first;
  let pause = kFirstPauseMs;
  while (!signal.aborted) {
    try {
      const headers: Record<string, string> = { Accept: "text/event-stream" };
      if (last) headers["Last-Event-ID"] = last;
      const response = await request(path, { headers, signal });
      onConnection("live");
      pause = kFirstPauseMs;
      for await (const event of readEvents(response.body!, (id) => (last = id))) onEvent(event);
      if (path !== "/v1/events" && (await isOver(path, signal))) return onConnection("ended");
    } catch {
      if (signal.aborted) return;
    }
    onConnection("lost");
    await new Promise((resolve) => setTimeout(resolve, pause));
    pause = Math.min(2 * pause, kMaxPauseMs);
  }
}

/** The number of the newest event, so that a stream of all jobs does not begin with their history. */
async function newestEvent(signal: AbortSignal): Promise<string> {
  const text = await (await request("/metrics", { signal })).text();
  return /^throng_events_total (\d+)$/m.exec(text)?.[1] ?? "";
}

/**
 * Follows /v1/events or a job's events while the page is visible: browsers allow six connections to a service for all
 * tabs together. `onEvent` also gets a "resumed" event whenever events may have been missed.
 */
export function useEvents(path: string | null, onEvent: (event: ServerEvent) => void): Connection {
  const [connection, setConnection] = useState<Connection>("connecting");
  const handler = useRef(onEvent);
  handler.current = onEvent;
  useEffect(() => {
    if (!path) return;
    let controller = new AbortController();
    const begin = async () => {
      controller = new AbortController();
      const { signal } = controller;
      const first = path === "/v1/events" ? await newestEvent(signal).catch(() => "") : "";
      if (!signal.aborted) await follow(path, first, signal, (event) => handler.current(event), setConnection);
    };
    const onVisibility = () => {
      controller.abort();
      if (document.hidden) return;
      handler.current({ type: "resumed", data: "{}" });
      void begin();
    };
    if (!document.hidden) void begin();
    document.addEventListener("visibilitychange", onVisibility);
    return () => {
      controller.abort();
      document.removeEventListener("visibilitychange", onVisibility);
    };
  }, [path]);
  return connection;
}
