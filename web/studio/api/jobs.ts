// Jobs and what can be done with them.

import { bytesText } from "../parts/format";
import { navigate } from "../parts/router";
import { sendJson } from "./client";
import type { Job, Progress } from "./types";

export const kStates: Job["state"][] = ["running", "queued", "succeeded", "partial", "failed", "cancelled"];

export const isActive = (job: Job) => job.state === "queued" || job.state === "running";
export const hasDataset = (job: Job) => job.state === "succeeded" || job.state === "partial";
export const canRetry = (job: Job) => job.state === "failed" || job.state === "partial" || job.state === "cancelled";

export const cancelJob = (id: string) => sendJson<Job>("POST", `/v1/jobs/${id}/cancel`);
export const retryJob = (id: string) => sendJson<Job>("POST", `/v1/jobs/${id}/retry`);
export const removeJob = (id: string) => sendJson<void>("DELETE", `/v1/jobs/${id}`);
export const keepJob = (id: string, keep: boolean) => sendJson<Job>("PATCH", `/v1/jobs/${id}`, JSON.stringify({ keep }));
export const prioritize = (id: string, priority: number) => sendJson<Job>("PATCH", `/v1/jobs/${id}`, JSON.stringify({ priority }));

/** Opens the form with a job's fields. */
export function editCopy(id: string): void {
  navigate(`/new?clone=${id}`);
}

/** How far a job is, in words. */
export function stageText(progress: Progress): string {
  const done = progress.frames_done ?? 0;
  const total = progress.frames_total ?? 0;
  switch (progress.stage) {
    case undefined:
    case "waiting":
      return "starting";
    case "simulating":
      return "simulating the crowd";
    case "rendering":
      return `rendering: ${done.toLocaleString("en-US")} of ${total.toLocaleString("en-US")} images`;
    case "rendered":
      return "writing the dataset";
    case "publishing":
      return `publishing: ${bytesText(progress.publishing?.bytes_done ?? 0)} of ${bytesText(progress.publishing?.bytes_total ?? 0)}`;
    default:
      return progress.stage;
  }
}

/** Share of the work that is done: simulated time and rendered images count half each. */
export function shareDone(progress: Progress): number {
  const runs = progress.runs ?? [];
  const duration = runs.reduce((sum, run) => sum + run.duration_s, 0);
  const simulated = runs.reduce((sum, run) => sum + run.simulated_s, 0);
  const total = progress.frames_total ?? 0;
  const parts = [duration > 0 ? simulated / duration : 0, total > 0 ? (progress.frames_done ?? 0) / total : 0];
  return (parts[0]! + parts[1]!) / 2;
}
