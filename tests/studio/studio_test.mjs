// Studio in a browser, against a real service: a job from the form to its labels, with mistakes and keys.
// usage: node studio_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { pixelsOf } from "./masks.mjs";
import { eventually, jsonFile, openStudio } from "./page.mjs";
import { kOtherHost, OtherSite } from "./service.mjs";

const kJobMs = 120_000; // a busy machine
const kJob = {
  name: "studio test",
  scenario: "city_square/emergency",
  crowd: { agents: 150 },
  drones: [
    { id: "d1", camera: { width: 320, height: 180 } },
    { id: "d2", camera: { width: 320, height: 180 } },
  ],
  capture: { from_s: 1, to_s: 2, rate_hz: 1 },
  outputs: { annotations: ["coco", "keypoints", "exits"], previews: 1 },
};

const { service, browser, page, go, complaints, test, check } = await openStudio();
let job; // the id of the job that the form submits

async function type(label, text) {
  await page.getByLabel(label, { exact: true }).fill(text);
}

test("the empty home leads to the form", async () => {
  await go("/");
  await page.getByText("No jobs yet").waitFor();
  await check(page, "home");
  // A file opened at once is kept, however late the schema comes.
  await page.route("**/v1/schema", async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 2000));
    await route.continue();
  });
  await page.getByRole("link", { name: "Make the first dataset" }).click();
  await page.getByRole("heading", { name: "New job" }).waitFor();
  assert.equal(new URL(page.url()).pathname, "/new");
});

test("a mistake is shown at its field and at its line", async () => {
  await page.getByLabel("Open a file").setInputFiles(jsonFile("job.json", kJob));
  await page.getByText("4 images").waitFor();
  await type("Runs", "none");
  const field = page.locator("#field-runs");
  await page.locator("#field-runs-note", { hasText: 'found "none", expected an integer from 1 to 1000' }).waitFor();
  assert.equal(await field.getAttribute("aria-invalid"), "true");
  assert.ok(await page.getByRole("button", { name: "Submit" }).isDisabled());
  await check(page, "form");
  await page.getByRole("tab", { name: /JSON/ }).click();
  const line = page.locator(".cm-line", { has: page.locator(".cm-lintRange-error") });
  await line.waitFor();
  assert.match(await line.innerText(), /"runs": "none"/);
  await check(page, "text");
  await page.getByRole("tab", { name: "All fields" }).click();
  await page.getByPlaceholder("Search fields").fill("exposure");
  await page.getByLabel("Exposure: value").first().waitFor();
  assert.equal(await page.getByLabel("Name", { exact: true }).count(), 0);
  await page.getByPlaceholder("Search fields").fill("");
  await check(page, "all fields");
  await type("Runs", "1");
  await page.getByText("4 images").waitFor();
});

test("a drone moves on the plan by keyboard", async () => {
  await page.getByRole("tab", { name: "Basic" }).click();
  const drone = page.getByRole("button", { name: /^Drone d2 at 10, -12/ });
  await drone.focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowUp");
  await page.getByRole("button", { name: /^Drone d2 at 11, -11/ }).waitFor();
  assert.equal(await page.locator("#field-drones-1-start input").first().inputValue(), "11");
});

test("what was typed survives a reload", async () => {
  await page.getByText("4 images").waitFor();
  await page.reload();
  await page.getByText("4 images").waitFor();
  assert.equal(await page.getByLabel("Name", { exact: true }).inputValue(), kJob.name);
});

test("a submitted job is watched until it ends", async () => {
  await page.getByRole("button", { name: "Submit" }).click();
  await page.getByRole("heading", { name: kJob.name }).waitFor();
  job = /\/jobs\/(\w+)$/.exec(page.url())[1];
  // Nothing is reloaded: events of the service change the screen.
  await page.locator(".heading .badge", { hasText: "succeeded" }).waitFor({ timeout: kJobMs });
  const stored = await service.json(`/v1/jobs/${job}`);
  assert.equal(stored.job.drones[1].start[0], 11);
  await page.locator("summary", { hasText: "Logs" }).click();
  await page.locator("pre.log", { hasText: /\w{4}/ }).waitFor();
  await check(page, "job");
});

