// Changes that can be undone.
import { useState } from "preact/hooks";

const kMaxSteps = 200;

interface Steps<T> {
  past: T[];
  present: T;
  future: T[];
  /** Before the change that is going on, such as a drag; null: none is. */
  base: T | null;
}

export interface History<T> {
  present: T;
  canUndo: boolean;
  canRedo: boolean;
  change: (next: T) => void;
  /** Shows a state on the way; `commit` makes all since the last one a single step. */
  preview: (next: T) => void;
  commit: () => void;
  undo: () => void;
  redo: () => void;
}

const latest = <T>(list: T[]) => list.slice(-kMaxSteps);

export function useHistory<T>(first: () => T): History<T> {
  const [steps, setSteps] = useState<Steps<T>>(() => ({ past: [], present: first(), future: [], base: null }));
  return {
    present: steps.present,
    canUndo: steps.past.length > 0,
    canRedo: steps.future.length > 0,
    change: (next) =>
      setSteps(({ past, present, base }) =>
        next === present
          ? { past, present, future: [], base: null }
          : { past: latest([...past, base ?? present]), present: next, future: [], base: null },
      ),
    preview: (next) => setSteps((last) => ({ ...last, present: next, base: last.base ?? last.present })),
    commit: () =>
      setSteps((last) => {
        if (last.base === null) return last;
        if (last.base === last.present) return { ...last, base: null };
        return { past: latest([...last.past, last.base]), present: last.present, future: [], base: null };
      }),
    undo: () =>
      setSteps((last) => {
        const before = last.past.at(-1);
        return before === undefined
          ? last
          : { past: last.past.slice(0, -1), present: before, future: [last.present, ...last.future], base: null };
      }),
    redo: () =>
      setSteps((last) => {
        const [next, ...future] = last.future;
        return next === undefined ? last : { past: latest([...last.past, last.present]), present: next, future, base: null };
      }),
  };
}
