/** Tests of the plane: tiles, zoom, hover, settings, address. */

import assert from "node:assert/strict";
import { SMALL, WIDE, answer, complete, drag, drawn, enter, hash, legend, listRequests, pixel, place, sharp, tasks, until } from "./page.mjs";

export async function loads_without_a_complaint({ open }) {
  const { page } = await open();
  await drawn(page);
  const shares = await legend(page);
  assert.ok(shares.get("1/1") > 15 && shares.get("1/1") < 40, `1/1 has ${shares.get("1/1")} %`);
  assert.ok(shares.get("no impact") > 25, "no impact is common");
  assert.match(await page.title(), /^1\/β 0\.375 to 2\.025, δ 0 to 5, ε 0\.5 · vibro explore$/);
  assert.ok(await page.locator("#strip").isHidden());
}

export async function becomes_sharp_and_the_shares_with_it({ open }) {
  const { page } = await open("", SMALL);
  await sharp(page);
  await until("the note on coarse shares is gone", async () => (await page.locator("#legend .note").textContent()) === "");
  const sum = [...(await legend(page)).values()].reduce((a, b) => a + b, 0);
  assert.ok(sum > 90 && sum <= 100.6, `shares add up to ${sum}`);
}

export async function zooms_ten_levels({ open }) {
  const { page } = await open("", WIDE);
  await drawn(page);
  const tiles = tasks(page, "/api/tile", "map");
  const [x, y] = await place(page, 1.11, 2.4);
  await page.mouse.move(x, y);
  for (let level = 0; level < 10; level++) {
    await page.mouse.wheel(0, -250);
    await page.waitForTimeout(60);
  }
  const view = async () => ((await hash(page)).get("view") ?? "0,1,0,1").split(",").map(Number);
  await until("the view is 1024 times smaller", async () => {
    const [left, right] = await view();
    return Math.abs(1.65 / (right - left) / 1024 - 1) < 0.01;
  });
  const [left, right, bottom, top] = await view();
  // accurate to a pixel of the first view
  assert.ok(Math.abs((left + right) / 2 - 1.11) < 0.004 && Math.abs((bottom + top) / 2 - 2.4) < 0.01, "the pointer stays where it is");
  await until("a sharp tile of that depth", () => tiles.some(({ axes }) => {
    const [from, to, count] = String(axes[0].over).split(":").map(Number);
    return count === 128 && (to - from) / 127 < (right - left) / 500;
  }));
  await until("1/2 fills the view", async () => (await legend(page)).get("1/2") > 99);
}

/** A change of the layout in the middle of a gesture showed the first view again. */
export async function a_change_of_the_size_does_not_undo_a_gesture({ open }) {
  const { page } = await open();
  await drawn(page);
  const [x, y] = await place(page, 1.11, 2.4);
  await page.evaluate(([clientX, clientY]) => {
    const surface = document.querySelector("#plane canvas:last-of-type");
    surface.dispatchEvent(new WheelEvent("wheel", { deltaY: -500, clientX, clientY, bubbles: true, cancelable: true }));
    dispatchEvent(new Event("resize"));
  }, [x, y]);
  await until("the view is 4 times smaller", async () => {
    const [left, right] = ((await hash(page)).get("view") ?? "0,1").split(",").map(Number);
    return Math.abs(1.65 / (right - left) / 4 - 1) < 0.01;
  });
}

