//! Measured materials: a lobe from tables that a gonioreflectometer filled.
//!
//! With `u_m` the normal's place on the unit square, `x = sqrt(2 theta_m / pi)` and
//! `y = (phi_m + pi) / (2 pi)`, and the warp `W` that takes uniform points `u` to densities of visible normals:
//!
//! ```text
//! f cos(theta_i) = rgb(W^-1(u_m)) D(u_m) / (4 sigma(wo))
//! p(wi) = p_luminance(W^-1(u_m)) p_vndf(u_m) / (|d wm / d u_m| 4 <wo, wm>)
//! |d wm / d u_m| = 2 pi^2 x sin(theta_m)
//! ```
//!
//! The last line follows from `theta_m = pi x^2 / 2`, `phi_m = 2 pi y - pi` and
//! `d wm = sin(theta_m) d theta_m d phi_m`. The papers' and files' i is our `wo`.
//!
//! Source: Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient Material Acquisition and
//! Rendering", sections 4 and 5. Departures: negative values are 0; the Jacobian is not bounded below by 1e-6 but
//! by 1e-9.

mod packed;
mod tables;
mod tabulate;
mod warp;

pub use tables::{MeasuredError, MeasuredGrid, MeasuredTables};
pub use tabulate::{Resolution, Symmetry, tabulate};

use alloc::vec::Vec;

use crate::bsdf::{Bsdf, BsdfSample, Event, Transport};
use crate::math::{Real, Rgb, Vec3, vec3};
use warp::{Colours, Grid, Slices, Warp};

/// A measured reflection.
///
/// It is black where `wo` or `wi` are below the horizon. It is reciprocal as far as the measurement and the
/// interpolation are.
#[derive(Clone, Debug)]
pub struct Measured<T> {
    theta_i: Vec<T>,
    phi_i: Vec<T>,
    turns: bool,
    /// How many times the azimuths cover a turn.
    symmetry: u32,
    ndf: Grid<T>,
    sigma: Grid<T>,
    vndf: Warp<T>,
    luminance: Warp<T>,
    rgb: Colours<T>,
    jacobian: bool,
    albedo: Rgb<T>,
}

/// A value of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredNode<T> {
    /// Towards the viewer.
    pub wo: Vec3<T>,
    /// Towards the light.
    pub wi: Vec3<T>,
    /// `f cos(theta_i)`, 1/sr.
    pub f_cos: Rgb<T>,
}

/// A view, mirrored to where the tables know it.
struct View<T> {
    wo: Vec3<T>,
    /// Signs that x and y were multiplied by.
    signs: [T; 2],
    phi: T,
    at: Slices<T>,
    /// `D / (4 sigma)` without D; 0 where nothing is seen.
    scale: T,
}

/// A normal, and where it lies.
struct Normal<T> {
    /// On the square of normals.
    u_m: [T; 2],
    /// Solid angle of reflections per area of that square.
    jacobian: T,
}

impl<T: Real> Measured<T> {
    /// # Errors
    ///
    /// Where sizes of the tables do not agree, angles do not ascend, or values are not finite.
    pub fn new(tables: &MeasuredTables) -> Result<Self, MeasuredError> {
        tables.check()?;
        let of = |all: &[f32]| all.iter().map(|&v| T::of(v.into())).collect();
        let turns = tables.is_isotropic();
        let grid = |g: &MeasuredGrid| Grid::new(g.size, &g.values);
        let warp = |g: &MeasuredGrid| Warp::new(g.size, &g.values);
        let mut measured = Self {
            theta_i: of(&tables.theta_i),
            phi_i: of(&tables.phi_i),
            turns,
            symmetry: if turns { 1 } else { tables.symmetry()? },
            ndf: grid(&tables.ndf),
            sigma: grid(&tables.sigma),
            vndf: warp(&tables.vndf),
            luminance: warp(&tables.luminance),
            rgb: Colours::new(tables.luminance.size, &tables.rgb),
            jacobian: tables.jacobian,
            albedo: Rgb::splat(T::ZERO),
        };
        measured.albedo = measured.representative();
        Ok(measured)
    }

