/** Tests of fields, ranges, undo and links. */

import assert from "node:assert/strict";
import { WIDE, drag, drawn, enter, hash, place, until } from "./page.mjs";

export async function a_decimal_comma_is_a_point_and_nonsense_is_refused({ open }) {
  const { page } = await open("#impacts=200");
  await drawn(page);
  const field = page.locator("#field-damping");
  const type = async (text) => {
    await field.focus();
    await page.keyboard.press("Control+A");
    await page.keyboard.type(text);
    await page.keyboard.press("Enter");
  };
  await type("0,05");
  assert.equal((await hash(page)).get("damping"), "0.05");
  assert.equal(await field.inputValue(), "0.05");
  for (const [text, sentence] of [["-0.1", /ζ = -0\.1 is not possible: 0 ≤ ζ\./], ["1,000.5", /"1,000\.5" is not a number/], ["", /A number is missing/]]) {
    await (text ? type(text) : enter(field, ""));
    assert.match(await page.locator(".parameter", { has: field }).locator(".why").textContent(), sentence);
    assert.equal((await hash(page)).get("damping"), "0.05", text);
  }
  await page.keyboard.press("Escape");
  assert.equal(await field.inputValue(), "0.05");
  const { page: other } = await open("#point=1&inverse_beta=1.3&gap=0.75&impacts=200");
  await enter(other.locator("#point input[aria-label='inverse frequency']"), "1,25");
  await until("the point is moved", async () => (await hash(other)).get("inverse_beta") === "1.25");
  // a slider takes no letters, so keys of the page work
  await page.locator("#parameters .parameter:not([hidden]) input[type=range]").first().focus();
  await page.keyboard.press("d");
  assert.match(await page.evaluate(() => location.hash), /theme=dark/);
}

export async function a_link_with_impossible_values_says_so({ open }) {
  const { page } = await open("#restitution=1.5&starts=200&nothing=1&gap=2");
  const strip = page.locator("#strip");
  await until("it is said", async () => (await strip.textContent()).includes("The link has parts that are not possible."));
  const text = await strip.textContent();
  for (const part of ["ε = 1.5 is not possible: 0 ≤ ε ≤ 1.", "starts = 200 has no meaning.", "There is no nothing."]) assert.ok(text.includes(part), text);
  await strip.locator("button", { hasText: "Close" }).click();
  await drawn(page);
  assert.equal(await page.locator("#field-restitution").inputValue(), "0.5");
}

export async function ranges_are_typed_boxes_dragged_and_both_undone({ open }) {
  const { page, context } = await open("#impacts=200", WIDE);
  await drawn(page);
  const range = (k) => page.locator(`#range-${k}`);
  assert.deepEqual(await Promise.all([0, 1, 2, 3].map((k) => range(k).inputValue())), ["0.375", "2.025", "0", "5"]);
  await enter(range(1), "1.5");
  const view = async () => (await hash(page)).get("view")?.split(",").map(Number);
  await until("the axis ends there", async () => (await view())?.[1] === 1.5);
  assert.equal((await view())[0], 0.375);
  await enter(range(0), "1.6");
  assert.equal(await range(0).getAttribute("aria-invalid"), "true");
  await page.keyboard.press("Escape");
  const window = await view();
  await page.locator("#box-tool").click();
  await drag(page, await place(page, 1, 2, window), await place(page, 1.25, 3, window));
  const near = (found, wanted) => found?.every((value, k) => Math.abs(value - wanted[k]) < 0.02);
  await until("the box fills the view", async () => near(await view(), [1, 1.25, 2, 3]));
  assert.equal(await page.locator("#box-tool").getAttribute("aria-pressed"), "false");
  await until("the title names the view", async () => /^1\/β [\d.]+ to 1\.2[45]\d*, δ (1\.9|2)/.test(await page.title()));
  await page.locator("#undo").click();
  await until("the typed range again", async () => near(await view(), window));
  await page.locator("#undo").click();
  await until("the first view again", async () => (await view()) === undefined);
  assert.ok(await page.locator("#undo").isDisabled());
  await page.locator("#redo").click();
  await until("redone", async () => near(await view(), window));
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.locator("#link-button").click();
  await until("the link is copied", async () => (await page.evaluate(() => navigator.clipboard.readText())) === page.url());
}

export async function coordinates_are_copied_with_all_digits({ open }) {
  const { page, context } = await open("#impacts=200");
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await drawn(page);
  await page.mouse.move(...await place(page, 1.2345, 1.5));
  await page.keyboard.press("c");
  const copied = () => page.evaluate(() => navigator.clipboard.readText());
  await until("the coordinates at the pointer", async () => /^1\/β = 1\.23\d{5,}, δ = 1\.\d{5,}$|^1\/β = 1\.23\d{5,}, δ = 1\.\d+$/.test(await copied()));
  const { page: other, context: its } = await open("#point=1&inverse_beta=1.2345678901&gap=0.75&impacts=200");
  await its.grantPermissions(["clipboard-read", "clipboard-write"]);
  await until("the chosen point has all its digits", async () => (await other.locator("#readout").textContent()).includes("1/β = 1.2345678901   δ = 0.75"));
  await other.locator("#copy-point").click();
  await until("the chosen point", async () => (await other.evaluate(() => navigator.clipboard.readText())) === "1/β = 1.2345678901, δ = 0.75");
}
