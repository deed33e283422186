/** Tests of the chosen point, its starts, and the line. */

import assert from "node:assert/strict";
import { drag, drawn, hash, pictures, place, tasks, until, verdict } from "./page.mjs";

const S = "#point=1&inverse_beta=1.3&gap=0.75";

export async function click_shows_the_verdict({ open }) {
  const { page } = await open();
  await drawn(page);
  await page.mouse.click(...await place(page, 1.3, 0.75));
  await until("the verdict is 2/1", async () => (await verdict(page)) === "2/1");
  const state = await hash(page);
  assert.deepEqual([state.get("point"), state.get("panel")], ["1", null]);
  assert.equal(await page.locator("#point input").nth(0).inputValue(), "1.3", "a click near S means S");
  await until("two motions coexist", async () => (await page.locator(".bars li").count()) === 2);
  const shares = await page.locator(".bars .share").allTextContents();
  assert.ok(Math.abs(parseFloat(shares[0]) + parseFloat(shares[1]) - 100) < 0.2, shares.join());
  await until("the waveform, the portrait, the multipliers and the section are there", async () => (await pictures(page)) >= 4);
  assert.match(await page.locator("#live").textContent(), /2\/1|impacts/);
}

export async function chaos_has_exponents({ open }) {
  const { page } = await open("#point=1&inverse_beta=1.11&gap=3");
  await until("the verdict is chaotic", async () => (await verdict(page)) === "chaotic");
  await until("both exponents are told", async () =>
    /exponents per unit of time .* and −/.test(await page.locator("#point").textContent()), 90);
}

export async function a_start_is_dragged({ open }) {
  const { page } = await open(S);
  await until("the verdict is 2/1", async () => (await verdict(page)) === "2/1");
  await page.locator("#basin").scrollIntoViewIfNeeded();
  const at = (x, v) => place(page, x, v, [-8, 1.15, -8, 8], "#basin");
  const settled = tasks(page, "/api/answer", "settle");
  await page.mouse.move(...await at(0, 0));
  await page.mouse.down();
  await page.mouse.move(...await at(-2, -2), { steps: 12 });
  await until("it is simulated while it is dragged", () => settled.length > 0);
  await page.mouse.up();
  await until("the start is in the address", async () => (await hash(page)).has("start"));
  const [x, v] = (await hash(page)).get("start").split(",").map(Number);
  assert.ok(Math.abs(x + 2) < 0.15 && Math.abs(v + 2) < 0.2, `the start is ${x}, ${v}`);
  await until("from there it is 1/1", async () => (await verdict(page)) === "1/1");
}

export async function back_and_forward({ open }) {
  const { page } = await open();
  await drawn(page);
  await page.mouse.click(...await place(page, 1.3, 0.75));
  await until("2/1", async () => (await verdict(page)) === "2/1");
  await page.mouse.click(...await place(page, 1.8, 0.25));
  await until("4/1", async () => (await verdict(page)) === "4/1");
  await page.goBack();
  await until("2/1 again", async () => (await verdict(page)) === "2/1");
  await page.goBack();
  await until("no point", async () => page.locator("#point").isHidden());
  await page.goForward();
  await page.goForward();
  await until("4/1 again", async () => (await verdict(page)) === "4/1");
}

export async function a_line_gives_a_bifurcation_diagram({ open, folder }) {
  const { page } = await open();
  await drawn(page);
  const draw = async (from, to) => {
    await page.locator("#line-tool").click();
    await drag(page, await place(page, ...from), await place(page, ...to));
    return (await hash(page)).get("line").split(",").map(Number);
  };
  const near = (line, wanted) => line.every((value, k) => Math.abs(value - wanted[k]) < 0.02);
  const upright = await draw([1.11, 1.5], [1.112, 2.5]);
  assert.ok(near(upright, [1.11, 1.5, 1.11, 2.5]) && upright[0] === upright[2], `it is upright: ${upright}`);
  const image = page.locator("#line .sheet img");
  await image.waitFor({ timeout: 120000 });
  assert.match(await image.getAttribute("alt"), /Bifurcation diagram: δ from .* 1\/β = 1\.11/);
  await page.screenshot({ path: `${folder}/line.png` });
  // an oblique direction, then the first one again
  const oblique = await draw([1.3, 2.5], [1, 1]);
  assert.ok(near(oblique, [1.3, 2.5, 1, 1]), `as it was drawn: ${oblique}`);
  await until("the diagram of the oblique line", async () =>
    /δ from 1.* 1\/β from (0\.9|1)/.test(await image.getAttribute("alt")), 120);
  await page.screenshot({ path: `${folder}/oblique.png` });
  await page.goBack();
  await until("the first line again", async () => (await hash(page)).get("line") === upright.join());
}

