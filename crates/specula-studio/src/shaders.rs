//! The library's shaders, for what pages compute on a GPU.

use serde::Deserialize;
use serde_json::{Map, Value, json};
use specula_shaders::{Export, File, Language, TABLES_FILE};

use crate::request::fields;
use crate::{Answer, AskError};

/// Answers `shaders.{what}`.
pub(crate) fn answer(what: &str, request: Map<String, Value>) -> Result<Answer, AskError> {
    match what {
        "library" => library(&fields(request)?),
        _ => Err(AskError::unknown(&format!("shaders.{what}"))),
    }
}

/// `shaders.library`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Library {
    /// What is wanted with all that it calls; empty: everything.
    #[serde(default)]
    functions: Vec<String>,
}

/// Most names of functions in a request.
const MOST_FUNCTIONS: usize = 256;

fn library(request: &Library) -> Result<Answer, AskError> {
    if request.functions.len() > MOST_FUNCTIONS {
        let count = request.functions.len();
        return Err(AskError::new(format!(
            "functions: expected at most {MOST_FUNCTIONS} names, got {count}"
        )));
    }
    let functions: Vec<&str> = request.functions.iter().map(String::as_str).collect();
    let export = Export {
        functions: &functions,
        ..Export::new(Language::Wgsl)
    };
    let files = export.files().map_err(|e| AskError::new(e.to_string()))?;
    let (texts, tables): (Vec<File>, Vec<File>) = files
        .into_iter()
        .partition(|file| file.name == Language::Wgsl.text_file());
    let text = texts
        .first()
        .map(|file| String::from_utf8_lossy(&file.bytes));
    let answer = Answer::new(json!({ "wgsl": text }));
    let tables = tables.into_iter().find(|file| file.name == TABLES_FILE);
    let tables = tables.map(|file| file.bytes).unwrap_or_default();
    Ok(answer.with_u8("tables", &[tables.len()], tables))
}
