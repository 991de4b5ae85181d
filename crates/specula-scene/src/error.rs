//! Located errors and warnings.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::limits;

/// The text of a file, stored to show excerpts.
pub struct SourceText {
    name: String,
    text: String,
}

impl fmt::Debug for SourceText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The text may be megabytes long; a debug print is no place for it.
        write!(f, "SourceText({:?}, {} bytes)", self.name, self.text.len())
    }
}

impl SourceText {
    pub(crate) fn new(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self {
            name: name.into(),
            text: text.into(),
        })
    }

    /// A source for a file whose text is unknown.
    pub(crate) fn unread(path: &Path) -> Arc<Self> {
        Self::new(path.display().to_string(), "")
    }

    /// Name of the file, as it was opened.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// A range of bytes in a file. It displays as `file:line:column`.
#[derive(Clone, Debug)]
pub struct Place {
    source: Arc<SourceText>,
    offset: usize,
    length: usize,
}

impl Place {
    pub(crate) fn new(source: &Arc<SourceText>, offset: usize, length: usize) -> Self {
        Self {
            source: Arc::clone(source),
            offset,
            length,
        }
    }

    /// A line, from 1, of a file; the text's end where it has fewer.
    pub(crate) fn of_line(source: &Arc<SourceText>, line: usize) -> Self {
        let mut lines = source.text().split_inclusive('\n');
        let before = lines.by_ref().take(line.saturating_sub(1));
        let offset = before.map(str::len).sum();
        let length = lines.next().map_or(0, |l| l.trim_end().len());
        Self::new(source, offset, length)
    }

    /// The beginning of a file.
    pub(crate) fn start(source: &Arc<SourceText>) -> Self {
        Self::new(source, 0, 0)
    }

    pub(crate) fn shared_source(&self) -> &Arc<SourceText> {
        &self.source
    }

    /// The file.
    pub fn source(&self) -> &SourceText {
        &self.source
    }

    /// First byte within the file's text.
    pub fn offset(&self) -> usize {
        self.offset
    }

    /// Length in bytes.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Line, from 1.
    pub fn line(&self) -> usize {
        self.before().bytes().filter(|&b| b == b'\n').count() + 1
    }

    /// Column in characters, from 1.
    pub fn column(&self) -> usize {
        let before = self.before();
        before[before.rfind('\n').map_or(0, |i| i + 1)..]
            .chars()
            .count()
            + 1
    }

    fn before(&self) -> &str {
        let text = &self.source.text;
        let mut end = self.offset.min(text.len());
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        &text[..end]
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.source.name, self.line(), self.column())
    }
}

/// What kind of thing is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A file cannot be opened or read.
    Io,
    /// A file is not UTF-8 text.
    Encoding,
    /// Text that does not follow the format's grammar.
    Syntax,
    /// A directive that pbrt-v4 does not have.
    UnknownDirective,
    /// A parameter's type, count or value.
    Parameter,
    /// A texture, material or object that is not defined.
    UnknownName,
    /// Something is defined twice.
    Duplicate,
    /// Blocks that do not match, or directives outside of their block.
    Structure,
    /// A file that includes itself.
    RecursiveInclude,
    /// A transform that cannot be inverted or is not finite.
    Transform,
    /// A mesh, inline or in a file.
    Mesh,
    /// A picture.
    Image,
    /// A spectrum.
    Spectrum,
    /// A measured material.
    Measured,
    /// There is nothing to render.
    EmptyScene,
    /// A picture without this feature would be meaningless.
    Unsupported,
    /// A limit of [`Limits`](crate::Limits) is exceeded.
    Limit,
}

/// Why a scene cannot be used, and where.
///
/// It displays as its message alone; [`SceneError::place`] displays as `file:line:column`.
#[derive(Debug, thiserror::Error)]
#[error("{}", .0.message)]
pub struct SceneError(Box<Inner>);

#[derive(Debug)]
struct Inner {
    kind: ErrorKind,
    message: String,
    help: Option<String>,
    place: Place,
    missing: Vec<MissingFile>,
}

impl SceneError {
    pub(crate) fn new(kind: ErrorKind, place: &Place, message: impl Into<String>) -> Self {
        let message = cut(message.into());
        Self(Box::new(Inner {
            kind,
            help: limits::help(&message),
            message,
            place: place.clone(),
            missing: Vec::new(),
        }))
    }

    pub(crate) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// The same with help, if there is any.
    pub(crate) fn with_hint(self, help: Option<String>) -> Self {
        match help {
            Some(help) => self.with_help(help),
            None => self,
        }
    }

