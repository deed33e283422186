/** Tests of error messages. */

import assert from "node:assert/strict";
import { drawn, enter, until } from "./page.mjs";

export async function what_the_server_refuses_is_said({ open }) {
  // with this second stop there is no room for the mass at the chosen point
  const { page, complaints } = await open("#point=1&gap=0.5&second=1&second_gap=-1");
  await until("the sentence of the server", async () => /leave the mass no room/.test(await page.locator("#strip").textContent()));
  await page.locator("#strip button", { hasText: "Close" }).click();
  assert.ok(await page.locator("#strip").isHidden());
  // the browser reports every answer with an error status
  complaints.splice(0, complaints.length, ...complaints.filter((one) => !/status of 4\d\d/.test(one)));
}

export async function a_server_that_is_gone_is_said_and_found_again({ open }) {
  const { page, complaints } = await open();
  await drawn(page);
  await page.route("**/api/**", (route) => route.abort("connectionrefused"));
  await enter(page.locator("#field-restitution"), "0.7");
  await until("it is said", async () => (await page.locator("#strip").textContent()).includes("The server has stopped; start `vibro explore` again."));
  await page.locator("#strip button", { hasText: "Retry" }).click();
  await page.waitForTimeout(300);
  assert.ok(await page.locator("#strip").isVisible(), "still gone");
  // the page finds it again by itself
  const asked = page.waitForResponse((response) => response.url().endsWith("/api/tile") && response.ok());
  await page.unroute("**/api/**");
  await asked;
  await until("the message is gone", () => page.locator("#strip").isHidden());
  complaints.splice(0, complaints.length, ...complaints.filter((one) => !/ERR_CONNECTION_REFUSED/.test(one)));
}

export async function a_view_of_nothing_legal_is_said({ open }) {
  const { page } = await open("#x=restitution&view=1.1,1.3,1,2");
  await until("it is said", async () => (await page.locator("#legend .note").textContent()) === "No legal values in view.");
  await page.locator("#whole").click();
  await drawn(page);
}

export async function a_second_stop_leaves_the_layers_a_legal_window({ open }) {
  const { page } = await open("#second=1&second_gap=0.2&layers=amplitude");
  await drawn(page);
  await until("the curve is there", async () =>
    (await page.$$eval("#layers .soft", (parts) => parts.map((part) => part.textContent).join(""))) === "");
  await page.waitForTimeout(800);
  assert.ok(await page.locator("#strip").isHidden(), await page.locator("#strip").textContent());
}
