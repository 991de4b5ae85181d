//! Whole files, decompressed where their name ends in `.gz`.

use std::io::Read;
use std::path::Path;

/// Most bytes that a file may unpack to; more is taken for a bomb.
const MAX_BYTES: u64 = 4 << 30;

/// Reads a file.
///
/// # Errors
///
/// A message without the file's name.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("cannot be read: {e}"))?;
    if path
        .extension()
        .is_none_or(|e| !e.eq_ignore_ascii_case("gz"))
    {
        return Ok(bytes);
    }
    let mut unpacked = Vec::with_capacity(bytes.len().saturating_mul(3));
    flate2::read::MultiGzDecoder::new(bytes.as_slice())
        .take(MAX_BYTES + 1)
        .read_to_end(&mut unpacked)
        .map_err(|e| format!("cannot be unpacked: {e}"))?;
    if unpacked.len() as u64 > MAX_BYTES {
        return Err(format!("unpacks to more than {MAX_BYTES} bytes"));
    }
    Ok(unpacked)
}
