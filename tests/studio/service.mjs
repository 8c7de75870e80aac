// A service with a folder of its own, and Debian's Chromium.
import { execFileSync, spawn } from "node:child_process";
import { randomInt } from "node:crypto";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const kChromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"];

/** `packages` is the node_modules of web/package-lock.json. */
export function load(packages, name) {
  return createRequire(path.join(packages, "any.js"))(name);
}

export function packageFile(packages, name) {
  return path.join(packages, name);
}

/** A port that no outgoing connection of this machine takes while the service is away. */
function portOfNobody() {
  const lowest = 10_240;
  const range = "/proc/sys/net/ipv4/ip_local_port_range";
  const end = existsSync(range) ? Number.parseInt(readFileSync(range, "utf8"), 10) : 32_768;
  return end > lowest + 1000 ? randomInt(lowest, end) : 0;
}

export class TestService {
  /** `environment`: variables beside those of the test. */
  constructor(program, options = [], environment = {}) {
    this.program = program;
    this.options = options;
    this.environment = environment;
    this.data = mkdtempSync(path.join(tmpdir(), "throng-studio-"));
  }

  /** Resolves when the service listens: the first time at a free port, then at the same one again. */
  async start() {
    if (this.address) return this.listen(new URL(this.address).port);
    for (let attempt = 0; ; ++attempt) {
      try {
        return await this.listen(portOfNobody());
      } catch (error) {
        if (attempt === 20 || !/in use|cannot listen/i.test(error.message)) throw error;
      }
    }
  }

  listen(port) {
    this.child = spawn(this.program, ["serve", "--data", this.data, "--port", String(port), ...this.options], {
      stdio: ["ignore", "pipe", "pipe"],
      env: { ...process.env, ...this.environment },
    });
    return new Promise((resolve, reject) => {
      let text = "";
      const read = (chunk) => {
        text += chunk;
        const address = /http:\/\/127\.0\.0\.1:\d+/.exec(text);
        if (address) resolve((this.address = address[0]));
      };
      this.child.stdout.on("data", read);
      this.child.stderr.on("data", read);
      this.child.on("exit", (code) => reject(new Error(`throng serve ended with ${code}: ${text}`)));
    });
  }

  createKey(scope) {
    const text = execFileSync(this.program, ["keys", "create", "test", "--data", this.data, "--scope", scope], { encoding: "utf8" });
    return /throng_\w+/.exec(text)[0];
  }

  async json(address, init) {
    const response = await fetch(this.address + address, init);
    if (!response.ok) throw new Error(`${address}: ${response.status} ${await response.text()}`);
    return response.json();
  }

  post(address, body) {
    return this.json(address, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
  }

  /** The id of a job, or of a study, that has succeeded. */
  async finished(document, kind = "jobs") {
    const { id } = await this.post(`/v1/${kind}`, document);
    for (;;) {
      const { state, error } = await this.json(`/v1/${kind}/${id}`);
      if (state === "succeeded") return id;
      if (state !== "queued" && state !== "running") throw new Error(`${kind}/${id} is ${state}: ${error?.message}`);
      await new Promise((resolve) => setTimeout(resolve, 500));
    }
  }

  async remove(address) {
    const response = await fetch(this.address + address, { method: "DELETE" });
    if (!response.ok) throw new Error(`${address}: ${response.status}`);
  }

  /** Ends the service; its data stay. `start` begins it again at the same address. */
  async halt() {
    const ended = new Promise((resolve) => this.child.on("exit", resolve));
    this.child.removeAllListeners("exit");
    this.child.on("exit", () => {});
    const gone = new Promise((resolve) => this.child.on("close", resolve));
    this.child.kill("SIGTERM");
    await Promise.race([ended, gone]);
  }

  async stop() {
    await this.halt();
    rmSync(this.data, { recursive: true, force: true });
  }
}

/** A name that leads to this machine for the browser alone. */
export const kOtherHost = "other-site.test";

/** A page of another origin, from which the service is attacked. */
export class OtherSite {
  start() {
    this.server = createServer((_, response) =>
      response.setHeader("Content-Type", "text/html").end("<!doctype html><title>other site</title>"),
    );
    return new Promise((resolve) =>
      this.server.listen(0, "127.0.0.1", () => {
        const { port } = this.server.address();
        this.address = `http://${kOtherHost}:${port}/`;
        this.localAddress = `http://127.0.0.1:${port}/`;
        resolve();
      }),
    );
  }

  stop() {
    this.server.closeAllConnections();
    this.server.close();
  }
}

/** What becomes of requests by a page of another site: [path, init] each. Nothing is to be read, and nothing done. */
export async function attacked(browser, address, requests) {
  const attacker = new OtherSite();
  await attacker.start();
  try {
    const page = await (await browser.newContext()).newPage();
    await page.goto(attacker.address);
    const outcomes = await page.evaluate(
      ({ address, requests }) =>
        Promise.all(
          requests.map(([path, init]) =>
            fetch(address + path, init).then(
              (response) => `${response.type} ${response.status}`,
              () => "refused",
            ),
          ),
        ),
      { address, requests },
    );
    await page.context().close();
    return outcomes;
  } finally {
    attacker.stop();
  }
}

export function launch(packages) {
  const executablePath = kChromium.find((file) => existsSync(file));
  if (!executablePath) throw new Error("Chromium is missing (Debian package chromium; scripts/setup.sh installs it)");
  return load(packages, "playwright-core").chromium.launch({
    executablePath,
    args: ["--no-sandbox", "--disable-gpu", `--host-resolver-rules=MAP ${kOtherHost} 127.0.0.1`],
  });
}
