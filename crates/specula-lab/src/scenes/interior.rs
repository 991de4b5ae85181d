//! A living room with a fireplace: rough metal on most walls, daylight from one side.
//!
//! In the spirit of the room of Tokuyoshi and Eto 2024, figs. 1 and 8: large rough surfaces that
//! light each other.

use std::f64::consts::TAU;

use glam::{DMat4, DVec3, dvec3};
use specula_scene::Scene;

use super::builder::Builder;

/// The room, 16:9.
#[must_use]
pub(crate) fn interior() -> Scene {
    let eye = dvec3(1.75, -2.8, 1.45);
    let mut room = Builder::new([512, 288], eye, dvec3(-0.35, 1.2, 0.98), 50.0);
    shell(&mut room);
    window(&mut room);
    fireplace(&mut room);
    mantelpiece(&mut room);
    table(&mut room);
    seats(&mut room);
    lamp(&mut room);
    room.finish()
}

/// Walls, floor, ceiling, rug.
fn shell(room: &mut Builder) {
    let (low, high) = (dvec3(-3.2, -3.0, 0.0), dvec3(3.2, 3.0, 2.8));
    let [x, y, z] = [
        DVec3::X * (high.x - low.x),
        DVec3::Y * (high.y - low.y),
        DVec3::Z * high.z,
    ];
    let plaster = room.diffuse("plaster", [0.78, 0.76, 0.72]);
    let back = room.tinted("back wall", [0.90, 0.84, 0.74], 0.9);
    let left = room.tinted("left wall", [0.82, 0.87, 0.91], 0.7);
    room.quad(dvec3(low.x, low.y, high.z), y, x, plaster);
    room.quad(low, z, x, plaster);
    room.quad(dvec3(high.x, low.y, 0.0), z, y, plaster);
    room.quad(low, y, z, left);
    room.quad(dvec3(low.x, high.y, 0.0), x, z, back);
    let boards = [0.42, 0.52, 0.47].map(|alpha: f32| {
        let shade = 1.0 - 0.8 * (alpha - 0.42);
        let colour = [0.80, 0.62, 0.43].map(|c: f32| c * shade);
        room.tinted("board", colour, alpha)
    });
    let width = (high.x - low.x) / 16.0;
    for i in 0..16_u32 {
        let corner = dvec3(low.x + width * f64::from(i), low.y, 0.0);
        let board = boards[(i * i + i / 3) as usize % boards.len()];
        room.quad(corner, DVec3::X * width, y, board);
    }
    let rug = room.diffuse("rug", [0.42, 0.10, 0.09]);
    room.cuboid(dvec3(-1.35, -1.15, 0.0), dvec3(1.2, 1.0, 0.015), rug);
    let skirting = room.diffuse("skirting", [0.75, 0.73, 0.70]);
    room.cuboid(dvec3(-3.2, 2.97, 0.0), dvec3(-1.1, 3.0, 0.14), skirting);
    room.cuboid(dvec3(1.1, 2.97, 0.0), dvec3(3.2, 3.0, 0.14), skirting);
    room.cuboid(dvec3(-3.2, -3.0, 0.0), dvec3(-3.17, 3.0, 0.14), skirting);
}

/// Daylight in the right wall, and its bars.
fn window(room: &mut Builder) {
    let black = room.diffuse("sky", [0.0; 3]);
    let corner = dvec3(3.19, -1.3, 0.7);
    room.quad(corner, DVec3::Z * 1.6, DVec3::Y * 2.6, black);
    room.glow([6.0, 6.9, 8.2]);
    let bar = room.diffuse("bar", [0.8; 3]);
    for y in [-1.3, 0.0, 1.3] {
        room.cuboid(dvec3(3.12, y - 0.04, 0.66), dvec3(3.2, y + 0.04, 2.34), bar);
    }
    for z in [0.7, 1.5, 2.3] {
        room.cuboid(dvec3(3.12, -1.3, z - 0.04), dvec3(3.2, 1.3, z + 0.04), bar);
    }
}

