//! What experiments leave: tables, pictures side by side, and the record of all.

pub mod comparison;
pub mod insets;
pub mod record;
pub mod table;

pub use comparison::{Comparison, Shot};
pub use insets::Inset;
pub use table::{Cell, Table};
