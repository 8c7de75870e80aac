// Downloads of a dataset: what it holds, the part that is wanted and its size, and the formats with code that reads them.
import { useState } from "preact/hooks";
import { servicePath, serviceUrl } from "../api/base";
import { hasDataset } from "../api/jobs";
import { useJson } from "../api/resource";
import { useSession } from "../api/session";
import type { Job } from "../api/types";
import { Empty, ErrorBox } from "../parts/elements";
import { bytesText } from "../parts/format";
import { GoneJob } from "../parts/gone";
import { navigate, useAddress } from "../parts/router";
import { CodeBlock } from "../parts/snippet";
import { type FormatEntry, FormatList } from "./format_list";
import { archiveOf, downloadSnippets, queryOf, type Selection, selectionOf } from "./selection";
import { useArchiveSize } from "./sizes";

/** The card of a dataset (dataset.json), as far as it is shown. */
interface Card {
  files: Record<string, string>;
  formats: Record<string, string>;
  splits: Record<string, string[]>;
}

// Always useful, and small.
const kAlways = new Set(["files"]);

/** What can be chosen, with where it lies. */
function partsOf(card: Card): { name: string; text: string }[] {
  const own = Object.entries(card.files).filter(([name]) => !kAlways.has(name));
  return [
    ...own.map(([name, text]) => (name === "metrics" ? { name: text, text: "figures of all runs" } : { name, text })),
    ...Object.entries(card.formats).map(([name, folder]) => ({ name, text: `${folder}: ready to use` })),
  ];
}

function Part({
  job,
  name,
  text,
  isChosen,
  onToggle,
}: {
  job: string;
  name: string;
  text: string;
  isChosen: boolean;
  onToggle: () => void;
}) {
  const size = useArchiveSize(archiveOf(job, { include: [name], runs: "", split: "", format: "tar" }));
  return (
    <li>
      <label class="row">
        <input type="checkbox" checked={isChosen} onChange={onToggle} />
        <span class="grow part-name">
          {name} <span class="quiet-text">{text}</span>
        </span>
        <span class="quiet-text size">{size.bytes === null ? "" : bytesText(size.bytes)}</span>
      </label>
    </li>
  );
}

function Chooser({ job, card, selection, onChange }: { job: Job; card: Card; selection: Selection; onChange: (next: Selection) => void }) {
  const toggle = (name: string) => {
    const include = selection.include.includes(name) ? selection.include.filter((other) => other !== name) : [...selection.include, name];
    onChange({ ...selection, include });
  };
  const splits = Object.keys(card.splits ?? {});
  return (
    <fieldset>
      <legend>Part of the dataset</legend>
      <ul class="plain-list parts">
        <li>
          <label class="row">
            <input type="checkbox" checked={selection.include.length === 0} onChange={() => onChange({ ...selection, include: [] })} />
            <span>Everything</span>
          </label>
        </li>
        {partsOf(card).map((part) => (
          <Part
            key={part.name}
            job={job.id}
            {...part}
            isChosen={selection.include.includes(part.name)}
            onToggle={() => toggle(part.name)}
          />
        ))}
      </ul>
      <div class="fields">
        <label class="field">
          <span class="field-name">Split</span>
          <select value={selection.split} onChange={(event) => onChange({ ...selection, split: event.currentTarget.value, runs: "" })}>
            <option value="">all</option>
            {splits.map((split) => (
              <option key={split} value={split}>
                {split} ({card.splits[split]!.length} runs)
              </option>
            ))}
          </select>
        </label>
        <label class="field">
          <span class="field-name">Runs</span>
          <input
            value={selection.runs}
            placeholder="all, or 0-3,7"
            onChange={(event) => onChange({ ...selection, runs: event.currentTarget.value.trim(), split: "" })}
          />
        </label>
        <label class="field">
          <span class="field-name">Archive</span>
          <select
            value={selection.format}
            onChange={(event) => onChange({ ...selection, format: event.currentTarget.value as Selection["format"] })}
          >
            <option>tar</option>
            <option>zip</option>
          </select>
        </label>
      </div>
    </fieldset>
  );
}

function Content({ job, card, formats }: { job: Job; card: Card; formats: FormatEntry[] }) {
  const { query } = useAddress();
  const { needsKey } = useSession();
  const [tool, setTool] = useState("throng");
  const selection = selectionOf(query);
  const size = useArchiveSize(archiveOf(job.id, selection));
  const change = (next: Selection) => {
    const text = new URLSearchParams(queryOf(next)).toString();
    navigate(servicePath(location.pathname) + (text ? `?${text}` : ""), { replace: true });
  };
  const snippets = downloadSnippets(job.id, selection, { host: serviceUrl(), needsKey });
  const shown = snippets.find((snippet) => snippet.name === tool)!;
  return (
    <>
      <Chooser job={job} card={card} selection={selection} onChange={change} />
      {size.error && size.error.status !== 401 && <ErrorBox error={size.error} />}
      <div class="row wrap download-bar">
        <a class={`button primary ${size.bytes === null ? "disabled" : ""}`} href={archiveOf(job.id, selection)} download="">
          Download {size.bytes === null ? "" : bytesText(size.bytes)}
        </a>
        <div class="chips" role="group" aria-label="The same by">
          {snippets.map(({ name }) => (
            <button key={name} type="button" class="chip" aria-pressed={name === tool} onClick={() => setTool(name)}>
              {name}
            </button>
          ))}
        </div>
      </div>
      <CodeBlock text={shown.text} label={`download by ${shown.name}`} />
      <FormatList job={job} formats={formats} truths={card.files} written={card.formats} splits={card.splits ?? {}} />
    </>
  );
}

export function DownloadsScreen({ id }: { id: string }) {
  const job = useJson<Job>(`/v1/jobs/${id}`);
  const isReady = job.value !== null && hasDataset(job.value);
  const card = useJson<Card>(isReady ? `/v1/jobs/${id}/files/dataset.json` : null);
  const formats = useJson<{ formats: FormatEntry[] }>("/v1/formats");
  if (job.error?.status === 404) return <GoneJob id={id} />;
  const error = job.error ?? card.error ?? formats.error;
  return (
    <div class="screen">
      <div class="heading">
        <p class="breadcrumb">
          <a href="/jobs">Jobs</a> / <a href={`/jobs/${id}`}>{job.value?.name ?? id}</a> / Downloads
        </p>
        <h1>Downloads of {job.value?.name ?? id}</h1>
      </div>
      {error?.status !== 401 && <ErrorBox error={error} />}
      {job.value && !isReady && <Empty title={`The job is ${job.value.state}: its dataset is there once it has succeeded`} />}
      {job.value && card.value && formats.value && <Content job={job.value} card={card.value} formats={formats.value.formats} />}
    </div>
  );
}
