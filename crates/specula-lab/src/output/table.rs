//! Tables: as CSV, as JSON within the record, as Markdown.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::typeset::prose;
use crate::{LabError, Result};

/// A table whose rows all have as many cells as there are columns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Name of the file, without its end.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// Heads with units, such as `time [ns]`.
    pub columns: Vec<String>,
    /// From top to bottom.
    pub rows: Vec<Vec<Cell>>,
}

/// The value of a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// A number. What is not finite is written as an empty cell.
    Number(Option<f64>),
    /// Words.
    Text(String),
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value.is_finite().then_some(value))
    }
}

impl From<f32> for Cell {
    fn from(value: f32) -> Self {
        f64::from(value).into()
    }
}

impl From<u32> for Cell {
    fn from(value: u32) -> Self {
        f64::from(value).into()
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl Cell {
    /// The value with so many significant digits; whole numbers have no decimals.
    #[must_use]
    pub fn show(&self, digits: usize) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(None) => String::new(),
            Self::Number(Some(value)) if value.fract() == 0.0 && value.abs() < 1e7 => {
                format!("{value:.0}")
            }
            Self::Number(Some(value)) => significant(*value, digits),
        }
    }
}

/// `value` with so many significant digits.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "decimal exponents are small, and places are bounded from below by 0"
)]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if !(-5.0..7.0).contains(&exponent) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    let places = (digits as f64 - 1.0 - exponent).max(0.0) as usize;
    format!("{value:.places$}")
}

impl Table {
    /// A table without rows.
    pub fn new(name: &str, caption: &str, columns: &[&str]) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.to_owned(),
            columns: columns.iter().map(|c| (*c).to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row.
    ///
    /// # Panics
    ///
    /// Where it has more or fewer cells than there are columns.
    pub fn push<const N: usize>(&mut self, row: [Cell; N]) {
        assert_eq!(N, self.columns.len(), "a cell per column");
        self.rows.push(row.into());
    }

    /// Writes it as CSV: numbers in full.
    ///
    /// # Errors
    ///
    /// Where the file cannot be written.
    pub fn write_csv(&self, path: &Path) -> Result<()> {
        let wrong = |e: csv::Error| LabError::Output(format!("{}: {e}", path.display()));
        let mut writer = csv::Writer::from_path(path).map_err(wrong)?;
        writer.write_record(&self.columns).map_err(wrong)?;
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Text(text) => text.clone(),
                Cell::Number(Some(value)) => value.to_string(),
                Cell::Number(None) => String::new(),
            });
            writer.write_record(cells).map_err(wrong)?;
        }
        writer.flush().map_err(LabError::io(path))
    }

    /// As Markdown, four digits.
    #[must_use]
    pub fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let mut text = line(self.columns.iter().map(|c| prose(c)).collect());
        text += &line(vec!["---".to_owned(); self.columns.len()]);
        for row in &self.rows {
            let cell = |c: &Cell| match c {
                Cell::Text(text) => text.clone(),
                Cell::Number(_) => prose(&c.show(4)),
            };
            text += &line(row.iter().map(cell).collect());
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_matter() {
        assert_eq!(significant(0.012345, 3), "0.0123");
        assert_eq!(significant(-1234.5, 3), "-1234");
        assert_eq!(significant(9.5e-9, 2), "9.5e-9");
        assert_eq!(significant(0.0, 3), "0");
    }

    #[test]
    fn files_hold_all_digits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let mut table = Table::new("a", "", &["x [m]", "what"]);
        table.push([(1.0 / 3.0).into(), "a, \"b\"".into()]);
        table.push([f64::NAN.into(), "none".into()]);
        table.write_csv(&path).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        assert_eq!(
            text,
            "x [m],what\n0.3333333333333333,\"a, \"\"b\"\"\"\n,none\n"
        );
        assert!(table.markdown().contains("| 0.3333 |"));
    }
}