    /// Whether the lobe turns with the view.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        self.turns
    }

    /// Bytes that its tables take.
    #[must_use]
    pub fn size_in_bytes(&self) -> u64 {
        let warps = [&self.vndf, &self.luminance].map(Warp::count);
        let tables = [self.ndf.count(), self.sigma.count(), self.rgb.count()];
        let views = self.theta_i.len() + self.phi_i.len();
        let all = warps.into_iter().chain(tables).sum::<usize>() + views;
        (all * size_of::<T>()) as u64
    }

    /// The values at the nodes of the colours, view by view: what was measured, without interpolation of
    /// views and colours.
    ///
    /// Pairs of directions of which one is not above the horizon are left out.
    pub fn nodes(&self) -> impl Iterator<Item = MeasuredNode<T>> + '_ {
        let [w, h] = self.rgb.size();
        let step = |i: usize, n: usize| warp::count::<T>(i) / warp::count(n - 1);
        let views = (self.phi_i.iter())
            .flat_map(|&phi| self.theta_i.iter().map(move |&theta| (theta, phi)));
        views.enumerate().flat_map(move |(slice, (theta, phi))| {
            let sin = theta.sin();
            let wo = vec3(sin * phi.cos(), sin * phi.sin(), theta.cos());
            let view = View {
                wo,
                signs: [T::ONE; 2],
                phi,
                at: Slices::only(slice),
                scale: self.scale(theta, phi),
            };
            (0..w * h).filter_map(move |i| {
                let u = [step(i % w, w), step(i / w, h)];
                let (u_m, _) = self.vndf.sample(&view.at, u);
                let (wi, _, cos) = self.reflection(&view, u_m);
                let node = MeasuredNode {
                    wo,
                    wi,
                    f_cos: self.value(&view, u, u_m),
                };
                (wo.z > T::ZERO && wi.z > T::ZERO && cos > T::ZERO).then_some(node)
            })
        })
    }

    /// Albedo at a cosine of 2/3, by 32 x 32 samples.
    fn representative(&self) -> Rgb<T> {
        const SIDE: u32 = 32;
        let step = T::ONE / T::of(SIDE.into());
        let middle = |i: u32| (T::of(i.into()) + T::HALF) * step;
        let cos = T::of(2.0 / 3.0);
        let wo = vec3((T::ONE - cos * cos).sqrt(), T::ZERO, cos);
        let mut sum = Rgb::splat(T::ZERO);
        for i in 0..SIDE * SIDE {
            let u = [T::HALF, middle(i % SIDE), middle(i / SIDE)];
            if let Some(sample) = self.sample(wo, u, Transport::Radiance) {
                sum += sample.weight * (step * step);
            }
        }
        sum.map(|v| v.within(T::ZERO, T::ONE))
    }

    /// `None` below the horizon.
    fn view(&self, wo: Vec3<T>) -> Option<View<T>> {
        if wo.z <= T::ZERO {
            return None;
        }
        // The tables of symmetric surfaces begin at -pi, where x and y are negative.
        let towards_minus = |v: T| T::select(v > T::ZERO, -T::ONE, T::ONE);
        let y = towards_minus(wo.y);
        let signs = match self.symmetry {
            4 => [towards_minus(wo.x), y],
            2 => [y, y],
            _ => [T::ONE; 2],
        };
        let wo = mirrored(wo, signs);
        let (theta, phi) = angles(wo);
        Some(View {
            wo,
            signs,
            phi,
            at: Slices::new(&self.phi_i, &self.theta_i, phi, theta),
            scale: self.scale(theta, phi),
        })
    }

    /// What colours of a view are multiplied by, without D.
    fn scale(&self, theta: T, phi: T) -> T {
        if !self.jacobian {
            return T::ONE;
        }
        let sigma = self.sigma.eval([polar(theta), azimuth(phi)]);
        T::select(sigma > T::ZERO, T::of(0.25) / sigma, T::ZERO)
    }

    /// The view's reflection at a normal, with the sine of the normal's polar angle and the cosine between
    /// the two.
    fn reflection(&self, view: &View<T>, u_m: [T; 2]) -> (Vec3<T>, T, T) {
        let theta = u_m[0] * u_m[0] * (T::PI * T::HALF);
        let turn = if self.turns { view.phi } else { T::ZERO };
        let phi = (T::TWO * u_m[1] - T::ONE) * T::PI + turn;
        let sin = theta.sin();
        let wm = vec3(sin * phi.cos(), sin * phi.sin(), theta.cos());
        let cos = view.wo.dot(wm);
        (wm * (T::TWO * cos) - view.wo, sin, cos)
    }

    /// Where the half vector of a view and `wi` lies.
    fn normal(&self, view: &View<T>, wi: Vec3<T>) -> Normal<T> {
        let wm = (view.wo + wi).normalize();
        let (theta, phi) = angles(wm);
        let y = azimuth(if self.turns { phi - view.phi } else { phi });
        let u_m = [polar(theta), y - y.floor()];
        Normal {
            u_m,
            jacobian: jacobian(u_m[0], theta.sin(), view.wo.dot(wm)),
        }
    }

    /// `f cos` where the warp of visible normals takes `u` to `u_m`.
    fn value(&self, view: &View<T>, u: [T; 2], u_m: [T; 2]) -> Rgb<T> {
        let [r, g, b] = self.rgb.eval(&view.at, u).map(|v| v.at_least(T::ZERO));
        let scale = if self.jacobian {
            self.ndf.eval(u_m).at_least(T::ZERO) * view.scale
        } else {
            T::ONE
        };
        Rgb { r, g, b } * scale
    }
}

