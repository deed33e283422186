//! The values of a chunk as bytes: the codecs of Zarr `bytes` (little-endian numbers) or `vlen-utf8` (texts), then `zstd`,
//! then `crc32c`.
//!
//! Not-a-number always has the same bit pattern.

use crate::checksum;
use std::io;
use vibroimpact_study::study::Cells;
use vibroimpact_study::{Column, NumberType};

/// Compression level; higher levels take more time and save little on these data.
pub(crate) const LEVEL: i32 = 3;

/// Maximum number of bytes of texts after decompression. A damaged chunk may state any number.
const MOST_TEXT: usize = 1 << 28;

/// The description of an internal error that should not occur, or of damage.
pub(crate) type Defect = String;

/// The type of the values of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Numbers.
    Numbers(NumberType),
    /// Texts.
    Text,
}

impl Holds {
    /// The type of some values.
    pub(crate) const fn of(values: &Cells) -> Self {
        match values {
            Cells::Numbers(column) => Self::Numbers(column.kind()),
            Cells::Text(_) => Self::Text,
        }
    }
}

/// The bytes of a chunk from its values.
pub(crate) fn encode(values: &Cells) -> Result<Vec<u8>, Defect> {
    let plain = match values {
        Cells::Numbers(column) => column.to_bytes(),
        Cells::Text(words) => from_texts(words)?,
    };
    let mut chunk = zstd::bulk::compress(&plain, LEVEL).map_err(|error| error.to_string())?;
    checksum::append(&mut chunk);
    // the buffer of the compressor is as large as the values
    chunk.shrink_to_fit();
    Ok(chunk)
}

/// The values of a chunk from its bytes, or a description of the damage. `count` is the number of values.
pub(crate) fn decode(kind: Holds, count: usize, chunk: &[u8]) -> Result<Cells, Defect> {
    let frame = checksum::content(chunk).ok_or("its checksum is wrong")?;
    let Holds::Numbers(kind) = kind else {
        return into_texts(&decompressed(frame, MOST_TEXT)?, count).map(Cells::Text);
    };
    let size = count.checked_mul(kind.size()).ok_or("it has too many values")?;
    let plain = decompressed(frame, size)?;
    if plain.len() != size {
        return Err(format!("it has {} bytes of values instead of {size}", plain.len()));
    }
    Ok(Cells::Numbers(Column::from_bytes(kind, &plain)))
}

/// The content of a frame of Zstandard, which has at most `most` bytes. The memory for them is bounded by this number and
/// by the blocks of the frame.
fn decompressed(frame: &[u8], most: usize) -> Result<Vec<u8>, Defect> {
    zstd::bulk::decompress(frame, most).map_err(|error: io::Error| error.to_string())
}

/// Texts as bytes: their number, then each with its length before it.
fn from_texts(words: &[String]) -> Result<Vec<u8>, Defect> {
    let length = |n: usize| u32::try_from(n).map(u32::to_le_bytes).map_err(|error| error.to_string());
    let mut bytes = length(words.len())?.to_vec();
    for word in words {
        bytes.extend(length(word.len())?);
        bytes.extend(word.as_bytes());
    }
    Ok(bytes)
}

