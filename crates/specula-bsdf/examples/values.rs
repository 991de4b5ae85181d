//! Values, densities and samples of some lobes, one line each: what bindings of other languages are compared with.
//!
//! ```text
//! lobe wo.x wo.y wo.z wi.x wi.y wi.z  f.r f.g f.b pdf  s.wi.x s.wi.y s.wi.z s.weight.r s.weight.g s.weight.b s.pdf
//! ```
//!
//! The sample's random numbers are 0.3, 0.6 and 0.2; zeros where it is rejected.

use specula_bsdf::bsdf::{
    CoatedDiffuse, Compensated, CompensatedDielectric, Eon, Lambert, Lobe, Plastic, Principled,
    PrincipledParameters, RoughConductor, RoughDielectric, SmoothDielectric, ThinDielectric,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Rgb, Stream, Vec3, rgb, vec3};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Bsdf, Transport, metals};

fn lobes() -> Vec<(&'static str, Lobe<f64>)> {
    let metal = |symbol| {
        let metal = metals::by_symbol(symbol).expect("measured");
        Reflectance::Conductor(Conductor {
            eta: metal.eta.into(),
            k: metal.k.into(),
        })
    };
    let ggx = |x, y| Ggx::new(Alpha::clamped(x, y));
    let beckmann = |x, y| Beckmann::new(Alpha::clamped(x, y));
    let colour = rgb(0.2, 0.5, 0.8);
    let gold = |x, y| RoughConductor::new(ggx(x, y), metal("Au"));
    let turquin = EnergyModel::Turquin(FmsVariant::NormalIncidence);
    let principled = PrincipledParameters {
        base_colour: colour,
        roughness: 0.4,
        metallic: 0.5,
        clearcoat: 0.5,
        ..PrincipledParameters::default()
    };
    vec![
        ("lambert", Lambert::new(colour).into()),
        ("eon", Eon::new(colour, 0.7).into()),
        ("gold exact", gold(0.2, 0.5).into()),
        (
            "gold bounded",
            gold(0.3, 0.3).with_sampler(Sampler::Bounded).into(),
        ),
        (
            "gold cap",
            gold(0.3, 0.3)
                .with_sampler(Sampler::Cap)
                .with_masking(Masking::Separable)
                .into(),
        ),
        (
            "gold heitz",
            gold(0.3, 0.3).with_sampler(Sampler::Heitz).into(),
        ),
        (
            "gold beckmann",
            RoughConductor::new(beckmann(0.2, 0.5), metal("Au")).into(),
        ),
        (
            "turquin",
            Compensated::new(ggx(0.7, 0.7), metal("Cu"), turquin).into(),
        ),
        (
            "kulla-conty",
            Compensated::new(ggx(0.7, 0.7), metal("Cu"), EnergyModel::KullaConty).into(),
        ),
        ("smooth glass", SmoothDielectric::new(1.5).into()),
        ("pane", ThinDielectric::new(1.5).into()),
        ("glass", RoughDielectric::new(ggx(0.3, 0.3), 1.5).into()),
        (
            "glass beckmann",
            RoughDielectric::new(beckmann(0.3, 0.3), 1.33).into(),
        ),
        (
            "compensated glass",
            CompensatedDielectric::new(ggx(0.5, 0.5), 1.5).into(),
        ),
        (
            "coated",
            CoatedDiffuse::new(Some(ggx(0.2, 0.2)), 1.5, colour).into(),
        ),
        (
            "plastic",
            Plastic::rough(
                ggx(0.2, 0.2),
                Masking::Separable,
                1.49,
                colour,
                Rgb::WHITE,
                false,
            )
            .into(),
        ),
        ("principled", Principled::new(principled).into()),
    ]
}

fn direction(stream: &mut Stream, is_above: bool) -> Vec3<f64> {
    let z = 0.05 + 0.95 * stream.next::<f64>();
    let (sin, cos) = (core::f64::consts::TAU * stream.next::<f64>()).sin_cos();
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    vec3(r * cos, r * sin, if is_above { z } else { -z })
}

#[allow(clippy::print_stdout, reason = "a program that prints")]
fn main() {
    let mut stream = Stream::new(1);
    for (name, lobe) in lobes() {
        for i in 0..40 {
            let wo = direction(&mut stream, i % 4 != 3);
            let wi = direction(&mut stream, i % 3 != 2);
            let (f, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);
            let sample = lobe.sample(wo, [0.3, 0.6, 0.2], Transport::Radiance);
            let (to, weight, density) =
                sample.map_or((Vec3::ZERO, Rgb::BLACK, 0.0), |s| (s.wi, s.weight, s.pdf));
            let before = [wo.x, wo.y, wo.z, wi.x, wi.y, wi.z, f.r, f.g, f.b, pdf];
            let sampled = [to.x, to.y, to.z, weight.r, weight.g, weight.b, density];
            let numbers = before.iter().chain(&sampled).map(|x| format!("{x:?}"));
            let numbers: Vec<_> = numbers.collect();
            println!("{}\t{}", name, numbers.join("\t"));
        }
    }
}
