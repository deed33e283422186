/** Tests of the panels: enlarged, in a presentation, two points compared, basins over the phase, the sketch, the preview. */

import assert from "node:assert/strict";
import { WIDE, drawn, enter, hash, onScreen, pictures, place, tasks, until, verdict } from "./page.mjs";

const S = "#point=1&inverse_beta=1.3&gap=0.75";
const head = (page, name) => page.locator(`[data-name=${name}] .head`).first();
const enlarge = (page, name) => head(page, name).getByRole("button", { name: /^Enlarge/ }).click();

export async function panels_enlarge_zoom_and_return({ open, folder }) {
  const { page } = await open(S, WIDE);
  await until("the panels are drawn", async () => (await pictures(page)) >= 4);
  const names = ["motion", "basin", "attractors", "portrait", "quantities", "multipliers", "sections"];
  const shown = () => page.$$eval("#point > .panel:not([hidden])", (panels) => panels.map((panel) => panel.dataset.name));
  await until("all panels are there", async () => (await shown()).length >= names.length);
  assert.deepEqual(await shown(), names);
  for (const name of names) {
    await enlarge(page, name);
    const box = await page.locator("#large").boundingBox();
    assert.ok(box.width > 1200 && box.height > 740, `${name}: ${box.width} by ${box.height}`);
    assert.equal(await page.locator("#point > .panel:not([hidden])").count(), names.length - 1, "the others stay");
    if (name === "motion") await page.screenshot({ path: `${folder}/enlarged.png` });
    await page.keyboard.press("Escape");
    await until("the panel is small again", async () => page.locator("#large").isHidden());
    await until(`${name} is in its place`, async () => (await shown()).join() === names.join());
    const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? "");
    await until("the focus is back", async () => /^Enlarge/.test(await focused()));
  }
  // the figures of the server are drawn in the new size
  const widthIn = (where) => page.locator(`${where} .sheet img`).evaluate((image) => image.naturalWidth);
  const narrow = await widthIn("#point [data-name=multipliers]");
  await enlarge(page, "multipliers");
  const width = () => widthIn("#large");
  await until("a larger picture", async () => (await width()) > 1.5 * narrow);
  await page.locator("#large .zoom").nth(1).click();
  const part = await page.locator("#large .sheet").evaluate((sheet) => sheet.scrollWidth / sheet.clientWidth);
  assert.ok(Math.abs(part - 2) < 0.05, `twice as wide: ${part}`);
  await page.keyboard.press("Escape");
  // the waveform zooms along the time, about the cursor
  const ticksIn = async (where) => (await page.$$eval(`${where} .plot .number`, (texts) => texts.map((text) => text.textContent))).join();
  const small = await ticksIn("#point [data-name=motion]");
  await enlarge(page, "motion");
  const ticks = () => ticksIn("#large");
  await until("it is drawn in the new size", async () => ![small, ""].includes(await ticks()));
  const whole = await ticks();
  await page.locator("#large .zoom").nth(1).click();
  assert.notEqual(await ticks(), whole);
  await page.locator("#large .zoom").nth(0).click();
  assert.equal(await ticks(), whole);
}

