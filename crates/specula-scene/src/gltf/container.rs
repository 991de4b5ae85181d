//! The binary container of glTF 2.0 (`.glb`): a header and two chunks, every length checked.

/// `glTF`, the first four bytes.
const MAGIC: &[u8; 4] = b"glTF";

/// What a file holds: the JSON document, and the binary chunk where there is one.
#[derive(Debug, PartialEq)]
pub(super) struct ContainerParts<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
}

/// Splits a file. Bytes without the container's magic number are taken as JSON.
///
/// # Errors
///
/// Where a header, version, length or chunk type is not as glTF 2.0, section 4.4, asks.
pub(super) fn split(bytes: &[u8]) -> Result<ContainerParts<'_>, String> {
    if !bytes.starts_with(MAGIC) {
        return Ok(ContainerParts {
            json: bytes,
            binary: None,
        });
    }
    let header = |at| number(bytes, at).ok_or("cut off in its header of 12 bytes".to_owned());
    let version = header(4)?;
    if version != 2 {
        return Err(format!(
            "expected version 2 of the container, found {version}"
        ));
    }
    let length = header(8)? as usize;
    if length > bytes.len() {
        return Err(format!(
            "cut off: its header tells of {length} bytes, the file has {}",
            bytes.len()
        ));
    }
    let mut rest = bytes[..length]
        .get(12..)
        .ok_or_else(|| format!("its header tells of {length} bytes: expected at least 12"))?;
    let json = chunk(&mut rest, *b"JSON")?.ok_or("expected a JSON chunk first")?;
    let binary = chunk(&mut rest, *b"BIN\0")?;
    Ok(ContainerParts { json, binary })
}

/// The next chunk if it is of the type asked for; later chunks of other types are for extensions.
fn chunk<'a>(rest: &mut &'a [u8], kind: [u8; 4]) -> Result<Option<&'a [u8]>, String> {
    if rest.len() < 8 || rest[4..8] != kind {
        return Ok(None);
    }
    let length = number(rest, 0).map_or(0, |n| n as usize);
    let content = rest[8..].get(..length).ok_or_else(|| {
        format!(
            "a chunk tells of {length} bytes where {} are left",
            rest.len() - 8
        )
    })?;
    *rest = &rest[8 + length..];
    Ok(Some(content))
}

/// Four bytes, little endian.
fn number(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(length: u32, chunks: &[(&[u8; 4], u32, &[u8])]) -> Vec<u8> {
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend(length.to_le_bytes());
        for (kind, length, content) in chunks {
            bytes.extend(length.to_le_bytes());
            bytes.extend(*kind);
            bytes.extend(*content);
        }
        bytes
    }

    #[test]
    fn both_chunks_or_one() {
        let both = file(40, &[(b"JSON", 4, b"{}  "), (b"BIN\0", 8, &[7; 8])]);
        let parts = split(&both).unwrap();
        assert_eq!(
            (parts.json, parts.binary),
            (&b"{}  "[..], Some(&[7; 8][..]))
        );
        let one = file(24, &[(b"JSON", 4, b"{}  ")]);
        assert_eq!(split(&one).unwrap().binary, None);
        assert_eq!(split(b"{}").unwrap().json, b"{}");
    }

    #[test]
    fn lengths_that_lie_are_errors() {
        let found = include_bytes!("../../tests/findings/gltf-short-length.glb");
        assert!(split(found).is_err());
        let json: &[(&[u8; 4], u32, &[u8])] = &[(b"JSON", 4, b"{}  ")];
        for length in [0, 5, 11, 25, u32::MAX] {
            assert!(split(&file(length, json)).is_err(), "{length}");
        }
        for chunk in [5, u32::MAX] {
            assert!(split(&file(24, &[(b"JSON", chunk, b"{}  ")])).is_err());
        }
        assert!(split(&file(24, &[(b"BIN\0", 4, b"{}  ")])).is_err());
        let whole = file(24, json);
        for cut in 4..24 {
            assert!(split(&whole[..cut]).is_err(), "{cut}");
        }
        let mut other = whole;
        other[4] = 1;
        assert!(split(&other).unwrap_err().contains("version 2"));
    }
}