test("masks on the canvas are those of the annotations", async () => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.getByRole("link", { name: "Browse images" }).click();
  await page.locator('canvas.image[data-drawn="yes"]').nth(3).waitFor();
  await check(page, "images");
  const name = "images/run000/d2/000001.jpg";
  await go(`/jobs/${job}/images?image=${name}`);
  const coco = await service.json(`/v1/jobs/${job}/files/annotations/instances.json`);
  const image = coco.images.find((entry) => entry.file_name === name);
  const people = coco.annotations.filter((entry) => entry.image_id === image.id);
  assert.ok(people.length > 3);
  await page.locator(`canvas.overlay[data-drawn="${image.id} boxes,masks"]`).waitFor();
  await page.keyboard.press("b");
  const canvas = page.locator(`canvas.overlay[data-drawn="${image.id} masks"]`);
  await canvas.waitFor();
  const painted = new Set(
    await canvas.evaluate((element, { width, height }) => {
      const { data } = element.getContext("2d").getImageData(0, 0, element.width, element.height);
      const scale = element.width / width;
      const found = [];
      for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
          const column = Math.floor((x + 0.5) * scale);
          const row = Math.floor((y + 0.5) * scale);
          if (data[4 * (row * element.width + column) + 3] > 0) found.push(y * width + x);
        }
      }
      return found;
    }, image),
  );
  const expected = new Set(people.flatMap((entry) => [...pixelsOf(entry.segmentation)]));
  assert.ok(expected.size > 100);
  assert.deepEqual([...painted].sort(), [...expected].sort());
});

test("labels and images change by keyboard", async () => {
  await page.keyboard.press("k");
  await page.locator('canvas.overlay[data-drawn$="masks,keypoints"]').waitFor();
  await page.keyboard.press("ArrowLeft");
  await page.getByText("run000 · d2 · 000000").waitFor();
  await page.keyboard.press("ArrowUp");
  await page.getByText("run000 · d1 · 000000").waitFor();
  await page.locator('canvas.overlay[data-drawn$="masks,keypoints"]').waitFor();
  await check(page, "viewer");
  await page.keyboard.press("Escape");
  await page.getByRole("heading", { name: /^Images of/ }).waitFor();
});

test("a click names a person", async () => {
  await page.setViewportSize({ width: 1440, height: 900 });
  const coco = await service.json(`/v1/jobs/${job}/files/annotations/instances.json`);
  const image = coco.images.find((entry) => entry.file_name === "images/run000/d1/000000.jpg");
  const people = coco.annotations.filter((entry) => entry.image_id === image.id);
  const chosen = people.reduce((best, entry) => (entry.area > best.area ? entry : best));
  await go(`/jobs/${job}/images?image=${image.file_name}`);
  const canvas = page.locator(`canvas.overlay[data-drawn^="${image.id} "]`);
  const box = await canvas.boundingBox();
  const scale = box.width / image.width;
  const [x, y, width, height] = chosen.bbox;
  await canvas.click({ position: { x: (x + width / 2) * scale, y: (y + height / 2) * scale } });
  const record = page.getByLabel("Person", { exact: true });
  await record.locator("dd").getByText(String(chosen.track_id), { exact: true }).waitFor();
  const track = coco.tracks.find((entry) => entry.id === chosen.track_id);
  await record.getByText(track.attributes.wears).waitFor();
});

