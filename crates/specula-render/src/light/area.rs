//! Shapes that emit light: triangles, spheres, disks and ellipsoids, sampled from a point.

use glam::{DMat3, DMat4};
use specula_bsdf::math::vec3;
use specula_bsdf::{Real, Vec3};

use super::cone::EmissionCone;
use super::parallelogram::Parallelogram;
use super::sphere::Sphere;
use super::triangle::{self, Triangle};
use crate::accel::{Bounds, QuadricShape};
use crate::codes;
use crate::convert::{Affine, abs, narrow, normal_matrix};
use crate::disk::concentric_disk;
use crate::geometry::unit_or;
use crate::offset::coupled;
use crate::words::Words;

/// A point on a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AreaSample {
    pub(crate) point: Vec3<f32>,
    pub(crate) error: Vec3<f32>,
    /// Towards the outside.
    pub(crate) normal: Vec3<f32>,
    /// From the reference point, unit.
    pub(crate) wi: Vec3<f32>,
    /// In 1/sr; 0 where the point is of no use.
    pub(crate) pdf: f32,
}

/// Shape of an area light, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Area {
    /// Sampled uniformly by area.
    Triangle(Triangle),
    /// Rectangles are sampled uniformly by solid angle.
    Parallelogram(Parallelogram),
    /// Sampled uniformly within the cone that it is seen in; by area from inside.
    Sphere(Sphere),
    /// Sampled uniformly by area.
    Disk {
        centre: Vec3<f32>,
        /// Images of the axes, times the radius.
        axes: [Vec3<f32>; 2],
        normal: Vec3<f32>,
        area: f32,
    },
    /// The image of a sphere, sampled as the sphere's area.
    Ellipsoid {
        /// The unit sphere's space to the world.
        forward: Affine,
        backward: Affine,
        /// Inverse transpose times the determinant: its length on a unit normal is the growth of
        /// area.
        cofactor: Affine,
        flipped: bool,
        area: f32,
    },
}

impl Area {
    /// A triangle by its corners, in winding order about the outside.
    pub(crate) fn triangle(corners: [Vec3<f32>; 3]) -> Self {
        Self::Triangle(Triangle::new(corners))
    }

    /// A parallelogram by a corner and its neighbours, in winding order about the outside.
    pub(crate) fn parallelogram(corners: [Vec3<f32>; 3]) -> Self {
        Self::Parallelogram(Parallelogram::new(corners))
    }

    /// A sphere or disk under a transform.
    pub(crate) fn quadric(shape: QuadricShape, to_world: &DMat4, flipped: bool) -> Self {
        let m = DMat3::from_mat4(*to_world);
        match shape {
            QuadricShape::Sphere { radius } => {
                let centre = Affine::new(to_world).translation;
                let scale = m.determinant().abs().cbrt();
                let gram = m.transpose() * m;
                let round =
                    gram.abs_diff_eq(DMat3::IDENTITY * (scale * scale), 1e-6 * scale * scale);
                if round {
                    return Self::Sphere(Sphere {
                        centre,
                        radius: narrow(radius * scale),
                        side: if flipped { -1.0 } else { 1.0 },
                    });
                }
                let forward = *to_world * DMat4::from_scale(glam::DVec3::splat(radius));
                let cofactor =
                    normal_matrix(&forward) * DMat3::from_mat4(forward).determinant().abs();
                Self::Ellipsoid {
                    forward: Affine::new(&forward),
                    backward: Affine::new(&forward.inverse()),
                    cofactor: Affine::linear(&cofactor),
                    flipped,
                    area: ellipsoid_area(&cofactor),
                }
            }
            QuadricShape::Disk { radius, height } => {
                let axes = [m.x_axis * radius, m.y_axis * radius];
                let cross = axes[0].cross(axes[1]);
                let normal = (normal_matrix(to_world) * glam::DVec3::Z).normalize_or_zero();
                let normal = if flipped { -normal } else { normal };
                let centre = to_world.transform_point3(glam::DVec3::new(0.0, 0.0, height));
                Self::Disk {
                    centre: crate::convert::narrow3(centre),
                    axes: axes.map(crate::convert::narrow3),
                    normal: crate::convert::narrow3(normal),
                    area: narrow(core::f64::consts::PI * cross.length()),
                }
            }
            QuadricShape::Part(_) => unreachable!("parts that emit are triangles"),
        }
    }

