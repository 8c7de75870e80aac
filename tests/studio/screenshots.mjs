// Screenshots of docs/studio.md, from a service of their own with two jobs.
// usage: node screenshots.mjs PROGRAM PACKAGES OUTPUT   OUTPUT: folder, docs/studio
import { mkdirSync } from "node:fs";
import path from "node:path";
import { launch, TestService } from "./service.mjs";

const [program, packages, output] = process.argv.slice(2);
const camera = { width: 1280, height: 720 };
const kJobs = [
  { name: "Square, 200 people", seed: 4, crowd: { agents: 200 } },
  { name: "Square, 260 people", seed: 9, crowd: { agents: 260 } },
].map((job) => ({
  scenario: "city_square/emergency",
  runs: 2,
  drones: [{ id: "d1", camera }, { id: "d2", camera }],
  capture: { from_s: 5, to_s: 45, rate_hz: 0.25 },
  outputs: { annotations: ["coco", "keypoints", "exits", "depth"], formats: ["mot"], previews: 2 },
  ...job,
}));

const service = new TestService(program);
await service.start();
const browser = await launch(packages);
try {
  mkdirSync(output, { recursive: true });
  const ids = [];
  for (const job of kJobs) ids.push(await service.finished(job));
  const kScreens = [
    { name: "run", address: `/jobs/${ids[0]}/runs/0?frame=2`, height: 980, ready: 'canvas.overlay[data-drawn$=" boxes"]' },
    { name: "image", address: `/jobs/${ids[0]}/images?image=images/run000/d1/000002.jpg`, height: 800, ready: 'canvas.overlay[data-drawn$=" boxes,masks"]' },
    { name: "depth", address: `/jobs/${ids[0]}/images?image=images/run000/d1/000002.jpg`, height: 800, keys: "bmx3", ready: 'canvas.overlay[data-drawn$=" depth,boxes3d"][data-rasters="depth"]' },
    { name: "downloads", address: `/jobs/${ids[0]}/downloads?include=images,coco`, height: 900, ready: ".parts .size:not(:empty)" },
    { name: "form", address: `/new?clone=${ids[0]}`, height: 900, ready: ".plan-sheet img" },
    { name: "compare", address: `/compare?job=${ids[0]}&job=${ids[1]}&t=13`, height: 980, ready: ".swipe .upper" },
  ];
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  for (const { name, address, height, ready, keys = "" } of kScreens) {
    await page.setViewportSize({ width: 1280, height });
    await page.goto(service.address + address);
    if (keys) await page.locator("canvas.overlay[data-drawn]:not([data-drawn=''])").waitFor();
    for (const key of keys) await page.keyboard.press(key);
    await page.locator(ready).first().waitFor();
    await page.waitForFunction(() => [...document.images].every((image) => image.complete && image.naturalWidth > 0));
    await page.waitForTimeout(500); // the plan, a large drawing, is painted after it has loaded
    await page.screenshot({ path: path.join(output, `${name}.jpg`), type: "jpeg", quality: 72 });
  }
} finally {
  await browser.close();
  await service.stop();
}
