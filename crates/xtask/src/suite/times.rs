//! How long each program of tests took, from what cargo says while it runs them.

use std::io::{BufRead, BufReader, Read, Write};
use std::time::Instant;

use crate::Result;

/// A program of tests.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Suite {
    name: String,
    seconds: f64,
}

/// Passes cargo's messages on to standard error until it ends; the programs that it ran, with their times.
pub(super) fn follow(messages: impl Read) -> Result<Vec<Suite>> {
    let mut suites = Vec::new();
    let mut running: Option<(String, Instant)> = None;
    let mut reader = BufReader::new(messages);
    let mut line = Vec::new();
    loop {
        line.clear();
        let ended = reader.read_until(b'\n', &mut line)? == 0;
        std::io::stderr().write_all(&line)?;
        let next = name(&String::from_utf8_lossy(&line));
        if (ended || next.is_some())
            && let Some((name, start)) = running.take()
        {
            let seconds = start.elapsed().as_secs_f64();
            suites.push(Suite { name, seconds });
        }
        if ended {
            return Ok(suites);
        }
        if let Some(name) = next {
            running = Some((name, Instant::now()));
        }
    }
}

/// What a line of cargo's says is run next: `specula_bsdf tests/batch.rs`.
fn name(line: &str) -> Option<String> {
    let line = line.trim();
    if let Some(package) = line.strip_prefix("Doc-tests ") {
        return Some(format!("{package} examples of the documentation"));
    }
    let (target, program) = line.strip_prefix("Running ")?.split_once(" (")?;
    let file = program.trim_end_matches(')').rsplit(['/', '\\']).next()?;
    let (program, _) = file.rsplit_once('-')?;
    Some(format!(
        "{program} {}",
        target.trim_start_matches("unittests ")
    ))
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

    const TEXT: &str = "   Compiling specula v0.1.0\n\
        \x20    Running unittests src/lib.rs (target/debug/deps/specula_bsdf-12ab)\n\
        SKIPPED a.rs:1: x\n\
        \x20    Running tests/batch.rs (target/debug/deps/batch-34cd)\n\
        \x20  Doc-tests specula_bsdf\n";

    #[test]
    fn programs_are_named_in_order() {
        let suites = follow(TEXT.as_bytes()).unwrap();
        let names: Vec<_> = suites.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "specula_bsdf src/lib.rs",
                "batch tests/batch.rs",
                "specula_bsdf examples of the documentation"
            ]
        );
    }

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
