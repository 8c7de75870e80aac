// The editor of blueprints in a browser, against a real service: from a drawing to a job, by pointer and by keyboard.
// usage: node blueprint_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { jsonFile, openStudio } from "./page.mjs";

const { service, page, complaints, test, check } = await openStudio();
const kLongMs = 60_000; // a busy machine

const blueprint = () => page.evaluate(() => JSON.parse(sessionStorage.getItem("throng.blueprint")));
const tool = (name) =>
  page
    .getByRole("toolbar")
    .getByRole("button", { name: new RegExp(`^${name} `) })
    .click();
const element = (pointer) => page.locator(`[data-pointer="${pointer}"]`);
const checked = (text) => page.locator('#findings + [data-pending="false"]', { hasText: text }).waitFor({ timeout: kLongMs });

/** Pixels of a point in the plan, m. */
const pixelOf = (x, y) =>
  page.locator(".plan-editor").evaluate(
    (svg, [px, py]) => {
      svg.scrollIntoView({ block: "nearest" });
      const point = new DOMPoint(px, -py).matrixTransform(svg.getScreenCTM());
      return [point.x, point.y];
    },
    [x, y],
  );

async function drag(from, to) {
  await page.mouse.move(...(await pixelOf(...from)));
  await page.mouse.down();
  await page.mouse.move(...(await pixelOf((from[0] + to[0]) / 2, (from[1] + to[1]) / 2)));
  await page.mouse.move(...(await pixelOf(...to)));
  await page.mouse.up();
}

test("the first blueprint can be used as it stands", async () => {
  await page.goto(`${service.address}/`);
  await page.getByRole("navigation").getByRole("link", { name: "Blueprint" }).click();
  await checked("Nothing found");
  await check(page, "the first blueprint");
  assert.ok(await page.getByRole("button", { name: "Upload" }).isEnabled());
});

test("elements are drawn on the grid", async () => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await tool("Building");
  await drag([-4.1, -1.9], [2.2, 3.1]);
  const drawn = (await blueprint()).buildings.at(-1);
  assert.deepEqual(drawn, { id: "building1", box: [-4, -2, 2, 3], height_m: 9 });
  await tool("Wall");
  await drag([8, -4], [8, 4]);
  const wall = (await blueprint()).buildings.at(-1);
  assert.deepEqual(wall.footprint, [
    [8, -4],
    [8, 4],
    [7.6, 4],
    [7.6, -4],
  ]);
  await tool("Hazard");
  await page.mouse.click(...(await pixelOf(14, 5)));
  assert.deepEqual((await blueprint()).disasters, [{ kind: "fire", start_s: 5, position: [14, 5] }]);
  await tool("Drone");
  await page.mouse.click(...(await pixelOf(-14, 5)));
  assert.deepEqual((await blueprint()).drones.at(-1), { id: "d2", yaw_deg: 0, start: [-14, 5, 25] });
});

test("elements are moved by pointer and keyboard, reshaped, and taken back", async () => {
  await drag([-3, 2], [-1, 4.1]);
  assert.deepEqual((await blueprint()).buildings[6].box, [-2, 0, 4, 5]);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Shift+ArrowDown");
  assert.deepEqual((await blueprint()).buildings[6].box, [-1.5, -5, 4.5, 0]);
  await drag([4.5, 0], [6, 1]); // a corner of the box: it stays one
  assert.deepEqual((await blueprint()).buildings[6].box, [-1.5, -5, 6, 1]);
  await page.getByRole("button", { name: "Add a corner after corner 3" }).click();
  assert.deepEqual((await blueprint()).buildings[6].footprint, [
    [-1.5, -5],
    [6, -5],
    [6, 1],
    [2.25, 1],
    [-1.5, 1],
  ]);
  await page.getByRole("button", { name: /^Corner 4 / }).focus();
  await page.keyboard.press("ArrowUp");
  assert.deepEqual((await blueprint()).buildings[6].footprint[3], [2.25, 1.5]);
  for (let step = 0; step < 3; ++step) await page.keyboard.press("Control+z");
  assert.deepEqual((await blueprint()).buildings[6].box, [-1.5, -5, 4.5, 0]);
  await page.keyboard.press("Control+y");
  assert.deepEqual((await blueprint()).buildings[6].box, [-1.5, -5, 6, 1]);
  await element("/buildings/6").focus();
  await page.keyboard.press("Delete");
  assert.equal((await blueprint()).buildings.length, 7);
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal((await blueprint()).buildings.length, 8);
});

test("elements are added and changed by the keyboard alone", async () => {
  await page.locator(".plan-editor").focus();
  await page.keyboard.press("e");
  await page.keyboard.press("Enter");
  const exits = (await blueprint()).exits;
  assert.deepEqual(exits.at(-1), { id: "exit1", from: [-2, 0], to: [2, 0] });
  await page.waitForFunction(() => document.activeElement.getAttribute("data-pointer") === "/exits/2");
  await page.getByLabel("Id", { exact: true }).fill("gate");
  await page.keyboard.press("Enter");
  assert.equal((await blueprint()).exits[2].id, "gate");
});

test("corners are reached by the keyboard", async () => {
  await element("/buildings/7").focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.activeElement.getAttribute("aria-label")?.startsWith("Corner 1 of Building wall1"));
  await page.keyboard.press("Tab");
  await page.keyboard.press("ArrowUp");
  assert.deepEqual((await blueprint()).buildings[7].footprint[1], [8, 4.5]);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.activeElement.getAttribute("data-pointer") === "/buildings/7");
});

