//! Mitsuba 3's `principled` and `principledthin`: Burley's material of 2012 and 2015.

mod gtr1;
mod opaque;
mod solid;
pub(super) mod terms;
mod thin;

use super::in_columns::InColumns;
use super::{Bsdf, BsdfSample, Transport};
use crate::math::{Real, Rgb, Vec3};
use opaque::{COLUMNS, Opaque};
use solid::Solid;
use thin::Thin;

/// What a [`Principled`] is made of, by the names of Mitsuba 3; shares are in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PrincipledParameters<T> {
    /// `base_color`.
    pub base_colour: Rgb<T>,
    /// `roughness`; alpha is its square.
    pub roughness: T,
    /// `anisotropic`.
    pub anisotropic: T,
    /// `metallic`; ignored where thin.
    pub metallic: T,
    /// `spec_trans`.
    pub spec_trans: T,
    /// `eta`: index inside over that outside, or what `specular` says (see
    /// [`eta_of_specular`](Self::eta_of_specular)).
    pub eta: T,
    /// `spec_tint`.
    pub spec_tint: T,
    /// `sheen`.
    pub sheen: T,
    /// `sheen_tint`.
    pub sheen_tint: T,
    /// `clearcoat`; ignored where thin.
    pub clearcoat: T,
    /// `clearcoat_gloss`.
    pub clearcoat_gloss: T,
    /// `flatness`.
    pub flatness: T,
    /// `diff_trans`, where thin: in `[0, 2]`.
    pub diff_trans: T,
    /// Whether it is `principledthin`.
    pub thin: bool,
    /// Whether it is seen from the outside of its shape; where thin, both sides are alike.
    pub outside: bool,
}

impl<T: Real> PrincipledParameters<T> {
    /// The index of refraction that Mitsuba makes of `specular`: `2 / (1 - sqrt(0.08 s)) - 1`.
    #[inline]
    pub fn eta_of_specular(specular: T) -> T {
        T::TWO / (T::ONE - (T::of(0.08) * specular).sqrt()) - T::ONE
    }
}

impl<T: Real> Default for PrincipledParameters<T> {
    /// Mitsuba's defaults.
    fn default() -> Self {
        Self {
            base_colour: Rgb::splat(T::HALF),
            roughness: T::HALF,
            anisotropic: T::ZERO,
            metallic: T::ZERO,
            spec_trans: T::ZERO,
            eta: T::of(1.5),
            spec_tint: T::ZERO,
            sheen: T::ZERO,
            sheen_tint: T::ZERO,
            clearcoat: T::ZERO,
            clearcoat_gloss: T::ZERO,
            flatness: T::ZERO,
            diff_trans: T::ZERO,
            thin: false,
            outside: true,
        }
    }
}

/// Mitsuba 3's `principled` and `principledthin`, by their formulas, as seen from the geometric
/// side of `wo`.
///
/// ```text
/// principled:  diffuse (1 - metallic) (1 - spec_trans) + sheen (1 - metallic)
///            + reflection by GGX with a Fresnel term between dielectric and base colour
///            + refraction (1 - metallic) spec_trans sqrt(base)  + clear coat by GTR1
/// thin:        diffuse (1 - spec_trans) shared by both sides + sheen
///            + spec_trans (reflection F + straight transmission (1 - F) base, wider or narrower
///              by 0.65 eta - 0.35)
/// ```
///
/// Sampled by a mixture of the cosine, the visible normals and the clear coat's own normals, with
/// probabilities of our own, by the light that each carries from `wo`.
///
/// # Known limitations of the model
///
/// * Energy is not conserved: the diffuse part takes no account of what the specular one reflects, and
///   sheen and clear coat come on top, so that the albedo of a white base passes 1 towards grazing
///   views (to 1.19, and 1.27 with both; test `the_energy_that_principled_makes_is_as_stated`).
/// * Reflection is reciprocal; refraction is not: seen from inside, reflection is `spec_trans F`,
///   and the share of light that a mixed material (`0 < spec_trans < 1`) does not transmit is lost.
/// * The clear coat lacks the factor `1 / (4 cos cos)` of a microfacet lobe and has the masking of
///   alpha 1/4 at every gloss.
/// * From inside a material that does not transmit is black, and so is its refraction.
/// * Sheen does not fade with `spec_trans` (as in Mitsuba's vectorised variants; the scalar ones
///   drop it where the diffuse part vanishes).
/// * A thin sheet reflects and transmits by two different alphas, as no surface does, and passes
///   nothing where the light's direction sees the front of the mirrored facet.
///
/// Departures: a backfacing shading normal (`wo.z < 0`) is continued as
/// [`Ndf::g2_over_cos`](crate::ndf::Ndf::g2_over_cos) says, where Mitsuba sees the other side;
/// indices within 1e-3 of 1 are taken as 1.001 (Mitsuba: 1 only).
///
/// Source: Burley 2012, Physically-Based Shading at Disney; Burley 2015, Extending the Disney BRDF
/// to a BSDF; Mitsuba 3's documentation of the two plugins. A test holds values of Mitsuba 3.9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled<T>(Surface<T>);

