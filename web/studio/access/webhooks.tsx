// Webhooks: addresses that get events, with what was delivered to them.
import { useState } from "preact/hooks";
import { type ApiError, asApiError, sendJson } from "../api/client";
import { useJson } from "../api/resource";
import type { Delivery, DeliveryList, Event as ServiceEvent, Webhook, WebhookList } from "../api/types";
import { Confirmation, Empty, ErrorBox, type Question } from "../parts/elements";
import { agoText } from "../parts/format";
import { CodeBlock } from "../parts/snippet";

const kEvents: (ServiceEvent["type"] | "partial")[] = [
  "submitted",
  "started",
  "resumed",
  "stage",
  "succeeded",
  "partial",
  "failed",
  "cancelled",
  "retried",
  "changed",
  "removed",
];
const kUsual = new Set<string>(["succeeded", "partial", "failed", "cancelled"]);

function NewWebhook({ onMade }: { onMade: (webhook: Webhook) => void }) {
  const [url, setUrl] = useState("");
  const [events, setEvents] = useState<ReadonlySet<string>>(kUsual);
  const [error, setError] = useState<ApiError | null>(null);
  const toggle = (event: string) => {
    const next = new Set(events);
    if (!next.delete(event)) next.add(event);
    setEvents(next);
  };
  const submit = async (event: Event) => {
    event.preventDefault();
    try {
      onMade(await sendJson<Webhook>("POST", "/v1/webhooks", JSON.stringify({ url: url.trim(), events: [...events] })));
      setUrl("");
      setError(null);
    } catch (reason) {
      setError(asApiError(reason));
    }
  };
  return (
    <form onSubmit={submit}>
      <fieldset>
        <legend>New webhook</legend>
        <label class="field">
          <span class="field-name">Address</span>
          <input type="url" value={url} placeholder="https://example.org/hook" onInput={(event) => setUrl(event.currentTarget.value)} />
        </label>
        <div class="checks event-checks" role="group" aria-label="Events">
          {kEvents.map((name) => (
            <label key={name}>
              <input type="checkbox" checked={events.has(name)} onChange={() => toggle(name)} /> {name}
            </label>
          ))}
        </div>
        <div class="actions form-end">
          <button type="submit" class="button primary" disabled={!url.trim() || events.size === 0}>
            Add the webhook
          </button>
        </div>
        <ErrorBox error={error} />
      </fieldset>
    </form>
  );
}

function outcomeOf(delivery: Delivery): string {
  return delivery.succeeded
    ? `delivered (${delivery.status}, ${delivery.took_ms} ms)`
    : (delivery.error ?? `refused with ${delivery.status}`);
}

function Deliveries({ id, round }: { id: string; round: number }) {
  const list = useJson<DeliveryList>(`/v1/webhooks/${id}/deliveries?limit=20#${round}`);
  if (list.value?.deliveries.length === 0) return <p class="quiet-text">Nothing was sent yet.</p>;
  return (
    <ul class="plain-list deliveries">
      {list.value?.deliveries.map((delivery) => (
        <li key={`${delivery.event} ${delivery.at} ${delivery.attempt}`}>
          <span class={`badge ${delivery.succeeded ? "state-succeeded" : "state-failed"}`}>{delivery.type}</span> {outcomeOf(delivery)}{" "}
          <span class="quiet-text">
            {agoText(delivery.at)}, attempt {delivery.attempt}
          </span>
        </li>
      ))}
    </ul>
  );
}

interface EntryProps {
  webhook: Webhook;
  onChange: () => void;
  onRemove: () => void;
  onError: (error: ApiError | null) => void;
}

function WebhookEntry({ webhook, onChange, onRemove, onError }: EntryProps) {
  const [round, setRound] = useState(0);
  const [isOpen, setOpen] = useState(false);
  const perform = (action: Promise<unknown>) =>
    void action.then(
      () => {
        onError(null);
        onChange();
        setRound((count) => count + 1);
      },
      (reason: unknown) => onError(asApiError(reason)),
    );
  const self = `/v1/webhooks/${webhook.id}`;
  return (
    <li class="card webhook">
      <div class="row wrap">
        <strong class="grow webhook-url">{webhook.url}</strong>
        <span class={`badge ${webhook.enabled ? "state-succeeded" : ""}`}>{webhook.enabled ? "in use" : "out of use"}</span>
      </div>
      <p class="quiet-text">
        {webhook.events.join(", ")}
        {webhook.failures > 0 && ` · failed ${webhook.failures} times in a row, since ${agoText(webhook.failing_since)}`}
      </p>
      <div class="actions">
        <button type="button" class="button small" onClick={() => perform(sendJson("POST", `${self}/ping`).then(() => setOpen(true)))}>
          Ping
        </button>
        <button
          type="button"
          class="button small"
          onClick={() => perform(sendJson("PATCH", self, JSON.stringify({ enabled: !webhook.enabled })))}
        >
          {webhook.enabled ? "Take out of use" : "Use again"}
        </button>
        <button type="button" class="button small danger-text" onClick={onRemove}>
          Delete
        </button>
      </div>
      <details open={isOpen} onToggle={(event) => setOpen(event.currentTarget.open)}>
        <summary>Deliveries</summary>
        {isOpen && <Deliveries id={webhook.id} round={round} />}
      </details>
    </li>
  );
}

export function Webhooks() {
  const list = useJson<WebhookList>("/v1/webhooks");
  const [made, setMade] = useState<Webhook | null>(null);
  const [question, setQuestion] = useState<Question | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const askRemove = (webhook: Webhook) =>
    setQuestion({
      title: "Delete this webhook?",
      text: `${webhook.url} gets no more events.`,
      action: "Delete the webhook",
      isDangerous: true,
      confirm: () =>
        void sendJson<void>("DELETE", `/v1/webhooks/${webhook.id}`).then(list.reload, (reason: unknown) => setError(asApiError(reason))),
    });
  const webhooks = list.value?.webhooks ?? [];
  return (
    <div class="stack">
      {made?.secret && (
        <div class="notice" role="status">
          <p>The secret that signs what is sent to {made.url} (header Throng-Signature), which cannot be shown again:</p>
          <CodeBlock text={made.secret} label={`secret of ${made.url}`} />
        </div>
      )}
      <ErrorBox error={error ?? (list.error?.status === 401 ? null : list.error)} />
      {list.value && webhooks.length === 0 && <Empty title="No webhooks yet" />}
      <ul class="plain-list">
        {webhooks.map((webhook) => (
          <WebhookEntry key={webhook.id} webhook={webhook} onChange={list.reload} onRemove={() => askRemove(webhook)} onError={setError} />
        ))}
      </ul>
      <NewWebhook
        onMade={(webhook) => {
          setMade(webhook);
          list.reload();
        }}
      />
      <Confirmation question={question} onClose={() => setQuestion(null)} />
    </div>
  );
}
