//! Records as the templates show them.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::embed;
use crate::output::comparison::{WrittenComparison, WrittenShot};
use crate::output::table::significant;
use crate::output::{Cell, Table};
use crate::typeset::prose;
use crate::{Answer, Claim, ClaimKind, Outcome, Record, Result, Source};

/// Tables with more rows are folded.
const FOLDED: usize = 12;
/// Rows of a table that the page shows; the rest is in its file.
const MOST_ROWS: usize = 100;
/// Digits of numbers in tables.
const DIGITS: usize = 4;

/// How many results have which outcome.
#[derive(Serialize)]
pub(super) struct Counts {
    all: usize,
    reproduced: usize,
    partly: usize,
    not: usize,
    undecided: usize,
}

/// Of all results.
pub(super) fn counts(results: &[(PathBuf, Record)]) -> Counts {
    let of = |outcome| results.iter().filter(|r| r.1.outcome == outcome).count();
    Counts {
        all: results.len(),
        reproduced: of(Outcome::Reproduced),
        partly: of(Outcome::Partly),
        not: of(Outcome::NotReproduced),
        undecided: of(Outcome::Undecided),
    }
}

#[derive(Serialize)]
pub(super) struct RecordView {
    /// Name within the page: that of the folder, unique there.
    anchor: String,
    id: String,
    source: &'static str,
    item: String,
    title: String,
    statement: String,
    command: String,
    quality: &'static str,
    seed: u64,
    version: String,
    machine: String,
    seconds: String,
    outcome: &'static str,
    /// For the style.
    class: &'static str,
    summary: String,
    caveat: String,
    claims: Vec<ClaimView>,
    plots: Vec<PlotView>,
    tables: Vec<TableView>,
    viewers: Vec<Viewer>,
}

#[derive(Serialize)]
struct ClaimView {
    statement: String,
    stated: String,
    measured: String,
    /// `yes`, `no`, `undecided`.
    holds: &'static str,
    /// For the style.
    class: &'static str,
    kind: &'static str,
}

#[derive(Serialize)]
struct PlotView {
    name: String,
    caption: String,
    src: String,
}

#[derive(Serialize)]
struct TableView {
    name: String,
    caption: String,
    heads: Vec<Head>,
    rows: Vec<Vec<CellView>>,
    /// Rows that only the file has.
    left_out: usize,
    count: usize,
    is_folded: bool,
    csv: Option<String>,
}

#[derive(Serialize)]
struct Head {
    text: String,
    is_number: bool,
}

#[derive(Serialize)]
struct CellView {
    text: String,
    is_number: bool,
}

#[derive(Serialize)]
struct Viewer {
    name: String,
    caption: String,
    width: u32,
    height: u32,
    shots: Vec<Shot>,
    has_errors: bool,
}

#[derive(Serialize)]
struct Shot {
    label: String,
    note: String,
    src: String,
    error_src: Option<String>,
    /// Name and value.
    errors: Vec<(&'static str, String)>,
}

/// A result in its folder.
pub(super) fn record(folder: &Path, record: &Record) -> Result<RecordView> {
    let machine = &record.machine;
    let anchor = folder
        .file_name()
        .map_or_else(|| record.id.clone(), |n| n.to_string_lossy().into_owned());
    let plots = record.plots.iter().map(|plot| {
        Ok(PlotView {
            name: plot.name.clone(),
            caption: prose(&plot.caption),
            src: embed::plot(folder, plot)?,
        })
    });
    Ok(RecordView {
        anchor,
        id: record.id.clone(),
        source: record.source.cite(),
        item: record.item.clone(),
        title: record.title.clone(),
        statement: prose(&record.statement),
        command: record.command.clone(),
        quality: record.quality.name(),
        seed: record.seed,
        version: record.version.clone(),
        machine: format!(
            "{}, {} threads, {}",
            machine.processor, machine.threads, machine.system
        ),
        seconds: significant(record.seconds, 3),
        outcome: outcome(record),
        class: match record.outcome {
            Outcome::Reproduced => "good",
            Outcome::Partly => "fair",
            Outcome::NotReproduced => "bad",
            Outcome::Undecided => "open",
        },
        summary: prose(&record.verdict.summary),
        caveat: prose(&record.verdict.caveat),
        claims: record.verdict.claims.iter().map(claim).collect(),
        plots: plots.collect::<Result<_>>()?,
        tables: each(&record.tables, |t| table(folder, t))?,
        viewers: each(&record.comparisons, |c| viewer(folder, c))?,
    })
}

fn each<T, V>(all: &[T], view: impl Fn(&T) -> Result<V>) -> Result<Vec<V>> {
    all.iter().map(view).collect()
}

/// The outcome in words; results of this project itself are not reproductions.
fn outcome(record: &Record) -> &'static str {
    match (record.source, record.outcome) {
        (Source::Specula, Outcome::Reproduced) => "holds",
        (Source::Specula, Outcome::NotReproduced) => "does not hold",
        (_, outcome) => outcome.name(),
    }
}

