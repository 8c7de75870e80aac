// Frames and times of a job's images.
import type { Job } from "../api/types";

export interface Capture {
  from_s: number;
  rate_hz: number;
}

export const captureOf = (job: Job) => job.job?.["capture"] as unknown as Capture;
export const timeOf = (capture: Capture, frame: number) => capture.from_s + frame / capture.rate_hz;
export const frameAt = (capture: Capture, time_s: number) => Math.round((time_s - capture.from_s) * capture.rate_hz);
