//! All kinds of lobes: found by name.

use crate::catalogue::KINDS;
use crate::given::{Argument, same};
use crate::kind::Kind;
use crate::{LobeError, NamedLobe};

/// Every kind.
#[must_use]
pub fn kinds() -> &'static [Kind] {
    &KINDS
}

impl Kind {
    /// A kind by its name; hyphens and underscores are the same.
    ///
    /// # Errors
    /// Where there is none of this name.
    pub fn named(name: &str) -> Result<&'static Self, LobeError> {
        KINDS.iter().find(|k| same(k.name, name)).ok_or_else(|| {
            let known: Vec<_> = KINDS.iter().map(|k| k.name).collect();
            let known = known.join(", ");
            LobeError(format!("no such lobe: '{name}' (expected one of {known})"))
        })
    }
}

/// Makes a lobe of a kind.
///
/// # Errors
/// Where there is no such kind, or as [`Kind::make`].
pub fn make(kind: &str, arguments: &[Argument<'_>]) -> Result<NamedLobe, LobeError> {
    Kind::named(kind)?.make(arguments)
}
