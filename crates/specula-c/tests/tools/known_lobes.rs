//! Lobes of all kinds, as texts and as the library makes them.

use specula_bsdf::bsdf::{
    Base, CoatLayer, CoatScattering, CoatedDiffuse, Compensated, CompensatedDielectric,
    DiffuseTransmission, Eon, Gltf, GltfParameters, Lambert, Layered, Lobe, Medium,
    MultibounceConductor, MultibounceDielectric, Plastic, Principled, PrincipledParameters,
    RoughConductor, RoughDielectric, SmoothConductor, SmoothDielectric, ThinDielectric, Tints,
};
use specula_bsdf::energy::EnergyModel;
use specula_bsdf::fresnel::{Conductor, F82Tint, Reflectance, Schlick};
use specula_bsdf::math::{Real, rgb};
use specula_bsdf::metals::by_symbol;
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Rgb};

/// The texts.
pub(crate) const TEXTS: [&str; 30] = [
    "lambert albedo 0.8,0.2,0.1",
    "lambert",
    "eon albedo 0.7 roughness 0.8",
    "diffuse-transmission reflectance 0.1,0.2,0.3 transmittance 0.4",
    "smooth-conductor Au",
    "smooth_conductor",
    "conductor Au alpha 0.3",
    "conductor alpha 0.1,0.4 reflectance 0.9,0.6,0.3 sampler heitz masking separable",
    "conductor alpha 0.2 f0 0.9,0.6,0.3 energy turquin sampler bounded",
    "conductor alpha 0.2,0.3 distribution beckmann f0 0.9 f82_tint 0.5",
    "conductor alpha 0.25 distribution beckmann energy kulla-conty Cu tint 0.5",
    "multibounce-conductor Au alpha 0.4",
    "multibounce-conductor alpha 0.4,0.2 model heitz mis_pdf lambert conductor_eta 0.2,0.9,1.1 \
     conductor_k 3.9,2.4,2.2",
    "multibounce-conductor alpha 0.4 distribution beckmann model bitterli",
    "smooth-dielectric eta 1.33 transmission_tint 0.9,0.8,0.7",
    "thin-dielectric reflection-tint 0.5",
    "dielectric alpha 0.3",
    "dielectric alpha 0.1,0.4 eta 0.7 sampler exact masking separable transmission_tint 0.5",
    "dielectric alpha 0.3 compensated true",
    "dielectric alpha 0.3 distribution beckmann",
    "dielectric alpha 0.3 distribution beckmann compensated 1 eta 1.8",
    "multibounce-dielectric alpha 0.3 reflection_tint 0.9",
    "multibounce-dielectric alpha 0.3 distribution beckmann model heitz mis_pdf hapke",
    "coated-diffuse alpha 0.2 eta 1.4 albedo 0.8,0.2,0.1 thickness 0.5 max_depth 5 scattering single",
    "layered albedo 0.5 thickness 0.25 medium_albedo 0.75 g 0.5 alpha 0.2",
    "layered Cu base_alpha 0.3 eta 1.3",
    "plastic alpha 0.2 nonlinear true diffuse 0.8,0.2,0.1 specular 0.5",
    "plastic alpha 0.2 distribution beckmann masking height_correlated",
    "principled base_color 0.8,0.2,0.1 roughness 0.25 metallic 0.5 anisotropic 0.5 clearcoat 1 sheen 0.5",
    "gltf base_color 0.8,0.2,0.1 roughness 0.5 metallic 0.25 clearcoat 0.5 transmission 0.5 volume true \
     sheen_color 0.5 specular_color 2",
];

fn ggx<T: Real>(x: f64, y: f64) -> Ggx<T> {
    Ggx::new(Alpha::clamped(T::of(x), T::of(y)))
}

fn beckmann<T: Real>(x: f64, y: f64) -> Beckmann<T> {
    Beckmann::new(Alpha::clamped(T::of(x), T::of(y)))
}

fn colour<T: Real>(r: f64, g: f64, b: f64) -> Rgb<T> {
    rgb(T::of(r), T::of(g), T::of(b))
}

fn grey<T: Real>(value: f64) -> Rgb<T> {
    Rgb::splat(T::of(value))
}

fn metal<T: Real>(symbol: &str) -> Reflectance<T> {
    let metal = by_symbol(symbol).unwrap();
    let [eta, k] = [metal.eta, metal.k].map(|n| Rgb::from(n).cast());
    Reflectance::Conductor(Conductor { eta, k })
}

fn schlick<T: Real>() -> Reflectance<T> {
    let f0 = colour(0.9, 0.6, 0.3);
    Reflectance::Schlick(Schlick { f0 })
}

fn white<T: Real>() -> Reflectance<T> {
    Reflectance::Constant(Rgb::WHITE)
}

fn tints<T: Real>(reflection: Rgb<T>, transmission: Rgb<T>) -> Tints<T> {
    Tints {
        reflection,
        transmission,
    }
}

/// Those of the texts.
pub(crate) fn known<T: Real>() -> Vec<Lobe<T>> {
    let mut lobes = metals();
    lobes.extend(dielectrics());
    lobes.extend(compounds());
    lobes
}

