//! A bathroom: white walls, a wide window, rough metal that hardly reflects other metal.
//!
//! In the place of the bathroom of Tokuyoshi and Eto 2024, fig. 9, where caps have no fireflies.

use glam::{DVec3, dvec3};
use specula_scene::Scene;

use super::builder::Builder;

/// The room, 16:9.
#[must_use]
pub(crate) fn bathroom() -> Scene {
    let eye = dvec3(1.25, -2.1, 1.5);
    let mut room = Builder::new([512, 288], eye, dvec3(-0.2, 1.0, 0.9), 50.0);
    shell(&mut room);
    window(&mut room);
    tub(&mut room);
    basin(&mut room);
    details(&mut room);
    room.finish()
}

/// Walls, ceiling, floor.
fn shell(room: &mut Builder) {
    let (low, high) = (dvec3(-2.0, -2.3, 0.0), dvec3(2.0, 2.0, 2.5));
    let [x, y, z] = [
        DVec3::X * (high.x - low.x),
        DVec3::Y * (high.y - low.y),
        DVec3::Z * high.z,
    ];
    let white = room.diffuse("walls", [0.72, 0.73, 0.72]);
    let blue = room.tinted("back wall", [0.42, 0.56, 0.62], 0.6);
    room.quad(dvec3(low.x, low.y, high.z), y, x, white);
    room.quad(low, z, x, white);
    room.quad(dvec3(high.x, low.y, 0.0), z, y, white);
    room.quad(low, y, z, white);
    room.quad(dvec3(low.x, high.y, 0.0), x, z, blue);
    let slabs = [0.65, 0.8].map(|alpha: f32| {
        let grey = 0.3 + 0.25 * alpha;
        room.tinted("slab", [grey, grey * 0.94, grey * 0.86], alpha)
    });
    for i in 0..5_u32 {
        for j in 0..6_u32 {
            let corner = low + dvec3(0.8 * f64::from(i), 0.72 * f64::from(j), 0.0);
            let slab = slabs[((i + j) % 2) as usize];
            room.quad(corner, DVec3::X * 0.8, DVec3::Y * 0.72, slab);
        }
    }
    let border = room.tinted("border", [0.55, 0.5, 0.4], 0.6);
    room.cuboid(dvec3(-2.0, 1.985, 1.25), dvec3(2.0, 2.0, 1.37), border);
}

/// Daylight in the left wall.
fn window(room: &mut Builder) {
    let black = room.diffuse("sky", [0.0; 3]);
    let corner = dvec3(-1.99, -1.5, 0.95);
    room.quad(corner, DVec3::Y * 2.8, DVec3::Z * 1.3, black);
    room.glow([4.4, 4.9, 5.4]);
    let bar = room.diffuse("bar", [0.8; 3]);
    for y in [-1.5, -0.1, 1.3] {
        room.cuboid(dvec3(-2.0, y - 0.03, 0.9), dvec3(-1.94, y + 0.03, 2.3), bar);
    }
    room.cuboid(dvec3(-2.0, -1.55, 0.88), dvec3(-1.85, 1.35, 0.95), bar);
}

/// The bath, along the back wall.
fn tub(room: &mut Builder) {
    let enamel = room.diffuse("enamel", [0.82; 3]);
    for (low, high) in [
        ([-1.9, 1.2, 0.0], [0.0, 1.26, 0.6]),
        ([-1.9, 1.9, 0.0], [0.0, 1.97, 0.6]),
        ([-1.9, 1.26, 0.0], [-1.82, 1.9, 0.6]),
        ([-0.08, 1.26, 0.0], [0.0, 1.9, 0.6]),
        ([-1.82, 1.26, 0.0], [-0.08, 1.9, 0.15]),
    ] {
        room.cuboid(low.into(), high.into(), enamel);
    }
    let rim = room.metal("Ti", 0.5);
    room.cuboid(dvec3(-1.93, 1.17, 0.6), dvec3(0.03, 1.27, 0.635), rim);
    room.cuboid(dvec3(-0.09, 1.27, 0.6), dvec3(0.03, 1.97, 0.635), rim);
    let tap = room.metal("Cr", 0.3);
    room.cuboid(dvec3(-1.0, 1.8, 0.9), dvec3(-0.94, 2.0, 0.94), tap);
    room.cuboid(dvec3(-1.0, 1.8, 0.82), dvec3(-0.94, 1.84, 0.9), tap);
}

