//! What a `miette` report needs to print a source excerpt.

use std::fmt::Display;

use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteSpanContents, Severity, SourceCode, SourceSpan,
    SpanContents,
};

use crate::error::{Place, SceneError, Source, Warning};
use crate::report::{self, Problem};

impl SourceCode for Source {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.text().read_span(span, lines_before, lines_after)?;
        Ok(Box::new(MietteSpanContents::new_named(
            self.name().to_owned(),
            contents.data(),
            *contents.span(),
            contents.line(),
            contents.column(),
            contents.line_count(),
        )))
    }
}

fn excerpt(place: &Place) -> Option<&dyn SourceCode> {
    // A file that could not be read has no text to show.
    (!place.source().text().is_empty()).then_some(place.source() as &dyn SourceCode)
}

fn label(place: &Place) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
    let span = LabeledSpan::new(Some("here".to_owned()), place.offset(), place.length());
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
        let source = Source::new("a.pbrt", "Identity\nScael 1 1 1\n");
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
}
