//! Moving the selected ones of eight elements to the front, without branches that depend on data.

/// For every byte, the positions of its set bits, in order.
pub(super) const PLACES_OF_BITS: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut bit, mut count) = (0_u8, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                table[byte][count] = bit;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    table
};

/// Writes the slots whose bits are set, of sixteen slots counted from `first`, to the beginning of `places`, which must
/// have room for sixteen, and returns their number.
#[inline(always)]
pub(super) fn list(bits: u32, first: usize, places: &mut [u32]) -> usize {
    let low = eight(bits, first, places);
    low + eight(bits >> 8, first + 8, &mut places[low..])
}

#[inline(always)]
fn eight(bits: u32, first: usize, places: &mut [u32]) -> usize {
    if let Some(places) = places.first_chunk_mut::<8>() {
        for (place, offset) in places.iter_mut().zip(&PLACES_OF_BITS[(bits & 0xff) as usize]) {
            #[allow(clippy::cast_possible_truncation)] // slot numbers
            let first = first as u32;
            *place = first + u32::from(*offset);
        }
    }
    (bits & 0xff).count_ones() as usize
}
