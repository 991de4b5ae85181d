//! `data/metals/*.csv`: complex index over wavelength.

use std::fs;
use std::path::{Path, PathBuf};

use specula_scene::spectrum::Spectrum;

use crate::Result;

/// A measured complex index.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measurement {
    /// `[nm, n, k]`, wavelengths increasing.
    pub(crate) rows: Vec<[f64; 3]>,
}

impl Measurement {
    /// The real part.
    pub(crate) fn eta(&self) -> Result<Spectrum> {
        Ok(Spectrum::new(
            self.rows.iter().map(|r| (r[0], r[1])).collect(),
        )?)
    }

    /// The imaginary part.
    pub(crate) fn k(&self) -> Result<Spectrum> {
        Ok(Spectrum::new(
            self.rows.iter().map(|r| (r[0], r[2])).collect(),
        )?)
    }
}

/// The path of a file, named without `.csv`.
pub(crate) fn path(root: &Path, file: &str) -> PathBuf {
    root.join("data/metals").join(format!("{file}.csv"))
}

/// Reads a file, named without `.csv`.
pub(crate) fn read(root: &Path, file: &str) -> Result<Measurement> {
    let path = path(root, file);
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    parse(&text).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// Reads `nm,n,k` rows; lines that begin with `#` are comments.
fn parse(text: &str) -> Result<Measurement> {
    let mut lines = (1..)
        .zip(text.lines())
        .filter(|(_, line)| !line.starts_with('#'));
    match lines.next() {
        Some((_, "nm,n,k")) => {}
        other => return Err(format!("expected the head `nm,n,k`, found {other:?}").into()),
    }
    let mut rows = Vec::new();
    for (number, line) in lines {
        let row = (|| {
            let mut fields = line.split(',').map(|f| f.parse::<f64>().ok());
            let row = [fields.next()??, fields.next()??, fields.next()??];
            fields.next().is_none().then_some(row)
        })();
        rows.push(row.ok_or_else(|| format!("line {number}: expected three numbers: {line}"))?);
    }
    let measurement = Measurement { rows };
    measurement.eta()?;
    measurement.k()?;
    Ok(measurement)
}

/// Writes a file that [`read`] reads back.
///
/// * `head`: comment lines, without `#`.
pub(crate) fn write(path: &Path, head: &[String], measurement: &Measurement) -> Result<()> {
    let mut text: String = head.iter().map(|line| format!("# {line}\n")).collect();
    text += "nm,n,k\n";
    for [nm, n, k] in &measurement.rows {
        text += &format!("{nm},{n},{k}\n");
    }
    Ok(fs::write(path, text)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_rows_and_comments() {
        let m = parse("# gold\nnm,n,k\n400,1.5,2\n500.5,1,3.25\n").unwrap();
        assert_eq!(m.rows, [[400.0, 1.5, 2.0], [500.5, 1.0, 3.25]]);
        assert_eq!(m.k().unwrap().value(500.5), 3.25);
    }

    #[test]
    fn bad_files_are_refused() {
        for (text, message) in [
            ("", "expected the head"),
            ("n,k\n1,2\n", "expected the head"),
            ("nm,n,k\n400,1\n", "line 2: expected three numbers"),
            ("nm,n,k\n400,1,2,3\n", "line 2: expected three numbers"),
            ("nm,n,k\n400,1,x\n", "line 2: expected three numbers"),
            ("nm,n,k\n400,1,2\n400,1,2\n", "expected a wavelength above"),
            ("nm,n,k\n", "at least one sample"),
        ] {
            let error = parse(text).unwrap_err().to_string();
            assert!(error.contains(message), "{text:?}: {error}");
        }
    }
}
