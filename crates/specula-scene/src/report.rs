//! All problems of a scene in one report.

use std::collections::HashMap;
use std::path::PathBuf;

use crate::Loaded;
use crate::error::{ErrorKind, Place, SceneError, Warning};
use crate::problems::{CollectedProblems, MOST, Note, NoteKind};

/// How much a problem matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The scene cannot be used.
    Error,
    /// It is rendered otherwise than the file says.
    Warning,
    /// Not a mistake, but it may surprise.
    Note,
}

impl Severity {
    /// `error`, `warning` or `note`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// One problem of a scene. It displays as its message.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{message}")]
pub struct Problem {
    severity: Severity,
    kind: &'static str,
    message: String,
    help: Option<String>,
    place: Place,
    count: usize,
}

impl Problem {
    /// How much it matters.
    pub fn severity(&self) -> Severity {
        self.severity
    }

    /// What kind of thing is wrong, as a word for machines: that of [`ErrorKind::name`],
    /// `approximation`, `unused` or `dark`.
    pub fn kind(&self) -> &'static str {
        self.kind
    }

    /// What is wrong and what was expected.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What may help.
    pub fn help(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// Where; the first place of several.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// How many times it occurs.
    pub fn count(&self) -> usize {
        self.count
    }
}

impl From<SceneError> for Problem {
    fn from(error: SceneError) -> Self {
        Self {
            severity: Severity::Error,
            kind: error.kind().name(),
            message: error.message().to_owned(),
            help: error.help().map(str::to_owned),
            place: error.place().clone(),
            count: 1,
        }
    }
}

impl From<Warning> for Problem {
    fn from(warning: Warning) -> Self {
        Self {
            severity: Severity::Warning,
            kind: "approximation",
            message: warning.message().to_owned(),
            help: None,
            place: warning.place().clone(),
            count: 1,
        }
    }
}

impl From<Note> for Problem {
    fn from(note: Note) -> Self {
        Self {
            severity: Severity::Note,
            kind: match note.kind {
                NoteKind::Unused => "unused",
                NoteKind::Dark => "dark",
            },
            message: note.message,
            help: None,
            place: note.place,
            count: 1,
        }
    }
}

/// What [`check`](crate::check) found.
#[derive(Clone, Debug, Default)]
pub struct CheckReport {
    problems: Vec<Problem>,
    counts: [usize; 3],
    files: Vec<PathBuf>,
}

impl CheckReport {
    pub(crate) fn new(
        loaded: Result<Loaded, SceneError>,
        collected: CollectedProblems,
        files: Vec<PathBuf>,
    ) -> Self {
        let mut found: Vec<Problem> = collected.errors.into_iter().map(Problem::from).collect();
        let mut warnings = collected.warnings;
        match loaded {
            Ok(loaded) => warnings.extend(loaded.warnings),
            // An error that ended the reading.
            Err(error) => found.push(error.into()),
        }
        let mut report = Self {
            files,
            ..Self::default()
        };
        report.counts[Severity::Error as usize] = found.len() + collected.more_errors;
        for group in [
            warnings.into_iter().map(Problem::from).collect(),
            collected.notes.into_iter().map(Problem::from).collect(),
        ] {
            let mut group = grouped(group);
            if let Some(first) = group.first() {
                report.counts[first.severity as usize] = group.len();
            }
            sort(&mut group);
            group.truncate(MOST);
            report.problems.append(&mut group);
        }
        sort(&mut found);
        report.problems.splice(0..0, found);
        report
    }

    /// The problems: errors, warnings, notes, each in the order of the files. Equal warnings are one
    /// with a count; at most 100 of each severity are listed.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// Every file that was read, as [`Loaded::files`]; also where the scene has errors.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// How many different problems of a severity there are, listed or not.
    pub fn count(&self, severity: Severity) -> usize {
        self.counts[severity as usize]
    }

