// Components whose scripts are loaded when they are first shown.
import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { messageOf } from "../api/client";

interface LazyProps<P> {
  load: () => Promise<ComponentType<P>>;
  props: P;
}

export function Lazy<P extends object>({ load, props }: LazyProps<P>) {
  const [loaded, setLoaded] = useState<{ Component: ComponentType<P> } | null>(null);
  const [error, setError] = useState<string | null>(null);
  useEffect(() => {
    load().then(
      (Component) => setLoaded({ Component }),
      (reason: unknown) => setError(messageOf(reason)),
    );
  }, [load]);
  if (loaded) return <loaded.Component {...props} />;
  if (!error) return <p class="loading">Loading …</p>;
  return (
    <div class="notice bad" role="alert">
      <p>A part of the page could not be loaded ({error}).</p>
      <button type="button" class="button" onClick={() => location.reload()}>
        Reload
      </button>
    </div>
  );
}
