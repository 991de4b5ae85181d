//! Hair and fur: scattering by a dielectric cylinder with rough, tilted scales that absorbs inside.
//!
//! The fibre runs along the local x. A direction has an inclination `theta` to the plane across the fibre, with
//! `sin(theta) = x`, and an azimuth `phi` in it. Light leaves in three lobes, reflected (R), through the fibre (TT),
//! and reflected once within (TRT), and in a fourth that stands for all that is left:
//!
//! ```text
//! S(wo, wi) = sum over p of A_p(theta_o, h) M_p(theta_o, theta_i) N_p(phi_i - phi_o, h)
//! pdf(wi) = sum over p of q_p M_p N_p,   q_p = mean(A_p) / (sum over p of mean(A_p))
//! ```
//!
//! S is what [`Bsdf::eval`] returns: a fibre has no cosine of its own, and scatters to the whole sphere. M and N are
//! densities, `A_0 + A_1 + A_2 + A_3 <= 1`, so that the albedo is their sum, and weights of samples are at most 3.
//!
//! S is not reciprocal: it has the attenuations of wo, and scales tilt. Without a tilt it is between directions of
//! the same inclination, averaged over h. It does not change when wo, wi and h are mirrored across the plane of x
//! and z.
//!
//! Source: Chiang, Bitterli, Tappan and Burley 2016, "A Practical and Controllable Hair and Fur Model for Production
//! Path Tracing", in the form of pbrt-v4 (Pharr, Jakob and Humphreys 2023, section 9.9). Departures: lobes are sampled
//! by the mean of their channels, as in pbrt-v4, where the paper has the luminance; M has one form for every variance
//! (`longitudinal`), and its samples are not cut off at a probability of 1e-5.

mod attenuation;
mod azimuthal;
mod longitudinal;
mod parameters;

pub use parameters::{
    HairParameters, absorption_of_colour, absorption_of_melanin, colour_of_absorption,
};

use attenuation::Section;
use longitudinal::Inclination;

use crate::bsdf::{Bsdf, BsdfSample, Event, Transport};
use crate::math::{Real, Rgb, Vec3, vec3};

/// How many lobes there are.
const LOBES: usize = 4;
/// The lobe of all that is left.
const RESIDUE: usize = 3;
/// The least roughness, as pbrt-v4's.
const LEAST_ROUGHNESS: f64 = 0.01;

/// A fibre of hair, where a ray hits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hair<T> {
    /// Offset of the view across the fibre; `None`: it follows from the normal.
    h: Option<T>,
    eta: T,
    sigma_a: Rgb<T>,
    /// Longitudinal variance of each lobe.
    variance: [T; LOBES],
    /// Scale of azimuthal distributions.
    scale: T,
    /// By how much the inclination of the view is turned, for each lobe.
    tilt: [Inclination<T>; LOBES],
    albedo: Rgb<T>,
}

/// A view of the fibre.
struct View<T> {
    inclination: Inclination<T>,
    /// Cosine and sine of the azimuth.
    azimuth: [T; 2],
    section: Section<T>,
}

impl<T: Real> Hair<T> {
    /// A fibre where its cylinder's normal is the local z: the offset of the view follows from the view.
    ///
    /// Within the cross section the angle `gamma_o` leads from the normal to the view, about x, and `h = sin(gamma_o)`:
    ///
    /// ```text
    /// h = -y / sqrt(y^2 + z^2),   wo = (x, y, z)
    /// ```
    ///
    /// That is the offset of a point in the normal's direction over its distance from the axis, also of a view from
    /// behind the normal, as interpolated normals have it near outlines.
    pub fn new(parameters: &HairParameters<T>) -> Self {
        let least = T::of(LEAST_ROUGHNESS);
        let beta_m = parameters.beta_m.within(least, T::ONE);
        let beta_n = parameters.beta_n.within(least, T::ONE);
        let v = longitudinal::variance(beta_m);
        // Beyond this nothing passes.
        let sigma_a = parameters.sigma_a.map(|s| s.within(T::ZERO, T::of(1e18)));
        Self {
            h: None,
            eta: parameters.eta.within(T::of(0.1), T::of(10.0)),
            sigma_a,
            variance: [v, T::of(0.25) * v, T::of(4.0) * v, T::of(4.0) * v],
            scale: azimuthal::scale(beta_n),
            tilt: [-2.0, 1.0, 4.0, 0.0].map(|times| {
                let angle = parameters.alpha_deg.to_f64() * times;
                let angle = if angle.is_finite() { angle } else { 0.0 };
                let (sin, cos) = (
                    T::of(angle.to_radians()).sin(),
                    T::of(angle.to_radians()).cos(),
                );
                Inclination { sin, cos }
            }),
            albedo: colour_of_absorption(sigma_a, beta_n),
        }
    }

