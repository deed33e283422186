/** The queue of requests for tiles. */

/**
 * A queue of requests in the order of their rank, with a few running at a time. Each owner repeatedly declares the
 * requests it needs; requests that it no longer needs are cancelled.
 *
 * @typedef {object} Job
 * @property {string} key
 * @property {number} rank
 * @property {boolean} [kept] whether it is finished even if it is no longer needed
 * @property {(signal: AbortSignal) => Promise<void>} run
 */
export class Queue {
  constructor(most = 3) {
    this.most = most;
    this.waiting = new Map();
    this.running = new Map();
    this.paused = false;
    /** Requests of this rank and above do not begin. */
    this.below = Infinity;
  }

  /** @param {object} owner @param {Job[]} jobs all requests that it needs */
  want(owner, jobs) {
    const keys = new Set(jobs.map((job) => job.key));
    for (const [key, { owner: of, job, control }] of this.running) {
      if (of === owner && !keys.has(key) && !job.kept) control.abort();
    }
    this.waiting.set(owner, jobs.filter((job) => !this.running.has(job.key)));
    this.pump();
  }

  /** Requests begin only if their rank is below this number. */
  only(below) {
    this.below = below;
    this.pump();
  }

  /** Cancels what runs, and begins nothing until it is called with false. */
  pause(paused) {
    this.paused = paused;
    if (paused) for (const { control } of this.running.values()) control.abort();
    this.pump();
  }

  pump() {
    while (!this.paused && this.running.size < this.most) {
      const all = [...this.waiting.entries()].flatMap(([owner, jobs]) => jobs.map((job) => ({ owner, job })))
        .filter(({ job }) => job.rank < this.below);
      if (!all.length) return;
      const { owner, job } = all.reduce((best, other) => (other.job.rank < best.job.rank ? other : best));
      this.waiting.set(owner, this.waiting.get(owner).filter((other) => other !== job));
      const control = new AbortController();
      this.running.set(job.key, { owner, job, control });
      job.run(control.signal).finally(() => {
        this.running.delete(job.key);
        this.pump();
      });
    }
  }
}