/// Chimney breast, opening, hearth, fire.
fn fireplace(room: &mut Builder) {
    let brick = room.tinted("chimney", [0.80, 0.56, 0.46], 1.0);
    let soot = room.diffuse("soot", [0.06, 0.055, 0.05]);
    let stone = room.tinted("hearth", [0.55, 0.56, 0.58], 0.6);
    room.cuboid(dvec3(-1.1, 2.4, 0.0), dvec3(-0.55, 3.0, 2.8), brick);
    room.cuboid(dvec3(0.55, 2.4, 0.0), dvec3(1.1, 3.0, 2.8), brick);
    room.cuboid(dvec3(-0.55, 2.4, 0.86), dvec3(0.55, 3.0, 2.8), brick);
    room.cuboid(dvec3(-0.55, 2.95, 0.0), dvec3(0.55, 3.0, 0.86), soot);
    room.cuboid(dvec3(-1.15, 1.95, 0.0), dvec3(1.15, 2.4, 0.06), stone);
    let iron = room.metal("Fe", 0.6);
    for x in [-0.3, 0.3] {
        let foot = dvec3(x, 2.45, 0.0);
        room.lathe(foot, &[[0.05, 0.0], [0.02, 0.05], [0.02, 0.3]], iron);
        room.sphere(foot + DVec3::Z * 0.33, 0.045, iron);
    }
    let bark = room.diffuse("logs", [0.12, 0.07, 0.04]);
    for (x, angle) in [(-0.08, 0.15), (0.06, -0.2)] {
        let place = DMat4::from_translation(dvec3(x, 2.65, 0.16)) * DMat4::from_rotation_z(angle);
        let half = dvec3(0.36, 0.06, 0.06);
        room.turned_cuboid(place, -half, half, bark);
    }
    let black = room.diffuse("flame", [0.0; 3]);
    for (x, size) in [(-0.2, 0.8), (0.0, 1.15), (0.19, 0.7)] {
        let flame = [[0.01, 0.0], [0.09, 0.06], [0.1, 0.12], [0.05, 0.27]];
        let mut profile: Vec<[f64; 2]> = flame.map(|[r, z]| [r * size, z * size]).to_vec();
        profile.push([0.002, 0.42 * size]);
        room.lathe(dvec3(x, 2.66, 0.2), &profile, black);
        room.glow([24.0, 9.5, 2.4]);
    }
}

/// The shelf over the fire, and what stands on it.
fn mantelpiece(room: &mut Builder) {
    let copper = room.metal("Cu", 0.3);
    room.cuboid(dvec3(-1.25, 2.22, 1.1), dvec3(1.25, 2.4, 1.17), copper);
    let gold = room.metal("Au", 0.5);
    let silver = room.metal("Ag", 0.8);
    let top = 1.17;
    let vase = [
        [0.05, 0.0],
        [0.09, 0.06],
        [0.1, 0.14],
        [0.05, 0.25],
        [0.045, 0.3],
        [0.07, 0.34],
    ];
    room.lathe(dvec3(-0.95, 2.31, top), &vase, silver);
    room.lathe(dvec3(0.95, 2.31, top), &vase, silver);
    room.sphere(dvec3(-0.55, 2.31, top + 0.08), 0.08, gold);
    let stick = [[0.06, 0.0], [0.015, 0.03], [0.015, 0.22], [0.04, 0.26]];
    room.lathe(dvec3(0.5, 2.31, top), &stick, gold);
    room.lathe(dvec3(0.68, 2.31, top), &stick, gold);
    room.cuboid(dvec3(-0.5, 2.36, 1.4), dvec3(0.5, 2.4, 2.15), gold);
    let canvas = room.diffuse("picture", [0.16, 0.26, 0.36]);
    room.cuboid(dvec3(-0.43, 2.34, 1.47), dvec3(0.43, 2.36, 2.08), canvas);
    let sun = room.diffuse("its sun", [0.85, 0.55, 0.15]);
    room.cuboid(dvec3(0.05, 2.33, 1.72), dvec3(0.24, 2.34, 1.91), sun);
}

