// The editor of blueprints: a plan to draw in, its elements' fields, and what the check finds.
import { useLayoutEffect, useMemo, useState } from "preact/hooks";
import type { JsonObject } from "../form/json";
import { useKeys } from "../parts/keys";
import { useCheckedBlueprint } from "./check";
import { type Element, elementsOf, rectangleOf } from "./elements";
import { OpenBar, storeBlueprint, storedBlueprint, UploadPanel } from "./file";
import { FindingList } from "./findings";
import { type History, useHistory } from "./history";
import { kKinds, type Point } from "./kinds";
import { middleOfPoints } from "./names";
import { PlanEditor } from "./plan_editor";
import { BlueprintFields, Properties } from "./properties";
import { focusElement, type Tool } from "./tools";
import { type Underlay, UnderlayPanel } from "./underlay";
import { middleOf, useView, type View, zoomed } from "./view";

const kTools: { tool: Tool; label: string; key: string }[] = [
  { tool: "select", label: "Select", key: "v" },
  { tool: "wall", label: "Wall", key: "w" },
  ...kKinds.filter((kind) => kind.key).map((kind) => ({ tool: kind.name, label: kind.label, key: kind.key })),
];
const kGrids = [0.1, 0.5, 1, 5, 0];
const kZoom = 1.4;
const kUsualWidthM = 80;

interface ToolBarProps {
  tool: Tool;
  onTool: (tool: Tool) => void;
  grid: number;
  onGrid: (grid: number) => void;
  history: History<JsonObject>;
  view: View;
  onView: (view: View | null) => void;
}

function ToolBar({ tool, onTool, grid, onGrid, history, view, onView }: ToolBarProps) {
  return (
    <div class="plan-tools" role="toolbar" aria-label="Tools">
      <div class="tool-group">
        {kTools.map((entry) => (
          <button
            key={entry.tool}
            type="button"
            class="button small"
            aria-pressed={tool === entry.tool}
            aria-keyshortcuts={entry.key}
            onClick={() => onTool(entry.tool)}
          >
            {entry.label} <kbd>{entry.key}</kbd>
          </button>
        ))}
      </div>
      <div class="tool-group">
        <button type="button" class="button small" disabled={!history.canUndo} aria-keyshortcuts="Control+Z" onClick={history.undo}>
          Undo
        </button>
        <button type="button" class="button small" disabled={!history.canRedo} aria-keyshortcuts="Control+Y" onClick={history.redo}>
          Redo
        </button>
        <button type="button" class="button small" aria-label="Zoom in" onClick={() => onView(zoomed(view, 1 / kZoom, middleOf(view)))}>
          +
        </button>
        <button type="button" class="button small" aria-label="Zoom out" onClick={() => onView(zoomed(view, kZoom, middleOf(view)))}>
          −
        </button>
        <button type="button" class="button small" onClick={() => onView(null)}>
          Whole
        </button>
        <label class="row">
          Grid
          <select value={String(grid)} onChange={(event) => onGrid(Number(event.currentTarget.value))}>
            {kGrids.map((step) => (
              <option key={step} value={String(step)}>
                {step > 0 ? `${step} m` : "off"}
              </option>
            ))}
          </select>
        </label>
      </div>
    </div>
  );
}

function ElementList({
  elements,
  selected,
  onShow,
}: {
  elements: Element[];
  selected: Element | undefined;
  onShow: (element: Element) => void;
}) {
  return (
    <details class="part">
      <summary>All elements ({elements.length})</summary>
      <ul class="plain-list element-list">
        {elements.map((element) => (
          <li key={element.pointer}>
            <button type="button" class="link" aria-current={element === selected} onClick={() => onShow(element)}>
              {element.label}
            </button>
          </li>
        ))}
      </ul>
    </details>
  );
}

