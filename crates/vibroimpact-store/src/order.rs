//! The order in which tiles are computed: from coarse to fine, so that the tiles that are done early are spread over the
//! whole grid.

use crate::shards::Shards;
use vibroimpact_study::Grid;

/// The given places in the order from coarse to fine: first the tile at the origin, then those that halve the spacing
/// along every dimension, and so on. `turn` rotates the places of each level, so that processes that start at the same time
/// begin at different places.
pub(crate) fn coarse_to_fine<T: Copy>(
    along: &[usize],
    places: impl IntoIterator<Item = (T, Vec<usize>)>,
    turn: usize,
) -> Vec<T> {
    let mut levels: Vec<Vec<T>> = Vec::new();
    for (which, place) in places {
        let level = level(along, &place);
        if levels.len() <= level {
            levels.resize_with(level + 1, Vec::new);
        }
        levels[level].push(which);
    }
    for level in levels.iter_mut().filter(|level| !level.is_empty()) {
        let turn = turn % level.len();
        level.rotate_left(turn);
    }
    levels.concat()
}

/// How often the spacing must be halved until it meets a place.
fn level(along: &[usize], place: &[usize]) -> usize {
    let of = |(count, at): (&usize, &usize)| match *at {
        0 => 0,
        at => count.next_power_of_two().trailing_zeros().saturating_sub(at.trailing_zeros()) as usize,
    };
    along.iter().zip(place).map(of).max().unwrap_or(0)
}

/// The tiles of a grid in the order from coarse to fine. With shards, the tiles of a shard come one after another, so that
/// few tiles wait for the others of their shard.
pub(crate) fn tiles(grid: &Grid, shards: Option<&Shards>, tiles: &[u64], turn: usize) -> Vec<u64> {
    if let Some(shards) = shards {
        let mut of_shard = shards.grouped(tiles);
        let order = coarse_to_fine(&shards.along(), of_shard.keys().map(|shard| (*shard, shards.place(*shard))), turn);
        let in_turn = |shard: &u64| {
            let mut tiles = of_shard.remove(shard).unwrap_or_default();
            let turn = turn % tiles.len().max(1);
            tiles.rotate_left(turn);
            tiles
        };
        return order.iter().flat_map(in_turn).collect();
    }
    coarse_to_fine(&grid.tiles_along(), tiles.iter().map(|tile| (*tile, grid.place(*tile))), turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::Dimension;

    #[test]
    fn early_tiles_are_spread_over_the_grid() {
        let dimension = |name: &str, count| Dimension { name: name.into(), count, tile: 1 };
        let grid = Grid { dimensions: vec![dimension("gap", 8), dimension("x", 6)] };
        let all: Vec<u64> = (0..grid.tiles()).collect();
        let order = tiles(&grid, None, &all, 0);
        // a tile after 1, the corners of a grid with spacing 4 after 4, all with even places after 12
        assert_eq!(order[..4], [0, 4, 24, 28]);
        assert!(order[..12].iter().all(|tile| grid.place(*tile).iter().all(|at| at % 2 == 0)), "{order:?}");
        for turn in [0, 1, 5, 1000] {
            let mut order = tiles(&grid, None, &all, turn);
            assert_eq!(order[0], 0);
            order.sort_unstable();
            assert_eq!(order, all);
        }
        let few = tiles(&grid, None, &[3, 9, 40], 0);
        assert_eq!(few.len(), 3);
        assert!(tiles(&grid, None, &[], 3).is_empty());
        let shards = Shards::of(&grid, Some(2)).unwrap();
        let mut order = tiles(&grid, Some(&shards), &all, 1);
        assert!(order.chunks(4).all(|four| four.iter().all(|tile| shards.of_tile(*tile) == shards.of_tile(four[0]))));
        order.sort_unstable();
        assert_eq!(order, all);
    }
}
