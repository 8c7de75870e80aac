// A study as fields: its runs, its cases, and its policies with their drones.
import type { ComponentChildren } from "preact";
import { useScenarios } from "../api/resource";
import type { Scenario } from "../api/types";
import { Members } from "../form/all_fields";
import type { Form } from "../form/draft";
import { Field } from "../form/field";
import { isObject, type Json, type JsonObject, type Path, pointerOf, valueAt } from "../form/json";
import { Plan } from "../form/plan";
import { type Schema, schemaAt } from "../form/schema";
import { withoutFields } from "./study_schema";

const kStudyFields = ["name", "seed", "runs", "baseline", "baseline_case", "horizons_s"];
const kCaseFields: Path[] = [
  ["id"],
  ["title"],
  ["scenario"],
  ["close"],
  ["crowd", "agents"],
  ["crowd", "model"],
  ["crowd", "compat"],
  ["alarm_s"],
  ["duration_s"],
];
const kReferenceFields: Path[] = [
  ["reference", "speed_mps"],
  ["reference", "capacity_per_s"],
];
const kDroneFields: Path[] = [
  ["id"],
  ["start"],
  ["guidance", "policy"],
  ["guidance", "speed_mps"],
  ["guidance", "lead_speed_mps"],
  ["moves_goal"],
];
// Studies make no images.
const kImageFields: Path[] = [["camera"]];

interface PartProps {
  form: Form;
  schema: Schema;
}

interface ItemProps extends PartProps {
  path: Path;
}

const listAt = (form: Form, path: Path): Json[] => {
  const value = valueAt(form.value, path);
  return Array.isArray(value) ? value : [];
};

const textAt = (value: Json | undefined, key: string) => (isObject(value) ? String(value[key] ?? "") : "");
const idsOf = (list: Json[]) => list.map((item) => textAt(item, "id")).filter(Boolean);

/** `base`, with a number where it is taken. */
export function freeId(base: string, taken: readonly string[]): string {
  if (!taken.includes(base)) return base;
  const stem = base.replace(/_?\d+$/, "");
  let number = 2;
  while (taken.includes(`${stem}_${number}`)) ++number;
  return `${stem}_${number}`;
}

/** A copy of an item with an id of its own, behind it. */
export function withCopy(list: readonly Json[], index: number): Json[] {
  const item = list[index];
  if (!isObject(item)) return [...list];
  const copy: JsonObject = { ...item, id: freeId(textAt(item, "id") || "copy", idsOf([...list])) };
  return [...list.slice(0, index + 1), copy, ...list.slice(index + 1)];
}

interface ItemBoxProps {
  form: Form;
  path: Path; ///< of the list
  index: number;
  noun: string;
  children: ComponentChildren;
}

function ItemBox({ form, path, index, noun, children }: ItemBoxProps) {
  const list = listAt(form, path);
  const name = textAt(list[index], "title") || textAt(list[index], "id") || String(index + 1);
  return (
    <div class="item-fields" role="group" aria-label={`${noun} ${index + 1}`}>
      {children}
      <div class="row wrap">
        <button
          type="button"
          class="button small"
          onClick={() => form.change(path, withCopy(list, index))}
          aria-label={`Duplicate ${noun.toLowerCase()} ${name}`}
        >
          Duplicate
        </button>
        <button
          type="button"
          class="button small danger-text"
          onClick={() => form.change(path, list.length > 1 ? list.filter((_, i) => i !== index) : undefined)}
          aria-label={`Remove ${noun.toLowerCase()} ${name}`}
        >
          Remove
        </button>
      </div>
    </div>
  );
}

/** What most studies leave as it is; open while something in it is wrong. */
function More({ form, path, schema, title }: ItemProps & { title: string }) {
  const pointer = `${pointerOf(path)}/`;
  const own = Object.keys(schema.properties ?? {}).map((key) => pointer + key);
  const isWrong = form.errors.some((error) => own.some((field) => error.pointer.startsWith(field)));
  return (
    <details class="part" open={isWrong}>
      <summary>{title}</summary>
      <Members form={form} path={path} schema={schema} words={[]} />
    </details>
  );
}

function FieldsOf({ form, path, schema, fields, scenarios }: ItemProps & { fields: readonly Path[]; scenarios?: string[] }) {
  return (
    <div class="fields">
      {fields.map((field) => (
        <Field
          key={field.join(".")}
          form={form}
          path={[...path, ...field]}
          schema={schemaAt(schema, field)}
          options={field[0] === "scenario" ? scenarios : undefined}
          isRequired={field.length === 1 && schema.required?.includes(String(field[0]))}
        />
      ))}
    </div>
  );
}

