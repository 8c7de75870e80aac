// Frames per second of the views of a live flight in Chromium, by its software WebGL where there is no graphics card; and the
// CPU time of the browser for each, which other work on the machine changes less.
// usage: node bench/fly_view.mjs THRONG|ADDRESS PACKAGES [PEOPLE [SCENARIO [IMAGE.png]]]
//   ADDRESS   of a service that runs, in place of one of its own
//   PACKAGES  build/web/node_modules
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { launch, TestService } from "../tests/studio/service.mjs";

const [program, folder, people = "260", scenario = "city_square/emergency", image] = process.argv.slice(2);
const packages = path.resolve(folder);
const kSeconds = 8;
const kViews = ["Camera", "3-D", "Plan"];

/** CPU time in ms of the processes of this one's browser. */
function browserMs() {
  const processes = new Map();
  for (const name of readdirSync("/proc").filter((entry) => /^\d+$/.test(entry))) {
    try {
      const text = readFileSync(`/proc/${name}/stat`, "utf8");
      const fields = text.slice(text.lastIndexOf(")") + 2).split(" ");
      processes.set(Number(name), {
        parent: Number(fields[1]),
        isBrowser: text.includes("(chrom"),
        ms: 10 * (Number(fields[11]) + Number(fields[12])),
      });
    } catch {
      // It has ended.
    }
  }
  const isOurs = (pid) => pid === process.pid || (processes.has(pid) && isOurs(processes.get(pid).parent));
  return [...processes].filter(([pid, { isBrowser }]) => isBrowser && isOurs(pid)).reduce((sum, [, { ms }]) => sum + ms, 0);
}

const isAddress = program.startsWith("http");
const service = isAddress ? { address: program, start: async () => {}, stop: async () => {} } : new TestService(program);
await service.start();
const browser = await launch(packages);
try {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  page.setDefaultTimeout(120_000); // thousands of people keep a page without a graphics card busy
  const job = {
    scenario,
    crowd: { agents: Number(people) },
    environment: { smoke: 1 },
    drones: [{ id: "d1", start: [-24, -6, 20], camera: { pitch_deg: -45 } }],
  };
  await page.goto(`${service.address}/new`);
  await page
    .getByLabel("Open a file")
    .setInputFiles({ name: "job.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(job)) });
  await page
    .getByText(/images? in/)
    .first()
    .waitFor({ timeout: 120_000 });
  await page.getByRole("link", { name: "Fly", exact: true }).click();
  await page.getByRole("button", { name: "Fly", exact: true }).click();
  await page.getByText("recording").waitFor({ timeout: 240_000 });
  for (const view of kViews) {
    await page.locator("main").getByRole("button", { name: view, exact: true }).click();
    await page.waitForTimeout(2500);
    const before = browserMs();
    const frames = await page.evaluate(
      (seconds) =>
        new Promise((resolve) => {
          const begun = performance.now();
          let count = 0;
          const tick = (now) => {
            if (now - begun >= 1000 * seconds) return resolve(count / seconds);
            ++count;
            requestAnimationFrame(tick);
          };
          requestAnimationFrame(tick);
        }),
      kSeconds,
    );
    if (image && view === "3-D") await page.screenshot({ path: image });
    console.log(
      `${people} people, ${view}: ${frames.toFixed(1)} frames/s, ${((browserMs() - before) / Math.max(1, frames * kSeconds)).toFixed(0)} ms of CPU each`,
    );
  }
} finally {
  await browser.close();
  await service.stop();
}
