// The schema of a study with those parts that are as in a job: crowds and drones.
import type { Path } from "../form/json";
import type { Schema } from "../form/schema";

/** The schema of a study as the service sends it. */
export interface StudySchema extends Schema {
  definitions?: Record<string, Schema>;
}

interface Referring extends Schema {
  $ref?: string;
}

const nameOf = (schema: Referring) => schema.$ref?.replace(/^#\/definitions\//, "");

function resolved(schema: Referring, parts: Record<string, Schema>): Schema {
  const name = nameOf(schema);
  const at = name ? (parts[name] ?? {}) : schema;
  const properties =
    at.properties && Object.fromEntries(Object.entries(at.properties).map(([key, member]) => [key, resolved(member, parts)]));
  const items = at.items && resolved(at.items, parts);
  return { ...at, ...(properties && { properties }), ...(items && { items }) };
}

/** References become what they name; `crowd` and `drones` are those of the job's schema. */
export function withJobParts(study: StudySchema, job: Schema): Schema {
  const { crowd = {}, drones = {} } = job.properties ?? {};
  return resolved(study, { ...study.definitions, crowd, drones: { ...drones, minItems: undefined } });
}

/** A schema without the fields at these paths, which a form shows elsewhere. */
export function withoutFields(schema: Schema, paths: readonly Path[]): Schema {
  const kept = Object.entries(schema.properties ?? {}).flatMap(([key, member]): [string, Schema][] => {
    const below = paths.filter((path) => path[0] === key);
    if (below.some((path) => path.length === 1)) return [];
    return [
      [
        key,
        below.length
          ? withoutFields(
              member,
              below.map((path) => path.slice(1)),
            )
          : member,
      ],
    ];
  });
  return { ...schema, properties: Object.fromEntries(kept) };
}
