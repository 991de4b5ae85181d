//! Results as Markdown for a repository: one table over all, a page per experiment with its
//! plots, small pictures and data.

mod items;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use resvg::tiny_skia::Pixmap;

use crate::output::comparison::{WrittenComparison, write_sheet};
use crate::output::insets::Sheet;
use crate::output::table::Table;
use crate::record;
use crate::typeset::prose;
use crate::{Claim, LabError, Outcome, Record, Result, experiments};

/// Widest picture, in pixels.
const WIDEST: usize = 1100;
/// Most rows of a table on a page; the CSV has all.
const MOST_ROWS: usize = 40;
/// Largest SVG and CSV file that is published, in bytes: larger plots are PNG, and larger data are left out.
const LARGEST: u64 = 250_000;

/// Writes `to/README.md`, and per experiment a folder with its page, plots, small pictures and CSV files,
/// from the results in `from`. Experiments that have no result there are named as missing.
///
/// # Errors
///
/// Where there is no result at all or one is damaged, or a file cannot be written.
pub fn publish(from: &Path, to: &Path) -> Result<()> {
    let mut records = Vec::new();
    let mut missing = Vec::new();
    for experiment in experiments::ALL {
        let folder = from.join(experiment.id);
        if !folder.join(record::FILE).is_file() {
            missing.push(experiment.id);
            continue;
        }
        let record = Record::read(&folder)?;
        page(&record, &folder, &to.join(experiment.id))?;
        records.push(record);
    }
    if records.is_empty() {
        return Err(LabError::NoResults(from.to_owned()));
    }
    let path = to.join("README.md");
    fs::write(&path, overview(&records, &missing)).map_err(LabError::io(&path))
}

/// The table over all.
fn overview(records: &[Record], missing: &[&str]) -> String {
    let mut text = String::from(HEAD);
    if let Some(record) = records.first() {
        let _ = writeln!(
            text,
            "Made by `specula lab run --quality {} -o DIR` and `specula lab report DIR --markdown \
             docs/results` with version {} on {}, {} threads ({}), {:.0} minutes.\n",
            record.quality.name(),
            record.version,
            record.machine.processor,
            record.machine.threads,
            record.machine.system,
            records.iter().map(|r| r.seconds).sum::<f64>() / 60.0,
        );
    }
    let count = |outcome| records.iter().filter(|r| r.outcome == outcome).count();
    let _ = write!(
        text,
        "{} experiments: {} reproduced, {} in part, {} not",
        records.len(),
        count(Outcome::Reproduced),
        count(Outcome::Partly),
        count(Outcome::NotReproduced),
    );
    match count(Outcome::Undecided) {
        0 => text += ".\n\n",
        undecided => {
            let _ = writeln!(text, ", {undecided} undecided.\n");
        }
    }
    text += "| table or figure | the paper's statement | Specula | verdict | command |\n";
    text += "| --- | --- | --- | --- | --- |\n";
    for record in records {
        let _ = writeln!(
            text,
            "| [{} {}]({}/README.md) | {} | {} | {} | `{}` |",
            record.source.cite(),
            record.item,
            record.id,
            cell(&record.statement),
            cell(&record.verdict.summary),
            record.outcome.name(),
            record.command,
        );
    }
    if !missing.is_empty() {
        let _ = writeln!(text, "\nNot run: {}.", missing.join(", "));
    }
    text += BETWEEN;
    for item in items::ITEMS {
        let _ = writeln!(
            text,
            "| {} {} | {} | {} |",
            item.source.cite(),
            item.item,
            cell(item.shows),
            cell(item.instead),
        );
    }
    text
}

const HEAD: &str = "# Every table and figure of the papers\n\n\
    The papers: Tokuyoshi and Eto 2024, *Bounded VNDF Sampling for the Smith-GGX BRDF*, and its \
    supplement of 2023; Dupuy and Benyoub 2023, *Sampling Visible GGX Normals with Spherical Caps*; \
    Cui et al. 2023, *Multiple-bounce Smith Microfacet BRDFs using the Invariance Principle*.\n\n";

const BETWEEN: &str = "\n## What is no result\n\n\
    | table or figure | what it shows | instead |\n| --- | --- | --- |\n";

/// Text within a cell of a table.
fn cell(text: &str) -> String {
    prose(text).replace('|', "\\|").replace('\n', " ")
}

/// One experiment's page with its files.
fn page(record: &Record, from: &Path, to: &Path) -> Result<()> {
    match fs::remove_dir_all(to) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(LabError::io(to)(e)),
        _ => (),
    }
    fs::create_dir_all(to).map_err(LabError::io(to))?;
    let mut text = head(record);
    for plot in &record.plots {
        let file = if is_small(&from.join(&plot.svg))? {
            copy(from, to, &plot.svg)?;
            &plot.svg
        } else {
            small(&from.join(&plot.png), &to.join(&plot.png))?;
            &plot.png
        };
        let caption = prose(&plot.caption);
        let _ = writeln!(text, "![{}]({file})\n\n{caption}\n", cell(&caption));
    }
    for comparison in &record.comparisons {
        small(&from.join(&comparison.sheet), &to.join(&comparison.sheet))?;
        text += &pictures(comparison);
    }
    for table in &record.tables {
        let name = format!("{}.csv", table.name);
        let is_kept = is_small(&from.join(&name))?;
        if is_kept {
            copy(from, to, &name)?;
        }
        text += &data(table, is_kept);
    }
    let path = to.join("README.md");
    fs::write(&path, text).map_err(LabError::io(&path))
}

