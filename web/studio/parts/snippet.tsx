// Text to be copied into a terminal or a program.
import { useEffect, useState } from "preact/hooks";

const kNoticeMs = 1500;

export function CodeBlock({ text, label }: { text: string; label: string }) {
  const [isCopied, setCopied] = useState(false);
  useEffect(() => {
    if (!isCopied) return;
    const timer = setTimeout(() => setCopied(false), kNoticeMs);
    return () => clearTimeout(timer);
  }, [isCopied]);
  // Pages that are neither of this machine nor behind TLS have no clipboard.
  const copy =
    navigator.clipboard &&
    (() =>
      void navigator.clipboard.writeText(text).then(
        () => setCopied(true),
        () => {},
      ));
  return (
    <div class="code-block">
      <pre tabIndex={0} aria-label={label}>
        {text}
      </pre>
      {copy && (
        <button type="button" class="button small" aria-label={`Copy: ${label}`} onClick={copy}>
          <span aria-live="polite">{isCopied ? "Copied" : "Copy"}</span>
        </button>
      )}
    </div>
  );
}
