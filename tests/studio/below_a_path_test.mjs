// Studio, the program and the Python package with a service below a path of nginx (docker/nginx_below_a_path.conf).
// usage: node below_a_path_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import path from "node:path";
import { after } from "node:test";
import { fileURLToPath } from "node:url";
import { eventually, openStudio } from "./page.mjs";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const kJob = {
  name: "below a path",
  scenario: "city_square/nearest_exit",
  drones: [{ id: "d1", start: [-24, -6, 20], camera: { width: 160, height: 120, pitch_deg: -60 } }],
  capture: { from_s: 1, to_s: 2, rate_hz: 1 },
  outputs: { annotations: ["coco"], previews: 1 },
};

const { program, service, page, complaints, test } = await openStudio();
const folder = mkdtempSync(path.join(tmpdir(), "throng-path-"));
let nginx;
let site;

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

async function startProxy() {
  const port = await freePort();
  const location = readFileSync(path.join(root, "docker/nginx_below_a_path.conf"), "utf8").replace(
    "http://127.0.0.1:8080/",
    `${service.address}/`,
  );
  assert.ok(location.includes(service.address));
  const temporary = ["client_body", "proxy", "fastcgi", "uwsgi", "scgi"].map((name) => `${name}_temp_path ${folder}/${name};`);
  const config = path.join(folder, "nginx.conf");
  writeFileSync(
    config,
    `daemon off; pid ${folder}/pid; error_log stderr warn; events {}\n` +
      `http { access_log off; ${temporary.join(" ")} server { listen 127.0.0.1:${port}; location = / { return 200 other; } ${location} } }\n`,
  );
  nginx = spawn("/usr/sbin/nginx", ["-e", "stderr", "-c", config], { stdio: "inherit" });
  site = `http://127.0.0.1:${port}`;
  await eventually("nginx answers", () =>
    fetch(site).then(
      (answer) => answer.ok,
      () => false,
    ),
  );
}

after(() => {
  nginx?.kill();
  rmSync(folder, { recursive: true, force: true });
});
await startProxy();
const job = await service.finished(kJob);

const heading = (name) => page.getByRole("heading", { name }).first().waitFor();

test("screens of every depth load with their pictures, and links stay below the path", async () => {
  const failed = [];
  page.on("response", (response) => {
    // A run without exits has no table of their crowds.
    if (response.status() >= 400 && !response.url().endsWith("/metrics.csv")) failed.push(`${response.status()} ${response.url()}`);
    if (!response.url().startsWith(`${site}/throng/`)) failed.push(response.url());
  });
  await page.goto(`${site}/throng/`);
  await page.getByRole("link", { name: kJob.name, exact: true }).first().click();
  await heading(kJob.name);
  assert.equal(new URL(page.url()).pathname, `/throng/jobs/${job}`);
  for (const address of ["/", "/jobs", "/new", "/api", "/studies", `/jobs/${job}`, `/jobs/${job}/images`, `/jobs/${job}/runs/0`]) {
    await page.goto(`${site}/throng${address}`);
    await page.locator("h1").first().waitFor();
    const links = await page.locator("a[href]").evaluateAll((all) => all.map((link) => link.href));
    for (const link of links) assert.ok(/^(data|blob):/.test(link) || link.startsWith(`${site}/throng/`) || !link.startsWith(site), link);
  }
  await page.goto(`${site}/throng/jobs/${job}`);
  await eventually("the picture is there", () =>
    page.locator("img").evaluateAll((images) => images.length > 0 && images.every((image) => image.naturalWidth > 0)),
  );
  assert.deepEqual(failed, []);
});

test("the back button leads back, and snippets name the path", async () => {
  await page.goto(`${site}/throng/jobs/${job}`);
  await page.getByRole("link", { name: "Parts, formats and code" }).click();
  await page.getByText(`THRONG_URL=${site}/throng throng fetch ${job}`).waitFor();
  assert.equal(new URL(page.url()).pathname, `/throng/jobs/${job}/downloads`);
  await page.goBack();
  await heading(kJob.name);
  await page.reload();
  await heading(kJob.name);
});

const environment = () => ({ ...process.env, THRONG_URL: `${site}/throng/` });

test("the program takes the address", () => {
  const run = (...words) => execFileSync(program, words, { encoding: "utf8", env: environment(), cwd: folder });
  assert.match(run("jobs"), /below a path/);
  writeFileSync(path.join(folder, "again.job.json"), JSON.stringify({ ...kJob, name: "by the program" }));
  const id = /j[0-9a-z]{15}/.exec(run("submit", "again.job.json"))[0];
  run("watch", id);
  run("fetch", id, "-o", "got.tar");
  assert.ok(readFileSync(path.join(folder, "got.tar")).includes("annotations/instances.json"));
});

test("the Python package takes the address", () => {
  const code = "import throng; print([job['name'] for job in throng.Client().jobs()])";
  const text = execFileSync("/usr/bin/python3", ["-c", code], {
    encoding: "utf8",
    env: { ...environment(), PYTHONPATH: path.join(root, "python") },
  });
  assert.match(text, /below a path/);
});

test("nothing was complained of", () => assert.deepEqual(complaints, []));
