// Keys: made, shown once, and revoked.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, sendJson } from "../api/client";
import { useJson } from "../api/resource";
import type { Key, KeyList } from "../api/types";
import { Confirmation, ErrorBox, type Question } from "../parts/elements";
import { bytesText, timeText } from "../parts/format";
import { CodeBlock } from "../parts/snippet";

const kScopes = [
  { name: "read", help: "see jobs with the label shared" },
  { name: "submit", help: "also queue jobs, see and change own ones" },
  { name: "admin", help: "see and change everything" },
] as const;
const kGiB = 2 ** 30;

/** null where the field is empty; the text where it is no number, so that the service says so. */
function numberIn(text: string, unit = 1): number | string | null {
  if (text.trim() === "") return null;
  const value = Number(text);
  return Number.isNaN(value) ? text : value * unit;
}

function NewKey({ onMade }: { onMade: (key: Key) => void }) {
  const [name, setName] = useState("");
  const [scope, setScope] = useState<Key["scope"]>("submit");
  const [jobs, setJobs] = useState("");
  const [disk, setDisk] = useState("");
  const [priority, setPriority] = useState("0");
  const [expiry, setExpiry] = useState("");
  const [error, setError] = useState<ApiError | null>(null);
  const submit = async (event: Event) => {
    event.preventDefault();
    const limits = { max_jobs: numberIn(jobs), max_bytes: numberIn(disk, kGiB), max_priority: numberIn(priority) };
    const body = { name, scope, ...limits, expires_at: expiry.trim() || null };
    try {
      onMade(await sendJson<Key>("POST", "/v1/keys", JSON.stringify(body)));
      setName("");
      setError(null);
    } catch (reason) {
      setError(asApiError(reason));
    }
  };
  const fields: [label: string, unit: string, value: string, set: (text: string) => void, placeholder: string][] = [
    ["Jobs at once", "", jobs, setJobs, "any number"],
    ["Disk", "GiB", disk, setDisk, "any"],
    ["Highest priority", "-100 to 100", priority, setPriority, "0"],
    ["Expires", "30d, 12h or a date", expiry, setExpiry, "never"],
  ];
  return (
    <form onSubmit={submit}>
      <fieldset>
        <legend>New key</legend>
        <div class="fields">
          <label class="field">
            <span class="field-name">Name of its owner</span>
            <input value={name} maxLength={100} onInput={(event) => setName(event.currentTarget.value)} />
          </label>
          <label class="field">
            <span class="field-name">Scope</span>
            <select value={scope} onChange={(event) => setScope(event.currentTarget.value as Key["scope"])}>
              {kScopes.map((entry) => (
                <option key={entry.name}>{entry.name}</option>
              ))}
            </select>
            <span class="field-note">may {kScopes.find((entry) => entry.name === scope)!.help}</span>
          </label>
          {fields.map(([label, unit, value, set, placeholder]) => (
            <label key={label} class="field">
              <span class="field-name">
                {label} {unit && <span class="unit">{unit}</span>}
              </span>
              <input
                inputMode={label === "Expires" ? "text" : "numeric"}
                value={value}
                placeholder={placeholder}
                onInput={(event) => set(event.currentTarget.value)}
              />
            </label>
          ))}
        </div>
        <div class="actions form-end">
          <button type="submit" class="button primary" disabled={!name.trim()}>
            Make the key
          </button>
        </div>
        <ErrorBox error={error} />
      </fieldset>
    </form>
  );
}

function KeyTable({ keys, onRevoke }: { keys: Key[]; onRevoke: (key: Key) => void }) {
  return (
    <div class="scroll">
      <table>
        <thead>
          <tr>
            <th>Name</th>
            <th>Scope</th>
            <th class="wide-only">Limits</th>
            <th class="wide-only">Made</th>
            <th class="wide-only">Expires</th>
            <th>
              <span class="hidden">Actions</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {keys.map((key) => (
            <tr key={key.id}>
              <td class="name">
                {key.name} <code class="quiet-text">{key.id}</code>
              </td>
              <td>{key.scope}</td>
              <td class="wide-only quiet-text">
                {key.max_jobs ?? "any"} jobs, {key.max_bytes === null ? "any disk" : bytesText(key.max_bytes)}, priority {key.max_priority}
              </td>
              <td class="wide-only quiet-text">{timeText(key.created_at)}</td>
              <td class="wide-only quiet-text">{key.expires_at ? timeText(key.expires_at) : "never"}</td>
              <td>
                {key.revoked_at ? (
                  <span class="quiet-text">revoked {timeText(key.revoked_at)}</span>
                ) : key.expires_at && Date.parse(key.expires_at) <= Date.now() ? (
                  <span class="quiet-text">expired {timeText(key.expires_at)}</span>
                ) : (
                  <button type="button" class="button small danger-text" aria-label={`Revoke ${key.name}`} onClick={() => onRevoke(key)}>
                    Revoke
                  </button>
                )}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

export function Keys({ isNeeded }: { isNeeded: boolean }) {
  const list = useJson<KeyList>("/v1/keys");
  const [made, setMade] = useState<Key | null>(null);
  const [question, setQuestion] = useState<Question | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const revoke = (key: Key) =>
    sendJson<Key>("DELETE", `/v1/keys/${key.id}`).then(
      () => {
        setError(null);
        list.reload();
      },
      (reason: unknown) => setError(asApiError(reason)),
    );
  const askRevoke = (key: Key) =>
    setQuestion({
      title: "Revoke this key?",
      text: `Whoever uses the key of “${key.name}” is refused from now on, and signed out. Their jobs stay. This cannot be undone.`,
      action: "Revoke the key",
      isDangerous: true,
      confirm: () => void revoke(key),
    });
  if (!isNeeded) {
    return (
      <div class="notice">
        <p>
          No key has been made yet: everybody on the machine of the service may do everything. The first key is made there; from then on
          everybody needs one.
        </p>
        <CodeBlock text="throng keys create NAME --scope admin --data DIR" label="make the first key" />
      </div>
    );
  }
  return (
    <div class="stack">
      {made?.key && (
        <div class="notice" role="status">
          <p>
            The key of <strong>{made.name}</strong>, which cannot be shown again:
          </p>
          <CodeBlock text={made.key} label={`key of ${made.name}`} />
          <button type="button" class="button small" onClick={() => setMade(null)}>
            Hide it
          </button>
        </div>
      )}
      <ErrorBox error={error ?? (list.error?.status === 401 ? null : list.error)} />
      {list.value && <KeyTable keys={list.value.keys} onRevoke={askRevoke} />}
      <NewKey
        onMade={(key) => {
          setMade(key);
          list.reload();
        }}
      />
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}