test("a run is shown over time", async () => {
  await go(`/jobs/${job}`);
  await page.getByRole("link", { name: "run000", exact: true }).click();
  await page.getByRole("heading", { name: `run000 of ${kJob.name}` }).waitFor();
  const time = page.getByRole("slider", { name: "Time" });
  await time.waitFor();
  assert.equal(await time.getAttribute("aria-valuetext"), "1.0 s");
  await page.getByRole("img", { name: "Share of the people who have escaped: 0 % at 1.0 s" }).waitFor();
  await page.keyboard.press("ArrowRight");
  const coco = await service.json(`/v1/jobs/${job}/files/annotations/instances.json`);
  const ids = new Set(coco.images.filter((image) => image.time_s === 2).map((image) => image.id));
  const people = new Set(coco.annotations.filter((entry) => ids.has(entry.image_id)).map((entry) => entry.track_id));
  await page.getByText(`${people.size} people that a camera sees`).waitFor();
  // The others come from the trace: this job's annotations have no trajectories.
  await page.getByText(/White: \d+ (person|people) that no camera sees/).waitFor();
  await page.getByRole("img", { name: /^States of the exits at 2.0 s: exit1 idle/ }).waitFor();
  assert.equal(await time.getAttribute("aria-valuetext"), "2.0 s");
  await check(page, "run");
});

test("jobs are compared", async () => {
  const changed = { ...kJob, name: "studio test, more people", seed: 5, crowd: { agents: 200 } };
  const other = await service.post("/v1/jobs", changed);
  await go("/jobs");
  await page.locator("tbody tr", { hasText: changed.name }).getByText("succeeded").waitFor({ timeout: kJobMs });
  await page.getByLabel("Select all jobs of this page").check();
  await page.getByRole("group", { name: "Selected jobs" }).getByRole("link", { name: "Compare" }).click();
  await page.getByRole("heading", { name: "Compare", exact: true }).waitFor();
  const ids = new URL(page.url()).searchParams.getAll("job");
  assert.deepEqual([...ids].sort(), [job, other.id].sort());
  // Each job has one run: its figures are those of metrics.json.
  const row = page.locator("tr", { has: page.getByRole("rowheader", { name: "People", exact: true }) });
  await row.waitFor();
  const cells = await row.locator("td").allInnerTexts();
  const people = await Promise.all(ids.map(async (id) => (await service.json(`/v1/jobs/${id}/metrics`)).runs[0].people));
  assert.deepEqual(
    cells,
    people.map((count) => count.toFixed(1)),
  );
  const fields = await page.getByRole("region", { name: "Fields in which the jobs differ" }).getByRole("rowheader").allInnerTexts();
  assert.deepEqual(fields.sort(), ["/crowd/agents", "/drones/1/start", "/seed"]);
  await page.getByRole("slider", { name: "Time" }).fill("2");
  await page.getByRole("img", { name: /^Median share of the people who have escaped at 2.0 s/ }).waitFor();
  await page
    .getByRole("img", { name: /images\/run000\/d1\/000001.jpg$/ })
    .nth(1)
    .waitFor();
  const edge = page.getByRole("slider", { name: "Edge between the images" });
  await edge.fill("25");
  const upper = page.locator(".swipe .upper");
  assert.match(await upper.evaluate((image) => image.style.clipPath), /^inset\(0(px)? 0(px)? 0(px)? 25%\)$/);
  await check(page, "comparison");
  // A run of a job beside the job that it is of.
  await go(`/jobs/${ids[0]}/runs/0`);
  await page.getByRole("link", { name: /^Compare with/ }).click();
  await page.getByLabel("Add a job or a run").selectOption(ids[1]);
  await row.waitFor();
  assert.deepEqual(new URL(page.url()).searchParams.getAll("job"), [`${ids[0]}:0`, ids[1]]);
  assert.deepEqual(await row.locator("td").allInnerTexts(), cells);
  await page.getByLabel("Add a job or a run").selectOption(`${ids[1]}:0`);
  await page
    .getByRole("link", { name: /, run 0$/ })
    .nth(1)
    .waitFor();
  await page.locator(".swipe .upper").waitFor();
  await check(page, "runs compared");
  await service.remove(`/v1/jobs/${other.id}`);
  await page.reload();
  await page.getByText(`there is no job ${other.id}`).waitFor();
});

