// The description of the API (OpenAPI 3.1), as far as it is shown.

export interface Schema {
  $ref?: string;
  type?: string | string[];
  const?: unknown;
  enum?: unknown[];
  oneOf?: Schema[];
  items?: Schema;
  properties?: Record<string, Schema>;
  additionalProperties?: boolean | Schema;
  required?: string[];
  description?: string;
  default?: unknown;
  minimum?: number;
  maximum?: number;
}

export interface Parameter {
  name: string;
  in: "path" | "query" | "header";
  required?: boolean;
  description?: string;
  schema?: Schema;
}

interface Answer {
  $ref?: string;
  description?: string;
  content?: Record<string, { schema?: Schema }>;
}

interface OperationObject {
  summary: string;
  tags?: string[];
  parameters?: Parameter[];
  requestBody?: { content: Record<string, { schema?: Schema }> };
  responses: Record<string, Answer>;
}

export interface Document {
  paths: Record<string, Record<string, OperationObject>>;
  components: { schemas: Record<string, Schema>; responses: Record<string, Answer> };
}

export interface Operation extends OperationObject {
  id: string; ///< "get /v1/jobs"
  method: string;
  path: string;
}

export function operationsOf(document: Document): Operation[] {
  return Object.entries(document.paths).flatMap(([path, methods]) =>
    Object.entries(methods).map(([method, operation]) => ({ id: `${method} ${path}`, method, path, ...operation })),
  );
}

/** Operations by their first tag, in the order of the document. */
export function groupsOf(operations: Operation[]): [tag: string, operations: Operation[]][] {
  const groups = new Map<string, Operation[]>();
  for (const operation of operations) {
    const tag = operation.tags?.[0] ?? "other";
    groups.set(tag, [...(groups.get(tag) ?? []), operation]);
  }
  return [...groups];
}

export function isMatch(operation: Operation, text: string): boolean {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const place = `${operation.method} ${operation.path} ${operation.summary}`.toLowerCase();
  return words.every((word) => place.includes(word));
}

const nameOf = (reference: string) => reference.split("/").at(-1)!;

/** A schema in short: "Job", "string[]", "integer or null". */
export function typeText(schema: Schema): string {
  if (schema.$ref) return nameOf(schema.$ref);
  if (schema.enum) return schema.enum.map((value) => JSON.stringify(value)).join(" | ");
  if ("const" in schema) return JSON.stringify(schema.const);
  if (schema.oneOf) return schema.oneOf.map(typeText).join(" | ");
  if (schema.type === "array") return `${typeText(schema.items ?? {})}[]`;
  if (Array.isArray(schema.type)) return schema.type.join(" | ");
  return schema.type ?? "anything";
}

export function answerOf(document: Document, answer: Answer): Answer {
  return answer.$ref ? (document.components.responses[nameOf(answer.$ref)] ?? {}) : answer;
}

/** Names of the components that a schema names, itself or in its parts. */
export function namesIn(schema: Schema | undefined): string[] {
  if (!schema) return [];
  if (schema.$ref) return [nameOf(schema.$ref)];
  const parts = [...(schema.oneOf ?? []), ...(schema.items ? [schema.items] : []), ...Object.values(schema.properties ?? {})];
  return [...new Set(parts.flatMap(namesIn))];
}

/** The path with its parameters filled in; "" for what is missing. */
export function addressOf(operation: Operation, values: Record<string, string>): string {
  const path = operation.path.replace(/\{(\w+)\}/g, (_, name: string) => (values[name] ?? "").split("/").map(encodeURIComponent).join("/"));
  const query = new URLSearchParams();
  for (const { name, in: place } of operation.parameters ?? []) if (place === "query" && values[name]) query.set(name, values[name]);
  const text = query.toString();
  return text ? `${path}?${text}` : path;
}

export function curlOf(operation: Operation, address: string, host: string, needsKey: boolean): string {
  const types = Object.keys(operation.requestBody?.content ?? {});
  const parts = ["curl"];
  if (operation.method !== "get") parts.push(`-X ${operation.method.toUpperCase()}`);
  if (needsKey) parts.push('-H "Authorization: Bearer $THRONG_KEY"');
  if (types.includes("application/json")) parts.push("-H 'Content-Type: application/json' --data-binary @body.json");
  else if (types.length > 0) parts.push(`-H 'Content-Type: ${types[0]}' --data-binary @FILE`);
  return [...parts, `'${host}${address}'`].join(" ");
}
