//! The mistakes of one mesh's file.

use std::fmt;

use crate::scene::Mesh;

/// Most mistakes of a file that are listed: one broken file must not crowd out the others of a scene.
pub(crate) const MOST: usize = 20;

/// One mistake. It displays with its line, where it has one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    /// Line of the file, from 1.
    pub(crate) line: Option<usize>,
    pub(crate) message: String,
}

impl Fault {
    pub(crate) fn at_line(line: usize, message: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            message: message.into(),
        }
    }
}

impl<T: Into<String>> From<T> for Fault {
    fn from(message: T) -> Self {
        Self {
            line: None,
            message: message.into(),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Where the mistakes of a file go.
///
/// In an ordinary load the first ends the reading. In a check reading goes on for as long as what
/// follows still makes sense.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    collects: bool,
    list: Vec<Fault>,
    more: usize,
}

impl Faults {
    /// * `collects`: whether to go on after a mistake, as a check does.
    pub(crate) fn new(collects: bool) -> Self {
        Self {
            collects,
            ..Self::default()
        }
    }

    /// Whether nothing is wrong so far.
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Records a mistake.
    ///
    /// # Errors
    ///
    /// The mistake itself, in an ordinary load.
    pub(crate) fn record(&mut self, fault: impl Into<Fault>) -> Result<(), Fault> {
        let fault = fault.into();
        if !self.collects {
            return Err(fault);
        }
        if self.list.len() < MOST {
            self.list.push(fault);
        } else {
            self.more += 1;
        }
        Ok(())
    }

    /// Adds the mistakes that another has recorded.
    ///
    /// # Errors
    ///
    /// The first of them, in an ordinary load.
    pub(crate) fn append(&mut self, other: Self) -> Result<(), Fault> {
        for fault in other.list {
            self.record(fault)?;
        }
        self.more += other.more;
        Ok(())
    }

    /// What was read, if nothing is wrong with it.
    ///
    /// # Errors
    ///
    /// All that was recorded, and the error that ended the reading: one at least.
    pub(crate) fn end<T>(mut self, read: Result<T, Fault>) -> Result<T, Vec<Fault>> {
        match read {
            Ok(value) if self.list.is_empty() => return Ok(value),
            Ok(_) => {}
            Err(last) => self.list.push(last),
        }
        if self.more > 0 {
            self.list
                .push(format!("and {} more mistakes", self.more).into());
        }
        Err(self.list)
    }
}

/// Vertices of a mesh that are not finite, and triangles of vertices that do not exist.
///
/// # Errors
///
/// Those of [`Faults::record`].
pub(crate) fn of_mesh(mesh: &Mesh, faults: &mut Faults) -> Result<(), Fault> {
    for (i, p) in mesh.positions.iter().enumerate() {
        if p.iter().any(|x| !x.is_finite()) {
            faults.record(format!("vertex {i} is not finite: {p:?}"))?;
        }
    }
    let count = mesh.positions.len();
    for (i, [a, b, c]) in mesh.triangles.iter().enumerate() {
        if [a, b, c].into_iter().any(|v| *v as usize >= count) {
            faults.record(format!(
                "triangle {i} refers to vertices {a}, {b}, {c}, but there are {count} vertices"
            ))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_ends_with_the_first_and_a_check_names_some_and_counts_the_rest() {
        let mut load = Faults::new(false);
        assert_eq!(load.record("a"), Err(Fault::from("a")));
        let mut check = Faults::new(true);
        for i in 0..MOST + 3 {
            check.record(Fault::at_line(i, "x")).unwrap();
        }
        let found = check.end(Err::<(), _>("last".into())).unwrap_err();
        assert_eq!(found.len(), MOST + 2);
        let last: Vec<String> = found[MOST - 1..].iter().map(Fault::to_string).collect();
        assert_eq!(last, ["line 19: x", "last", "and 3 more mistakes"]);
        assert_eq!(Faults::new(true).end(Ok(7)), Ok(7));
    }
}
