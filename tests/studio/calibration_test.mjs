// The calibration of a camera in a browser, against a real service: from images of a board to a job with the camera.
// usage: node calibration_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after } from "node:test";
import { jsonFile, openStudio } from "./page.mjs";

const { program, service, page, go, complaints, test, check } = await openStudio();
const boards = mkdtempSync(path.join(tmpdir(), "throng-boards-"));
const kCorners = 108; // 12 × 9, of the board that throng calibrate selftest renders
const kTrueFx = 900;
const kLongMs = 120_000; // a busy machine

after(() => rmSync(boards, { recursive: true }));
// With few views its own limits may not hold; the images are there all the same.
spawnSync(program, ["calibrate", "selftest", "--views", "10", "--images", boards], { stdio: "ignore" });
const files = readdirSync(boards)
  .sort()
  .map((name) => path.join(boards, name));
assert.equal(files.length, 10);

const chooser = () => page.locator('input[type="file"]');

/** Drops a file on the page as a hand does. */
async function drop(name, bytes) {
  const transfer = await page.evaluateHandle(
    ([file, base64]) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], file, { type: "image/png" }));
      return data;
    },
    [name, bytes.toString("base64")],
  );
  for (const event of ["dragover", "drop"]) await page.locator(".drop").dispatchEvent(event, { dataTransfer: transfer });
}

test("images are chosen, dropped and taken out again", async () => {
  await go("/");
  await page.getByRole("navigation").getByRole("link", { name: "Calibration" }).click();
  await page.getByText("No calibrations yet").waitFor();
  await check(page, "no calibrations");
  assert.ok(await page.getByRole("button", { name: "Calibrate" }).isDisabled());
  const other = await page.screenshot({ clip: { x: 0, y: 0, width: 1280, height: 720 } }); // as large, without a board
  await chooser().setInputFiles({ name: "notes.txt", mimeType: "text/plain", buffer: Buffer.from("no image") });
  await page.getByText("notes.txt is neither JPEG nor PNG").waitFor();
  await chooser().setInputFiles(files.slice(0, 9));
  await drop("view09.png", readFileSync(files[9]));
  await drop("view09.png", other);
  await page.getByText("11 images").waitFor();
  await page.getByRole("button", { name: "Take out view00.png" }).click();
  await page.getByText("10 images").waitFor();
  await check(page, "chosen images");
});

test("a wrong setting is shown at its field", async () => {
  await page.getByLabel("Inner corners in a row").fill("nine");
  await page.getByLabel("Inner corners in a column").fill("9");
  await page.getByLabel("Name", { exact: true }).fill("wide camera");
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.locator("#calibration-board-columns-note", { hasText: 'found "nine"' }).waitFor();
  await check(page, "a wrong setting");
  await page.getByLabel("Inner corners in a row").fill("12");
});

test("the camera, its accuracy and the corners in each image are shown", async () => {
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.getByText("succeeded").waitFor({ timeout: kLongMs });
  const id = new URL(page.url()).pathname.split("/").at(-1);
  const { camera } = await service.json(`/v1/calibrations/${id}`);
  const found = await service.json(`/v1/calibrations/${id}/points`);
  const row = page.getByRole("row").filter({ has: page.getByText("fx", { exact: true }) });
  const [value, deviation] = (await row.locator("td").allInnerTexts()).map((text) => Number(text.replace("± ", "")));
  assert.ok(Math.abs(value - kTrueFx) < Math.max(4.5, 6 * deviation), `fx ${value} ± ${deviation}`);
  assert.ok(Math.abs(value - camera.fx) <= deviation && Math.abs(deviation / camera.std.fx - 1) < 0.1);
  const warnings = page.locator(".notice.warn li");
  assert.equal(await warnings.count(), camera.warnings.length);
  // Options of the command line are not of this page.
  assert.ok(camera.warnings.some((text) => text.includes("--prior")));
  assert.ok(!(await warnings.allInnerTexts()).join().includes("--"));
  await warnings.filter({ hasText: "(“About known”: cx = 640 ± 20)" }).waitFor();
  assert.ok(
    camera.warnings.some((text) => /^[1-9] views/.test(text)),
    "it warns of fewer than 10 views",
  );
  assert.equal(await page.locator(".cell-covered").count(), Math.round(48 * camera.coverage));
  const figure = page.locator("#view-view01-png");
  assert.equal(await figure.locator(".board-point, .board-outlier").count(), kCorners);
  const drawn = await figure
    .locator("circle")
    .nth(1)
    .evaluate((circle) => [circle.cx.baseVal.value, circle.cy.baseVal.value]);
  const { pixel } = found.views.find((view) => view.image === "view01.png").points[1];
  assert.ok(Math.hypot(drawn[0] - pixel[0] - 0.5, drawn[1] - pixel[1] - 0.5) < 1e-3);
  await page.locator("#view-view09-2-png").getByText("left out: found ").waitFor();
  await page.waitForFunction(() => [...document.images].every((image) => image.complete && image.naturalWidth > 0));
  await page.getByRole("button", { name: "view01.png" }).click();
  assert.equal(await page.evaluate(() => document.activeElement.id), "view-view01-png");
  await check(page, "a calibration");
});

