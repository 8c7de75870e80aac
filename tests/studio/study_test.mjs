// Studies in a browser, against a real service: from a preset with a mistake to intervals and convergence.
// usage: node study_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { eventually, jsonFile, openStudio } from "./page.mjs";
import { attacked } from "./service.mjs";

const { service, browser, page, go, complaints, test, check } = await openStudio();
const kRuns = 4;
const kStudy = {
  name: "studio test",
  seed: 3,
  runs: kRuns,
  baseline: "none",
  horizons_s: [20, 40],
  cases: ["nearest_exit_navigated", "crowded_exit_blocked_navigated"].map((name, index) => ({
    id: `case_${index}`,
    title: `Case ${index}, with a long title that takes more than one line on a phone`,
    scenario: `city_square/huang2016/${name}`,
    crowd: { agents: 30 },
    alarm_s: 0,
    duration_s: 60,
  })),
  policies: [
    { id: "none", title: "no drone" },
    { id: "one", title: "one drone", drones: [{ id: "d1", start: [0, 0, 20], moves_goal: [99, 0], guidance: { policy: "balance" } }] },
  ],
};
let address;

const openFile = (study) => page.locator('input[type="file"]').setInputFiles(jsonFile("study.json", study));
const start = () => page.getByRole("button", { name: "Start the study" });
const idOf = (url) => new URL(url).pathname.split("/").at(-1);

test("shipped studies are offered, whole and in small parts", async () => {
  await go("/");
  await page.getByRole("navigation").getByRole("link", { name: "Studies" }).click();
  await page.getByText("No studies yet").waitFor();
  await page.getByText("12 simulations").waitFor();
  await page.getByLabel("Start from").selectOption({ label: "Guidance in the city square: the whole study" });
  await page.getByText("960 simulations: 8 cases × 5 policies × 24 runs").or(page.getByText("960 simulations")).first().waitFor();
  await check(page, "a new study");
});

test("a mistake is shown with its pointer, and mended", async () => {
  const wrong = structuredClone(kStudy);
  wrong.cases[1].scenario = "city_square/huang2016/crowded_exit_blokd_navigated";
  await openFile(wrong);
  await page.getByRole("button", { name: "/cases/1/scenario" }).waitFor();
  assert.ok(await start().isDisabled());
  // At its field, with the nearest name; one of the list mends it, and the text of the other tab follows.
  const scenario = page.locator("#field-cases-1-scenario");
  assert.equal(await scenario.getAttribute("aria-invalid"), "true");
  await page.locator("#field-cases-1-scenario-note", { hasText: "crowded_exit_blocked_navigated" }).waitFor();
  await check(page, "a mistake in a study");
  await scenario.selectOption(kStudy.cases[1].scenario);
  await page.getByText("16 simulations").waitFor();
  assert.equal(await scenario.getAttribute("aria-invalid"), "false");
  await openFile({ not: "a study" });
  await page
    .getByText(/unknown field "not"/)
    .first()
    .waitFor();
  await openFile(kStudy);
  await page.getByText("16 simulations").waitFor();
});

test("a study is written as fields", async () => {
  await page
    .getByRole("group", { name: "Case 2" })
    .getByRole("button", { name: /^Duplicate case/ })
    .click();
  await page.getByText("24 simulations").waitFor();
  await page.locator("#field-cases-2-duration_s").fill("45");
  await page.getByLabel("Runs of each").fill("3");
  await page.getByRole("button", { name: "Add a policy" }).click();
  const policy = page.getByRole("group", { name: "Policy 3" });
  await policy.getByRole("button", { name: "Add a drone" }).click();
  await page.locator("#field-policies-2-drones-0-guidance-speed_mps").fill("99");
  await page.locator("#field-policies-2-drones-0-guidance-speed_mps-note").getByText("found 99").waitFor();
  await page.locator("#field-policies-2-drones-0-guidance-speed_mps").fill("2");
  await page.getByText("27 simulations").waitFor();
  await page.getByLabel("Baseline", { exact: true }).selectOption("one");
  // The plan moves the drone by keys.
  await policy.getByText("Starts on the plan").click();
  await policy.getByRole("button", { name: /^Drone d1 at 0, 0/ }).focus();
  await page.keyboard.press("ArrowRight");
  await policy.getByRole("button", { name: /^Drone d1 at 1, 0/ }).waitFor();
  await check(page, "a study as fields");
  await page.getByRole("tab", { name: "JSON" }).click();
  const text = await page.evaluate(() => JSON.parse(sessionStorage.getItem("throng.study")));
  assert.deepEqual(
    text.cases.map(({ id, duration_s }) => [id, duration_s]),
    [
      ["case_0", 60],
      ["case_1", 60],
      ["case_2", 45],
    ],
  );
  assert.deepEqual(text.policies[2], {
    id: "policy",
    drones: [{ id: "d1", start: [1, 0, 20], guidance: { policy: "balance", speed_mps: 2 } }],
  });
  assert.deepEqual([text.runs, text.baseline, text.cases[2].crowd], [3, "one", { agents: 30 }]);
  await page.locator(".json-editor .cm-content").getByText("studio test").first().waitFor();
  await page.getByRole("tab", { name: "Form" }).click();
  await openFile(kStudy);
  await page.getByText("16 simulations").waitFor();
  assert.equal(await page.locator("#field-runs").inputValue(), String(kRuns));
});

