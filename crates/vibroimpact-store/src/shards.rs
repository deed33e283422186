//! Shards: files that hold the chunks of many tiles, as the codec `sharding_indexed` of Zarr describes them.
//!
//! A shard is the chunks of its tiles one after another, in the order of the tiles, and an index: the offset and the length
//! of each chunk, and a CRC-32C. A tile beyond the edge of the grid has no chunk.
//!
//! A tile is computed alone and written as one object below [`LOOSE`], with the chunks of all its fields. When all tiles of
//! a shard are there, its shards are written (one for each field), then its status, and the objects of its tiles are
//! removed. The bytes of a shard depend only on its chunks, so any number of processes may do this at the same time.

use crate::checksum;
use std::collections::BTreeMap;
use vibroimpact_study::{Grid, number, place};

/// The folder of the objects of tiles whose shards are not complete.
pub(crate) const LOOSE: &str = ".tiles/";

/// Number of tiles up to which a store has no shards by default.
const MOST_FILES: u64 = 4096;
/// Number of shards that a store has at most by default, unless shards would be too large.
const MOST_SHARDS: u64 = 1024;
/// Maximum number of tiles of a shard by default.
const MOST_TILES: u64 = 4096;
/// The offset and the length of a chunk that does not exist.
const NONE: u64 = u64::MAX;
/// Bytes of an entry of the index.
const ENTRY: usize = 16;

/// How the tiles of a grid are grouped into shards.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Shards {
    /// Number of tiles of the grid along each dimension.
    along: Vec<usize>,
    /// Number of tiles of a shard along each dimension.
    pub(crate) side: Vec<usize>,
}

impl Shards {
    /// The shards of a grid with `side` tiles along each axis; by default, none for up to 4096 tiles, and otherwise so that
    /// there are at most 1024. One tile is no shard.
    pub(crate) fn of(grid: &Grid, side: Option<u32>) -> Option<Self> {
        let along = grid.tiles_along();
        let clipped = |side: usize| along.iter().map(|count| side.min(*count)).collect::<Vec<_>>();
        let product = |of: &mut dyn Iterator<Item = usize>| of.fold(1_u64, |all, n| all.saturating_mul(n as u64));
        let side = match side {
            Some(side) => clipped(side as usize),
            None if grid.tiles() <= MOST_FILES => return None,
            None => {
                let mut side = 1;
                let count = |side: usize| product(&mut along.iter().map(|n| n.div_ceil(side)));
                let tiles = |side: usize| product(&mut clipped(side).into_iter());
                while count(side) > MOST_SHARDS && tiles(2 * side) <= MOST_TILES {
                    side *= 2;
                }
                clipped(side)
            }
        };
        side.iter().any(|side| *side > 1).then_some(Self { along, side })
    }

    /// Number of shards along each dimension.
    pub(crate) fn along(&self) -> Vec<usize> {
        self.along.iter().zip(&self.side).map(|(count, side)| count.div_ceil(*side)).collect()
    }

    /// Number of shards.
    pub(crate) fn count(&self) -> u64 {
        self.along().iter().fold(1, |all, n| all * *n as u64)
    }

    /// The position of a shard among the shards.
    pub(crate) fn place(&self, shard: u64) -> Vec<usize> {
        place(&self.along(), shard)
    }

    /// The shard of a tile.
    pub(crate) fn of_tile(&self, tile: u64) -> u64 {
        let at = place(&self.along, tile);
        let at = at.iter().zip(&self.side).map(|(at, side)| at / side);
        number(&self.along(), at)
    }

    /// Number of chunks of a shard, with those beyond the edge of the grid.
    pub(crate) fn chunks(&self) -> usize {
        self.side.iter().product()
    }

    /// The tile of each chunk of a shard; `None` beyond the edge of the grid.
    pub(crate) fn tiles(&self, shard: u64) -> Vec<Option<u64>> {
        let corner = self.place(shard);
        let tile = |chunk: usize| {
            let inside = place(&self.side, chunk as u64);
            let at: Vec<usize> =
                corner.iter().zip(&self.side).zip(&inside).map(|((corner, side), at)| corner * side + at).collect();
            at.iter().zip(&self.along).all(|(at, count)| at < count).then(|| number(&self.along, at))
        };
        (0..self.chunks()).map(tile).collect()
    }

