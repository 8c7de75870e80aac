// A field of the job, made from its part of the schema.
import type { JSX, TargetedInputEvent } from "preact";
import { useEffect, useState } from "preact/hooks";
import { DistributionControl, numberOrText } from "./distribution";
import type { Form } from "./draft";
import { isEqual, isObject, type Json, type Path, pointerOf, valueAt } from "./json";
import { expectedText, hasType, isNumeric, type Schema } from "./schema";

export interface FieldProps {
  form: Form;
  path: Path;
  schema: Schema;
  label?: string;
  options?: string[]; ///< suggested values
  isRequired?: boolean;
}

export interface ControlProps {
  id: string;
  schema: Schema;
  value: Json | undefined;
  onChange: (value: Json | undefined) => void;
  aria: { "aria-invalid": boolean; "aria-describedby": string; "aria-required": boolean | undefined };
  options?: string[];
}

export const idOf = (path: Path) => `field${pointerOf(path).replace(/\W/g, "-")}`;

function defaultText(schema: Schema): string {
  const { default: value } = schema;
  if (value === undefined || (typeof value === "object" && JSON.stringify(value).length < 3)) return "";
  return Array.isArray(value) ? value.join(", ") : String(value);
}

function TextControl({ id, schema, value, onChange, aria, options }: ControlProps) {
  const text = value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value);
  const onInput = (event: TargetedInputEvent<HTMLInputElement>) => {
    const next = event.currentTarget.value;
    if (next === "") onChange(undefined);
    else onChange(isNumeric(schema) ? numberOrText(next) : next);
  };
  return (
    <>
      <input
        id={id}
        class={isNumeric(schema) ? "short" : ""}
        type="text"
        inputMode={isNumeric(schema) ? "decimal" : "text"}
        value={text}
        placeholder={defaultText(schema)}
        list={options ? `${id}-options` : undefined}
        spellcheck={false}
        autocomplete="off"
        onInput={onInput}
        {...aria}
      />
      {options && (
        <datalist id={`${id}-options`}>
          {options.map((option) => (
            <option key={option} value={option} />
          ))}
        </datalist>
      )}
    </>
  );
}

function SelectControl({ id, schema, value, onChange, aria, options }: ControlProps) {
  const isBoolean = hasType(schema, "boolean");
  const choices = isBoolean ? ["yes", "no"] : (options ?? schema.enum ?? []);
  const preset = isBoolean ? (schema.default === true ? "yes" : schema.default === false ? "no" : "") : defaultText(schema);
  const current = value === undefined ? "" : typeof value === "boolean" ? (value ? "yes" : "no") : String(value);
  const select = (text: string) => onChange(text === "" ? undefined : isBoolean ? text === "yes" : text);
  return (
    <select id={id} value={current} onChange={(event) => select(event.currentTarget.value)} {...aria}>
      <option value="">{preset ? `${preset} (default)` : "–"}</option>
      {current && !choices.includes(current) && <option>{current}</option>}
      {choices
        .filter((choice) => choice !== preset || choice === current)
        .map((choice) => (
          <option key={choice}>{choice}</option>
        ))}
    </select>
  );
}

function SetControl({ id, schema, value, onChange, options }: ControlProps) {
  const choices = options ?? schema.items?.enum ?? [];
  const chosen = (Array.isArray(value) ? value : Array.isArray(schema.default) ? schema.default : []).map(String);
  const toggle = (choice: string, isChosen: boolean) => {
    const next = isChosen ? [...chosen, choice] : chosen.filter((entry) => entry !== choice);
    onChange(isEqual(next, schema.default) ? undefined : next);
  };
  return (
    <div class="checks" id={id}>
      {[...new Set([...choices, ...chosen])].map((choice) => (
        <label key={choice}>
          <input type="checkbox" checked={chosen.includes(choice)} onChange={(event) => toggle(choice, event.currentTarget.checked)} />
          {choice}
        </label>
      ))}
    </div>
  );
}