/// A low round table with a tea set.
fn table(room: &mut Builder) {
    let brass = room.metal("CuZn", 0.45);
    let foot = dvec3(-0.1, 0.1, 0.015);
    let profile = [
        [0.3, 0.0],
        [0.28, 0.03],
        [0.05, 0.06],
        [0.05, 0.4],
        [0.6, 0.41],
        [0.61, 0.43],
        [0.6, 0.45],
        [0.001, 0.45],
    ];
    room.lathe(foot, &profile, brass);
    let top = foot + DVec3::Z * 0.45;
    let gold = room.metal("Au", 0.7);
    let pot = [
        [0.07, 0.0],
        [0.13, 0.05],
        [0.14, 0.11],
        [0.1, 0.18],
        [0.05, 0.2],
        [0.05, 0.22],
        [0.001, 0.23],
    ];
    room.lathe(top + dvec3(-0.2, 0.12, 0.0), &pot, gold);
    room.sphere(top + dvec3(-0.2, 0.12, 0.245), 0.022, gold);
    let copper = room.metal("Cu", 1.0);
    let bowl = [
        [0.06, 0.0],
        [0.13, 0.04],
        [0.17, 0.11],
        [0.16, 0.11],
        [0.12, 0.05],
        [0.001, 0.02],
    ];
    room.lathe(top + dvec3(0.22, -0.08, 0.0), &bowl, copper);
    let fruit = room.diffuse("fruit", [0.75, 0.33, 0.05]);
    for i in 0..3_u32 {
        let (sin, cos) = (TAU * f64::from(i) / 3.0 + 0.4).sin_cos();
        let place = top + dvec3(0.22 + 0.055 * cos, -0.08 + 0.055 * sin, 0.09);
        room.sphere(place, 0.05, fruit);
    }
    let silver = room.metal("Ag", 0.4);
    room.sphere(top + dvec3(-0.15, -0.28, 0.07), 0.07, silver);
}

/// A sofa on the left, an armchair on the right.
fn seats(room: &mut Builder) {
    let blue = room.diffuse("sofa", [0.10, 0.17, 0.30]);
    for (low, high) in [
        ([-3.0, -1.3, 0.1], [-2.05, 1.0, 0.42]),
        ([-3.1, -1.3, 0.1], [-2.8, 1.0, 0.88]),
        ([-3.05, -1.5, 0.1], [-2.05, -1.3, 0.62]),
        ([-3.05, 1.0, 0.1], [-2.05, 1.2, 0.62]),
    ] {
        room.cuboid(low.into(), high.into(), blue);
    }
    let cushion = room.diffuse("cushion", [0.72, 0.62, 0.40]);
    let half = dvec3(0.22, 0.07, 0.22);
    for (y, turn) in [(0.68, 1.2), (-0.1, 1.75)] {
        let place = DMat4::from_translation(dvec3(-2.62, y, 0.64))
            * DMat4::from_rotation_z(turn)
            * DMat4::from_rotation_x(0.35);
        room.turned_cuboid(place, -half, half, cushion);
    }
    let green = room.diffuse("armchair", [0.13, 0.22, 0.13]);
    let place = DMat4::from_translation(dvec3(1.95, 1.35, 0.0)) * DMat4::from_rotation_z(-0.75);
    for (low, high) in [
        ([-0.4, -0.4, 0.12], [0.4, 0.4, 0.42]),
        ([-0.4, 0.25, 0.12], [0.4, 0.42, 0.95]),
        ([-0.5, -0.4, 0.12], [-0.36, 0.42, 0.62]),
        ([0.36, -0.4, 0.12], [0.5, 0.42, 0.62]),
    ] {
        room.turned_cuboid(place, low.into(), high.into(), green);
    }
}

/// A globe on a stand in the corner.
fn lamp(room: &mut Builder) {
    let steel = room.metal("Cr", 0.35);
    let foot = dvec3(-2.35, 2.3, 0.0);
    let profile = [
        [0.18, 0.0],
        [0.17, 0.03],
        [0.02, 0.05],
        [0.02, 1.4],
        [0.06, 1.44],
    ];
    room.lathe(foot, &profile, steel);
    let black = room.diffuse("globe", [0.0; 3]);
    room.sphere(foot + DVec3::Z * 1.6, 0.18, black);
    room.glow([5.0, 3.9, 2.5]);
}
