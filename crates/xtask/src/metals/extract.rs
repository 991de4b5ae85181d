//! `cargo xtask metals --extract`: `data/metals/*.csv` from the refractiveindex.info database.

use std::fs;
use std::path::Path;

use super::catalogue;
use super::csv::{self, Measurement};
use crate::Result;

/// The wavelengths that are extracted, in nm, and one row more on either side: the visible ones, with some margin.
const EXTRACTED_NM: (f64, f64) = (350.0, 850.0);

/// Writes every file whose page is in `folder`.
///
/// * `folder`: holds `database/data/...`. A page that it lacks is named, and the committed file
///   stays; a folder without any page is an error.
pub(crate) fn extract(root: &Path, folder: &Path) -> Result<()> {
    let (mut found, mut all) = (0, 0);
    for entry in catalogue::files() {
        all += 1;
        let page = folder.join(format!("database/data/{}.yml", entry.page));
        let Ok(yaml) = fs::read_to_string(&page) else {
            println!(
                "{}: {} is not there, left as it is",
                entry.file,
                page.display()
            );
            continue;
        };
        let measurement = visible(parse(&yaml).map_err(|e| format!("{}: {e}", page.display()))?);
        let (symbol, name) = entry.metal;
        let head = [
            format!("{symbol}, {name}: {}", entry.source),
            format!("refractiveindex.info, CC0, page {}", entry.page),
        ];
        csv::write(&csv::path(root, entry.file), &head, &measurement)?;
        found += 1;
    }
    println!("{found} of {all} files extracted");
    match found {
        0 => Err(format!("{}: no page of the catalogue", folder.display()).into()),
        _ => Ok(()),
    }
}

/// The first table of type `tabulated nk` of a page: rows of micrometres, n, k.
///
/// Only this layout of the database is read, line by line; a general YAML reader is not needed.
fn parse(yaml: &str) -> Result<Measurement> {
    let mut lines = yaml
        .lines()
        .map(str::trim)
        .skip_while(|l| *l != "- type: tabulated nk")
        .skip(1);
    if lines.next() != Some("data: |") {
        return Err("expected `- type: tabulated nk` and then `data: |`".into());
    }
    let mut rows: Vec<[f64; 3]> = Vec::new();
    for line in lines {
        let numbers: Option<Vec<f64>> = line.split_whitespace().map(|w| w.parse().ok()).collect();
        let Some(&[um, n, k]) = numbers.as_deref() else {
            break;
        };
        // Picometres are finer than any page; rounding takes the noise of the product away.
        let nm = (um * 1e6).round() / 1e3;
        // Some pages join two measurements and repeat a wavelength: the first one counts.
        if rows.last().is_none_or(|last| last[0] < nm) {
            rows.push([nm, n, k]);
        }
    }
    match rows.is_empty() {
        true => Err("expected rows of three numbers".into()),
        false => Ok(Measurement { rows }),
    }
}

/// The rows within [`EXTRACTED_NM`] and one on either side.
fn visible(measurement: Measurement) -> Measurement {
    let rows = measurement.rows;
    let first = rows
        .partition_point(|r| r[0] < EXTRACTED_NM.0)
        .saturating_sub(1);
    let end = (rows.partition_point(|r| r[0] <= EXTRACTED_NM.1) + 1).min(rows.len());
    Measurement {
        rows: rows[first..end].to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "\
REFERENCES: |
    A. Author. 0.1 1 2
DATA:
  - type: tabulated nk
    data: |
        0.2 1.0 1.5
        0.3 1.1 1.5
        0.3 9.9 9.9
        0.5876 1.2 2.25
        0.9 1.3 3.5
        1.1 1.4 4.5
SPECS:
    0.5 1 2
";

    #[test]
    fn reads_the_table_and_extracts_the_visible() {
        let all = parse(PAGE).unwrap();
        assert_eq!(all.rows.len(), 5);
        assert_eq!(
            visible(all).rows,
            [[300.0, 1.1, 1.5], [587.6, 1.2, 2.25], [900.0, 1.3, 3.5]]
        );
    }

    #[test]
    fn other_layouts_are_refused() {
        for text in [
            "",
            "DATA:\n  - type: formula 2\n",
            "DATA:\n  - type: tabulated nk\n",
            "DATA:\n  - type: tabulated nk\n    data: |\n",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn committed_data_are_what_the_database_gives() {
        let root = crate::workspace::root();
        let mut without_page = Vec::new();
        for entry in catalogue::files() {
            let page = root.join(format!("data/metals/database/data/{}.yml", entry.page));
            if !page.exists() {
                without_page.push(entry.file);
                continue;
            }
            let yaml = fs::read_to_string(&page).unwrap();
            let committed = csv::read(&root, entry.file).unwrap();
            assert_eq!(visible(parse(&yaml).unwrap()), committed, "{}", entry.file);
        }
        // Its page is of another part of the database.
        assert_eq!(without_page, ["CuZn"]);
    }
}
