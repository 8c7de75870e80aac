// Downloads of a dataset, with the same by the program and in Python.
import { useSession } from "../api/session";
import type { Job } from "../api/types";

interface Download {
  label: string;
  path: string;
  file: string;
}

function downloadsOf(job: Job): Download[] {
  const self = `/v1/jobs/${job.id}`;
  return [
    { label: "Dataset (tar)", path: `${self}/archive`, file: `${job.id}.tar` },
    { label: "Dataset (zip)", path: `${self}/archive?format=zip`, file: `${job.id}.zip` },
    { label: "Metrics (JSON)", path: `${self}/metrics`, file: `${job.id}-metrics.json` },
    { label: "Manifest (JSON)", path: `${self}/manifest`, file: `${job.id}-manifest.json` },
  ];
}

function snippets(job: Job, needsKey: boolean): { name: string; text: string }[] {
  const host = location.origin;
  const key = needsKey ? `THRONG_KEY=… ` : "";
  const header = needsKey ? `-H "Authorization: Bearer $THRONG_KEY" ` : "";
  return [
    { name: "throng", text: `${key}THRONG_URL=${host} throng fetch ${job.id}` },
    { name: "curl", text: `curl ${header}-C - -O -J ${host}/v1/jobs/${job.id}/archive` },
  ];
}

export function Downloads({ job }: { job: Job }) {
  const { needsKey } = useSession();
  return (
    <section aria-labelledby="downloads">
      <h2 id="downloads">Results</h2>
      <div class="actions">
        {downloadsOf(job).map((download) => (
          <a key={download.path} class="button" href={download.path} download={download.path.includes("/archive") ? "" : download.file}>
            {download.label}
          </a>
        ))}
        <a class="button" href={`/v1/jobs/${job.id}/report`} target="_blank" rel="noreferrer">
          Report
        </a>
      </div>
      <dl class="snippets">
        {snippets(job, needsKey).map((snippet) => (
          <div key={snippet.name}>
            <dt>{snippet.name}</dt>
            <dd>
              <code>{snippet.text}</code>
            </dd>
          </div>
        ))}
      </dl>
    </section>
  );
}
