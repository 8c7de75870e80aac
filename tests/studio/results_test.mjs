// A dataset with all layers in a browser: downloads of its parts, values per pixel, 3-D boxes, a person who is followed.
// usage: node results_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { inflateRawSync } from "node:zlib";
import { importStudio } from "./bundle.mjs";
import { openStudio } from "./page.mjs";

const kJob = {
  name: "all layers",
  scenario: "city_square/emergency",
  crowd: { agents: 120 },
  runs: 2,
  drones: [
    { id: "d1", camera: { width: 320, height: 180, model: "brown_conrady", distortion: { k1: -0.15, k2: 0.02, p1: 0.001, p2: -0.002 } } },
    { id: "d2", camera: { width: 320, height: 180 } },
  ],
  capture: { from_s: 2, to_s: 10, rate_hz: 0.25 },
  outputs: {
    annotations: ["coco", "keypoints", "exits", "density", "depth", "trajectories"],
    formats: ["mot"],
    splits: { train: 0.5, val: 0.5 },
    previews: 0,
  },
};
const kImage = "images/run000/d2/000001.jpg";

const { packages, service, page, go, complaints, test, check } = await openStudio();

const job = await service.finished(kJob);
const coco = await service.json(`/v1/jobs/${job}/files/annotations/instances.json`);

const peopleOf = (name) => {
  const image = coco.images.find((entry) => entry.file_name === name);
  return { image, people: coco.annotations.filter((entry) => entry.image_id === image.id) };
};

test("the size of a part is that of its archive", async () => {
  await go(`/jobs/${job}`);
  await page.getByRole("link", { name: "Parts, formats and code" }).click();
  await page.getByRole("heading", { name: `Downloads of ${kJob.name}` }).waitFor();
  await page.getByRole("link", { name: /^Download [\d.]+ .B$/ }).waitFor();
  await page.getByLabel(/^depth /).check();
  await page.getByLabel(/^mot /).check();
  await page.getByLabel("Split").selectOption("val");
  await page.getByLabel(/^Archive/).selectOption("zip");
  const address = new URL(page.url());
  assert.deepEqual(Object.fromEntries(address.searchParams), { format: "zip", include: "depth,mot", split: "val" });
  const link = page.getByRole("link", { name: /^Download [\d.]+ .B$/ });
  await link.waitFor();
  const [download] = await Promise.all([page.waitForEvent("download"), link.click()]);
  const bytes = readFileSync(await download.path());
  assert.equal(bytes.subarray(0, 2).toString(), "PK");
  const shown = /([\d.]+) (.)B/.exec(await link.innerText());
  assert.ok(Math.abs(bytes.length / { k: 1e3, M: 1e6 }[shown[2]] - Number(shown[1])) < 1, "the size was said before");
  const text = bytes.toString("latin1");
  assert.ok(text.includes("/depth/run001/") && text.includes("/formats/mot/"));
  assert.ok(!text.includes("/depth/run000/") && !text.includes("/images/"), "nothing else is in it");
  await page.getByText(`THRONG_URL=${service.address} throng fetch ${job} --zip --include 'depth' 'mot' --split 'val'`).waitFor();
  await page.getByRole("button", { name: "Python" }).click();
  await page.getByText(`client.download("${job}", include=["depth","mot"], split="val", format="zip")`).waitFor();
  await check(page, "downloads");
});

test("a wrong selection is named", async () => {
  await page.getByLabel("Runs", { exact: true }).fill("7");
  await page.keyboard.press("Tab");
  await page.getByRole("alert").getByText("?runs").waitFor();
});

test("each format says how it is made and read", async () => {
  const { formats } = await service.json("/v1/formats");
  const list = page.getByRole("region", { name: "Formats", exact: true }).locator("details");
  assert.equal(await list.count(), formats.length);
  for (let index = 0; index < formats.length; ++index) await list.nth(index).locator("summary").click();
  await page.getByLabel("read mot", { exact: true }).getByText("dataset/formats/mot/").waitFor();
  await page.getByLabel("export to voc", { exact: true }).getByText("--formats voc").waitFor();
  await page.getByText("Needs instances among the annotations").waitFor();
  const without = formats.filter((format) => format.needs && !kJob.outputs.annotations.includes(format.needs)).length;
  assert.equal(await list.locator('pre[aria-label^="read "]').count(), formats.length - without);
});

