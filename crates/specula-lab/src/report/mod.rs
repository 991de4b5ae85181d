//! One HTML page about results: plots, pictures to compare, tables, claims. It holds all that it shows
//! and takes nothing from a network.

mod embed;
mod view;

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment, Value, context};

use crate::record::FILE;
use crate::{LabError, Record, Result, experiments};

/// Name of the page in the folder of results.
pub const PAGE: &str = "report.html";

/// A page above this many bytes is slow to open.
pub const LARGE: u64 = 30 << 20;

const TEMPLATES: [(&str, &str); 5] = [
    ("page.html", include_str!("page.html")),
    ("summary.html", include_str!("summary.html")),
    ("record.html", include_str!("record.html")),
    ("viewer.html", include_str!("viewer.html")),
    ("table.html", include_str!("table.html")),
];
const STYLE: &str = include_str!("style.css");
/// In the order in which they need each other.
const SCRIPTS: [&str; 4] = [
    include_str!("viewer.js"),
    include_str!("input.js"),
    include_str!("page.js"),
    include_str!("check.js"),
];

/// A page that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Where.
    pub path: PathBuf,
    /// How many results it shows.
    pub results: usize,
    /// Its size.
    pub bytes: u64,
}

/// Results in a folder: its own, or those of the folders in it, in the order of the papers.
///
/// # Errors
///
/// Where there is none, or one is damaged.
pub fn read(folder: &Path) -> Result<Vec<(PathBuf, Record)>> {
    let mut places = vec![folder.to_owned()];
    for entry in fs::read_dir(folder).map_err(LabError::io(folder))? {
        places.push(entry.map_err(LabError::io(folder))?.path());
    }
    // Unfinished ones have names that begin with a dot.
    let is_hidden = |p: &Path| {
        p.file_name()
            .is_some_and(|n| n.as_encoded_bytes().starts_with(b"."))
    };
    places.retain(|p| p.join(FILE).is_file() && (p == folder || !is_hidden(p)));
    let mut results = Vec::new();
    for place in places {
        let record = Record::read(&place)?;
        results.push((place, record));
    }
    if results.is_empty() {
        return Err(LabError::NoResults(folder.to_owned()));
    }
    results.sort_by_cached_key(|(place, record)| {
        let at = experiments::ALL.iter().position(|e| e.id == record.id);
        (at.unwrap_or(usize::MAX), place.clone())
    });
    Ok(results)
}

/// Writes `report.html` about all results in a folder, whole or not at all.
///
/// # Errors
///
/// Where there is no result, a file that one names cannot be read, or the page not be written.
pub fn write(folder: &Path) -> Result<Page> {
    write_to(folder, &folder.join(PAGE))
}

/// [`write()`] with a path for the page.
///
/// # Errors
///
/// Those of [`write()`].
pub fn write_to(folder: &Path, path: &Path) -> Result<Page> {
    let results = read(folder)?;
    let text = html(&results)?;
    specula_scene::atomic::replace(path, |file| file.write_all(text.as_bytes()))
        .map_err(LabError::io(path))?;
    Ok(Page {
        path: path.to_owned(),
        results: results.len(),
        bytes: text.len() as u64,
    })
}

/// The page about results and the folders that they are in.
fn html(results: &[(PathBuf, Record)]) -> Result<String> {
    let wrong = |e: minijinja::Error| LabError::Output(format!("{PAGE}: {e:#}"));
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    for (name, text) in TEMPLATES {
        environment.add_template(name, text).map_err(wrong)?;
    }
    let views = results
        .iter()
        .map(|(folder, record)| view::record(folder, record))
        .collect::<Result<Vec<_>>>()?;
    let page = environment.get_template("page.html").map_err(wrong)?;
    page.render(context! {
        counts => Value::from(Serde(view::counts(results))),
        records => Value::from(Serde(views)),
        version => env!("CARGO_PKG_VERSION"),
        style => STYLE,
        script => SCRIPTS.concat(),
    })
    .map_err(wrong)
}
