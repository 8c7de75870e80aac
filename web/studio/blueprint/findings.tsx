// Findings of the check of a blueprint, with the way to each element.
import { countText } from "../parts/format";
import type { BlueprintCheck, Finding } from "./check";
import { type Element, elementAt } from "./elements";

interface FindingListProps {
  check: BlueprintCheck;
  elements: Element[];
  onShow: (element: Element) => void;
}

function FindingEntry({
  finding,
  element,
  onShow,
}: {
  finding: Finding;
  element: Element | undefined;
  onShow: (element: Element) => void;
}) {
  return (
    <li class={finding.severity}>
      <p>
        <span class={`badge state-${finding.severity === "error" ? "failed" : "partial"}`}>{finding.severity}</span>{" "}
        {element ? (
          <button type="button" class="link" onClick={() => onShow(element)}>
            Go to {element.label}
          </button>
        ) : (
          <code>{finding.pointer}</code>
        )}
      </p>
      <p>{finding.text}</p>
      {finding.remedy && <p class="quiet-text">{finding.remedy}</p>}
    </li>
  );
}

export function FindingList({ check, elements, onShow }: FindingListProps) {
  const { findings, isPending, message } = check;
  const errors = findings.filter((finding) => finding.severity === "error").length;
  const warnings = findings.length - errors;
  const summary = [errors > 0 ? countText(errors, "error") : "", warnings > 0 ? countText(warnings, "warning") : ""]
    .filter(Boolean)
    .join(", ");
  return (
    <section class="card summary" aria-labelledby="findings">
      <h2 id="findings">Check</h2>
      <p aria-live="polite" data-pending={isPending}>
        {isPending ? "checking …" : message ? "" : summary || "Nothing found: the blueprint can be used."}
      </p>
      {message && <p class="field-error">{message}</p>}
      {findings.length > 0 && (
        <ul class="plain-list findings">
          {findings.map((finding, index) => (
            <FindingEntry key={index} finding={finding} element={elementAt(elements, finding.pointer)} onShow={onShow} />
          ))}
        </ul>
      )}
    </section>
  );
}