function Cases({ form, schema, scenarios }: PartProps & { scenarios: Scenario[] }) {
  const cases = listAt(form, ["cases"]);
  const item = schemaAt(schema, ["cases", 0]);
  const crowd = withoutFields(
    schemaAt(item, ["crowd"]),
    kCaseFields.filter(([first]) => first === "crowd").map((path) => path.slice(1)),
  );
  const ids = scenarios.filter((scenario) => !scenario.error && scenario.crowd_model !== null).map((scenario) => scenario.id);
  const add = () =>
    form.change(["cases"], [...cases, { id: freeId("case", idsOf(cases)), scenario: textAt(cases.at(-1), "scenario") || (ids[0] ?? "") }]);
  return (
    <fieldset>
      <legend>Cases</legend>
      {cases.map((_, index) => (
        <ItemBox key={index} form={form} path={["cases"]} index={index} noun="Case">
          <FieldsOf form={form} path={["cases", index]} schema={item} fields={kCaseFields} scenarios={ids} />
          <More form={form} path={["cases", index, "crowd"]} schema={crowd} title="More of the crowd" />
          <details class="part" open={isObject(valueAt(form.value, ["cases", index, "reference"]))}>
            <summary>Reference time</summary>
            <FieldsOf form={form} path={["cases", index]} schema={item} fields={kReferenceFields} />
          </details>
        </ItemBox>
      ))}
      <button type="button" class="button small" onClick={add}>
        Add a case
      </button>
    </fieldset>
  );
}

/** A policy's drones are those of a job: the same plan moves them. */
function formOfPolicy(form: Form, path: Path): Form {
  const pointer = pointerOf(path);
  const errors = form.errors.filter((error) => error.pointer.startsWith(`${pointer}/`));
  const value = valueAt(form.value, path);
  return {
    value: isObject(value) ? value : {},
    errors: errors.map((error) => ({ ...error, pointer: error.pointer.slice(pointer.length) })),
    change: (below, next) => form.change([...path, ...below], next),
  };
}

function Drones({ form, path, schema, scenario }: ItemProps & { scenario: Scenario | undefined }) {
  const list = listAt(form, [...path, "drones"]);
  const item = schemaAt(schema, ["drones", 0]);
  const add = () =>
    form.change([...path, "drones"], [...list, { id: freeId("d1", idsOf(list)), start: [0, 0, 20], guidance: { policy: "balance" } }]);
  const rest = withoutFields(item, [...kDroneFields, ...kImageFields]);
  return (
    <>
      {list.map((drone, index) => (
        <div key={index} class="study-drone" role="group" aria-label={`Drone ${textAt(drone, "id") || index + 1}`}>
          <FieldsOf form={form} path={[...path, "drones", index]} schema={item} fields={kDroneFields} />
          <More form={form} path={[...path, "drones", index]} schema={rest} title="More of the drone" />
          <button
            type="button"
            class="button small danger-text"
            onClick={() => form.change([...path, "drones"], list.length > 1 ? list.filter((_, i) => i !== index) : undefined)}
          >
            Remove drone {textAt(drone, "id")}
          </button>
        </div>
      ))}
      {scenario && list.length > 0 && (
        <details class="part">
          <summary>Starts on the plan of {scenario.name ?? scenario.id}</summary>
          <Plan form={formOfPolicy(form, path)} scenario={scenario} />
        </details>
      )}
      {list.length === 0 && <p class="field-note">No drones.</p>}
      <button type="button" class="button small" onClick={add}>
        Add a drone
      </button>
    </>
  );
}

function Policies({ form, schema, scenario }: PartProps & { scenario: Scenario | undefined }) {
  const policies = listAt(form, ["policies"]);
  const item = schemaAt(schema, ["policies", 0]);
  const add = () => form.change(["policies"], [...policies, { id: freeId("policy", idsOf(policies)) }]);
  return (
    <fieldset>
      <legend>Policies</legend>
      {policies.length === 0 && <p class="field-note">None: each case is simulated without drones.</p>}
      {policies.map((_, index) => (
        <ItemBox key={index} form={form} path={["policies"]} index={index} noun="Policy">
          <FieldsOf form={form} path={["policies", index]} schema={item} fields={[["id"], ["title"]]} />
          <Drones form={form} path={["policies", index]} schema={item} scenario={scenario} />
        </ItemBox>
      ))}
      <button type="button" class="button small" onClick={add}>
        Add a policy
      </button>
    </fieldset>
  );
}

/** `schema` with the job's parts (study_schema.ts). */
export function StudyForm({ form, schema }: PartProps) {
  const list = useScenarios();
  const scenarios = list.value ?? [];
  const first = textAt(listAt(form, ["cases"])[0], "scenario");
  const choices: Record<string, string[]> = { baseline: idsOf(listAt(form, ["policies"])), baseline_case: idsOf(listAt(form, ["cases"])) };
  return (
    <div class="study-form">
      <fieldset>
        <legend>Study</legend>
        <div class="fields">
          {kStudyFields.map((key) => (
            <Field key={key} form={form} path={[key]} schema={schemaAt(schema, [key])} options={choices[key]} />
          ))}
        </div>
      </fieldset>
      <Cases form={form} schema={schema} scenarios={scenarios} />
      <Policies form={form} schema={schema} scenario={scenarios.find((scenario) => scenario.id === first)} />
    </div>
  );
}