test("the draft survives a reload, and is started", async () => {
  await page.reload(); // the draft survives it
  await page.getByText("16 simulations").waitFor();
  await start().click();
  await page.waitForURL(/\/studies\/[a-z0-9]+$/);
  address = page.url();
});

test("the grid fills while the study runs, and is that of the service", async () => {
  await page.getByRole("region", { name: "Finished runs of each case and policy" }).waitFor();
  await page.getByText("succeeded").waitFor({ timeout: 300_000 });
  const counts = await page.locator(".study-count").allInnerTexts();
  assert.deepEqual(counts, Array(4).fill(`${kRuns} of ${kRuns}`));
  const summary = await service.json(`/v1/studies/${idOf(address)}/files/summary.json`);
  const means = await page.locator(".study-mean").allInnerTexts();
  assert.deepEqual(
    means,
    summary.rows.map((row) => `${row.restricted_means[1].mean_s.toFixed(1)} s`),
  );
});

test("differences and times are those of the summary", async () => {
  const { rows } = await service.json(`/v1/studies/${idOf(address)}/files/summary.json`);
  const signed = (value) => `${value > 0 ? "+" : value < 0 ? "−" : ""}${Math.abs(value).toFixed(1)}`;
  const expected = rows
    .filter((row) => row.policy !== "none")
    .flatMap((row) =>
      row.restricted_means.map(
        (mean) => `${signed(mean.difference_s)} [${signed(mean.difference_95_s[0])}, ${signed(mean.difference_95_s[1])}]`,
      ),
    );
  assert.deepEqual(await page.locator(".forest-text").allInnerTexts(), expected);
  // A point lies where its difference lies between the ends of the axis.
  const ticks = await page
    .locator(".forest-axis span")
    .evaluateAll((spans) => spans.map((span) => [Number(span.textContent.replace("−", "-")), parseFloat(span.style.left)]));
  const [[low, at], [high, end]] = [ticks[0], ticks.at(-1)];
  const places = await page.locator(".forest-point").evaluateAll((points) => points.map((point) => parseFloat(point.style.left)));
  const differences = rows.filter((row) => row.policy !== "none").flatMap((row) => row.restricted_means.map((mean) => mean.difference_s));
  differences.forEach((value, index) => {
    const place = at + ((value - low) / (high - low)) * (end - at);
    assert.ok(Math.abs(place - places[index]) < 0.01, `${value} s is at ${places[index]} %, not at ${place} %`);
  });
  const cells = await page
    .getByRole("region", { name: "Times at which shares of the people were out" })
    .locator("tbody tr:not(.study-case)")
    .first()
    .locator("td")
    .allInnerTexts();
  const text = (value) => (value === null ? "never" : value.toFixed(0));
  const spread = (name) => `${text(rows[0].times[name].median)} [${text(rows[0].times[name].low)}–${text(rows[0].times[name].high)}]`;
  assert.deepEqual(cells.slice(0, 4), [String(kRuns), spread("t50_s"), spread("t90_s"), spread("t95_s")]);
  await check(page, "a study");
});

