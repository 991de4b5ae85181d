//! Gradient noise, and pbrt's textures made of it.
//!
//! The permutation is Perlin's published one, so that pictures show the same clouds as elsewhere.

use specula_bsdf::math::rgb;
use specula_bsdf::{Rgb, Vec3};

use crate::convert::{floor_i32, floor_index};
use crate::words::Words;

/// Frequency of an octave over that of the one before: not 2, so that the lattices do not coincide.
const LACUNARITY: f32 = 1.99;

/// Gradient noise, in about `[-1, 1]`; 0 at all points of the integer lattice.
///
/// Source: Perlin 2002, Improving Noise.
pub(super) fn noise(p: Vec3<f32>) -> f32 {
    let p = p.to_array();
    // Beyond 2^22 the fraction has no digits left; what is not finite is 0.
    if !p.iter().all(|x| x.abs() < 4_194_304.0) {
        return 0.0;
    }
    let cell = p.map(|x| floor_i32(x) & 255);
    let d = p.map(|x| x - x.floor());
    let w = d.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    let corner = |i: i32, j: i32, k: i32| {
        gradient(
            hash([cell[0] + i, cell[1] + j, cell[2] + k]),
            [d[0] - i as f32, d[1] - j as f32, d[2] - k as f32],
        )
    };
    let along_x = |j, k| lerp(w[0], corner(0, j, k), corner(1, j, k));
    let along_y = |k| lerp(w[1], along_x(0, k), along_x(1, k));
    lerp(w[2], along_y(0), along_y(1))
}

fn hash(cell: [i32; 3]) -> u8 {
    let step = |run: u8, x: i32| PERMUTATION[((i32::from(run) + x) & 255).unsigned_abs() as usize];
    step(step(step(0, cell[0]), cell[1]), cell[2])
}

/// The dot product with one of the 12 edges of the cube (four of them twice).
fn gradient(hash: u8, [x, y, z]: [f32; 3]) -> f32 {
    let h = hash & 15;
    let u = if h < 8 || h == 12 || h == 13 { x } else { y };
    let v = if h < 4 || h == 12 || h == 13 { y } else { z };
    let signed = |value: f32, bit: u8| if h & bit == 0 { value } else { -value };
    signed(u, 1) + signed(v, 2)
}

fn lerp(t: f32, a: f32, b: f32) -> f32 {
    (1.0 - t) * a + t * b
}

/// Fractional Brownian motion: `sum_i roughness^i noise(1.99^i p)`.
pub(super) fn fbm(p: Vec3<f32>, roughness: f32, octaves: u32) -> f32 {
    sum(p, roughness, octaves, |n| n).0
}

/// The same of absolute values; octaves that are left out are replaced by their mean, as in pbrt.
pub(super) fn turbulence(p: Vec3<f32>, roughness: f32, octaves: u32) -> f32 {
    let (sum, amplitude) = sum(p, roughness, octaves, f32::abs);
    sum + 0.2 * amplitude
}

/// The sum of octaves, and the amplitude of the next.
fn sum(p: Vec3<f32>, roughness: f32, octaves: u32, of: impl Fn(f32) -> f32) -> (f32, f32) {
    let (mut sum, mut amplitude, mut frequency) = (0.0, 1.0, 1.0);
    for _ in 0..octaves {
        sum += amplitude * of(noise(p * frequency));
        frequency *= LACUNARITY;
        amplitude *= roughness;
    }
    (sum, amplitude)
}

/// Waves whose strength is another noise: pbrt's `windy`.
pub(super) fn windy(p: Vec3<f32>) -> f32 {
    fbm(p * 0.1, 0.5, 3).abs() * fbm(p, 0.5, 6)
}

/// A ramp of greys along y, bent by fractional Brownian motion: pbrt's `marble`.
pub(super) fn marble(p: Vec3<f32>, variation: f32, roughness: f32, octaves: u32) -> Rgb<f32> {
    let bent = p.y + variation * fbm(p, roughness, octaves);
    let t = 0.5 + 0.5 * bent.sin();
    // A Bezier segment over each four neighbours in a row.
    let segments = MARBLE.len() - 3;
    let along = t * segments as f32;
    let first = floor_index(along).min(segments - 1);
    let t = along - first as f32;
    let points: [[f32; 3]; 4] = std::array::from_fn(|i| MARBLE[first + i]);
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    let mut colour = Rgb::BLACK;
    for ([r, g, b], w) in points.into_iter().zip(weights) {
        colour += rgb(r, g, b) * w;
    }
    colour * 1.5
}

/// Whether a point lies in one of pbrt's `dots`: at most one per cell of unit size, somewhere in it.
pub(super) fn in_dot([s, t]: [f32; 2]) -> bool {
    const RADIUS: f32 = 0.35;
    let cell = [s, t].map(|x| (x + 0.5).floor());
    let noise = |dx: f32, dy: f32| noise(Vec3::from([cell[0] + dx, cell[1] + dy, 0.5]));
    if noise(0.5, 0.5) <= 0.0 {
        return false;
    }
    let shift = 0.5 - RADIUS;
    let x = s - (cell[0] + shift * noise(1.5, 2.8));
    let y = t - (cell[1] + shift * noise(4.5, 9.8));
    x * x + y * y < RADIUS * RADIUS
}

