//! The tables of `docs/profile`.

use std::fmt::Write;

use super::Row;
use super::parts::Part;

/// What stands between these lines of the document is written by the chore.
const BEGIN: &str = "<!-- written by `cargo xtask profile --publish` -->\n";
const END: &str = "<!-- end -->\n";

/// Shares of every part, in per cent, scene by scene.
pub(super) fn table(rows: &[Row]) -> String {
    let mut text = "| scene | instructions a sample |".to_owned();
    for part in Part::ALL {
        let _ = write!(text, " {} |", part.title());
    }
    text.push_str("\n|---|---|");
    text.push_str(&"---|".repeat(Part::ALL.len()));
    text.push('\n');
    for row in rows {
        let _ = write!(
            text,
            "| {} | {:.0} |",
            row.name,
            row.instructions_per_sample()
        );
        for part in Part::ALL {
            let _ = write!(text, " {:.1} |", 100.0 * row.share(part));
        }
        text.push('\n');
    }
    text
}

/// BSDF sampling alone, beside what was published of it.
fn sampling(rows: &[Row]) -> String {
    let mut text = "| scene | renderer | BSDF sampling, % |\n|---|---|---|\n".to_owned();
    for (scene, before, after) in [
        ("pbrt-book", 1.34, 0.54),
        ("lte-orb (conductor)", 3.71, 1.49),
        ("lte-orb (dielectric)", 1.89, 0.74),
        ("sportscar", 0.48, 0.20),
    ] {
        let _ = writeln!(
            text,
            "| {scene} | pbrt-v4, Heitz 2018, then spherical caps | {before:.2}, then {after:.2} |"
        );
    }
    for row in rows {
        let share = 100.0 * row.share(Part::Sampling);
        let _ = writeln!(
            text,
            "| {} | Specula, exact reflections | {share:.1} |",
            row.name
        );
    }
    text
}

/// The document with its tables replaced, or a new one.
pub(super) fn publish(old: &str, rows: &[Row]) -> String {
    let tables = format!(
        "{BEGIN}\n{}\nBSDF sampling beside table 1 of Dupuy and Benyoub 2023, shares of time there and of \
         instructions here:\n\n{}\n{END}",
        table(rows),
        sampling(rows)
    );
    match (old.split_once(BEGIN), old.split_once(END)) {
        (Some((before, _)), Some((_, after))) => format!("{before}{tables}{after}"),
        _ => format!("# Where the time goes\n\n{tables}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> Row {
        Row {
            name: "room".to_owned(),
            totals: [40, 10, 10, 5, 15, 10, 5, 2, 1, 2],
            samples: 4,
        }
    }

    #[test]
    fn shares_add_to_the_whole() {
        let text = table(&[row()]);
        assert!(
            text.ends_with(
                "| room | 25 | 40.0 | 10.0 | 10.0 | 5.0 | 15.0 | 10.0 | 5.0 | 2.0 | 1.0 | 2.0 |\n"
            ),
            "{text}"
        );
        assert!(sampling(&[row()]).ends_with("| room | Specula, exact reflections | 5.0 |\n"));
    }

    #[test]
    fn the_rest_of_the_document_stays() {
        let old = format!("head\n{BEGIN}old{END}tail\n");
        let new = publish(&old, &[row()]);
        assert!(new.starts_with("head\n") && new.ends_with("tail\n"));
        assert!(new.contains("| room |") && !new.contains("old"));
        assert_eq!(publish(&new, &[row()]), new);
        assert!(publish("", &[row()]).starts_with("# Where"));
    }
}
