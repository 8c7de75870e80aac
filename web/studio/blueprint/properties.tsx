// Fields of the selected element, and of the blueprint itself.
import { useEffect, useState } from "preact/hooks";
import { isObject, type Json, type JsonObject, type Path, valueAt, withValue } from "../form/json";
import { type Element, removed, withCorner } from "./elements";
import type { FieldSpec } from "./kinds";

interface InputProps {
  id: string;
  label: string;
  unit?: string;
  value: Json | undefined;
  usual?: string;
  isNumber?: boolean;
  onChange: (value: Json | undefined) => void;
}

/** Takes effect when it is left or Enter is pressed, so that each change is one step of the history. */
function TextInput({ id, label, unit, value, usual = "", isNumber = false, onChange }: InputProps) {
  const shown = value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value);
  const [text, setText] = useState(shown);
  useEffect(() => setText(shown), [shown, id]);
  const apply = () => {
    if (text === shown) return;
    const isFigure = isNumber && text.trim() !== "" && !Number.isNaN(Number(text));
    onChange(text.trim() === "" ? undefined : isFigure ? Number(text) : text);
  };
  return (
    <label class="field">
      <span class="field-name">
        {label}
        {unit && <span class="unit"> {unit}</span>}
      </span>
      <input
        type="text"
        inputMode={isNumber ? "decimal" : "text"}
        autocomplete="off"
        value={text}
        placeholder={usual}
        onInput={(event) => setText(event.currentTarget.value)}
        onBlur={apply}
        onKeyDown={(event) => event.key === "Enter" && apply()}
      />
    </label>
  );
}

interface ChoiceProps {
  label: string;
  value: Json | undefined;
  choices: string[];
  usual: string | null; ///< null: one has to be chosen
  onChange: (value: string | undefined) => void;
}

function Choice({ label, value, choices, usual, onChange }: ChoiceProps) {
  const current = value === undefined ? "" : String(value);
  return (
    <label class="field">
      <span class="field-name">{label}</span>
      <select value={current} onChange={(event) => onChange(event.currentTarget.value || undefined)}>
        {usual !== null && <option value="">{usual ? `(${usual})` : "–"}</option>}
        {current && !choices.includes(current) && <option>{current}</option>}
        {choices.map((choice) => (
          <option key={choice}>{choice}</option>
        ))}
      </select>
    </label>
  );
}

interface PropertiesProps {
  document: JsonObject;
  element: Element;
  onChange: (document: JsonObject) => void;
  onRemove: () => void;
}

function ElementField({ document, element, field, onChange }: Omit<PropertiesProps, "onRemove"> & { field: FieldSpec }) {
  const path = field.key.split("/");
  const set = (value: Json | undefined) => onChange(withValue(document, [...element.path, ...path], value) as JsonObject);
  const value = valueAt(element.value, path);
  if (field.type === "check") {
    return (
      <label class="row check-field">
        <input type="checkbox" checked={value !== false} onChange={(event) => set(event.currentTarget.checked ? undefined : false)} />
        {field.label}
      </label>
    );
  }
  if (field.type === "choice" || field.type === "exit") {
    const exits = valueAt(document, ["exits"]);
    const ids = (Array.isArray(exits) ? exits : []).flatMap((exit) =>
      isObject(exit) && typeof exit["id"] === "string" ? [exit["id"]] : [],
    );
    const isFigure = field.choices?.every((choice) => !Number.isNaN(Number(choice))) ?? false;
    return (
      <Choice
        label={field.label}
        value={value}
        choices={field.type === "exit" ? ids : (field.choices ?? [])}
        usual={field.isRequired ? null : (field.usual ?? "")}
        onChange={(next) => set(next !== undefined && isFigure ? Number(next) : next)}
      />
    );
  }
  return (
    <TextInput
      id={`${element.pointer}/${field.key}`}
      label={field.label}
      {...(field.unit ? { unit: field.unit } : {})}
      value={value}
      usual={field.usual ?? ""}
      isNumber={field.type === "number"}
      onChange={set}
    />
  );
}

