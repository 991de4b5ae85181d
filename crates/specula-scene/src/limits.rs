//! Limits on what is read.

/// Limits on what is read. What exceeds one is an error of kind
/// [`ErrorKind::Limit`](crate::ErrorKind::Limit), or of the thing's own kind, that names the limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Limits {
    /// Deepest nesting of files and of references; blocks within a file nest 16 times as deep.
    pub max_depth: usize,
    /// Most bytes of one file, after unpacking.
    pub max_bytes: u64,
    /// Most pixels of one picture.
    pub max_pixels: u64,
    /// Most vertices, and most triangles, of one mesh; also of what a shape is tessellated into.
    pub max_vertices: u64,
    /// Most triangles that a scene's surfaces are subdivided into, all together.
    pub max_subdivided: u64,
    /// Most files that a scene's own file includes, directly or not; one counts as often as it is
    /// included.
    pub max_files: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            max_depth: 64,
            max_bytes: 4 << 30,
            max_pixels: 1 << 28,
            max_vertices: 1 << 28,
            max_subdivided: 1 << 24,
            max_files: 20_000,
        }
    }
}

impl Limits {
    /// Limits for hostile files: small enough that no file takes a second or a gibibyte.
    #[must_use]
    pub const fn strict() -> Self {
        Self {
            max_depth: 16,
            max_bytes: 16 << 20,
            max_pixels: 1 << 20,
            max_vertices: 1 << 18,
            max_subdivided: 1 << 18,
            max_files: 1000,
        }
    }
}

/// The end of messages about an exceeded limit, and the option of the command line that raises it.
const OPTIONS: [(&str, &str); 4] = [
    ("(`max_depth`)", "--limit-nesting N"),
    ("(`max_bytes`)", "--limit-bytes SIZE"),
    ("(`max_pixels`)", "--limit-pixels N"),
    ("(`max_vertices`)", "--limit-vertices N"),
];

/// Help for a message that a limit is exceeded: such messages end with the name of the
/// limit, whatever readers wrap them in.
pub(crate) fn help(message: &str) -> Option<String> {
    let (_, option) = OPTIONS.iter().find(|(name, _)| message.contains(name))?;
    Some(format!(
        "if the file is sound, `{option}` raises this limit (`Limits` in code)"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_lead_to_options() {
        let help = help("has more than 10 bytes (`max_bytes`)").unwrap();
        assert!(help.contains("`--limit-bytes SIZE`"), "{help}");
        assert_eq!(super::help("has more than 10 bytes"), None);
    }
}
