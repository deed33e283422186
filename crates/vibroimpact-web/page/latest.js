/** One question at a time: of several asked in the meantime only the newest is put. */
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
   * Asks after the question that is under way, or instead of it.
   * @param {any} argument
   * @param {boolean} [instead] give up the one under way
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

  /** Gives up what is under way and what waits. */
  stop() {
    this.next = null;
    this.running?.abort();
  }
}
