/** Tests of the export: every format of every view. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { drawn, until, verdict } from "./page.mjs";

async function saved(page, format) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`#export [data-format=${format}]`).click()]);
  assert.ok(download.suggestedFilename().endsWith(`.${format}`));
  return readFile(await download.path());
}

export async function exports_each_format({ open }) {
  const { page } = await open("#point=1&inverse_beta=1.3&gap=0.75&line=1.3,1,1.2,2", { acceptDownloads: true });
  await drawn(page);
  await until("a verdict", async () => (await page.locator(".verdict .label").count()) === 1 && (await verdict(page)) === "2/1");
  await page.locator("#export-button").click();
  await page.locator("#export-points").selectOption("100");
  const views = await page.$$eval("#export-view option", (options) => options.map((option) => option.value));
  assert.ok(views.length >= 9, views.join());
  for (const view of views) {
    await page.locator("#export-view").selectOption(view);
    await until(`the command of ${view}`, async () =>
      (await page.locator("#export pre").first().textContent()).startsWith("vibro "));
    assert.match(await page.locator("#export pre").last().textContent(), /import vibroimpact/);
    const formats = view === "attractors" ? ["csv"] : ["svg", "png", "csv"];
    for (const format of formats) {
      const bytes = await saved(page, format);
      if (format === "svg") assert.match(bytes.toString("utf8", 0, 200), /<svg /, view);
      if (format === "png") assert.equal(bytes.toString("hex", 0, 4), "89504e47", view);
      if (format === "csv") assert.match(bytes.toString("utf8", 0, 400), /^[a-z_#]/i, view);
    }
  }
}

export async function the_command_line_is_that_of_the_view({ open }) {
  const { page } = await open("#view=1,1.5,1,2&starts=3&restitution=0.6");
  await drawn(page);
  await page.keyboard.press("e");
  await until("the command is there", async () => (await page.locator("#export pre").first().textContent()).length > 10);
  const command = await page.locator("#export pre").first().textContent();
  for (const part of ["vibro map", "--inverse-beta", "1:1.5:200", "--gap", "1:2:200", "--starts", "3", "--restitution", "0.6", "--impacts", "200"]) {
    assert.ok(command.includes(part), `${part} in: ${command}`);
  }
}

/** The command and the table of each panel belong to that panel. */
export async function f10_panels_export_what_they_show({ open }) {
  const { page } = await open("#point=1&inverse_beta=1.3&gap=0.75", { acceptDownloads: true });
  await until("the panels are drawn", async () =>
    (await page.$$eval("#point .sheet img", (images) => images.filter((image) => !image.hidden && image.naturalWidth > 0).length)) >= 4);
  for (const [panel, view, python, head] of [
    ["phase portrait of the steady motion", "phase", "motion.waveform()", "t,x,v"],
    ["multipliers", "multipliers", "motion.multipliers", "re,im"],
    ["impact map and stroboscopic section", "sections", "vi.lyapunov(osc, x=0, points=2000).plot()", "section,side,phase,x,v"],
  ]) {
    await page.locator(`#point button[aria-label="Export ${panel}"]`).click();
    await until(`the command of ${view}`, async () =>
      (await page.locator("#export pre").first().textContent()).endsWith(`--show ${view} --plot ${view}.svg`));
    assert.ok((await page.locator("#export pre").last().textContent()).includes(python), python);
    assert.equal((await saved(page, "csv")).toString().split("\n")[0], head);
    await page.locator("#export [data-close]").click();
  }
}