    /// How many problems of a severity are not listed.
    pub fn unlisted(&self, severity: Severity) -> usize {
        let listed = self.problems.iter().filter(|p| p.severity == severity);
        self.count(severity).saturating_sub(listed.count())
    }
}

/// Problems of the same message as one, at the first of their places.
fn grouped(problems: Vec<Problem>) -> Vec<Problem> {
    let mut index: HashMap<String, usize> = HashMap::new();
    let mut groups: Vec<Problem> = Vec::new();
    for problem in problems {
        match index.get(&problem.message) {
            Some(&i) => groups[i].count += 1,
            None => {
                index.insert(problem.message.clone(), groups.len());
                groups.push(problem);
            }
        }
    }
    groups
}

/// Files in the order in which they are met, places from the top down.
fn sort(problems: &mut [Problem]) {
    let mut files: HashMap<String, usize> = HashMap::new();
    for problem in problems.iter() {
        let next = files.len();
        let file = problem.place.source().name();
        files.entry(file.to_owned()).or_insert(next);
    }
    problems.sort_by_key(|p| {
        (
            files.get(p.place.source().name()).copied(),
            p.place.offset(),
        )
    });
}

impl ErrorKind {
    /// The kind as a word for machines.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Io => "file",
            Self::Encoding => "encoding",
            Self::Syntax => "syntax",
            Self::UnknownDirective => "unknown-directive",
            Self::Parameter => "parameter",
            Self::UnknownName => "unknown-name",
            Self::Duplicate => "duplicate",
            Self::Structure => "structure",
            Self::RecursiveInclude => "recursive-include",
            Self::Transform => "transform",
            Self::Mesh => "mesh",
            Self::Image => "image",
            Self::Spectrum => "spectrum",
            Self::Measured => "measured",
            Self::EmptyScene => "empty-scene",
            Self::Unsupported => "unsupported",
            Self::Limit => "limit",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::SourceText;
    use crate::missing::Missing;
    use crate::problems::Problems;

    #[test]
    fn errors_come_first_and_equal_warnings_are_counted() {
        let source = SourceText::new("a.pbrt", "one\ntwo\nthree\n");
        let at = |offset| Place::new(&source, offset, 1);
        let problems = Problems::collecting(Missing::Refuse);
        for offset in [8, 0] {
            let error = SceneError::new(ErrorKind::Syntax, &at(offset), "wrong");
            problems.record(error).unwrap();
        }
        problems.note(NoteKind::Dark, &at(4), || "dark".to_owned());
        let mut warnings = vec![
            Warning::new(&at(4), "odd"),
            Warning::new(&at(8), "odd"),
            Warning::new(&at(0), "other"),
        ];
        problems.record_warnings(&mut warnings);
        let last = SceneError::new(ErrorKind::EmptyScene, &at(4), "nothing");
        let report = CheckReport::new(Err(last), problems.take(), Vec::new());
        let lines: Vec<_> = (report.problems().iter())
            .map(|p| (p.severity().name(), p.place().line(), p.count()))
            .collect();
        assert_eq!(
            lines,
            [
                ("error", 1, 1),
                ("error", 2, 1),
                ("error", 3, 1),
                ("warning", 1, 1),
                ("warning", 2, 2),
                ("note", 2, 1)
            ]
        );
        assert_eq!(report.count(Severity::Warning), 2);
        assert_eq!(report.unlisted(Severity::Error), 0);
    }

    #[test]
    fn what_is_beyond_the_list_is_counted() {
        let source = SourceText::new("a.pbrt", "");
        let place = Place::start(&source);
        let problems = Problems::collecting(Missing::Refuse);
        for i in 0..MOST + 3 {
            let error = SceneError::new(ErrorKind::Syntax, &place, format!("{i}"));
            problems.record(error).unwrap();
            problems.note(NoteKind::Dark, &place, || format!("{i}"));
        }
        let report = CheckReport::new(
            Err(SceneError::new(ErrorKind::Io, &place, "last")),
            problems.take(),
            Vec::new(),
        );
        assert_eq!(report.unlisted(Severity::Error), 3);
        assert_eq!(report.unlisted(Severity::Note), 3);
        assert_eq!(report.unlisted(Severity::Warning), 0);
    }
}