export async function one_axis_is_zoomed_alone({ open, folder }) {
  const { page } = await open("", SMALL);
  await sharp(page);
  // creates an entry in the history to go back to
  await page.mouse.click(...await place(page, 1.3, 1.5));
  await until("a point is chosen", async () => (await hash(page)).has("point"));
  const tiles = tasks(page, "/api/tile", "map");
  const view = async () => (await hash(page)).get("view")?.split(",").map(Number);
  const box = await page.locator("#plane").boundingBox();
  const [x, y] = await place(page, 1.3, 1.5);
  await page.mouse.move(x, box.y + box.height - 12);
  for (let k = 0; k < 4; k++) {
    await page.mouse.wheel(0, -125);
    await page.waitForTimeout(60);
  }
  await until("a quarter of the width", async () => {
    const [from, to] = (await view()) ?? [0, 9];
    return Math.abs(to - from - 1.65 / 4) < 0.005;
  });
  const [left, right, bottom, top] = await view();
  assert.ok(Math.abs(bottom) < 0.01 && Math.abs(top - 5) < 0.01, `the gap stays: ${bottom}, ${top}`);
  assert.ok(Math.abs((1.3 - left) / (right - left) - (1.3 - 0.375) / 1.65) < 0.01, "what is below the pointer stays there");
  await page.waitForTimeout(300);
  await sharp(page);
  const many = tiles.length;
  assert.ok(many > 0 && many <= 80, `${many} tiles for one gesture`);
  await page.screenshot({ path: `${folder}/one-axis.png` });
  // zooms the ordinate alone, from the keyboard, and back
  await page.locator("#plane canvas").last().focus();
  await page.keyboard.press("y");
  await until("half the height", async () => Math.abs((await view())[3] - (await view())[2] - 2.5) < 0.02);
  assert.ok(Math.abs((await view())[0] - left) < 1e-6, "the frequency stays");
  await page.waitForTimeout(200);
  await page.keyboard.press("Shift+Y");
  await until("the whole height", async () => Math.abs((await view())[3] - (await view())[2] - 5) < 0.02);
  await page.waitForTimeout(300);
  await sharp(page);
  assert.ok(tiles.length <= many + 80, `${tiles.length - many} tiles for the other axis`);
  await page.mouse.move(box.x + 15, y);
  await page.mouse.dblclick(box.x + 15, y);
  await until("a double click over the other numbers", async () => Math.abs((await view())[3] - (await view())[2] - 2.5) < 0.02);
  assert.ok(Math.abs((await view())[1] - right) < 1e-6, "the frequency stays");
  await page.waitForTimeout(300);
  // gestures in quick succession are one step
  let steps = 0;
  while (!(await page.locator("#undo").isDisabled()) && (await hash(page)).has("view")) {
    await page.locator("#undo").click();
    await page.waitForTimeout(100);
    steps++;
  }
  assert.ok(steps >= 1 && steps <= 4, `${steps} steps`);
}

export async function stops_at_the_numeric_limit({ open }) {
  const { page } = await open("#view=1.1099999999999,1.1100000000001,1.9999999999999,2.0000000000001");
  await drawn(page);
  assert.ok(await page.locator("#limit").isHidden());
  const [x, y] = await place(page, 1.11, 2, [1.1099999999999, 1.1100000000001, 1.9999999999999, 2.0000000000001]);
  await page.mouse.move(x, y);
  for (let k = 0; k < 12; k++) await page.mouse.wheel(0, -600);
  await page.locator("#limit").waitFor();
  await page.waitForTimeout(500);
  const [left, right] = (await hash(page)).get("view").split(",").map(Number);
  assert.ok(right > left, "there is a view");
  assert.ok(right - left >= 8 * 2 ** -52 * 200, `a view ${right - left} wide has points that differ`);
}

export async function hover_names_the_motion_the_server_settles_into({ open, address }) {
  const { page } = await open("", SMALL);
  await sharp(page);
  for (const [x, y] of [[1.3, 1.5], [1.8, 0.25], [0.6, 2], [1.15, 2.4], [1.7, 0.6]]) {
    const { motion } = await answer(address, { settle: { start: {} } }, { inverse_beta: x, gap: y, restitution: 0.5 });
    await page.mouse.move(...await place(page, x, y));
    const name = motion.label === "0" ? "no impact" : motion.label;
    await until(`the readout names ${name} at ${x}, ${y}`, async () =>
      (await page.locator("#readout").textContent()).endsWith(name), 5);
    const text = await page.locator("#readout").textContent();
    const [, told] = text.match(/1\/β ([\d.]+)/);
    assert.ok(Math.abs(Number(told) - x) < 0.004, text);
  }
}

