/** After random zooming and clicking the server must become idle, with bounded memory. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";

/** The process number of the server, if the caller has set it. */
const PID = process.env.VIBRO_PID;
/** Clock ticks of /proc in a second, on Linux. */
const TICKS = 100;
/** Seconds of zooming and clicking; more in the long run. */
const SECONDS = process.env.VIBROIMPACT_LONG === "1" ? 60 : 6;

/** Processor time that the server has used, in seconds. */
async function used() {
  const text = await readFile(`/proc/${PID}/stat`, "utf8");
  const fields = text.slice(text.lastIndexOf(")") + 2).split(" ");
  return (Number(fields[11]) + Number(fields[12])) / TICKS;
}

/** Memory of the server in megabytes. */
async function held() {
  const text = await readFile(`/proc/${PID}/status`, "utf8");
  return Number(/VmRSS:\s+(\d+)/.exec(text)[1]) / 1024;
}

/** A generator of pseudorandom numbers that are the same in every run. */
function dice(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Seconds until the server has been idle for a quarter of a second. */
async function untilIdle(patience) {
  const begin = Date.now();
  while (Date.now() - begin < 1000 * patience) {
    const before = await used();
    await pause(250);
    if ((await used()) - before <= 0.03) return (Date.now() - begin) / 1000 - 0.25;
  }
  return Infinity;
}

export async function is_quiet_after_zooming_and_clicking({ open }) {
  if (!PID) {
    console.log("        skipped: VIBRO_PID does not say which process the server is");
    return;
  }
  const { page, context } = await open("", { whole: true });
  const box = await page.locator("canvas").first().boundingBox();
  const roll = dice(7);
  const act = async () => {
    const at = [box.x + box.width * (0.15 + 0.7 * roll()), box.y + box.height * (0.1 + 0.7 * roll())];
    await page.mouse.move(...at);
    const kind = roll();
    if (kind < 0.55) await page.mouse.wheel(0, roll() < 0.6 ? -400 : 400);
    else if (kind < 0.8) await page.mouse.click(...at);
    else {
      await page.mouse.down();
      await page.mouse.move(at[0] + 120 * (roll() - 0.5), at[1] + 120 * (roll() - 0.5), { steps: 4 });
      await page.mouse.up();
    }
    await pause(40 + 120 * roll());
  };
  const end = Date.now() + 1000 * SECONDS;
  let acts = 0;
  while (Date.now() < end) {
    await act();
    acts++;
  }
  assert.ok(acts > SECONDS, `${acts} acts`);
  // the only remaining work is for the current view, which is drawn in full resolution
  const sharp = await untilIdle(60);
  assert.ok(Number.isFinite(sharp), "the server is busy a minute after the last act");
  for (let k = 0; k < 10; k++) await act();
  await page.goto("about:blank");
  await context.close();
  const idle = await untilIdle(20);
  const memory = await held();
  console.log(`        ${acts} acts; sharp and idle ${sharp.toFixed(2)} s after the last; idle ${idle.toFixed(2)} s after the page went, ${memory.toFixed(0)} MB held`);
  assert.ok(idle <= 1, `the server was busy for ${idle} s after the page went`);
  assert.ok(memory < 600, `the server holds ${memory} MB`);
}
