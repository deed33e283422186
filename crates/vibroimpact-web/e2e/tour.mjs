/** Tests of the tour of the paper. */

import assert from "node:assert/strict";
import { drawn, hash, until, verdict } from "./page.mjs";

/** The verdicts at the points of the paper; null for steps without a chosen point. */
const VERDICTS = [null, "4/1", null, null, null, "2/1", "1/2", "chaotic"];

export async function the_tour_goes_through_all_steps({ open, folder }) {
  const { page } = await open();
  await drawn(page);
  await page.locator("#tour-button").click();
  const next = page.locator("#tour button", { hasText: "Next" });
  for (let step = 1; step <= 8; step++) {
    await until(`step ${step}`, async () => (await page.locator("#tour").textContent()).includes(`${step} of 8`));
    assert.equal((await hash(page)).get("tour"), String(step));
    assert.match(await page.locator("#tour-title").textContent(), new RegExp(`^Figure ${step + 3}\\.`));
    if (VERDICTS[step - 1]) {
      await until(`figure ${step + 3} shows ${VERDICTS[step - 1]}`, async () =>
        (await page.locator(".verdict .label").count()) === 1 && (await verdict(page)) === VERDICTS[step - 1]);
    }
    await page.waitForTimeout(1000);
    await page.screenshot({ path: `${folder}/tour-${step}.png` });
    assert.ok(await page.locator("#strip").isHidden(), await page.locator("#strip").textContent());
    if (step < 8) await next.click();
  }
  assert.ok(await next.isDisabled());
  await page.keyboard.press("[");
  await until("the step before", async () => (await hash(page)).get("tour") === "7");
  await page.locator("#tour button", { hasText: "Close" }).click();
  assert.ok(await page.locator("#tour").isHidden());
}