export async function at_most_three_tiles_are_under_way_and_those_out_of_view_are_given_up({ open }) {
  const { page } = await open("about:blank");
  await listRequests(page);
  await page.goto(`${page.address}#impacts=200`);
  await drawn(page);
  // no tile is ready before the view changes, however fast it is computed
  await page.evaluate(() => { globalThis.held = new Promise((go) => { globalThis.release = go; }); });
  const tiles = async (wanted) => (await page.evaluate(() => globalThis.asked.map(({ path, signal, done, abreast }) =>
    ({ path, given: signal?.aborted, done, abreast })))).filter(({ path, ...one }) => path === "/api/tile" && wanted(one));
  for (let k = 0; k < 6; k++) {
    await page.locator("#zoom-in").click();
    await until("tiles are under way", async () => (await tiles(({ given, done }) => !given && !done)).length >= 2);
  }
  await page.locator("#whole").click();
  await until("tiles are given up", async () => (await tiles(({ given }) => given)).length > 0);
  await page.evaluate(() => globalThis.release());
  await drawn(page);
  const most = Math.max(...(await tiles(() => true)).map(({ abreast }) => abreast));
  assert.ok(most >= 2 && most <= 3, `${most} at a time`);
}

export async function tiles_have_hardly_more_points_than_pixels({ open }) {
  // one motion everywhere, so that the server has little to compute
  const { page } = await open("#view=1.25,1.35,1.45,1.55", { viewport: { width: 1810, height: 905 } });
  const tiles = tasks(page, "/api/tile", "map");
  await page.reload();
  await sharp(page);
  const [x0, y0] = await place(page, 0, 0, [0, 1, 0, 1]);
  const [x1, y1] = await place(page, 1, 1, [0, 1, 0, 1]);
  const pixels = (x1 - x0) * (y0 - y1);
  const points = tiles.filter(({ refine }) => refine).map(({ axes }) => axes.reduce((product, { over }) => product * Number(over.split(":")[2]), 1))
    .reduce((sum, count) => sum + count, 0);
  // the surplus includes tiles at the edges, which are only partly visible
  assert.ok(points >= pixels && points < 1.6 * pixels, `${points} points for ${pixels} pixels`);
}

export async function what_was_seen_is_not_asked_again({ open }) {
  const { page } = await open("#view=1.25,1.35,1.4,1.6&impacts=200", { whole: true, viewport: { width: 480, height: 400 } });
  // a tile that is sharp may still be asked for, to compute its filled points
  await complete(page);
  const asked = tasks(page, "/api/tile", "map");
  await page.locator("#zoom-in").click();
  await until("another level", async () => (await hash(page)).get("view") !== "1.25,1.35,1.4,1.6");
  // its tiles are requested a little later
  await until("its tiles are requested", async () => asked.length > 0);
  await page.waitForTimeout(1000);
  await complete(page);
  asked.length = 0;
  await page.locator("#zoom-out").click();
  await page.waitForTimeout(1000);
  await complete(page);
  assert.equal(asked.length, 0);
}

export async function pans_by_drag_and_arrows({ open }) {
  const { page } = await open();
  await drawn(page);
  const [x, y] = await place(page, 1.2, 2);
  await drag(page, [x, y], [x + 100, y + 50]);
  const [left, , bottom] = (await hash(page)).get("view").split(",").map(Number);
  assert.ok(left < 0.375 && bottom > 0, `moved to ${left}, ${bottom}`);
  assert.ok(!(await hash(page)).has("point"), "a drag chooses nothing");
  await page.locator("#plane canvas").last().focus();
  await page.keyboard.press("ArrowRight");
  await until("the arrow moves the view", async () => Number((await hash(page)).get("view").split(",")[0]) > left);
}