impl<T: Real> Bsdf<T> for Measured<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _: Transport) -> (Rgb<T>, T) {
        let nothing = (Rgb::splat(T::ZERO), T::ZERO);
        let Some(view) = self.view(wo) else {
            return nothing;
        };
        if wi.z <= T::ZERO {
            return nothing;
        }
        let Normal { u_m, jacobian } = self.normal(&view, mirrored(wi, view.signs));
        let (u, visible) = self.vndf.invert(&view.at, u_m);
        let pdf = visible * self.luminance.pdf(&view.at, u) / jacobian;
        (self.value(&view, u, u_m), pdf)
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3], _: Transport) -> Option<BsdfSample<T>> {
        let view = self.view(wo)?;
        let (u, by_luminance) = self.luminance.sample(&view.at, [u[1], u[2]]);
        let (u_m, visible) = self.vndf.sample(&view.at, u);
        let (wi, sin, cos) = self.reflection(&view, u_m);
        let pdf = by_luminance * visible / jacobian(u_m[0], sin, cos);
        if !(wi.z > T::ZERO && cos > T::ZERO && pdf > T::ZERO && pdf.is_finite()) {
            return None;
        }
        Some(BsdfSample {
            wi: mirrored(wi, view.signs),
            weight: self.value(&view, u, u_m) / pdf,
            pdf,
            event: Event::Reflection,
            specular: false,
            eta: T::ONE,
        })
    }

    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}

/// `2 pi^2 x sin(theta_m) 4 <wo, wm>`.
fn jacobian<T: Real>(x: T, sin: T, cos: T) -> T {
    let normals = (T::TWO * T::PI * T::PI * x * sin).at_least(T::of(1e-9));
    normals * (T::of(4.0) * cos).at_least(T::TINY.sqrt())
}

fn mirrored<T: Real>(w: Vec3<T>, signs: [T; 2]) -> Vec3<T> {
    vec3(w.x * signs[0], w.y * signs[1], w.z)
}

/// Polar angle and azimuth in radians.
fn angles<T: Real>(w: Vec3<T>) -> (T, T) {
    let radius = (w.x * w.x + w.y * w.y).sqrt();
    (radius.atan2(w.z), w.y.atan2(w.x))
}

fn polar<T: Real>(theta: T) -> T {
    (theta * T::TWO * T::INV_PI).at_least(T::ZERO).sqrt()
}

fn azimuth<T: Real>(phi: T) -> T {
    (phi + T::PI) * T::INV_PI * T::HALF
}
