//! Whole files, decompressed where their name ends in `.gz`.

use std::fs::File;
use std::io::{Error, Read};
use std::path::Path;

use crate::Limits;

/// Reads a file; one whose name ends in `.gz` is unpacked.
///
/// # Errors
///
/// A message without the file's name.
pub(crate) fn read_bytes(path: &Path, limits: &Limits) -> Result<Vec<u8>, String> {
    let bytes = plain_bytes(path, limits)?;
    let packed = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    if packed {
        unpack(&bytes, limits)
    } else {
        Ok(bytes)
    }
}

/// Reads a file as it is.
///
/// # Errors
///
/// A message without the file's name.
pub(crate) fn plain_bytes(path: &Path, limits: &Limits) -> Result<Vec<u8>, String> {
    let most = limits.max_bytes;
    let unreadable = |e: Error| format!("cannot be read: {e}");
    let file = File::open(path).map_err(unreadable)?;
    let promised = file.metadata().map_err(unreadable)?.len();
    let too_long = || format!("has more than {most} bytes (`max_bytes`)");
    if promised > most {
        return Err(too_long());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(promised).unwrap_or(0));
    // A pipe or a device promises nothing.
    file.take(most.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > most {
        return Err(too_long());
    }
    Ok(bytes)
}

fn unpack(bytes: &[u8], limits: &Limits) -> Result<Vec<u8>, String> {
    let most = limits.max_bytes;
    let mut unpacked = Vec::with_capacity(bytes.len().saturating_mul(3));
    flate2::read::MultiGzDecoder::new(bytes)
        .take(most.saturating_add(1))
        .read_to_end(&mut unpacked)
        .map_err(|e| format!("cannot be unpacked: {e}"))?;
    if unpacked.len() as u64 > most {
        return Err(format!("unpacks to more than {most} bytes (`max_bytes`)"));
    }
    Ok(unpacked)
}
