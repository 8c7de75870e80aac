// Modules of web/studio, bundled for Node.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { load } from "./service.mjs";

const kStudio = path.join(path.dirname(fileURLToPath(import.meta.url)), "../../web/studio");

/** The exports of a module, such as "dataset/coco.ts". */
export async function importStudio(packages, file) {
  const folder = mkdtempSync(path.join(tmpdir(), "throng-bundle-"));
  const outfile = path.join(folder, "module.mjs");
  await load(packages, "esbuild").build({
    entryPoints: [path.join(kStudio, file)],
    outfile,
    bundle: true,
    format: "esm",
    platform: "node",
    jsx: "automatic",
    jsxImportSource: "preact",
    nodePaths: [packages],
    logLevel: "error",
  });
  try {
    return await import(pathToFileURL(outfile).href);
  } finally {
    rmSync(folder, { recursive: true });
  }
}
