//! Tables of what was measured.

use std::fmt::Write;
use std::path::Path;

use super::{Row, peer};
use crate::Result;

const BEGIN: &str = "<!-- figures -->\n";
const END: &str = "<!-- end of figures -->\n";

/// One mesh, to be read while others are measured.
pub(super) fn row(row: &Row) -> String {
    let mut text = format!("{} triangles\n", row.triangles);
    for cell in &row.cells {
        let _ = write!(text, "  {:34}{:7.0} ns", cell.what, cell.specula);
        for (call, time) in peer::CALLS.iter().zip(cell.peer.iter().flatten()) {
            let _ = write!(text, "; Embree, {call}: {time:.0} ns");
        }
        text.push('\n');
    }
    text
}

/// All of it, as Markdown.
pub(super) fn tables(rows: &[Row]) -> String {
    let mut text = String::from(
        "Millions of rays a second, one thread: Embree with one ray a call, and with sixteen, told that they are coherent \
         where that is faster; and Specula's over each:\n\n\
         | triangles | rays | Specula | Embree, one | sixteen | ratio, one | sixteen |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        for cell in &row.cells {
            let rate = 1e3 / cell.specula;
            let _ = write!(text, "| {} | {} | {rate:.2} |", row.triangles, cell.what);
            let (Some([one, ..]), Some(sixteen)) = (cell.peer, cell.in_packets()) else {
                text.push_str(" | | | |\n");
                continue;
            };
            let [one, sixteen] = [one, sixteen].map(|time| 1e3 / time);
            let _ = writeln!(
                text,
                " {one:.2} | {sixteen:.2} | {:.2} | {:.2} |",
                rate / one,
                rate / sixteen
            );
        }
    }
    text.push_str(
        "\nSeconds to build, by the clock, and bytes a triangle:\n\n\
         | triangles | Specula, 1 thread | 2 threads | Embree, 1 thread | 2 threads | Specula, bytes | Embree, bytes |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let [one, two] = row.build;
        let _ = write!(text, "| {} | {one:.3} | {two:.3} |", row.triangles);
        match row.peer_build {
            Some([one, two]) => {
                let _ = write!(text, " {one:.3} | {two:.3} |");
            }
            None => text.push_str(" | |"),
        }
        let each = |bytes: f64| format!("{:.0}", bytes / row.triangles as f64);
        let peer = row.peer_bytes.map_or(String::new(), each);
        let _ = writeln!(text, " {} | {peer} |", each(row.bytes));
    }
    text
}

/// Puts the tables between their marks.
pub(super) fn write(path: &Path, tables: &str) -> Result<()> {
    let text = std::fs::read_to_string(path)?;
    let (before, rest) = text
        .split_once(BEGIN)
        .ok_or("the document has no mark for figures")?;
    let (_, after) = rest
        .split_once(END)
        .ok_or("the document has no mark for figures' end")?;
    std::fs::write(path, format!("{before}{BEGIN}\n{tables}\n{END}{after}"))?;
    Ok(())
}
