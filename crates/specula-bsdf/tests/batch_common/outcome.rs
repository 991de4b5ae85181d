//! What the batch functions compute of lobes, and what scalar code does.

use specula_bsdf::batch::{Colours, Directions, Level, Lobes, SampleOutcome, Samples};
use specula_bsdf::{Bsdf, BsdfSample, Event, Real, Rgb, Transport, Vec3};

use super::Elements;

/// Everything that the batch functions compute of a lobe.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outcome<T> {
    pub(crate) f_cos: Colours<Vec<T>>,
    pub(crate) pdf: Vec<T>,
    pub(crate) both: (Colours<Vec<T>>, Vec<T>),
    pub(crate) samples: Samples<Vec<T>, Vec<SampleOutcome>>,
    pub(crate) wi: Directions<Vec<T>>,
}

impl Outcome<f32> {
    /// That of one element.
    pub(crate) fn at(&self, i: usize) -> Self {
        let one = |v: &[f32]| vec![v[i]];
        let colours = |c: &Colours<Vec<f32>>| Colours {
            r: one(&c.r),
            g: one(&c.g),
            b: one(&c.b),
        };
        let directions = |d: &Directions<Vec<f32>>| Directions {
            x: one(&d.x),
            y: one(&d.y),
            z: one(&d.z),
        };
        Self {
            f_cos: colours(&self.f_cos),
            pdf: one(&self.pdf),
            both: (colours(&self.both.0), one(&self.both.1)),
            samples: Samples {
                wi: directions(&self.samples.wi),
                weight: colours(&self.samples.weight),
                pdf: one(&self.samples.pdf),
                outcome: vec![self.samples.outcome[i]],
            },
            wi: directions(&self.wi),
        }
    }

    /// Whether all of it is finite, and values, densities and weights are not negative.
    pub(crate) fn is_sane(&self) -> bool {
        let colours = [&self.f_cos, &self.both.0, &self.samples.weight];
        let colours = colours.into_iter().flat_map(|c| [&c.r, &c.g, &c.b]);
        let densities = [&self.pdf, &self.both.1, &self.samples.pdf];
        let positive = colours.chain(densities).flatten();
        let directions = [&self.wi, &self.samples.wi];
        let mut directions = directions.into_iter().flat_map(|w| [&w.x, &w.y, &w.z]);
        positive.copied().all(|x| x.is_finite() && x >= 0.0)
            && directions.all(|w| w.iter().all(|x| x.is_finite()))
    }
}

pub(crate) fn batch<T: Real, L: Lobes<T>>(level: Level, lobes: &L, e: &Elements<T>) -> Outcome<T> {
    let n = e.wo.x.len();
    let (wo, wi) = (e.wo.as_slices(), e.wi.as_slices());
    let transport = Transport::Radiance;
    let mut out = Outcome {
        f_cos: Colours::zeroed(n),
        pdf: vec![T::ZERO; n],
        both: (Colours::zeroed(n), vec![T::ZERO; n]),
        samples: Samples::rejected(n),
        wi: Directions::zeroed(n),
    };
    level
        .eval(lobes, wo, wi, transport, out.f_cos.as_mut_slices())
        .expect("equal lengths");
    level
        .pdf(lobes, wo, wi, &mut out.pdf)
        .expect("equal lengths");
    let (f_cos, pdf) = &mut out.both;
    level
        .eval_pdf(lobes, wo, wi, transport, f_cos.as_mut_slices(), pdf)
        .expect("equal lengths");
    level
        .sample(lobes, wo, e.u(), transport, out.samples.as_mut_slices())
        .expect("equal lengths");
    level
        .sample_wi(lobes, wo, e.u(), transport, out.wi.as_mut_slices())
        .expect("equal lengths");
    out
}

fn outcome<T: Real>(sample: &BsdfSample<T>) -> SampleOutcome {
    match (sample.event, sample.specular) {
        (Event::Reflection, false) => SampleOutcome::Reflection,
        (Event::Transmission, false) => SampleOutcome::Transmission,
        (Event::Reflection, true) => SampleOutcome::SpecularReflection,
        (Event::Transmission, true) => SampleOutcome::SpecularTransmission,
    }
}

pub(crate) fn scalar<T: Real, L: Bsdf<T>>(lobe: &L, e: &Elements<T>) -> Outcome<T> {
    let n = e.wo.x.len();
    let mut out = Outcome {
        f_cos: Colours::default(),
        pdf: Vec::new(),
        both: (Colours::default(), Vec::new()),
        samples: Samples::default(),
        wi: Directions::default(),
    };
    let push = |to: &mut Colours<Vec<T>>, c: Rgb<T>| {
        to.r.push(c.r);
        to.g.push(c.g);
        to.b.push(c.b);
    };
    let (wo, wi) = (e.wo.as_slices(), e.wi.as_slices());
    for i in 0..n {
        let (wo, wi) = (
            wo.get(i).expect("an element"),
            wi.get(i).expect("an element"),
        );
        push(&mut out.f_cos, lobe.eval(wo, wi, Transport::Radiance));
        out.pdf.push(lobe.pdf(wo, wi));
        let (f_cos, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);
        push(&mut out.both.0, f_cos);
        out.both.1.push(pdf);
        let sample = lobe.sample(wo, e.u.each_ref().map(|u| u[i]), Transport::Radiance);
        let wi = sample.map_or(Vec3::ZERO, |s| s.wi);
        for all in [&mut out.samples.wi, &mut out.wi] {
            all.x.push(wi.x);
            all.y.push(wi.y);
            all.z.push(wi.z);
        }
        push(
            &mut out.samples.weight,
            sample.map_or(Rgb::BLACK, |s| s.weight),
        );
        out.samples.pdf.push(sample.map_or(T::ZERO, |s| s.pdf));
        let outcome = sample.as_ref().map_or(SampleOutcome::Rejected, outcome);
        out.samples.outcome.push(outcome);
    }
    out
}

/// The levels that this machine has; says which it lacks.
pub(crate) fn levels() -> Vec<Level> {
    let (here, lacking): (Vec<_>, Vec<_>) = Level::ALL.into_iter().partition(|l| l.is_available());
    for level in lacking {
        specula_testing::not_of_this_machine("batches", format_args!("no {level}"));
    }
    here
}
