/** The cache of tiles. */

/** A cache of the most recently used tiles. */
export class Cache {
  constructor(most = 400) {
    this.most = most;
    this.tiles = new Map();
  }

  get(key) {
    const tile = this.tiles.get(key);
    if (tile) {
      this.tiles.delete(key);
      this.tiles.set(key, tile);
    }
    return tile;
  }

  has(key) {
    return this.tiles.has(key);
  }

  delete(key) {
    this.tiles.delete(key);
  }

  set(key, tile) {
    this.tiles.set(key, tile);
    for (const oldest of this.tiles.keys()) {
      if (this.tiles.size <= this.most) break;
      this.tiles.delete(oldest);
    }
  }

  /** @returns {Iterable<import("./tiles.js").Tile>} all tiles */
  all() {
    return this.tiles.values();
  }
}
