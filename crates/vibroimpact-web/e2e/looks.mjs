/** Tests of the appearance: sizes, light and dark, and accessibility with axe-core. */

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFile } from "node:fs/promises";
import { drawn, pictures, until } from "./page.mjs";

const S = "#point=1&inverse_beta=1.3&gap=0.75";
const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Waits for the figures of the point. */
const figures = (page) => until("the figures are there", async () => (await pictures(page)) >= 4);

const SIZES = [
  ["360", { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true }],
  ["1000x700", { viewport: { width: 1000, height: 700 } }],
  ["1440x900-dark", { viewport: { width: 1440, height: 900 }, colorScheme: "dark" }],
  ["4k", { viewport: { width: 3840, height: 2160 } }],
  ["900x600-2x", { viewport: { width: 900, height: 600 }, deviceScaleFactor: 2 }],
];

export async function the_page_fits_in_every_size({ open, folder }) {
  for (const [name, options] of SIZES) {
    const { page } = await open(S, options);
    await drawn(page);
    await figures(page);
    await page.waitForTimeout(500);
    const { width } = options.viewport;
    const wide = await page.evaluate(() => [document.documentElement.scrollWidth, document.body.scrollWidth]);
    assert.ok(Math.max(...wide) <= width, `${name}: ${wide} pixels in ${width}`);
    await page.screenshot({ path: `${folder}/${name}.png` });
    if (name === "360") await page.screenshot({ path: `${folder}/360-whole.png`, fullPage: true });
  }
}

export async function touch_pans_pinches_and_taps({ open }) {
  const { page } = await open("", { viewport: { width: 400, height: 800 }, hasTouch: true, isMobile: true });
  await drawn(page);
  const box = await page.locator("#plane").boundingBox();
  const client = await page.context().newCDPSession(page);
  const touch = (type, points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await touch("touchStart", [[x - 30, y], [x + 30, y]]);
  for (let k = 1; k <= 6; k++) await touch("touchMove", [[x - 30 - 10 * k, y], [x + 30 + 10 * k, y]]);
  await touch("touchEnd", []);
  const width = async () => {
    const view = new URLSearchParams((await page.evaluate(() => location.hash)).slice(1)).get("view")?.split(",").map(Number);
    return view ? view[1] - view[0] : 1.65;
  };
  await until("a pinch zooms", async () => Math.abs((await width()) - 1.65 / 3) < 0.08);
  await page.touchscreen.tap(x, y);
  await until("a tap chooses", async () => (await page.evaluate(() => location.hash)).includes("point=1"));
}

export async function the_theme_is_chosen_and_kept({ open }) {
  const { page } = await open("", { colorScheme: "light" });
  await drawn(page);
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.keyboard.press("d");
  await until("dark", async () => (await ground()) !== light);
  assert.match(await page.evaluate(() => location.hash), /theme=dark/);
  await page.reload();
  assert.notEqual(await ground(), light);
}

async function faults(page, where) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  const bad = violations.filter((one) => ["serious", "critical"].includes(one.impact));
  assert.deepEqual(bad.map((one) => `${where}: ${one.id}: ${one.nodes.map((node) => node.html).slice(0, 3).join(" | ")}`), []);
}

export async function axe_finds_no_serious_fault({ open }) {
  for (const colorScheme of ["light", "dark"]) {
    const { page } = await open(`${S}&tour=6`, { colorScheme });
    await drawn(page);
    await figures(page);
    await faults(page, colorScheme);
    // the dialogs have the colours of the page
    if (colorScheme === "dark") continue;
    for (const [key, dialog] of [["?", "#keys"], ["e", "#export"], ["s", "#symbols"]]) {
      await page.keyboard.press(key);
      await page.locator(dialog).waitFor();
      await faults(page, `${colorScheme} ${dialog}`);
      await page.keyboard.press("Escape");
    }
  }
  const pinned = `${S}&pin=1,1.5,0.5,0,2,0.5,0,0,0,0,0`;
  for (const [where, options] of [["presentation", { colorScheme: "dark" }], ["forced colours", { forcedColors: "active" }]]) {
    const { page } = await open(`${pinned}&present=1&subject=compare`, options);
    await until("both points are drawn", async () => (await page.locator(".side .motion").count()) === 4);
    await faults(page, where);
    await page.keyboard.press("Escape");
    await page.locator("[data-name=motion] .enlarge").click();
    await faults(page, `${where}, enlarged`);
  }
  const { page } = await open("#panel=line&line=1.11,1.5,1.11,2", { viewport: { width: 360, height: 740 } });
  await drawn(page);
  await faults(page, "narrow");
}