export async function with_the_keyboard_alone({ open }) {
  const { page } = await open();
  await drawn(page);
  await page.keyboard.press("p");
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute("role")), "application");
  for (let k = 0; k < 3; k++) await page.keyboard.press("ArrowRight");
  await page.keyboard.press("+");
  await page.waitForTimeout(400);
  await page.keyboard.press("Enter");
  await until("a verdict", async () => (await page.locator(".verdict .label").count()) === 1);
  await until("it is heard", async () => (await page.locator("#live").textContent()).length > 10);
  await page.keyboard.press("?");
  assert.ok(await page.locator("#keys").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#keys").isHidden());
  await page.keyboard.press("l");
  await page.keyboard.press("Enter");
  for (let k = 0; k < 4; k++) await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await until("a line was drawn", async () => (await hash(page)).has("line"));
  // every control can be reached with Tab and shows its focus
  const reached = new Set();
  await page.evaluate(() => document.body.focus());
  for (let k = 0; k < 130; k++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  for (const id of ["tour-button", "export-button", "theme-button", "keys-button", "axis-x", "zoom-in", "line-tool", "starts", "impacts", "show"]) {
    assert.ok(reached.has(id), `Tab reaches ${id}: ${[...reached]}`);
  }
}

export async function f10_positions_on_a_line_are_positions({ open, folder }) {
  const { page } = await open("#line=1.3,0.7,1.3,1.2&panel=line");
  const image = page.locator("#line .sheet img");
  // the policy of the page forbids it to fetch its own images, so the answers are intercepted
  const answers = [];
  page.on("response", (response) => {
    if (response.url().includes("/api/bifurcation")) response.text().then((text) => answers.push(text)).catch(() => {});
  });
  await page.reload();
  await image.waitFor({ timeout: 120000 });
  await until("velocities", async () => (answers.at(-1) ?? "").includes("arrival velocity"), 120);
  await page.locator("#show").selectOption("strobe");
  await until("positions", async () => answers.at(-1).includes("at phase 0"), 120);
  assert.ok(!answers.at(-1).includes("arrival velocity"));
  await page.screenshot({ path: `${folder}/line-strobe.png` });
}

/** 42.13: which tile came first decided which of two cycles was "(2nd)", and had the second colour. */
export async function names_of_cycles_do_not_depend_on_the_order_of_tiles({ open }) {
  const { page } = await open(S);
  const looks = await page.evaluate(async () => {
    const { Cycles } = await import(new URL("/assets/cycles.js", document.baseURI).href);
    const colour = "#336699";
    const found = [
      { label: "2/1", phase: 1.2, velocity: 2, colour }, { label: "2/1", phase: 0.7, velocity: 1.5, colour },
      { label: "2/1", phase: 0.7034, velocity: 1.1, colour }, { label: "1/1", phase: 0, velocity: 1, colour },
    ];
    return [[0, 1, 2, 3], [3, 2, 1, 0], [1, 3, 0, 2]].map((order) => {
      const cycles = new Cycles();
      // another tile has the same cycles but for rounding
      for (const k of order) cycles.number({ ...found[k], phase: found[k].phase * (1 + 1e-13) });
      return found.map((cycle) => cycles.look(cycles.number(cycle)));
    });
  });
  const [first] = looks;
  for (const other of looks) assert.deepEqual(other, first);
  assert.deepEqual(first.map(({ remark }) => remark), ["phase 1.20", "phase 0.700", "phase 0.703", ""]);
  assert.equal(new Set(first.map(({ name, colour }) => `${name} ${colour}`)).size, 4);
}