fn claim(claim: &Claim) -> ClaimView {
    ClaimView {
        statement: prose(&claim.statement),
        stated: prose(&claim.stated),
        measured: prose(&claim.measured),
        holds: claim.holds.name(),
        class: match claim.holds {
            Answer::Yes => "good",
            Answer::No => "bad",
            Answer::Undecided => "open",
        },
        kind: match claim.kind {
            ClaimKind::Law => "on every machine",
            ClaimKind::Refuted => "on no machine",
            ClaimKind::Measured => "measured here",
        },
    }
}

fn table(folder: &Path, table: &Table) -> Result<TableView> {
    let is_number = |cell: &Cell| matches!(cell, Cell::Number(_));
    let column = |i: usize| table.rows.iter().filter_map(move |row| row.get(i));
    let heads = table.columns.iter().enumerate().map(|(i, text)| Head {
        text: prose(text),
        is_number: column(i).all(is_number),
    });
    let whole: Vec<bool> = (0..table.columns.len())
        .map(|i| column(i).all(is_whole))
        .collect();
    let cell = |(cell, is_whole): (&Cell, &bool)| CellView {
        text: match cell {
            Cell::Number(Some(value)) if *is_whole => prose(&format!("{value:.0}")),
            Cell::Number(_) => prose(&cell.show(DIGITS)),
            Cell::Text(text) => text.clone(),
        },
        is_number: is_number(cell),
    };
    let shown = table.rows.iter().take(MOST_ROWS);
    Ok(TableView {
        name: table.name.clone(),
        caption: prose(&table.caption),
        heads: heads.collect(),
        rows: shown
            .map(|row| row.iter().zip(&whole).map(cell).collect())
            .collect(),
        left_out: table.rows.len().saturating_sub(MOST_ROWS),
        count: table.rows.len(),
        is_folded: table.rows.len() > FOLDED,
        csv: embed::csv(&folder.join(format!("{}.csv", table.name)))?,
    })
}

/// Whether a number is shown without decimals where its whole column is.
fn is_whole(cell: &Cell) -> bool {
    match cell {
        Cell::Number(Some(value)) => value.fract() == 0.0 && value.abs() < 1e12,
        Cell::Number(None) => true,
        Cell::Text(_) => false,
    }
}

fn viewer(folder: &Path, comparison: &WrittenComparison) -> Result<Viewer> {
    let shots = each(&comparison.shots, |s| shot(folder, s))?;
    let [width, height] = comparison.size;
    Ok(Viewer {
        name: comparison.name.clone(),
        caption: prose(&comparison.caption),
        width,
        height,
        has_errors: shots.iter().any(|s| s.error_src.is_some()),
        shots,
    })
}

fn shot(folder: &Path, shot: &WrittenShot) -> Result<Shot> {
    let error_png = shot.error_png.as_ref();
    let errors = shot.errors.as_ref().map_or_else(Vec::new, |e| {
        vec![
            ("RMSE", significant(e.rmse, DIGITS)),
            ("relMSE", significant(e.rel_mse, DIGITS)),
            ("bias", format!("{:+.2} %", 100.0 * e.rel_bias)),
            ("HDR-FLIP", significant(e.hdr_flip, DIGITS)),
            (
                "fireflies",
                format!("{} ppm", significant(e.fireflies_ppm, 3)),
            ),
        ]
    });
    Ok(Shot {
        label: shot.label.clone(),
        note: shot.note.clone(),
        src: embed::png(&folder.join(&shot.png))?,
        error_src: error_png
            .map(|name| embed::png(&folder.join(name)))
            .transpose()?,
        errors,
    })
}
