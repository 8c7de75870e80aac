// The plan of a blueprint, in which elements are drawn, moved and reshaped by pointer or keyboard.
import type { TargetedPointerEvent } from "preact";
import { useMemo, useRef } from "preact/hooks";
import { type Element, withNewCorner } from "./elements";
import { placedNames } from "./names";
import { type Editing, planKeys, usePlanPointer } from "./plan_actions";
import { Ground, Handles, NewElement, PlanElement, UnderlayImage } from "./plan_parts";
import { Name } from "./shapes";
import type { Underlay } from "./underlay";
import { useUnit } from "./view";

interface PlanEditorProps extends Editing {
  elements: Element[];
  selected: Element | undefined;
  underlay: Underlay | null;
}

/** Names above all elements, whose labels say the same. */
function Names({ elements, selected, unit }: Pick<PlanEditorProps, "elements" | "selected"> & { unit: number }) {
  const names = useMemo(() => placedNames(elements, selected ?? null, unit), [elements, selected, unit]);
  return (
    <g aria-hidden="true">
      {[...names].map(([element, name]) => (
        <Name key={element.pointer} name={name} unit={unit} />
      ))}
    </g>
  );
}

export function PlanEditor(props: PlanEditorProps) {
  const { history, elements, selected, onSelect, tool, view, underlay, onUnderlayPoint } = props;
  const { present } = history;
  const svg = useRef<SVGSVGElement>(null);
  const pointer = usePlanPointer(svg, props);
  const keys = planKeys(svg, props);
  const unit = useUnit(svg, view);
  const canGrab = tool === "select" && !onUnderlayPoint;
  const grab = (event: TargetedPointerEvent<SVGGElement>, element: Element) => {
    if (!canGrab || event.button !== 0) return;
    event.currentTarget.focus({ preventScroll: true });
    pointer.begin(event, { what: "element", element, from: pointer.place(event), document: present });
  };
  return (
    <svg
      ref={svg}
      class={`plan-editor ${canGrab ? "" : "drawing"}`}
      viewBox={`${view.x} ${view.y} ${view.width} ${view.height}`}
      role="application"
      aria-label="Plan. Enter adds an element of the chosen tool in the middle; arrow keys move the view, or the element that has the focus. Enter on an element leads to its corners."
      tabindex={0}
      onPointerDown={pointer.onDown}
      onPointerMove={pointer.onMove}
      onPointerUp={pointer.onUp}
      onPointerCancel={pointer.onUp}
      onKeyDown={keys.onPlan}
      onWheel={pointer.onWheel}
    >
      <Ground document={present} unit={unit} />
      {underlay && <UnderlayImage underlay={underlay} />}
      {elements
        .filter((element) => element.points.length > 0)
        .map((element) => (
          <PlanElement
            key={element.pointer}
            {...{ element, unit }}
            isSelected={element === selected}
            onSelect={() => onSelect(element.pointer)}
            onGrab={(event) => grab(event, element)}
            onKey={(event) => keys.onElement(event, element)}
          />
        ))}
      <Names {...{ elements, selected, unit }} />
      {canGrab && selected && selected.kind.shape !== "point" && (
        <Handles
          element={selected}
          unit={unit}
          onGrab={(event, index) => pointer.begin(event, { what: "corner", element: selected, index, document: present })}
          onKey={(event, index) => keys.onCorner(event, selected, index)}
          onSplit={(edge) => history.change(withNewCorner(present, selected, edge))}
        />
      )}
      {pointer.drag?.what === "new" && <NewElement tool={tool} from={pointer.drag.from} to={pointer.drag.to} unit={unit} />}
    </svg>
  );
}
