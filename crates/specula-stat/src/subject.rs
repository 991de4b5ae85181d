//! A BSDF under test: three closures, or an implementor of the trait [`Bsdf`].

use specula_bsdf::{Bsdf, Real, Rgb, Transport, Vec3};

/// One sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionSample {
    /// Towards the light, unit, local frame.
    pub wi: Vec3<f64>,
    /// `f |cos theta_i| / pdf`.
    pub weight: Rgb<f64>,
    /// The density that the sampler itself reports, where it does.
    pub pdf: Option<f64>,
    /// Whether it was sampled from a Dirac delta, which `eval` and `pdf` do not include.
    pub is_specular: bool,
}

impl DirectionSample {
    /// A direction that is not specular, from a sampler that reports no pdf.
    #[must_use]
    pub fn new(wi: Vec3<f64>, weight: Rgb<f64>) -> Self {
        Self {
            wi,
            weight,
            pdf: None,
            is_specular: false,
        }
    }
}

type Eval<'a> = Box<dyn Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> + Sync + 'a>;
type Pdf<'a> = Box<dyn Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync + 'a>;
type EvalPdf<'a> = Box<dyn Fn(Vec3<f64>, Vec3<f64>) -> (Rgb<f64>, f64) + Sync + 'a>;
type Sample<'a> = Box<dyn Fn(Vec3<f64>, [f64; 3]) -> Option<DirectionSample> + Sync + 'a>;

/// A BSDF under test. Its interface is in double precision.
pub struct Subject<'a> {
    eval: Eval<'a>,
    pdf: Pdf<'a>,
    /// Both together, where a BSDF has a function for that.
    eval_pdf: Option<EvalPdf<'a>>,
    sample: Sample<'a>,
}

impl<'a> Subject<'a> {
    /// A BSDF from three closures.
    ///
    /// * `eval(wo, wi)`: `f |cos theta_i|`, 1/sr.
    /// * `pdf(wo, wi)`: density of `sample`, 1/sr; it integrates to the share of samples that are
    ///   accepted.
    /// * `sample(wo, u)`: a direction from three uniform random numbers in `[0, 1)`, or `None`.
    pub fn new(
        eval: impl Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> + Sync + 'a,
        pdf: impl Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync + 'a,
        sample: impl Fn(Vec3<f64>, [f64; 3]) -> Option<DirectionSample> + Sync + 'a,
    ) -> Self {
        Self {
            eval: Box::new(eval),
            pdf: Box::new(pdf),
            eval_pdf: None,
            sample: Box::new(sample),
        }
    }

    /// A BSDF from an implementor of [`Bsdf`], in either precision.
    pub fn from_bsdf<T: Real, B: Bsdf<T> + Sync>(bsdf: &'a B, transport: Transport) -> Self {
        let separate = Self::new(
            move |wo, wi| bsdf.eval(wo.cast(), wi.cast(), transport).cast(),
            move |wo, wi| bsdf.pdf(wo.cast(), wi.cast()).to_f64(),
            move |wo, u| {
                let sample = bsdf.sample(wo.cast(), u.map(T::of), transport)?;
                Some(DirectionSample {
                    wi: sample.wi.cast(),
                    weight: sample.weight.cast(),
                    pdf: Some(sample.pdf.to_f64()),
                    is_specular: sample.specular,
                })
            },
        );
        let eval_pdf = move |wo: Vec3<f64>, wi: Vec3<f64>| {
            let (value, pdf) = bsdf.eval_pdf(wo.cast(), wi.cast(), transport);
            (value.cast(), pdf.to_f64())
        };
        Self {
            eval_pdf: Some(Box::new(eval_pdf)),
            ..separate
        }
    }

    /// `f |cos theta_i|`, 1/sr.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> Rgb<f64> {
        (self.eval)(wo, wi)
    }

    /// Density of `sample`, 1/sr.
    #[must_use]
    pub fn pdf(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        (self.pdf)(wo, wi)
    }

    /// [`eval`](Self::eval) and [`pdf`](Self::pdf) together.
    #[must_use]
    pub fn eval_pdf(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> (Rgb<f64>, f64) {
        match &self.eval_pdf {
            Some(eval_pdf) => eval_pdf(wo, wi),
            None => (self.eval(wo, wi), self.pdf(wo, wi)),
        }
    }

    /// Samples a direction.
    #[must_use]
    pub fn sample(&self, wo: Vec3<f64>, u: [f64; 3]) -> Option<DirectionSample> {
        (self.sample)(wo, u)
    }

    /// Samples a direction; `None` also where it is specular, as `pdf` does not include those.
    #[must_use]
    pub fn sample_density(&self, wo: Vec3<f64>, u: [f64; 3]) -> Option<DirectionSample> {
        self.sample(wo, u).filter(|sampled| !sampled.is_specular)
    }
}
