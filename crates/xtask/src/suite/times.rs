//! How long each program of tests took.

use std::time::Instant;

/// A program of tests, or a part of the run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Suite {
    name: String,
    seconds: f64,
}

impl Suite {
    /// One that ends now.
    pub(super) fn new(name: &str, start: Instant) -> Self {
        Self {
            name: name.to_owned(),
            seconds: start.elapsed().as_secs_f64(),
        }
    }
}

/// The table, the longest first; what took less than a second together.
pub(super) fn table(suites: &[Suite]) -> String {
    let mut sorted = suites.to_vec();
    sorted.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    let (long, short): (Vec<_>, Vec<_>) = sorted.into_iter().partition(|s| s.seconds >= 1.0);
    let mut lines: Vec<String> = long
        .iter()
        .map(|s| format!("{:<56} {:8.1} s", s.name, s.seconds))
        .collect();
    let rest: f64 = short.iter().map(|s| s.seconds).sum();
    lines.push(format!(
        "{:<56} {rest:8.1} s",
        format!("{} more", short.len())
    ));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_comes_first() {
        let suite = |name: &str, seconds| Suite {
            name: name.to_owned(),
            seconds,
        };
        let text = table(&[
            suite("a", 0.5),
            suite("b", 2.0),
            suite("c", 3.0),
            suite("d", 0.25),
        ]);
        let lines: Vec<_> = text.lines().collect();
        assert!(
            lines[0].starts_with("c ") && lines[0].ends_with("3.0 s"),
            "{text}"
        );
        assert!(lines[1].starts_with("b "), "{text}");
        assert!(
            lines[2].starts_with("2 more") && lines[2].ends_with("0.8 s"),
            "{text}"
        );
    }
}
