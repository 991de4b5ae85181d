//! Rays through the lenses of a camera.
//!
//! Camera space: the film is at z = 0, the scene at z > 0. Interfaces are traced from the film outwards. The sphere of
//! curvature `k` (0: a plane) through the vertex at the origin is
//!
//! ```text
//! k |p|^2 - 2 z = 0,   inner normal n(p) = (-k x, -k y, 1 - k z),   |n| = 1
//! ```
//!
//! A ray `p + t d` with `|d| = 1` from the plane of the vertex, `p = (x, y, 0)`, meets it at
//!
//! ```text
//! t = k (x^2 + y^2) / (m + c),   m = d.z - k p.d,   c = sqrt(m^2 - k^2 (x^2 + y^2)) = n . d
//! ```
//!
//! without cancellation however flat it is, and the cosine for Snell's law is `c`.
//!
//! Source: Kolb, Mitchell and Hanrahan 1995; the pupils by radius are pbrt-v4's (Pharr, Jakob and Humphreys, fourth
//! edition, section B.2).

use rayon::prelude::*;
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene::{LensSystem, StopPicture};

use crate::convert::{floor, floor_i32, floor_index, narrow};

/// Parts of the film's half diagonal, each with a pupil of its own.
const RADII: usize = 64;
/// Rays per side of the squares that are searched for pupils.
const SEARCH: usize = 64;

/// Lenses, ready to be traced.
#[derive(Clone, Debug)]
pub(crate) struct Lenses {
    /// From the film to the scene.
    interfaces: Vec<Interface>,
    stop: Option<StopPicture>,
    /// z of the rear vertex.
    rear: f32,
    film_radius: f32,
    /// By radius on the film: what of the plane at the rear vertex is to be sampled; `None`: nothing gets through.
    pupils: Vec<Option<Pupil>>,
    /// At the ends of the parts, from the middle on.
    chief_rays: Vec<ChiefRay>,
}

#[derive(Clone, Copy, Debug)]
struct Interface {
    z: f32,
    curvature: f32,
    /// Index on the film's side over that on the scene's.
    eta: f32,
    aperture_radius: f32,
    is_stop: bool,
}

/// A rectangle of the plane at the rear vertex, for points of the film on the +x axis; it is symmetrical in y.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pupil {
    x: [f32; 2],
    y: f32,
}

/// The ray from a point of the film at a radius through the middle of the exit pupil.
#[derive(Clone, Copy, Debug, Default)]
struct ChiefRay {
    /// Outside of the lenses: away from the axis over along it.
    slope: f32,
    /// Root of the solid angle for each unit of the film's area.
    spread: f32,
}

/// A ray that has left the lenses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LensRay {
    pub(crate) origin: Vec3<f32>,
    pub(crate) direction: Vec3<f32>,
    /// Transmittance of the stop; in samples, times the area of the pupil's rectangle, `cos^4 / d^2`.
    pub(crate) weight: f32,
}

impl Lenses {
    pub(crate) fn new(system: &LensSystem) -> Self {
        let mut z = 0.0;
        let mut interfaces = Vec::with_capacity(system.interfaces.len());
        for (i, of_file) in system.interfaces.iter().enumerate().rev() {
            z += of_file.thickness;
            let is_stop = of_file.curvature_radius == 0.0;
            let before = i.checked_sub(1).map_or(1.0, |i| system.interfaces[i].eta);
            interfaces.push(Interface {
                z: narrow(z),
                curvature: narrow(if is_stop {
                    0.0
                } else {
                    -1.0 / of_file.curvature_radius
                }),
                eta: narrow(of_file.eta / before),
                aperture_radius: narrow(of_file.aperture_radius),
                is_stop,
            });
        }
        let mut lenses = Self {
            rear: interfaces.first().map_or(0.0, |i| i.z),
            interfaces,
            stop: system.stop.clone(),
            film_radius: narrow(0.5 * system.film_diagonal),
            pupils: Vec::new(),
            chief_rays: Vec::new(),
        };
        let at_radius = |i: usize| lenses.film_radius * (i as f32 / RADII as f32);
        let ends: Vec<Option<Pupil>> = (0..=RADII)
            .into_par_iter()
            .map(|i| lenses.search_pupil(at_radius(i)))
            .collect();
        let pupils = ends.windows(2).map(|ends| match (ends[0], ends[1]) {
            (Some(a), Some(b)) => Some(a.and(b)),
            (a, b) => a.or(b),
        });
        lenses.pupils = pupils.collect();
        lenses.chief_rays = lenses.chief_rays();
        lenses
    }

