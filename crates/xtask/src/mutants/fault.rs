//! Faults as cargo-mutants lists them.

use std::process::Command;

use serde_json::Value;

use crate::Result;

/// A piece of a file, and what stands there instead.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    /// With its place.
    pub(super) name: String,
    /// From the workspace's root.
    pub(super) file: String,
    replacement: String,
    /// Where the piece begins and ends.
    span: [Place; 2],
}

/// Both count from 1, columns in characters.
#[derive(Clone, Copy, Debug)]
struct Place {
    line: usize,
    column: usize,
}

/// The faults that a command of cargo-mutants chooses.
pub(super) fn list(command: &mut Command) -> Result<Vec<Fault>> {
    let output = command.args(["--list", "--json"]).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let faults: Vec<Value> = serde_json::from_slice(&output.stdout)?;
    let faults: Option<Vec<Fault>> = faults.iter().map(Fault::read).collect();
    faults.ok_or_else(|| "cargo-mutants lists faults in a form of its own".into())
}

impl Fault {
    fn read(value: &Value) -> Option<Self> {
        let text = |key: &str| Some(value.get(key)?.as_str()?.to_owned());
        let place = |key: &str| {
            let place = value.get("span")?.get(key)?;
            let number = |key: &str| usize::try_from(place.get(key)?.as_u64()?).ok();
            Some(Place {
                line: number("line")?,
                column: number("column")?,
            })
        };
        Some(Self {
            name: text("name")?,
            file: text("file")?,
            replacement: text("replacement")?,
            span: [place("start")?, place("end")?],
        })
    }

    /// The file with the fault.
    pub(super) fn planted(&self, text: &str) -> Result<String> {
        let [start, end] = self.span.map(|place| place.offset(text));
        let (Some(start), Some(end)) = (start, end) else {
            return Err(format!("{}: the file is too short", self.name).into());
        };
        Ok(format!(
            "{}{}{}",
            &text[..start],
            self.replacement,
            &text[end..]
        ))
    }

    #[cfg(test)]
    pub(super) fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            file: String::new(),
            replacement: String::new(),
            span: [Place { line: 1, column: 1 }; 2],
        }
    }
}

impl Place {
    /// In bytes.
    fn offset(self, text: &str) -> Option<usize> {
        let line = text.split_inclusive('\n').nth(self.line.checked_sub(1)?)?;
        let begin = line.as_ptr() as usize - text.as_ptr() as usize;
        let column = self.column.checked_sub(1)?;
        let ends = line.char_indices().map(|(at, _)| at).chain([line.len()]);
        Some(begin + ends.into_iter().nth(column)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_read_and_planted() {
        let json = r#"{"name": "a.rs:2:6: replace + with -", "file": "a.rs", "genre": "BinaryOperator", "replacement": "-",
            "span": {"start": {"line": 2, "column": 6}, "end": {"line": 2, "column": 7}}}"#;
        let fault = Fault::read(&serde_json::from_str(json).unwrap()).unwrap();
        let planted = fault.planted("fn f() {\n ä = + b\n}\n").unwrap();
        assert_eq!(planted, "fn f() {\n ä = - b\n}\n");
        assert!(fault.planted("one line").is_err());
        assert!(Fault::read(&Value::Null).is_none());
    }
}
