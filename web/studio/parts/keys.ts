// Keys of a page that reach it wherever the focus is.
import { useEffect, useRef } from "preact/hooks";

/** Calls the newest `onKey` for every key that is pressed while the component is shown. */
export function useKeys(onKey: (event: KeyboardEvent) => void): void {
  const handler = useRef(onKey);
  handler.current = onKey;
  useEffect(() => {
    const listener = (event: KeyboardEvent) => handler.current(event);
    addEventListener("keydown", listener);
    return () => removeEventListener("keydown", listener);
  }, []);
}
