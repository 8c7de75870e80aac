// Live flight in a browser: by keyboard, by a gamepad, to the pilot log and the job that repeats the flight.
// usage: node fly_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { eventually, jsonFile, openStudio } from "./page.mjs";
import { attacked } from "./service.mjs";

const kStartMs = 60_000; // a busy machine
const kJobMs = 120_000;
const kJob = {
  name: "flight",
  scenario: "city_square/emergency",
  crowd: { agents: 60 },
  quality: "draft",
  drones: [
    { id: "d1", start: [-24, -6, 20], camera: { width: 160, height: 120, pitch_deg: -45 }, moves_goal: [99, 0] },
    { id: "d2", start: [8, 8, 25], camera: { width: 160, height: 120, pitch_deg: -60 } },
  ],
  capture: { from_s: 1, to_s: 2, rate_hz: 0.5 },
  outputs: { annotations: ["coco"], previews: 1 },
};

const { service, browser, page, go, complaints, test, check } = await openStudio();

await page.addInitScript(() => {
  window.pad = null;
  navigator.getGamepads = () => [window.pad];
});

const figure = (name) =>
  page
    .locator(".figures div", { has: page.locator("dt", { hasText: new RegExp(`^${name}$`) }) })
    .locator("dd")
    .innerText();
const number = async (name) => Number.parseFloat(await figure(name));
const until = (condition, what) => eventually(what, condition);
/** Colors that the canvas of a view holds. */
const colorsOf = (label) =>
  page.getByRole("img", { name: label }).evaluate((canvas) => {
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [64, 36];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0, 64, 36);
    const { data } = context.getImageData(0, 0, 64, 36);
    return new Set(Array.from({ length: data.length / 4 }, (_, i) => `${data[4 * i]},${data[4 * i + 1]},${data[4 * i + 2]}`)).size;
  });
const sticks = (axes, buttons = []) =>
  page.evaluate(
    ([values, pressed]) => {
      const list = Array.from({ length: 17 }, (_, index) => ({ pressed: pressed.includes(index), value: 0 }));
      window.pad = { connected: true, mapping: "standard", id: "test", axes: values, buttons: list };
    },
    [axes, buttons],
  );

async function start() {
  await go("/new");
  await page.getByLabel("Open a file").setInputFiles(jsonFile("job.json", kJob));
  await page.getByText("2 images").waitFor();
  await page.getByRole("link", { name: "Fly", exact: true }).click();
  await page.getByRole("heading", { name: "Live flight" }).waitFor();
  await page.getByLabel("Record as MCAP (ROS 2, Foxglove)").check();
  await page.getByRole("button", { name: "Fly", exact: true }).click();
  await page.getByText("recording").waitFor({ timeout: kStartMs });
  await until(async () => (await number("Images")) > 2, "images come");
}

test("a mistake in the job is shown before the flight", async () => {
  await go("/new");
  await page.getByLabel("Open a file").setInputFiles(jsonFile("job.json", { ...kJob, runs: 0 }));
  await page.getByText("1 error").waitFor();
  await page.getByRole("link", { name: "Fly", exact: true }).click();
  await check(page, "the start of a flight");
  await page.getByRole("button", { name: "Fly", exact: true }).click();
  await page.getByRole("alert").filter({ hasText: "/job/runs" }).waitFor();
});

test("a drone is flown by keyboard", async () => {
  await start();
  assert.ok((await colorsOf("Camera of d1")) > 30, "the camera shows something");
  assert.ok((await colorsOf("Floor plan with people and drones")) > 5);
  const height = await number("Height");
  await page.keyboard.down("KeyW");
  await page.keyboard.down("ArrowDown");
  await until(async () => (await number("Speed")) > 2, "the drone flies");
  await until(async () => (await number("Height")) < height - 1, "the drone comes down");
  await page.keyboard.up("KeyW");
  await page.keyboard.up("ArrowDown");
  await until(async () => (await number("Speed")) < 1, "the drone hovers");
  assert.ok((await number("Latency")) > 0);
  const pitch = await number("Camera");
  await page.keyboard.down("KeyF");
  await until(async () => (await number("Camera")) < pitch - 5, "the camera tilts down");
  await page.keyboard.up("KeyF");
  await page.keyboard.press("KeyB");
  await page.locator('button[aria-pressed="true"]', { hasText: "Beacon" }).waitFor();
  await page.keyboard.press("KeyP");
  await page.getByText("paused", { exact: true }).waitFor();
  // The word comes at once, the pause when the flight has the command.
  let paused;
  await until(async () => {
    paused = await figure("Time");
    await page.waitForTimeout(600);
    return (await figure("Time")) === paused;
  }, "time stands still");
  await check(page, "a flight");
  assert.equal(await figure("Time"), paused);
  await page.keyboard.press("KeyP");
  await until(async () => (await figure("Time")) !== paused, "time goes on");
});

