// The part of a dataset that is downloaded: the address of the screen and of the archive hold it alike.

export interface Selection {
  include: string[]; ///< kinds of ground truth, formats, folders and files at the top; none: everything
  runs: string; ///< "0-3,7"; "": all
  split: string; ///< "": all
  format: "tar" | "zip";
}

export function selectionOf(query: URLSearchParams): Selection {
  return {
    include: (query.get("include") ?? "").split(",").filter(Boolean),
    runs: query.get("runs") ?? "",
    split: query.get("split") ?? "",
    format: query.get("format") === "zip" ? "zip" : "tar",
  };
}

/** Parameters of the archive; runs and splits exclude each other. */
export function queryOf(selection: Selection): Record<string, string> {
  const query: Record<string, string> = {};
  if (selection.format === "zip") query["format"] = "zip";
  if (selection.include.length > 0) query["include"] = selection.include.join(",");
  if (selection.split) query["split"] = selection.split;
  else if (selection.runs) query["runs"] = selection.runs;
  return query;
}

export function archiveOf(job: string, selection: Selection): string {
  const query = new URLSearchParams(queryOf(selection)).toString();
  return `/v1/jobs/${job}/archive${query ? `?${query}` : ""}`;
}

export interface Snippet {
  name: string;
  text: string;
}

interface Access {
  host: string; ///< of the service, with its scheme
  needsKey: boolean;
}

const quoted = (text: string) => `'${text.replaceAll("'", "'\\''")}'`;

/** The same download by the program, by curl and in Python. */
export function downloadSnippets(job: string, selection: Selection, { host, needsKey }: Access): Snippet[] {
  const { include, runs, split, format } = selection;
  const key = needsKey ? "THRONG_KEY=… " : "";
  const choice = split ? ` --split ${quoted(split)}` : runs ? ` --runs ${quoted(runs)}` : "";
  const options = `${format === "zip" ? " --zip" : ""}${include.length > 0 ? ` --include ${include.map(quoted).join(" ")}` : ""}${choice}`;
  const header = needsKey ? `-H "Authorization: Bearer $THRONG_KEY" ` : "";
  const list = include.length > 0 ? [`include=${JSON.stringify(include)}`] : [];
  if (split) list.push(`split=${JSON.stringify(split)}`);
  else if (runs) list.push(`runs=${JSON.stringify(runs)}`);
  if (format === "zip") list.push('format="zip"');
  const rest = ["", ...list].join(", ");
  return [
    { name: "throng", text: `${key}THRONG_URL=${host} throng fetch ${job}${options}` },
    { name: "curl", text: `curl ${header}-C - -O -J ${quoted(host + archiveOf(job, selection))}` },
    {
      name: "Python",
      text: `import throng\nclient = throng.Client("${host}"${needsKey ? ', "throng_…"' : ""})\ndataset = throng.Dataset(client.download("${job}"${rest}))`,
    },
  ];
}