test("the camera goes into a job", async () => {
  const id = new URL(page.url()).pathname.split("/").at(-1);
  await page.getByRole("link", { name: "Use in a job" }).click();
  await page
    .getByText(/\d+ images? in|images/)
    .first()
    .waitFor();
  await page.waitForFunction(() => location.pathname === "/new" && !location.search.includes("calibration"));
  const draft = JSON.parse(await page.evaluate(() => sessionStorage.getItem("throng.draft")));
  assert.ok(draft.drones.length > 0);
  for (const drone of draft.drones) {
    assert.equal(drone.camera.calibration, id);
    assert.equal(drone.camera.width, undefined, "the calibration says the size");
  }
  assert.equal(await page.getByLabel("Calibration", { exact: true }).first().inputValue(), id);
  await page
    .getByRole("region", { name: "Check and submit" })
    .getByText(/\d+ images/)
    .first()
    .waitFor({ timeout: kLongMs });
  assert.ok(await page.getByRole("button", { name: "Submit" }).isEnabled());
});

test("corners are shown even if there are too few images; the rest is added later", async () => {
  await go("/calibrations");
  await chooser().setInputFiles(files.slice(1, 2));
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.getByText("failed", { exact: true }).waitFor({ timeout: kLongMs });
  await page.locator(".board-view circle").first().waitFor();
  assert.equal(await page.locator(".board-view circle").count(), kCorners);
  await check(page, "a failed calibration");
  await page.getByRole("link", { name: "Change and repeat" }).click();
  await page.getByText("1 image,").waitFor();
  await chooser().setInputFiles(files.slice(2));
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.waitForURL(/\/calibrations\/[a-z0-9]+$/); // the list, too, says that one has succeeded
  await page.getByText("succeeded").waitFor({ timeout: kLongMs });
});

test("parameters that are known go with the images", async () => {
  await go("/calibrations");
  await page.getByText("What is known of the lens").click();
  await page.getByLabel("Fixed", { exact: true }).fill("k3, cy = 359.5");
  await page.getByLabel("About known").fill("cx = 640 ± x");
  await page.getByLabel("fx and fy are equal").check();
  await chooser().setInputFiles(files);
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.locator("#calibration-prior-note", { hasText: 'found "x"' }).waitFor();
  await check(page, "known parameters");
  await page.getByLabel("About known").fill("cx = 640 ± 5");
  await page.getByRole("button", { name: "Calibrate" }).click();
  await page.waitForURL(/\/calibrations\/[a-z0-9]+$/);
  await page.getByText("succeeded").waitFor({ timeout: kLongMs });
  const { camera, request } = await service.json(`/v1/calibrations/${new URL(page.url()).pathname.split("/").at(-1)}`);
  assert.deepEqual(
    [request.fix, request.prior, request.tie],
    [{ k3: null, cy: 359.5 }, { cx: { mean: 640, sd: 5 } }, { fx: { to: "fy" } }],
  );
  assert.equal(camera.fx, camera.fy);
  assert.equal(camera.cy, 359.5);
  await service.remove(new URL(page.url()).pathname.replace("/calibrations", "/v1/calibrations"));
});

