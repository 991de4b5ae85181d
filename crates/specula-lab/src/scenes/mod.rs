//! Scenes of the experiments, one file each, made by the program.

pub(crate) mod bathroom;
mod builder;
pub(crate) mod interior;
pub(crate) mod kitchen;
pub(crate) mod lighting;
pub(crate) mod orbs;
pub(crate) mod pots;
pub(crate) mod statues;
pub(crate) mod testball;
pub(crate) mod two_urns;
