/** A cache of what was used most recently: tiles, motions. */
export class Cache {
  constructor(most = 400) {
    this.most = most;
    this.kept = new Map();
  }

  get(key) {
    const found = this.kept.get(key);
    if (found) {
      this.kept.delete(key);
      this.kept.set(key, found);
    }
    return found;
  }

  delete(key) {
    this.kept.delete(key);
  }

  set(key, found) {
    this.kept.set(key, found);
    for (const oldest of this.kept.keys()) {
      if (this.kept.size <= this.most) break;
      this.kept.delete(oldest);
    }
  }

  /** @returns {Iterable<any>} all that is there */
  all() {
    return this.kept.values();
  }
}
