//! Elements and lobes that the tests of the batch functions share.
#![allow(dead_code, reason = "no test file uses all of it")]

pub(crate) mod outcome;

use specula_bsdf::batch::Directions;
use specula_bsdf::bsdf::{
    CoatLayer, CoatScattering, CoatedDiffuse, Compensated, CompensatedDielectric,
    DiffuseTransmission, Eon, Gltf, GltfParameters, Lambert, Plastic, Principled,
    PrincipledParameters, RoughConductor, RoughDielectric, SmoothConductor, SmoothDielectric,
    ThinDielectric,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, F82Tint, Reflectance, Schlick};
use specula_bsdf::math::{Stream, rgb, warp};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Real, Rgb, Vec3};
use specula_testing::horizon;

/// Cosines of views: straight, oblique, grazing.
pub(crate) const COSINES: [f64; 7] = [1.0, 0.9, 0.7, 0.3, 0.05, 5e-3, 1e-3];

/// Views, lights and random numbers, the first two of them steered to every pair of cosines, above
/// the horizon and below it.
pub(crate) struct Elements<T> {
    pub(crate) wo: Directions<Vec<T>>,
    pub(crate) wi: Directions<Vec<T>>,
    pub(crate) u: [Vec<T>; 3],
}

impl<T: Real> Elements<T> {
    pub(crate) fn new(n: usize, seed: u64) -> Self {
        let mut stream = Stream::new(seed);
        let mut direction = |i: usize| {
            let turn: T = stream.next();
            let (s, c) = turn.sin_cos_turns();
            let free: T = stream.next();
            // Every other one at a cosine of the list, the rest anywhere.
            let z = match i % 2 {
                0 => T::of(COSINES[i / 2 % COSINES.len()]),
                _ => free,
            };
            let r = ((T::ONE - z) * (T::ONE + z)).sqrt();
            Vec3 {
                x: r * c,
                y: r * s,
                z,
            }
        };
        let below = |i: usize, w: Vec3<T>| match i % 5 {
            4 => Vec3 { z: -w.z, ..w },
            _ => w,
        };
        let wo = (0..n).map(|i| below(i, direction(i))).collect();
        let wi = (0..n)
            .map(|i| below(i / 5, direction(i / COSINES.len())))
            .collect();
        let u = core::array::from_fn(|_| (0..n).map(|_| stream.next()).collect());
        Self { wo, wi, u }
    }

    /// Some components that are not numbers.
    pub(crate) fn with_nan(mut self) -> Self {
        let nan = T::of(f64::NAN);
        for directions in [&mut self.wo, &mut self.wi] {
            for (i, x) in directions.x.iter_mut().enumerate() {
                *x = if i % 11 == 3 { nan } else { *x };
            }
            for (i, z) in directions.z.iter_mut().enumerate() {
                *z = if i % 7 == 2 { nan } else { *z };
            }
        }
        self
    }

    /// One of them.
    pub(crate) fn only(&self, i: usize) -> Self {
        let directions = |d: &Directions<Vec<T>>| Directions {
            x: vec![d.x[i]],
            y: vec![d.y[i]],
            z: vec![d.z[i]],
        };
        Self {
            wo: directions(&self.wo),
            wi: directions(&self.wi),
            u: self.u.each_ref().map(|u| vec![u[i]]),
        }
    }

    pub(crate) fn u(&self) -> [&[T]; 3] {
        [&self.u[0], &self.u[1], &self.u[2]]
    }

    /// Diffuse light instead: cosine-distributed directions above the horizon.
    pub(crate) fn above(n: usize, seed: u64) -> Self {
        let mut stream = Stream::new(seed);
        let mut directions = || {
            (0..n)
                .map(|_| warp::cosine_hemisphere([stream.next(), stream.next()]))
                .collect()
        };
        let (wo, wi) = (directions(), directions());
        let u = core::array::from_fn(|_| (0..n).map(|_| stream.next()).collect());
        Self { wo, wi, u }
    }
}

