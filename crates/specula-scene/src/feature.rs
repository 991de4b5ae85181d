//! What a reader does with each feature of its format, as data.
//!
//! Every reader has one list of these; its dispatch is tested against the list, and the table of
//! features in the documentation is generated from it.

/// A feature of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Feature {
    /// What kind of thing it is: `material`, `texture`, `light`, `shape`, `camera`, `film` and so on, in
    /// the format's words.
    pub class: &'static str,
    /// The format's name for it.
    pub name: &'static str,
    /// What is done with it.
    pub support: Support,
}

/// What a reader does with a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// It is rendered as the format's own renderer does.
    Full,
    /// Something similar is rendered: what, and how similar. Where the picture changes visibly, loading
    /// gives a warning.
    Approximated(&'static str),
    /// It is an error: why.
    Refused(&'static str),
}

impl Feature {
    /// A feature that is fully supported.
    #[must_use]
    pub const fn full(class: &'static str, name: &'static str) -> Self {
        Self {
            class,
            name,
            support: Support::Full,
        }
    }

    /// A feature that is approximated, and how.
    #[must_use]
    pub const fn approximated(class: &'static str, name: &'static str, how: &'static str) -> Self {
        Self {
            class,
            name,
            support: Support::Approximated(how),
        }
    }

    /// A feature that is refused, and why.
    #[must_use]
    pub const fn refused(class: &'static str, name: &'static str, why: &'static str) -> Self {
        Self {
            class,
            name,
            support: Support::Refused(why),
        }
    }
}
