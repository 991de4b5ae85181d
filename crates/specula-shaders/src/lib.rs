//! The microfacet library as WGSL.
//!
//! `wgsl/` mirrors the folders of `specula-bsdf`: each module is the twin of the Rust file of its name.
//! [`MODULES`] lists them, and [`compose()`] puts the wanted ones and what they import into one text:
//!
//! ```
//! # fn main() -> Result<(), specula_shaders::ComposeError> {
//! let all = specula_shaders::compose(&[])?;
//! # let _ = all;
//! # Ok(())
//! # }
//! ```

mod compose;
mod cpp;
mod declarations;
mod document;
mod error;
mod export;
mod header;
mod items;
mod language;
mod modules;
mod names;
mod needed;
mod papers;
mod restore;
mod slang;
mod spirv;
mod tables;
mod translate;

pub use compose::{compose, ordered};
pub use cpp::to_cpp;
pub use declarations::{Declaration, DeclarationKind, Field, declarations, fields};
pub use error::ComposeError;
pub use export::{Export, ExportError, File, TABLES_FILE, export, translated};
pub use language::Language;
pub use modules::{Import, MODULES, Module};
pub use tables::{offset, tables};
pub use translate::TranslateError;