test("pages of other sites neither see nor steer a flight", async () => {
  const { flights } = await service.json("/v1/live");
  const self = `/v1/live/${flights[0].id}`;
  const json = { "Content-Type": "application/json" };
  const beacon = JSON.stringify({ sequence: 9999, drones: [{ id: "d2", beacon: true }] });
  const outcomes = await attacked(browser, service.address, [
    ["/v1/live", { method: "POST", mode: "no-cors", body: JSON.stringify({ job: kJob }) }],
    ["/v1/live", { method: "POST", headers: json, body: JSON.stringify({ job: kJob }) }],
    ["/v1/live", {}],
    [`${self}/stream`, {}],
    [`${self}/commands`, { method: "POST", mode: "no-cors", body: beacon }],
    [`${self}/commands`, { method: "POST", headers: json, body: beacon }],
    [`${self}/stop`, { method: "POST", mode: "no-cors" }],
    [self, { method: "DELETE" }],
  ]);
  assert.ok(
    outcomes.every((outcome) => ["opaque 0", "refused"].includes(outcome)),
    outcomes.join(),
  );
  assert.deepEqual(
    (await service.json("/v1/live")).flights.map(({ id }) => id),
    [flights[0].id],
  );
  const time = await figure("Time");
  await until(async () => (await figure("Time")) !== time, "the flight goes on");
  assert.equal(await page.getByText("The flight is over").count(), 0);
});

test("views are changed", async () => {
  await page.getByRole("button", { name: "3-D" }).click();
  const scene = page.getByRole("img", { name: "The flight in space" });
  await scene.waitFor();
  await check(page, "the flight in space");
  await page.keyboard.press("KeyV");
  await page.locator(".fly-inset").getByRole("img", { name: "The flight in space" }).waitFor();
  await page.getByRole("button", { name: "Camera" }).click();
});

test("another drone is flown by a gamepad", async () => {
  await sticks([0, 0, 0, 0], [3]);
  await page.getByText("connected", { exact: true }).waitFor();
  await page.getByRole("img", { name: "Camera of d2" }).waitFor();
  await sticks([0.5, -1, 0, -1]);
  const height = await number("Height");
  await until(async () => (await number("Height")) > height + 2, "the drone rises");
  await sticks([0, 0, 0, 0], [1]);
  await sticks([0, 0, 0, 0]);
  const time = await number("Time");
  await until(async () => (await number("Time")) > time + 1, "the flight goes on for a second");
});

test("the flight becomes a job that repeats it", async () => {
  await page.getByRole("button", { name: "Stop" }).click();
  await page.getByRole("heading", { name: "Flight recorded" }).waitFor();
  await check(page, "a recorded flight");
  const recording = page.waitForEvent("download");
  await page.getByRole("link", { name: /^Recording \(MCAP, [0-9.]+ [kM]?B\)$/ }).click();
  const bytes = readFileSync(await (await recording).path());
  const magic = Buffer.from("\x89MCAP0\r\n", "latin1");
  assert.deepEqual([bytes.subarray(0, 8), bytes.subarray(-8)], [magic, magic]);
  const hash = await page.locator("code").innerText();
  const log = decodeURIComponent(
    (await page.getByRole("link", { name: "Pilot log of d2" }).getAttribute("href")).split(",").slice(1).join(","),
  );
  const rows = log
    .trim()
    .split("\n")
    .slice(1)
    .map((line) => line.split(",").map(Number));
  assert.ok(rows.length > 30);
  assert.ok(Math.max(...rows.map((row) => row[3])) > rows[0][3] + 2, "the log has the climb");
  await page.getByRole("button", { name: "Make a dataset of this flight" }).click();
  await page.getByRole("heading", { name: "New job" }).waitFor();
  assert.equal(await page.getByLabel("Name", { exact: true }).inputValue(), "flight, flown");
  await page.getByRole("button", { name: "Submit" }).click({ timeout: kJobMs });
  await page.getByRole("heading", { name: "flight, flown" }).waitFor();
  const id = /jobs\/([a-z0-9]+)/.exec(page.url())[1];
  await page.locator(".heading .badge", { hasText: "succeeded" }).waitFor({ timeout: kJobMs });
  const trace = await (await fetch(`${service.address}/v1/jobs/${id}/runs/0/trace`)).arrayBuffer();
  assert.equal(createHash("sha256").update(Buffer.from(trace)).digest("hex"), hash);
});

test("a lost connection and a flight that is gone say so", async () => {
  await start();
  await service.halt();
  await page.getByText("The connection to the flight is lost").waitFor();
  await service.start();
  await page.getByText("The flight is over").waitFor();
  await page.getByRole("link", { name: "Fly again" }).click();
  await page.getByRole("button", { name: "Fly", exact: true }).waitFor();
});

test("nothing else was complained of", () => {
  assert.deepEqual(
    complaints.filter((text) => !/ERR_(CONNECTION|INCOMPLETE|EMPTY)|network error|WebGL|GPU stall/i.test(text)),
    [],
  );
});
