// Lost connections and restarts of the service in a browser: screens say so, go on by themselves and keep what was typed.
// usage: node restart_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { jsonFile, openStudio } from "./page.mjs";

const kJobMs = 120_000; // a busy machine
const kJob = {
  name: "restart",
  scenario: "city_square/emergency",
  crowd: { agents: 40 },
  drones: [{ id: "d1", camera: { width: 160, height: 120 } }],
  capture: { from_s: 1, to_s: 2, rate_hz: 1 },
  outputs: { annotations: ["coco"], previews: 1 },
};

// The third run of a job rests until the service is restarted in its midst.
const { service, page, go, complaints, test, check } = await openStudio([], { THRONG_FAULTS: "slow:run002/trace:3600" });

const lost = () => page.getByRole("status").filter({ hasText: "The service cannot be reached" });
const post = (job) => service.post("/v1/jobs", job);
async function restart() {
  await service.start();
  await lost().waitFor({ state: "hidden" });
}

test("a list says that the connection is lost, and is live again", async () => {
  await go("/jobs");
  await page.getByText("live", { exact: true }).waitFor();
  await service.halt();
  await page.getByText("connection lost, trying again").waitFor();
  await lost().waitFor();
  await check(page, "a lost connection");
  await service.start();
  await post({ ...kJob, name: "sent meanwhile" });
  await page.getByRole("link", { name: "sent meanwhile" }).waitFor();
  await lost().waitFor({ state: "hidden" });
  await page.getByText("live", { exact: true }).waitFor();
});

test("the form of a job keeps what is typed while the service is away", async () => {
  await go("/new");
  await page.getByLabel("Open a file").setInputFiles(jsonFile("job.json", kJob));
  await page.getByText("2 images").waitFor();
  await service.halt();
  await page.getByLabel("Name", { exact: true }).fill("typed meanwhile");
  await lost().waitFor();
  await page.getByLabel("Runs", { exact: true }).fill("2");
  await restart();
  await page.getByText("4 images").waitFor(); // it was checked by itself
  assert.equal(await page.getByLabel("Name", { exact: true }).inputValue(), "typed meanwhile");
  await page.getByRole("button", { name: "Submit" }).click();
  await page.getByRole("heading", { name: "typed meanwhile" }).waitFor();
});

test("a job's screen goes on after a restart in the middle of the job", async () => {
  const { id } = await post({ ...kJob, name: "interrupted", runs: 3, crowd: { agents: 60 } });
  await go(`/jobs/${id}`);
  await page.locator(".heading .badge", { hasText: "running" }).waitFor({ timeout: kJobMs });
  await service.halt();
  service.environment = {};
  await page.getByText("connection lost, trying again").waitFor();
  await restart();
  await page.locator(".heading .badge", { hasText: "succeeded" }).waitFor({ timeout: kJobMs });
  await page.waitForFunction(() => [...document.querySelectorAll("figure img")].some((image) => image.naturalWidth > 0));
});

test("a blueprint is kept, and checked by itself when the service is back", async () => {
  await go("/blueprint");
  await page.locator(".plan-editor").waitFor();
  await service.halt();
  await page.getByRole("button", { name: /^Wall/ }).click();
  await page.locator(".plan-editor").focus();
  await page.keyboard.press("Enter");
  await lost().waitFor();
  const elements = await page.locator(".plan-element").count();
  assert.ok(elements > 0);
  const checked = page.waitForResponse((response) => response.url().includes("/v1/scenarios?dry_run"));
  await restart();
  await checked;
  assert.equal(await page.locator(".plan-element").count(), elements);
});

test("images of a calibration stay chosen", async () => {
  await go("/calibrations");
  const image = await page.screenshot();
  await page.locator('input[type="file"]').setInputFiles([
    { name: "a.png", mimeType: "image/png", buffer: image },
    { name: "b.png", mimeType: "image/png", buffer: image },
  ]);
  await page.getByLabel("Name", { exact: true }).fill("kept");
  await service.halt();
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.getByRole("alert").filter({ hasText: "the service cannot be reached" }).waitFor();
  await restart();
  await page.getByText("2 images").first().waitFor();
  assert.equal(await page.getByLabel("Name", { exact: true }).inputValue(), "kept");
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.getByRole("heading", { name: "kept" }).waitFor();
});

test("removed jobs are named on each of their screens", async () => {
  const id = await service.finished({ ...kJob, name: "removed" });
  await go(`/jobs/${id}`);
  await page.getByRole("heading", { name: "removed" }).waitFor();
  await service.remove(`/v1/jobs/${id}`);
  for (const address of ["", "/images", "/images?filters=all", "/images?image=images/run000/d1/000000.jpg", "/runs/0", "/downloads"]) {
    await go(`/jobs/${id}${address}`);
    await page
      .getByText(new RegExp(`There is no job ${id}`, "i"))
      .first()
      .waitFor();
  }
  const { id: queued } = await post({ ...kJob, name: "watched", runs: 5, crowd: { agents: 150 } });
  await go(`/jobs/${queued}`);
  await page.getByRole("heading", { name: "watched" }).waitFor();
  await page.getByText("live", { exact: true }).waitFor();
  await service.remove(`/v1/jobs/${queued}`);
  await page.getByText(`There is no job ${queued}`).waitFor();
});

test("a session that ended with the service is asked for above the form, which stays", async () => {
  const key = service.createKey("submit");
  await go("/new");
  await page.getByLabel("Key", { exact: true }).fill(key);
  await page.getByRole("button", { name: "Use this key" }).click();
  await page.getByLabel("Name", { exact: true }).fill("typed with a key");
  await page
    .getByText(/\d images/)
    .first()
    .waitFor();
  await service.halt();
  await page.getByLabel("Name", { exact: true }).fill("typed before the key");
  await service.start();
  await page.getByRole("heading", { name: "Key needed" }).waitFor();
  await page.getByLabel("Key", { exact: true }).fill(key);
  await page.getByRole("button", { name: "Use this key" }).click();
  await page.getByRole("heading", { name: "Key needed" }).waitFor({ state: "hidden" });
  assert.equal(await page.getByLabel("Name", { exact: true }).inputValue(), "typed before the key");
  await page
    .getByText(/\d images/)
    .first()
    .waitFor();
  assert.ok(await page.getByRole("button", { name: "Submit" }).isEnabled());
});

test("nothing but refused connections and a service that stops was on the console", () =>
  assert.deepEqual(
    complaints.filter((text) => !/net::ERR_|status of 503/.test(text)),
    [],
  ));
