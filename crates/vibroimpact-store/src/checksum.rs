//! The CRC-32C at the end of chunks, of indices of shards and of begun tiles: a truncated object or a flipped bit is
//! detected by it.

/// Number of bytes of a checksum.
pub(crate) const LENGTH: usize = 4;

/// Appends the checksum of some bytes to them.
pub(crate) fn append(bytes: &mut Vec<u8>) {
    let check = crc32c::crc32c(bytes);
    bytes.extend(check.to_le_bytes());
}

/// The bytes before the checksum in which they end; `None` if it is not theirs.
pub(crate) fn content(bytes: &[u8]) -> Option<&[u8]> {
    let (content, check) = bytes.split_last_chunk()?;
    (crc32c::crc32c(content).to_le_bytes() == *check).then_some(content)
}
