// Says when what is shown may be old.
import type { Connection } from "../api/events";

export function ConnectionNote({ state }: { state: Connection }) {
  if (state === "live") return <span class="live">live</span>;
  if (state !== "lost") return null;
  return (
    <span class="live lost" role="status">
      connection lost, trying again
    </span>
  );
}
