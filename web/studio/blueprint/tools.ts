// Tools of the plan's editor.
import { type Kind, kindNamed } from "./kinds";

export type Tool = "select" | "wall" | Kind["name"];

export const kindOfTool = (tool: Tool): Kind => kindNamed(tool === "wall" ? "building" : tool);

/** Gives the focus to an element of the plan, if it is drawn. */
export function focusElement(pointer: string): void {
  document.querySelector<SVGGElement>(`[data-pointer="${CSS.escape(pointer)}"]`)?.focus();
}
