//! Metals, diffuse surfaces and the black one.

use specula_bsdf::Real;
use specula_bsdf::bsdf::{
    Compensated, DiffuseTransmission, Eon, KullaConty, Lambert, Lobe, RoughConductor,
    SmoothConductor,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::Rgb;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};

use super::{colour, lobe_cases, rows, sampler};
use crate::harness::{ALPHAS, Case, alpha};

/// Statements that declare the facets of `x[7]` to `x[11]`.
macro_rules! facets {
    () => {
        "let facets = MicrofacetsModel(vec2f(x[7], x[8]), u32(x[9]), u32(x[10]), u32(x[11]));
         "
    };
}
pub(crate) use facets;

/// Statements that declare gold, or what reflects everything, by `x[12]`.
macro_rules! metal {
    () => {
        concat!(
            crate::bsdf::metals::facets!(),
            "var reflectance = reflectance_constant(vec3f(1.0));
             if x[12] == 0.0 {
                 reflectance = reflectance_conductor(vec3f(0.14, 0.37, 1.44), vec3f(3.98, 2.38, 1.6));
             }
             "
        )
    };
}

/// Gold, or what reflects everything.
pub(super) fn metal<T: Real>(which: T) -> Reflectance<T> {
    if which > T::ZERO {
        return Reflectance::Constant(Rgb::WHITE);
    }
    Reflectance::Conductor(Conductor {
        eta: colour([0.14, 0.37, 1.44]),
        k: colour([3.98, 2.38, 1.6]),
    })
}

/// The masking of a code.
pub(super) fn masking<T: Real>(x: T) -> Masking {
    if x > T::ZERO {
        Masking::Separable
    } else {
        Masking::HeightCorrelated
    }
}

fn rough_conductor<T: Real>(p: &[T]) -> Lobe<T> {
    let (alpha, masking) = (alpha(p, 0), masking(p[3]));
    if p[2] > T::ZERO {
        RoughConductor::new(Beckmann::new(alpha), metal(p[5]))
            .with_masking(masking)
            .into()
    } else {
        RoughConductor::new(Ggx::new(alpha), metal(p[5]))
            .with_masking(masking)
            .with_sampler(sampler(p[4]))
            .into()
    }
}

fn compensated<T: Real>(p: &[T]) -> Lobe<T> {
    let (alpha, masking) = (alpha(p, 0), masking(p[3]));
    let model = if p[6] == T::ZERO {
        EnergyModel::Turquin(FmsVariant::NormalIncidence)
    } else if p[6] == T::ONE {
        EnergyModel::Turquin(FmsVariant::AverageSeries)
    } else {
        EnergyModel::KullaConty
    };
    if p[2] > T::ZERO {
        Compensated::new(Beckmann::new(alpha), metal(p[5]), model)
            .with_masking(masking)
            .into()
    } else {
        Compensated::new(Ggx::new(alpha), metal(p[5]), model)
            .with_masking(masking)
            .with_sampler(sampler(p[4]))
            .into()
    }
}

fn kulla_conty<T: Real>(p: &[T]) -> KullaConty<T> {
    KullaConty::new(p[0], metal(T::ZERO))
}

fn smooth_conductor<T: Real>(p: &[T]) -> Lobe<T> {
    SmoothConductor::new(metal(p[0])).into()
}

fn lambert<T: Real>(p: &[T]) -> Lobe<T> {
    Lambert::new(colour::<T>([0.9, 0.6, 0.3]) * p[0]).into()
}

fn eon<T: Real>(p: &[T]) -> Lobe<T> {
    Eon::new(colour([0.9, 0.6, 0.3]), p[0]).into()
}

fn diffuse_transmission<T: Real>(p: &[T]) -> Lobe<T> {
    let base = colour::<T>([0.9, 0.6, 0.3]);
    DiffuseTransmission::new(base * p[0], base * p[1]).into()
}