test("jobs are filtered by the address and removed in bulk", async () => {
  await go("/jobs?state=failed");
  await page.getByText("No job fits").waitFor();
  await page.getByRole("button", { name: "succeeded" }).click();
  await page.getByRole("link", { name: kJob.name }).waitFor();
  assert.equal(new URL(page.url()).searchParams.getAll("state").join(), "failed,succeeded");
  const copy = await service.json(`/v1/jobs/${job}/clone`, { method: "POST" });
  await go("/jobs?name=studio");
  await page.locator("tbody tr").nth(1).waitFor();
  await check(page, "jobs");
  await page.getByLabel("Select all jobs of this page").check();
  await page.getByLabel(`Select ${kJob.name}`).last().uncheck();
  await page.getByRole("group", { name: "Selected jobs" }).getByRole("button", { name: "Delete" }).click();
  await page.getByRole("dialog").getByRole("button", { name: "Delete 1 job" }).click();
  await page.waitForFunction(() => document.querySelectorAll("tbody tr").length === 1);
  const left = await service.json("/v1/jobs");
  assert.deepEqual(
    left.jobs.map((entry) => entry.id),
    [job],
  );
  assert.notEqual(copy.id, job);
});

test("wrong addresses and removed jobs are named", async () => {
  await go("/nothing/here");
  await page.getByText("There is nothing at this address.").waitFor();
  await go("/jobs/j0000000000000000");
  await page.getByText("There is no job j0000000000000000").waitFor();
});

test("pages of other sites can neither change nor read anything", async () => {
  const attacker = new OtherSite();
  await attacker.start();
  try {
    const before = await service.json("/v1/jobs");
    const context = await browser.newContext();
    const evil = await context.newPage();
    await evil.goto(attacker.address);
    const body = JSON.stringify({ ...kJob, name: "attack" });
    const outcomes = await evil.evaluate(
      async ({ address, body, job }) => {
        const outcome = (path, init) =>
          fetch(address + path, init).then(
            (response) => `${response.type} ${response.status}`,
            () => "refused",
          );
        return [
          await outcome("/v1/jobs", { method: "POST", mode: "no-cors", body }),
          await outcome("/v1/jobs", { method: "POST", headers: { "Content-Type": "application/json" }, body }),
          await outcome(`/v1/jobs/${job}`, { method: "DELETE" }),
          await outcome(`/v1/jobs/${job}/clone`, { method: "POST", mode: "no-cors" }),
          await outcome("/v1/jobs", {}),
        ];
      },
      { address: service.address, body, job },
    );
    // An opaque answer cannot be read; what follows shows that it changed nothing. Answers for same-origin pages only
    // (Cross-Origin-Resource-Policy) are refused.
    assert.ok(
      outcomes.every((outcome) => ["opaque 0", "refused"].includes(outcome)),
      outcomes.join(),
    );
    await evil.evaluate(
      ({ address, body }) => {
        const form = document.createElement("form");
        Object.assign(form, { action: `${address}/v1/jobs`, method: "post", enctype: "text/plain" });
        const field = document.createElement("input");
        Object.assign(field, { name: `${body.slice(0, -1)},"x":"`, value: '"}' });
        form.append(field);
        document.body.append(form);
        form.submit();
      },
      { address: service.address, body },
    );
    await evil.waitForURL(`${service.address}/v1/jobs`);
    assert.match(await evil.locator("body").innerText(), /40[03]|415/);
    assert.deepEqual(
      (await service.json("/v1/jobs")).jobs.map((entry) => [entry.id, entry.state]),
      before.jobs.map((entry) => [entry.id, entry.state]),
    );
    // The page is not shown in frames of others.
    await evil.goto(attacker.address);
    await evil.evaluate((address) => {
      const frame = document.createElement("iframe");
      frame.src = address;
      document.body.append(frame);
    }, service.address);
    // The frame's address is known some time after the event `load` of its element: none before, then that of what it shows.
    const addressOfFrame = () => evil.frames()[1]?.url() ?? "";
    await eventually("the frame shows something", () => !["", "about:blank"].includes(addressOfFrame()));
    assert.match(addressOfFrame(), /^chrome-error:/);
    assert.match((await fetch(service.address)).headers.get("content-security-policy"), /frame-ancestors 'none'/);
    // A name of the attacker that leads to this machine (DNS rebinding) is not the service's.
    for (const path of ["/", "/v1/jobs"]) {
      const answer = await evil.goto(`http://${kOtherHost}:${new URL(service.address).port}${path}`);
      assert.ok([400, 403, 421].includes(answer.status()), `${path}: ${answer.status()}`);
      assert.ok(!(await answer.text()).includes(job));
    }
    await context.close();
  } finally {
    attacker.stop();
  }
});

