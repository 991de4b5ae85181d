//! The equal-area map between the square and the sphere.
//!
//! Source: Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD; orientation as in
//! pbrt-v4: the centre of the square is +z, its corners are -z, u runs with x and v with y.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

use super::angles::{sin_cos_half_turns, turns};

/// The direction of a point of `[0, 1]^2`.
#[inline(always)]
pub(crate) fn direction_of([s, t]: [f32; 2]) -> Vec3<f32> {
    let (u, v) = (2.0 * s - 1.0, 2.0 * t - 1.0);
    let (au, av) = (u.abs(), v.abs());
    let signed_distance = 1.0 - (au + av);
    let r = 1.0 - signed_distance.abs();
    let quarter = if r == 0.0 { 1.0 } else { (av - au) / r + 1.0 };
    let (sin, cos) = sin_cos_half_turns(0.25 * quarter);
    let planar = r * (2.0 - r * r).sqrt();
    vec3(
        (planar * cos).copysign(u),
        (planar * sin).copysign(v),
        (1.0 - r * r).copysign(signed_distance),
    )
}

/// The point of `[0, 1]^2` of a unit direction.
#[inline(always)]
pub(crate) fn square_of(w: Vec3<f32>) -> [f32; 2] {
    let (x, y, z) = (w.x.abs(), w.y.abs(), w.z.abs());
    // sqrt(1 - z) without cancellation.
    let r = ((x * x + y * y) / (1.0 + z)).sqrt();
    let r = if r < 1.0 { r } else { 1.0 };
    let v = 4.0 * turns(y, x) * r;
    let u = r - v;
    let below = w.z < 0.0;
    let (u, v) = (
        if below { 1.0 - v } else { u },
        if below { 1.0 - u } else { v },
    );
    [0.5 * (u.copysign(w.x) + 1.0), 0.5 * (v.copysign(w.y) + 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_maps_are_inverse_and_unit() {
        for i in 0..100 {
            for j in 0..100 {
                let p = [i, j].map(|k| (k as f32 + 0.5) / 100.0);
                let w = direction_of(p);
                assert!((w.length() - 1.0).abs() < 1e-6);
                let q = square_of(w);
                assert!(
                    (p[0] - q[0]).abs() < 1e-5 && (p[1] - q[1]).abs() < 1e-5,
                    "{p:?} {q:?}"
                );
            }
        }
    }

    #[test]
    fn areas_are_equal_and_the_centre_is_up() {
        assert!((direction_of([0.5, 0.5]) - Vec3::Z).length() < 1e-6);
        assert!((direction_of([0.0, 0.0]) + Vec3::Z).length() < 1e-6);
        // r = 1/2: z = 3/4 and sqrt(7)/4 along the axis.
        let quarter = 7.0_f32.sqrt() / 4.0;
        assert!((direction_of([0.75, 0.5]) - vec3(quarter, 0.0, 0.75)).length() < 1e-6);
        assert!((direction_of([0.5, 0.75]) - vec3(0.0, quarter, 0.75)).length() < 1e-6);
        // Means of z, z^2 and x^2 over equal areas are those of the sphere.
        let n = 400;
        let (mut z, mut z2, mut x2) = (0.0, 0.0, 0.0);
        for k in 0..n * n {
            let w = direction_of([k / n, k % n].map(|i| (i as f32 + 0.5) / n as f32)).cast::<f64>();
            z += w.z;
            z2 += w.z * w.z;
            x2 += w.x * w.x;
        }
        let count = f64::from(n * n);
        assert!((z / count).abs() < 1e-5);
        assert!((z2 / count - 1.0 / 3.0).abs() < 1e-4 && (x2 / count - 1.0 / 3.0).abs() < 1e-4);
    }
}