    /// The given tiles by shard.
    pub(crate) fn grouped(&self, tiles: &[u64]) -> BTreeMap<u64, Vec<u64>> {
        let mut of_shard: BTreeMap<u64, Vec<u64>> = BTreeMap::new();
        tiles.iter().for_each(|tile| of_shard.entry(self.of_tile(*tile)).or_default().push(*tile));
        of_shard
    }

    /// The first tile of a shard.
    pub(crate) fn first(&self, shard: u64) -> u64 {
        number(&self.along, self.place(shard).iter().zip(&self.side).map(|(corner, side)| corner * side))
    }

    /// The number of the chunk of a tile in its shard.
    pub(crate) fn chunk(&self, tile: u64) -> usize {
        let at = place(&self.along, tile);
        let at = at.iter().zip(&self.side).map(|(at, side)| at % side);
        usize::try_from(number(&self.side, at)).unwrap_or(0)
    }

    /// The key of the object of a tile whose shard is not complete.
    pub(crate) fn loose_key(&self, tile: u64) -> String {
        format!("{}{tile}", loose_prefix(self.of_tile(tile)))
    }

    /// Number of bytes of the index at the end of a shard.
    pub(crate) fn index_length(&self) -> usize {
        self.chunks() * ENTRY + checksum::LENGTH
    }
}

/// The prefix of the keys of the objects of the tiles of a shard.
pub(crate) fn loose_prefix(shard: u64) -> String {
    format!("{LOOSE}{shard}/")
}

/// The chunks of a shard, in the order of its tiles; `None` for a tile beyond the edge of the grid, or a missing chunk.
pub(crate) type Chunks = Vec<Option<Vec<u8>>>;

/// The bytes of a shard from its chunks.
pub(crate) fn assemble(chunks: &[Option<Vec<u8>>]) -> Vec<u8> {
    let (mut bytes, mut index) = (Vec::new(), Vec::with_capacity(chunks.len() * ENTRY + checksum::LENGTH));
    for chunk in chunks {
        let (offset, length) = match chunk {
            Some(chunk) => (bytes.len() as u64, chunk.len() as u64),
            None => (NONE, NONE),
        };
        index.extend(offset.to_le_bytes());
        index.extend(length.to_le_bytes());
        bytes.extend(chunk.iter().flatten());
    }
    checksum::append(&mut index);
    bytes.extend(index);
    bytes
}

/// The places of the chunks of a shard from its index; `None` if the index is damaged. `length` is that of the shard.
pub(crate) fn index(bytes: &[u8], length: u64) -> Option<Vec<Option<(u64, u64)>>> {
    let entries = checksum::content(bytes).filter(|entries| entries.len() % ENTRY == 0)?;
    let word = |at: &[u8]| at.try_into().map(u64::from_le_bytes).ok();
    let end = length.checked_sub(bytes.len() as u64)?;
    let entry = |entry: &[u8]| -> Option<Option<(u64, u64)>> {
        let (offset, length) = (word(&entry[..8])?, word(&entry[8..])?);
        if (offset, length) == (NONE, NONE) {
            return Some(None);
        }
        (offset.checked_add(length)? <= end).then_some(Some((offset, length)))
    };
    entries.chunks(ENTRY).map(entry).collect()
}

/// The chunks of a shard; `None` if its index is damaged.
pub(crate) fn chunks(bytes: &[u8], index_length: usize) -> Option<Chunks> {
    let tail = bytes.get(bytes.len().checked_sub(index_length)?..)?;
    let chunk = |entry: Option<(u64, u64)>| -> Option<Option<Vec<u8>>> {
        let Some((offset, length)) = entry else { return Some(None) };
        let from = usize::try_from(offset).ok()?;
        Some(Some(bytes.get(from..from.checked_add(usize::try_from(length).ok()?)?)?.to_vec()))
    };
    index(tail, bytes.len() as u64)?.into_iter().map(chunk).collect()
}

/// The object of a tile: the number of its chunks, their lengths, and the chunks, which have checksums of their own.
pub(crate) fn bundle(chunks: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = (chunks.len() as u64).to_le_bytes().to_vec();
    chunks.iter().for_each(|chunk| bytes.extend((chunk.len() as u64).to_le_bytes()));
    chunks.iter().for_each(|chunk| bytes.extend(chunk));
    bytes
}

