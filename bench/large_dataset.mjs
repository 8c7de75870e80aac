// How long the first page of a large dataset takes in Chromium, from the address to its thumbnails; the service has just been
// started, and knows nothing of the dataset yet. Most images are entries of the manifest only: a page does not open them.
// usage: node bench/large_dataset.mjs THRONG PACKAGES [IMAGES]
import { linkSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { launch, TestService } from "../tests/studio/service.mjs";

const [program, folder, wanted = "100000"] = process.argv.slice(2);
const kRuns = 10;
const kThere = 200; ///< images of the first camera that are files, too
const kAttempts = 3;
const service = new TestService(program);
const job = {
  name: "large",
  scenario: "city_square/emergency",
  crowd: { agents: 20 },
  quality: "draft",
  drones: [{ id: "d1", camera: { width: 1280, height: 720 } }],
  capture: { from_s: 1, to_s: 2, rate_hz: 1 },
  outputs: { annotations: [] },
};

/** The dataset's manifest with many more images. */
function enlarge(id) {
  const dataset = path.join(service.data, "jobs", id, "dataset");
  const manifest = JSON.parse(readFileSync(path.join(dataset, "manifest.json"), "utf8"));
  const image = manifest.files.find((file) => file.path.startsWith("images/"));
  const source = path.join(dataset, image.path);
  const more = [];
  for (let run = 0; run < kRuns; ++run) {
    const camera = `images/run${String(run).padStart(3, "0")}/d1`;
    mkdirSync(path.join(dataset, camera), { recursive: true });
    const there = new Set(readdirSync(path.join(dataset, camera)));
    for (let frame = 0; frame < Number(wanted) / kRuns; ++frame) {
      const name = `${String(frame).padStart(6, "0")}.jpg`;
      more.push({ ...image, path: `${camera}/${name}` });
      if (run === 0 && frame < kThere && !there.has(name)) linkSync(source, path.join(dataset, camera, name));
    }
  }
  const files = [...manifest.files.filter((file) => !file.path.startsWith("images/")), ...more].sort((a, b) => (a.path < b.path ? -1 : 1));
  writeFileSync(path.join(dataset, "manifest.json"), JSON.stringify({ ...manifest, files }));
}

/** Ends the service; its helpers close their files in the folder a moment later. */
async function halt() {
  await service.halt();
  await new Promise((resolve) => setTimeout(resolve, 1000));
}

await service.start();
const id = await service.finished(job);
await halt();
enlarge(id);
const browser = await launch(path.resolve(folder));
try {
  for (let attempt = 0; attempt < kAttempts; ++attempt) {
    await service.start();
    for (const visit of ["first visit", "second visit"]) {
      const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
      await page.goto("about:blank");
      const begun = performance.now();
      await page.goto(`${service.address}/jobs/${id}/images`, { waitUntil: "commit" });
      await page.getByText(`${Number(wanted).toLocaleString("en-US")} images`).waitFor();
      const listed = performance.now() - begun;
      // Not waitForFunction(): the page's policy allows no eval().
      const areShown = () =>
        page.evaluate(() => {
          const shown = [...document.querySelectorAll("main .thumbnail canvas")].filter(
            (canvas) => canvas.getBoundingClientRect().top < innerHeight,
          );
          const isDrawn = (canvas) =>
            canvas.width > 1 && canvas.getContext("2d").getImageData(canvas.width >> 1, canvas.height >> 1, 1, 1).data[3] === 255;
          return shown.length > 3 && shown.every(isDrawn);
        });
      while (!(await areShown())) await page.waitForTimeout(10);
      console.log(
        `${wanted} images, ${visit}: listed after ${listed.toFixed(0)} ms, thumbnails after ${(performance.now() - begun).toFixed(0)} ms`,
      );
      await page.close();
    }
    await halt();
  }
} finally {
  await browser.close();
  service.child.kill("SIGTERM");
  rmSync(service.data, { recursive: true, force: true });
}
