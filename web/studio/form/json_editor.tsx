// A document as JSON text, with the service's findings at their lines.
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { json, jsonParseLinter } from "@codemirror/lang-json";
import {
  bracketMatching,
  ensureSyntaxTree,
  HighlightStyle,
  indentOnInput,
  indentUnit,
  syntaxHighlighting,
  syntaxTree,
} from "@codemirror/language";
import { type Diagnostic, lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { useEffect, useRef } from "preact/hooks";
import type { Mistake } from "../api/types";

export interface JsonEditorProps {
  what?: string; ///< "The job"
  text: string;
  errors: Mistake[];
  focus: string | null; ///< pointer to show
  onChange: (text: string) => void;
}

type Node = NonNullable<ReturnType<ReturnType<typeof syntaxTree>["resolve"]>>;

const kTheme = EditorView.theme({
  "&": {
    backgroundColor: "var(--card)",
    color: "var(--text)",
    fontSize: "13.5px",
    border: "1px solid var(--field-line)",
    borderRadius: "8px",
  },
  "&.cm-focused": { outline: "2px solid var(--accent)" },
  ".cm-scroller": { fontFamily: "var(--mono)", minHeight: "380px", maxHeight: "70vh" },
  ".cm-content": { caretColor: "var(--text)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  ".cm-gutters": { backgroundColor: "var(--raised)", color: "var(--quiet)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--accent-soft)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--accent-soft) !important" },
  ".cm-tooltip": { backgroundColor: "var(--card)", color: "var(--text)", border: "1px solid var(--line)" },
});

const kColors = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--accent)" },
  { tag: tags.string, color: "var(--good)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--warn)" },
]);

const unquoted = (text: string) => {
  try {
    return String(JSON.parse(text));
  } catch {
    return text;
  }
};

/** The value that a pointer names; the innermost that exists where it names nothing. */
function nodeAt(state: EditorState, pointer: string): Node {
  // On a busy machine the editor parses a part only before it draws.
  const tree = ensureSyntaxTree(state, state.doc.length, 1000) ?? syntaxTree(state);
  let node: Node = tree.topNode.firstChild ?? tree.topNode;
  for (const part of pointer
    .split("/")
    .slice(1)
    .map((text) => text.replace(/~1/g, "/").replace(/~0/g, "~"))) {
    let next: Node | null = null;
    if (node.name === "Object") {
      for (const property of node.getChildren("Property")) {
        const name = property.firstChild;
        if (name && unquoted(state.sliceDoc(name.from, name.to)) === part) next = property.lastChild;
      }
    } else if (node.name === "Array") {
      const items: Node[] = [];
      for (let child = node.firstChild; child; child = child.nextSibling) if (!/^[[\],⚠]$/.test(child.name)) items.push(child);
      next = items[Number(part)] ?? null;
    }
    if (!next) return node;
    node = next;
  }
  return node;
}

/** Of a value that spans lines its first line. */
function diagnosticsOf(view: EditorView, errors: Mistake[]): Diagnostic[] {
  const { state } = view;
  const syntax = jsonParseLinter()(view);
  if (syntax.length) return syntax;
  return errors.map((error) => {
    const node = nodeAt(state, error.pointer);
    const to = Math.max(node.from, Math.min(node.to, state.doc.lineAt(node.from).to));
    return { from: node.from, to, severity: "error", message: error.message };
  });
}

export function JsonEditor({ what = "The job", text, errors, focus, onChange }: JsonEditorProps) {
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const handler = useRef(onChange);
  handler.current = onChange;
  useEffect(() => {
    // In a shadow tree the editor's styles are adopted sheets, which the page's policy allows; style elements are not.
    const root = host.current!.shadowRoot ?? host.current!.attachShadow({ mode: "open" });
    const editor = new EditorView({
      root,
      parent: root,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(),
          lintGutter(),
          history(),
          drawSelection(),
          indentOnInput(),
          indentUnit.of("  "),
          bracketMatching(),
          highlightActiveLine(),
          json(),
          kTheme,
          syntaxHighlighting(kColors),
          EditorView.lineWrapping,
          EditorView.contentAttributes.of({ tabindex: "0", "aria-label": `${what} as JSON. Escape, then Tab, leaves the editor.` }),
          keymap.of([...defaultKeymap, ...historyKeymap, ...lintKeymap, indentWithTab]),
          EditorView.updateListener.of((update) => update.docChanged && handler.current(update.state.doc.toString())),
        ],
      }),
    });
    view.current = editor;
    return () => editor.destroy();
  }, []);
  useEffect(() => {
    const editor = view.current!;
    if (editor.state.doc.toString() !== text) editor.dispatch({ changes: { from: 0, to: editor.state.doc.length, insert: text } });
    editor.dispatch(setDiagnostics(editor.state, diagnosticsOf(editor, errors)));
  }, [text, errors]);
  useEffect(() => {
    if (focus === null) return;
    const editor = view.current!;
    const node = nodeAt(editor.state, focus);
    editor.dispatch({ selection: { anchor: node.from }, effects: EditorView.scrollIntoView(node.from, { y: "center" }) });
    editor.focus();
  }, [focus]);
  return <div ref={host} class="json-editor" />;
}
