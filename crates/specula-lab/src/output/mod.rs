//! Output of experiments: tables, and pictures side by side.

pub mod comparison;
pub mod insets;
pub mod table;

pub use comparison::{PictureComparison, Shot};
pub use insets::Inset;
pub use table::{Cell, Table};
