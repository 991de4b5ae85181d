//! `specula check`.

use crate::cli::ExitCode;
use std::fmt::Write;
use std::path::Path;

use crate::scene::{CheckReport, Problem, Severity, check};
use miette::Report as Printed;
use serde_json::json;

use super::arguments::CheckArguments;
use super::failure::BAD_INPUT;
use super::{Failure, print};

/// Reports all problems of scenes; code 2 where one has errors, or warnings under `--strict`.
pub(crate) fn run(arguments: &CheckArguments) -> Result<ExitCode, Failure> {
    let options = arguments.loading.options(&arguments.parameters);
    let mut bad = false;
    for path in &arguments.scenes {
        let report = check(path, &options);
        bad |= report.count(Severity::Error) > 0
            || arguments.strict && report.count(Severity::Warning) > 0;
        if arguments.json {
            print(&as_json(path, &report))?;
        } else {
            print(&as_text(path, &report))?;
        }
    }
    Ok(ExitCode::from(if bad { BAD_INPUT } else { 0 }))
}

/// One line of JSON.
fn as_json(path: &Path, report: &CheckReport) -> String {
    let problem = |p: &Problem| {
        json!({
            "severity": p.severity().name(),
            "kind": p.kind(),
            "file": p.place().source().name(),
            "line": p.place().line(),
            "column": p.place().column(),
            "message": p.message(),
            "help": p.help(),
            "count": p.count(),
        })
    };
    let unlisted: usize = SEVERITIES.iter().map(|s| report.unlisted(*s)).sum();
    let value = json!({
        "file": path.display().to_string(),
        "errors": report.count(Severity::Error),
        "warnings": report.count(Severity::Warning),
        "notes": report.count(Severity::Note),
        "unlisted": unlisted,
        "problems": report.problems().iter().map(problem).collect::<Vec<_>>(),
    });
    format!("{value}\n")
}

const SEVERITIES: [Severity; 3] = [Severity::Error, Severity::Warning, Severity::Note];

/// Every problem with an excerpt, and how many there are.
fn as_text(path: &Path, report: &CheckReport) -> String {
    let mut text = String::new();
    for severity in SEVERITIES {
        let listed = report.problems().iter();
        for problem in listed.filter(|p| p.severity() == severity) {
            let _ = write!(text, "{:?}", Printed::new(problem.clone()));
            if problem.count() > 1 {
                let _ = writeln!(text, "  (and {} more like it)", problem.count() - 1);
            }
            text.push('\n');
        }
        if report.unlisted(severity) > 0 {
            let more = counted(report.unlisted(severity), severity);
            let _ = writeln!(text, "and {more} more\n");
        }
    }
    let counts: Vec<String> = (SEVERITIES.iter())
        .filter(|s| report.count(**s) > 0)
        .map(|s| counted(report.count(*s), *s))
        .collect();
    let counts = if counts.is_empty() {
        "no problems".to_owned()
    } else {
        counts.join(", ")
    };
    let _ = writeln!(text, "{}: {counts}", path.display());
    text
}

/// `1 error`, `3 errors`.
fn counted(count: usize, severity: Severity) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {}{plural}", severity.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_have_their_plural() {
        assert_eq!(counted(1, Severity::Error), "1 error");
        assert_eq!(counted(2, Severity::Note), "2 notes");
    }
}
