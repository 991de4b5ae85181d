//! What a `miette` report needs to print a source excerpt.

use std::fmt::Display;

use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteSpanContents, Severity, SourceCode, SourceSpan,
    SpanContents,
};

use crate::error::{Place, SceneError, SourceText, Warning};
use crate::report::{self, Problem};

/// Longest excerpt of a file that is shown, in bytes.
const LONGEST_EXCERPT: usize = 2000;

/// Longest mark below an excerpt, in bytes: what is longer is marked at its beginning.
const LONGEST_MARK: usize = 200;

/// Bytes that are shown before and after a place in a longer one.
const AROUND: usize = 60;

impl SourceCode for SourceText {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let text = self.text();
        let contents = text.read_span(span, lines_before, lines_after)?;
        let (mut start, mut line, mut column) =
            (contents.span().offset(), contents.line(), contents.column());
        let mut end = start + contents.data().len();
        if end - start > LONGEST_EXCERPT {
            // A line that a machine wrote is long: only what is around the place is shown.
            let at = span.offset().clamp(start, end);
            let row = text[..at].rfind('\n').map_or(0, |i| i + 1).max(start);
            let from = text.floor_char_boundary(at.saturating_sub(AROUND)).max(row);
            let before = text.get(start..row).unwrap_or_default();
            column = if before.is_empty() { column } else { 0 } + (from - row);
            line += before.matches('\n').count();
            let to = text.ceil_char_boundary(at.saturating_add(span.len()).saturating_add(AROUND));
            let row_end = text[at..].find('\n').map_or(text.len(), |i| at + i);
            end = end.min(to.min(row_end.max(at + span.len())));
            start = from;
        }
        Ok(Box::new(MietteSpanContents::new_named(
            self.name().to_owned(),
            &text.as_bytes()[start..end],
            (start, end - start).into(),
            line,
            column,
            contents.line_count(),
        )))
    }
}

fn excerpt(place: &Place) -> Option<&dyn SourceCode> {
    // A file that could not be read has no text to show.
    (!place.source().text().is_empty()).then_some(place.source() as &dyn SourceCode)
}

fn label(place: &Place) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
    let text = place.source().text();
    let end = place
        .offset()
        .saturating_add(place.length().min(LONGEST_MARK));
    let length = match text.len() {
        length if end < length => text.floor_char_boundary(end).saturating_sub(place.offset()),
        _ => place.length().min(LONGEST_MARK),
    };
    let span = LabeledSpan::new(Some("here".to_owned()), place.offset(), length);
    Some(Box::new(std::iter::once(span)))
}

impl Diagnostic for SceneError {
    fn code<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        Some(Box::new(self.place()))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        SceneError::help(self).map(|h| Box::new(h) as Box<dyn Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        excerpt(self.place())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        label(self.place())
    }
}

impl Diagnostic for Warning {
    fn code<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        Some(Box::new(self.place()))
    }

    fn severity(&self) -> Option<Severity> {
        Some(Severity::Warning)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        excerpt(self.place())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        label(self.place())
    }
}

impl Diagnostic for Problem {
    fn code<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        Some(Box::new(self.place()))
    }

    fn severity(&self) -> Option<Severity> {
        Some(match Problem::severity(self) {
            report::Severity::Error => Severity::Error,
            report::Severity::Warning => Severity::Warning,
            report::Severity::Note => Severity::Advice,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        Problem::help(self).map(|h| Box::new(h) as Box<dyn Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        excerpt(self.place())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        label(self.place())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn an_error_shows_its_line() {
        let source = SourceText::new("a.pbrt", "Identity\nScael 1 1 1\n");
        let place = Place::new(&source, 9, 5);
        let error = SceneError::new(ErrorKind::UnknownDirective, &place, "unknown directive");
        let code = error.source_code().expect("the text is known");
        let span = error
            .labels()
            .expect("one label")
            .next()
            .expect("one label");
        let contents = code
            .read_span(span.inner(), 1, 1)
            .expect("inside of the text");
        let data = String::from_utf8_lossy(contents.data());
        assert!(data.contains("Scael 1 1 1"), "{data}");
        // The line and the column count from 0 here.
        assert_eq!(contents.line(), 0, "one line of context before");
        assert_eq!(contents.name(), Some("a.pbrt"));
    }

    #[test]
    fn of_a_long_name_the_beginning_is_marked() {
        let text = format!("Shape \"{}\"\n", "\u{fc}".repeat(1 << 20));
        let source = SourceText::new("a.pbrt", text.as_str());
        let place = Place::new(&source, 6, text.len() - 7);
        let error = SceneError::new(ErrorKind::Parameter, &place, "unknown");
        let mut labels = Diagnostic::labels(&error).unwrap();
        let span = *labels.next().unwrap().inner();
        assert!(
            span.len() <= LONGEST_MARK && span.len() > LONGEST_MARK - 4,
            "{span:?}"
        );
        let contents = source.read_span(&span, 1, 1).unwrap();
        assert!(contents.data().len() < 400, "{}", contents.data().len());
        assert!(std::str::from_utf8(contents.data()).is_ok());
    }

    #[test]
    fn of_a_long_line_a_part_is_shown() {
        let text = format!(
            "{{\n{}\u{fc}, \"here\": 7, {}\n}}",
            "a".repeat(9000),
            "b".repeat(9000)
        );
        let at = text.find("7").expect("it is there");
        let source = SourceText::new("a.gltf", text);
        let contents = source.read_span(&(at, 1).into(), 1, 1).expect("inside");
        let data = std::str::from_utf8(contents.data()).expect("whole characters");
        assert!(data.contains("\"here\": 7,") && data.len() < 200, "{data}");
        assert_eq!(contents.line(), 1);
        let start = contents.span().offset();
        assert_eq!(&source.text()[start..start + data.len()], data);
    }
}
