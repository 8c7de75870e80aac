// Writes api/types.ts, the types of the service's answers, from `throng schema openapi`.
// usage: node generate_types.mjs THRONG [--check]   --check writes nothing and exits with 1 if the file is not up to date
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const target = path.join(here, "api/types.ts");
const document = JSON.parse(execFileSync(process.argv[2], ["schema", "openapi"], { maxBuffer: 1 << 26 }));
const kPlain = { string: "string", integer: "number", number: "number", boolean: "boolean", null: "null" };

function typeOf(schema, indent) {
  if (schema.$ref) return schema.$ref.split("/").pop();
  if (schema.enum) return schema.enum.map((value) => JSON.stringify(value)).join(" | ");
  if ("const" in schema) return JSON.stringify(schema.const);
  if (schema.oneOf)
    return schema.oneOf
      .map((part) => typeOf(part, indent))
      .reverse()
      .join(" | ");
  if (Array.isArray(schema.type)) return schema.type.map((name) => kPlain[name] ?? "unknown").join(" | ");
  if (schema.type === "array") {
    const item = typeOf(schema.items ?? {}, indent);
    return item.includes("|") ? `(${item})[]` : `${item}[]`;
  }
  if (schema.type !== "object") return kPlain[schema.type] ?? "unknown";
  const values = schema.additionalProperties;
  const rest = typeof values === "object" ? typeOf(values, indent) : "unknown";
  return schema.properties ? members(schema, indent) : `Record<string, ${rest}>`;
}

function members(schema, indent) {
  const inner = `${indent}  `;
  const required = new Set(schema.required ?? []);
  // Required members without a description are there all the same.
  const others = [...required].filter((key) => !(key in schema.properties)).map((key) => [key, {}]);
  const described = { ...schema.properties, ...Object.fromEntries(others) };
  const lines = Object.entries(described).map(([key, value]) => {
    const comment = value.description ? `${inner}/** ${value.description} */\n` : "";
    return `${comment}${inner}${key}${required.has(key) ? "" : "?"}: ${typeOf(value, inner)};\n`;
  });
  return `{\n${lines.join("")}${indent}}`;
}

const parts = ["// Made by web/studio/generate_types.mjs from `throng schema openapi`; do not edit.\n"];
for (const [name, schema] of Object.entries(document.components.schemas)) {
  if (schema.description) parts.push(`/** ${schema.description} */`);
  parts.push(schema.properties ? `export interface ${name} ${members(schema, "")}\n` : `export type ${name} = ${typeOf(schema, "")};\n`);
}
const text = parts.join("\n").replace(/\*\/\n\nexport/g, "*/\nexport");
if (process.argv.includes("--check")) {
  if (!existsSync(target) || readFileSync(target, "utf8") !== text) {
    console.error("web/studio/api/types.ts is not up to date: run node web/studio/generate_types.mjs THRONG");
    process.exit(1);
  }
} else {
  writeFileSync(target, text);
}