/// Alphas, distribution, masking, strategy and reflectance.
fn metals() -> Vec<[f32; 6]> {
    let mut all = Vec::new();
    for (i, [x, y]) in ALPHAS.into_iter().enumerate() {
        for strategy in [0.0, 1.0, 2.0, 3.0] {
            let white = if i % 2 == 0 { 0.0 } else { 1.0 };
            all.push([x, y, 0.0, 0.0, strategy, 0.0]);
            all.push([x, y, 0.0, 1.0, strategy, white]);
        }
        if x.max(y) < 2.0 && x.min(y) > 1e-2 {
            all.push([x, y, 1.0, 0.0, 0.0, 0.0]);
            all.push([x, y, 1.0, 1.0, 0.0, 1.0]);
        }
    }
    all
}

/// The same and a model of compensation.
fn compensated_metals() -> Vec<[f32; 7]> {
    // At alphas of 10 single scattering reflects a thousandth: Turquin's quotient has few digits in f32.
    let some = metals()
        .into_iter()
        .filter(|p| p[0].min(p[1]) < 5.0 && (p[4] == 3.0 || p[2] > 0.0));
    some.flat_map(|[x, y, distribution, masking, strategy, metal]| {
        [0.0, 1.0, 2.0].map(|model| [x, y, distribution, masking, strategy, metal, model])
    })
    .collect()
}

pub(super) fn cases() -> Vec<Case> {
    let smooth = |_: &[f32; 1]| ([0.3, 0.3], None);
    [
        lobe_cases!(
            "rough_conductor",
            "rough_conductor",
            concat!(metal!(), "let lobe = RoughConductor(facets, reflectance);\n"),
            rough_conductor,
            rows(&metals(), |p| ([p[0], p[1]], None), |p| p[2] > 0.0),
            [128.0, 512.0],
            &[1e-20]
        ),
        lobe_cases!(
            "compensated",
            "compensated",
            concat!(metal!(), "let lobe = compensated_new(facets, reflectance, u32(x[13]));\n"),
            compensated,
            rows(&compensated_metals(), |p| ([p[0], p[1]], None), |p| p[2] > 0.0),
            [2048.0, 4096.0],
            &[1e-3]
        ),
        lobe_cases!(
            "kulla_conty",
            "kulla_conty",
            "let gold = ConductorIor(vec3f(0.14, 0.37, 1.44), vec3f(3.98, 2.38, 1.6));
             let lobe = kulla_conty_new(x[7], gold);\n",
            kulla_conty,
            rows(&ALPHAS.map(|[x, _]| [x]), |p| ([p[0].min(1.0); 2], None), |_| false),
            [512.0, 4096.0],
            &[1e-3]
        ),
        lobe_cases!(
            "smooth_conductor",
            "smooth_conductor",
            "var reflectance = reflectance_constant(vec3f(1.0));
             if x[7] == 0.0 {
                 reflectance = reflectance_conductor(vec3f(0.14, 0.37, 1.44), vec3f(3.98, 2.38, 1.6));
             }
             let lobe = SmoothConductor(reflectance);\n",
            smooth_conductor,
            rows(&[[0.0], [1.0]], smooth, |_| false),
            [0.0, 8.0],
            &[1e-20]
        ),
        lobe_cases!(
            "lambert",
            "lambert",
            "let lobe = LambertLobe(vec3f(0.9, 0.6, 0.3) * x[7]);\n",
            lambert,
            rows(&[[1.0], [0.5]], smooth, |_| false),
            [2.0, 8.0],
            &[1e-20]
        ),
        lobe_cases!(
            "eon",
            "eon",
            "let lobe = EonLobe(vec3f(0.9, 0.6, 0.3), x[7]);\n",
            eon,
            rows(&[[0.0], [0.1], [0.5], [1.0]], smooth, |_| false),
            [16.0, 16.0],
            &[1e-20]
        ),
        lobe_cases!(
            "diffuse_transmission",
            "diffuse_transmission",
            "let lobe = DiffuseTransmission(vec3f(0.9, 0.6, 0.3) * x[7], vec3f(0.9, 0.6, 0.3) * x[8]);\n",
            diffuse_transmission,
            rows(&[[0.5, 0.5], [0.9, 0.0], [0.1, 0.7]], |_| ([0.3, 0.3], None), |_| false),
            [4.0, 8.0],
            &[1e-20]
        ),
    ]
    .concat()
}
