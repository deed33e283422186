/** Tests of the export: every format of every view, and commands that give the same tables. */

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, readlink, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { promisify } from "node:util";
import { SMALL, drawn, pictures, sharp, until, verdict } from "./page.mjs";

async function saved(page, format) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`#export [data-format=${format}]`).click()]);
  assert.ok(download.suggestedFilename().endsWith(`.${format}`));
  return readFile(await download.path());
}

/**
 * The number of points along each axis of what is exported, fewer than the page offers: each figure and table is computed
 * three times, by the page, by this program and by the command.
 */
const FEW = "20";

/** A window with few pixels, whose points the server computes before the command has the range of the colours. */
const TINY = { viewport: { width: 340, height: 290 } };

/** Chooses a number of points for the export, offered or not. */
async function choosePoints(page, points) {
  await page.locator("#export-points").evaluate((choice, points) => {
    if (![...choice.options].some((option) => option.value === points)) choice.add(new Option(points, points));
  }, points);
  await page.locator("#export-points").selectOption(points);
}

/** Every view has its commands, and a map and a motion are pictures; as figures and tables all are those of their commands, see below. */
export async function exports_views_as_png({ open }) {
  const { page } = await open("#point=1&inverse_beta=1.3&gap=0.75&line=1.3,1,1.2,2&impacts=200", SMALL);
  await drawn(page);
  await until("a verdict", async () => (await verdict(page)) === "2/1");
  await page.locator("#export-button").click();
  await choosePoints(page, FEW);
  const views = await page.$$eval("#export-view option", (options) => options.map((option) => option.value));
  assert.ok(views.length >= 9, views.join());
  for (const view of views) {
    await page.locator("#export-view").selectOption(view);
    await until(`the command of ${view}`, async () =>
      (await page.locator("#export pre").first().textContent()).startsWith("vibro "));
    assert.match(await page.locator("#export pre").last().textContent(), /import vibroimpact/);
    if (["plane", "waveform"].includes(view)) assert.equal((await saved(page, "png")).toString("hex", 0, 4), "89504e47", view);
  }
}

export async function the_command_line_is_that_of_the_view({ open }) {
  const { page } = await open("#view=1,1.5,1,2&starts=3&restitution=0.6", { full: true });
  await drawn(page);
  await page.keyboard.press("e");
  await until("the command is there", async () => (await page.locator("#export pre").first().textContent()).length > 10);
  const command = await page.locator("#export pre").first().textContent();
  for (const part of ["vibro map", "--inverse-beta", "1:1.5:200", "--gap", "1:2:200", "--starts", "3", "--restitution", "0.6", "--impacts", "20000"]) {
    assert.ok(command.includes(part), `${part} in: ${command}`);
  }
}

/** The command and the table of each panel belong to that panel. */
export async function f10_panels_export_what_they_show({ open }) {
  const { page } = await open("#point=1&inverse_beta=1.3&gap=0.75");
  await until("the panels are drawn", async () => (await pictures(page)) >= 4);
  for (const [panel, view, python, head] of [
    ["phase portrait", "phase", "motion.waveform()", "time,x,v,phase"],
    ["multipliers", "multipliers", "motion.multipliers", "re,im"],
    ["impact map and stroboscopic section", "sections", "vi.lyapunov(osc, x=0, points=2000).plot_sections()", "section,stop,phase,speed,x,v"],
  ]) {
    await page.locator(`#point button[aria-label="Export ${panel}"]`).click();
    await until(`the command of ${view}`, async () =>
      (await page.locator("#export pre").first().textContent()).endsWith(`--show ${view} --plot ${view}.svg`));
    assert.ok((await page.locator("#export pre").last().textContent()).includes(python), python);
    assert.equal((await saved(page, "csv")).toString().split("\n")[0], head);
    await page.locator("#export [data-close]").click();
  }
}

/** Runs an exported command of the shell with a table (`csv`) or a figure (`plot`) as its output, and returns that. */
async function outputOf(command, folder, kind) {
  const program = await readlink(`/proc/${process.env.VIBRO_PID}/exe`);
  const file = `${folder}/${kind === "csv" ? "table.csv" : "figure.svg"}`;
  assert.match(command, /^vibro /);
  const line = `${command.replace(/^vibro/, `'${program}'`).replace(/--(csv|plot) \S+/g, "")} --${kind} '${file}' --force`;
  await promisify(execFile)("sh", ["-c", line], { cwd: folder });
  return readFile(file, "utf8");
}

/** The figure that the page asks for when it acts, in the size of the command. */
async function figureOfCommand(page, address, act) {
  const asked = page.waitForRequest((request) => /\/api\/(figure|bifurcation)\?/.test(request.url()));
  await act();
  const request = await asked;
  const { pathname, searchParams: query } = new URL(request.url());
  for (const name of ["width", "height"]) query.delete(name);
  const response = await fetch(new URL(`${pathname}?${query}`, address), {
    method: "POST", headers: { "content-type": "application/json" }, body: request.postData(),
  });
  assert.ok(response.ok, await response.clone().text());
  return response.text();
}