    /// A ray from a point of the film, if it gets through.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    pub(crate) fn sample(&self, film: [f32; 2], u: [f32; 2]) -> Option<LensRay> {
        let radius = film[0].hypot(film[1]);
        let part = floor_index(radius / self.film_radius * RADII as f32).min(RADII - 1);
        let pupil = self.pupils[part]?;
        let width = pupil.x[1] - pupil.x[0];
        let (x, y) = (pupil.x[0] + u[0] * width, pupil.y * (2.0 * u[1] - 1.0));
        let (cos, sin) = if radius > 0.0 {
            (film[0] / radius, film[1] / radius)
        } else {
            (1.0, 0.0)
        };
        let towards = vec3(
            cos * x - sin * y - film[0],
            sin * x + cos * y - film[1],
            self.rear,
        )
        .normalize();
        let ray = self.trace(film, towards)?;
        let cos2 = towards.z * towards.z;
        let area = width * 2.0 * pupil.y;
        Some(LensRay {
            weight: ray.weight * area * cos2 * cos2 / (self.rear * self.rear),
            ..ray
        })
    }

    /// A ray from a point of the film; `None`: something holds it up.
    ///
    /// * `direction`: unit, z above 0.
    fn trace(&self, film: [f32; 2], direction: Vec3<f32>) -> Option<LensRay> {
        self.refract(film, direction, true)
    }

    /// * `is_bounded`: whether apertures hold rays up.
    fn refract(&self, film: [f32; 2], direction: Vec3<f32>, is_bounded: bool) -> Option<LensRay> {
        let (mut point, mut d, mut weight) = (vec3(film[0], film[1], 0.0), direction, 1.0);
        for interface in &self.interfaces {
            let k = interface.curvature;
            let to_plane = (interface.z - point.z) / d.z;
            let vertex = vec3(0.0, 0.0, interface.z);
            let on_plane = point + d * to_plane - vertex;
            let (x, y) = (on_plane.x, on_plane.y);
            let m = d.z - k * (x * d.x + y * d.y);
            let discriminant = m * m - k * k * (x * x + y * y);
            let c = discriminant.max(0.0).sqrt();
            if discriminant < 0.0 || m + c <= 0.0 {
                return None;
            }
            let t = k * (x * x + y * y) / (m + c);
            if to_plane + t < 0.0 {
                return None;
            }
            let local = vec3(x + t * d.x, y + t * d.y, t * d.z);
            if is_bounded {
                weight *= interface.transmittance(self.stop.as_ref(), local);
                if weight <= 0.0 {
                    return None;
                }
            }
            if interface.eta != 1.0 && !interface.is_stop {
                let eta = interface.eta;
                let cos2 = 1.0 - eta * eta * (1.0 - c * c);
                if cos2 <= 0.0 {
                    return None;
                }
                let normal = vec3(-k * local.x, -k * local.y, 1.0 - k * local.z);
                d = (d * eta + normal * (cos2.sqrt() - eta * c)).normalize();
            }
            if d.z <= 0.0 {
                return None;
            }
            point = local + vertex;
        }
        Some(LensRay {
            origin: point,
            direction: d,
            weight,
        })
    }

    /// The rectangle that holds all of the pupil of a point of the film, by two rounds of rays on a grid.
    fn search_pupil(&self, film: f32) -> Option<Pupil> {
        let rear = self
            .interfaces
            .first()
            .map_or(0.0, |i| 1.5 * i.aperture_radius);
        let whole = Pupil {
            x: [-rear, rear],
            y: rear,
        };
        // A narrow stop is between the rays of a wide grid.
        let near = self.paraxial_pupil(film, 0.15 * rear);
        let first = self.pupil_within(film, whole);
        let second = near.and_then(|near| self.pupil_within(film, near));
        let coarse = match (first, second) {
            (Some(a), Some(b)) => a.and(b),
            (a, b) => a.or(b)?,
        };
        // The coarse grid's margins hold the pupil, and more.
        self.pupil_within(film, coarse).or(Some(coarse))
    }

    /// What of a rectangle is reached, and a cell around it.
    fn pupil_within(&self, film: f32, within: Pupil) -> Option<Pupil> {
        let cell = |width: f32| width / SEARCH as f32;
        let (dx, dy) = (cell(within.x[1] - within.x[0]), cell(within.y));
        let mut found: Option<Pupil> = None;
        for row in 0..SEARCH {
            let y = (row as f32 + 0.5) * dy;
            for column in 0..SEARCH {
                let x = within.x[0] + (column as f32 + 0.5) * dx;
                let is_known = found.is_some_and(|f| x >= f.x[0] && x <= f.x[1] && y <= f.y);
                let towards = vec3(x - film, y, self.rear).normalize();
                if !is_known && self.trace([film, 0.0], towards).is_some() {
                    let point = Pupil { x: [x; 2], y };
                    found = Some(found.map_or(point, |f| f.and(point)));
                }
            }
        }
        found.map(|f| Pupil {
            x: [f.x[0] - dx, f.x[1] + dx],
            y: f.y + dy,
        })
    }

    /// Where rays near the axis have the pupil, with room around it.
    ///
    /// * `least`: half a side at least.
    fn paraxial_pupil(&self, film: f32, least: f32) -> Option<Pupil> {
        let (z, radius) = self.exit_pupil();
        let on_plane = self.rear / z;
        let (x, half) = (
            film * (1.0 - on_plane),
            (2.0 * radius * on_plane).abs().max(least),
        );
        (x.is_finite() && half.is_finite()).then_some(Pupil {
            x: [x - half, x + half],
            y: half,
        })
    }

    /// z of the stop's image in the lenses behind it, and its radius; of lenses without a stop, of the rear one's edge.
    ///
    /// A ray near the axis from the stop arrives behind the lenses as `h = A h0 + B u0`, `u = C h0 + D u0`: the image
    /// is at `-B / D`, its size `A - C B / D`.
    fn exit_pupil(&self) -> (f32, f32) {
        let Some(stop) = self.interfaces.iter().position(|i| i.is_stop) else {
            let radius = self.interfaces.first().map_or(0.0, |i| i.aperture_radius);
            return (self.rear, radius);
        };
        let trace = |mut height: f32, mut slope: f32| {
            // Towards the film: slopes by -z.
            let mut z = self.interfaces[stop].z;
            for i in self.interfaces[..stop].iter().rev() {
                height += slope * (z - i.z);
                z = i.z;
                // n' u' = n u - h (n' - n) / R with R = -1 / k, and eta = n' / n.
                slope = (slope + height * (i.eta - 1.0) * i.curvature) / i.eta;
            }
            [height, slope]
        };
        let ([a, c], [b, d]) = (trace(1.0, 0.0), trace(0.0, 1.0));
        let behind = -b / d;
        let size = (a + c * behind).abs() * self.interfaces[stop].aperture_radius;
        (self.rear - behind, size)
    }

    /// With the slope `s(r)` outside, an element `r dr dphi` of the film has `s ds dphi cos^3` steradians.
    fn chief_rays(&self) -> Vec<ChiefRay> {
        let (pupil, _) = self.exit_pupil();
        let slope = |r: f32| {
            // From the film towards its middle, or, from a pupil beyond it, away from there.
            let tangent = if pupil.is_finite() { -r / pupil } else { 0.0 };
            let ray = self.refract([r, 0.0], vec3(tangent, 0.0, 1.0).normalize(), false)?;
            Some((ray.direction.x / ray.direction.z).abs())
        };
        let step = self.film_radius / RADII as f32;
        let mut rays: Vec<ChiefRay> = Vec::with_capacity(RADII + 1);
        for i in 0..=RADII {
            let r = step * i as f32;
            let [low, high] = [(r - 0.5 * step).max(0.0), r + 0.5 * step];
            let ray = (|| {
                let (middle, low_slope, high_slope) = (slope(r)?, slope(low)?, slope(high)?);
                let growth = (high_slope - low_slope) / (high - low);
                let ratio = if r > 0.0 { middle / r } else { growth };
                let cos2 = 1.0 / (1.0 + middle * middle);
                Some(ChiefRay {
                    slope: middle,
                    spread: (ratio * growth * cos2 * cos2.sqrt()).abs().sqrt(),
                })
            })();
            // Where nothing gets through, nothing is seen either.
            rays.push(ray.or(rays.last().copied()).unwrap_or_default());
        }
        rays
    }

    /// The direction, in camera space, of the ray through the middle of the pupil, and the root of the solid angle that
    /// a unit of the film's area sees there.
    pub(crate) fn chief(&self, film: [f32; 2]) -> (Vec3<f32>, f32) {
        let radius = film[0].hypot(film[1]);
        let at = (radius / self.film_radius * RADII as f32).min(RADII as f32);
        let i = floor_index(at).min(RADII - 1);
        let (a, b, t) = (self.chief_rays[i], self.chief_rays[i + 1], at - i as f32);
        let slope = a.slope + t * (b.slope - a.slope);
        let outwards = if radius > 0.0 { -slope / radius } else { 0.0 };
        let direction = vec3(outwards * film[0], outwards * film[1], 1.0).normalize();
        (direction, a.spread + t * (b.spread - a.spread))
    }
}

