// Keys and webhooks of the service, for administrators; and the service itself.
import { useState } from "preact/hooks";
import { useJson } from "../api/resource";
import type { Session } from "../api/types";
import { ErrorBox, Figures, Tabs } from "../parts/elements";
import { bytesText } from "../parts/format";
import { Keys } from "./keys";
import { Webhooks } from "./webhooks";

const kTabs = [
  { id: "keys", label: "Keys" },
  { id: "webhooks", label: "Webhooks" },
];

export function AccessScreen() {
  const session = useJson<Session>("/v1/session");
  const version = useJson<{ version: string }>("/v1/version");
  const disk = useJson<{ free_bytes: number }>("/readyz");
  const [tab, setTab] = useState("keys");
  const { needs_key, scope } = session.value ?? {};
  return (
    <div class="screen">
      <h1>Keys and webhooks</h1>
      <ErrorBox error={session.error} />
      {version.value && (
        <Figures
          list={[
            ["throng", version.value.version],
            [
              "this browser may",
              scope === "admin" ? "change everything" : scope === "submit" ? "queue jobs" : scope === "read" ? "read" : "nothing yet",
            ],
            ["free disk", disk.value ? bytesText(disk.value.free_bytes) : "–"],
          ]}
        />
      )}
      {scope && scope !== "admin" && (
        <p class="notice warn">Keys and webhooks are for administrators: sign out, and in again with a key of scope admin.</p>
      )}
      {needs_key && !scope && <p class="notice warn">Sign in with a key of scope admin.</p>}
      {scope === "admin" && (
        <>
          <Tabs label="Kind" tabs={kTabs} selected={tab} onSelect={setTab} />
          <div id="panel" role="tabpanel" aria-labelledby={`tab-${tab}`}>
            {tab === "keys" ? <Keys isNeeded={needs_key!} /> : <Webhooks />}
          </div>
        </>
      )}
    </div>
  );
}
