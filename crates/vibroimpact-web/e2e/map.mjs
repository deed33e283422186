/** Tests of the map: what colours mean, sharpening, sliders, starts. */

import assert from "node:assert/strict";
import { complete, drawn, hash, legend, listRequests, pixel, place, sharp, until } from "./page.mjs";

const progress = (page) => page.locator("#progress").textContent();

/** The tiles that were asked for, each with its budget and whether it is under way. */
const asked = (page) => page.evaluate(() => globalThis.asked.filter(({ path }) => /^.api.(tile|whole)/.test(path))
  .map(({ body, done }) => ({ under: !done, budget: Object.values(JSON.parse(body).task)[0].impacts })));

const hide = (page, hidden) => page.evaluate((value) => {
  Object.defineProperty(document, "hidden", { value, configurable: true });
  document.dispatchEvent(new Event("visibilitychange"));
}, hidden);

export async function the_map_rests_while_hidden_and_pauses({ open }) {
  const { page } = await open("about:blank", { viewport: { width: 640, height: 520 } });
  await listRequests(page);
  const under = async () => (await asked(page)).filter((one) => one.under).length;
  const begun = async () => (await asked(page)).length;
  // chaos, which takes long, and another window in every run, because the server keeps answers
  await page.goto(`${page.address}#view=1,1.3,2.6,${3.6 + 0.01 * Math.random()}&panel=none`);
  await until("it says what it does", async () => /^Sharpening, 20.000 impacts: \d+ of \d+ tiles sharp\.$/.test(await progress(page)));
  // a hidden tab: nothing runs soon after, and goes on when it is seen again
  const hidden = Date.now();
  await hide(page, true);
  await until("nothing runs while the tab is hidden", async () => (await under()) === 0);
  console.log(`        nothing runs ${((Date.now() - hidden) / 1000).toFixed(1)} s after the tab was hidden`);
  const rested = await begun();
  await page.waitForTimeout(700);
  assert.equal(await begun(), rested, "nothing begins while the tab is hidden");
  await hide(page, false);
  await until("it goes on", async () => (await begun()) > rested);
  await page.locator("#pause").click();
  await until("it is paused", async () => /^Paused/.test(await progress(page)) && (await under()) === 0);
  const paused = await begun();
  await page.waitForTimeout(700);
  assert.equal(await begun(), paused, "nothing begins during the pause");
  await page.locator("#pause").click();
  await until("it goes on after the pause", async () => (await begun()) > paused);
}

export async function the_map_sharpens_by_itself_and_keeps_what_is_decided({ open }) {
  const { page } = await open("about:blank", { whole: true, viewport: { width: 340, height: 290 } });
  await listRequests(page);
  const top = 2.4 + 0.01 * Math.random();
  await page.goto(`${page.address}#view=1.1,1.34,1.5,${top}&impacts=1000&panel=none`);
  const begin = Date.now();
  await sharp(page);
  const first = Date.now() - begin;
  const decided = async () => pixel(page, await place(page, 1.2, 1.6, [1.1, 1.34, 1.5, top]));
  const colour = await decided();
  await complete(page);
  console.log(`        sharp after ${(first / 1000).toFixed(1)} s, complete after ${((Date.now() - begin) / 1000).toFixed(1)} s`);
  assert.equal(await progress(page), "Complete: every point computed, 1000 impacts.");
  assert.deepEqual(await decided(), colour, "what is decided keeps its colour");
  const budgets = (await asked(page)).map(({ budget }) => budget);
  assert.ok(budgets.indexOf(1000) > 0 && budgets[0] === 200, `first 200 impacts, then 1000: ${budgets}`);
  assert.equal(budgets.lastIndexOf(200) < budgets.indexOf(1000), true, "no tile is computed again before all are there");
  await until("nothing is undecided so far", async () => !(await legend(page)).has("undecided so far"));
  assert.ok(await page.locator("#pause").isHidden());
}