test("findings lead to their elements", async () => {
  await element("/exits/2").focus();
  await page.keyboard.press("Delete");
  await element("/buildings/6").focus();
  for (let step = 0; step < 2; ++step) await page.keyboard.press("Shift+ArrowDown"); // onto the building in the south
  const overlap = page.locator(".findings li.error", { hasText: "building1" });
  await overlap.waitFor({ timeout: kLongMs });
  assert.ok(await page.getByRole("button", { name: "Upload" }).isDisabled());
  await check(page, "findings");
  await page.setViewportSize({ width: 1440, height: 900 });
  await overlap.getByRole("button", { name: /^Go to Building (building1|south)$/ }).click();
  await page.waitForFunction(() => ["/buildings/1", "/buildings/6"].includes(document.activeElement.getAttribute("data-pointer")));
  for (let step = 0; step < 2; ++step) await page.keyboard.press("Control+z");
  assert.deepEqual((await blueprint()).buildings[6].box, [-1.5, -5, 6, 1]);
  await page.getByLabel(/^Height/).fill("tall");
  await page.keyboard.press("Enter");
  await page.locator(".findings").getByText('found "tall"').waitFor({ timeout: kLongMs });
  await page.keyboard.press("Escape");
});

test("the draft survives a reload, a file brings it back", async () => {
  const before = await blueprint();
  await page.reload();
  await element("/buildings/6").waitFor();
  assert.deepEqual(await blueprint(), before);
  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name: "Save as a file" }).click()]);
  assert.equal(saved.suggestedFilename(), "my_place.blueprint.json");
  const text = readFileSync(await saved.path(), "utf8");
  assert.deepEqual(JSON.parse(text), before);
  const corrected = JSON.parse(text);
  for (const building of corrected.buildings) if (building.height_m === "tall") building.height_m = 9;
  const open = page.getByLabel("Open a file");
  await open.setInputFiles({ name: "bad.json", mimeType: "application/json", buffer: Buffer.from("[1]") });
  await page.getByRole("alert").getByText("bad.json cannot be opened").waitFor();
  await open.setInputFiles(jsonFile("my.blueprint.json", corrected));
  await checked(/Nothing found|warning/);
});

test("an image is laid below the plan and scaled by two points", async () => {
  await page.getByText("Image below the plan").click();
  const bytes = await page.screenshot({ clip: { x: 0, y: 0, width: 400, height: 200 } });
  await page.getByLabel("Choose an image").setInputFiles({ name: "map.png", mimeType: "image/png", buffer: bytes });
  await page.locator(".plan-editor image").waitFor();
  const sizeOf = () =>
    page.locator(".plan-editor image").evaluate((image) => ["x", "y", "width", "height"].map((key) => Number(image.getAttribute(key))));
  const [x, y, width, height] = await sizeOf();
  assert.deepEqual([width, height], [80, 40]);
  await page.getByRole("button", { name: "Set the scale by two points" }).click();
  for (const point of [
    [-10, 0],
    [10, 0],
  ])
    await page.mouse.click(...(await pixelOf(...point)));
  await page.getByLabel("Distance").fill("30");
  await page.getByRole("button", { name: "Apply" }).click();
  const after = await sizeOf();
  // 20 m are 30 m now; the first point stays.
  const near = (a, b) => Math.abs(a - b) < 0.5;
  assert.ok(near(after[2], 1.5 * width) && near(after[3], 1.5 * height), String(after));
  assert.ok(near(after[0], -10 + 1.5 * (x + 10)) && near(after[1], 1.5 * y), String(after));
  await check(page, "an image");
});

test("the blueprint is uploaded and becomes a job's", async () => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.getByLabel("Name for jobs").fill("test_yard");
  await page.getByRole("button", { name: "Upload", exact: true }).click();
  await page.getByRole("status").getByText("test_yard/place").waitFor({ timeout: kLongMs });
  const scenario = await service.json("/v1/scenarios/test_yard/place");
  assert.deepEqual(scenario.ground_m, [-40, -30, 40, 30]);
  assert.deepEqual(
    scenario.drones.map((drone) => drone.id),
    ["d1", "d2"],
  );
  assert.deepEqual(await service.json("/v1/scenarios/test_yard/place?format=blueprint"), await blueprint());
  await element("/drones/1").focus();
  await page.keyboard.press("ArrowUp");
  await checked(/Nothing found|warning/);
  await page.getByRole("button", { name: "Upload", exact: true }).click();
  await page.getByRole("alert").getByText("already").waitFor();
  await page.getByRole("button", { name: "Replace the upload test_yard" }).click();
  await page.getByRole("status").getByText("test_yard/place").waitFor({ timeout: kLongMs });
  assert.deepEqual((await service.json("/v1/scenarios/test_yard/place")).drones[1].start_m, [-14, 5.5, 25]);
  await page.getByRole("link", { name: "Make a job" }).click();
  await page
    .getByRole("region", { name: "Check and submit" })
    .getByText(/\d+ images/)
    .first()
    .waitFor({ timeout: kLongMs });
  assert.equal(JSON.parse(await page.evaluate(() => sessionStorage.getItem("throng.draft"))).scenario, "test_yard/place");
});

test("shipped scenarios are opened and changed", async () => {
  await page.goto(`${service.address}/blueprint`);
  await page.getByLabel("Start from").selectOption("city_square/emergency");
  await element("/exits/4").waitFor({ state: "attached" }); // a line along an axis has no area
  const opened = await blueprint();
  assert.equal(opened.exits.length, 5, "of the file that it extends");
  assert.equal(opened.extends, undefined);
  await checked(/Nothing found|warning|error/);
  await check(page, "the city square");
});

test("nothing was on the console", () => assert.deepEqual(complaints, []));
