//! Proofs of lobes whose values are estimates: everything by means.

use std::f64::consts::PI;

use specula_bsdf::math::{Stream, vec3, warp};
use specula_bsdf::{Bsdf, Transport, Vec3};
use specula_stat::Check;
use specula_stat::normalisation::integrate_bands;
use specula_stat::quadrature::Quadrature;
use specula_stat::reciprocity::Domain;
use specula_stat::z_test::{Moments, sidak, two_sided_p};

use super::{Case, RADIANCE, SIGNIFICANCE};

impl Case<'_> {
    pub(super) fn means(&self) -> Vec<Check> {
        let mut checks = vec![self.samples_follow_values(), self.integral(), self.energy()];
        if self.reciprocity != Domain::Nowhere && self.wo.z > 0.0 {
            checks.push(self.reciprocity());
        }
        checks
    }

    fn moments(&self, salt: u64, f: impl Fn(&mut Stream) -> [f64; 3]) -> [Moments; 3] {
        let mut stream = Stream::new(self.seed ^ salt.rotate_left(56));
        let mut moments = [Moments::default(); 3];
        for _ in 0..self.samples {
            for (moments, value) in moments.iter_mut().zip(f(&mut stream)) {
                moments.push(value);
            }
        }
        moments
    }

    /// Mean weight of samples against the integral of values.
    ///
    /// Values are asked at samples of the walk and at cosines, weighed by the balance heuristic with the lobe's density
    /// for the samples: any positive function serves there.
    fn samples_follow_values(&self) -> Check {
        let sides = if self.transmits { 2.0 } else { 1.0 };
        let cosine = |wi: Vec3<f64>| wi.z.abs() / (sides * PI);
        let sampled = |s: &mut Stream| {
            let u = [s.next(), s.next(), s.next()];
            let sample = self.lobe().sample_random(self.wo, u, RADIANCE, s);
            sample.filter(|x| !x.specular)
        };
        let samples = self.moments(1, |s| sampled(s).map_or([0.0; 3], |x| x.weight.to_array()));
        let values = self.moments(2, |s| {
            if s.next::<f64>() < 0.5 {
                let mut wi: Vec3<f64> = warp::cosine_hemisphere([s.next(), s.next()]);
                if self.transmits && s.next::<f64>() < 0.5 {
                    wi.z = -wi.z;
                }
                let (f, pdf) = self.lobe().eval_pdf_random(self.wo, wi, RADIANCE, s);
                (f * (2.0 / (pdf + cosine(wi)).max(1e-30))).to_array()
            } else {
                let weighed = |x: specula_bsdf::BsdfSample<f64>| {
                    let share = x.pdf / (x.pdf + cosine(x.wi)).max(1e-30);
                    (x.weight * (2.0 * share)).to_array()
                };
                sampled(s).map_or([0.0; 3], weighed)
            }
        });
        equal("furnace: samples follow values", samples, values)
    }

    /// The density for multiple importance sampling integrates to 1.
    fn integral(&self) -> Check {
        let quadrature = Quadrature {
            relative_tolerance: 1e-5,
            max_patches: 4000,
            peaks: self.peaks(),
            ..Quadrature::default()
        };
        let edges = [1.0, self.eta, 1.0 / self.eta].map(|e| self.wo.z.abs() * e);
        let density = |wi| [self.lobe().pdf(self.wo, wi)];
        let integral = integrate_bands(&edges, &quadrature, density).value[0];
        // What smooth interfaces reflect at once is no part of the density.
        let [specular, ..] = self.moments(6, |s| {
            let u = [s.next(), s.next(), s.next()];
            let sample = self.lobe().sample_random(self.wo, u, RADIANCE, s);
            [f64::from(u8::from(sample.is_some_and(|x| x.specular))); 3]
        });
        let expected = 1.0 - specular.mean();
        let slack = 2e-3 + 5.0 * specular.variance_of_mean().sqrt();
        let is_density = super::word(self.named, "mis_pdf").is_none_or(|m| m != "hapke");
        Check {
            name: "integral of pdf".to_owned(),
            is_pass: (integral - expected).abs() < slack || !is_density,
            p_value: None,
            detail: if is_density {
                format!("{integral:.6}, expected {expected:.6}")
            } else {
                format!("{integral:.6}; as published it is a weight, not a density")
            },
        }
    }

    /// No channel of the mean weight is above 1.
    pub(super) fn energy(&self) -> Check {
        // Radiance is compressed below the surface: importance is what is preserved.
        let energy = self.moments(3, |s| {
            let u = [s.next(), s.next(), s.next()];
            let sample = self
                .lobe()
                .sample_random(self.wo, u, Transport::Importance, s);
            sample.map_or([0.0; 3], |x| x.weight.to_array())
        });
        let p = energy.map(|m| {
            let noise = m.variance_of_mean().sqrt() + 1e-9;
            two_sided_p((m.mean() - 1.0).max(0.0) / noise)
        });
        let p = p.into_iter().fold(1.0, f64::min);
        let [r, g, b] = energy.map(|m| m.mean());
        Check {
            name: "energy".to_owned(),
            is_pass: p >= sidak(SIGNIFICANCE, 3),
            p_value: Some(p),
            detail: format!("albedo {r:.4}, {g:.4}, {b:.4}; expected at most 1"),
        }
    }

    /// `f(a, b) = f(b, a)` for the view and a direction of its other side.
    fn reciprocity(&self) -> Check {
        let a = self.wo;
        let b = vec3(-0.28, 0.576, 0.768);
        let scaled = |salt, wo: Vec3<f64>, wi: Vec3<f64>| {
            self.moments(salt, |s| {
                let f_cos = self.lobe().eval_pdf_random(wo, wi, RADIANCE, s).0;
                (f_cos * (1.0 / wi.z.abs().max(1e-6))).to_array()
            })
        };
        equal("reciprocity", scaled(4, a, b), scaled(5, b, a))
    }
}

/// Comparison of two means, channel by channel.
fn equal(name: &str, a: [Moments; 3], b: [Moments; 3]) -> Check {
    let p = |(a, b): (&Moments, &Moments)| {
        let variance = a.variance_of_mean() + b.variance_of_mean() + 1e-24;
        two_sided_p((a.mean() - b.mean()) / variance.sqrt())
    };
    let p = a.iter().zip(&b).map(p).fold(1.0, f64::min);
    let (deviation, other) = (
        a[1].variance_of_mean().sqrt(),
        b[1].variance_of_mean().sqrt(),
    );
    Check {
        name: name.to_owned(),
        is_pass: p >= sidak(SIGNIFICANCE, 3),
        p_value: Some(p),
        detail: format!(
            "p = {p:.2e}; green: {:.5} +- {deviation:.1e} and {:.5} +- {other:.1e}",
            a[1].mean(),
            b[1].mean()
        ),
    }
}
