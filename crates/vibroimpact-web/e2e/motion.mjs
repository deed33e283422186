/** Tests of the panel of the motion: the animation, the waveform, the portrait. */

import assert from "node:assert/strict";
import { answer, hash, table, until } from "./page.mjs";

const S = "#point=1&inverse_beta=1.3&gap=0.75";
const SYSTEM = { inverse_beta: 1.3, gap: 0.75, restitution: 0.5, damping: 0 };

const moved = (page) => until("the motion is drawn", async () => (await page.locator("[data-name=motion] .motion").count()) === 1);
const slider = (page) => page.locator(".player .time");
const time = async (page) => Number(await slider(page).inputValue());
const next = (page) => page.locator(".player button", { hasText: "Next impact" }).click();

/** What the line below the animation says of a quantity. */
const told = async (page, name) => {
  const text = (await page.locator(".player .now").textContent()).replaceAll("−", "-");
  return Number(new RegExp(`${name} (-?[\\d.]+)`).exec(text)[1]);
};

/** Two frames of the browser. */
const frames = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

export async function the_animation_steps_through_the_impacts_of_the_command({ address, open }) {
  const { page } = await open(S);
  await moved(page);
  const { events } = await answer(address, { simulate: { start: {}, impacts: null, periods: 10 } }, SYSTEM);
  const impacts = events.filter(({ kind }) => kind === "impact");
  const stop = () => page.locator(".machine .ground").nth(1).evaluate((ground) => Number(/V?M[-\d.]+ ([\d.]+)/.exec(ground.getAttribute("d"))[1]));
  const face = () => page.locator(".machine .mass").evaluate((mass) => Number(mass.getAttribute("y")));
  assert.ok((await face()) > (await stop()) + 5, "the mass begins below the stop");
  for (const { time: wanted } of impacts.slice(0, 5)) {
    await next(page);
    assert.ok(Math.abs((await time(page)) - wanted) < 1e-9, `an impact at ${wanted}, shown at ${await time(page)}`);
    assert.equal(await told(page, "ξ"), 0.75);
    assert.ok(Math.abs((await face()) - (await stop())) < 0.01, "the mass is at the stop");
  }
}

export async function positions_are_those_of_the_table({ address, open }) {
  const { page } = await open(S);
  await moved(page);
  const rows = (await table(address, { simulate: { start: {}, impacts: null, periods: 10 } }, SYSTEM)).map((row) => row.map(Number));
  for (const [at, x, v] of [rows[7], rows[233], rows[611]]) {
    await slider(page).evaluate((input, value) => {
      input.value = value;
      input.dispatchEvent(new Event("input"));
    }, String(at));
    assert.ok(Math.abs((await told(page, "ξ")) - x) < 6e-4 && Math.abs((await told(page, "ξ′")) - v) < 6e-4, `${at}: ${x}, ${v}`);
    assert.ok(Math.abs((await told(page, "force")) - Math.sin(at / 1.3)) < 6e-3, "the force at this time");
  }
}

export async function it_plays_and_pauses({ open }) {
  const { page } = await open(S);
  await moved(page);
  await frames(page);
  assert.equal(await time(page), 0, "it does not start by itself");
  await page.locator(".player .play").click();
  await until("the time advances", async () => (await time(page)) > 0);
  await page.locator(".player .play", { hasText: "Pause" }).click();
  const at = await time(page);
  await frames(page);
  assert.equal(await time(page), at);
  assert.equal(await page.locator(".player .play").textContent(), "Play");
}

export async function with_reduced_motion_it_can_be_stepped({ open }) {
  const { page } = await open(S, { reducedMotion: "reduce" });
  await moved(page);
  await frames(page);
  assert.deepEqual([await time(page), await page.locator(".player .play").textContent()], [0, "Play"]);
  await page.keyboard.press("n");
  assert.ok((await time(page)) > 0);
  const at = await time(page);
  await frames(page);
  assert.equal(await time(page), at, "a step is no animation");
}

export async function periods_and_part_are_chosen({ open }) {
  const { page } = await open(`${S}&start=0.2,-1,0`);
  await moved(page);
  const period = 2 * Math.PI * 1.3;
  const end = async () => Number(await slider(page).getAttribute("max"));
  assert.ok(Math.abs((await end()) - 10 * period) < 1e-9);
  const before = await page.locator("[data-name=motion] .motion").getAttribute("d");
  await page.locator("#periods").selectOption("3");
  await until("three periods", async () => Math.abs((await end()) - 3 * period) < 1e-9);
  await page.locator("#wave").selectOption("settled");
  await until("another part of the motion", async () => (await hash(page)).get("wave") === "settled"
    && (await page.locator("[data-name=motion] .motion").getAttribute("d")) !== before);
  await until("two impacts in each of three periods", async () => [6, 7].includes(await page.locator("[data-name=motion] .impact").count()));
  const portrait = page.locator("[data-name=portrait] .motion");
  const steady = await portrait.getAttribute("d");
  await page.locator("#portrait").selectOption("start");
  await until("the portrait from the start", async () => (await portrait.getAttribute("d")) !== steady);
  // the cursor is in both pictures where they show the same motion
  await page.locator("#wave").selectOption("start");
  await until("the same motion", async () => (await hash(page)).get("wave") === null);
  await until("the cursor in the portrait", async () => {
    await next(page);
    return (await page.locator("[data-name=portrait] .cursor-dot").count()) === 1;
  });
}

export async function the_export_has_the_periods_that_are_shown({ open }) {
  const { page } = await open(`${S}&periods=3`);
  await moved(page);
  await page.locator("[data-name=motion] button", { hasText: "Export" }).click();
  await until("the command", async () => /^vibro simulate .*--periods 3\b/.test(await page.locator("#export pre").first().textContent()));
}