test("a key is asked for, a wrong one is reported, and a right one becomes a cookie", async () => {
  // With keys, jobs without the label are seen by their owner and administrators only.
  const labeled = await fetch(`${service.address}/v1/jobs/${job}`, {
    method: "PATCH",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ labels: ["shared"] }),
  });
  assert.equal(labeled.status, 200);
  const key = service.createKey("submit");
  await go(`/jobs/${job}`);
  await page.getByRole("heading", { name: "Key needed" }).waitFor();
  await check(page, "key");
  await page.getByLabel("Key", { exact: true }).fill("throng_wrong");
  await page.getByRole("button", { name: "Use this key" }).click();
  await page.getByRole("alert").getByText("this key is not known, or was revoked").waitFor();
  await page.getByLabel("Key", { exact: true }).fill(key);
  await page.getByRole("button", { name: "Use this key" }).click();
  await page.getByRole("heading", { name: kJob.name }).waitFor();
  const cookies = await page.context().cookies();
  assert.deepEqual(
    cookies.map(({ httpOnly, sameSite, expires }) => ({ httpOnly, sameSite, expires })),
    [{ httpOnly: true, sameSite: "Strict", expires: -1 }],
  );
  assert.ok(!cookies[0].value.includes(key));
  // Images and downloads need the session too.
  await page.waitForFunction(() => [...document.querySelectorAll("figure img")].filter((image) => image.naturalWidth > 0).length >= 2);
  await page.reload();
  await page.getByRole("heading", { name: kJob.name }).waitFor();
  const stored = await page.evaluate(() =>
    JSON.stringify([
      localStorage,
      sessionStorage,
      document.cookie,
      location.href,
      performance.getEntriesByType("resource").map((entry) => entry.name),
    ]),
  );
  assert.ok(!stored.includes(key) && !stored.includes("throng_"));
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name: "Dataset (zip)" }).click()]);
  assert.equal(
    readFileSync(await download.path())
      .subarray(0, 2)
      .toString(),
    "PK",
  );
});

test("a session does not serve pages of another port of this host", async () => {
  const attacker = new OtherSite();
  await attacker.start();
  try {
    const evil = await page.context().newPage();
    await evil.goto(attacker.localAddress);
    const outcome = await evil.evaluate(
      async ({ address, job }) => {
        const post = (path) =>
          fetch(address + path, { method: "POST", mode: "no-cors", credentials: "include" }).then(
            (response) => response.type,
            () => "refused",
          );
        const image = new Image();
        const isShown = new Promise((resolve) => {
          image.onload = () => resolve(true);
          image.onerror = () => resolve(false);
        });
        image.src = `${address}/v1/jobs/${job}/plan`;
        const read = await fetch(`${address}/v1/jobs`, { credentials: "include" }).then(
          (response) => response.text(),
          () => "refused",
        );
        return [await post(`/v1/jobs/${job}/clone`), await post("/v1/session"), read, await isShown];
      },
      { address: service.address, job },
    );
    assert.ok(
      outcome.slice(0, 2).every((type) => ["opaque", "refused"].includes(type)),
      outcome.join(),
    );
    assert.deepEqual(outcome.slice(2), ["refused", false]);
    await evil.close();
  } finally {
    attacker.stop();
  }
  const list = await page.evaluate(() => fetch("/v1/jobs").then((response) => response.json()));
  assert.deepEqual(
    list.jobs.map((entry) => entry.id),
    [job],
  );
  await page.getByRole("button", { name: "Sign out" }).click();
  await page.getByRole("heading", { name: "Key needed" }).waitFor();
  assert.deepEqual(await page.context().cookies(), []);
});

test("nothing was on the console", () => assert.deepEqual(complaints, []));
