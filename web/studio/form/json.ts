// JSON values by path and by pointer (RFC 6901).

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };
export type Path = readonly (string | number)[];

export const isObject = (value: unknown): value is JsonObject => typeof value === "object" && value !== null && !Array.isArray(value);

export function pointerOf(path: Path): string {
  return path.map((part) => `/${String(part).replace(/~/g, "~0").replace(/\//g, "~1")}`).join("");
}

export function valueAt(value: Json | undefined, path: Path): Json | undefined {
  let at: Json | undefined = value;
  for (const part of path) {
    if (Array.isArray(at)) at = at[Number(part)];
    else if (isObject(at)) at = at[String(part)];
    else return undefined;
  }
  return at;
}

/** A copy with another value at the path; `undefined` removes it, and objects that this leaves empty. */
export function withValue(value: Json | undefined, path: Path, next: Json | undefined): Json | undefined {
  const [part, ...rest] = path;
  if (part === undefined) return next;
  if (typeof part === "number") {
    const list = Array.isArray(value) ? [...value] : [];
    const item = withValue(list[part], rest, next);
    if (item !== undefined) list[part] = item;
    else if (rest.length === 0) list.splice(part, 1);
    else list[part] = {};
    return list;
  }
  const object: JsonObject = isObject(value) ? { ...value } : {};
  const member = withValue(object[part], rest, next);
  if (member === undefined) delete object[part];
  else object[part] = member;
  return next === undefined && Object.keys(object).length === 0 ? undefined : object;
}

export function isEqual(a: Json | undefined, b: Json | undefined): boolean {
  if (a === b) return true;
  if (Array.isArray(a) && Array.isArray(b)) return a.length === b.length && a.every((item, i) => isEqual(item, b[i]));
  if (!isObject(a) || !isObject(b)) return false;
  const keys = new Set([...Object.keys(a), ...Object.keys(b)]);
  return [...keys].every((key) => isEqual(a[key], b[key]));
}

export function textOf(value: Json): string {
  // Lists of numbers stay on one line: they are places.
  return JSON.stringify(value, null, 2).replace(/\[[\s\d.,eE+-]*\]/g, (list) =>
    list.replace(/\s+/g, " ").replace("[ ", "[").replace(" ]", "]"),
  );
}