function CornerFields({ document, element, onChange }: Omit<PropertiesProps, "onRemove">) {
  const names =
    element.kind.shape === "point"
      ? ["Blueprint"]
      : element.kind.shape === "segment"
        ? ["From", "To"]
        : element.points.map((_, i) => `Corner ${i + 1}`);
  const start = element.kind.name === "drone" ? element.value["start"] : undefined;
  return (
    <>
      {element.points.map((point, index) => (
        <div key={index} class="corner-fields" role="group" aria-label={names[index]}>
          {[0, 1].map((axis) => (
            <TextInput
              key={axis}
              id={`${element.pointer}-${index}-${axis}`}
              label={`${names[index]} ${axis === 0 ? "x" : "y"}`}
              unit="m"
              isNumber
              value={point[axis]!}
              onChange={(value) => {
                if (typeof value === "number")
                  onChange(withCorner(document, element, index, axis === 0 ? [value, point[1]] : [point[0], value]));
              }}
            />
          ))}
        </div>
      ))}
      {Array.isArray(start) && (
        <TextInput
          id={`${element.pointer}-height`}
          label="Height"
          unit="m"
          isNumber
          value={start[2]}
          onChange={(value) => onChange(withValue(document, [...element.path, "start"], [start[0]!, start[1]!, value ?? 0]) as JsonObject)}
        />
      )}
    </>
  );
}

export function Properties({ document, element, onChange, onRemove }: PropertiesProps) {
  const fields = element.kind.fields;
  const remove = () => {
    onChange(removed(document, element));
    onRemove();
  };
  return (
    <section class="card summary" aria-labelledby="element">
      <h2 id="element">{element.label}</h2>
      <div class="fields">
        {fields.map((field) => (
          <ElementField key={`${element.pointer}${field.key}`} document={document} element={element} field={field} onChange={onChange} />
        ))}
      </div>
      <details class="corners">
        <summary>Coordinates</summary>
        <CornerFields document={document} element={element} onChange={onChange} />
      </details>
      <div class="actions">
        <button type="button" class="button small danger-text" onClick={remove}>
          Remove
        </button>
      </div>
    </section>
  );
}

/** Name, ground, sitters, and the rectangle or polygon that people escape from. */
export function BlueprintFields({ document, onChange }: { document: JsonObject; onChange: (document: JsonObject) => void }) {
  const set = (path: Path, value: Json | undefined) => onChange((withValue(document, path, value) ?? {}) as JsonObject);
  const corner = (rectangle: string, end: string, axis: number, label: string) => {
    const point = valueAt(document, [rectangle, end]);
    const list: Json[] = Array.isArray(point) ? point : [0, 0];
    return (
      <TextInput
        id={`${rectangle}-${end}-${axis}`}
        label={label}
        unit="m"
        isNumber
        value={list[axis]}
        onChange={(value) => set([rectangle, end], axis === 0 ? [value ?? 0, list[1]!] : [list[0]!, value ?? 0])}
      />
    );
  };
  const rectangle = (name: string, legend: string) => (
    <div role="group" aria-label={legend}>
      <p class="field-name">{legend}</p>
      <div class="corner-fields">
        {corner(name, "min", 0, "West")}
        {corner(name, "max", 0, "East")}
        {corner(name, "min", 1, "South")}
        {corner(name, "max", 1, "North")}
      </div>
    </div>
  );
  return (
    <section class="card summary" aria-labelledby="blueprint">
      <h2 id="blueprint">Blueprint</h2>
      <TextInput id="blueprint-name" label="Name" value={document["name"]} onChange={(value) => set(["name"], value)} />
      <TextInput
        id="blueprint-description"
        label="Description"
        value={document["description"]}
        onChange={(value) => set(["description"], value)}
      />
      <Choice
        label="Ground"
        value={valueAt(document, ["ground", "material"])}
        choices={["pavers", "asphalt", "grass", "concrete", "dirt"]}
        usual={null}
        onChange={(value) => set(["ground", "material"], value)}
      />
      <TextInput
        id="blueprint-sitters"
        label="Share of seats taken, 0 to 1"
        isNumber
        usual="0"
        value={valueAt(document, ["sitters", "share"])}
        onChange={(value) => set(value === undefined ? ["sitters"] : ["sitters", "share"], value)}
      />
      {rectangle("ground", "Drawn ground")}
      {valueAt(document, ["inside", "corners"]) === undefined ? (
        rectangle("inside", "Inside: people who leave it have escaped")
      ) : (
        <p>Inside is a polygon of the file; people who leave it have escaped.</p>
      )}
    </section>
  );
}
