// Keys, webhooks and the API's description in a browser, against a real service.
// usage: node access_test.mjs PROGRAM PACKAGES
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { after } from "node:test";
import { openStudio } from "./page.mjs";

const received = [];
const { service, page, go, complaints, test, check } = await openStudio(["--webhook-private"]);
const receiver = createServer((request, response) => {
  received.push(request.headers);
  response.writeHead(204).end();
});

await new Promise((resolve) => receiver.listen(0, "127.0.0.1", resolve));
after(() => {
  receiver.closeAllConnections();
  receiver.close();
});

const statusOf = async (key) => (await fetch(`${service.address}/v1/jobs`, { headers: { Authorization: `Bearer ${key}` } })).status;

test("operations of the API are searched, shown and sent", async () => {
  await go("/api");
  const document = await service.json("/openapi.json");
  const count = Object.values(document.paths).reduce((sum, methods) => sum + Object.keys(methods).length, 0);
  await page.getByText(`${count} operations`).waitFor();
  assert.equal(await page.locator("details.source").count(), count);
  await page.getByRole("searchbox").fill("post keys");
  await page.getByText("1 operation", { exact: true }).waitFor();
  await page.getByRole("searchbox").fill("get a scenario, its floor plan");
  await page.getByText("1 operation", { exact: true }).waitFor();
  await page.locator("details.source summary").focus();
  await page.keyboard.press("Enter");
  const send = page.getByRole("button", { name: "Send" });
  await send.waitFor();
  assert.ok(await send.isDisabled());
  await page.getByRole("textbox", { name: /^path/ }).fill("city_square/emergency");
  await page.getByText(`'${service.address}/v1/scenarios/city_square/emergency'`).waitFor();
  await send.click();
  await page.getByText("200: application/json").waitFor();
  assert.equal(JSON.parse(await page.getByLabel("answer", { exact: true }).innerText()).id, "city_square/emergency");
  await check(page, "API");
  await page.reload();
  await page.getByRole("textbox", { name: /^path/ }).waitFor();
});

test("the API answers in the page as it does outside of it", async () => {
  await page.getByRole("textbox", { name: /^path/ }).fill("no/such/place");
  await page.getByRole("button", { name: "Send" }).click();
  await page.getByText(/^404: /).waitFor();
});

test("without keys the page says how the first one is made", async () => {
  await go("/keys");
  await page.getByText("throng keys create NAME --scope admin").waitFor();
  await check(page, "no keys");
});

test("a webhook is added, pinged, taken out of use and deleted", async () => {
  await page.getByRole("tab", { name: "Webhooks" }).click();
  const address = page.getByLabel("Address");
  await address.fill("http://user@example.org/");
  await page.getByRole("button", { name: "Add the webhook" }).click();
  await page.getByRole("alert").getByText("expected an address such as https://example.org/hook").waitFor();
  await address.fill(`http://127.0.0.1:${receiver.address().port}/hook`);
  await page.getByLabel("submitted").check();
  await page.getByRole("button", { name: "Add the webhook" }).click();
  await page.getByText("which cannot be shown again").waitFor();
  await page.getByRole("button", { name: "Ping" }).click();
  await page.getByText(/delivered \(204/).waitFor();
  assert.equal(received.at(-1)["throng-event"], "ping");
  await check(page, "webhooks");
  const { webhooks } = await service.json("/v1/webhooks");
  assert.deepEqual(webhooks[0].events, ["succeeded", "partial", "failed", "cancelled", "submitted"]);
  await page.getByRole("button", { name: "Take out of use" }).click();
  await page.getByText("out of use", { exact: true }).waitFor();
  await page.getByRole("button", { name: "Delete" }).click();
  await page.getByRole("dialog").getByRole("button", { name: "Delete the webhook" }).click();
  await page.getByText("No webhooks yet").waitFor();
});

test("an administrator makes keys and revokes them", async () => {
  const admin = service.createKey("admin");
  await go("/keys");
  await page.getByRole("heading", { name: "Key needed" }).or(page.getByText("Sign in with a key")).first().waitFor();
  await page.evaluate(
    (key) => fetch("/v1/session", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ key }) }),
    admin,
  );
  await page.reload();
  await page.getByLabel("Name of its owner").fill("camera team");
  await page.getByLabel("Scope").selectOption("read");
  await page.getByLabel("Jobs at once").fill("many");
  await page.getByRole("button", { name: "Make the key" }).click();
  await page.getByRole("alert").getByText("/max_jobs").waitFor();
  await page.getByLabel("Jobs at once").fill("3");
  await page.getByLabel("Expires").fill("yesterday");
  await page.getByRole("button", { name: "Make the key" }).click();
  await page.getByRole("alert").getByText("/expires_at").waitFor();
  await page.getByLabel("Expires").fill("2100-02-03");
  await page.getByRole("button", { name: "Make the key" }).click();
  const made = page.getByLabel("key of camera team", { exact: true });
  await made.waitFor();
  const key = (await made.innerText()).trim();
  assert.equal(await statusOf(key), 200);
  await check(page, "keys");
  const { keys } = await service.json("/v1/keys", { headers: { Authorization: `Bearer ${admin}` } });
  assert.deepEqual(
    keys.map(({ name, scope, max_jobs, expires_at }) => [name, scope, max_jobs, expires_at]),
    [
      ["test", "admin", null, null],
      ["camera team", "read", 3, "2100-02-03T00:00:00.000Z"],
    ],
  );
  await page.reload();
  await page.getByRole("button", { name: "Revoke camera team" }).click();
  assert.ok(!(await page.content()).includes(key), "a key is shown once");
  await page.getByRole("dialog").getByRole("button", { name: "Revoke the key" }).click();
  await page.getByText(/^revoked /).waitFor();
  assert.equal(await statusOf(key), 401);
  await page.getByRole("button", { name: "Revoke test" }).click();
  await page.getByRole("dialog").getByRole("button", { name: "Revoke the key" }).click();
  await page.getByRole("alert").getByText("revoke it with another one").waitFor();
});

test("others are told that they may not", async () => {
  const key = service.createKey("submit");
  await page.evaluate(
    (value) =>
      fetch("/v1/session", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ key: value }) }),
    key,
  );
  await page.reload();
  await page.getByText("Keys and webhooks are for administrators").waitFor();
  assert.equal(await page.getByRole("tab").count(), 0);
});

test("nothing was on the console", () => assert.deepEqual(complaints, []));
