// The job's schema (spec/job/job.schema.json), as far as forms need it.
import { isEqual, isObject, type Json, type JsonObject } from "./json";

export interface Schema {
  title?: string;
  description?: string;
  type?: string | string[];
  properties?: Record<string, Schema>;
  items?: Schema;
  required?: string[];
  enum?: string[];
  default?: Json;
  minimum?: number;
  maximum?: number;
  minItems?: number;
  maxItems?: number;
  unit?: string;
  deprecated?: boolean;
  "x-distribution"?: string[];
  "x-expected"?: string;
  "x-parts"?: string[]; ///< names of the figures of a list; default: coordinates
}

export function hasType(schema: Schema, type: string): boolean {
  return Array.isArray(schema.type) ? schema.type.includes(type) : schema.type === type;
}

export const isNumeric = (schema: Schema) => hasType(schema, "number") || hasType(schema, "integer");

export function schemaAt(schema: Schema, path: readonly (string | number)[]): Schema {
  let at: Schema = schema;
  for (const part of path) at = (typeof part === "number" ? at.items : at.properties?.[part]) ?? {};
  return at;
}

/** The value without members that have their default. */
export function withoutDefaults(value: Json, schema: Schema): Json {
  if (Array.isArray(value)) return schema.items ? value.map((item) => withoutDefaults(item, schema.items!)) : value;
  if (!isObject(value) || !schema.properties) return value;
  const result: JsonObject = {};
  for (const [key, member] of Object.entries(value)) {
    const part = schema.properties[key];
    const isRequired = schema.required?.includes(key);
    if (part && !isRequired && isEqual(member, part.default)) continue;
    const next = part ? withoutDefaults(member, part) : member;
    const isBlank = part?.properties && !isRequired && isObject(next) && Object.keys(next).length === 0;
    if (!isBlank) result[key] = next;
  }
  return result;
}

/** Whether a field or one below it has all the words in its name, title or description. */
export function isFound(name: string, schema: Schema, words: string[]): boolean {
  const text = `${name} ${schema.title ?? ""} ${schema.description ?? ""}`.toLowerCase();
  if (words.every((word) => text.includes(word))) return true;
  const children = Object.entries({ ...schema.properties, ...schema.items?.properties });
  return children.some(([key, child]) => isFound(`${name} ${key}`, child, words));
}

/** Values that a text may have; a field with distributions names them in words. */
export function choicesOf(schema: Schema): string[] {
  if (schema.enum) return schema.enum;
  const words = schema["x-expected"] ?? "";
  return words.startsWith("one of ") ? [...words.matchAll(/"([^"]+)"/g)].map((match) => match[1]!) : [];
}

/** What a field takes, in words. */
export function expectedText(schema: Schema): string {
  if (choicesOf(schema).length > 0) return "";
  if (schema["x-expected"]) return schema["x-expected"].replace(/^(a|an) (number|integer) from /, "");
  if (isNumeric(schema) && schema.minimum !== undefined && schema.maximum !== undefined) {
    return `${schema.minimum} to ${schema.maximum}`;
  }
  return "";
}
