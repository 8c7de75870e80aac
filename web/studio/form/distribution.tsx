// A value that is fixed, or sampled for each run (docs/job_randomization.md).
import type { JSX } from "preact";
import type { ControlProps } from "./field";
import { isObject, type Json } from "./json";
import { choicesOf, isNumeric } from "./schema";

/** A number where the text is one; the text itself else, which the service reports at this field. */
export function numberOrText(text: string): Json {
  return /^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*$/.test(text) ? Number(text) : text;
}

const kNames: Record<string, { label: string; first: string; second: string }> = {
  uniform: { label: "uniform", first: "from", second: "to" },
  log_uniform: { label: "log-uniform", first: "from", second: "to" },
  normal: { label: "normal", first: "mean", second: "deviation" },
};

export function DistributionControl({ id, schema, value, onChange, aria }: ControlProps): JSX.Element {
  const kinds = schema["x-distribution"] ?? [];
  const kind = isObject(value) ? (kinds.find((name) => name in value) ?? "fixed") : "fixed";
  const list = isObject(value) && Array.isArray(value[kind]) ? (value[kind] as Json[]) : [];
  const read = (text: string): Json => (isNumeric(schema) ? numberOrText(text) : text);
  const start = (kind === "fixed" ? value : list[0]) ?? schema.default ?? 0;
  const select = (next: string) => {
    if (next === "fixed") onChange(start === schema.default ? undefined : start);
    else if (next === "choice") onChange({ choice: list.length ? list : [start] });
    else onChange({ [next]: [list[0] ?? start, list[1] ?? start] });
  };
  const names = kNames[kind];
  const choices = choicesOf(schema);
  const change = (index: number, text: string) => onChange({ [kind]: [0, 1].map((i) => (i === index ? read(text) : (list[i] ?? 0))) });
  return (
    <div class="distribution">
      {kind === "fixed" && choices.length > 0 && (
        <select
          id={id}
          value={value === undefined ? "" : String(value)}
          onChange={(event) => onChange(event.currentTarget.value || undefined)}
          {...aria}
          aria-label={`${schema.title ?? ""}: value`}
        >
          <option value="">{String(schema.default ?? "–")} (default)</option>
          {choices
            .filter((choice) => choice !== schema.default || choice === value)
            .map((choice) => (
              <option key={choice}>{choice}</option>
            ))}
        </select>
      )}
      {kind === "fixed" && choices.length === 0 && (
        <input
          id={id}
          class="short"
          type="text"
          value={value === undefined ? "" : String(value)}
          placeholder={schema.default === undefined ? "" : String(schema.default)}
          onInput={(event) => onChange(event.currentTarget.value === "" ? undefined : read(event.currentTarget.value))}
          {...aria}
          aria-label={`${schema.title ?? ""}: value`}
        />
      )}
      {kind === "choice" && (
        <input
          id={id}
          type="text"
          value={list.map(String).join(", ")}
          onChange={(event) => onChange({ choice: event.currentTarget.value.split(",").map((text) => read(text.trim())) })}
          {...aria}
          aria-label={`${schema.title ?? ""}: values, separated by commas`}
        />
      )}
      {names &&
        [names.first, names.second].map((name, index) => (
          <input
            key={name}
            id={index === 0 ? id : undefined}
            class="short"
            type="text"
            value={String(list[index] ?? "")}
            placeholder={name}
            onInput={(event) => change(index, event.currentTarget.value)}
            {...aria}
            aria-label={`${schema.title ?? ""}: ${name}`}
          />
        ))}
      <select aria-label={`${schema.title ?? ""}: fixed or sampled`} value={kind} onChange={(event) => select(event.currentTarget.value)}>
        <option value="fixed">fixed</option>
        {kinds.map((name) => (
          <option key={name} value={name}>
            {kNames[name]?.label ?? name}
          </option>
        ))}
      </select>
    </div>
  );
}
