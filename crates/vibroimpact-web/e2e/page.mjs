/** Common functions of the tests of the page. */

import assert from "node:assert/strict";

/**
 * Waits until a condition holds. After `seconds` it fails with the last value of the condition.
 *
 * The time only ends a test that would wait for ever. It is long, because other work may run on the machine.
 */
export async function until(what, condition, seconds = 90) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    if (await condition()) return;
    assert.ok(Date.now() < end, `after ${seconds} s still not: ${what}`);
    await new Promise((again) => setTimeout(again, 100));
  }
}

/** A window for tests that wait for the whole map: the server computes what is shown, and keeps it for the next such test. */
export const SMALL = { viewport: { width: 640, height: 500 } };

/** A window for tests that measure what is on the screen. */
export const WIDE = { viewport: { width: 1280, height: 800 } };

/** The hash of the page as pairs. */
export const hash = async (page) => new URLSearchParams((await page.evaluate(() => location.hash)).slice(1));

/** The rows of the legend as a map from name to per cent. */
export const legend = async (page) => new Map(await page.$$eval("#legend button.legend-item", (items) => items.map((item) => [
  item.querySelector(".legend-name").textContent, parseFloat(item.querySelector(".legend-share").textContent.replace("<", "")),
])));

/** Waits for the first picture of the plane, with the colours of motions or of a quantity. */
export const drawn = (page, quantity = false) => (quantity ? page.waitForSelector("#legend .bar-colours[data-range]")
  : until("the legend names motions", async () => (await legend(page)).size > 0));

/** Waits until every tile in view is drawn with the first budget. */
export const sharp = (page) => page.waitForSelector("#plane[data-sharp]", { timeout: 120000 });

/** Waits until every tile in view has its largest budget. */
export const complete = (page) => page.waitForSelector("#plane[data-complete]", { timeout: 240000 });

/** The pixel of the map at a position on the screen. */
export const pixel = (page, at) => page.evaluate(([x, y]) => {
  const canvas = document.querySelector("#plane canvas");
  const box = canvas.getBoundingClientRect();
  const scale = canvas.width / box.width;
  const one = new OffscreenCanvas(1, 1).getContext("2d");
  one.drawImage(canvas, -Math.round((x - box.x) * scale), -Math.round((y - box.y) * scale));
  return [...one.getImageData(0, 0, 1, 1).data].slice(0, 3);
}, at);

/** Writes into a field and leaves it with Enter. */
export async function enter(field, text) {
  await field.fill(text);
  await field.press("Enter");
}

/** Drags the pointer from one position on the screen to another one. */
export async function drag(page, from, to) {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(...to, { steps: 6 });
  await page.mouse.up();
}

/** The position on the screen of a point of the first view, or of another window, computed from the frame of the plane on the page. */
export async function place(page, x, y, [left, right, bottom, top] = [0.375, 2.025, 0, 5], plane = "#plane") {
  const box = await page.locator(plane).boundingBox();
  const em = await page.evaluate(() => parseFloat(getComputedStyle(document.documentElement).fontSize));
  const narrow = box.width < 26 * em;
  const [l, b, t, r] = [Math.round(em * (narrow ? 3.2 : 4.2)), Math.round(3.3 * em), Math.round(0.7 * em), Math.round(0.9 * em)];
  return [
    box.x + l + ((x - left) / (right - left)) * (box.width - l - r),
    box.y + t + ((top - y) / (top - bottom)) * (box.height - t - b),
  ];
}

/** The verdict in the panel. */
export const verdict = (page) => page.locator(".verdict .label").textContent();

/** Sends a question directly to the server, for its answer or its table. */
async function post(address, path, task, system) {
  const response = await fetch(`${address}api/${path}`, {
    method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify({ version: 1, system, task }),
  });
  assert.ok(response.ok, await response.clone().text());
  return response;
}

export const answer = async (address, task, system) => (await post(address, "answer", task, system)).json();

/** The rows of a table, without its head. */
export const table = async (address, task, system) =>
  (await (await post(address, "table", task, system)).text()).trim().split("\n").slice(1).map((row) => row.split(","));

/** The tasks that the page asks of a path from now on, of a kind such as `map`. */
export function tasks(page, path, kind) {
  const found = [];
  page.on("request", (request) => {
    const task = request.url().endsWith(path) && request.postDataJSON().task[kind];
    if (task) found.push(task);
  });
  return found;
}

/**
 * Lets a page that is loaded next list its requests in `asked`, because the browser reports cancelled ones only later. Those for tiles are
 * sent when the promise in `held` is kept.
 */
export const listRequests = (page) => page.addInitScript(() => {
  const original = globalThis.fetch;
  globalThis.asked = [];
  globalThis.fetch = async (path, options) => {
    const one = { path: String(path).split("?")[0], body: options?.body ?? "", signal: options?.signal, done: false };
    globalThis.asked.push(one);
    // a request that was stopped ends a moment later
    one.abreast = globalThis.asked.filter((of) => of.path === one.path && !of.done && !of.signal?.aborted).length;
    const stopped = () => new Promise((_, stop) => one.signal?.addEventListener("abort", () => stop(one.signal.reason)));
    try {
      if (one.path === "/api/tile") await Promise.race([globalThis.held, stopped()]);
      const response = await original(path, options);
      const bytes = await response.arrayBuffer();
      return new Response(bytes, { status: response.status, headers: response.headers });
    } finally {
      one.done = true;
    }
  };
});

/** The number of panels of the point with a picture: from the server, or drawn by the page. */
export const pictures = (page) => page.evaluate(() =>
  [...document.querySelectorAll("#point .sheet img")].filter((image) => !image.hidden && image.naturalWidth > 0).length
  + document.querySelectorAll("#point > .panel:not([data-name=compare]) .graph .motion").length);

/** Whether the whole of an element is on the screen. */
export const onScreen = (page, selector) => page.locator(selector).first().evaluate((element) => {
  const { left, right, top, bottom } = element.getBoundingClientRect();
  return right > left && bottom > top && left >= -1 && top >= -1 && right <= innerWidth + 1 && bottom <= innerHeight + 1;
});
