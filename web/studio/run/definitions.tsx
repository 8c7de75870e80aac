// Meanings of the figures of a run: the rows of docs/metrics.md, and names of figures that lead to them.
import definitions from "definitions";
import type { ComponentChildren } from "preact";
import { useEffect } from "preact/hooks";
import { useAddress } from "../parts/router";

/** The name of a figure, which leads to its definition and shows it when pointed at. */
export function Defined({ anchor, children }: { anchor: string; children: ComponentChildren }) {
  const definition = definitions.find((one) => one.anchor === anchor);
  if (!definition) return <>{children}</>;
  return (
    <a class="defined" href={`/definitions?of=${anchor}`} title={definition.text}>
      {children}
    </a>
  );
}

export function DefinitionsScreen() {
  const chosen = useAddress().query.get("of");
  useEffect(() => {
    if (chosen) document.getElementById(`definition-${chosen}`)?.scrollIntoView({ block: "center" });
  }, [chosen]);
  return (
    <>
      <h1>Definitions of the figures</h1>
      <p>Names are those of metrics.json. docs/metrics.md has the same paragraphs, and those of the tables of exits.</p>
      <dl class="definitions">
        {definitions.map(({ anchor, names, text }) => (
          <div key={anchor} id={`definition-${anchor}`} aria-current={anchor === chosen || undefined}>
            <dt>
              <code>{names}</code>
            </dt>
            <dd>{text}</dd>
          </div>
        ))}
      </dl>
    </>
  );
}
