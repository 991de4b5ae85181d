//! How much light an interface passes on, integrated over directions.

pub mod interface;
mod interface_table;