test("pages of other sites neither see nor change studies", async () => {
  const self = `/v1/studies/${idOf(address)}`;
  const json = { "Content-Type": "application/json" };
  const outcomes = await attacked(browser, service.address, [
    ["/v1/studies", { method: "POST", mode: "no-cors", body: JSON.stringify(kStudy) }],
    ["/v1/studies", { method: "POST", headers: json, body: JSON.stringify(kStudy) }],
    ["/v1/studies", {}],
    [`${self}/events`, {}],
    [self, { method: "PATCH", headers: json, body: '{"keep": true}' }],
    [`${self}/cancel`, { method: "POST", mode: "no-cors" }],
    [self, { method: "DELETE" }],
  ]);
  assert.ok(
    outcomes.every((outcome) => ["opaque 0", "refused"].includes(outcome)),
    outcomes.join(),
  );
  const { studies } = await service.json("/v1/studies");
  assert.deepEqual(
    studies.map(({ id, state, keep }) => [id, state, keep]),
    [[idOf(address), "succeeded", false]],
  );
});

test("the running mean ends at the mean of all runs", async () => {
  const { cases } = await service.json(`/v1/studies/${idOf(address)}/files/values.json`);
  const meanOf = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [none, one] = cases[1].policies.map((policy) => policy.means_s[0]);
  await page.locator(".convergence").getByLabel(/^Case/).selectOption("case_1");
  await page.getByLabel("Mean to").selectOption("0");
  const difference = meanOf(one.map((value, index) => value - none[index]));
  const signed = `${difference > 0 ? "+" : difference < 0 ? "−" : ""}${Math.abs(difference).toFixed(1)}`;
  const chart = page.getByRole("img", { name: /^Running mean up to 20 s after 4 runs/ });
  assert.ok((await chart.getAttribute("aria-label")).includes(`one drone ${signed} ±`), await chart.getAttribute("aria-label"));
  await page.getByRole("checkbox", { name: "Difference to the baseline" }).uncheck();
  await page.getByRole("group", { name: "Policies in the chart" }).getByLabel("no drone").uncheck();
  assert.equal(await page.locator(".convergence polyline.series:not(.series-edge)").count(), 1);
});

test("a study is cancelled, goes on, is repeated with changes and deleted", async () => {
  await page.getByRole("link", { name: "Change and repeat" }).click();
  await page.getByText("16 simulations").waitFor();
  await page
    .getByText(/, about .* judging by/)
    .getByRole("link", { name: "studio test" })
    .waitFor();
  await page.getByLabel("Start from").selectOption({ label: `studio test (${idOf(address)})` });
  await openFile({ ...kStudy, name: "longer", runs: 200 });
  await page.getByText("800 simulations").waitFor();
  await start().click();
  await page.waitForURL((url) => /\/studies\/[a-z0-9]+$/.test(url.pathname) && url.href !== address);
  // Progress comes as events: without any other request for the study it goes on.
  await page.getByText("live", { exact: true }).waitFor();
  await page.route(/\/v1\/studies\/[a-z0-9]+$/, (route) =>
    route.fulfill({ status: 404, contentType: "application/problem+json", body: '{"status": 404, "detail": "hidden by the test"}' }),
  );
  const count = async () => Number(/([\d,]+) of 800/.exec(await page.locator(".summary p").innerText())?.[1]?.replace(",", "") ?? 0);
  const begun = await count();
  await eventually("the count goes on", async () => (await count()) > begun + 2);
  await page.unroute(/\/v1\/studies\/[a-z0-9]+$/);
  await page.getByText(/^simulating: [1-9]/).waitFor();
  await page.getByRole("button", { name: "Keep", exact: true }).click();
  await page.getByRole("button", { name: "Kept", exact: true }).waitFor();
  await page.getByRole("button", { name: "Cancel" }).click();
  await page.getByText("cancelled").first().waitFor();
  await page.getByRole("button", { name: "Go on" }).click();
  await page.getByText(/^simulating: /).waitFor();
  await page.getByRole("button", { name: "Delete" }).click();
  await page.getByRole("dialog").getByRole("button", { name: "Delete the study" }).click();
  await page.waitForURL(/\/studies$/);
  await page.getByRole("link", { name: "studio test", exact: true }).waitFor();
  assert.equal((await service.json("/v1/studies")).studies.length, 1);
  await check(page, "the list of studies");
  await go("/studies/nowhere");
  await page.getByText("There is no study nowhere").waitFor();
});

test("nothing was on the console", () => assert.deepEqual(complaints, []));
