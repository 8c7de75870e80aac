// Results of a job: the usual downloads, and the way to all others.
import type { Job } from "../api/types";

export function Results({ job }: { job: Job }) {
  const self = `/v1/jobs/${job.id}`;
  const files: [label: string, address: string, file: string][] = [
    ["Dataset (tar)", `${self}/archive`, ""],
    ["Dataset (zip)", `${self}/archive?format=zip`, ""],
    ["Metrics (JSON)", `${self}/metrics`, `${job.id}-metrics.json`],
    ["Manifest (JSON)", `${self}/manifest`, `${job.id}-manifest.json`],
  ];
  return (
    <section aria-labelledby="results">
      <h2 id="results">Results</h2>
      <div class="actions">
        {files.map(([label, address, file]) => (
          <a key={address} class="button" href={address} download={file}>
            {label}
          </a>
        ))}
        <a class="button" href={`/jobs/${job.id}/downloads`}>
          Parts, formats and code
        </a>
        <a class="button" href={`${self}/report`} target="_blank" rel="noreferrer">
          Report
        </a>
      </div>
    </section>
  );
}
