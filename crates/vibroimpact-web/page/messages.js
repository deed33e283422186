/** The strip for error messages, and the live region for screen readers. */

import { about, ServerGone } from "./api.js";
import { byId, element } from "./dom.js";

/** Time between attempts to reach a server that is gone, in milliseconds. */
const AGAIN = 1500;

export class Messages {
  /** @param {() => void} again called when the server answers again, or the user wants to retry */
  constructor(again) {
    this.again = again;
    this.strip = byId("strip");
    this.live = byId("live");
    this.gone = false;
  }

  /** @param {Error} error */
  failed(error) {
    if (error.name === "AbortError") return;
    const gone = error instanceof ServerGone;
    if (this.gone && !gone) return;
    this.gone = gone;
    if (gone) this.reconnect();
    this.put(error.message, element("button", { type: "button", text: "Retry", onclick: () => this.retry() }));
  }

  /** Shows a sentence and its hints. */
  put(message, ...buttons) {
    const [first, ...rest] = message.split("\n");
    const text = element("p", {}, element("span", { text: first }));
    for (const line of rest) text.append(element("span", { class: "hint", text: line }));
    this.strip.replaceChildren(
      text,
      ...buttons,
      element("button", { type: "button", class: "quiet", text: "Close", onclick: () => this.clear() }),
    );
    this.strip.hidden = false;
  }

  async retry() {
    try {
      await about();
    } catch (error) {
      this.failed(error);
      return;
    }
    this.clear();
    this.again();
  }

  /** Looks for the server until it answers again. */
  reconnect() {
    clearTimeout(this.timer);
    this.timer = setTimeout(async () => {
      if (!this.gone) return;
      if (document.hidden) this.reconnect();
      else await this.retry();
    }, AGAIN);
  }

  clear() {
    this.gone = false;
    this.strip.hidden = true;
    this.strip.replaceChildren();
  }

  /** @param {string} text message for screen readers */
  say(text) {
    this.live.textContent = text;
  }
}