test("3-D boxes are projected as the dataset's keypoints are", async () => {
  const { cornersOf, projectionOf } = await importStudio(packages, "dataset/camera.ts");
  for (const camera of ["d1", "d2"]) {
    const { image, people } = peopleOf(`images/run000/${camera}/000001.jpg`);
    assert.equal(image.camera.model, camera === "d1" ? "brown_conrady" : "pinhole");
    const project = projectionOf(image.camera);
    let count = 0;
    for (const person of people.filter((entry) => entry.keypoints)) {
      person.keypoints_3d.forEach((point, index) => {
        const [x, y, seen] = person.keypoints.slice(3 * index, 3 * index + 3);
        if (seen === 0) return;
        const [u, v] = project(point);
        assert.ok(Math.hypot(u - x, v - y) < 0.1, `${u}, ${v} is not ${x}, ${y}`);
        ++count;
      });
      const corners = cornersOf(person.box_3d, person.heading).map(project);
      const [left, top, width, height] = person.bbox;
      assert.ok(
        Math.min(...corners.map((corner) => corner[0])) < left + 1 && Math.max(...corners.map((corner) => corner[0])) > left + width - 1,
      );
      assert.ok(
        Math.min(...corners.map((corner) => corner[1])) < top + 1 && Math.max(...corners.map((corner) => corner[1])) > top + height - 1,
      );
    }
    assert.ok(count > 50, `${count} keypoints`);
  }
});

test("3-D boxes are drawn", async () => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await go(`/jobs/${job}/images?image=${kImage}`);
  const { image } = peopleOf(kImage);
  await page.locator(`canvas.overlay[data-drawn="${image.id} boxes,masks"]`).waitFor();
  await page.keyboard.press("b");
  await page.keyboard.press("m");
  await page.keyboard.press("3");
  const canvas = page.locator(`canvas.overlay[data-drawn="${image.id} boxes3d"]`);
  await canvas.waitFor();
  const painted = await canvas.evaluate(
    (element) =>
      element
        .getContext("2d")
        .getImageData(0, 0, element.width, element.height)
        .data.filter((value, index) => index % 4 === 3 && value > 0).length,
  );
  assert.ok(painted > 500, `${painted} pixels`);
  await page.keyboard.press("3");
});

/** The .npy file in the .npz file at an address of the service. */
async function arrayIn(path) {
  const zip = Buffer.from(await (await fetch(service.address + path)).arrayBuffer());
  return inflateRawSync(zip.subarray(30 + zip.readUInt16LE(26) + zip.readUInt16LE(28)));
}

test("depth and density at the pointer are those of the files", async () => {
  await page.keyboard.press("x");
  await page.keyboard.press("d");
  const canvas = page.locator('canvas.overlay[data-rasters="density,depth"]');
  await canvas.waitFor();
  await page.getByText(/^Depth: [\d.]+ m \(yellow\)/).waitFor();
  const { image } = peopleOf(kImage);
  const box = await canvas.boundingBox();
  const scale = box.width / image.width;
  await page.mouse.move(box.x + 160.5 * scale, box.y + 120.5 * scale);
  const shown = await page.locator(".pixel-values").innerText();
  // The ground: its depth follows from the camera alone. Rays are R's rows; the ground is z = 0.
  const { K, R, t } = image.camera;
  const ray = [(160.5 - 0.5 - K[0][2]) / K[0][0], (120.5 - 0.5 - K[1][2]) / K[1][1], 1];
  const center = [0, 1, 2].map((axis) => -(R[0][axis] * t[0] + R[1][axis] * t[1] + R[2][axis] * t[2]));
  const down = R[0][2] * ray[0] + R[1][2] * ray[1] + R[2][2] * ray[2];
  const ground = -center[2] / down;
  const depth = Number(/depth ([\d.]+) m/.exec(shown)[1]);
  assert.ok(depth <= ground + 0.02 && depth > 0.7 * ground, `${depth} m, ground ${ground} m`);
  const npy = await arrayIn(`/v1/jobs/${job}/files/${kImage.replace("images", "density").replace("jpg", "npz")}`);
  const value = npy.readFloatLE(10 + npy.readUInt16LE(8) + 4 * (120 * image.width + 160));
  assert.ok(Math.abs(Number(/density ([\d.e-]+)/.exec(shown)[1]) - value) <= 0.005 * value + 1e-12, shown);
  await check(page, "values per pixel");
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.keyboard.press("f");
  await page.getByText("The dataset has no flow").waitFor();
  for (const key of ["f", "x", "d", "b"]) await page.keyboard.press(key);
});