/** A list of a fixed number of figures, such as a place. */
function TupleControl({ id, schema, value, onChange, aria }: ControlProps) {
  const names = schema["x-parts"] ?? ["x", "y", "z"];
  const list = Array.isArray(value) ? value : [];
  const change = (index: number, text: string) => {
    const next = Array.from({ length: schema.minItems ?? 2 }, (_, i): Json => list[i] ?? 0);
    next[index] = text === "" ? 0 : numberOrText(text);
    onChange(next);
  };
  return (
    <div class="tuple" id={id}>
      {Array.from({ length: schema.minItems ?? 2 }, (_, index) => (
        <input
          key={index}
          class="short"
          type="text"
          inputMode="decimal"
          placeholder={names[index]}
          value={list[index] === undefined ? "" : String(list[index])}
          onInput={(event) => change(index, event.currentTarget.value)}
          {...aria}
          aria-label={`${schema.title ?? ""} ${names[index] ?? index}`}
        />
      ))}
    </div>
  );
}

/** Anything else, as JSON. Text that is no JSON is a string, of which the service says what is wrong. */
function JsonControl({ id, value, onChange, aria }: ControlProps) {
  const shown = value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value);
  const [text, setText] = useState(shown);
  const [isTyping, setTyping] = useState(false);
  useEffect(() => {
    if (!isTyping) setText(shown);
  }, [shown, isTyping]);
  const onInput = (next: string) => {
    setText(next);
    if (next.trim() === "") return onChange(undefined);
    try {
      onChange(JSON.parse(next) as Json);
    } catch {
      onChange(next);
    }
  };
  return (
    <textarea
      id={id}
      class="code"
      rows={shown.length > 60 ? 3 : 1}
      spellcheck={false}
      value={text}
      onFocus={() => setTyping(true)}
      onBlur={() => setTyping(false)}
      onInput={(event) => onInput(event.currentTarget.value)}
      {...aria}
    />
  );
}

function controlOf({ schema, value, options }: ControlProps): (props: ControlProps) => JSX.Element {
  if (schema["x-distribution"]) return DistributionControl;
  if (hasType(schema, "boolean") || schema.enum) return SelectControl;
  if (hasType(schema, "array")) {
    if (schema.items?.enum || options) return SetControl;
    const isTuple = schema.minItems && schema.minItems === schema.maxItems && isNumeric(schema.items ?? {});
    return isTuple && (value === undefined || Array.isArray(value)) ? TupleControl : JsonControl;
  }
  if (isObject(value) || schema.type === "object") return JsonControl;
  return options && schema.type === "string" ? SelectControl : TextControl;
}

export function Field({ form, path, schema, label, options, isRequired }: FieldProps) {
  const id = idOf(path);
  const pointer = pointerOf(path);
  const errors = form.errors.filter((error) => error.pointer === pointer || error.pointer.startsWith(`${pointer}/`));
  const name = label ?? schema.title ?? String(path.at(-1));
  const expected = expectedText(schema);
  const props: ControlProps = {
    id,
    schema,
    options,
    value: valueAt(form.value, path),
    onChange: (value) => form.change(path, value),
    aria: { "aria-invalid": errors.length > 0, "aria-describedby": `${id}-note`, "aria-required": isRequired },
  };
  const Control = controlOf(props);
  const isGroup = Control === SetControl || Control === TupleControl || Control === DistributionControl;
  const Name = isGroup ? "span" : "label";
  return (
    <div class={`field ${errors.length ? "wrong" : ""}`} role={isGroup ? "group" : undefined} aria-label={isGroup ? name : undefined}>
      <Name class="field-name" {...(isGroup ? {} : { for: id })} title={`${path.join(".")}\n${schema.description ?? ""}`}>
        {name}
        {schema.unit && schema.unit !== name.toLowerCase() && <span class="unit"> {schema.unit}</span>}
      </Name>
      <Control {...props} />
      <div id={`${id}-note`}>
        {errors.map((error) => (
          <p key={error.message} class="field-error">
            {error.found ? `found ${error.found}, expected ${error.expected}` : error.message}
          </p>
        ))}
        {errors.length === 0 && expected && <p class="field-note">{expected}</p>}
      </div>
    </div>
  );
}