test("control points give the poses of a camera", async () => {
  const points = [
    [-12, -8, 0],
    [10, -9, 2],
    [14, 6, 0],
    [-9, 7, 3],
    [2, 1, 0],
    [-4, -3, 1],
    [7, 3, 0],
    [0, 9, 2],
  ];
  const center = [-20, -15, 25];
  // Looking at the origin: right, down and ahead.
  const ahead = center.map((value) => -value / Math.hypot(...center));
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const level = Math.hypot(ahead[0], ahead[1]);
  const right = [ahead[1] / level, -ahead[0] / level, 0];
  const axes = [right, cross(ahead, right), ahead];
  const pixels = points.map((point) => {
    const [x, y, z] = axes.map((axis) => axis.reduce((sum, value, index) => sum + value * (point[index] - center[index]), 0));
    return [(900 * x) / z + 639.5, (900 * y) / z + 359.5];
  });
  const table = (name, header, rows) => ({
    name,
    mimeType: "text/csv",
    buffer: Buffer.from(`${header}\n${rows.map((row) => row.join()).join("\n")}\n`),
  });
  const form = page.getByRole("form", { name: "New poses" });
  const inputs = form.locator('input[type="file"]');
  const choose = async (header, seen) => {
    await go("/calibrations?form=poses");
    const ground = points.map((point, index) => [`p${index}`, ...point]);
    const rows = pixels.map((pixel, index) => ["a.jpg", `p${index}`, ...seen(pixel)]);
    const camera = { width: 1280, height: 720, lens: "pinhole", fx: 900, fy: 900, cx: 639.5, cy: 359.5 };
    await inputs.nth(0).setInputFiles(table("gcp.csv", "point,X,Y,Z", ground));
    await inputs.nth(1).setInputFiles(table("seen.csv", header, rows));
    await inputs.nth(2).setInputFiles(jsonFile("camera.json", camera));
  };
  await choose("image,point,u", ([u]) => [u]);
  await page.getByRole("button", { name: "Estimate poses" }).click();
  await page
    .getByRole("alert")
    .or(page.getByText("failed", { exact: true }))
    .first()
    .waitFor({ timeout: kLongMs });
  await page
    .getByText(/column/)
    .first()
    .waitFor();
  await service.remove(new URL(page.url()).pathname.replace("/calibrations", "/v1/calibrations"));
  await choose("image,point,u,v", (pixel) => pixel);
  await check(page, "control points");
  await page.getByRole("button", { name: "Estimate poses" }).click();
  await page.waitForURL(/\/calibrations\/[a-z0-9]+$/);
  await page.getByText("succeeded").waitFor({ timeout: kLongMs });
  const cells = await page.getByRole("region", { name: "Poses of the cameras" }).getByRole("row").nth(1).locator("td").allInnerTexts();
  const [heading, pitch] = [Math.atan2(ahead[1], ahead[0]), Math.asin(ahead[2])].map((angle) => (angle * 180) / Math.PI);
  const expected = [...center, heading, pitch];
  expected.forEach((value, index) => assert.ok(Math.abs(parseFloat(cells[index]) - value) < 0.02, `${cells} is not ${expected}`));
  await check(page, "poses");
  await service.remove(new URL(page.url()).pathname.replace("/calibrations", "/v1/calibrations"));
});

test("calibrations are listed and deleted", async () => {
  await go("/calibrations");
  await page.getByRole("row").nth(3).waitFor();
  await check(page, "the list");
  await page.getByRole("button", { name: "Delete wide camera" }).first().click();
  await page.getByRole("dialog").getByRole("button", { name: "Delete the calibration" }).click();
  await page.waitForFunction(() => document.querySelectorAll("tbody tr").length === 2);
  assert.equal((await service.json("/v1/calibrations")).calibrations.length, 2);
  await go("/calibrations/nowhere");
  await page.getByText("There is no calibration nowhere").waitFor();
});

test("nothing was on the console", () => assert.deepEqual(complaints, []));