    /// Its kind, one of the codes.
    pub(super) fn kind(&self) -> u32 {
        match self {
            Self::Triangle(_) => codes::AREA_TRIANGLE,
            Self::Disk { .. } => codes::AREA_DISK,
            Self::Parallelogram(_) => codes::AREA_PARALLELOGRAM,
            Self::Sphere(_) => codes::AREA_SPHERE,
            Self::Ellipsoid { .. } => codes::AREA_ELLIPSOID,
        }
    }

    /// Kind and parameters, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        to.id(self.kind());
        let mut flat = |corner, edges: [Vec3<f32>; 2], normal, area| {
            to.vector(corner);
            for v in [edges[0], edges[1], normal] {
                to.vector(v);
            }
            to.number(area);
        };
        match *self {
            Self::Triangle(Triangle {
                corner,
                edges,
                normal,
                area,
            }) => flat(corner, edges, normal, area),
            Self::Disk {
                centre,
                axes,
                normal,
                area,
            } => flat(centre, axes, normal, area),
            Self::Parallelogram(light) => light.flatten(to),
            Self::Sphere(Sphere {
                centre,
                radius,
                side,
            }) => {
                to.vector(centre);
                to.number(radius);
                to.flag(side < 0.0);
            }
            Self::Ellipsoid {
                forward,
                backward,
                cofactor,
                flipped,
                area: _,
            } => {
                for map in [&forward, &backward, &cofactor] {
                    to.affine(map);
                }
                to.flag(flipped);
            }
        }
    }

    /// Surface area.
    pub(crate) fn area(&self) -> f32 {
        match *self {
            Self::Triangle(Triangle { area, .. })
            | Self::Parallelogram(Parallelogram { area, .. })
            | Self::Disk { area, .. }
            | Self::Ellipsoid { area, .. } => area,
            Self::Sphere(sphere) => sphere.area(),
        }
    }

    /// Area of the shadow along the normal; of a closed surface, the mean over directions.
    pub(crate) fn projected_area(&self) -> f32 {
        match self {
            Self::Triangle(_) | Self::Parallelogram(_) | Self::Disk { .. } => self.area(),
            // Cauchy's formula for convex bodies.
            Self::Sphere(_) | Self::Ellipsoid { .. } => 0.25 * self.area(),
        }
    }

    /// The least box around it, up to rounding.
    pub(super) fn bounds(&self) -> Bounds {
        let around = |corners: &[Vec3<f32>]| {
            let point = |p: &Vec3<f32>| Bounds {
                min: p.to_array(),
                max: p.to_array(),
            };
            let points = corners.iter();
            points.fold(Bounds::EMPTY, |b, p| b.union(&point(p)))
        };
        let (centre, reach) = match *self {
            Self::Triangle(Triangle { corner, edges, .. }) => {
                return around(&[corner, corner + edges[0], corner + edges[1]]);
            }
            Self::Parallelogram(Parallelogram { corner, edges, .. }) => {
                let [a, b] = edges;
                return around(&[corner, corner + a, corner + b, corner + a + b]);
            }
            Self::Sphere(Sphere { centre, radius, .. }) => (centre, Vec3::splat(radius)),
            Self::Disk { centre, axes, .. } => (centre, root_of_squares(&axes)),
            Self::Ellipsoid { forward, .. } => {
                (forward.translation, root_of_squares(&forward.columns))
            }
        };
        Bounds {
            min: (centre - reach).to_array(),
            max: (centre + reach).to_array(),
        }
    }

    /// Bound on the directions that it sends light to.
    pub(super) fn cone(&self, two_sided: bool) -> EmissionCone {
        match *self {
            Self::Triangle(Triangle { normal, .. })
            | Self::Parallelogram(Parallelogram { normal, .. })
            | Self::Disk { normal, .. } => EmissionCone::flat(normal, two_sided),
            Self::Sphere(_) | Self::Ellipsoid { .. } => EmissionCone::SPHERE,
        }
    }

    /// A point of the surface, uniform by area but on ellipsoids; the same as [`Area::sample`] samples,
    /// except on spheres and rectangles.
    pub(super) fn point(&self, u: [f32; 2]) -> Vec3<f32> {
        match *self {
            Self::Triangle(triangle) => triangle.point(u),
            Self::Parallelogram(Parallelogram { corner, edges, .. }) => {
                corner + edges[0] * u[0] + edges[1] * u[1]
            }
            Self::Sphere(Sphere { centre, radius, .. }) => {
                centre + specula_bsdf::math::warp::uniform_sphere(u) * radius
            }
            Self::Disk { centre, axes, .. } => {
                let d = concentric_disk(u);
                centre + axes[0] * d[0] + axes[1] * d[1]
            }
            Self::Ellipsoid { forward, .. } => {
                forward.point(specula_bsdf::math::warp::uniform_sphere(u))
            }
        }
    }

    /// Barycentric weights of the second and third corner of the point of a triangle that `u` leads
    /// to.
    pub(super) fn weights(u: [f32; 2]) -> [f32; 2] {
        triangle::weights(u)
    }

    /// The inverse of [`Area::weights`].
    pub(super) fn square_of([b, c]: [f32; 2]) -> [f32; 2] {
        if c > b {
            [2.0 * b, b + c]
        } else {
            [b + c, 2.0 * c]
        }
    }

    /// A point of the light as seen from `p`.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3<f32>, u: [f32; 2]) -> Option<AreaSample> {
        let sample = match *self {
            Self::Triangle(triangle) => triangle.sample(p, u),
            Self::Parallelogram(light) => light.area_sample(p, u),
            Self::Sphere(sphere) => sphere.sample(p, u),
            Self::Disk {
                centre,
                axes,
                normal,
                area,
            } => {
                let d = concentric_disk(u);
                let point = centre + axes[0] * d[0] + axes[1] * d[1];
                let reach = abs(centre) + abs(axes[0]) + abs(axes[1]);
                by_area(p, point, reach, normal, 1.0 / area)
            }
            Self::Ellipsoid {
                forward,
                cofactor,
                flipped,
                ..
            } => {
                let d = specula_bsdf::math::warp::uniform_sphere(u);
                let stretched = cofactor.vector(d);
                let normal = stretched.normalize();
                let per_area = 0.25 * f32::INV_PI / stretched.length();
                let normal = if flipped { -normal } else { normal };
                by_area(p, forward.point(d), forward.magnitude(d), normal, per_area)
            }
        };
        (sample.pdf > 0.0).then_some(sample)
    }

    /// Density in 1/sr with which [`Area::sample`] samples the direction from `p` to the point `q` of
    /// the light.
    ///
    /// * `normal`: of the light at `q`.
    #[inline]
    pub(crate) fn pdf(&self, p: Vec3<f32>, q: Vec3<f32>, normal: Vec3<f32>) -> f32 {
        let per_area = match *self {
            Self::Triangle(Triangle { area, .. }) | Self::Disk { area, .. } => 1.0 / area,
            Self::Parallelogram(light) => return finite_or_zero(light.pdf(p, q)),
            Self::Sphere(sphere) => match sphere.pdf(p) {
                Some(pdf) => return pdf,
                None => 1.0 / sphere.area(),
            },
            Self::Ellipsoid {
                backward, cofactor, ..
            } => {
                let d = unit_or(backward.point(q), Vec3::Z);
                0.25 * f32::INV_PI / cofactor.vector(d).length()
            }
        };
        let d = q - p;
        let distance_squared = d.length_squared();
        let cos = normal.dot(d).abs() / distance_squared.sqrt();
        finite_or_zero(per_area * distance_squared / cos)
    }
}

