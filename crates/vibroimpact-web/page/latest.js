/** Runs one request at a time. Of several requests in the meantime, only the newest is sent. */
export class Latest {
  /**
   * @param {(argument: any, signal: AbortSignal) => Promise<void>} work
   * @param {(error: Error) => void} failed
   */
  constructor(work, failed) {
    this.work = work;
    this.failed = failed;
    this.running = null;
    this.next = null;
  }

  /**
   * Sends a request after the current one, or instead of it.
   * @param {any} argument
   * @param {boolean} [instead] whether to cancel the current one
   */
  ask(argument, instead = false) {
    if (this.running) {
      this.next = { argument };
      if (instead) this.running.abort();
      return;
    }
    const control = new AbortController();
    this.running = control;
    this.work(argument, control.signal)
      .catch((error) => {
        if (!control.signal.aborted) this.failed(error);
      })
      .finally(() => {
        this.running = null;
        const { next } = this;
        this.next = null;
        if (next) this.ask(next.argument);
      });
  }

  /** Cancels the current and the waiting request. */
  stop() {
    this.next = null;
    this.running?.abort();
  }
}
