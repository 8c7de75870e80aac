// Pages of Studio under test: what all tests in a browser check alike.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, test as nodeTest } from "node:test";
import { launch, packageFile, TestService } from "./service.mjs";

const kWidths = [360, 768, 1440];
const kWaitMs = 60_000; // a busy machine

/** A page that notes what it complains of. Refused requests are expected answers; anything else on the console is a fault. */
async function openPage(browser, complaints) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, reducedMotion: "reduce" });
  const page = await context.newPage();
  page.setDefaultTimeout(kWaitMs);
  page.on("console", (message) => {
    if (message.type() === "error" && !/Failed to load resource: .* (400|401|403|404|409)/.test(message.text()))
      complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  return page;
}

/** Waits until `condition`, which may be asynchronous, holds. */
export async function eventually(what, condition) {
  const end = Date.now() + kWaitMs;
  while (!(await condition())) {
    assert.ok(Date.now() < end, `waited in vain until ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Each step begins where the last one ended: after a failure the rest is left out. */
function stepsOf(nodeTest) {
  let isBroken = false;
  return (name, step) =>
    nodeTest(name, async (context) => {
      if (isBroken) return context.skip("an earlier step failed");
      isBroken = true;
      await step();
      isBroken = false;
    });
}

/** Findings of axe-core that keep people from using the screen. */
async function checkAccess(page, packages, name) {
  await page.evaluate(readFileSync(packageFile(packages, "axe-core/axe.min.js"), "utf8"));
  const found = await page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations
      .filter((entry) => entry.impact === "serious" || entry.impact === "critical")
      .map((entry) => `${entry.id}: ${entry.nodes.map((node) => node.target.join(" ")).slice(0, 3)}`);
  });
  assert.deepEqual(found, [], name);
}

/** No screen is wider than the window, whatever its width. */
async function checkWidths(page, name) {
  for (const width of kWidths) {
    await page.setViewportSize({ width, height: 900 });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok(wide <= 0, `${name} is ${wide} px too wide at ${width}`);
  }
}

/** Checks the screen that a page shows, in light and dark and at several widths. */
function screenChecker(packages) {
  return async (page, name) => {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      await checkAccess(page, packages, `${name}, ${colorScheme}`);
    }
    await page.emulateMedia({ colorScheme: "light" });
    await checkWidths(page, name);
  };
}

/** A file to choose in the page, whose content is JSON. */
export const jsonFile = (name, value) => ({ name, mimeType: "application/json", buffer: Buffer.from(JSON.stringify(value, null, 2)) });

/** Beginning of each test in a browser: a service and a page of it, which end with the tests. Arguments: PROGRAM PACKAGES. */
export async function openStudio(options = [], environment = {}) {
  const [program, packages] = process.argv.slice(2);
  const service = new TestService(program, options, environment);
  const complaints = [];
  let browser;
  process.on("exit", () => service.child?.kill()); // whatever fails before the first test
  after(async () => {
    await browser?.close();
    await service.stop();
  });
  await service.start();
  browser = await launch(packages);
  const page = await openPage(browser, complaints);
  const go = (address) => page.goto(service.address + address);
  return { program, packages, service, browser, page, go, complaints, test: stepsOf(nodeTest), check: screenChecker(packages) };
}