/// The chunks of the object of a tile; `None` if it is damaged.
pub(crate) fn unbundle(bytes: &[u8]) -> Option<Vec<Vec<u8>>> {
    let word = |k: usize| Some(u64::from_le_bytes(bytes.get(8 * k..8 * k + 8)?.try_into().ok()?));
    let count = usize::try_from(word(0)?).ok().filter(|count| *count < bytes.len())?;
    let mut rest = bytes.get(8 * (count + 1)..)?;
    let mut chunks = Vec::with_capacity(count);
    for k in 1..=count {
        let (chunk, after) = rest.split_at_checked(usize::try_from(word(k)?).ok()?)?;
        chunks.push(chunk.to_vec());
        rest = after;
    }
    rest.is_empty().then_some(chunks)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::Dimension;

    fn grid(counts: [usize; 2], tile: usize) -> Grid {
        let dimension = |(name, count): (&str, usize)| Dimension { name: name.into(), count, tile };
        Grid { dimensions: ["gap", "x"].into_iter().zip(counts).map(dimension).collect() }
    }

    #[test]
    fn tiles_belong_to_one_shard() {
        let grid = grid([50, 70], 10);
        let shards = Shards::of(&grid, Some(3)).unwrap();
        assert_eq!((shards.along(), shards.count(), shards.chunks()), (vec![2, 3], 6, 9));
        let mut seen = vec![0; 35];
        for shard in 0..shards.count() {
            for (chunk, tile) in shards.tiles(shard).into_iter().enumerate() {
                let Some(tile) = tile else { continue };
                seen[usize::try_from(tile).unwrap()] += 1;
                assert_eq!((shards.of_tile(tile), shards.chunk(tile)), (shard, chunk));
            }
        }
        assert_eq!(seen, [1; 35]);
        assert_eq!(shards.loose_key(34), ".tiles/5/34");
    }

    #[test]
    fn large_grids_have_few_shards_by_default() {
        assert_eq!(Shards::of(&grid([640, 640], 10), None), None);
        assert_eq!(Shards::of(&grid([640, 650], 10), Some(1)), None);
        let shards = Shards::of(&grid([640, 650], 10), None).unwrap();
        assert_eq!((shards.side.clone(), shards.count()), (vec![4, 4], 16 * 17));
        // 1e9 points
        let shards = Shards::of(&grid([32_000, 32_000], 16), None).unwrap();
        assert_eq!((shards.side.clone(), shards.count()), (vec![64, 64], 32 * 32));
        // a short side is one shard
        let shards = Shards::of(&grid([2, 100_000], 1), None).unwrap();
        assert_eq!((shards.side.clone(), shards.count()), (vec![2, 128], 782));
    }

    #[test]
    fn damage_of_shards_and_bundles_is_found() {
        let some = |text: &str| Some(text.as_bytes().to_vec());
        let all = [some("one"), None, some(""), some("four")];
        let shard = assemble(&all);
        assert_eq!(shard.len(), 7 + 4 * ENTRY + checksum::LENGTH);
        assert_eq!(chunks(&shard, 4 * ENTRY + checksum::LENGTH).as_deref(), Some(all.as_slice()));
        for k in 7..shard.len() {
            let mut bad = shard.clone();
            bad[k] ^= 16;
            assert_eq!(chunks(&bad, 4 * ENTRY + checksum::LENGTH), None, "{k}");
        }
        assert_eq!(chunks(&shard[1..], 4 * ENTRY + checksum::LENGTH), None);
        assert_eq!(chunks(&shard[..shard.len() - 1], 4 * ENTRY + checksum::LENGTH), None);
        assert_eq!(chunks(&[], 4 * ENTRY + checksum::LENGTH), None);
        let pieces = [b"one".to_vec(), Vec::new(), b"three".to_vec()];
        let bytes = bundle(&pieces);
        assert_eq!(unbundle(&bytes).as_deref(), Some(pieces.as_slice()));
        for end in 0..bytes.len() {
            assert_eq!(unbundle(&bytes[..end]), None, "{end}");
        }
        assert_eq!(unbundle(&[bytes.as_slice(), b"x"].concat()), None);
        assert_eq!(unbundle(&[255; 64]), None);
    }
}