fn head(record: &Record) -> String {
    let mut text = format!(
        "# {} {}: {}\n\n{}\n\n**{}.** {}\n",
        record.source.cite(),
        record.item,
        record.title,
        prose(&record.statement),
        capitalised(record.outcome.name()),
        prose(&record.verdict.summary),
    );
    if !record.verdict.caveat.is_empty() {
        let _ = write!(text, "\n{}\n", prose(&record.verdict.caveat));
    }
    text += "\n| claim | stated | measured | holds |\n| --- | --- | --- | --- |\n";
    for Claim {
        statement,
        stated,
        measured,
        holds,
        ..
    } in &record.verdict.claims
    {
        let holds = holds.name();
        let _ = writeln!(
            text,
            "| {} | {} | {} | {holds} |",
            cell(statement),
            cell(stated),
            cell(measured)
        );
    }
    let _ = writeln!(
        text,
        "\n`{}`, seed {}, {:.0} s.\n",
        record.command, record.seed, record.seconds
    );
    text
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

fn pictures(comparison: &WrittenComparison) -> String {
    let labels: Vec<&str> = comparison.shots.iter().map(|s| s.label.as_str()).collect();
    let mut text = format!(
        "![{}]({})\n\n{} In their order: {}.\n\n",
        cell(&comparison.caption),
        comparison.sheet,
        prose(&comparison.caption),
        labels.join(", "),
    );
    text += "| picture | | RMSE | relMSE | HDR-FLIP | fireflies [ppm] |\n";
    text += "| --- | --- | --- | --- | --- | --- |\n";
    for shot in &comparison.shots {
        let Some(e) = &shot.errors else { continue };
        let _ = writeln!(
            text,
            "| {} | {} | {:.4} | {:.4} | {:.4} | {:.0} |",
            cell(&shot.label),
            cell(&shot.note),
            e.rmse,
            e.rel_mse,
            e.hdr_flip,
            e.fireflies_ppm
        );
    }
    text.push('\n');
    text
}

fn data(table: &Table, is_kept: bool) -> String {
    let name = &table.name;
    let file = if is_kept {
        format!("[{name}.csv]({name}.csv)")
    } else {
        format!("{name}.csv, made by the command")
    };
    let rows = table.rows.len();
    if rows > MOST_ROWS {
        return format!("{} ({file}, {rows} rows)\n\n", prose(&table.caption));
    }
    format!(
        "{} ({file})\n\n{}\n",
        prose(&table.caption),
        table.markdown()
    )
}

fn is_small(path: &Path) -> Result<bool> {
    let metadata = fs::metadata(path).map_err(LabError::io(path))?;
    Ok(metadata.len() <= LARGEST)
}

fn copy(from: &Path, to: &Path, name: &str) -> Result<()> {
    let (from, to) = (from.join(name), to.join(name));
    fs::copy(&from, &to).map_err(LabError::io(&from))?;
    Ok(())
}

/// A PNG no wider than [`WIDEST`]: means over squares of pixels.
fn small(from: &Path, to: &Path) -> Result<()> {
    let bytes = fs::read(from).map_err(LabError::io(from))?;
    let picture = Pixmap::decode_png(&bytes).map_err(|e| LabError::NotAResult {
        path: from.to_owned(),
        message: e.to_string(),
    })?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let side = width.div_ceil(WIDEST).max(1);
    let pixels = picture.pixels();
    let mut sheet = Sheet::new(width / side, height / side, [0; 3]);
    let columns = sheet.width;
    for (i, pixel) in sheet.pixels.iter_mut().enumerate() {
        let (x, y) = (side * (i % columns), side * (i / columns));
        *pixel = mean(pixels, width, [x, y], side);
    }
    write_sheet(to, &sheet)
}

/// The mean of a square of pixels.
#[expect(clippy::cast_possible_truncation, reason = "a mean of bytes is a byte")]
fn mean(
    pixels: &[resvg::tiny_skia::PremultipliedColorU8],
    width: usize,
    [x, y]: [usize; 2],
    side: usize,
) -> [u8; 3] {
    let mut sum = [0_usize; 3];
    for row in y..y + side {
        for pixel in &pixels[row * width + x..row * width + x + side] {
            for (s, v) in sum
                .iter_mut()
                .zip([pixel.red(), pixel.green(), pixel.blue()])
            {
                *s += usize::from(v);
            }
        }
    }
    sum.map(|s| (s / (side * side)) as u8)
}
