// Addresses are the state of the screens: every view can be linked, reloaded and left by the back button.
import { useEffect, useState } from "preact/hooks";
import { browserAddress, servicePath } from "../api/base";

const listeners = new Set<() => void>();

function notify(): void {
  listeners.forEach((listener) => listener());
}

addEventListener("popstate", notify);

export function navigate(address: string, options: { replace?: boolean } = {}): void {
  const shown = browserAddress(address);
  if (options.replace) history.replaceState(null, "", shown);
  else {
    history.pushState(null, "", shown);
    scrollTo(0, 0);
  }
  notify();
}

/** Follows links to screens without loading the page again. */
export function followLinks(event: MouseEvent): void {
  if (event.defaultPrevented || event.button !== 0 || event.metaKey || event.ctrlKey || event.shiftKey) return;
  const link = (event.target as Element).closest("a");
  if (!link || link.target || link.hasAttribute("download") || link.origin !== location.origin) return;
  const path = servicePath(link.pathname);
  if (path.startsWith("/v1/") || path.startsWith("/assets/") || path === "/openapi.json") return;
  event.preventDefault();
  navigate(path + link.search);
}

export interface Address {
  path: string;
  query: URLSearchParams;
}

export function useAddress(): Address {
  const read = () => servicePath(location.pathname) + location.search;
  const [address, setAddress] = useState(read);
  useEffect(() => {
    const listener = () => setAddress(read());
    listeners.add(listener);
    return () => void listeners.delete(listener);
  }, []);
  const url = new URL(address, location.origin);
  return { path: url.pathname, query: url.searchParams };
}

/** The present address with some parameters changed; "" and null remove one. */
export function withQuery(query: URLSearchParams, changes: Record<string, string | number | null>): string {
  const next = new URLSearchParams(query);
  for (const [name, value] of Object.entries(changes)) {
    if (value === null || value === "") next.delete(name);
    else next.set(name, String(value));
  }
  const text = next.toString();
  return servicePath(location.pathname) + (text ? `?${text}` : "");
}
