// Subjects of a comparison: finished jobs with all of their runs, or single runs.
import type { Job } from "../api/types";
import type { Metrics } from "../run/metrics";

export const kMaxSubjects = 6;

/** A job, or one of its runs. */
export interface Choice {
  id: string;
  run: number | null; ///< null: all
}

export interface Subject extends Choice {
  name: string;
  job: Job;
  runs: Metrics[]; ///< of what was chosen
}

/** "ID" or "ID:RUN". */
export const keyOf = ({ id, run }: Choice) => (run === null ? id : `${id}:${run}`);

export function choiceOf(text: string): Choice | null {
  const parts = /^([a-z0-9]+)(?::(\d{1,4}))?$/.exec(text);
  return parts && { id: parts[1]!, run: parts[2] === undefined ? null : Number(parts[2]) };
}

/** The first of those that an address names; each counts once. */
export function choicesOf(query: URLSearchParams): Choice[] {
  const choices = query
    .getAll("job")
    .map(choiceOf)
    .filter((choice) => choice !== null);
  const keys = choices.map(keyOf);
  return choices.filter((choice, index) => keys.indexOf(keyOf(choice)) === index).slice(0, kMaxSubjects);
}

export function addressOf(choices: Choice[], time_s?: number): string {
  const query = choices.map((choice) => `job=${keyOf(choice)}`);
  if (time_s !== undefined) query.push(`t=${Math.round(10 * time_s) / 10}`);
  return `/compare?${query.join("&")}`;
}

export const pageOf = ({ id, run }: Choice) => (run === null ? `/jobs/${id}` : `/jobs/${id}/runs/${run}`);
export const nameOf = (job: Job, run: number | null) => (run === null ? job.name : `${job.name}, run ${run}`);
export const runName = (run: number) => `run${String(run).padStart(3, "0")}`;

export function runsOf(job: Job): number {
  // Rows of a list say only how far each of their runs is.
  const runs = job.job?.["runs"] ?? job.progress.runs?.length;
  return typeof runs === "number" ? runs : 1;
}