export async function a_presentation_shows_the_map_and_one_panel({ open, folder }) {
  const { page } = await open(S, WIDE);
  await until("the verdict", async () => (await page.locator(".verdict .label").count()) === 1);
  const em = () => page.evaluate(() => parseFloat(getComputedStyle(document.documentElement).fontSize));
  const before = await em();
  await page.keyboard.press("f");
  assert.ok((await em()) > 1.3 * before, "large type");
  for (const hidden of [".masthead", "#legend h2", "#starts-note", "#controls", "[data-name=basin]", ".tabs"]) {
    assert.ok(await page.locator(hidden).isHidden(), hidden);
  }
  for (const [width, height] of [[1280, 720], [1920, 1080]]) {
    await page.setViewportSize({ width, height });
    for (const name of ["motion", "basin", "portrait"]) {
      await page.locator("#subject").selectOption(name);
      const shown = `[data-name=${name}]`;
      await until(`${name} is shown`, async () => page.locator(shown).isVisible());
      await until(`${name} fits`, async () => (await onScreen(page, `${shown} .graph, ${shown} .view`)) && onScreen(page, "#plane"));
    }
    // what the colours are, below the map
    assert.ok(await onScreen(page, "#legend .legend-item"));
    await page.screenshot({ path: `${folder}/presentation-${height}.png` });
  }
  await page.evaluate(() => { location.hash += "&colour=impact_speed_max&impacts=200"; });
  await page.waitForSelector("#legend .bar-colours[data-range]");
  assert.ok((await onScreen(page, "#legend .bar-colours")) && (await onScreen(page, "#plane")));
  await page.goBack();
  await page.reload();
  await until("a link keeps it", async () => page.locator("#subject").isVisible());
  assert.ok(await page.locator("[data-name=portrait]").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(await page.locator(".masthead").isVisible());
  assert.ok(await page.locator("[data-name=basin]").isVisible());
}

export async function two_points_are_compared({ open, folder }) {
  const { page } = await open(S);
  await until("the verdict is 2/1", async () => (await verdict(page)) === "2/1");
  await page.locator(".pin").click();
  await enter(page.locator("#point .fields input").nth(0), "1.8");
  await enter(page.locator("#point .fields input").nth(1), "0.25");
  const labels = () => page.locator(".side .verdict .label").allTextContents();
  await until("both verdicts", async () => (await labels()).join() === "2/1,4/1");
  await until("waveforms and portraits of both", async () => (await page.locator(".side .motion").count()) === 4);
  assert.deepEqual(await page.locator(".side .values").allTextContents(), ["1/β 1.3, δ 0.75", "1/β 1.8, δ 0.25"]);
  await page.screenshot({ path: `${folder}/compared.png` });
  await page.reload();
  await until("a link keeps the pin", async () => (await labels()).join() === "2/1,4/1");
  await page.getByRole("button", { name: "Exchange" }).click();
  await until("exchanged", async () => (await labels()).join() === "4/1,2/1");
  assert.deepEqual([(await hash(page)).get("inverse_beta"), (await hash(page)).get("gap")], [null, null], "S again, the default");
  await page.getByRole("button", { name: "Remove the pin" }).click();
  assert.ok(await page.locator("[data-name=compare]").isHidden());
}

export async function basins_follow_the_phase({ open }) {
  const { page } = await open(S);
  await until("the verdict", async () => (await page.locator(".verdict .label").count()) === 1);
  const asked = tasks(page, "/api/tile", "basin");
  const slider = page.locator("#phase");
  await slider.focus();
  await page.keyboard.press("End");
  await page.keyboard.press("Home");
  for (let k = 0; k < 3; k++) await page.keyboard.press("PageUp");
  await until("the phase is in the address", async () => {
    // a busy browser may write the address between two keys
    const start = (await hash(page)).get("start")?.split(",").map(Number);
    const shown = await page.locator(".phase output").textContent();
    return start && start[0] === 0 && start[1] === 0 && start[2] > 0.1 && shown === `${(start[2] / Math.PI).toFixed(2)} π`;
  });
  const phase = Number((await hash(page)).get("start").split(",")[2]);
  assert.equal(await page.locator(".phase output").textContent(), `${(phase / Math.PI).toFixed(2)} π`);
  assert.equal(Number(await page.getByLabel("phase of the force", { exact: true }).inputValue()), phase);
  await until("the basin of this phase", () => asked.some(({ start }) => Math.abs(start.phase - phase) < 1e-9));
  // neighbouring tiles join: thin arms are not missed in one of them
  assert.ok(asked.filter(({ refine }) => refine).every(({ refine }) => refine <= 2));
  await page.getByRole("button", { name: "Reset start" }).click();
  await until("the start is reset", async () => (await hash(page)).get("start") === null);
}

export async function the_sketch_explains_every_symbol({ open, folder }) {
  const { page } = await open("#second=1&second_gap=1.5&gap=0.4&damping=0.03");
  assert.ok(await page.locator("#hint-sketch svg").isVisible(), "beside the map while no point is chosen");
  await page.keyboard.press("s");
  const rows = await page.$$eval("#symbols-body dt", (terms) => terms.map((term) => [term.textContent, term.nextElementSibling.textContent]));
  assert.deepEqual(rows.map(([symbol]) => symbol), ["ξ", "ξ′", "τ", "β", "φ", "δ", "ε", "ζ", "δ₂", "ε₂", "m/n"]);
  const value = new Map(rows);
  assert.ok(value.get("δ").endsWith(" 0.4") && value.get("ζ").endsWith(" 0.03") && value.get("δ₂").endsWith(" 1.5"), rows.join("; "));
  const drawing = await page.locator("#symbols-body svg").textContent();
  for (const symbol of ["ξ", "ξ′", "τ", "β", "φ", "δ", "ε", "ζ", "δ₂", "ε₂", "mass", "spring", "damper", "stop"]) {
    assert.ok(drawing.includes(symbol), `${symbol} in the drawing`);
  }
  await page.screenshot({ path: `${folder}/symbols.png` });
  await page.keyboard.press("Escape");
  await page.locator("#second").click();
  assert.ok(!(await page.locator("#hint-sketch svg").textContent()).includes("δ₂"));
}

export async function the_waveform_at_the_pointer_is_previewed({ open }) {
  const { page } = await open();
  await drawn(page);
  let asked = 0;
  page.on("request", (request) => {
    if (request.url().includes("/api/motion")) {
      asked++;
      assert.ok(request.postDataJSON().task.settle.impacts <= 200, "a small budget");
    }
  });
  for (const [x, y] of [[0.9, 2], [1.8, 0.3]]) {
    const at = await place(page, x, y);
    await page.mouse.move(...at);
    await page.locator("#preview:not([hidden])").waitFor();
    const box = await page.locator("#preview").boundingBox();
    const inside = at[0] > box.x - 10 && at[0] < box.x + box.width + 10 && at[1] > box.y - 10 && at[1] < box.y + box.height + 10;
    assert.ok(!inside, "it does not cover the pointer");
    assert.match(await page.locator("#preview .motion").getAttribute("d"), /^M0/);
  }
  const before = asked;
  const [x, y] = await place(page, 0.6, 4);
  for (let k = 0; k < 30; k++) await page.mouse.move(x + 9 * k, y);
  assert.ok(await page.locator("#preview").isHidden(), "it is hidden while the pointer moves");
  await page.locator("#preview:not([hidden])").waitFor();
  assert.equal(asked, before + 1, "only where the pointer rests");
  await page.mouse.move(5, 5);
  assert.ok(await page.locator("#preview").isHidden());
}

/** The body of docs/units.md: 0.8 kg, 12 N/mm, 30 N, 2 %, 1.5 mm, at 15.5 Hz, in the units of the command. */
export async function results_are_in_si_units_of_a_machine({ open }) {
  const natural = Math.sqrt(12000 / 0.8) / (2 * Math.PI);
  const { page } = await open(`#point=1&beta=${15.5 / natural}&gap=0.6&restitution=0.65&damping=0.02&wave=settled&periods=3`);
  await until("the motion is drawn", async () => (await page.locator("[data-name=motion] .motion").count()) === 1);
  const axes = () => page.$$eval("[data-name=motion] .plot .name, [data-name=portrait] .plot .name", (names) => names.map((name) => name.textContent));
  assert.deepEqual(await axes(), ["time τ", "ξ", "ξ", "velocity ξ′"]);
  await page.locator("#machine").click();
  await until("axes in seconds and millimetres", async () => (await axes()).join() === "time t (s),ξ (mm),ξ (mm),velocity ξ′ (m/s)");
  assert.match(await page.locator("#point > .note").textContent(), /^Force at 15\.5 Hz, gap 1\.5 mm, natural frequency 19\.49 Hz, F\/k 2\.5 mm\.$/);
  // in one step, because the list is written again while it is read
  const quantity = (name) => page.evaluate((wanted) => [...document.querySelectorAll(".quantities dt")]
    .find((term) => term.textContent === wanted)?.nextElementSibling.textContent ?? "", name);
  // the row of 2/1 of `vibro attractors ... --units si` on that page
  await until("quantities in SI units", async () => /^0\.6763 m\/s$/.test(await quantity("largest impact speed")));
  await enter(page.locator("#machine-force"), "60");
  await until("another force, another unit of length", async () =>
    /gap 3 mm/.test(await page.locator("#point > .note").textContent()) && /^1\.353 m\/s$/.test(await quantity("largest impact speed")));
  assert.equal((await hash(page)).get("machine"), "0.8,12000,60");
  await enter(page.locator("#machine-force"), "0");
  assert.match(await page.locator("#machine-units").textContent(), /force must be above 0 N/);
  await page.locator("#machine").click();
  await until("nondimensional again", async () => (await axes())[0] === "time τ");
}
