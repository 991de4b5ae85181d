//! A kitchen: painted cupboards, brushed steel, pots, light from a window and from the ceiling.
//!
//! In the place of the kitchen of Tokuyoshi and Eto 2024, table 3: rough metal, but not on the
//! surfaces that fill the room.

use glam::{DVec3, dvec3};
use specula_scene::Scene;

use super::builder::Builder;

/// Height of the worktop.
const TOP: f64 = 0.92;

/// The room, 16:9.
#[must_use]
pub(crate) fn kitchen() -> Scene {
    let eye = dvec3(1.35, -2.35, 1.5);
    let mut room = Builder::new([512, 288], eye, dvec3(-0.25, 1.0, 1.12), 50.0);
    shell(&mut room);
    lights(&mut room);
    cupboards(&mut room);
    stove(&mut room);
    pots(&mut room);
    island(&mut room);
    room.finish()
}

/// Walls, ceiling, tiled floor.
fn shell(room: &mut Builder) {
    let (low, high) = (dvec3(-2.4, -2.6, 0.0), dvec3(2.4, 2.2, 2.6));
    let [x, y, z] = [
        DVec3::X * (high.x - low.x),
        DVec3::Y * (high.y - low.y),
        DVec3::Z * high.z,
    ];
    let paint = room.diffuse("walls", [0.80, 0.79, 0.74]);
    let cream = room.diffuse("back wall", [0.74, 0.70, 0.56]);
    room.quad(dvec3(low.x, low.y, high.z), y, x, paint);
    room.quad(low, z, x, paint);
    room.quad(dvec3(high.x, low.y, 0.0), z, y, paint);
    room.quad(low, y, z, paint);
    room.quad(dvec3(low.x, high.y, 0.0), x, z, cream);
    let tiles = [[0.62, 0.60, 0.56], [0.20, 0.22, 0.24]].map(|c| room.diffuse("tile", c));
    for i in 0..8_u32 {
        for j in 0..8_u32 {
            let corner = low + dvec3(0.6 * f64::from(i), 0.6 * f64::from(j), 0.0);
            let tile = tiles[((i + j) % 2) as usize];
            room.quad(corner, DVec3::X * 0.6, DVec3::Y * 0.6, tile);
        }
    }
}

/// A window in the left wall and a panel in the ceiling.
fn lights(room: &mut Builder) {
    let black = room.diffuse("light", [0.0; 3]);
    room.quad(
        dvec3(-2.39, -0.9, 1.15),
        DVec3::Y * 1.8,
        DVec3::Z * 1.1,
        black,
    );
    room.glow([8.5, 9.2, 10.0]);
    room.quad(
        dvec3(-0.8, -0.8, 2.59),
        DVec3::Y * 0.8,
        DVec3::X * 1.6,
        black,
    );
    room.glow([4.2, 3.9, 3.4]);
    let bar = room.diffuse("bar", [0.8; 3]);
    room.cuboid(dvec3(-2.4, -0.03, 1.1), dvec3(-2.34, 0.03, 2.3), bar);
    room.cuboid(dvec3(-2.4, -1.0, 1.08), dvec3(-2.2, 1.0, 1.15), bar);
}

/// Below and above the worktops, and the refrigerator.
fn cupboards(room: &mut Builder) {
    let teal = room.diffuse("doors", [0.16, 0.36, 0.38]);
    let dark = room.diffuse("plinth", [0.05; 3]);
    let steel = room.metal("Fe", 0.45);
    let knob = room.metal("CuZn", 0.3);
    room.cuboid(dvec3(-2.3, 1.65, 0.0), dvec3(2.3, 2.2, 0.1), dark);
    room.cuboid(dvec3(-2.35, 1.6, TOP - 0.04), dvec3(1.45, 2.2, TOP), steel);
    room.cuboid(dvec3(-2.4, -1.4, TOP - 0.04), dvec3(-1.8, 1.6, TOP), steel);
    room.cuboid(dvec3(-2.4, -1.4, 0.0), dvec3(-1.86, 1.6, TOP - 0.04), teal);
    for x in [-2.3, -1.7, -1.1, 0.25, 0.85] {
        let door = dvec3(x + 0.01, 1.63, 0.1);
        room.cuboid(door, dvec3(x + 0.59, 2.2, TOP - 0.05), teal);
        room.sphere(dvec3(x + 0.5, 1.61, 0.75), 0.022, knob);
    }
    for x in [-2.3, -1.7, 0.3, 0.9] {
        let door = dvec3(x + 0.01, 1.86, 1.5);
        room.cuboid(door, dvec3(x + 0.59, 2.2, 2.2), teal);
        room.sphere(dvec3(x + 0.5, 1.84, 1.58), 0.022, knob);
    }
    let fridge = room.metal("Ti", 0.35);
    room.cuboid(dvec3(1.55, 1.45, 0.03), dvec3(2.35, 2.2, 0.78), fridge);
    room.cuboid(dvec3(1.55, 1.45, 0.8), dvec3(2.35, 2.2, 1.95), fridge);
    for (bottom, top) in [(0.45, 0.72), (0.88, 1.35)] {
        room.cuboid(dvec3(1.6, 1.4, bottom), dvec3(1.64, 1.43, top), knob);
    }
}