impl Pupil {
    /// A rectangle around two.
    fn and(self, other: Self) -> Self {
        Self {
            x: [self.x[0].min(other.x[0]), self.x[1].max(other.x[1])],
            y: self.y.max(other.y),
        }
    }
}

impl Interface {
    /// Share of the light that passes at a point.
    fn transmittance(&self, stop: Option<&StopPicture>, at: Vec3<f32>) -> f32 {
        match stop {
            Some(stop) if self.is_stop => {
                let unit = |x: f32| (x / self.aperture_radius + 1.0) * 0.5;
                transmittance(stop, [unit(at.x), unit(at.y)])
            }
            _ => {
                let is_within =
                    at.x * at.x + at.y * at.y <= self.aperture_radius * self.aperture_radius;
                f32::from(u8::from(is_within))
            }
        }
    }
}

/// Between the middles of pixels, 0 beyond them.
fn transmittance(stop: &StopPicture, [u, v]: [f32; 2]) -> f32 {
    let [x, y] = [u * stop.width as f32 - 0.5, v * stop.height as f32 - 0.5];
    let [left, low] = [floor(x), floor(y)];
    let value = |dx: i32, dy: i32| {
        let [x, y] = [floor_i32(left) + dx, floor_i32(low) + dy];
        let [x, y] = [u32::try_from(x), u32::try_from(y)];
        match (x, y) {
            (Ok(x), Ok(y)) if x < stop.width && y < stop.height => {
                stop.values[(y * stop.width + x) as usize]
            }
            _ => 0.0,
        }
    };
    let [tx, ty] = [x - left, y - low];
    let row = |dy: i32| value(0, dy) * (1.0 - tx) + value(1, dy) * tx;
    row(0) * (1.0 - ty) + row(1) * ty
}

#[cfg(test)]
mod tests;
