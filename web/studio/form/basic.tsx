// The fields that most jobs need.
import { useJson, useScenarios } from "../api/resource";
import type { Scenario } from "../api/types";
import type { Form } from "./draft";
import { Field } from "./field";
import { isObject, type Path, valueAt } from "./json";
import { dronesOf, Plan } from "./plan";
import { type Schema, schemaAt } from "./schema";

interface BasicProps {
  form: Form;
  schema: Schema;
}

const kGroups: { title: string; fields: Path[] }[] = [
  { title: "Dataset", fields: [["name"], ["runs"], ["seed"]] },
  {
    title: "Crowd and light",
    fields: [
      ["crowd", "agents"],
      ["environment", "time_of_day"],
      ["environment", "weather"],
    ],
  },
  { title: "Capture", fields: [["capture", "from_s"], ["capture", "to_s"], ["capture", "rate_hz"], ["capture", "run_to_s"], ["quality"]] },
];

// The rest is for training.
const kSplits: Path[] = [
  ["outputs", "splits", "val"],
  ["outputs", "splits", "test"],
];

const kDroneFields: Path[] = [
  ["id"],
  ["start"],
  ["guidance", "policy"],
  ["camera", "pitch_deg"],
  ["camera", "yaw_deg"],
  ["camera", "calibration"],
  ["camera", "hfov_deg"],
  ["camera", "width"],
  ["camera", "height"],
];

function ScenarioField({ form, schema, scenarios }: BasicProps & { scenarios: Scenario[] }) {
  const value = form.value["scenario"];
  const usable = scenarios.filter((scenario) => !scenario.error);
  return (
    <Field
      form={form}
      path={["scenario"]}
      schema={
        isObject(value) || Array.isArray(value)
          ? schemaAt(schema, ["scenario"])
          : { ...schemaAt(schema, ["scenario"]), type: "string", "x-expected": undefined }
      }
      options={usable.map((scenario) => scenario.id)}
      isRequired
    />
  );
}

function Drones({ form, schema, scenario }: BasicProps & { scenario: Scenario | undefined }) {
  const own = valueAt(form.value, ["drones"]);
  const drones = Array.isArray(own) ? own : [];
  const shown = scenario ? dronesOf(form, scenario) : [];
  const add = () => {
    const base = Array.isArray(own) ? own : shown.map((drone) => ({ id: drone.id }));
    const names = new Set(base.map((drone) => (isObject(drone) ? String(drone["id"]) : "")));
    let number = base.length + 1;
    while (names.has(`d${number}`)) ++number;
    form.change(["drones"], [...base, { id: `d${number}`, start: [0, 0, 30] }]);
  };
  return (
    <fieldset>
      <legend>Drones</legend>
      {!Array.isArray(own) && (
        <p class="field-note">
          The scenario's drones hover at their starts: {shown.map((drone) => drone.id).join(", ") || "none"}. Move one on the plan, or add
          one, to set them here.
        </p>
      )}
      {drones.map((drone, index) => (
        <div key={index} class="drone-fields" role="group" aria-label={`Drone ${index + 1}`}>
          <div class="fields">
            {kDroneFields.map((field) => (
              <Field
                key={field.join(".")}
                form={form}
                path={["drones", index, ...field]}
                schema={schemaAt(schema, ["drones", 0, ...field])}
              />
            ))}
          </div>
          <button
            type="button"
            class="button small danger-text"
            onClick={() => form.change(drones.length > 1 ? ["drones", index] : ["drones"], undefined)}
          >
            Remove {isObject(drone) ? String(drone["id"] ?? "drone") : "drone"}
          </button>
        </div>
      ))}
      <button type="button" class="button small" onClick={add}>
        Add a drone
      </button>
    </fieldset>
  );
}

export function Basic({ form, schema }: BasicProps) {
  const list = useScenarios();
  const formats = useJson<{ formats: { name: string }[] }>("/v1/formats");
  const scenarios = list.value ?? [];
  const scenario = scenarios.find((entry) => entry.id === form.value["scenario"]);
  return (
    <div class="basic">
      <div class="basic-fields">
        <fieldset>
          <legend>Scenario</legend>
          <ScenarioField form={form} schema={schema} scenarios={scenarios} />
          {scenario?.description && <p class="field-note">{scenario.description}</p>}
        </fieldset>
        {kGroups.map((group) => (
          <fieldset key={group.title}>
            <legend>{group.title}</legend>
            <div class="fields">
              {group.fields.map((path) => (
                <Field key={path.join(".")} form={form} path={path} schema={schemaAt(schema, path)} />
              ))}
            </div>
          </fieldset>
        ))}
        <Drones form={form} schema={schema} scenario={scenario} />
        <fieldset>
          <legend>Outputs</legend>
          <Field form={form} path={["outputs", "annotations"]} schema={schemaAt(schema, ["outputs", "annotations"])} />
          <Field
            form={form}
            path={["outputs", "formats"]}
            schema={schemaAt(schema, ["outputs", "formats"])}
            options={formats.value?.formats.map((format) => format.name) ?? []}
          />
          <div class="fields">
            {kSplits.map((path) => (
              <Field key={path.join(".")} form={form} path={path} schema={schemaAt(schema, path)} />
            ))}
          </div>
        </fieldset>
      </div>
      {scenario && <Plan form={form} scenario={scenario} />}
    </div>
  );
}