/// Stove, hood and its wall.
fn stove(room: &mut Builder) {
    let steel = room.metal("Cr", 0.6);
    let glass = room.diffuse("oven", [0.03; 3]);
    room.cuboid(dvec3(-0.48, 1.58, 0.1), dvec3(0.23, 2.2, TOP + 0.01), steel);
    room.cuboid(dvec3(-0.4, 1.565, 0.25), dvec3(0.15, 1.58, 0.68), glass);
    let bar = room.metal("Cr", 0.3);
    room.cuboid(dvec3(-0.4, 1.53, 0.74), dvec3(0.15, 1.55, 0.765), bar);
    let wall = room.metal("Al", 0.7);
    room.cuboid(dvec3(-1.08, 2.17, TOP), dvec3(0.28, 2.2, 2.6), wall);
    room.cuboid(dvec3(-0.5, 1.7, 1.62), dvec3(0.25, 2.18, 1.7), steel);
    room.cuboid(dvec3(-0.28, 1.9, 1.7), dvec3(0.03, 2.18, 2.6), steel);
}

/// Pots and pans on the stove, a rail with ladles.
fn pots(room: &mut Builder) {
    let copper = room.metal("Cu", 0.4);
    let aluminium = room.metal("Al", 0.8);
    let pot = |r: f64, h: f64| {
        [
            [0.001, 0.0],
            [r, 0.005],
            [r, h],
            [r - 0.008, h],
            [r - 0.008, 0.02],
            [0.001, 0.02],
        ]
    };
    room.lathe(dvec3(-0.3, 1.85, TOP + 0.02), &pot(0.12, 0.16), copper);
    room.lathe(dvec3(0.05, 1.8, TOP + 0.02), &pot(0.14, 0.09), aluminium);
    let jar = [
        [0.06, 0.0],
        [0.08, 0.05],
        [0.08, 0.16],
        [0.05, 0.2],
        [0.05, 0.22],
        [0.001, 0.24],
    ];
    for (x, alpha) in [(-1.5, 0.3), (-1.28, 0.5), (-1.06, 0.7)] {
        let tin = room.metal("Cu", alpha);
        room.lathe(dvec3(x, 1.95, TOP), &jar, tin);
    }
    let white = room.diffuse("china", [0.8, 0.8, 0.78]);
    for i in 0..5_u32 {
        let foot = dvec3(0.75, 1.9, TOP + 0.018 * f64::from(i));
        room.lathe(foot, &[[0.06, 0.0], [0.13, 0.02], [0.001, 0.012]], white);
    }
}

/// A table in the middle.
fn island(room: &mut Builder) {
    let wood = room.diffuse("wood", [0.42, 0.27, 0.14]);
    room.cuboid(dvec3(-0.9, -0.35, 0.84), dvec3(0.75, 0.5, 0.9), wood);
    for (x, y) in [(-0.85, -0.3), (0.64, -0.3), (-0.85, 0.39), (0.64, 0.39)] {
        room.cuboid(dvec3(x, y, 0.0), dvec3(x + 0.07, y + 0.07, 0.84), wood);
    }
    let silver = room.metal("Ag", 0.5);
    let bowl = [
        [0.08, 0.0],
        [0.17, 0.05],
        [0.21, 0.13],
        [0.2, 0.13],
        [0.16, 0.06],
        [0.001, 0.02],
    ];
    let middle = dvec3(-0.1, 0.1, 0.9);
    room.lathe(middle, &bowl, silver);
    for (colour, dx, dy) in [
        ([0.55, 0.05, 0.04], 0.06, 0.03),
        ([0.35, 0.55, 0.08], -0.06, 0.05),
        ([0.75, 0.55, 0.06], 0.0, -0.07),
    ] {
        let fruit = room.diffuse("fruit", colour);
        room.sphere(middle + dvec3(dx, dy, 0.1), 0.055, fruit);
    }
    let board = room.diffuse("board", [0.6, 0.42, 0.22]);
    room.cuboid(dvec3(0.25, -0.2, 0.9), dvec3(0.6, 0.25, 0.92), board);
    let mug = room.metal("Ti", 0.9);
    let profile = [
        [0.001, 0.0],
        [0.045, 0.002],
        [0.045, 0.11],
        [0.04, 0.11],
        [0.04, 0.01],
    ];
    room.lathe(dvec3(-0.6, -0.1, 0.9), &profile, mug);
}
