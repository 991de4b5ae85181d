//! Coats over bases that differ from element to element are one lobe each.

mod batch_common;

use batch_common::Elements;
use specula_bsdf::batch::{
    Colours, LengthMismatch, Level, Lobes, PerElementBase, SampleOutcome, Samples,
};
use specula_bsdf::bsdf::{CoatLayer, CoatScattering, CoatedDiffuse, DiffuseCoat, Plastic};
use specula_bsdf::{Bsdf, Rgb, Transport};

/// Not a multiple of any vector's length.
const N: usize = 421;

/// Values, densities and samples.
#[derive(Debug, PartialEq)]
struct Outcome {
    f_cos: Colours<Vec<f32>>,
    pdf: Vec<f32>,
    pdf_alone: Vec<f32>,
    samples: Samples<Vec<f32>, Vec<SampleOutcome>>,
}

fn outcome(
    level: Level,
    lobes: &impl Lobes<f32>,
    e: &Elements<f32>,
) -> Result<Outcome, LengthMismatch> {
    let mut out = Outcome {
        f_cos: Colours::zeroed(N),
        pdf: vec![0.0; N],
        pdf_alone: vec![0.0; N],
        samples: Samples::rejected(N),
    };
    let (wo, wi, transport) = (e.wo.as_slices(), e.wi.as_slices(), Transport::Radiance);
    let f_cos = out.f_cos.as_mut_slices();
    level.eval_pdf(lobes, wo, wi, transport, f_cos, &mut out.pdf)?;
    level.pdf(lobes, wo, wi, &mut out.pdf_alone)?;
    let samples = out.samples.as_mut_slices();
    level.sample(lobes, wo, e.u(), transport, samples)?;
    Ok(out)
}

fn ramp(low: f32, step: f32) -> Vec<f32> {
    #[allow(clippy::cast_precision_loss, reason = "a small index")]
    (0..N).map(|i| low + step * i as f32).collect()
}

/// A batch of a coat over bases against the coat over each of them, alone.
///
/// * `base`: of a lobe.
fn compare<L: Bsdf<f32> + Copy>(lobe: L, over: impl Fn(Rgb<f32>) -> L, base: fn(&L) -> Rgb<f32>)
where
    for<'a> PerElementBase<'a, f32, L>: Lobes<f32>,
{
    let elements = Elements::<f32>::new(N, 18);
    let albedo = Colours {
        r: ramp(0.0, 0.002),
        g: ramp(1.0, -0.002),
        b: ramp(0.5, 0.001),
    };
    let lobes: Vec<L> = (0..N)
        .map(|i| over(albedo.as_slices().get(i).expect("an element")))
        .collect();
    let mut bases = Colours::<Vec<f32>>::default();
    for Rgb { r, g, b } in lobes.iter().map(base) {
        bases.r.push(r);
        bases.g.push(g);
        bases.b.push(b);
    }
    let coloured = PerElementBase {
        lobe,
        albedo: albedo.as_slices(),
        base: bases.as_slices(),
    };
    for level in Level::ALL.into_iter().filter(|l| l.is_available()) {
        let many = outcome(level, &coloured, &elements).expect("equal lengths");
        let (wo, wi) = (elements.wo.as_slices(), elements.wi.as_slices());
        for (i, lobe) in lobes.iter().enumerate() {
            let at = |d: &specula_bsdf::batch::Directions<&[f32]>| d.get(i).expect("an element");
            let (f_cos, pdf) = lobe.eval_pdf(at(&wo), at(&wi), Transport::Radiance);
            let found = many.f_cos.as_slices().get(i).expect("an element");
            assert_eq!(found, f_cos, "{level} {i}");
            assert_eq!([many.pdf[i], many.pdf_alone[i]], [pdf; 2], "{level} {i}");
            let u = elements.u.each_ref().map(|u| u[i]);
            let sample = lobe.sample(at(&wo), u, Transport::Radiance);
            let weight = many.samples.weight.as_slices().get(i).expect("an element");
            assert_eq!(
                weight,
                sample.map_or(Rgb::BLACK, |s| s.weight),
                "{level} {i}"
            );
            let found = many.samples.pdf[i];
            assert_eq!(found, sample.map_or(0.0, |s| s.pdf), "{level} {i}");
            let is_rejected = many.samples.outcome[i] == SampleOutcome::Rejected;
            assert_eq!(is_rejected, sample.is_none(), "{level} {i}");
        }
    }
    let short = PerElementBase {
        base: Colours {
            g: &bases.g[1..],
            ..bases.as_slices()
        },
        ..coloured
    };
    let error = outcome(Level::best(), &short, &elements).expect_err("a slice is short");
    assert_eq!((error.name, error.found), ("base.g", N - 1));
}

#[test]
fn coats_over_bases_are_one_lobe_each() {
    for coat in [None, Some(batch_common::ggx([0.2, 0.2]))] {
        let layer = CoatLayer {
            thickness: 0.1,
            max_depth: Some(6),
            scattering: CoatScattering::Single,
        };
        let coat = DiffuseCoat::<f32>::new(coat, 1.5, layer);
        compare(
            coat.over(Rgb::WHITE),
            |colour| coat.over(colour),
            CoatedDiffuse::base,
        );
    }
}

#[test]
fn plastics_over_bases_are_one_lobe_each() {
    for plastic in [
        batch_common::plastic::<f32>([0.1, 0.3]),
        batch_common::smooth_plastic(),
    ] {
        compare(plastic, |colour| plastic.over(colour), Plastic::base);
    }
}
