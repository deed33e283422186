/**
 * The tests of the page: `node run.mjs http://127.0.0.1:8411/ [folder for screenshots] [part of a name]`.
 *
 * Needs a running `vibro explore` and Chromium. The variable CHROMIUM has its path if it is not /usr/bin/chromium.
 */

import { chromium } from "playwright-core";
import { mkdir } from "node:fs/promises";
import * as exporting from "./export.mjs";
import * as line from "./line.mjs";
import * as looks from "./looks.mjs";
import * as map from "./map.mjs";
import * as motion from "./motion.mjs";
import * as panels from "./panels.mjs";
import * as plane from "./plane.mjs";
import * as point from "./point.mjs";
import * as quiet from "./quiet.mjs";
import * as settings from "./settings.mjs";
import * as tour from "./tour.mjs";
import * as units from "./units.mjs";
import * as values from "./values.mjs";
import * as wrong from "./wrong.mjs";

const [address, folder = "screenshots", part = ""] = process.argv.slice(2);
if (!address) {
  console.error("usage: node run.mjs ADDRESS [FOLDER] [PART OF A NAME]");
  process.exit(2);
}

const QUIET = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

/** Not large, because the server computes every point that is shown. */
const VIEWPORT = { width: 1000, height: 640 };

/** Impacts within which the motions of most tests are decided. */
const BUDGET = 200;

await mkdir(folder, { recursive: true });
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: QUIET });
let passed = 0;
let failed = 0;

/** The hash with a small budget if it has none: with the full one the server would compute as long as the page is open. */
function shallow(hash) {
  if (hash === "about:blank" || /[#&]impacts=/.test(hash)) return hash;
  return `${hash || "#"}${hash.length > 1 ? "&" : ""}impacts=${BUDGET}`;
}

/** Pages that tests have left. The next test takes one: to open another one takes the browser twice as long. */
const left = [];

/**
 * Opens the page and collects its errors. A test that expects errors empties the list. With `full` it has the full budget, with
 * `whole` it asks for the points between others that agree too: the server would compute them as long as the page is open. A test with
 * other options, or one that begins at `about:blank`, has a page of its own.
 */
async function open(hash = "", { full = false, whole = false, viewport = VIEWPORT, ...options } = {}) {
  const shared = hash !== "about:blank" && !Object.keys(options).length;
  const page = (shared && left.pop()) || await (await browser.newContext({ viewport, ...options })).newPage();
  await page.setViewportSize(viewport);
  if (!whole) await page.route(/\/api\/whole/, () => {});
  page.setDefaultTimeout(60000);
  const complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => complaints.push(String(error.stack)));
  page.address = address;
  const shown = full ? hash : shallow(hash);
  await page.goto(shown === "about:blank" ? shown : address + shown);
  return { page, context: page.context(), complaints, shared };
}

/** Leaves a page for the next test, or closes it. */
async function leave({ page, context, shared }, failed) {
  if (!shared || failed || page.isClosed()) {
    await context.close();
    return;
  }
  for (const event of ["console", "pageerror", "request", "response"]) page.removeAllListeners(event);
  await page.mouse.move(0, 0);
  await page.goto("about:blank");
  await page.unrouteAll({ behavior: "ignoreErrors" });
  await context.clearPermissions();
  left.push(page);
}

const chosen = part.split(",");
for (const module of [plane, map, settings, line, point, motion, panels, exporting, values, units, tour, wrong, looks, quiet]) {
  for (const [name, test] of Object.entries(module)) {
    if (!chosen.some((one) => name.includes(one))) continue;
    const opened = [];
    const before = failed;
    const begin = Date.now();
    try {
      await test({
        address, folder,
        open: async (...given) => {
          opened.push(await open(...given));
          return opened.at(-1);
        },
      });
      const complaints = opened.flatMap((one) => one.complaints);
      if (complaints.length) throw new Error(`the console says\n${complaints.join("\n")}`);
      passed++;
      console.log(`ok      ${name}  ${((Date.now() - begin) / 1000).toFixed(1)} s`);
    } catch (error) {
      failed++;
      console.log(`FAILED  ${name}\n${error.stack}`);
      await opened.at(-1)?.page.screenshot({ path: `${folder}/failed-${name}.png` }).catch(() => {});
    }
    for (const one of opened) await leave(one, failed > before);
  }
}
await browser.close();
console.log(`test result: ${failed ? "FAILED" : "ok"}. ${passed} passed; ${failed} failed`);
process.exit(failed || !passed ? 1 : 0);