impl Elements<f32> {
    /// Cosines whose logarithms are uniform down to 1e-38, on both sides; half of the lights are opposite to the view
    /// in azimuth, a quarter are above or below it.
    pub(crate) fn near_the_horizon(n: usize, seed: u64) -> Self {
        let mut stream = Stream::new(seed);
        let mut wo = Vec::new();
        let wi = (0..n).map(|i| {
            let mut turn = || stream.next::<f32>().sin_cos_turns();
            let ((s, c), (other_s, other_c)) = (turn(), turn());
            let azimuth = match i % 4 {
                0 | 1 => [-c, -s],
                2 => [c, s],
                _ => [other_c, other_s],
            };
            let mut direction = |azimuth| -> Vec3<f32> {
                horizon::direction((stream.next(), stream.next()), azimuth).into()
            };
            wo.push(direction([c, s]));
            direction(azimuth)
        });
        let wi = wi.collect();
        let u = core::array::from_fn(|_| (0..n).map(|_| stream.next()).collect());
        let wo = wo.into_iter().collect();
        Self { wo, wi, u }
    }
}

/// A number that is the same in both precisions.
fn single<T: Real>(x: f32) -> T {
    T::of(f64::from(x))
}

pub(crate) fn colour<T: Real>(r: f32, g: f32, b: f32) -> Rgb<T> {
    rgb(single(r), single(g), single(b))
}

pub(crate) fn ggx<T: Real>([x, y]: [f32; 2]) -> Ggx<T> {
    Ggx::new(Alpha {
        x: single(x),
        y: single(y),
    })
}

pub(crate) fn gold<T: Real>() -> Reflectance<T> {
    Reflectance::Conductor(Conductor {
        eta: colour(0.14, 0.37, 1.44),
        k: colour(3.98, 2.38, 1.6),
    })
}

pub(crate) fn reflectances<T: Real>() -> [Reflectance<T>; 5] {
    let f0 = colour(0.9, 0.6, 0.3);
    [
        gold(),
        Reflectance::Constant(colour(1.0, 0.5, 0.25)),
        Reflectance::Schlick(Schlick { f0 }),
        Reflectance::F82Tint(F82Tint::new(f0, colour(0.7, 0.8, 0.9))),
        gold().tinted(colour(0.5, 0.6, 0.7)),
    ]
}

/// Calls the macro `$each` with every lobe that has loops of its own: its name in the table of lobes, and the lobe for
/// alphas `$alpha` in the scalar `$t`.
#[macro_export]
macro_rules! for_every_lobe {
    ($t:ty, $alpha:expr, $each:ident) => {{
        use $crate::batch_common as make;
        for sampler in make::SAMPLERS {
            for reflectance in make::reflectances::<$t>() {
                let metal = make::metal::<$t>($alpha, reflectance).with_sampler(sampler);
                $each!("RoughConductor", metal);
            }
            let separable = specula_bsdf::ndf::Masking::Separable;
            let metal = make::metal::<$t>($alpha, make::gold()).with_sampler(sampler);
            $each!("RoughConductor", metal.with_masking(separable));
            for eta in [1.5, 1.0 / 1.5, 1.0, 2.4] {
                let glass = make::glass::<$t>($alpha, eta).with_sampler(sampler);
                $each!("RoughDielectric", glass);
                $each!("RoughDielectric", glass.with_masking(separable));
            }
            let coat = make::coated_diffuse::<$t>(Some($alpha)).with_sampler(sampler);
            $each!("CoatedDiffuse", coat);
            let coat = make::lossy_coat::<$t>(Some($alpha)).with_sampler(sampler);
            $each!("CoatedDiffuse", coat);
            let plastic = make::plastic::<$t>($alpha).with_sampler(sampler);
            $each!("Plastic", plastic);
        }
        for reflectance in make::reflectances::<$t>() {
            let metal = make::beckmann::<$t>($alpha, reflectance);
            $each!("RoughConductorBeckmann", metal);
            $each!(
                "RoughConductorBeckmann",
                metal.with_masking(specula_bsdf::ndf::Masking::Separable)
            );
        }
        for eta in [1.5, 1.0 / 1.5] {
            $each!(
                "RoughDielectricBeckmann",
                make::beckmann_glass::<$t>($alpha, eta)
            );
        }
        for gltf in make::gltfs::<$t>($alpha) {
            $each!("Gltf", gltf);
        }
        for principled in make::principleds::<$t>($alpha) {
            $each!("Principled", principled);
        }
        $each!("CoatedDiffuse", make::coated_diffuse::<$t>(None));
        $each!("CoatedDiffuse", make::lossy_coat::<$t>(None));
        $each!("Plastic", make::smooth_plastic::<$t>());
        $each!("Lambert", make::lambert::<$t>());
        $each!("Eon", make::eon::<$t>());
        $each!("DiffuseTransmission", make::sheet::<$t>());
        for reflectance in make::reflectances::<$t>() {
            $each!(
                "SmoothConductor",
                specula_bsdf::bsdf::SmoothConductor::new(reflectance)
            );
        }
        $each!("SmoothDielectric", make::smooth_dielectric::<$t>());
        $each!("ThinDielectric", make::pane::<$t>());
    }};
}

