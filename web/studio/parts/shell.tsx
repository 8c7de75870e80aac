// Header and frame of all screens, and the request for a key.
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { getJson, messageOf, sendJson } from "../api/client";
import { useLost } from "../api/reach";
import { demandKey, noteSession, noteSignIn, useSession } from "../api/session";
import type { Session } from "../api/types";
import { useAddress } from "./router";

const kThemes = ["system", "light", "dark"] as const;
type Theme = (typeof kThemes)[number];
const kThemeStorage = "throng.theme";

function storedTheme(): Theme {
  const stored = localStorage.getItem(kThemeStorage);
  return kThemes.find((theme) => theme === stored) ?? "system";
}

export function applyTheme(theme: Theme = storedTheme()): void {
  document.documentElement.dataset["theme"] = theme;
}

function ThemeButton() {
  const [theme, setTheme] = useState(storedTheme);
  const next = kThemes[(kThemes.indexOf(theme) + 1) % kThemes.length]!;
  const onClick = () => {
    localStorage.setItem(kThemeStorage, next);
    applyTheme(next);
    setTheme(next);
  };
  return (
    <button type="button" class="button quiet" onClick={onClick} aria-label={`Colors: ${theme}. Change to ${next}`}>
      <span aria-hidden="true">{theme === "system" ? "◐" : theme === "light" ? "☀" : "☾"}</span>
    </button>
  );
}

const kScreens = [
  { address: "/", label: "Home" },
  { address: "/jobs", label: "Jobs" },
  { address: "/new", label: "New job" },
  { address: "/fly", label: "Fly" },
  { address: "/blueprint", label: "Blueprint" },
  { address: "/studies", label: "Studies" },
  { address: "/calibrations", label: "Calibration" },
];

export function Shell({ children }: { children: ComponentChildren }) {
  const { path } = useAddress();
  const { needsKey, demand } = useSession();
  useEffect(() => void getJson<Session>("/v1/session").then(noteSession, () => {}), []);
  const signOut = () =>
    void sendJson<void>("DELETE", "/v1/session").then(
      () => demandKey("Enter a key to go on"),
      (error: unknown) => alert(`Signing out: ${messageOf(error)}`),
    );
  return (
    <>
      <a class="skip" href="#main">
        Skip to content
      </a>
      <header class="header">
        <a class="brand" href="/">
          throng <span>Studio</span>
        </a>
        <nav aria-label="Screens">
          {kScreens.map((screen) => (
            <a
              key={screen.address}
              href={screen.address}
              aria-current={path === screen.address ? "page" : undefined}
              class={screen.address !== "/" && path.startsWith(screen.address) ? "here" : ""}
            >
              {screen.label}
            </a>
          ))}
        </nav>
        <div class="header-end">
          {needsKey && demand === null && (
            <button type="button" class="button quiet" onClick={signOut}>
              Sign out
            </button>
          )}
          <ThemeButton />
        </div>
      </header>
      <LostNote />
      <main id="main" tabIndex={-1}>
        {children}
      </main>
      <footer class="footer">
        <a href="/keys">Keys and webhooks</a> · <a href="/api">API</a> ·{" "}
        <a href="/assets/notice.txt" target="_blank" rel="noreferrer">
          Licenses
        </a>
      </footer>
    </>
  );
}

/** Says so while the service does not answer; what was typed stays. */
function LostNote() {
  const isLost = useLost();
  return (
    <div role="status" class={isLost ? "notice warn lost-note" : "hidden"}>
      {isLost && "The service cannot be reached; trying again. Nothing that was typed is lost."}
    </div>
  );
}

/** Asks for a key; the screen behind it keeps its state. */
export function KeyDialog() {
  const { demand } = useSession();
  const dialog = useRef<HTMLDialogElement>(null);
  const [text, setText] = useState("");
  const [error, setError] = useState<string | null>(null);
  const [isBusy, setBusy] = useState(false);
  useEffect(() => {
    if (demand !== null) dialog.current?.showModal();
    else dialog.current?.close();
  }, [demand]);
  const submit = async (event: Event) => {
    event.preventDefault();
    setBusy(true);
    try {
      await sendJson<Session>("POST", "/v1/session", JSON.stringify({ key: text.trim() }));
      noteSignIn();
      setText("");
      setError(null);
    } catch (reason) {
      setError(messageOf(reason));
    }
    setBusy(false);
  };
  return (
    <dialog ref={dialog} class="key-dialog" aria-labelledby="key-title" onCancel={(event) => event.preventDefault()}>
      {demand !== null && (
        <form onSubmit={submit}>
          <h2 id="key-title">Key needed</h2>
          <p>
            {demand}. A key is made on the machine of the service by <code>throng keys create NAME --data DIR</code>. This browser stays
            signed in until you sign out, the service is restarted or the browser is closed.
          </p>
          <label for="key">Key</label>
          <input
            id="key"
            type="password"
            autocomplete="off"
            spellcheck={false}
            value={text}
            aria-invalid={error !== null}
            aria-describedby="key-error"
            onInput={(event) => setText(event.currentTarget.value)}
          />
          <p id="key-error" class="field-error" role="alert">
            {error}
          </p>
          <div class="actions end">
            <button type="submit" class="button primary" disabled={isBusy || !text.trim()}>
              Use this key
            </button>
          </div>
        </form>
      )}
    </dialog>
  );
}