/// A closed surface or a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Surface<T> {
    Solid(Solid<T>),
    Thin(Thin<T>),
}

impl<T: Real> Principled<T> {
    /// The material of these parameters; shares outside `[0, 1]` are clamped.
    #[inline]
    pub fn new(parameters: PrincipledParameters<T>) -> Self {
        let share = |x: T| x.within(T::ZERO, T::ONE);
        let p = PrincipledParameters {
            base_colour: parameters.base_colour.map(share),
            roughness: share(parameters.roughness),
            anisotropic: share(parameters.anisotropic),
            metallic: share(parameters.metallic),
            spec_trans: share(parameters.spec_trans),
            eta: proper_index(parameters.eta),
            spec_tint: share(parameters.spec_tint),
            sheen: share(parameters.sheen),
            sheen_tint: share(parameters.sheen_tint),
            clearcoat: share(parameters.clearcoat),
            clearcoat_gloss: share(parameters.clearcoat_gloss),
            flatness: share(parameters.flatness),
            diff_trans: parameters.diff_trans.within(T::ZERO, T::TWO),
            ..parameters
        };
        Self(if p.thin {
            Surface::Thin(Thin::new(&p))
        } else {
            Surface::Solid(Solid::new(&p))
        })
    }
}

impl<T: Real> Principled<T> {
    /// Whether anything passes it; else it only reflects.
    #[inline(always)]
    pub fn transmits(&self) -> bool {
        match &self.0 {
            Surface::Solid(solid) => solid.through > T::ZERO,
            Surface::Thin(_) => true,
        }
    }
}

/// An index that bends: refraction has no density where nothing is bent.
fn proper_index<T: Real>(eta: T) -> T {
    let eta = eta.within(T::of(0.1), T::of(10.0));
    let least = T::of(1e-3);
    let bend = eta - T::ONE;
    T::select(bend.abs() < least, T::ONE + least, eta)
}

impl<T: Real> Bsdf<T> for Principled<T> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        match &self.0 {
            Surface::Solid(solid) => solid.sample(wo, u, transport),
            Surface::Thin(thin) => thin.sample(wo, u),
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        match &self.0 {
            Surface::Solid(solid) => solid.eval_pdf(wo, wi, transport),
            Surface::Thin(thin) => thin.eval_pdf(wo, wi),
        }
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        match &self.0 {
            Surface::Solid(solid) => solid.base(),
            Surface::Thin(thin) => thin.base(),
        }
    }
}

/// In columns, where it is closed and refracts nothing.
impl<T: Real> InColumns<T, COLUMNS, 0, 0> for Principled<T> {
    #[inline(always)]
    fn columns(&self) -> Option<[T; COLUMNS]> {
        match &self.0 {
            Surface::Solid(solid) if solid.through <= T::ZERO => Some(solid.opaque.columns()),
            _ => None,
        }
    }

    /// It has no tables.
    #[inline(always)]
    fn places(_columns: [T; COLUMNS], _w: Vec3<T>) -> [T; 0] {
        []
    }

    #[inline(always)]
    fn look_up(&self, _places: [T; 0], _w: Vec3<T>) -> [T; 0] {
        []
    }

    #[inline(always)]
    fn sample_wi_of(columns: [T; COLUMNS], _: [T; 0], wo: Vec3<T>, u: [T; 3]) -> Vec3<T> {
        Opaque::of_columns(columns).sample_wi(wo, u)
    }

    #[inline(always)]
    fn eval_pdf_of(columns: [T; COLUMNS], _: [[T; 0]; 2], wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        Opaque::of_columns(columns).eval_pdf(wo, wi)
    }
}