/// The tables for shaders: the permutation, the colours of marble.
pub(super) fn flatten(to: &mut Words) {
    to.float_constant("TEXTURE_NOISE_LACUNARITY", LACUNARITY);
    to.begin("NOISE_PERMUTATION");
    to.ids(PERMUTATION.map(u32::from));
    to.begin("NOISE_MARBLE");
    to.floats(MARBLE.into_iter().flatten());
}

/// Constants for the tables where no texture reads them.
pub(super) fn leave_out(to: &mut Words) {
    to.float_constant("TEXTURE_NOISE_LACUNARITY", LACUNARITY);
    to.constant("NOISE_PERMUTATION", 0);
    to.constant("NOISE_MARBLE", 0);
}

/// pbrt's colours of marble.
const MARBLE: [[f32; 3]; 9] = [
    [0.58, 0.58, 0.6],
    [0.58, 0.58, 0.6],
    [0.58, 0.58, 0.6],
    [0.5, 0.5, 0.5],
    [0.6, 0.59, 0.58],
    [0.58, 0.58, 0.6],
    [0.58, 0.58, 0.6],
    [0.2, 0.2, 0.33],
    [0.58, 0.58, 0.6],
];

/// Source: Perlin 2002, Improving Noise.
#[rustfmt::skip]
const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69,
    142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219,
    203, 117, 35, 11, 32, 57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175,
    74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230,
    220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76,
    132, 187, 208, 89, 18, 169, 200, 196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173,
    186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212, 207, 206,
    59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248, 152, 2, 44, 154, 163,
    70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232,
    178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162,
    241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204,
    176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141,
    128, 195, 78, 66, 215, 61, 156, 180,
];

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::vec3;

    #[test]
    fn the_permutation_is_one() {
        let mut seen = [false; 256];
        for p in PERMUTATION {
            seen[usize::from(p)] = true;
        }
        assert!(seen.iter().all(|&s| s));
    }

    /// Next to a lattice point the noise is its gradient's plane: an edge of the cube, of length
    /// sqrt(2); and 0 at the point itself, on both sides of the origin.
    #[test]
    fn lattice_points_are_zeros_with_gradients_along_the_edges_of_the_cube() {
        let mut seen = std::collections::BTreeSet::new();
        for i in -6..6_i16 {
            for j in -6..6_i16 {
                let p = vec3(f32::from(i), f32::from(j), 3.0);
                assert_eq!(noise(p), 0.0);
                let h = 1.0 / 256.0;
                let slope = |d: Vec3<f32>| (noise(p + d * h) - noise(p - d * h)) / (2.0 * h);
                // Plus 0: there is no -0.
                let g = [Vec3::X, Vec3::Y, Vec3::Z].map(|d| slope(d).round() + 0.0);
                let squared: f32 = g.iter().map(|x| x * x).sum();
                assert_eq!(squared, 2.0, "{p:?}: {g:?}");
                seen.insert(g.map(|x| x.to_bits()));
            }
        }
        assert_eq!(seen.len(), 12);
    }

    /// Perlin's reference implementation prints this for his example.
    #[test]
    fn a_value_is_perlins() {
        let found = noise(vec3(157.0 / 50.0, 42.0, 7.0));
        assert!((found - 0.136_919_95).abs() < 1e-5, "{found}");
    }

    #[test]
    fn octaves_add_up_and_turbulence_is_positive() {
        let p = vec3(0.3, 1.7, -2.2);
        let two = noise(p) + 0.5 * noise(p * LACUNARITY);
        assert!((fbm(p, 0.5, 2) - two).abs() < 1e-6);
        let absolute = noise(p).abs() + 0.5 * noise(p * LACUNARITY).abs() + 0.2 * 0.25;
        assert!((turbulence(p, 0.5, 2) - absolute).abs() < 1e-6);
        assert_eq!(fbm(p, 0.5, 0), 0.0);
        assert_eq!(noise(vec3(f32::NAN, 0.5, 0.5)), 0.0);
    }

    #[test]
    fn marble_without_variation_runs_through_its_ramp() {
        use core::f32::consts::FRAC_PI_2;
        let at = |y| marble(vec3(5.3, y, 0.4), 0.0, 0.5, 8);
        // sin = -1, 0, 1: the first point, the start of the fourth segment, the last point.
        let expect = |found: Rgb<f32>, [r, g, b]: [f32; 3]| {
            assert!((found - rgb(r, g, b) * 1.5).max_channel().abs() < 1e-5);
        };
        expect(at(-FRAC_PI_2), MARBLE[0]);
        expect(at(0.0), MARBLE[3]);
        expect(at(FRAC_PI_2), MARBLE[8]);
    }

    /// About half of the cells have a dot, of area `pi 0.35^2` each.
    #[test]
    fn dots_cover_the_share_that_their_cells_give_them() {
        let (cells, fine) = (40, 16);
        let (mut inside, mut occupied) = (0, 0);
        for i in 0..cells {
            for j in 0..cells {
                let before = inside;
                for k in 0..fine * fine {
                    let at =
                        |cell: i32, sub: i32| cell as f32 + (sub as f32 + 0.5) / fine as f32 - 0.5;
                    inside += i32::from(in_dot([at(i, k / fine), at(j, k % fine)]));
                }
                occupied += i32::from(inside > before);
            }
        }
        let expected = f64::from(occupied) * core::f64::consts::PI * 0.35 * 0.35;
        let found = f64::from(inside) / f64::from(fine * fine);
        assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
        let share = f64::from(occupied) / f64::from(cells * cells);
        assert!((0.35..0.6).contains(&share), "{share}");
    }
}