/// The inverse of [`from_texts`].
fn into_texts(bytes: &[u8], count: usize) -> Result<Vec<String>, Defect> {
    let number = |rest: &mut &[u8]| {
        let (number, after) = rest.split_first_chunk()?;
        *rest = after;
        usize::try_from(u32::from_le_bytes(*number)).ok()
    };
    let mut rest = bytes;
    if number(&mut rest) != Some(count) {
        return Err(format!("it does not have {count} texts"));
    }
    let mut words = Vec::new();
    for _ in 0..count {
        let length = number(&mut rest).ok_or("a text is missing")?;
        let (word, after) = rest.split_at_checked(length).ok_or("a text is incomplete")?;
        words.push(String::from_utf8(word.to_vec()).map_err(|error| error.to_string())?);
        rest = after;
    }
    if rest.is_empty() { Ok(words) } else { Err("there are bytes after the last text".into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples() -> [Cells; 5] {
        let texts = |words: &[&str]| Cells::Text(words.iter().map(|word| (*word).to_owned()).collect());
        [
            Cells::Numbers(Column::I8((-128..=127).collect())),
            Cells::Numbers(Column::I32((-300..300).map(|k| k * 7_000_001).collect())),
            Cells::Numbers(Column::F64(vec![0.0, -0.0, 1.5, f64::INFINITY, f64::NAN, f64::MIN_POSITIVE])),
            texts(&["2/1", "", "inf/1 \u{3b2}"]),
            texts(&[]),
        ]
    }

    fn count(values: &Cells) -> usize {
        match values {
            Cells::Numbers(column) => column.len(),
            Cells::Text(words) => words.len(),
        }
    }

    fn sealed(frame: &[u8]) -> Vec<u8> {
        let mut chunk = frame.to_vec();
        checksum::append(&mut chunk);
        chunk
    }

    /// The content of the frame of a chunk.
    fn plain(chunk: &[u8]) -> Vec<u8> {
        zstd::stream::decode_all(checksum::content(chunk).unwrap()).unwrap()
    }

    #[test]
    fn chunks_are_read_again_unless_damaged() {
        for values in samples() {
            let (kind, count, chunk) = (Holds::of(&values), count(&values), encode(&values).unwrap());
            assert_eq!(decode(kind, count, &chunk).as_ref(), Ok(&values));
            for other in [count + 1, count.wrapping_sub(1), 0, usize::MAX] {
                assert!(other == count || decode(kind, other, &chunk).is_err(), "{kind:?} {other}");
            }
            for end in 0..chunk.len() {
                assert!(decode(kind, count, &chunk[..end]).is_err(), "{kind:?} {end}");
                let mut bad = chunk.clone();
                bad[end] ^= 4;
                assert!(decode(kind, count, &bad).is_err(), "{kind:?} {end}");
                // the same within the frame, with a checksum of its own
                let frame = &chunk[..end.min(chunk.len() - checksum::LENGTH - 1)];
                assert!(decode(kind, count, &sealed(frame)).is_err(), "{kind:?} {end}");
            }
        }
    }

    #[test]
    fn not_a_number_has_one_pattern() {
        let other = f64::from_bits(0xfff8_0000_0000_0001);
        let of = |x| encode(&Cells::Numbers(Column::F64(vec![x]))).unwrap();
        assert_eq!(of(other), of(f64::NAN));
        assert_eq!(plain(&of(other)), [0, 0, 0, 0, 0, 0, 0xf8, 0x7f]);
    }

    /// Stores do not change from version to version, nor between processors.
    #[test]
    fn the_bytes_of_a_chunk() {
        let numbers = encode(&Cells::Numbers(Column::I32(vec![1, -1]))).unwrap();
        assert_eq!(plain(&numbers), [1, 0, 0, 0, 255, 255, 255, 255]);
        // a frame of one segment that states its size, without a checksum of Zstandard
        assert_eq!(numbers[..6], [0x28, 0xb5, 0x2f, 0xfd, 0x20, 8]);
        let texts = encode(&Cells::Text(vec!["ab".into(), String::new()])).unwrap();
        assert_eq!(plain(&texts), [2, 0, 0, 0, 2, 0, 0, 0, b'a', b'b', 0, 0, 0, 0]);
    }

    /// Frames of other programs may not state the size of their content, may have a checksum, and may be several.
    #[test]
    fn frames_of_other_programs_are_read() {
        for values in samples() {
            let plain = plain(&encode(&values).unwrap());
            let (first, second) = plain.split_at(plain.len() / 2);
            let unstated = |bytes: &[u8]| zstd::stream::encode_all(bytes, 1).unwrap();
            let mut checked = zstd::bulk::Compressor::new(9).unwrap();
            checked.include_checksum(true).unwrap();
            for frame in [
                unstated(&plain),
                checked.compress(&plain).unwrap(),
                [unstated(first), checked.compress(second).unwrap()].concat(),
            ] {
                assert_eq!(decode(Holds::of(&values), count(&values), &sealed(&frame)).as_ref(), Ok(&values));
            }
        }
    }

    #[test]
    fn frames_cannot_take_much_memory() {
        // the content is stated as 2^60 bytes
        let stated = [0x28, 0xb5, 0x2f, 0xfd, 0xe0, 0, 0, 0, 0, 0, 0, 0, 0x10, 1, 0, 0];
        // a million zeros in some bytes
        let zeros = zstd::stream::encode_all(io::Read::take(io::repeat(0), 1 << 20), 1).unwrap();
        for frame in [stated.to_vec(), zeros] {
            for kind in [Holds::Numbers(NumberType::I8), Holds::Numbers(NumberType::F64), Holds::Text] {
                assert!(decode(kind, 100, &sealed(&frame)).is_err(), "{kind:?}");
            }
        }
    }

    #[test]
    fn texts_that_contradict_their_lengths_are_damaged() {
        for (bytes, count) in [
            (&[1, 0, 0, 0, 2, 0, 0, 0, b'a'][..], 1),
            (&[1, 0, 0, 0, 1, 0, 0, 0, b'a', b'b'], 1),
            (&[1, 0, 0, 0, 1, 0, 0, 0, 0xff], 1),
            (&[255, 255, 255, 255], u32::MAX as usize),
            (&[2, 0, 0, 0, 0, 0, 0, 0], 1),
            (&[], 0),
        ] {
            let frame = zstd::bulk::compress(bytes, LEVEL).unwrap();
            assert!(decode(Holds::Text, count, &sealed(&frame)).is_err(), "{bytes:?}");
        }
    }
}
