// Bundles Studio and writes the sources that make it part of the program.
// usage: node build.mjs PACKAGES OUTPUT [--watch]
//   PACKAGES  node_modules with what web/package-lock.json names
//   OUTPUT    folder for the files of the page (OUTPUT/files), studio_files.cpp and studio_bytes.S
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.resolve(here, "../..");
const [packages, output] = process.argv.slice(2, 4).map((folder) => path.resolve(folder));
const files = path.join(output, "files");
const esbuild = createRequire(path.join(packages, "anything.js"))("esbuild");

const kTypes = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml",
  ".txt": "text/plain; charset=utf-8",
};

/// The documents of scenarios/ whose names end with `suffix` as a module, each as the field `key` beside its `file`.
const documents = (module, suffix, key) => ({
  name: module,
  setup(build) {
    build.onResolve({ filter: new RegExp(`^${module}$`) }, () => ({ path: module, namespace: module }));
    build.onLoad({ filter: /.*/, namespace: module }, () => {
      const folder = path.join(root, "scenarios");
      const names = readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(suffix));
      const list = names.sort().map((name) => ({
        file: name,
        [key]: JSON.parse(readFileSync(path.join(folder, name), "utf8")),
      }));
      return { contents: JSON.stringify(list), loader: "json" };
    });
  },
});

