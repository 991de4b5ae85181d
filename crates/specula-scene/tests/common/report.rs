//! What reports of checks hold.

use specula_scene::{CheckReport, SceneError, Severity};

/// Lines and messages of one severity.
pub(crate) fn found(report: &CheckReport, severity: Severity) -> Vec<(usize, String)> {
    let problems = report.problems().iter();
    problems
        .filter(|p| p.severity() == severity)
        .map(|p| (p.place().line(), p.message().to_owned()))
        .collect()
}

/// Holds the errors of a report against lines and words of their messages, and the error of an
/// ordinary load against them.
#[track_caller]
pub(crate) fn expect_errors(report: &CheckReport, load: &SceneError, expected: &[(usize, &str)]) {
    let errors = found(report, Severity::Error);
    let lines: Vec<usize> = errors.iter().map(|e| e.0).collect();
    let wanted: Vec<usize> = expected.iter().map(|e| e.0).collect();
    assert_eq!(lines, wanted, "{errors:#?}");
    for ((_, message), (line, word)) in errors.iter().zip(expected) {
        assert!(message.contains(word), "line {line}: {message}");
    }
    let known = |e: &(usize, String)| e.0 == load.line() && e.1 == load.message();
    assert!(errors.iter().any(known), "{load}");
}
