/** Tests of the page in the units of a machine. */

import assert from "node:assert/strict";
import { drawn, enter, hash, place, sharp, until } from "./page.mjs";

/** The body of docs/units.md. */
const MACHINE = "machine=0.8,12000,30";
const NATURAL = Math.sqrt(12000 / 0.8) / (2 * Math.PI);
/** One unit of length, F/k, in mm. */
const LENGTH = 2.5;

/** With a machine everything on the page that is a coordinate is in its units. */
export async function a_machine_has_axes_in_its_units({ open }) {
  const { page } = await open("#impacts=200&view=1,1.5,0.4,1.4&point=1&inverse_beta=1.25&gap=0.8");
  await drawn(page);
  await page.locator("#machine").click();
  const state = () => hash(page);
  await until("the abscissa is the frequency", async () => (await state()).get("x") === "beta");
  const view = async () => (await state()).get("view").split(",").map(Number);
  const [left, right] = await view();
  assert.ok(Math.abs(left - 1 / 1.5) < 1e-6 && Math.abs(right - 1) < 1e-6, `${left} ${right}`);
  const options = () => page.$$eval("#axis-x option", (all) => all.filter((one) => !one.disabled).map((one) => one.text));
  await until("the choices have units", async () => (await options()).includes("f frequency of the force, Hz") && (await options()).includes("δ gap, mm"));
  assert.ok(!(await options()).some((text) => text.startsWith("1/β")));
  // the ends of the axes
  const end = (k) => page.locator(`#range-${k}`).inputValue().then(Number);
  await until("the ends of the axes in Hz and mm", async () => Math.abs((await end(1)) - NATURAL) < 1e-3 && Math.abs((await end(2)) - 0.4 * LENGTH) < 1e-3);
  await enter(page.locator("#range-1"), "18");
  await until("the axis ends at 18 Hz", async () => Math.abs((await view())[1] * NATURAL - 18) < 1e-4);
  assert.equal(await page.locator("#range-1").inputValue(), "18");
  // the fields of the point, and what they refuse
  const field = page.locator("#point input[aria-label='frequency of the force']");
  assert.ok(Math.abs(Number(await field.inputValue()) - 0.8 * NATURAL) < 1e-9);
  await enter(field, "15");
  await until("the point is at 15 Hz", async () => Math.abs(Number((await state()).get("beta")) * NATURAL - 15) < 1e-9);
  assert.equal(await field.inputValue(), "15");
  await enter(field, "-3");
  assert.match(await page.locator("#point > .head .fields").textContent(), /f = -3 Hz is not possible: 0 Hz < f\./);
  await page.keyboard.press("Escape");
  // the readout, at the pointer and of the chosen point
  await page.mouse.move(...await place(page, 16 / NATURAL, 1, await view()));
  await until("the place in Hz and mm", async () => /f 1[56]\.\d+ Hz\s+δ 2\.\d+ mm/.test(await page.locator("#readout").textContent()));
  await page.mouse.move(5, 5);
  await until("the chosen point", async () => /f = 15 Hz\s+δ = 2 mm/.test(await page.locator("#readout").textContent()));
  assert.match(await page.title(), /f .* Hz, δ 1 to 3\.5 mm.*point f 15 Hz, δ 2 mm/);
  // the start
  await enter(page.locator("[data-name=basin] input[aria-label='initial position']"), "1.5");
  await until("the start is at 1.5 mm", async () => Number((await state()).get("start")?.split(",")[0]) * LENGTH === 1.5);
  // another parameter on no axis
  await page.locator("#axis-x").selectOption("restitution");
  const slider = page.locator(".parameter:not([hidden])", { hasText: "frequency of the force, Hz" }).locator("input[type=text]");
  await until("the field of the frequency", async () => (await slider.inputValue()) === "15");
  // the legend above grows with each tile, and the button would move away under a click
  await sharp(page);
  await page.locator("#machine").click();
  await until("nondimensional again", async () => (await page.locator("#range-3").inputValue()) === "5");
}

/** The diagram along a line and its events are in the units of the machine. */
export async function a_line_of_a_machine_is_in_its_units({ open }) {
  const beta = 1 / 1.11;
  const { page } = await open(`#${MACHINE}&impacts=200&x=beta&view=0.7,1.2,1,3.6&line=${beta},1.6,${beta},2.2&panel=line`);
  await drawn(page);
  const text = () => page.locator("#line .place").textContent();
  await until("the line in Hz and mm", async () => /δ from 4\.00\d* to 5\.50\d* mm, f = 17\.5\d+ Hz/.test(await text()));
  const events = () => page.locator("#line .events").textContent();
  // 1.829 nondimensional
  await until("the flip of 1/1 in mm", async () => /1\/1: flip \(period doubling\) at δ = 4\.57\d+ mm/.test(await events()));
  const [left, right] = [Number(await page.locator("#line .line-ends input").nth(1).inputValue()), Number(await page.locator("#line .line-ends input").nth(3).inputValue())];
  assert.deepEqual([left, right], [4, 5.5]);
  await page.locator("#line .events button", { hasText: "1/1: flip" }).first().click();
  await until("the event is chosen", async () => Math.abs(Number((await hash(page)).get("gap")) - 1.829) < 2e-3);
}

/** A link with a machine and the inverse of the frequency has the same part of the plane over the frequency. */
export async function a_link_with_a_machine_has_the_frequency({ open }) {
  const { page } = await open(`#${MACHINE}&impacts=200&view=1,1.25,0.4,1.4`);
  await sharp(page);
  assert.equal(await page.locator("#axis-x").inputValue(), "beta");
  await until("its ends in Hz", async () => Math.abs(Number(await page.locator("#range-0").inputValue()) - 0.8 * NATURAL) < 1e-3);
}
