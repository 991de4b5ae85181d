//! What callgrind writes: costs by symbol, file and line, inlined code under its own file.
//!
//! Source: Valgrind's manual, Callgrind Format Specification.

use std::collections::HashMap;

/// Instructions of one line of a file within one symbol.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cost<'a> {
    pub(super) symbol: &'a str,
    /// The file of the line: another where code was inlined.
    pub(super) file: &'a str,
    pub(super) line: u32,
    pub(super) instructions: u64,
}

/// Names are given once, with a number, and by their number from then on.
#[derive(Default)]
struct Names<'a>(HashMap<&'a str, &'a str>);

impl<'a> Names<'a> {
    fn get(&mut self, text: &'a str) -> &'a str {
        let Some((number, name)) = text.strip_prefix('(').and_then(|t| t.split_once(')')) else {
            return text;
        };
        match name.trim_start() {
            "" => self.0.get(number).copied().unwrap_or("?"),
            name => {
                self.0.insert(number, name);
                name
            }
        }
    }
}

/// Every cost of a profile in the order of the file, which within a symbol is nearly that of the code;
/// costs of calls are left out. `None` where it is no profile of instructions by line.
pub(super) fn costs(text: &str) -> Option<Vec<Cost<'_>>> {
    if !text.contains("\nevents: Ir") || !text.contains("\npositions: line") {
        return None;
    }
    let (mut files, mut symbols) = (Names::default(), Names::default());
    let (mut home, mut file, mut symbol) = ("?", "?", "?");
    let (mut line, mut call, mut found) = (0_u32, false, Vec::new());
    for row in text.lines() {
        if let Some((key, value)) = row.split_once('=') {
            match key {
                "fl" => {
                    home = files.get(value);
                    file = home;
                }
                "fi" | "fe" => file = files.get(value),
                "fn" => {
                    symbol = symbols.get(value);
                    file = home;
                }
                "cfi" | "cfl" => {
                    files.get(value);
                }
                "cfn" => {
                    symbols.get(value);
                }
                "calls" => call = true,
                _ => {}
            }
            continue;
        }
        let Some((position, cost)) = row.split_once(' ') else {
            continue;
        };
        let Some(at) = position_of(position, line) else {
            continue;
        };
        line = at;
        if std::mem::take(&mut call) {
            continue;
        }
        found.push(Cost {
            symbol,
            file,
            line,
            instructions: cost.trim().parse().ok()?,
        });
    }
    Some(found)
}

/// `17`, `+3`, `-2` or `*`, the last three from the line before; `None`: no position.
fn position_of(text: &str, before: u32) -> Option<u32> {
    match text.as_bytes().first()? {
        b'*' => Some(before),
        b'+' => before.checked_add(text[1..].parse().ok()?),
        b'-' => before.checked_sub(text[1..].parse().ok()?),
        b'0'..=b'9' => text.parse().ok(),
        _ => None,
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Cut from a recorded profile, its paths shortened.
    pub(in super::super) const EXCERPT: &str = "\
# callgrind format
version: 1
positions: line
events: Ir
summary: 1000

ob=(1) /w/specula
fl=(1) /w/crates/specula-render/src/integrator/block.rs
fn=(1) _RNvMs_integrator5block10follow_all
210 40
+1 10
fi=(2) /w/crates/specula-render/src/light/tree.rs
30 100
fi=(3) /rustc/core/src/ops/arith.rs
91 7
fe=(1)
212 5
cob=(2) /lib/libm.so
cfi=(4) /libm/sinf.c
cfn=(2) sinf
calls=3 8
* 600
fi=(5) /w/crates/specula-bsdf/src/bsdf/conductor.rs
11 50
21 30
fi=(3)
91 9

fl=(6) /w/crates/specula-render/src/accel/traverse.rs
fn=(3) _RNvNtNtCs_14specula_render5accel4avx29intersect
12 200

fn=(4) _RNvNtNtCs_14specula_render5accel4avx28occluded
12 100
-2 11

ob=(2)
fl=(4)
fn=(2)
8 600
";

    #[test]
    fn inlined_code_counts_for_its_own_file_and_calls_for_nobody() {
        let found = costs(EXCERPT).unwrap();
        let sum = |file: &str| {
            let of = found.iter().filter(|c| c.file.ends_with(file));
            of.map(|c| c.instructions).sum::<u64>()
        };
        assert_eq!(sum("block.rs"), 55);
        assert_eq!(sum("tree.rs"), 100);
        assert_eq!(sum("conductor.rs"), 80);
        assert_eq!(sum("arith.rs"), 16);
        assert_eq!(sum("sinf.c"), 600);
        let last = found.last().unwrap();
        assert_eq!((last.symbol, last.line), ("sinf", 8));
        let shadow = found.iter().find(|c| c.instructions == 11).unwrap();
        assert_eq!(shadow.line, 10);
        assert!(shadow.symbol.ends_with("8occluded"));
        assert_eq!(costs("version: 1\n"), None);
    }
}
