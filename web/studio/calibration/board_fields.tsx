// Settings of a calibration: the board, and the model of the lens.
import type { ComponentChildren } from "preact";
import type { Mistake } from "../api/types";
import { choicesOf, type Schema, schemaAt } from "../form/schema";
import type { Settings } from "./request";

interface BoardFieldsProps {
  settings: Settings;
  schema: Schema;
  errors: Mistake[];
  onChange: (change: Partial<Settings>) => void;
}

const kBoards = [
  {
    kind: "chessboard",
    label: "Chessboard",
    columns: "Inner corners in a row",
    rows: "Inner corners in a column",
    square: "Side of a square",
  },
  { kind: "charuco", label: "ChArUco board", columns: "Squares in a row", rows: "Squares in a column", square: "Side of a square" },
  { kind: "circles", label: "Asymmetric grid of circles", columns: "Circles in a row", rows: "Rows", square: "Half the distance in a row" },
] as const;

const kLenses: Record<string, string> = {
  auto: "the one that fits best (BIC)",
  pinhole: "pinhole, no distortion",
  brown2: "k1, k2",
  brown4: "k1, k2, p1, p2",
  brown5: "k1 to k3, p1, p2",
  brown8: "k1 to k6, p1, p2",
  fisheye: "fisheye, k1 to k4",
};

interface TextFieldProps {
  label: ComponentChildren;
  pointer: string;
  value: string;
  errors: Mistake[];
  placeholder?: string;
  isNumber?: boolean;
  onInput: (text: string) => void;
}

function TextField({ label, pointer, value, errors, placeholder = "", isNumber = true, onInput }: TextFieldProps) {
  const own = errors.filter((error) => error.pointer === pointer || error.pointer.startsWith(`${pointer}/`));
  const id = `calibration${pointer.replace(/\W/g, "-")}`;
  return (
    <div class={`field ${own.length ? "wrong" : ""}`}>
      <label class="field-name" for={id}>
        {label}
      </label>
      <input
        id={id}
        type="text"
        inputMode={isNumber ? "decimal" : "text"}
        autocomplete="off"
        value={value}
        placeholder={placeholder}
        aria-invalid={own.length > 0}
        aria-describedby={`${id}-note`}
        onInput={(event) => onInput(event.currentTarget.value)}
      />
      <div id={`${id}-note`}>
        {own.map((error) => (
          <p key={error.message} class="field-error">
            found {error.found}, expected {error.expected}
          </p>
        ))}
      </div>
    </div>
  );
}

export function BoardFields({ settings, schema, errors, onChange }: BoardFieldsProps) {
  const board = kBoards.find((entry) => entry.kind === settings.kind) ?? kBoards[0];
  const lenses = choicesOf(schemaAt(schema, ["lens"]));
  const dictionaries = choicesOf(schemaAt(schema, ["board", "dictionary"]));
  const unit = <span class="unit"> m</span>;
  const text = (key: "name" | "columns" | "rows" | "square" | "marker" | "fix" | "prior") => ({
    value: settings[key],
    errors,
    onInput: (value: string) => onChange({ [key]: value }),
  });
  return (
    <fieldset>
      <legend>Board and lens</legend>
      <div class="fields">
        <label class="field">
          <span class="field-name">Board</span>
          <select value={settings.kind} onChange={(event) => onChange({ kind: event.currentTarget.value as Settings["kind"] })}>
            {kBoards.map((entry) => (
              <option key={entry.kind} value={entry.kind}>
                {entry.label}
              </option>
            ))}
          </select>
        </label>
        <TextField label={board.columns} pointer="/board/columns" {...text("columns")} />
        <TextField label={board.rows} pointer="/board/rows" {...text("rows")} />
        <TextField
          label={
            <>
              {board.square}
              {unit}
            </>
          }
          pointer="/board/square"
          placeholder="1"
          {...text("square")}
        />
        {settings.kind === "charuco" && (
          <>
            <TextField label={<>Side of a marker{unit}</>} pointer="/board/marker" placeholder="0.75 squares" {...text("marker")} />
            <label class="field">
              <span class="field-name">Markers</span>
              <select value={settings.dictionary} onChange={(event) => onChange({ dictionary: event.currentTarget.value })}>
                {dictionaries.map((name) => (
                  <option key={name}>{name}</option>
                ))}
              </select>
            </label>
          </>
        )}
        <label class="field">
          <span class="field-name">Lens</span>
          <select value={settings.lens} onChange={(event) => onChange({ lens: event.currentTarget.value })}>
            {lenses.map((name) => (
              <option key={name} value={name}>
                {name}: {kLenses[name] ?? name}
              </option>
            ))}
          </select>
        </label>
        <TextField label="Name" pointer="/name" isNumber={false} placeholder="of the camera" {...text("name")} />
      </div>
      <details class="known" open={settings.fix !== "" || settings.prior !== "" || settings.isSquare}>
        <summary>What is known of the lens</summary>
        <div class="fields">
          <TextField label="Fixed" pointer="/fix" isNumber={false} placeholder="k3, cx = 640" {...text("fix")} />
          <TextField label="About known" pointer="/prior" isNumber={false} placeholder="cx = 640 ± 20" {...text("prior")} />
          <label class="row check-field">
            <input type="checkbox" checked={settings.isSquare} onChange={(event) => onChange({ isSquare: event.currentTarget.checked })} />
            fx and fy are equal
          </label>
        </div>
      </details>
    </fieldset>
  );
}
