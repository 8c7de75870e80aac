// The HTTP API, from the service's own description; what only reads can be tried here.
import { useState } from "preact/hooks";
import { serviceUrl } from "../api/base";
import { asApiError, request } from "../api/client";
import { useJson } from "../api/resource";
import { useSession } from "../api/session";
import { Empty, ErrorBox } from "../parts/elements";
import { countText } from "../parts/format";
import { navigate, useAddress, withQuery } from "../parts/router";
import { CodeBlock } from "../parts/snippet";
import {
  addressOf,
  answerOf,
  curlOf,
  type Document,
  groupsOf,
  isMatch,
  namesIn,
  type Operation,
  operationsOf,
  type Schema,
  typeText,
} from "./openapi";

const kMaxShown = 20_000; // characters of an answer

function Properties({ schema }: { schema: Schema }) {
  const required = new Set(schema.required);
  return (
    <ul class="plain-list properties">
      {Object.entries(schema.properties ?? {}).map(([name, part]) => (
        <li key={name}>
          <code>{name}</code>
          {!required.has(name) && <span class="quiet-text">?</span>} <span class="quiet-text">{typeText(part)}</span>
          {part.description && <span> {part.description}</span>}
        </li>
      ))}
    </ul>
  );
}

/** A schema with the components that it names, each as deep as it is opened. */
function SchemaView({ schema, document }: { schema: Schema; document: Document }) {
  const [isOpen, setOpen] = useState<Record<string, boolean>>({});
  return (
    <>
      {schema.properties && <Properties schema={schema} />}
      {namesIn(schema).map((name) => (
        <details key={name} onToggle={(event) => setOpen({ ...isOpen, [name]: event.currentTarget.open })}>
          <summary>
            <code>{name}</code>
          </summary>
          {isOpen[name] && <SchemaView schema={document.components.schemas[name] ?? {}} document={document} />}
        </details>
      ))}
    </>
  );
}

function Contents({ content, document }: { content: Record<string, { schema?: Schema }>; document: Document }) {
  return (
    <>
      {Object.entries(content).map(([type, { schema }]) => (
        <div key={type} class="content-type">
          <code>{type}</code> {schema && <span class="quiet-text">{typeText(schema)}</span>}
          {schema && <SchemaView schema={schema} document={document} />}
        </div>
      ))}
    </>
  );
}

function Parameters({
  operation,
  values,
  onChange,
}: {
  operation: Operation;
  values: Record<string, string>;
  onChange: (values: Record<string, string>) => void;
}) {
  return (
    <div class="fields">
      {operation.parameters!.map(({ name, in: place, description, schema, required }) => (
        <label key={name} class="field">
          <span class="field-name">
            <code>{name}</code> <span class="unit">{place === "path" || required ? "required" : typeText(schema ?? {})}</span>
          </span>
          <input
            value={values[name] ?? ""}
            placeholder={schema?.default === undefined ? "" : String(schema.default)}
            disabled={place === "header"}
            onInput={(event) => onChange({ ...values, [name]: event.currentTarget.value })}
          />
          {description && <span class="field-note">{description}</span>}
        </label>
      ))}
    </div>
  );
}

function Trial({ address, isReady }: { address: string; isReady: boolean }) {
  const [answer, setAnswer] = useState<{ title: string; text: string } | null>(null);
  const send = async () => {
    try {
      const response = await request(address, { headers: { Accept: "application/json, */*" } });
      const type = response.headers.get("Content-Type") ?? "";
      if (!/json|text|svg|yaml|csv/.test(type)) {
        await response.body?.cancel();
        setAnswer({ title: `${response.status}: ${type}, ${response.headers.get("Content-Length") ?? "?"} bytes`, text: "" });
        return;
      }
      const text = await response.text();
      setAnswer({ title: `${response.status}: ${type}`, text: type.includes("json") ? JSON.stringify(JSON.parse(text), null, 2) : text });
    } catch (reason) {
      const error = asApiError(reason);
      setAnswer({ title: `${error.status}: ${error.message}`, text: error.errors.length > 0 ? JSON.stringify(error.errors, null, 2) : "" });
    }
  };
  return (
    <>
      <button type="button" class="button small" disabled={!isReady} onClick={() => void send()}>
        Send
      </button>
      {answer && (
        <div role="status" class="stack">
          <p class="answer-title">{answer.title}</p>
          {answer.text && (
            <CodeBlock text={answer.text.length > kMaxShown ? `${answer.text.slice(0, kMaxShown)}\n…` : answer.text} label="answer" />
          )}
        </div>
      )}
    </>
  );
}