fn metals<T: Real>() -> Vec<Lobe<T>> {
    let f82 = F82Tint::new(grey(0.9), grey(0.5));
    let exact = Reflectance::Conductor(Conductor {
        eta: colour(0.2, 0.9, 1.1),
        k: colour(3.9, 2.4, 2.2),
    });
    let (of_walks, heitz) = (
        MultibounceModel::StratifiedBidirectional,
        MultibounceModel::Heitz2016,
    );
    let turquin: EnergyModel = "turquin".parse().unwrap();
    let copper = metal("Cu").tinted(grey(0.5));
    vec![
        Lambert::new(colour(0.8, 0.2, 0.1)).into(),
        Lambert::new(grey(0.5)).into(),
        Eon::new(grey(0.7), T::of(0.8)).into(),
        DiffuseTransmission::new(colour(0.1, 0.2, 0.3), grey(0.4)).into(),
        SmoothConductor::new(metal("Au")).into(),
        SmoothConductor::new(white()).into(),
        RoughConductor::new(ggx(0.3, 0.3), metal("Au")).into(),
        RoughConductor::new(ggx(0.1, 0.4), Reflectance::Constant(colour(0.9, 0.6, 0.3)))
            .with_sampler(Sampler::Heitz)
            .with_masking(Masking::Separable)
            .into(),
        Compensated::new(ggx(0.2, 0.2), schlick(), turquin)
            .with_sampler(Sampler::Bounded)
            .into(),
        RoughConductor::new(beckmann(0.2, 0.3), Reflectance::F82Tint(f82)).into(),
        Compensated::new(beckmann(0.25, 0.25), copper, EnergyModel::KullaConty).into(),
        MultibounceConductor::new(ggx(0.4, 0.4), metal("Au"), of_walks).into(),
        MultibounceConductor::new(ggx(0.4, 0.2), exact, heitz)
            .with_mis_pdf("lambert".parse().unwrap())
            .into(),
        MultibounceConductor::new(
            beckmann(0.4, 0.4),
            white(),
            MultibounceModel::BitterliDeon2022,
        )
        .into(),
    ]
}

fn dielectrics<T: Real>() -> Vec<Lobe<T>> {
    let glass = T::of(1.5);
    let hapke: MisPdf = "hapke".parse().unwrap();
    vec![
        SmoothDielectric::new(T::of(1.33))
            .with_tints(tints(Rgb::WHITE, colour(0.9, 0.8, 0.7)))
            .into(),
        ThinDielectric::new(glass)
            .with_tints(tints(grey(0.5), Rgb::WHITE))
            .into(),
        RoughDielectric::new(ggx(0.3, 0.3), glass)
            .with_sampler(Sampler::Cap)
            .into(),
        RoughDielectric::new(ggx(0.1, 0.4), T::of(0.7))
            .with_sampler(Sampler::Exact)
            .with_masking(Masking::Separable)
            .with_tints(tints(Rgb::WHITE, grey(0.5)))
            .into(),
        CompensatedDielectric::new(ggx(0.3, 0.3), glass)
            .with_sampler(Sampler::Cap)
            .into(),
        RoughDielectric::new(beckmann(0.3, 0.3), glass).into(),
        CompensatedDielectric::new(beckmann(0.3, 0.3), T::of(1.8)).into(),
        MultibounceDielectric::new(ggx(0.3, 0.3), glass, MultibounceModel::default())
            .with_tints(tints(grey(0.9), Rgb::WHITE))
            .into(),
        MultibounceDielectric::new(beckmann(0.3, 0.3), glass, MultibounceModel::Heitz2016)
            .with_mis_pdf(hapke)
            .into(),
    ]
}

fn compounds<T: Real>() -> Vec<Lobe<T>> {
    let layer = CoatLayer {
        thickness: T::of(0.5),
        max_depth: Some(5),
        scattering: CoatScattering::Single,
    };
    let medium = Medium {
        thickness: T::of(0.25),
        albedo: grey(0.75),
        g: T::of(0.5),
    };
    let copper = Base::metal(Some(ggx(0.3, 0.3)), metal("Cu"));
    let red = colour(0.8, 0.2, 0.1);
    let (coat, half) = (ggx(0.2, 0.2), grey(0.5));
    vec![
        CoatedDiffuse::over_layer(Some(coat), T::of(1.4), red, layer).into(),
        Layered::new(Some(coat), T::of(1.5), Base::diffuse(half))
            .with_medium(medium)
            .into(),
        Layered::new(None, T::of(1.3), copper).into(),
        Plastic::rough(coat, Masking::Separable, T::of(1.49), red, half, true).into(),
        Plastic::rough(
            beckmann(0.2, 0.2),
            Masking::HeightCorrelated,
            T::of(1.49),
            half,
            Rgb::WHITE,
            false,
        )
        .into(),
        Principled::new(PrincipledParameters {
            base_colour: red,
            roughness: T::of(0.25),
            anisotropic: T::of(0.5),
            metallic: T::of(0.5),
            spec_trans: T::ZERO,
            eta: T::of(1.5),
            spec_tint: T::ZERO,
            sheen: T::of(0.5),
            sheen_tint: T::ZERO,
            clearcoat: T::ONE,
            clearcoat_gloss: T::ZERO,
            flatness: T::ZERO,
            diff_trans: T::ZERO,
            thin: false,
            outside: true,
        })
        .into(),
        Gltf::new(GltfParameters {
            base_colour: red,
            metallic: T::of(0.25),
            roughness: T::of(0.5),
            anisotropy: T::ZERO,
            ior: T::of(1.5),
            specular: T::ONE,
            specular_colour: grey(2.0),
            transmission: T::of(0.5),
            volume: true,
            outside: true,
            clearcoat: T::of(0.5),
            clearcoat_roughness: T::ZERO,
            sheen_colour: grey(0.5),
            sheen_roughness: T::ZERO,
            compensated: false,
        })
        .into(),
    ]
}
