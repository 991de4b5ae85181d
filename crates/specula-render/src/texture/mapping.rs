//! Texture mappings: from a point of a surface to texture coordinates.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene::{TextureMapping, UvMapping};

use super::{Footprint, TextureCoordinates};
use crate::codes;
use crate::convert::Affine;
use crate::words::Words;

/// [`TextureMapping`] in single precision.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mapping {
    Uv([[f32; 3]; 2]),
    SecondUv([[f32; 3]; 2]),
    /// `s` and `t` are linear in the world's position: a vector and an offset each.
    Planar([(Vec3<f32>, f32); 2]),
    Spherical(Affine),
    Cylindrical(Affine),
}

impl Mapping {
    pub(super) fn new(mapping: &TextureMapping) -> Self {
        match mapping {
            TextureMapping::Uv(UvMapping(m)) => Self::Uv(*m),
            TextureMapping::SecondUv(UvMapping(m)) => Self::SecondUv(*m),
            TextureMapping::Planar { to_texture, s, t } => {
                let m = Affine::new(to_texture);
                Self::Planar([s, t].map(|axis| {
                    let along = vec3(axis[0], axis[1], axis[2]);
                    (
                        Vec3::from(m.columns.map(|c| c.dot(along))),
                        along.dot(m.translation) + axis[3],
                    )
                }))
            }
            TextureMapping::Spherical { to_texture } => Self::Spherical(Affine::new(to_texture)),
            TextureMapping::Cylindrical { to_texture } => {
                Self::Cylindrical(Affine::new(to_texture))
            }
        }
    }

    /// `(s, t)`, with its origin at the lower left of pictures.
    #[inline]
    pub(super) fn at(&self, place: &TextureCoordinates) -> [f32; 2] {
        use core::f32::consts::{PI, TAU};
        match self {
            Self::Uv(m) => affine(m, place.uv),
            Self::SecondUv(m) => affine(m, place.second_uv),
            Self::Planar(axes) => axes.map(|(along, offset)| along.dot(place.position) + offset),
            Self::Spherical(to_texture) => {
                let p = to_texture.point(place.position);
                // The polar angle by atan2: acos loses half the digits at the poles.
                let theta = (p.x * p.x + p.y * p.y).sqrt().atan2(p.z);
                let phi = p.y.atan2(p.x);
                let turn = if phi < 0.0 { phi + TAU } else { phi };
                [theta / PI, turn / TAU]
            }
            Self::Cylindrical(to_texture) => {
                let p = to_texture.point(place.position);
                [(PI + p.y.atan2(p.x)) / TAU, p.z]
            }
        }
    }
}

impl Mapping {
    /// How much `(s, t)` change along the half axes of a footprint, to first order.
    ///
    /// At the poles of spheres and along the axis of cylinders the azimuth changes by up to a radian, not infinitely.
    pub(super) fn axes(&self, place: &TextureCoordinates, footprint: &Footprint) -> [[f32; 2]; 2] {
        use core::f32::consts::{PI, TAU};
        let linear = |m: &[[f32; 3]; 2], axes: [[f32; 2]; 2]| {
            axes.map(|[u, v]| m.map(|row| row[0] * u + row[1] * v))
        };
        // Of the azimuth, with the distance from the axis.
        let turned = |p: Vec3<f32>, d: Vec3<f32>| {
            let radius = (p.x * p.x + p.y * p.y).max(d.x * d.x + d.y * d.y);
            let turn = if radius > 0.0 {
                (p.x * d.y - p.y * d.x) / radius
            } else {
                0.0
            };
            (turn, radius.sqrt())
        };
        match self {
            Self::Uv(m) => linear(m, footprint.uv),
            Self::SecondUv(m) => linear(m, footprint.second_uv),
            Self::Planar(axes) => {
                let along = |d: Vec3<f32>| axes.map(|(axis, _)| axis.dot(d));
                footprint.position.map(along)
            }
            Self::Spherical(to_texture) => {
                let p = to_texture.point(place.position);
                footprint.position.map(|d| {
                    let d = to_texture.vector(d);
                    let (turn, radius) = turned(p, d);
                    let outwards = (p.x * d.x + p.y * d.y) / radius.max(f32::MIN_POSITIVE);
                    let squared = (radius * radius + p.z * p.z).max(f32::MIN_POSITIVE);
                    [(p.z * outwards - radius * d.z) / squared / PI, turn / TAU]
                })
            }
            Self::Cylindrical(to_texture) => {
                let p = to_texture.point(place.position);
                footprint.position.map(|d| {
                    let d = to_texture.vector(d);
                    [turned(p, d).0 / TAU, d.z]
                })
            }
        }
    }

    /// Its kind, then its parameters.
    pub(super) fn flatten(&self, to: &mut Words) {
        match self {
            Self::Uv(m) => {
                to.id(codes::TEXTURE_MAPPING_UV);
                to.floats(m.iter().flatten().copied());
            }
            Self::SecondUv(m) => {
                to.id(codes::TEXTURE_MAPPING_SECOND_UV);
                to.floats(m.iter().flatten().copied());
            }
            Self::Planar(axes) => {
                to.id(codes::TEXTURE_MAPPING_PLANAR);
                for (along, offset) in axes {
                    to.vector(*along);
                    to.number(*offset);
                }
            }
            Self::Spherical(to_texture) => {
                to.id(codes::TEXTURE_MAPPING_SPHERICAL);
                to.affine(to_texture);
            }
            Self::Cylindrical(to_texture) => {
                to.id(codes::TEXTURE_MAPPING_CYLINDRICAL);
                to.affine(to_texture);
            }
        }
    }
}