pub(crate) const SAMPLERS: [Sampler; 4] = [
    Sampler::Heitz,
    Sampler::Cap,
    Sampler::Bounded,
    Sampler::Exact,
];

pub(crate) fn metal<T: Real>(alpha: [f32; 2], reflectance: Reflectance<T>) -> RoughConductor<T> {
    RoughConductor::new(ggx(alpha), reflectance).with_masking(Masking::HeightCorrelated)
}

pub(crate) fn beckmann<T: Real>(
    [x, y]: [f32; 2],
    reflectance: Reflectance<T>,
) -> RoughConductor<T, Beckmann<T>> {
    let ndf = Beckmann::new(Alpha {
        x: single(x),
        y: single(y),
    });
    RoughConductor::new(ndf, reflectance)
}

pub(crate) fn beckmann_glass<T: Real>(
    [x, y]: [f32; 2],
    eta: f32,
) -> RoughDielectric<T, Beckmann<T>> {
    let ndf = Beckmann::new(Alpha {
        x: single(x),
        y: single(y),
    });
    RoughDielectric::new(ndf, single(eta))
}

pub(crate) fn glass<T: Real>(alpha: [f32; 2], eta: f32) -> RoughDielectric<T> {
    RoughDielectric::new(ggx(alpha), single(eta))
}

pub(crate) fn coated_diffuse<T: Real>(alpha: Option<[f32; 2]>) -> CoatedDiffuse<T> {
    CoatedDiffuse::new(alpha.map(ggx), single(1.5), colour(0.8, 0.5, 0.2))
}

/// A coat as pbrt-v4's: its facets scatter once, what is under it absorbs.
pub(crate) fn lossy_coat<T: Real>(alpha: Option<[f32; 2]>) -> CoatedDiffuse<T> {
    let layer = CoatLayer {
        thickness: single(0.01),
        max_depth: Some(10),
        scattering: CoatScattering::Single,
    };
    CoatedDiffuse::over_layer(alpha.map(ggx), single(1.5), colour(0.8, 0.5, 0.2), layer)
}

/// As Mitsuba's `roughplastic`.
pub(crate) fn plastic<T: Real>(alpha: [f32; 2]) -> Plastic<T> {
    let [diffuse, specular] = [colour(0.8, 0.5, 0.2), colour(1.0, 0.9, 0.7)];
    Plastic::rough(
        ggx(alpha),
        Masking::Separable,
        single(1.5),
        diffuse,
        specular,
        true,
    )
}

/// As Mitsuba's `plastic`.
pub(crate) fn smooth_plastic<T: Real>() -> Plastic<T> {
    let [diffuse, specular] = [colour(0.8, 0.5, 0.2), colour(1.0, 0.9, 0.7)];
    Plastic::smooth(single(1.9), diffuse, specular, false)
}