/** Letters choose a tool, Control+Z and Control+Y go back and forth; not while something is typed. */
function useEditorKeys(history: History<JsonObject>, onTool: (tool: Tool) => void): void {
  useKeys((event) => {
    const target = event.target as HTMLElement;
    if (["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName) || event.altKey) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      if (key === "z" && !event.shiftKey) history.undo();
      else if (key === "y" || (key === "z" && event.shiftKey)) history.redo();
      else return;
      return event.preventDefault();
    }
    const tool = key === "escape" ? "select" : kTools.find((entry) => entry.key === key)?.tool;
    if (tool) onTool(tool);
  });
}

export function BlueprintScreen() {
  const history = useHistory(storedBlueprint);
  const blueprint = history.present;
  const elements = useMemo(() => elementsOf(blueprint), [blueprint]);
  const [pointer, setPointer] = useState<string | null>(null);
  const [tool, setTool] = useState<Tool>("select");
  const [grid, setGrid] = useState(0.5);
  const [view, setView] = useView(blueprint);
  const [underlay, setUnderlay] = useState<Underlay | null>(null);
  const [points, setPoints] = useState<Point[] | null>(null);
  const check = useCheckedBlueprint(blueprint);
  // At once, so that a reload right after a change keeps it.
  useLayoutEffect(() => storeBlueprint(blueprint), [blueprint]);
  useEditorKeys(history, setTool);
  const selected = elements.find((element) => element.pointer === pointer);
  const show = (element: Element) => {
    setPointer(element.pointer);
    setTool("select");
    if (element.points.length > 0) {
      const [x, y] = middleOfPoints(element.points);
      const isSeen = x > view.x && x < view.x + view.width && -y > view.y && -y < view.y + view.height;
      if (!isSeen) setView({ ...view, x: x - view.width / 2, y: -y - view.height / 2 });
    }
    document.querySelector(".plan-editor")?.scrollIntoView({ block: "nearest" });
    requestAnimationFrame(() => focusElement(element.pointer));
  };
  const open = (next: JsonObject) => {
    history.change(next);
    setPointer(null);
    setView(null);
  };
  const ground = rectangleOf(blueprint, "ground");
  return (
    <div class="screen blueprint">
      <div class="row wrap heading">
        <h1 class="grow">Blueprint</h1>
        <OpenBar document={blueprint} onOpen={open} />
      </div>
      <ToolBar tool={tool} onTool={setTool} grid={grid} onGrid={setGrid} history={history} view={view} onView={setView} />
      <div class="blueprint-body">
        <div class="stack">
          <PlanEditor
            history={history}
            elements={elements}
            selected={selected}
            onSelect={setPointer}
            tool={tool}
            onTool={setTool}
            grid={grid}
            view={view}
            onView={setView}
            underlay={underlay}
            onUnderlayPoint={points !== null && points.length < 2 ? (point) => setPoints([...points, point]) : null}
          />
          <p class="quiet-text">
            Drag to draw, move or pan; Ctrl and the wheel zoom. Tab goes through the elements, arrow keys move what has the focus (Shift:
            ten steps), Delete removes it. Enter on an element leads to its corners, Enter in the plan adds an element of the chosen tool.
          </p>
        </div>
        <div class="stack">
          {selected ? (
            <Properties document={blueprint} element={selected} onChange={history.change} onRemove={() => setPointer(null)} />
          ) : (
            <BlueprintFields document={blueprint} onChange={history.change} />
          )}
          <FindingList check={check} elements={elements} onShow={show} />
          <UploadPanel
            document={blueprint}
            canUpload={!check.isPending && check.message === null && !check.findings.some((finding) => finding.severity === "error")}
          />
          <UnderlayPanel
            underlay={underlay}
            onChange={setUnderlay}
            points={points}
            onPoints={setPoints}
            widthM={ground ? ground[2] - ground[0] : kUsualWidthM}
          />
          <ElementList elements={elements} selected={selected} onShow={show} />
        </div>
      </div>
    </div>
  );
}