    /// The fibre where the view is offset across it, whatever the normal: on a flat ribbon that stands for the fibre.
    ///
    /// * `h`: over the fibre's radius, towards the local y; clamped to `[-1, 1]`.
    #[must_use]
    pub fn at_offset(self, h: T) -> Self {
        Self {
            h: Some(h.within(-T::ONE, T::ONE)),
            ..self
        }
    }

    /// The fibre where the normal is the local z, as [`new`](Self::new) makes it.
    #[must_use]
    pub fn around_normal(self) -> Self {
        Self { h: None, ..self }
    }

    fn view(&self, wo: Vec3<T>) -> View<T> {
        let (inclination, azimuth) = angles(wo);
        let gamma_o = match self.h {
            Some(h) => [h, ((T::ONE - h) * (T::ONE + h)).safe_sqrt()],
            None => [-azimuth[0], azimuth[1].abs()],
        };
        View {
            inclination,
            azimuth,
            section: Section::new(gamma_o, inclination, self.eta, self.sigma_a),
        }
    }

    /// The view's inclination on the scales, as a lobe sees it.
    ///
    /// Tilts beyond the fibre's axis end on the other side of it, where the cosine is positive, too.
    fn tilted(&self, p: usize, o: Inclination<T>) -> Inclination<T> {
        let turn = self.tilt[p];
        Inclination {
            sin: o.sin * turn.cos + o.cos * turn.sin,
            cos: (o.cos * turn.cos - o.sin * turn.sin).abs(),
        }
    }

    fn value_and_density(&self, view: &View<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let (inclination, azimuth) = angles(wi);
        let ([cos_o, sin_o], [cos_i, sin_i]) = (view.azimuth, azimuth);
        let phi = (cos_o * sin_i - sin_o * cos_i).atan2(cos_o * cos_i + sin_o * sin_i);
        let section = &view.section;
        let (mut value, mut pdf) = (Rgb::BLACK, T::ZERO);
        for p in 0..LOBES {
            let o = self.tilted(p, view.inclination);
            let along = longitudinal::density(self.variance[p], inclination, o);
            let around = if p == RESIDUE {
                T::HALF * T::INV_PI
            } else {
                let centre = azimuthal::deflection(p, section.gamma_o, section.gamma_t);
                azimuthal::density(self.scale, phi - centre)
            };
            value += section.attenuation[p] * (along * around);
            pdf += section.probability[p] * (along * around);
        }
        (value, pdf)
    }
}

impl<T: Real> Bsdf<T> for Hair<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        self.value_and_density(&self.view(wo), wi).0
    }

    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.value_and_density(&self.view(wo), wi).1
    }

    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        self.value_and_density(&self.view(wo), wi)
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let view = self.view(wo);
        let (p, u0) = chosen(&view.section.probability, u[0]);
        let o = self.tilted(p, view.inclination);
        let i = longitudinal::sample(self.variance[p], o, [u[1], u[2]]);
        let phi = if p == RESIDUE {
            T::TWO * T::PI * u0
        } else {
            let (gamma_o, gamma_t) = (view.section.gamma_o, view.section.gamma_t);
            azimuthal::deflection(p, gamma_o, gamma_t) + azimuthal::sample(self.scale, u0)
        };
        let (sin, cos) = (phi.sin(), phi.cos());
        let [cos_o, sin_o] = view.azimuth;
        let wi = vec3(
            i.sin,
            i.cos * (cos_o * cos - sin_o * sin),
            i.cos * (cos_o * sin + sin_o * cos),
        )
        .normalize();
        let (value, pdf) = self.value_and_density(&view, wi);
        if !(pdf > T::ZERO && pdf.is_finite()) {
            return None;
        }
        Some(BsdfSample {
            wi,
            weight: value / pdf,
            pdf,
            event: match wi.z * wo.z < T::ZERO {
                true => Event::Transmission,
                false => Event::Reflection,
            },
            specular: false,
            eta: T::ONE,
        })
    }

    /// The colour of many such fibres together.
    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}

/// Inclination, and cosine and sine of the azimuth: that of z for directions along the fibre.
fn angles<T: Real>(w: Vec3<T>) -> (Inclination<T>, [T; 2]) {
    let across = (w.y * w.y + w.z * w.z).sqrt();
    let azimuth = match across > T::ZERO {
        true => [w.y / across, w.z / across],
        false => [T::ZERO, T::ONE],
    };
    let sin = w.x.within(-T::ONE, T::ONE);
    (
        Inclination {
            sin,
            cos: across.at_most(T::ONE),
        },
        azimuth,
    )
}

/// A lobe by its probability, and what is left of the random number.
fn chosen<T: Real>(probability: &[T; LOBES], u: T) -> (usize, T) {
    let (mut below, mut last) = (T::ZERO, (0, T::ZERO));
    for (p, &share) in probability.iter().enumerate() {
        if share > T::ZERO {
            last = (p, ((u - below) / share).within(T::ZERO, T::ONE));
            below += share;
            if u < below {
                break;
            }
        }
    }
    last
}