/// glTF's materials that are vectors, and the forms of it that are computed one by one.
pub(crate) fn gltfs<T: Real>([along, across]: [f32; 2]) -> [Gltf<T>; 8] {
    // Alphas along and across are `a + (1 - a) s^2` and `a`.
    let least = along.min(across).min(1.0);
    let strength = ((along.max(across).min(1.0) - least) / (1.0 - least).max(1e-3)).sqrt();
    let mixed = GltfParameters::<T> {
        base_colour: colour(0.9, 0.5, 0.1),
        metallic: single(0.4),
        roughness: single(least.sqrt()),
        anisotropy: single(strength),
        specular: single(0.8),
        specular_colour: colour(1.0, 0.7, 0.4),
        ..GltfParameters::default()
    };
    [
        mixed,
        GltfParameters {
            metallic: T::ONE,
            compensated: true,
            ..mixed
        },
        GltfParameters {
            compensated: true,
            ..mixed
        },
        GltfParameters {
            metallic: T::ZERO,
            anisotropy: T::ZERO,
            ..mixed
        },
        GltfParameters {
            metallic: T::ZERO,
            base_colour: Rgb::BLACK,
            ..mixed
        },
        GltfParameters {
            clearcoat: T::HALF,
            ..mixed
        },
        GltfParameters {
            sheen_colour: colour(0.3, 0.2, 0.5),
            sheen_roughness: T::HALF,
            ..mixed
        },
        GltfParameters {
            transmission: T::HALF,
            volume: true,
            ..mixed
        },
    ]
    .map(Gltf::new)
}

/// `principled` that is vectors, and the forms of it that are computed one by one.
pub(crate) fn principleds<T: Real>([along, across]: [f32; 2]) -> [Principled<T>; 7] {
    // Alphas are `a / q` and `a q`, `q^2 = 1 - 0.9 anisotropic`.
    let (least, most) = (along.min(across).min(1.0), along.max(across).min(1.0));
    let mixed = PrincipledParameters::<T> {
        base_colour: colour(0.9, 0.5, 0.1),
        roughness: single((least * most).sqrt().sqrt()),
        anisotropic: single((1.0 - least / most) / 0.9),
        metallic: single(0.4),
        spec_tint: single(0.3),
        sheen: single(0.6),
        sheen_tint: T::HALF,
        flatness: single(0.4),
        clearcoat: T::HALF,
        clearcoat_gloss: single(0.7),
        ..PrincipledParameters::default()
    };
    let simple = PrincipledParameters {
        base_colour: mixed.base_colour,
        roughness: mixed.roughness,
        ..PrincipledParameters::default()
    };
    [
        mixed,
        simple,
        PrincipledParameters {
            metallic: T::ONE,
            ..simple
        },
        PrincipledParameters {
            base_colour: Rgb::BLACK,
            ..mixed
        },
        PrincipledParameters {
            outside: false,
            ..mixed
        },
        PrincipledParameters {
            spec_trans: T::HALF,
            ..mixed
        },
        PrincipledParameters {
            thin: true,
            ..mixed
        },
    ]
    .map(Principled::new)
}

/// Every model of energy compensation.
pub(crate) const MODELS: [EnergyModel; 3] = [
    EnergyModel::Turquin(FmsVariant::NormalIncidence),
    EnergyModel::Turquin(FmsVariant::AverageSeries),
    EnergyModel::KullaConty,
];

pub(crate) fn compensated<T: Real>(alpha: [f32; 2], model: EnergyModel) -> Compensated<T> {
    Compensated::new(ggx(alpha), gold(), model)
}

pub(crate) fn compensated_glass<T: Real>(alpha: [f32; 2]) -> CompensatedDielectric<T> {
    CompensatedDielectric::new(ggx(alpha), single(1.5))
}

pub(crate) fn lambert<T: Real>() -> Lambert<T> {
    Lambert::new(colour(0.8, 0.5, 0.2))
}

pub(crate) fn eon<T: Real>() -> Eon<T> {
    Eon::new(colour(0.8, 0.5, 0.2), single(0.6))
}

pub(crate) fn sheet<T: Real>() -> DiffuseTransmission<T> {
    DiffuseTransmission::new(colour(0.6, 0.3, 0.2), colour(0.1, 0.2, 0.3))
}

pub(crate) fn smooth_dielectric<T: Real>() -> SmoothDielectric<T> {
    SmoothDielectric::new(single(1.5))
}

pub(crate) fn pane<T: Real>() -> ThinDielectric<T> {
    ThinDielectric::new(single(1.5))
}

pub(crate) fn mirror<T: Real>() -> SmoothConductor<T> {
    SmoothConductor::new(gold())
}
