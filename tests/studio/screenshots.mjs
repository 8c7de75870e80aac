// Screenshots of docs/studio.md, from a service of their own with two jobs, a calibration and a study.
// usage: node screenshots.mjs PROGRAM PACKAGES OUTPUT [NAME...]   OUTPUT: folder, docs/studio; NAME: of those alone, such as blueprint
import { execFile } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { promisify } from "node:util";
import { launch, TestService } from "./service.mjs";

const [program, packages, output, ...names] = process.argv.slice(2);
const isWanted = (list) => names.length === 0 || list.some((name) => names.includes(name));
const kWithoutJobs = ["calibration", "blueprint", "study", "fly"];
// The demo, so that the pages show what a new user sees.
const kDemo = JSON.parse(readFileSync(new URL("../../scenarios/city_square/demo.job.json", import.meta.url), "utf8"));
const kJobs = [
  { name: "Square, evacuation at noon", seed: 7 },
  { name: "Square, evacuation in the evening", seed: 9, environment: { time_of_day: "18:10", smoke: 1 } },
].map((job) => ({
  ...kDemo,
  runs: 2,
  capture: { from_s: 3, to_s: 17, rate_hz: 1 },
  outputs: { annotations: ["coco", "keypoints", "exits", "depth"], formats: ["mot"], previews: 2 },
  ...job,
}));

/** The id of a calibration by images of the board that throng renders. */
async function calibrated() {
  const boards = mkdtempSync(path.join(tmpdir(), "throng-boards-"));
  // With few views its own limits may not hold. Not synchronously: connections that the service closes meanwhile must be noticed.
  await promisify(execFile)(program, ["calibrate", "selftest", "--views", "12", "--images", boards]).catch(() => {});
  const images = readdirSync(boards).sort();
  const form = new FormData();
  form.append("request", JSON.stringify({ name: "wide camera", images, board: { columns: 12, rows: 9, square: 0.025 }, lens: "auto" }));
  for (const name of images) form.append("file", new Blob([readFileSync(path.join(boards, name))], { type: "image/png" }), name);
  rmSync(boards, { recursive: true });
  const { id } = await service.json("/v1/calibrations", { method: "POST", body: form });
  for (;;) {
    const { state, error } = await service.json(`/v1/calibrations/${id}`);
    if (state === "succeeded") return id;
    if (state === "failed") throw new Error(`the calibration failed: ${error.message}`);
    await new Promise((resolve) => setTimeout(resolve, 500));
  }
}

/** The id of a study of two cases and four policies, which is part of the shipped one. */
async function studied() {
  const whole = JSON.parse(readFileSync(new URL("../../scenarios/city_square/study.json", import.meta.url), "utf8"));
  const study = {
    ...whole,
    runs: 12,
    cases: whole.cases.slice(-2).map((one) => ({ ...one, duration_s: 300 })),
    policies: whole.policies.slice(0, 4),
  };
  return service.finished(study, "studies");
}

/** The id of a live flight. */
async function begunFlight() {
  const job = {
    scenario: "city_square/emergency",
    drones: [
      { id: "d1", start: [20, 18, 12], camera: { pitch_deg: -30 }, moves_goal: [99, 0] },
      { id: "d2", start: [-10, 6, 22], camera: { pitch_deg: -60 } },
    ],
    capture: { from_s: 1, to_s: 2 },
  };
  const { id } = await service.post("/v1/live", { job });
  return id;
}

async function flyAbout(page) {
  await page.keyboard.press("KeyB");
  await page.keyboard.down("ArrowLeft");
  await page.waitForTimeout(1200);
  await page.keyboard.up("ArrowLeft");
  await page.getByRole("button", { name: "3-D" }).click();
  await page.waitForTimeout(3000); // the scene is loaded
  await page.getByRole("button", { name: "Camera" }).click();
  await page.keyboard.down("KeyW");
  await page.waitForTimeout(1500);
}

const service = new TestService(program);
await service.start();
const browser = await launch(packages);
try {
  mkdirSync(output, { recursive: true });
  const ids = [];
  const needsJobs = names.length === 0 || names.some((name) => !kWithoutJobs.includes(name));
  for (const job of needsJobs ? kJobs : []) ids.push(await service.finished(job));
  const calibration = isWanted(["calibration"]) ? await calibrated() : "";
  const study = isWanted(["study"]) ? await studied() : "";
  const flight = isWanted(["fly"]) ? await begunFlight() : "";
  const kScreens = [
    { name: "run", address: `/jobs/${ids[0]}/runs/0?frame=10`, height: 980, ready: 'canvas.overlay[data-drawn$=" boxes"]' },
    {
      name: "image",
      address: `/jobs/${ids[0]}/images?image=images/run000/d1/000008.jpg`,
      height: 800,
      ready: 'canvas.overlay[data-drawn$=" boxes,masks"]',
    },
    {
      name: "depth",
      address: `/jobs/${ids[0]}/images?image=images/run000/d1/000008.jpg`,
      height: 800,
      keys: "bmx3",
      ready: 'canvas.overlay[data-drawn$=" depth,boxes3d"][data-rasters="depth"]',
    },
    { name: "downloads", address: `/jobs/${ids[0]}/downloads?include=images,coco`, height: 900, ready: ".parts .size:not(:empty)" },
    { name: "form", address: `/new?clone=${ids[0]}`, height: 900, ready: ".plan-sheet img" },
    { name: "compare", address: `/compare?job=${ids[0]}&job=${ids[1]}&t=11`, height: 980, ready: ".swipe .upper" },
    {
      name: "filters",
      address: `/jobs/${ids[0]}/images?filters=all&state=panicking`,
      height: 900,
      ready: 'canvas.image[data-drawn="yes"]',
    },
    { name: "calibration", address: `/calibrations/${calibration}`, height: 1000, ready: ".board-view circle" },
    { name: "study", address: `/studies/${study}`, height: 1180, ready: ".convergence .series" },
    {
      name: "blueprint",
      address: "/blueprint",
      height: 980,
      ready: ".plan-element",
      start: "city_square/emergency",
      pending: "checking …",
    },
    { name: "fly", address: `/fly?flight=${flight}`, height: 940, ready: ".badge.recording", action: flyAbout },
  ];
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  for (const { name, address, height, ready, keys = "", start = "", pending = "", action = null } of kScreens.filter((screen) =>
    isWanted([screen.name]),
  )) {
    await page.setViewportSize({ width: 1280, height });
    await page.goto(service.address + address);
    if (start) await page.getByLabel("Start from").selectOption(start);
    if (keys) await page.locator("canvas.overlay[data-drawn]:not([data-drawn=''])").waitFor();
    for (const key of keys) await page.keyboard.press(key);
    await page.locator(ready).first().waitFor();
    if (pending) await page.getByText(pending).waitFor({ state: "hidden" });
    if (action) await action(page);
    await page.waitForFunction(() => [...document.images].every((image) => image.complete && image.naturalWidth > 0));
    await page.waitForTimeout(500); // the plan, a large drawing, is painted after it has loaded
    await page.screenshot({ path: path.join(output, `${name}.jpg`), type: "jpeg", quality: 72 });
  }
} finally {
  await browser.close();
  await service.stop();
}
