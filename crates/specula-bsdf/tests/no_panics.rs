//! Nothing public panics: constructors and lobes take any argument, NaN and infinities included.

use specula_bsdf::bsdf::{
    Base, CoatLayer, CoatScattering, CoatedDiffuse, Compensated, CompensatedDielectric, Eon, Gltf,
    GltfParameters, Layered, Lobe, Medium, MultibounceConductor, MultibounceDielectric, Plastic,
    Principled, PrincipledParameters, RoughConductor, RoughDielectric, SmoothDielectric,
    ThinDielectric,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, F82Tint, Reflectance};
use specula_bsdf::math::{Stream, rgb, vec3};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Alpha, Bsdf, Frame, Real, Transport};

/// Values that a caller should not pass.
fn odd<T: Real>() -> [T; 7] {
    let huge = T::MAX * T::MAX;
    let nan = huge * T::ZERO;
    [-huge, -T::ONE, T::ZERO, T::TINY, T::of(1e9), huge, nan]
}

/// Lobes of parameters that are all `x`.
fn lobes<T: Real>(x: T) -> Vec<Lobe<T>> {
    let colour = rgb(x, x, x);
    let metal = Reflectance::Conductor(Conductor {
        eta: colour,
        k: colour,
    })
    .tinted(colour);
    let f82 = Reflectance::F82Tint(F82Tint::new(colour, colour));
    // The fields are public: the range is not held.
    let ggx = Ggx::new(Alpha { x, y: T::HALF });
    let beckmann = Beckmann::new(Alpha { x, y: x });
    let layer = CoatLayer {
        thickness: x,
        max_depth: Some(u32::MAX),
        scattering: CoatScattering::Single,
    };
    let medium = Medium {
        thickness: x,
        albedo: colour,
        g: x,
    };
    let mut lobes: Vec<Lobe<T>> = vec![
        Eon::new(colour, x).into(),
        SmoothDielectric::new(x).into(),
        ThinDielectric::new(x).into(),
        RoughConductor::new(ggx, f82).into(),
        RoughConductor::new(beckmann, metal).into(),
        RoughDielectric::new(ggx, x).into(),
        RoughDielectric::facing(beckmann, x).into(),
        CoatedDiffuse::over_layer(Some(ggx), x, colour, layer).into(),
        CompensatedDielectric::new(ggx, x).into(),
        CompensatedDielectric::facing(beckmann, x).into(),
        Plastic::smooth(x, colour, colour, true).into(),
        Plastic::rough(beckmann, Masking::Separable, x, colour, colour, true).into(),
        Principled::new(PrincipledParameters {
            base_colour: colour,
            roughness: x,
            eta: x,
            clearcoat: x,
            ..PrincipledParameters::default()
        })
        .into(),
        Gltf::new(GltfParameters {
            base_colour: colour,
            roughness: x,
            ior: x,
            clearcoat: x,
            sheen_colour: colour,
            sheen_roughness: x,
            compensated: true,
            ..GltfParameters::default()
        })
        .into(),
        Layered::new(Some(ggx), x, Base::metal(Some(ggx), metal))
            .with_medium(medium)
            .with_max_depth(0)
            .with_walks(0)
            .into(),
        Layered::new(None, x, Base::diffuse(colour))
            .with_medium(medium)
            .into(),
    ];
    for model in [
        EnergyModel::Turquin(FmsVariant::AverageSeries),
        EnergyModel::KullaConty,
    ] {
        lobes.push(Compensated::new(ggx, metal, model).into());
        lobes.push(Compensated::new(beckmann, f82, model).into());
    }
    for model in MultibounceModel::ALL {
        lobes.push(MultibounceConductor::new(ggx, metal, model).into());
        lobes.push(MultibounceDielectric::new(beckmann, x, model).into());
    }
    lobes
}

fn nothing_panics<T: Real>() {
    let directions = [
        vec3(T::ZERO, T::ZERO, T::ONE),
        vec3(T::of(0.6), T::ZERO, T::of(-0.8)),
        vec3(T::ZERO, T::ZERO, T::ZERO),
        vec3(T::MAX, T::MAX, T::MAX),
    ];
    let nan = odd::<T>()[6];
    let directions = directions.into_iter().chain([vec3(nan, nan, nan)]);
    let mut called = 0;
    for x in odd::<T>() {
        for lobe in lobes(x) {
            for wo in directions.clone() {
                let mut stream = Stream::new(1);
                for transport in [Transport::Radiance, Transport::Importance] {
                    for u in [[T::ZERO; 3], [T::HALF; 3], [x; 3]] {
                        let _ = lobe.sample(wo, u, transport);
                        let _ = lobe.sample_random(wo, u, transport, &mut stream);
                    }
                    for wi in directions.clone() {
                        let _ = (lobe.eval_pdf(wo, wi, transport), lobe.pdf(wo, wi));
                        called += 1;
                    }
                }
                let _ = (lobe.albedo(), Frame::from_normal_tangent(wo, wo));
            }
        }
    }
    assert!(called > 10_000, "{called}");
}

#[test]
fn nothing_panics_in_single_precision() {
    nothing_panics::<f32>();
}

#[test]
fn nothing_panics_in_double_precision() {
    nothing_panics::<f64>();
}