/** Figures and tables in the colours of a quantity, of many points, and of a machine are those of their commands. */
// regions take seconds for each figure, so one of them has regions, and only in the long run; tests/cli/overlays.rs has them
export async function figures_of_quantities_and_machines_are_those_of_their_commands({ open, address }) {
  if (!process.env.VIBRO_PID) return;
  const folder = await mkdtemp(`${tmpdir()}/vibro-e2e-`);
  const window = "view=1.25,1.35,0.7,0.8&impacts=200&layers=stripes";
  const regions = process.env.VIBROIMPACT_LONG === "1" ? "regions," : "";
  try {
    for (const [hash, points, wanted] of [
      [`#${window}&colour=power&range=0,0.5&starts=2&of=smallest`, FEW, /--colour power --of smallest --colour-range 0:0\.5 --plot/],
      ["#view=1.25,1.35,1.4,1.6&impacts=200&layers=stripes&starts=2", "80", /:80 (?!.*--refine).* --plot/],
      [`#${window}&machine=0.8,12000,30&colour=power`, FEW, /--mass-kg 0\.8 .*--frequency-hz \S+:20 .*--colour power/],
      ["#view=1,1.5,0.5,2.5&impacts=200&point=1&inverse_beta=1.3&gap=1&line=1.1,1.5,1.1,2.2&panel=line&layers=paper,amplitude,boundaries", FEW,
        /--layers amplitude,paper,boundaries --mark 1\.3,1 --line 1\.1,1\.5:1\.1,2\.2 --plot/],
      [`#machine=0.8,12000,30&x=beta&point=1&beta=0.77&gap=0.75&view=0.74,0.82,0.6,1&impacts=200&layers=${regions}paper,amplitude,stripes`, FEW,
        new RegExp(`--mass-kg 0\\.8 .*--layers ${regions}amplitude,paper,stripes --mark \\S+,0\\.001875 --plot`)],
    ]) {
      const { page } = await open(hash, TINY);
      await page.waitForSelector("#plane[data-picture]");
      if (hash.includes("colour")) await page.waitForSelector("#legend .bar-colours[data-range]");
      // the range of the colours in the command is that of the tiles that are there, so it changes until all are
      await sharp(page);
      await page.locator("#export-button").click();
      await choosePoints(page, points);
      const text = page.locator("#export pre").first();
      await until(`the command ${wanted}`, async () => wanted.test(await text.textContent()));
      const [table, figure] = (await text.textContent()).split("\n");
      const svg = await figureOfCommand(page, address, () => saved(page, "svg"));
      assert.equal(await outputOf(figure, folder, "plot"), svg, hash);
      if (points === FEW) assert.equal(await outputOf(table, folder, "csv"), (await saved(page, "csv")).toString(), hash);
    }
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/** The tables and the figures of every view: those of motions; and of a machine, in its units, in the colours of a quantity. */
export async function every_export_is_that_of_its_command({ open, address }) {
  if (!process.env.VIBRO_PID) {
    console.log("        skipped: VIBRO_PID does not say which program the server is");
    return;
  }
  const folder = await mkdtemp(`${tmpdir()}/vibro-e2e-`);
  try {
    for (const [hash, system, head] of [
      ["#point=1&inverse_beta=1.3&gap=0.75&view=1,1.4,0.4,2.2&line=1.3,1,1.2,2&starts=2&layers=stripes&impacts=200", "--restitution 0.5", /./],
      ["#machine=0.8,12000,30&x=beta&point=1&beta=0.77&gap=0.75&damping=0.02&start=0.1,0.2,0.3&view=0.7,1,0.4,2.2&line=0.7,1,0.8,1.2&layers=stripes&impacts=200&colour=displacement_max",
        "--mass-kg 0.8", /_(hz|m|s|m_per_s)\b|^re,im$|^section,/],
    ]) {
      const { page } = await open(hash, TINY);
      await drawn(page, hash.includes("colour"));
      await page.waitForSelector("#point .note:not(:empty)");
      if (hash.includes("colour")) await page.waitForSelector("[data-name=basin] .bar-colours[data-range]");
      // the range of the colours in the command is that of the tiles that are there, so it changes until all are
      if (hash.includes("colour")) await sharp(page);
      await page.locator("#export-button").click();
      await choosePoints(page, FEW);
      const views = await page.$$eval("#export-view option", (options) => options.map((option) => option.value));
      assert.ok(views.length >= 10, views.join());
      for (const view of views) {
        const command = page.locator("#export pre").first();
        const before = await command.textContent();
        await page.locator("#export-view").selectOption(view);
        await until(`the command of ${view}`, async () => {
          const text = await command.textContent();
          return text.startsWith("vibro ") && text.includes(system) && (view === views[0] || text !== before);
        });
        const commands = (await command.textContent()).trim().split("\n");
        const saidByPage = (await saved(page, "csv")).toString();
        assert.match(saidByPage.split("\n")[0], head, view);
        assert.ok(saidByPage.split("\n").length > 2, view);
        assert.equal(await outputOf(commands[0], folder, "csv"), saidByPage, `${view} ${hash}`);
        if (view === "attractors") continue;
        const svg = await figureOfCommand(page, address, () => saved(page, "svg"));
        assert.equal(await outputOf(commands.at(-1), folder, "plot"), svg, `${view} ${hash}`);
      }
    }
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}
