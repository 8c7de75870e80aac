// States of a run's exits over time, from exits.csv (docs/metrics.md).

export const kExitStates = ["idle", "flowing", "congested", "clogged", "closed"] as const;
export type ExitState = (typeof kExitStates)[number];

export interface ExitSpan {
  from_s: number;
  to_s: number;
  state: ExitState;
}

export interface ExitHistory {
  id: string;
  spans: ExitSpan[];
}

/** Rows of a table with a header; values have no commas or quotes. */
function rowsOf(csv: string): Record<string, string>[] {
  const [header = "", ...lines] = csv.trim().split(/\r?\n/);
  const names = header.split(",");
  return lines.map((line) => {
    const values = line.split(",");
    return Object.fromEntries(names.map((name, index) => [name, values[index] ?? ""]));
  });
}

/** A state lasts from its frame to the next; the last one up to `end_s`. */
export function historiesOf(csv: string, end_s: number): ExitHistory[] {
  const histories = new Map<string, ExitSpan[]>();
  for (const row of rowsOf(csv)) {
    const spans = histories.get(row["exit"]!) ?? [];
    histories.set(row["exit"]!, spans);
    const time_s = Number(row["time_s"]);
    const last = spans.at(-1);
    if (last) last.to_s = time_s;
    if (last?.state === row["state"]) last!.to_s = Math.max(end_s, time_s);
    else spans.push({ from_s: time_s, to_s: Math.max(end_s, time_s), state: row["state"] as ExitState });
  }
  return [...histories].map(([id, spans]) => ({ id, spans }));
}

export function stateAt(history: ExitHistory, time_s: number): ExitState | null {
  return history.spans.find((span) => time_s >= span.from_s && time_s < span.to_s)?.state ?? history.spans.at(-1)?.state ?? null;
}