test("a person is followed over frames and cameras", async () => {
  const { people } = peopleOf("images/run000/d1/000000.jpg");
  const tracks = (name) => new Set(peopleOf(name).people.map((entry) => entry.track_id));
  const other = tracks("images/run000/d2/000000.jpg");
  const chosen = people.filter((entry) => other.has(entry.track_id)).reduce((best, entry) => (entry.area > best.area ? entry : best));
  await go(`/jobs/${job}/images?image=images/run000/d1/000000.jpg`);
  const { image } = peopleOf("images/run000/d1/000000.jpg");
  const canvas = page.locator(`canvas.overlay[data-drawn^="${image.id} "]`);
  await canvas.waitFor();
  const box = await canvas.boundingBox();
  const scale = box.width / image.width;
  const [x, y, width, height] = chosen.bbox;
  await canvas.click({ position: { x: (x + width / 2) * scale, y: (y + height / 2) * scale } });
  const follow = page.getByRole("region", { name: "Followed person" });
  await follow.getByText(String(chosen.track_id), { exact: true }).waitFor();
  const seen = peopleOf("images/run000/d2/000000.jpg").people.find((entry) => entry.track_id === chosen.track_id);
  await follow
    .locator("li", { has: page.getByRole("button", { name: "d2" }) })
    .getByText(`${Math.round(100 * seen.visibility)} % visible`)
    .waitFor();
  await follow.getByRole("button", { name: "d2" }).click();
  await page.getByText("run000 · d2 · 000000").waitFor();
  await follow.getByRole("button", { name: "Seen next" }).click();
  const next = ["d2", "d1"].map((camera) => `images/run000/${camera}/000001.jpg`).find((name) => tracks(name).has(chosen.track_id));
  if (next) await page.getByText(`run000 · ${next.split("/")[2]} · 000001`).waitFor();
  else await follow.getByText("No camera sees them").or(page.getByText("000002")).waitFor();
  await check(page, "followed");
  await follow.getByRole("button", { name: "Stop" }).click();
  await follow.waitFor({ state: "detached" });
});

test("images are filtered by histograms of their labels", async () => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await go(`/jobs/${job}/images`);
  await page.getByRole("link", { name: "All filters" }).click();
  const filters = page.getByRole("region", { name: "Filters" });
  const group = (name) => filters.getByRole("group", { name, exact: true });
  await group("State of a person").waitFor();
  // The oracle counts the annotations as JSON.
  const peopleIn = (image) => coco.annotations.filter((entry) => entry.image_id === image.id && entry.category_id === 1);
  const imagesWith = (...conditions) =>
    coco.images.filter((image) => peopleIn(image).some((entry) => conditions.every((holds) => holds(entry))));
  const heights = [0, 8, 16, 32, 64, 128].map((from) => ({
    label: `${from} to ${from ? 2 * from : 8} px`,
    holds: ({ bbox }) => bbox[3] >= from && bbox[3] < (from ? 2 * from : 8),
  }));
  const parts = [0, 20, 40, 60, 80].map((from) => ({
    label: `${from} to ${from + 20} %`,
    holds: ({ visibility }) => visibility >= from / 100 && (from === 80 || visibility < (from + 20) / 100),
  }));
  // How many images show somebody of some height and visible part depends on the people, so the bars do, too: both together
  // leave some of the images, as near to half of them as can be.
  const pairs = heights.flatMap((height) => parts.map((part) => ({ height, part, both: imagesWith(height.holds, part.holds) })));
  const fromHalf = ({ both }) => Math.abs(both.length - coco.images.length / 2);
  const { height, part, both } = pairs.reduce((best, pair) => (fromHalf(pair) < fromHalf(best) ? pair : best));
  assert.ok(both.length > 0 && both.length < coco.images.length, `${both.length} of ${coco.images.length}`);
  const tall = imagesWith(height.holds);
  const bar = (facet, label, list) => group(facet).getByRole("button", { name: new RegExp(`^${label}\\W+${countOf(list)}$`) });
  const countOf = (list) => (list.length === 1 ? "1 image" : `${list.length} images`);
  await bar("Height of a person", height.label, tall).focus();
  await page.keyboard.press("Enter");
  await bar("Visible part of a person", part.label, both).click();
  await filters
    .getByRole("status")
    .getByText(`${countOf(both)} of ${coco.images.length}`)
    .waitFor();
  assert.equal(await page.locator("a.thumbnail").count(), both.length);
  const light = coco.images.filter((image) => image.environment.sun_elevation_deg >= 15 && both.includes(image));
  if (light.length > 0) await bar("Light", "day", light).waitFor();
  await page.reload();
  await filters
    .getByRole("status")
    .getByText(`${countOf(both)} of ${coco.images.length}`)
    .waitFor();
  const d1 = both.filter((image) => image.camera_id === "d1");
  if (d1.length > 0) {
    await bar("Camera", "d1", d1).click();
    await filters
      .getByRole("status")
      .getByText(`${countOf(d1)} of`)
      .waitFor();
  }
  await page.locator('canvas.image[data-drawn="yes"]').first().waitFor();
  await check(page, "filters");
  await filters.getByRole("link", { name: "No filters" }).click();
  await page.getByText(`${coco.images.length} images`).waitFor();
});

