/** Tests of the tour: the paper and beyond, and its subject on the screen. */

import assert from "node:assert/strict";
import { drawn, hash, onScreen, until, verdict } from "./page.mjs";

/** For each step: the beginning of its title, the verdict at its point, the panel that is its subject. */
const STEPS = [
  ["Figure 4.", null, "map"], ["Figure 5.", "4/1", "motion"], ["Figure 6.", null, "basin"], ["Figure 7.", null, "basin"],
  ["Figure 8.", null, "basin"], ["Figure 9.", "2/1", "basin"], ["Figure 10.", "1/2", "motion"], ["Figure 11.", "chaotic", "motion"],
  ["Period doubling", null, "line"], ["A grazing event", null, "line"], ["Chatter", "∞/1", "motion"], ["Three motions", null, "basin"],
  ["Two stops", "1/1", "basin"], ["Both sides", null, "compare"],
];

const SIZES = [{ width: 1280, height: 720 }, { width: 1920, height: 1080 }, { width: 360, height: 740 }];

/** What must be on the screen for each subject. */
const SUBJECT = {
  map: "#plane", motion: "[data-name=motion] .graph", basin: "#basin", line: "#line .figure", compare: ".side .graph",
};

/** The times between the impacts in the waveform, in forcing periods. */
const intervals = (page) => page.$$eval("[data-name=motion] .impact", (marks) => {
  const end = Number(document.querySelector(".player .time").max);
  const frame = document.querySelector("[data-name=motion] .frame");
  const periods = Number(document.querySelector("#periods").value);
  const times = marks.map((mark) => ((mark.getAttribute("cx") - frame.getAttribute("x")) / frame.getAttribute("width")) * periods);
  return end > 0 ? times.slice(1).map((time, k) => time - times[k]) : [];
});

export async function the_tour_goes_through_all_steps({ open, folder }) {
  const { page } = await open("", { viewport: SIZES[0] });
  await drawn(page);
  await page.locator("#tour-button").click();
  const next = page.locator("#tour button", { hasText: "Next" });
  const place = await next.boundingBox();
  for (const [k, [title, label]] of STEPS.entries()) {
    const step = k + 1;
    await until(`step ${step}`, async () => (await page.locator("#tour").textContent()).includes(`${step} of ${STEPS.length}`));
    assert.equal((await hash(page)).get("tour"), String(step));
    assert.ok((await page.locator("#tour-title").textContent()).startsWith(title), title);
    if (label) {
      await until(`${title} shows ${label}`, async () =>
        (await page.locator("#point > .verdict .label").count()) === 1 && (await verdict(page)) === label);
    }
    if (title === "Figure 5.") {
      await until("four impacts in each of two periods", async () => [8, 9].includes(await page.locator("[data-name=motion] .impact").count()));
    }
    if (title === "Figure 10.") {
      await until("up to the takeover", async () => (await intervals(page)).length > 20);
      const found = await intervals(page);
      assert.ok(Math.abs(found[0] - 1) < 0.1 && Math.abs(found.at(-1) - 2) < 0.1, `1/1 at first, 1/2 at last: ${found}`);
    }
    if (title === "Both sides") {
      await until("both", async () => (await page.locator(".side .verdict .label").allTextContents()).join() === "2/1,1/1");
    }
    await page.screenshot({ path: `${folder}/tour-${step}.png` });
    assert.ok(await page.locator("#strip").isHidden(), await page.locator("#strip").textContent());
    assert.deepEqual(await next.boundingBox(), place, "the button stays where it is");
    if (step < STEPS.length) await next.click();
  }
  assert.ok(await next.isDisabled());
  await page.keyboard.press("[");
  await until("the step before", async () => (await hash(page)).get("tour") === String(STEPS.length - 1));
  await page.keyboard.press("PageDown");
  await until("the key of a presenter", async () => (await hash(page)).get("tour") === String(STEPS.length));
  await page.locator("#tour-step").selectOption("2");
  await until("a step from the list", async () => (await page.locator("#tour-title").textContent()).startsWith("Figure 5."));
  await page.locator("#tour button", { hasText: "Close" }).click();
  assert.ok(await page.locator("#tour").isHidden());
}

export async function the_tour_keeps_its_subject_on_the_screen({ open, folder }) {
  const wide = await open("", { viewport: SIZES[0] });
  const narrow = await open("", { viewport: SIZES[2], hasTouch: true, isMobile: true });
  const looks = (page, where, shown) => until(`${where}: subject and title are on the screen`, async () =>
    (await onScreen(page, shown)) && onScreen(page, "#tour-title"));
  for (const { page } of [wide, narrow]) await page.locator("#tour-button").click();
  for (const [k, [title, , subject]] of STEPS.entries()) {
    for (const { page } of [wide, narrow]) {
      await until(title, async () => (await page.locator("#tour-title").textContent()).startsWith(title));
    }
    await looks(narrow.page, `${title} on a phone`, subject === "map" ? "#tour" : SUBJECT[subject]);
    for (const size of SIZES.slice(0, 2)) {
      await wide.page.setViewportSize(size);
      await looks(wide.page, `${title} at ${size.height} lines`, SUBJECT[subject]);
      if (subject === "compare") await looks(wide.page, `the portraits at ${size.height} lines`, ".side:last-child .graph:last-child");
    }
    await wide.page.setViewportSize(SIZES[0]);
    await wide.page.keyboard.press("f");
    await looks(wide.page, `${title} presented`, SUBJECT[subject]);
    if (k === 6) await wide.page.screenshot({ path: `${folder}/tour-7-presented.png` });
    await wide.page.keyboard.press("f");
    if (k + 1 < STEPS.length) for (const { page } of [wide, narrow]) await page.locator("#tour button", { hasText: "Next" }).click();
  }
}
