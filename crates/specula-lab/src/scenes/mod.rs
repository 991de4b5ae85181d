//! Scenes of the experiments, one file each, made by the program.

pub mod bathroom;
mod builder;
pub mod interior;
pub mod kitchen;
pub(crate) mod lighting;
pub mod orbs;
pub(crate) mod pots;
pub(crate) mod statues;
pub(crate) mod testball;
pub mod two_urns;
