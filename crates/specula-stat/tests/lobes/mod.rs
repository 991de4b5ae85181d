//! Examples of every lobe of the library's table.
#![allow(dead_code, reason = "each suite uses a part")]

use specula_bsdf::bsdf::{
    Base, Black, CoatedDiffuse, Compensated, CompensatedDielectric, DiffuseTransmission, Eon, Gltf,
    GltfParameters, Lambert, Layered, Lobe, Medium, MultibounceConductor, MultibounceDielectric,
    Plastic, Principled, PrincipledParameters, RoughConductor, RoughDielectric, SmoothConductor,
    SmoothDielectric, ThinDielectric,
};
use specula_bsdf::energy::EnergyModel;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Real, rgb};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Alpha, Rgb};
use specula_stat::reciprocity::Domain;

/// A lobe, and what it promises.
pub(crate) struct Example<T> {
    pub(crate) lobe: Lobe<T>,
    /// Index of refraction below the surface; 1 where nothing refracts.
    pub(crate) eta: f64,
    pub(crate) reciprocity: Domain,
    /// The lowest cosine of views: samples from below follow the density too where it is negative.
    pub(crate) lowest: f64,
}

impl<T: Real> Example<T> {
    /// A lobe that is black below the surface and reciprocal above.
    fn reflecting(lobe: impl Into<Lobe<T>>) -> Self {
        Self {
            lobe: lobe.into(),
            eta: 1.0,
            reciprocity: Domain::Above,
            lowest: 0.0,
        }
    }

    /// The same from below: a backfacing shading normal.
    fn seen_down_to(self, lowest: f64) -> Self {
        Self { lowest, ..self }
    }

    /// An interface of index [`ETA`] with both sides.
    fn interface(lobe: impl Into<Lobe<T>>) -> Self {
        Self {
            lobe: lobe.into(),
            eta: ETA,
            reciprocity: Domain::Everywhere,
            lowest: -1.0,
        }
    }
}

pub(crate) const ETA: f64 = 1.5;
pub(crate) const ALPHAS: (f64, f64) = (0.3, 0.5);

pub(crate) fn colour<T: Real>() -> Rgb<T> {
    rgb(T::of(0.8), T::of(0.4), T::of(0.1))
}

/// Gold, about.
pub(crate) fn gold<T: Real>() -> Reflectance<T> {
    let colour = |r, g, b| rgb(T::of(r), T::of(g), T::of(b));
    Reflectance::Conductor(Conductor {
        eta: colour(0.143, 0.375, 1.442),
        k: colour(3.983, 2.386, 1.603),
    })
}

/// At least one example of each row of the table, one for each of its ways to scatter; rough ones of these alphas.
pub(crate) fn examples<T: Real>((x, y): (f64, f64)) -> Vec<Example<T>> {
    let alpha = Alpha::clamped(T::of(x), T::of(y));
    let (ggx, beckmann) = (Ggx::new(alpha), Beckmann::new(alpha));
    let (eta, masking) = (T::of(ETA), Masking::Separable);
    let (kulla_conty, model) = (EnergyModel::KullaConty, MultibounceModel::default());
    let cloud = Medium {
        thickness: T::of(0.3),
        albedo: colour(),
        g: T::of(0.3),
    };
    let layered = |base| {
        Layered::new(Some(ggx), eta, base)
            .with_medium(cloud)
            .with_max_depth(20)
    };
    let principled = PrincipledParameters {
        base_colour: colour(),
        metallic: T::of(0.3),
        ..PrincipledParameters::default()
    };
    let gltf = GltfParameters {
        base_colour: colour(),
        metallic: T::of(0.3),
        roughness: T::of(0.6),
        ..GltfParameters::default()
    };
    vec![
        Example::reflecting(Lambert::new(colour())),
        Example::reflecting(Eon::new(colour(), T::of(0.6))),
        Example::reflecting(DiffuseTransmission::new(colour(), colour() * T::of(0.2))),
        Example::reflecting(SmoothConductor::new(gold())),
        Example::reflecting(RoughConductor::new(ggx, gold())).seen_down_to(-0.3),
        Example::reflecting(RoughConductor::new(beckmann, gold())).seen_down_to(-0.05),
        Example::interface(SmoothDielectric::new(eta)),
        Example::interface(RoughDielectric::new(ggx, eta)),
        Example::interface(RoughDielectric::new(beckmann, eta)),
        Example {
            eta: 1.0,
            ..Example::interface(ThinDielectric::new(eta))
        },
        Example::reflecting(CoatedDiffuse::new(None, eta, colour())),
        Example::reflecting(CoatedDiffuse::new(Some(ggx), eta, colour())),
        Example::reflecting(layered(Base::metal(Some(ggx), gold()))),
        Example::reflecting(layered(Base::diffuse(colour()))),
        Example::reflecting(Layered::new(None, eta, Base::metal(None, gold()))),
        Example::reflecting(Compensated::new(ggx, gold(), kulla_conty)).seen_down_to(-0.3),
        Example::reflecting(Compensated::new(beckmann, gold(), kulla_conty)).seen_down_to(-0.05),
        Example::interface(CompensatedDielectric::new(ggx, eta)),
        Example::interface(CompensatedDielectric::new(beckmann, eta)),
        Example::reflecting(MultibounceConductor::new(ggx, gold(), model)),
        Example::reflecting(MultibounceConductor::new(beckmann, gold(), model)),
        Example::interface(MultibounceDielectric::new(ggx, eta, model)),
        Example::interface(MultibounceDielectric::new(beckmann, eta, model)),
        Example::reflecting(Black),
        Example::reflecting(Plastic::smooth(eta, colour(), colour(), true)),
        Example::reflecting(Plastic::rough(ggx, masking, eta, colour(), colour(), true)),
        Example::reflecting(Plastic::rough(
            beckmann,
            masking,
            eta,
            colour(),
            colour(),
            true,
        )),
        Example::reflecting(Principled::new(principled)),
        Example::reflecting(Gltf::new(gltf)),
    ]
}

macro_rules! rows {
    ($($(#[$doc:meta])* $name:ident: $lobe:ty, $sides:ident, $batch:ident, $shader:literal;)*) => {
        /// The rows of the table.
        pub(crate) const ROWS: &[&str] = &[$(stringify!($name)),*];

        /// The row that a lobe is of.
        pub(crate) fn row<T>(lobe: &Lobe<T>) -> &'static str {
            match lobe {
                $(Lobe::$name(_) => stringify!($name),)*
            }
        }
    };
}

specula_bsdf::lobe_table!(rows);