test("density maps are compared in the same colors", async () => {
  const other = await service.finished({ ...kJob, name: "fewer people", crowd: { agents: 60 }, runs: 1 });
  await page.setViewportSize({ width: 1440, height: 900 });
  await go(`/compare?job=${job}&job=${other}&t=6`);
  await page.getByRole("checkbox", { name: "Density" }).check();
  await page.getByRole("img", { name: "density of fewer people" }).waitFor();
  const sumOf = async (id) => {
    const npy = await arrayIn(`/v1/jobs/${id}/files/density/run000/d1/000001.npz`);
    let sum = 0;
    for (let at = 10 + npy.readUInt16LE(8); at < npy.length; at += 4) sum += npy.readFloatLE(at);
    return sum.toFixed(1);
  };
  await page.getByText(`People in the images: ${await sumOf(job)} and ${await sumOf(other)}.`).waitFor();
  // Left of the edge the one map is seen, right of it the other.
  await page.getByRole("slider", { name: "Edge between the images" }).fill("30");
  const clips = await page.locator("canvas.density").evaluateAll((list) => list.map((canvas) => canvas.style.clipPath));
  assert.match(clips[0], /^inset\(0(px)? 70% 0(px)? 0(px)?\)$/);
  assert.match(clips[1], /^inset\(0(px)? 0(px)? 0(px)? 30%\)$/);
  await check(page, "density compared");
});

test("events of a run lead to their time", async () => {
  const metrics = await service.json(`/v1/jobs/${job}/runs/0/metrics`);
  assert.equal(metrics.alarm_s, 8);
  await page.setViewportSize({ width: 1440, height: 900 });
  await go(`/jobs/${job}/runs/0`);
  await page.getByRole("img", { name: /events? of the run$/ }).waitFor();
  const alarm = page.getByRole("listitem").filter({ hasText: "alarm" });
  await alarm.getByRole("button", { name: "8.0 s" }).focus();
  await page.keyboard.press("Enter");
  await page.getByRole("slider", { name: "Time" }).and(page.locator('[aria-valuetext="10.0 s"]')).waitFor(); // the nearest image
  await check(page, "run with events");
});

test("everybody of a run is counted once, and figures lead to their definitions", async () => {
  const { people, people_counts: counts } = await service.json(`/v1/jobs/${job}/runs/0/metrics`);
  await go(`/jobs/${job}/runs/0`);
  const figures = page.locator("section", { hasText: "Escaped by time" }).locator(".figures").first();
  await figures.waitFor();
  const [all, ...parts] = (await figures.locator("dd").allTextContents()).map(Number);
  assert.equal(all, people);
  assert.equal(
    parts.reduce((sum, part) => sum + part, 0),
    people,
  );
  const exit = counts.left_by_exit[0];
  await figures
    .locator("div", { hasText: `left by ${exit.id}` })
    .locator("dd", { hasText: String(exit.people) })
    .first()
    .waitFor();
  await page.getByRole("link", { name: "escape time, median" }).click();
  const definition = page.locator("#definition-escape_time_percentiles[aria-current]");
  await definition.getByText("escape_time_percentiles").waitFor();
  await check(page, "definitions of figures");
});

test("the plan shows everybody, seen by a camera or not", async () => {
  await go(`/jobs/${job}/runs/0?frame=1`);
  const seen = new Set(
    ["d1", "d2"].flatMap((camera) =>
      peopleOf(`images/run000/${camera}/000001.jpg`)
        .people.filter((entry) => entry.category_id === 1)
        .map((entry) => entry.track_id),
    ),
  );
  const { track_ids } = await service.json(`/v1/jobs/${job}/files/trajectories/run000.json`);
  const npy = Buffer.from(await (await fetch(`${service.address}/v1/jobs/${job}/files/trajectories/run000.npy`)).arrayBuffer());
  const start = 10 + npy.readUInt16LE(8);
  const present = track_ids.filter((_, person) => !Number.isNaN(npy.readFloatLE(start + 16 * (track_ids.length + person))));
  const unseen = present.filter((track) => !seen.has(track)).length;
  assert.ok(unseen > 0, "a person whom no camera sees");
  assert.ok([...seen].every((track) => present.includes(track)));
  await page.getByRole("img", { name: `${present.length} people on the plan` }).waitFor();
  await page.getByText(new RegExp(`White: ${unseen} (person|people) that no camera sees`)).waitFor();
  const dots = page.locator("canvas.unseen");
  assert.equal(await dots.getAttribute("data-count"), String(unseen));
  assert.ok(
    await dots.evaluate((canvas) =>
      canvas
        .getContext("2d")
        .getImageData(0, 0, canvas.width, canvas.height)
        .data.some((value) => value > 0),
    ),
    "they are drawn",
  );
  await check(page, "everybody on the plan");
});

test("nothing was on the console", () => assert.deepEqual(complaints, []));