/** Points between others that agree are computed at last, as those of the command without refinement: tests/tiles.rs. */
export async function a_complete_map_has_no_filled_points({ open, address, folder }) {
  // the others take long: chaos, and three starts for each point
  const windows = [[0, [1.2, 1.4, 0.6, 1.4], ""], [1, [1.05, 1.3, 1.6, 2.4], ""], [2, [1.25, 1.35, 0.7, 0.8], "&starts=3"]];
  for (const [k, window, more] of windows.slice(0, process.env.VIBROIMPACT_LONG === "1" ? 3 : 1)) {
    const { page } = await open("about:blank", { whole: true, viewport: { width: 340, height: 290 } });
    const [filled, plans] = [[], []];
    page.on("response", async (response) => {
      if (!response.url().includes("/api/whole?") || !response.ok()) return;
      plans.push(response.request().postDataJSON());
      filled.push((await response.body()).subarray(0, 4000).includes('"computed","type"'));
    });
    await page.goto(`${address}#view=${window}&impacts=1000&panel=none&layers=${more}`);
    const said = [];
    await until("every point is computed", async () => {
      said.push(await progress(page));
      return (await page.locator("#plane").getAttribute("data-complete")) !== null;
    });
    await complete(page);
    assert.ok(plans.length > 0, "points between others are computed");
    assert.ok(plans.every(({ task: { map } }) => map.refine === undefined && map.impacts === 1000));
    // it says so while there are filled points
    if (said.some((text) => text.startsWith("Sharp;"))) assert.ok(said.some((text) => /^Sharp; \d+ of \d+ tiles have filled points\.$/.test(text)), said.join("\n"));
    await page.screenshot({ path: `${folder}/complete-${k}.png` });
  }
}

