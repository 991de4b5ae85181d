//! A ball on a foot, of rough copper throughout, in parallel light, as in previews of materials.

use glam::dvec3;
use specula_scene::Scene;

use super::builder::Builder;
use super::lighting::Lighting;

/// The scene; only the light that metal reflects at once is meant to be seen.
pub(crate) fn testball(side: u32, alpha: f32) -> Scene {
    let target = dvec3(0.0, 0.0, 1.16);
    let mut build = Builder::new([side; 2], dvec3(2.2, -7.6, 3.6), target, 21.0);
    let floor = build.diffuse("floor", [0.18, 0.18, 0.2]);
    let copper = build.metal("Cu", alpha);
    build.quad(
        dvec3(-30.0, -30.0, 0.0),
        dvec3(60.0, 0.0, 0.0),
        dvec3(0.0, 60.0, 0.0),
        floor,
    );
    // Foot, ball with a band cut out around its equator, and the core that shows in the band.
    build.lathe(
        dvec3(0.0, 0.0, 0.0),
        &[
            [0.9, 0.0],
            [0.95, 0.08],
            [0.85, 0.16],
            [0.4, 0.22],
            [0.3, 0.4],
        ],
        copper,
    );
    let centre = dvec3(0.0, 0.0, 1.3);
    build.lathe(centre, &zone(-89.0, -16.0), copper);
    build.lathe(centre, &zone(16.0, 89.0), copper);
    build.sphere(centre, 0.82, copper);
    let mut scene = build.finish();
    Lighting::Parallel(dvec3(-0.55, -0.65, 0.7), 4.0).add_to(&mut scene);
    scene
}

/// The part of the unit sphere between two latitudes, closed towards the core.
fn zone(from_deg: f64, to_deg: f64) -> Vec<[f64; 2]> {
    const ROWS: u32 = 24;
    let at = |i: u32| {
        let latitude = from_deg + (to_deg - from_deg) * f64::from(i) / f64::from(ROWS);
        let (sin, cos) = latitude.to_radians().sin_cos();
        [cos, sin]
    };
    (0..=ROWS).map(at).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn it_is_valid() {
        super::testball(32, 1.0).validate().unwrap();
    }
}