/// Half sides of the box around the image of the unit sphere, or disk, of these axes.
fn root_of_squares(axes: &[Vec3<f32>]) -> Vec3<f32> {
    let squares = axes.iter().fold(Vec3::ZERO, |sum, a| sum + a.hadamard(*a));
    vec3(squares.x.sqrt(), squares.y.sqrt(), squares.z.sqrt())
}

/// Surface area of the image of the unit sphere: the mean of `|cofactor n|` over directions.
fn ellipsoid_area(cofactor: &DMat3) -> f32 {
    let (n_z, n_phi) = (16, 32);
    let mut sum = 0.0;
    for i in 0..n_z * n_phi {
        let z = (f64::from(i / n_phi) + 0.5) / f64::from(n_z) * 2.0 - 1.0;
        let phi = (f64::from(i % n_phi) + 0.5) / f64::from(n_phi) * core::f64::consts::TAU;
        let r = (1.0 - z * z).sqrt();
        sum += (*cofactor * glam::DVec3::new(r * phi.cos(), r * phi.sin(), z)).length();
    }
    narrow(sum / f64::from(n_z * n_phi) * 4.0 * core::f64::consts::PI)
}

/// The sample of a point that was sampled by area, as seen from `p`.
///
/// * `per_area`: density over the area.
#[inline(always)]
pub(super) fn by_area(
    p: Vec3<f32>,
    point: Vec3<f32>,
    reach: Vec3<f32>,
    normal: Vec3<f32>,
    per_area: f32,
) -> AreaSample {
    let d = point - p;
    let distance_squared = d.length_squared();
    let wi = d * (1.0 / distance_squared.sqrt());
    let pdf = per_area * distance_squared / normal.dot(wi).abs();
    let usable = (pdf > 0.0) & (pdf < f32::INFINITY) & (wi.length_squared() > 0.5);
    AreaSample {
        point,
        error: coupled(reach),
        normal,
        wi,
        pdf: if usable { pdf } else { 0.0 },
    }
}