/** A slider that moves 20 times a second. */
export async function a_slider_is_followed_while_it_moves({ open }) {
  const { page } = await open("#panel=none", { viewport: { width: 1280, height: 720 } });
  await drawn(page);
  const { seen, ages, blank } = await page.evaluate(async () => {
    const range = document.querySelector("#parameters .parameter:not([hidden]) input[type=range]");
    const host = document.querySelector("#plane");
    const canvas = host.querySelector("canvas");
    const copy = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
    const [set, seen, ages] = [new Map(), new Set(), []];
    const begin = performance.now();
    let blank = 0;
    let moving = true;
    const look = () => {
      const shown = /"restitution":([\d.]+)/.exec(host.dataset.picture)?.[1];
      if (set.has(shown)) {
        seen.add(shown);
        ages.push(performance.now() - set.get(shown));
      } else if (performance.now() - begin > 1000) ages.push(performance.now() - begin);
      // the pattern of what is not computed is white
      copy.drawImage(canvas, -canvas.width / 2, -canvas.height / 2);
      const { data } = copy.getImageData(0, 0, 1, 1);
      if (data[0] === 255 && data[1] === 255 && data[2] === 255) blank++;
      if (moving) requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
    for (let k = 0; k < 60; k++) {
      const value = (0.5 + k * 0.005).toFixed(3).replace(/0+$/, "");
      range.step = "0.005";
      range.value = value;
      set.set(String(Number(value)), performance.now());
      range.dispatchEvent(new Event("input", { bubbles: true }));
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    moving = false;
    return { seen: seen.size, ages, blank };
  });
  ages.sort((a, b) => a - b);
  console.log(`        ${seen} pictures of 60 values; the picture is at most ${ages.at(-1).toFixed(0)} ms old, in the median ${ages[ages.length >> 1].toFixed(0)} ms`);
  assert.ok(seen >= 2, `${seen} pictures in 3 seconds`);
  assert.equal(blank, 0, "the last picture stays until the next one is there");
  // on a quiet machine at most 300; other tests and builds may run beside this one
  assert.ok(ages[ages.length >> 1] < 400 && ages.at(-1) < 2000, `a picture is ${ages.at(-1)} ms old`);
  await page.evaluate(() => document.querySelector("#parameters .parameter:not([hidden]) input[type=range]").dispatchEvent(new Event("change")));
  await until("the value is in the address", async () => (await hash(page)).get("restitution") === "0.795");
}

/** While a slider moves, there is one request at a time, for a coarse picture; the panels follow when it rests. */
export async function only_the_map_is_computed_while_a_slider_moves({ open }) {
  const { page } = await open("about:blank");
  await listRequests(page);
  await page.goto(`${page.address}#point=1&inverse_beta=1.3&gap=0.75&line=1.3,1,1.2,2&layers=regions`);
  await drawn(page);
  await page.locator(".verdict .label").waitFor();
  const { during, last } = await page.evaluate(async () => {
    const range = document.querySelector("#parameters .parameter:not([hidden]) input[type=range]");
    const before = globalThis.asked.length;
    for (let k = 0; k < 20; k++) {
      range.value = String(0.51 + 0.01 * k);
      range.dispatchEvent(new Event("input", { bubbles: true }));
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    const moved = globalThis.asked.slice(before);
    // before the first picture, requests may begin that the slider then stops
    moved.splice(0, moved.findIndex(({ path }) => path === "/api/picture"));
    return { during: moved.map(({ path, abreast }) => ({ path, abreast })), last: range.value };
  });
  assert.ok(during.length >= 3, `${during.length} pictures`);
  assert.deepEqual([...new Set(during.map(({ path }) => path))], ["/api/picture"]);
  assert.equal(Math.max(...during.map(({ abreast }) => abreast)), 1, "one at a time");
  await until("then the panels follow", () => page.evaluate((value) => ["/api/answer", "/api/motion", "/api/tile", "/api/layer"].every((path) =>
    globalThis.asked.some((one) => one.path === path && one.body.includes(`"restitution":${value}`))), last));
}

const lin = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
const lab = ([r, g, b]) => {
  const f = (t) => (t > 216 / 24389 ? Math.cbrt(t) : ((24389 / 27) * t + 16) / 116);
  const [x, y, z] = [
    f((0.4124564 * r + 0.3575761 * g + 0.180437 * b) / 0.95047), f(0.2126729 * r + 0.7151522 * g + 0.072175 * b),
    f((0.0193339 * r + 0.119192 * g + 0.9503041 * b) / 1.08883),
  ];
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
};
/** Linear light as it appears to trichromats, protanopes and deuteranopes: Machado et al. (2009), severity 1. */
const EYES = [
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
];
const apart = (eye, a, b) => {
  const [p, q] = [a, b].map((rgb) => lab(eye.map((row) => row.reduce((sum, m, k) => sum + m * lin(rgb[k]), 0))));
  return Math.hypot(...p.map((v, k) => v - q[k]));
};

/** The mean colour of a square of the map. */
const mean = (page, at) => page.evaluate(([x, y]) => {
  const canvas = document.querySelector("#plane canvas");
  const box = canvas.getBoundingClientRect();
  const copy = new OffscreenCanvas(21, 21).getContext("2d", { willReadFrequently: true });
  copy.drawImage(canvas, 10 - Math.round(x - box.x), 10 - Math.round(y - box.y));
  const { data } = copy.getImageData(0, 0, 21, 21);
  return [0, 1, 2].map((k) => data.filter((_, at) => at % 4 === k).reduce((sum, v) => sum + v, 0) / (data.length / 4));
}, at);

export async function what_is_no_motion_has_a_look_and_a_row_of_its_own({ open, folder }) {
  const window = [0.6, 1.4, 1, 5];
  const link = `#x=restitution&view=${window}&impacts=200&inverse_beta=1.11&layers=&panel=none`;
  const { page } = await open(link, { whole: true, viewport: { width: 480, height: 400 } });
  await sharp(page);
  await page.screenshot({ path: `${folder}/looks.png` });
  const named = () => page.$$eval("#legend .legend-item .legend-name", (names) => names.map((name) => name.textContent));
  await until("the legend is that of the sharp map", async () => (await named()).includes("undecided in 200 impacts"));
  const rows = await named();
  assert.ok(rows.includes("no such oscillator") && rows.includes("undecided in 200 impacts"), rows.join());
  assert.ok(!rows.includes("not computed yet"), rows.join());
  const { page: waiting } = await open("about:blank", { viewport: { width: 480, height: 400 } });
  await waiting.route(/\/api\/(tile|picture)/, () => {});
  await waiting.goto(waiting.address + link);
  await until("the row of what is not computed", async () => (await waiting.locator("#legend").textContent()).includes("not computed yet"));
  const at = (x, y) => place(page, x, y, window);
  const looks = {
    impossible: await mean(page, await at(1.2, 3)), undecided: await mean(page, await at(0.72, 4)), "not computed": await mean(waiting, await at(0.8, 3)),
    "no impact": [0xf2, 0xee, 0xcb], "1/1": [0x9a, 0xd6, 0xee],
  };
  for (const [k, eye] of EYES.entries()) {
    for (const [a, one] of Object.entries(looks)) {
      for (const [b, other] of Object.entries(looks)) {
        if (a < b) assert.ok(apart(eye, one, other) > 7, `${a} and ${b}, eye ${k}: ${apart(eye, one, other).toFixed(1)} of ${one} and ${other}`);
      }
    }
  }
  await waiting.unrouteAll({ behavior: "ignoreErrors" });
}

export async function labels_have_the_colours_of_the_server_and_swatches_keep_them({ open, address }) {
  const { page } = await open("#impacts=200", { viewport: { width: 640, height: 480 }, forcedColors: "active" });
  await drawn(page);
  const server = await page.evaluate(async () => {
    const { tile } = await import("/assets/api.js");
    const { colourOf } = await import("/assets/colours.js");
    const axes = [{ vary: "inverse_beta", over: "0.4:2:60" }, { vary: "gap", over: "0:5:60" }];
    const plan = { version: 1, system: { inverse_beta: 1, gap: 1, restitution: 0.5 }, task: { map: { axes, starts: 1, seed: 1, impacts: 1000 } } };
    const { header } = await tile(plan);
    return Object.values(header.labels).map(({ name, colour }) => [name, colour, colourOf(name)]);
  });
  assert.ok(server.length > 10, `${server.length} labels`);
  for (const [name, ofServer, ofPage] of server) assert.equal(ofPage, ofServer, name);
  const swatch = await page.$eval("#legend .legend-item .swatch", (patch) => [getComputedStyle(patch).backgroundColor, getComputedStyle(patch).forcedColorAdjust]);
  assert.deepEqual(swatch, ["rgb(242, 238, 203)", "none"]);
  assert.ok(address);
}

export async function a_dark_page_has_a_dark_map({ open }) {
  const { page } = await open("#impacts=200", { colorScheme: "dark", viewport: { width: 640, height: 480 } });
  await drawn(page);
  const filters = await page.$$eval("#plane canvas:first-child, #legend .swatch", (all) => [...new Set(all.filter((one) => one.isConnected).map((one) => getComputedStyle(one).filter))]);
  assert.equal(filters.length, 1, filters.join());
  assert.match(filters[0], /invert/);
  await page.keyboard.press("d");
  await until("light", async () => (await page.$eval("#plane canvas", (canvas) => getComputedStyle(canvas).filter)) === "none");
}

export async function the_legend_names_groups_and_isolates_them({ open }) {
  const { page } = await open("#impacts=200", { viewport: { width: 1280, height: 640 } });
  await sharp(page);
  const row = page.locator("#legend button.legend-item", { hasText: "other m/n:" });
  assert.match(await row.textContent(), /^other m\/n: \d+\/\d+, \d+\/\d+, \d+\/\d+ and \d+ more/);
  assert.ok((await row.getAttribute("title")).split(", ").length > 10, "all of them are named in its tip");
  const at = await place(page, 1.3, 1.5);
  const before = await pixel(page, at);
  await row.click();
  await page.mouse.move(5, 5);
  await until("1/1 fades and stays so", async () => String(await pixel(page, at)) !== String(before));
  assert.equal(await row.getAttribute("aria-pressed"), "true");
  await row.click();
  await page.mouse.move(5, 5);
  await until("1/1 has its colour", async () => String(await pixel(page, at)) === String(before));
  await page.locator("#legend button.quiet", { hasText: "motions" }).click();
  await until("every motion has a row", async () => (await page.locator("#legend button.legend-item").count()) > 20);
}

export async function lines_between_motions_are_drawn_when_asked({ open }) {
  const { page } = await open("#view=1.2,1.4,0.5,1.5&impacts=200&layers=", { viewport: { width: 640, height: 480 } });
  await sharp(page);
  // pixels that have the colour of no motion
  const dark = () => page.evaluate(() => {
    const canvas = document.querySelector("#plane canvas");
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) if (data[k + 3] && data[k] + data[k + 1] + data[k + 2] < 240) count++;
    return count;
  });
  const before = await dark();
  await page.locator("#layers label", { hasText: "lines between motions" }).click();
  await until("a line from edge to edge", async () => (await dark()) > before + 300);
  assert.equal((await hash(page)).get("layers"), "boundaries");
}

export async function starts_of_each_point_are_said_and_shares_offered({ open }) {
  const { page } = await open("#impacts=200&view=1.25,1.35,0.7,0.8");
  await sharp(page);
  assert.match(await page.locator("#starts-note").textContent(), /^One start at each point/);
  await page.locator("#more-starts").click();
  assert.equal((await hash(page)).get("starts"), "8");
  assert.match(await page.locator("#starts-note").textContent(), /^8 starts at each point/);
  await page.mouse.move(...await place(page, 1.3, 0.75, [1.25, 1.35, 0.7, 0.8]));
  await until("two motions with their shares", async () => /1\/1 \d+\.\d %, 2\/1 \d+\.\d %|2\/1 \d+\.\d %, 1\/1 \d+\.\d %/.test(await page.locator("#readout").textContent()));
}
