// Fields in which jobs differ.
import { isEqual, isObject, type Json, type Path, pointerOf } from "../form/json";

export interface Difference {
  pointer: string;
  values: (Json | undefined)[]; ///< by job; undefined: the job does not have the field
}

const kIgnored = new Set(["/name"]);

/** Objects and lists of equal length are compared by their parts. */
function parts(values: (Json | undefined)[]): (string | number)[] | null {
  if (values.every(isObject)) return [...new Set(values.flatMap((value) => Object.keys(value)))];
  const lists = values.filter(Array.isArray);
  const isOfParts = lists.every((list) => list.length === lists[0]!.length && list.some((item) => isObject(item)));
  return lists.length === values.length && isOfParts ? lists[0]!.map((_, index) => index) : null;
}

export function differencesOf(values: (Json | undefined)[], path: Path = []): Difference[] {
  if (values.every((value) => isEqual(value, values[0]))) return [];
  const keys = parts(values);
  if (!keys) {
    const pointer = pointerOf(path);
    return kIgnored.has(pointer) ? [] : [{ pointer, values }];
  }
  return keys.flatMap((key) =>
    differencesOf(
      values.map((value) => (value as Record<string | number, Json>)[key]),
      [...path, key],
    ),
  );
}