#[inline(always)]
fn affine(m: &[[f32; 3]; 2], [u, v]: [f32; 2]) -> [f32; 2] {
    m.map(|row| row[0] * u + row[1] * v + row[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DVec3};

    fn at(mapping: &TextureMapping, p: [f32; 3]) -> [f32; 2] {
        let place = TextureCoordinates {
            position: Vec3::from(p),
            uv: [0.25, 0.5],
            second_uv: [4.0, 1.0],
            ..TextureCoordinates::default()
        };
        Mapping::new(mapping).at(&place)
    }

    fn assert_near(found: [f32; 2], expected: [f32; 2]) {
        for (f, e) in found.into_iter().zip(expected) {
            assert!((f - e).abs() < 1e-5, "{found:?} instead of {expected:?}");
        }
    }

    #[test]
    fn surface_coordinates_go_through_an_affine_map() {
        let turned = UvMapping([[0.0, -1.0, 1.0], [2.0, 0.0, 0.5]]);
        assert_near(at(&TextureMapping::Uv(turned), [9.0; 3]), [0.5, 1.0]);
        assert_near(at(&TextureMapping::SecondUv(turned), [9.0; 3]), [0.0, 8.5]);
    }

    #[test]
    fn planes_spheres_and_cylinders_follow_their_definitions() {
        let to_texture = DMat4::from_translation(DVec3::new(-1.0, 0.0, 0.0));
        let planar = TextureMapping::Planar {
            to_texture: to_texture * DMat4::from_scale(DVec3::splat(2.0)),
            s: [1.0, 0.0, 1.0, 0.25],
            t: [0.0, 3.0, 0.0, -1.0],
        };
        // In texture space (1, 4, 6).
        assert_near(at(&planar, [1.0, 2.0, 3.0]), [7.25, 11.0]);
        let spherical = TextureMapping::Spherical { to_texture };
        assert_near(at(&spherical, [1.0, 0.0, 5.0]), [0.0, 0.0]);
        assert_near(at(&spherical, [1.0, 2.0, 0.0]), [0.5, 0.25]);
        assert_near(at(&spherical, [1.0, -2.0, 0.0]), [0.5, 0.75]);
        assert_near(at(&spherical, [4.0, 0.0, -3.0]), [0.75, 0.0]);
        let cylindrical = TextureMapping::Cylindrical { to_texture };
        assert_near(at(&cylindrical, [3.0, 0.0, 0.7]), [0.5, 0.7]);
        assert_near(at(&cylindrical, [1.0, 1.0, -2.0]), [0.75, -2.0]);
        assert_near(at(&cylindrical, [1.0, -1.0, 0.0]), [0.25, 0.0]);
    }

    /// Changes along two vectors against differences of nearby points.
    #[test]
    fn changes_are_those_of_nearby_points() {
        let to_texture = DMat4::from_rotation_x(0.3) * DMat4::from_scale(DVec3::new(1.0, 2.0, 0.7));
        let sheared = UvMapping([[0.4, -1.0, 1.0], [2.0, 0.1, 0.5]]);
        for mapping in [
            TextureMapping::Uv(sheared),
            TextureMapping::SecondUv(sheared),
            TextureMapping::Planar {
                to_texture,
                s: [1.0, 0.4, 1.0, 0.25],
                t: [0.0, 3.0, 0.2, -1.0],
            },
            TextureMapping::Spherical { to_texture },
            TextureMapping::Cylindrical { to_texture },
        ] {
            let mapping = Mapping::new(&mapping);
            for p in [[1.0, 0.5, 0.3], [-0.4, -0.8, 2.0], [0.2, 0.9, -1.1]] {
                let footprint = Footprint {
                    position: [vec3(0.3, -0.2, 0.1), vec3(0.0, 0.1, 0.25)],
                    uv: [[0.1, 0.2], [-0.3, 0.05]],
                    second_uv: [[0.4, 0.0], [0.1, -0.2]],
                };
                let place = |axis: usize, step: f32| TextureCoordinates {
                    position: Vec3::from(p) + footprint.position[axis] * step,
                    uv: footprint.uv[axis].map(|d| d * step),
                    second_uv: footprint.second_uv[axis].map(|d| d * step),
                    ..TextureCoordinates::default()
                };
                let axes = mapping.axes(&place(0, 0.0), &footprint);
                for (axis, found) in axes.into_iter().enumerate() {
                    const STEP: f32 = 0.02;
                    let [a, b] = [-STEP, STEP].map(|step| mapping.at(&place(axis, step)));
                    for i in 0..2 {
                        let expected = (b[i] - a[i]) / (2.0 * STEP);
                        let error = (found[i] - expected).abs();
                        assert!(error < 1e-3, "{mapping:?} {p:?}: {found:?}, {expected}");
                    }
                }
            }
        }
    }

    #[test]
    fn poles_have_finite_footprints() {
        let mapping = Mapping::new(&TextureMapping::Spherical {
            to_texture: DMat4::IDENTITY,
        });
        let place = TextureCoordinates {
            position: vec3(0.0, 0.0, 2.0),
            ..TextureCoordinates::default()
        };
        let footprint = Footprint {
            position: [vec3(0.1, 0.0, 0.0), Vec3::ZERO],
            ..Footprint::default()
        };
        let axes = mapping.axes(&place, &footprint);
        assert!(
            axes.iter()
                .flatten()
                .all(|x| x.is_finite() && x.abs() < 0.5),
            "{axes:?}"
        );
    }
}