function OperationBody({ operation, document }: { operation: Operation; document: Document }) {
  const [values, setValues] = useState<Record<string, string>>({});
  const { needsKey } = useSession();
  const address = addressOf(operation, values);
  const isReady = (operation.parameters ?? []).every((parameter) => parameter.in !== "path" || values[parameter.name]);
  const shown = isReady ? address : operation.path;
  return (
    <div class="stack operation-body">
      {operation.parameters && <Parameters operation={operation} values={values} onChange={setValues} />}
      <CodeBlock text={curlOf(operation, shown, serviceUrl(), needsKey)} label={`${operation.id} by curl`} />
      {operation.method === "get" && !operation.path.endsWith("events") && <Trial address={address} isReady={isReady} />}
      {operation.requestBody && (
        <section aria-label="Body">
          <h4>Body</h4>
          <Contents content={operation.requestBody.content} document={document} />
        </section>
      )}
      <section aria-label="Answers">
        <h4>Answers</h4>
        {Object.entries(operation.responses).map(([status, reference]) => {
          const answer = answerOf(document, reference);
          return (
            <div key={status} class="content-type">
              <strong>{status}</strong> {answer.description}
              {status.startsWith("2") && answer.content && <Contents content={answer.content} document={document} />}
            </div>
          );
        })}
      </section>
    </div>
  );
}

export function ReferenceScreen() {
  const document = useJson<Document>("/openapi.json");
  const { query } = useAddress();
  const text = query.get("q") ?? "";
  const selected = query.get("operation");
  const operations = document.value ? operationsOf(document.value).filter((operation) => isMatch(operation, text)) : [];
  const select = (id: string, isOpen: boolean) => {
    if (isOpen !== (selected === id)) navigate(withQuery(query, { operation: isOpen ? id : null }), { replace: true });
  };
  return (
    <div class="screen">
      <div class="row wrap heading">
        <h1 class="grow">API</h1>
        <a class="button small" href="/openapi.json" download="throng-openapi.json">
          openapi.json
        </a>
      </div>
      <ErrorBox error={document.error} />
      <label class="search">
        <span class="hidden">Search operations</span>
        <input
          type="search"
          placeholder="Search operations"
          value={text}
          onInput={(event) => navigate(withQuery(query, { q: event.currentTarget.value }), { replace: true })}
        />
      </label>
      <p class="quiet-text" role="status">
        {countText(operations.length, "operation")}
      </p>
      {document.value && operations.length === 0 && <Empty title="No operation fits" />}
      {groupsOf(operations).map(([tag, group]) => (
        <section key={tag} aria-label={tag}>
          <h2>{tag}</h2>
          <div class="format-list">
            {group.map((operation) => (
              <details
                key={operation.id}
                class="source"
                open={selected === operation.id}
                onToggle={(event) => select(operation.id, event.currentTarget.open)}
              >
                <summary>
                  <span class={`method method-${operation.method}`}>{operation.method}</span> <code>{operation.path}</code>{" "}
                  <span class="quiet-text">{operation.summary}</span>
                </summary>
                {selected === operation.id && <OperationBody operation={operation} document={document.value!} />}
              </details>
            ))}
          </div>
        </section>
      ))}
    </div>
  );
}