export async function restitution_changes_the_plane({ open }) {
  const { page } = await open();
  await drawn(page);
  const before = await legend(page);
  const asked = page.waitForRequest((request) => request.url().endsWith("/api/tile")
    && request.postDataJSON().system.restitution === 0.8);
  await enter(page.locator("#field-restitution"), "0.8");
  await asked;
  assert.equal((await hash(page)).get("restitution"), "0.8");
  await until("the shares are others", async () => (await legend(page)).get("1/1") !== before.get("1/1"));
  await enter(page.locator("#field-restitution"), "1.5");
  assert.equal(await page.locator("#field-restitution").getAttribute("aria-invalid"), "true");
  assert.equal((await hash(page)).get("restitution"), "0.8", "an illegal value changes nothing");
}

export async function axes_change_and_budget_and_starts({ open }) {
  const { page } = await open();
  await drawn(page);
  const asked = page.waitForRequest((request) => {
    if (!request.url().endsWith("/api/tile")) return false;
    const { map } = request.postDataJSON().task;
    return map.axes[0].vary === "restitution" && map.axes[1].vary === "gap";
  });
  await page.locator("#axis-x").selectOption("restitution");
  await asked;
  assert.ok(await page.locator("#field-inverse_beta").isVisible(), "the frequency is on no axis now");
  const starts = page.locator("#starts");
  assert.deepEqual(await starts.evaluate((slider) => [slider.min, slider.max, slider.labels[0].textContent]), ["1", "16", "starts per point"]);
  await starts.focus();
  for (let k = 0; k < 3; k++) await page.keyboard.press("ArrowRight");
  assert.equal(await page.locator("output[for=starts]").textContent(), "4");
  await page.locator("#impacts").selectOption("1000");
  const state = await hash(page);
  assert.deepEqual([state.get("x"), state.get("starts"), state.get("impacts")], ["restitution", "4", "1000"]);
}

export async function a_link_brings_everything_back({ open }) {
  const link = "#view=1,1.5,1.5,2.5&restitution=0.6&starts=2&layers=paper,amplitude&point=1&gap=2&inverse_beta=1.2";
  const { page } = await open(link);
  await drawn(page);
  const { page: other } = await open(await page.evaluate(() => location.hash));
  await drawn(other);
  assert.equal(await other.locator("#field-restitution").inputValue(), "0.6");
  assert.equal(await other.locator("#starts").inputValue(), "2");
  assert.equal(await other.locator("#point input").first().inputValue(), "1.2");
  const boxes = await other.$$eval("#layers input", (inputs) => inputs.map((input) => input.checked));
  assert.deepEqual(boxes, [false, true, true, false, false]);
}

export async function layers_are_drawn({ open, folder }) {
  const { page } = await open("#view=1.2,1.4,0.6,1.4", SMALL);
  await drawn(page);
  for (const [kind, name] of [["regions", "regions of stability"], ["amplitude", "free amplitude"]]) {
    const [response] = await Promise.all([
      page.waitForResponse((one) => one.url().endsWith(`/api/layer?kind=${kind}`)),
      page.locator("#layers label", { hasText: name }).click(),
    ]);
    assert.equal(response.status(), 200);
  }
  await until("no layer is being computed", async () =>
    (await page.$$eval("#layers .soft", (parts) => parts.map((part) => part.textContent).join(""))) === "", 120);
  await sharp(page);
  await page.screenshot({ path: `${folder}/layers.png` });
}

export async function a_motion_of_the_legend_alone_keeps_its_colour({ open }) {
  const { page } = await open("", SMALL);
  await sharp(page);
  // the page is scrolled to the legend
  const colour = async () => (await pixel(page, await place(page, 1.3, 1.5))).join();
  await page.mouse.move(5, 5);
  const before = await colour();
  await page.locator(".legend-item", { hasText: "2/1" }).first().hover();
  await until("1/1 fades", async () => (await colour()) !== before);
  await page.locator(".legend-item", { hasText: "1/1" }).first().hover();
  await until("1/1 has its colour", async () => (await colour()) === before);
}
