// Elements that many screens use.
import type { ComponentChildren, TargetedKeyboardEvent } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import type { ApiError } from "../api/client";
import { useSource } from "../api/resource";
import { useSession } from "../api/session";
import type { Job, Mistake } from "../api/types";

export function StateBadge({ state }: { state: Job["state"] }) {
  return <span class={`badge state-${state}`}>{state}</span>;
}

export function Progress({ done, total, label }: { done: number; total: number; label: string }) {
  const share = total > 0 ? Math.min(1, done / total) : 0;
  return (
    <div class="progress" role="progressbar" aria-label={label} aria-valuemin={0} aria-valuemax={total} aria-valuenow={done}>
      <div class="progress-bar" style={{ width: `${100 * share}%` }} />
    </div>
  );
}

/** An image of the service; a blank of the same size until it is there. */
export function ServiceImage({ path, alt, className = "" }: { path: string | null; alt: string; className?: string }) {
  const source = useSource(path);
  const { round } = useSession();
  const attempt = `${round} ${source}`;
  const [failed, setFailed] = useState<string | null>(null);
  if (source && failed !== attempt)
    return <img key={attempt} class={`image ${className}`} src={source} alt={alt} decoding="async" onError={() => setFailed(attempt)} />;
  return (
    <div class={`image blank ${className}`} role="img" aria-label={alt}>
      {failed ? <span>no image</span> : null}
    </div>
  );
}

export function ErrorBox({ error, children }: { error: ApiError | null; children?: ComponentChildren }) {
  if (!error) return null;
  return (
    <div class="notice bad" role="alert">
      <p>{error.message}</p>
      <Mistakes list={error.errors} />
      {children}
    </div>
  );
}

export function Mistakes({ list, onSelect }: { list: Mistake[]; onSelect?: (pointer: string) => void }) {
  if (list.length === 0) return null;
  return (
    <ul class="mistakes">
      {list.map((mistake) => (
        <li key={mistake.message}>
          {onSelect ? (
            <button type="button" class="link code" onClick={() => onSelect(mistake.pointer)}>
              {mistake.pointer || "/"}
            </button>
          ) : (
            <code>{mistake.pointer || "/"}</code>
          )}{" "}
          {mistake.found ? (
            <>
              found <code>{mistake.found}</code>, expected {mistake.expected}
            </>
          ) : (
            mistake.message
          )}
        </li>
      ))}
    </ul>
  );
}

export interface Question {
  title: string;
  text: string;
  action: string;
  isDangerous?: boolean;
  confirm: () => void;
}

/** Asks before something that cannot be undone. */
export function Confirmation({ question, onClose }: { question: Question | null; onClose: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    if (question) dialog.current?.showModal();
    else dialog.current?.close();
  }, [question]);
  return (
    <dialog ref={dialog} onClose={onClose} aria-labelledby="question">
      {question && (
        <>
          <h2 id="question">{question.title}</h2>
          <p>{question.text}</p>
          <div class="actions end">
            <button type="button" class="button" onClick={onClose}>
              Cancel
            </button>
            <button
              type="button"
              class={`button ${question.isDangerous ? "danger" : "primary"}`}
              onClick={() => {
                onClose();
                question.confirm();
              }}
            >
              {question.action}
            </button>
          </div>
        </>
      )}
    </dialog>
  );
}

/** Figures with their names: in a row, or as a record. */
export function Figures({ list, className = "figures" }: { list: [name: ComponentChildren, value: string][]; className?: string }) {
  return (
    <dl class={className}>
      {list.map(([name, value], index) => (
        <div key={index}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

export function Empty({ title, children }: { title: string; children?: ComponentChildren }) {
  return (
    <div class="empty">
      <p class="empty-title">{title}</p>
      {children}
    </div>
  );
}

interface TabsProps {
  label: string;
  tabs: { id: string; label: ComponentChildren }[];
  selected: string;
  onSelect: (id: string) => void;
}

/** Tabs with the arrow keys of the ARIA pattern. The panel has the id `panel`. */
export function Tabs({ label, tabs, selected, onSelect }: TabsProps) {
  const onKey = (event: TargetedKeyboardEvent<HTMLDivElement>) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (!step) return;
    event.preventDefault();
    const index = tabs.findIndex((tab) => tab.id === selected);
    const next = tabs[(index + step + tabs.length) % tabs.length]!;
    onSelect(next.id);
    document.getElementById(`tab-${next.id}`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label={label} onKeyDown={onKey}>
      {tabs.map((tab) => (
        <button
          key={tab.id}
          type="button"
          role="tab"
          id={`tab-${tab.id}`}
          aria-selected={tab.id === selected}
          aria-controls="panel"
          tabIndex={tab.id === selected ? 0 : -1}
          onClick={() => onSelect(tab.id)}
        >
          {tab.label}
        </button>
      ))}
    </div>
  );
}

interface FileButtonProps {
  accept: string;
  multiple?: boolean;
  onFiles: (files: File[]) => void; ///< at least one
  children: ComponentChildren;
}

/** A button that opens the browser's dialog for files; the same file may be chosen again after it was changed. */
export function FileButton({ accept, multiple = false, onFiles, children }: FileButtonProps) {
  return (
    <label class="button">
      {children}
      <input
        class="hidden"
        type="file"
        accept={accept}
        multiple={multiple}
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = "";
          if (files.length > 0) onFiles(files);
        }}
      />
    </label>
  );
}