#[inline]
fn finite_or_zero(x: f32) -> f32 {
    if x.is_finite() { x } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The solid angle `int 1 = E[1 / pdf]` by samples against its closed form, and the pdf of every
    /// sample against the one of a hit at the same point.
    fn check(area: &Area, p: Vec3<f32>, solid_angle: f64, tolerance: f64) {
        let n = 256;
        let mut sum = 0.0;
        for i in 0..n * n {
            let u = [i / n, i % n].map(|k| (k as f32 + 0.5) / n as f32);
            let Some(s) = area.sample(p, u) else { continue };
            let hit = area.pdf(p, s.point, s.normal);
            assert!(
                (hit / s.pdf - 1.0).abs() < 5e-3,
                "{area:?}: {hit} {}",
                s.pdf
            );
            let towards = (s.point - p).normalize();
            assert!(
                (towards - s.wi).length() < 2e-3,
                "{area:?} {towards:?} {:?}",
                s.wi
            );
            // Both faces of a closed surface count: only the near one is wanted.
            let weight = match area {
                Area::Ellipsoid { .. } if s.normal.dot(s.wi) > 0.0 => 0.0,
                _ => 1.0,
            };
            sum += weight / f64::from(s.pdf);
        }
        let found = sum / f64::from(n * n);
        assert!(
            (found / solid_angle - 1.0).abs() < tolerance,
            "{area:?}: {found} instead of {solid_angle}"
        );
    }

    #[test]
    fn solid_angles_are_the_closed_forms() {
        use core::f64::consts::{PI, TAU};
        let p = vec3(0.0, 0.0, 2.0);
        // The octant seen from the origin.
        let octant = Area::triangle([Vec3::X, Vec3::Y, Vec3::Z]);
        check(&octant, Vec3::ZERO, PI / 2.0, 1e-3);
        let place = |m: DMat4, shape| Area::quadric(shape, &m, false);
        let disk = place(
            DMat4::IDENTITY,
            QuadricShape::Disk {
                radius: 1.0,
                height: 0.5,
            },
        );
        check(
            &disk,
            p,
            TAU * (1.0 - 1.5 / (1.5_f64.powi(2) + 1.0).sqrt()),
            1e-3,
        );
        let unit = QuadricShape::Sphere { radius: 1.0 };
        check(
            &place(DMat4::IDENTITY, unit),
            p,
            TAU * (1.0 - 0.75_f64.sqrt()),
            1e-4,
        );
        check(
            &place(DMat4::IDENTITY, unit),
            vec3(0.1, 0.2, 0.3),
            4.0 * PI,
            5e-3,
        );
        let far = place(DMat4::from_scale(glam::DVec3::splat(1e-3)), unit);
        check(&far, p * 500.0, PI * 1e-12, 1e-4);
        // An oblate spheroid along its axis: the tangent cone touches where z = c^2 / d.
        let oblate = place(DMat4::from_scale(glam::DVec3::new(1.0, 1.0, 0.5)), unit);
        let tan2 = 1.0 / (4.0 - 0.25);
        check(
            &oblate,
            p,
            TAU * (1.0 - 1.0 / (1.0_f64 + tan2).sqrt()),
            5e-3,
        );
    }

    #[test]
    fn an_ellipsoid_has_the_area_of_its_closed_form() {
        let m = DMat4::from_scale(glam::DVec3::new(2.0, 2.0, 1.0));
        let area = Area::quadric(QuadricShape::Sphere { radius: 1.0 }, &m, false).area();
        let e = 0.75_f64.sqrt();
        let exact = core::f64::consts::TAU * 4.0 * (1.0 + (1.0 - e * e) / e * e.atanh());
        assert!(
            (f64::from(area) / exact - 1.0).abs() < 1e-2,
            "{area} {exact}"
        );
    }
}