/// The rows of docs/metrics.md that define figures of a run as a module: the anchor, the paths in metrics.json as the
/// document writes them, and the text without markup.
const definitions = {
  name: "definitions",
  setup(build) {
    build.onResolve({ filter: /^definitions$/ }, () => ({ path: "definitions", namespace: "definitions" }));
    build.onLoad({ filter: /.*/, namespace: "definitions" }, () => {
      const document = readFileSync(path.join(root, "docs/metrics.md"), "utf8");
      const list = [...document.matchAll(/^\| <a id="([^"]+)"><\/a>(.*?) \| (.*) \|$/gm)].map(([, anchor, names, text]) => ({
        anchor,
        names: names.replaceAll("`", ""),
        text: text.replaceAll(/\[([^\]]*)\]\([^)]*\)/g, "$1").replaceAll(/[`*\\]/g, ""),
      }));
      return { contents: JSON.stringify(list), loader: "json" };
    });
  },
};
const modules = [definitions, documents("presets", ".job.json", "job"), documents("study_presets", "study.json", "study")];

const options = {
  absWorkingDir: here,
  entryPoints: { main: "main.tsx", icon: "icon.svg" },
  outdir: files,
  bundle: true,
  minify: true,
  splitting: true,
  format: "esm",
  target: "es2022",
  charset: "ascii",
  entryNames: "[name]-[hash]",
  chunkNames: "[name]-[hash]",
  assetNames: "[name]-[hash]",
  loader: { ".svg": "copy" },
  jsx: "automatic",
  jsxImportSource: "preact",
  nodePaths: [packages],
  legalComments: "none",
  metafile: true,
  logLevel: "warning",
  plugins: modules,
};

/// The packages in the bundle with their licenses, which their notices have to accompany.
function notice(metafile) {
  const names = new Set();
  for (const input of Object.keys(metafile.inputs)) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) names.add(found[1]);
  }
  const listed = readFileSync(path.join(root, "NOTICE"), "utf8");
  const parts = ["Software of others in Studio, the web page of throng, with its licenses.\n"];
  for (const name of [...names].sort()) {
    const folder = path.join(packages, name);
    const { version, license } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    if (!license || !file) throw new Error(`the package ${name} names no license`);
    if (!listed.includes(`\n  ${name} `) || !listed.includes(` ${license}\n`)) throw new Error(`NOTICE does not name ${name} (${license})`);
    parts.push(`${"-".repeat(80)}\n${name} ${version} (${license})\n\n${readFileSync(path.join(folder, file), "utf8")}`);
  }
  return parts.join("\n");
}

/// The page for addresses of `depth` levels ("/jobs/ID" has 1): its files are named relative to it, since the service may lie
/// below a path of a proxy.
function page(metafile, depth) {
  const assets = `${"../".repeat(depth) || "./"}assets`;
  const outputs = Object.entries(metafile.outputs);
  const nameOf = (test) => path.basename(outputs.find(([, value]) => test(value))[0]);
  const [, main] = outputs.find(([, value]) => value.entryPoint === "main.tsx");
  const chunks = main.imports.filter((entry) => entry.kind === "import-statement").map((entry) => path.basename(entry.path));
  return readFileSync(path.join(here, "index.html"), "utf8")
    .replace("ICON", `${assets}/${nameOf((value) => value.entryPoint === "icon.svg")}`)
    .replace("STYLE", `${assets}/${path.basename(main.cssBundle)}`)
    .replace("MAIN", `${assets}/${nameOf((value) => value.entryPoint === "main.tsx")}`)
    .replace("<!--CHUNKS-->", chunks.map((name) => `<link rel="modulepreload" href="${assets}/${name}">`).join("\n"));
}

/// studio_bytes.S holds the bytes, studio_files.cpp the table of server/api/studio.h.
function writeSources() {
  const rows = [];
  const bytes = ["  .section .rodata\n"];
  const names = readdirSync(files)
    .filter((name) => !name.endsWith(".gz"))
    .sort();
  names.forEach((name, number) => {
    const file = path.join(files, name);
    const content = readFileSync(file);
    writeFileSync(`${file}.gz`, gzipSync(content, { level: 9 }));
    const etag = createHash("sha256").update(content).digest("hex").slice(0, 16);
    for (const [kind, source] of [
      ["plain", file],
      ["gzip", `${file}.gz`],
    ]) {
      const symbol = `throng_studio_${number}_${kind}`;
      bytes.push(`  .global ${symbol}, ${symbol}_end\n${symbol}:\n  .incbin "${source}"\n${symbol}_end:\n  .byte 0\n`);
    }
    const span = (kind) => `between(throng_studio_${number}_${kind}, throng_studio_${number}_${kind}_end)`;
    const type = kTypes[path.extname(name)];
    rows.push(`    StudioFile{"${name}", "${type}", "\\"${etag}\\"", ${span("plain")}, ${span("gzip")}},\n`);
  });
  // A change of the bytes alone has to change this file, which the build compares.
  bytes.unshift(`# ${createHash("sha256").update(rows.join("")).digest("hex")}\n`);
  bytes.push('  .section .note.GNU-stack, "", %progbits\n');
  const symbols = rows
    .map((_, number) =>
      ["plain", "gzip"]
        .map((kind) => `extern const char throng_studio_${number}_${kind}[], throng_studio_${number}_${kind}_end[];\n`)
        .join(""),
    )
    .join("");
  const table = `// Written by web/studio/build.mjs.  NOLINTBEGIN
#include <array>
#include <cstddef>
#include <span>

#include "server/http/studio_file.h"

extern "C" {
${symbols}}
namespace throng::embedded {
using server::StudioFile;
namespace {
std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}
const std::array kFiles = {
${rows.join("")}};
}  // namespace
extern const std::span<const StudioFile> kStudio;
const std::span<const StudioFile> kStudio = kFiles;
}  // namespace throng::embedded
// NOLINTEND
`;
  writeFileSync(path.join(output, "studio_bytes.S"), bytes.join(""));
  writeFileSync(path.join(output, "studio_files.cpp"), table);
}

function finish(result) {
  writeFileSync(path.join(files, "notice.txt"), notice(result.metafile));
  // server/api/studio.cpp chooses by the depth of the address.
  for (let depth = 0; depth < 8; ++depth) writeFileSync(path.join(files, `index.${depth}.html`), page(result.metafile, depth));
  writeFileSync(path.join(output, "metafile.json"), JSON.stringify(result.metafile));
  writeSources();
}

if (existsSync(files)) rmSync(files, { recursive: true });
mkdirSync(files, { recursive: true });
if (process.argv.includes("--watch")) {
  const end = { name: "end", setup: (build) => build.onEnd((result) => result.errors.length || finish(result)) };
  const context = await esbuild.context({ ...options, minify: false, plugins: [...modules, end] });
  await context.watch();
} else {
  finish(await esbuild.build(options));
}
