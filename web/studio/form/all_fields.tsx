// Every field of the job's schema, with a search.
import { useState } from "preact/hooks";
import type { Form } from "./draft";
import { Field } from "./field";
import { isObject, type Path, pointerOf, valueAt } from "./json";
import { hasType, isFound, type Schema } from "./schema";

interface PartProps {
  form: Form;
  path: Path;
  schema: Schema;
  words: string[];
}

const hasParts = (schema: Schema) => Boolean(schema.properties) && !hasType(schema, "string");
const isListOfParts = (schema: Schema) => hasType(schema, "array") && Boolean(schema.items?.properties);

export function Members({ form, path, schema, words }: PartProps) {
  const members = Object.entries(schema.properties ?? {}).filter(
    ([key, member]) =>
      (!member.deprecated || valueAt(form.value, [...path, key]) !== undefined) &&
      (words.length === 0 || isFound([...path, key].join(" "), member, words)),
  );
  const plain = members.filter(([, member]) => !hasParts(member) && !isListOfParts(member));
  const nested = members.filter(([, member]) => hasParts(member) || isListOfParts(member));
  return (
    <>
      {plain.length > 0 && (
        <div class="fields">
          {plain.map(([key, member]) => (
            <Field key={key} form={form} path={[...path, key]} schema={member} isRequired={schema.required?.includes(key)} />
          ))}
        </div>
      )}
      {nested.map(([key, member]) =>
        isListOfParts(member) ? (
          <ListPart key={key} form={form} path={[...path, key]} schema={member} words={words} />
        ) : (
          <Part key={key} form={form} path={[...path, key]} schema={member} words={words} />
        ),
      )}
    </>
  );
}

/** Open while it holds something that the job names, an error, or what is searched for. */
function Part({ form, path, schema, words, title }: PartProps & { title?: string }) {
  const pointer = pointerOf(path);
  const count = form.errors.filter((error) => error.pointer.startsWith(pointer)).length;
  const value = valueAt(form.value, path);
  const isSet = isObject(value) && Object.keys(value).length > 0;
  return (
    <details class="part" open={words.length > 0 || count > 0 || path.length === 1 || isSet}>
      <summary>
        {title ?? schema.title ?? String(path.at(-1))}
        <span class="field-note"> {schema.description}</span>
        {count > 0 && <span class="field-error"> {count === 1 ? "1 error" : `${count} errors`}</span>}
      </summary>
      <Members form={form} path={path} schema={schema} words={words} />
    </details>
  );
}

function ListPart({ form, path, schema, words }: PartProps) {
  const value = valueAt(form.value, path);
  const list = Array.isArray(value) ? value : [];
  const title = schema.items?.title ?? "Item";
  const add = () => form.change([...path, list.length], { id: `d${list.length + 1}` });
  return (
    <section class="part-list" aria-label={schema.title}>
      {list.map((item, index) => (
        <div key={index} class="part-item">
          <Part
            form={form}
            path={[...path, index]}
            schema={schema.items!}
            words={words}
            title={`${title} ${index + 1}${isObject(item) && item["id"] ? `: ${String(item["id"])}` : ""}`}
          />
          <button type="button" class="button small danger-text" onClick={() => form.change([...path, index], undefined)}>
            Remove {title.toLowerCase()} {index + 1}
          </button>
        </div>
      ))}
      <button type="button" class="button small" onClick={add}>
        Add {title.toLowerCase()}
      </button>
    </section>
  );
}

export function AllFields({ form, schema }: { form: Form; schema: Schema }) {
  const [search, setSearch] = useState("");
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  return (
    <div class="all-fields">
      <label class="search">
        <span class="hidden">Search fields</span>
        <input
          type="search"
          placeholder="Search fields, e.g. weather or exposure"
          value={search}
          onInput={(event) => setSearch(event.currentTarget.value)}
        />
      </label>
      <Members form={form} path={[]} schema={schema} words={words} />
    </div>
  );
}
