//! The results of checks: one line for each, and whether all hold.

use std::fmt;

/// The outcome of one check.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The check and its configuration.
    pub name: String,
    /// Whether it holds.
    pub is_pass: bool,
    /// The probability of a result at least this bad if the subject is right; `None` for checks without
    /// random error.
    pub p_value: Option<f64>,
    /// What was measured, in words.
    pub detail: String,
}

/// A list of checks.
///
/// Printed, a report that passes is one line for each check, and one that fails names every
/// failure in full.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What was tested.
    pub subject: String,
    /// The checks, in the order made.
    pub checks: Vec<Check>,
}

impl Report {
    /// An empty report on `subject`.
    #[must_use]
    pub fn new(subject: impl Into<String>) -> Self {
        Self {
            subject: subject.into(),
            checks: Vec::new(),
        }
    }

    /// Whether every check holds. A report without checks proves nothing and does not pass.
    #[must_use]
    pub fn is_pass(&self) -> bool {
        !self.checks.is_empty() && self.checks.iter().all(|c| c.is_pass)
    }

    /// The checks that do not hold.
    pub fn failures(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|c| !c.is_pass)
    }

    /// Adds all checks of `other`.
    pub fn absorb(&mut self, other: Self) {
        self.checks.extend(other.checks);
    }

    /// How many checks are statistical: the number of tests for [`sidak`](crate::z_test::sidak).
    #[must_use]
    pub fn chance_checks(&self) -> usize {
        self.checks.iter().filter(|c| c.p_value.is_some()).count()
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.is_pass { "pass" } else { "FAIL" };
        write!(f, "{verdict}  {}: {}", self.name, self.detail)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let failed = self.failures().count();
        writeln!(
            f,
            "{}: {} of {} checks pass",
            self.subject,
            self.checks.len() - failed,
            self.checks.len()
        )?;
        for check in &self.checks {
            writeln!(f, "  {check}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_report_does_not_pass() {
        assert!(!Report::new("nothing").is_pass());
    }

    #[test]
    fn one_failure_fails_the_whole() {
        let check = |is_pass| Check {
            name: "c".into(),
            is_pass,
            p_value: Some(0.5),
            detail: "d".into(),
        };
        let mut report = Report::new("s");
        report.checks.push(check(true));
        assert!(report.is_pass());
        report.checks.push(check(false));
        assert!(!report.is_pass());
        assert_eq!(report.failures().count(), 1);
        assert_eq!(report.chance_checks(), 2);
        assert!(
            report
                .to_string()
                .contains("1 of 2 checks pass\n  pass  c: d\n  FAIL  c: d")
        );
    }
}
