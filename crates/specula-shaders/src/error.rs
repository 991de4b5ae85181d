//! Why modules cannot be composed.

use thiserror::Error;

/// What is wrong with a request, or with the modules themselves.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ComposeError {
    /// A module was asked for that there is none of.
    #[error("there is no module `{name}`{}", did_you_mean(nearest))]
    UnknownModule {
        /// What was asked for.
        name: String,
        /// Names of modules that are spelt nearly so.
        nearest: Vec<&'static str>,
    },
    /// A function was asked for that there is none of.
    #[error("there is no function `{name}`{}", did_you_mean(nearest))]
    UnknownFunction {
        /// What was asked for.
        name: String,
        /// Names of functions that are spelt nearly so.
        nearest: Vec<String>,
    },
    /// A module imports from one that there is none of.
    #[error("module `{module}` imports from `{path}`, which does not exist")]
    UnknownImport {
        /// The module with the import.
        module: String,
        /// What it imports from.
        path: String,
    },
    /// Modules import each other.
    #[error("modules import each other: {}", .0.join(" -> "))]
    Cycle(Vec<String>),
    /// An import that is not in the form that [`Module::imports`](crate::Module::imports) reads.
    #[error(
        "module `{module}`: expected `import package::folder::module::{{name}};`, found `{statement}`"
    )]
    Syntax {
        /// The module with the import.
        module: String,
        /// What it says.
        statement: String,
    },
}

fn did_you_mean(nearest: &[impl std::fmt::Display]) -> String {
    if nearest.is_empty() {
        return String::new();
    }
    let names: Vec<String> = nearest.iter().map(|n| format!("`{n}`")).collect();
    format!("; did you mean {}?", names.join(" or "))
}