    /// The same, with the files that it is about.
    pub(crate) fn with_missing(mut self, files: Vec<MissingFile>) -> Self {
        self.0.missing = files;
        self
    }

    /// The same as an error about a file that does not exist, where it does not.
    ///
    /// * `hint`: where it was looked for; `None` for a file that exists.
    pub(crate) fn if_missing(self, hint: Option<String>, path: &Path) -> Self {
        let Some(hint) = hint else {
            return self;
        };
        let file = MissingFile {
            path: path.to_owned(),
            place: self.0.place.clone(),
            kind: self.0.kind,
        };
        let help = format!("{hint}; `--missing stand-in` goes on without");
        self.with_help(help).with_missing(vec![file])
    }

    /// The same, with what its missing files hold.
    pub(crate) fn of_missing(mut self, kind: ErrorKind) -> Self {
        self.0.missing.iter_mut().for_each(|file| file.kind = kind);
        self
    }

    /// The files that do not exist, where that is all that is wrong; else none.
    pub fn missing(&self) -> &[MissingFile] {
        &self.0.missing
    }

    /// What kind of thing is wrong.
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// What is wrong and what was expected.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Where.
    pub fn place(&self) -> &Place {
        &self.0.place
    }

    /// The file.
    pub fn file(&self) -> &str {
        self.0.place.source.name()
    }

    /// Line, from 1.
    pub fn line(&self) -> usize {
        self.0.place.line()
    }

    /// Column in characters, from 1.
    pub fn column(&self) -> usize {
        self.0.place.column()
    }

    /// What may help.
    pub fn help(&self) -> Option<&str> {
        self.0.help.as_deref()
    }
}

/// A file that does not exist, and the first place that names it.
#[derive(Clone, Debug)]
pub struct MissingFile {
    path: PathBuf,
    place: Place,
    kind: ErrorKind,
}

impl MissingFile {
    /// The file, as it would have been opened.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What names it.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// What it holds, as the kind of the errors about such files.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }
}

/// A difference between the file and what is rendered, and where it is.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{message}")]
pub struct Warning {
    message: String,
    place: Place,
}

impl Warning {
    pub(crate) fn new(place: &Place, message: impl Into<String>) -> Self {
        Self {
            message: cut(message.into()),
            place: place.clone(),
        }
    }

    /// What differs, and what is rendered instead.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Where.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// The file.
    pub fn file(&self) -> &str {
        self.place.source.name()
    }

    /// Line, from 1.
    pub fn line(&self) -> usize {
        self.place.line()
    }

    /// Column in characters, from 1.
    pub fn column(&self) -> usize {
        self.place.column()
    }
}

/// Longest line of a message, in bytes.
const LONGEST_LINE: usize = 1000;

/// The message with its long lines cut in their middles: a file's names may be megabytes long.
fn cut(message: String) -> String {
    if message.len() <= LONGEST_LINE {
        return message;
    }
    let line = |line: &str| match line.len() {
        length if length > LONGEST_LINE => {
            let head = &line[..line.floor_char_boundary(LONGEST_LINE / 2)];
            let tail = &line[line.ceil_char_boundary(length - LONGEST_LINE / 4)..];
            format!("{head}…{tail}")
        }
        _ => line.to_owned(),
    };
    let lines: Vec<String> = message.split('\n').map(line).collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_of_messages_are_cut_and_keep_their_ends() {
        let message = cut(format!(
            "mesh {}: too many (`max_bytes`)\nshort",
            "ü".repeat(1 << 20)
        ));
        let (first, rest) = message.split_once('\n').unwrap();
        assert!(
            first.len() <= LONGEST_LINE && first.starts_with("mesh üü"),
            "{first}"
        );
        assert!(
            first.contains('…') && first.ends_with("ü: too many (`max_bytes`)"),
            "{first}"
        );
        assert_eq!(rest, "short");
        assert_eq!(cut("as it is".to_owned()), "as it is");
    }

    #[test]
    fn places_count_lines_and_characters_from_one() {
        let source = SourceText::new("a.pbrt", "über\nScale x");
        let place = Place::new(&source, "über\nScale ".len(), 1);
        assert_eq!((place.line(), place.column()), (2, 7));
        assert_eq!(place.to_string(), "a.pbrt:2:7");
        assert_eq!(
            Place::new(&source, 1, 1).column(),
            1,
            "inside a character: its start"
        );
    }
}