/// A basin on its cupboard, and the mirror over it.
fn basin(room: &mut Builder) {
    let cupboard = room.tinted("cupboard", [0.50, 0.36, 0.26], 0.6);
    room.cuboid(dvec3(0.55, 1.45, 0.12), dvec3(1.75, 2.0, 0.78), cupboard);
    let stone = room.diffuse("top", [0.25, 0.26, 0.27]);
    room.cuboid(dvec3(0.5, 1.4, 0.78), dvec3(1.8, 2.0, 0.83), stone);
    let china = room.diffuse("china", [0.82; 3]);
    let bowl = [
        [0.1, 0.0],
        [0.18, 0.05],
        [0.24, 0.14],
        [0.225, 0.14],
        [0.16, 0.06],
        [0.001, 0.03],
    ];
    room.lathe(dvec3(1.15, 1.7, 0.83), &bowl, china);
    let tap = room.metal("Cr", 0.3);
    let post = [[0.04, 0.0], [0.018, 0.02], [0.018, 0.26], [0.001, 0.27]];
    room.lathe(dvec3(1.15, 1.95, 0.83), &post, tap);
    room.cuboid(dvec3(1.135, 1.78, 1.06), dvec3(1.165, 1.96, 1.085), tap);
    let knob = room.metal("CuZn", 0.5);
    for x in [1.08, 1.22] {
        room.sphere(dvec3(x, 1.43, 0.6), 0.025, knob);
    }
    let frame = room.metal("CuZn", 0.6);
    room.cuboid(dvec3(0.68, 1.965, 1.45), dvec3(1.62, 2.0, 2.25), frame);
    let mirror = room.metal("Ag", 0.05);
    room.cuboid(dvec3(0.73, 1.955, 1.5), dvec3(1.57, 1.965, 2.2), mirror);
}

/// Towels, a stool, a bin, bottles.
fn details(room: &mut Builder) {
    let towel = room.diffuse("towel", [0.60, 0.22, 0.16]);
    let rail = room.metal("Cr", 0.4);
    room.cuboid(dvec3(0.15, 1.93, 1.6), dvec3(0.55, 1.95, 1.62), rail);
    room.cuboid(dvec3(0.2, 1.91, 1.0), dvec3(0.5, 1.96, 1.63), towel);
    let wood = room.diffuse("stool", [0.45, 0.30, 0.17]);
    let stool = [
        [0.16, 0.0],
        [0.1, 0.2],
        [0.19, 0.42],
        [0.19, 0.45],
        [0.001, 0.45],
    ];
    room.lathe(dvec3(-0.95, 0.45, 0.0), &stool, wood);
    let folded = room.diffuse("folded towel", [0.72, 0.70, 0.60]);
    room.cuboid(dvec3(-1.08, 0.32, 0.45), dvec3(-0.82, 0.58, 0.55), folded);
    let bin = room.metal("Fe", 0.7);
    let profile = [
        [0.13, 0.0],
        [0.15, 0.36],
        [0.15, 0.38],
        [0.1, 0.43],
        [0.001, 0.45],
    ];
    room.lathe(dvec3(0.35, 1.25, 0.0), &profile, bin);
    let bottle = [
        [0.035, 0.0],
        [0.035, 0.12],
        [0.012, 0.15],
        [0.012, 0.18],
        [0.001, 0.18],
    ];
    for (x, colour) in [(1.5, [0.2, 0.45, 0.3]), (1.6, [0.7, 0.5, 0.2])] {
        let soap = room.diffuse("bottle", colour);
        room.lathe(dvec3(x, 1.75, 0.83), &bottle, soap);
    }
    let mat = room.diffuse("mat", [0.30, 0.42, 0.50]);
    room.cuboid(dvec3(-0.7, 0.1, 0.0), dvec3(0.55, 0.95, 0.02), mat);
}
