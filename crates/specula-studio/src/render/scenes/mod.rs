//! The scenes of the program: small ones that show one thing each.

mod ball;
mod build;
mod furnace;
mod row;

use specula_scene::{Scene, builtin};

/// Name, title, and what makes it.
pub(super) type BuiltIn = (&'static str, &'static str, fn() -> Scene);

/// The scene that the command line renders where none is named.
pub(super) const ORBS: &str = "orbs";

/// All of them, the one that pages begin with first.
pub(super) const BUILT_IN: &[BuiltIn] = &[
    (ORBS, "Orbs of metal", builtin::orbs),
    ("ball", "A ball of gold under two lamps", ball::scene),
    ("row", "Gold, from smooth to rough", row::scene),
    (
        "furnace",
        "Furnace: white metal in white light",
        furnace::scene,
    ),
];
