// The formats of a dataset and those that it can be exported to, each with code that makes and reads it.
import type { Job } from "../api/types";
import { CodeBlock } from "../parts/snippet";
import { isTruth, readerOf, truthReaderOf } from "./formats";

export interface FormatEntry {
  name: string;
  summary: string;
  needs: string; ///< kinds of ground truth, with commas between; "": none
}

const kUsualNeed = "coco";

interface FormatListProps {
  job: Job;
  formats: FormatEntry[];
  truths: Record<string, string>; ///< of the dataset: where each kind lies
  written: Record<string, string>; ///< folders of the formats in the dataset
  splits: Record<string, string[]>;
}

function Format({
  format,
  job,
  folder,
  split,
  isMissing,
}: {
  format: FormatEntry;
  job: Job;
  folder: string | null;
  split: string;
  isMissing: boolean;
}) {
  const made = `throng fetch ${job.id} -o dataset.tar && mkdir dataset && tar -xf dataset.tar -C dataset --strip-components=1\nthrong export dataset -o exported --formats ${format.name}`;
  return (
    <details class="source">
      <summary>
        {format.name} <span class="quiet-text">{format.summary}</span>
        {folder && <span class="badge state-succeeded">in the dataset</span>}
      </summary>
      {isMissing && (
        <p class="quiet-text">
          Needs <code>{format.needs || kUsualNeed}</code> among the annotations, which this job did not ask for.
        </p>
      )}
      {!folder && !isMissing && <CodeBlock text={made} label={`export to ${format.name}`} />}
      {!isMissing && (
        <CodeBlock
          text={readerOf(format.name, folder ? `dataset/${folder}` : `exported/${format.name}`, split)}
          label={`read ${format.name}`}
        />
      )}
    </details>
  );
}

export function FormatList({ job, formats, truths, written, splits }: FormatListProps) {
  const split = Object.keys(splits)[0] ?? "train";
  return (
    <>
      <section aria-labelledby="truths">
        <h2 id="truths">Ground truth of the dataset</h2>
        <div class="format-list">
          {Object.entries(truths)
            .filter(([name]) => isTruth(name))
            .map(([name, place]) => (
              <details key={name} class="source">
                <summary>
                  {name} <span class="quiet-text">{place}</span>
                </summary>
                <CodeBlock text={truthReaderOf(name, "dataset.tar")} label={`read ${name}`} />
              </details>
            ))}
        </div>
      </section>
      <section aria-labelledby="formats">
        <h2 id="formats">Formats</h2>
        <p class="quiet-text table-note">
          A job writes those that it names in <code>outputs.formats</code>; the others are made from its dataset at any time.
        </p>
        <div class="format-list">
          {formats.map((format) => (
            <Format
              key={format.name}
              format={format}
              job={job}
              folder={written[format.name] ?? null}
              split={split}
              isMissing={(format.needs || kUsualNeed).split(", ").some((kind) => !(kind in truths))}
            />
          ))}
        </div>
      </section>
    </>
  );
}
