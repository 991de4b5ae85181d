//! Batches of a lobe whose kind is known when the program runs.

use alloc::vec;
use alloc::vec::Vec;

use super::level::Level;
use super::slices::{Colours, Directions, LengthMismatch, SampleOutcome, Samples, check};
use crate::bsdf::{Bsdf, Lobe, Transport};
use crate::math::{Real, Stream};

/// Batches of a [`Lobe`]: in vectors where its kind has them, else one by one; lobes that are themselves estimates get
/// random numbers for each element, by a seed and the element's index.
///
/// ```
/// use specula_bsdf::batch::{Directions, LobeBatches};
/// use specula_bsdf::bsdf::{Lambert, Lobe};
/// use specula_bsdf::math::{Rgb, vec3};
/// use specula_bsdf::Transport;
///
/// let lobe = Lobe::from(Lambert::new(Rgb::splat(0.5_f32)));
/// let batches = LobeBatches::new(&lobe, Transport::Radiance, 0);
/// let up: Directions<Vec<f32>> = (0..100).map(|_| vec3(0.0, 0.0, 1.0)).collect();
/// let mut pdf = vec![0.0; 100];
/// batches.pdf(up.as_slices(), up.as_slices(), &mut pdf)?;
/// assert_eq!(pdf[99], std::f32::consts::FRAC_1_PI);
/// # Ok::<(), specula_bsdf::batch::LengthMismatch>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct LobeBatches<'a, T> {
    lobe: &'a Lobe<T>,
    transport: Transport,
    seed: u64,
}

/// Runs `$call` with a lobe whose batches are vectors, or `$other`.
macro_rules! batched {
    ($lobe:expr, $l:ident => $call:expr, _ => $other:expr) => {
        match $lobe {
            Lobe::Lambert($l) => $call,
            Lobe::Eon($l) => $call,
            Lobe::DiffuseTransmission($l) => $call,
            Lobe::SmoothConductor($l) => $call,
            Lobe::RoughConductor($l) => $call,
            Lobe::SmoothDielectric($l) => $call,
            Lobe::RoughDielectric($l) => $call,
            Lobe::ThinDielectric($l) => $call,
            Lobe::RoughConductorBeckmann($l) => $call,
            Lobe::RoughDielectricBeckmann($l) => $call,
            Lobe::Principled($l) => $call,
            Lobe::Gltf($l) => $call,
            _ => $other,
        }
    };
}

const WO: [&str; 3] = ["wo.x", "wo.y", "wo.z"];
const WI: [&str; 3] = ["wi.x", "wi.y", "wi.z"];
const F_COS: [&str; 3] = ["f_cos.r", "f_cos.g", "f_cos.b"];

impl<'a, T: Real> LobeBatches<'a, T> {
    /// * `transport`: what the path carries.
    /// * `seed`: of lobes that are themselves estimates.
    #[must_use]
    pub fn new(lobe: &'a Lobe<T>, transport: Transport, seed: u64) -> Self {
        Self {
            lobe,
            transport,
            seed,
        }
    }

    /// `f |cos theta_i|` in 1/sr, without Dirac deltas.
    ///
    /// * `first`: index of the first element, from which random numbers come: batches may be cut.
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn eval(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        mut f_cos: Colours<&mut [T]>,
    ) -> Result<(), LengthMismatch> {
        if self.lobe.is_stochastic() {
            let mut densities = vec![T::ZERO; f_cos.r.len()];
            return self.random(first, wo, wi, f_cos, &mut densities);
        }
        batched!(self.lobe, l => Level::best().eval(l, wo, wi, self.transport, f_cos), _ => {
            check_lengths(wo, wi, &f_cos)?;
            for i in 0..f_cos.r.len() {
                f_cos.set_from(i, self.lobe.eval(wo.at(i), wi.at(i), self.transport));
            }
            Ok(())
        })
    }

    /// The density in 1/sr with which [`sample`](Self::sample) samples `wi`, without Dirac deltas.
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn pdf(
        &self,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        batched!(self.lobe, l => Level::best().pdf(l, wo, wi, pdf), _ => {
            let lengths = wo.lengths(WO).into_iter().chain(wi.lengths(WI));
            check(pdf.len(), lengths)?;
            for (i, pdf) in pdf.iter_mut().enumerate() {
                *pdf = self.lobe.pdf(wo.at(i), wi.at(i));
            }
            Ok(())
        })
    }

    /// [`eval`](Self::eval) and [`pdf`](Self::pdf) together.
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn eval_pdf(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        mut f_cos: Colours<&mut [T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        if self.lobe.is_stochastic() {
            return self.random(first, wo, wi, f_cos, pdf);
        }
        let transport = self.transport;
        batched!(self.lobe, l => Level::best().eval_pdf(l, wo, wi, transport, f_cos, pdf), _ => {
            check_lengths(wo, wi, &f_cos)?;
            check(f_cos.r.len(), [("pdf", pdf.len())])?;
            for (i, pdf) in pdf.iter_mut().enumerate() {
                let (f, density) = self.lobe.eval_pdf(wo.at(i), wi.at(i), transport);
                f_cos.set_from(i, f);
                *pdf = density;
            }
            Ok(())
        })
    }

    /// Samples directions to the light.
    ///
    /// * `first`: index of the first element, as for [`eval`](Self::eval).
    /// * `u`: uniform in `[0, 1)^3`.
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn sample(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        u: [&[T]; 3],
        mut samples: Samples<&mut [T], &mut [SampleOutcome]>,
    ) -> Result<(), LengthMismatch> {
        let n = samples.pdf.len();
        let (level, transport) = (Level::best(), self.transport);
        if let Lobe::MultibounceConductor(metal) = self.lobe {
            return level.sample_random(metal, wo, u, &mut self.streams(first, n), samples);
        }
        batched!(self.lobe, l => level.sample(l, wo, u, transport, samples), _ => {
            let [a, b, c] = u;
            let lengths = [("u[0]", a.len()), ("u[1]", b.len()), ("u[2]", c.len())];
            check(n, samples.lengths())?;
            check(n, wo.lengths(WO).into_iter().chain(lengths))?;
            for i in 0..n {
                let mut stream = self.stream(first + i);
                let u = u.map(|u| u[i]);
                let sample = self.lobe.sample_random(wo.at(i), u, transport, &mut stream);
                samples.set_from(i, sample);
            }
            Ok(())
        })
    }

    /// Estimates and densities of a lobe that is itself random.
    fn random(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        mut f_cos: Colours<&mut [T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        let n = f_cos.r.len();
        if let Lobe::MultibounceConductor(metal) = self.lobe {
            let mut streams = self.streams(first, n);
            return Level::best().eval_pdf_random(metal, wo, wi, &mut streams, f_cos, pdf);
        }
        check_lengths(wo, wi, &f_cos)?;
        check(n, [("pdf", pdf.len())])?;
        for (i, pdf) in pdf.iter_mut().enumerate() {
            let mut stream = self.stream(first + i);
            let (wo, wi) = (wo.at(i), wi.at(i));
            let (f, density) = self
                .lobe
                .eval_pdf_random(wo, wi, self.transport, &mut stream);
            f_cos.set_from(i, f);
            *pdf = density;
        }
        Ok(())
    }

    /// The random numbers of an element: the same wherever it is computed.
    fn stream(&self, index: usize) -> Stream {
        // Steps of a large odd number, so that streams of neighbours do not overlap.
        let step = (index as u64).wrapping_mul(0xd134_2543_de82_ef95);
        Stream::new(self.seed.rotate_left(32).wrapping_add(step))
    }

    fn streams(&self, first: usize, n: usize) -> Vec<Stream> {
        (0..n).map(|i| self.stream(first + i)).collect()
    }
}

fn check_lengths<T: Real>(
    wo: Directions<&[T]>,
    wi: Directions<&[T]>,
    f_cos: &Colours<&mut [T]>,
) -> Result<(), LengthMismatch> {
    let n = f_cos.r.len();
    check(n, f_cos.lengths(F_COS))?;
    check(n, wo.lengths(WO).into_iter().chain(wi.lengths(WI)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Alpha;
    use crate::bsdf::{Compensated, Lambert, MultibounceConductor, RoughConductor};
    use crate::energy::EnergyModel;
    use crate::fresnel::{Reflectance, Schlick};
    use crate::math::{Rgb, Vec3, rgb, vec3};
    use crate::multibounce::MultibounceModel;
    use crate::ndf::Ggx;

    const N: usize = 40;

    fn lobes() -> [Lobe<f64>; 4] {
        let ggx = Ggx::new(Alpha::isotropic(0.6));
        let f0 = rgb(0.9, 0.6, 0.3);
        let metal = Reflectance::Schlick(Schlick { f0 });
        [
            Lambert::new(Rgb::splat(0.5)).into(),
            RoughConductor::new(ggx, metal).into(),
            Compensated::new(ggx, metal, EnergyModel::KullaConty).into(),
            MultibounceConductor::new(ggx, metal, MultibounceModel::default()).into(),
        ]
    }

    fn directions(turn: f64) -> Directions<Vec<f64>> {
        let one = |i: usize| -> Vec3<f64> {
            let z = 0.1 + 0.8 * i as f64 / N as f64;
            let (sin, cos) = (turn + i as f64).sin_cos();
            let r = (1.0 - z * z).sqrt();
            vec3(r * cos, r * sin, z)
        };
        (0..N).map(one).collect()
    }

    /// Values, densities and samples of `parts` of the elements, one after the other.
    fn all(lobe: &Lobe<f64>, seed: u64, parts: &[usize]) -> (Vec<Rgb<f64>>, Vec<f64>, Vec<f64>) {
        let batches = LobeBatches::new(lobe, Transport::Radiance, seed);
        let (wo, wi) = (directions(0.0), directions(2.0));
        let u: Vec<f64> = (0..N).map(|i| (0.37 * i as f64).fract()).collect();
        let mut f_cos = Colours::zeroed(N);
        let (mut pdf, mut alone) = (vec![0.0; N], vec![0.0; N]);
        let mut samples = Samples::rejected(N);
        let mut first = 0;
        for part in parts {
            let end = first + part;
            let (wo, wi) = (
                wo.as_slices().range(first, end),
                wi.as_slices().range(first, end),
            );
            let mut to = f_cos.as_mut_slices();
            let to = to.range(first, end);
            let done = batches.eval_pdf(first, wo, wi, to, &mut pdf[first..end]);
            assert!(done.is_ok());
            assert!(batches.pdf(wo, wi, &mut alone[first..end]).is_ok());
            let u = &u[first..end];
            let mut to = samples.as_mut_slices();
            let to = to.range(first, end);
            assert!(batches.sample(first, wo, [u, u, u], to).is_ok());
            first = end;
        }
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12 * a;
        assert!(pdf.iter().zip(&alone).all(near));
        let f_cos = (0..N).map(|i| f_cos.as_slices().at(i)).collect();
        (f_cos, pdf, samples.wi.x)
    }

    #[test]
    fn batches_may_be_cut_and_are_the_lobe() {
        let (wo, wi) = (directions(0.0), directions(2.0));
        for lobe in lobes() {
            let whole = all(&lobe, 1, &[N]);
            assert_eq!(whole, all(&lobe, 1, &[7, 1, 32]));
            assert_eq!(whole != all(&lobe, 2, &[N]), lobe.is_stochastic());
            let (f_cos, pdf, _) = whole;
            for i in 0..N {
                let (wo, wi) = (wo.as_slices().at(i), wi.as_slices().at(i));
                assert!((pdf[i] - lobe.pdf(wo, wi)).abs() < 1e-12 * pdf[i]);
                let f = lobe.eval(wo, wi, Transport::Radiance);
                assert!(lobe.is_stochastic() || (f_cos[i].r - f.r).abs() < 1e-12 * f.r);
            }
        }
    }

    #[test]
    fn slices_of_other_lengths_are_errors() {
        let (wo, wi) = (directions(0.0), directions(2.0));
        for lobe in lobes() {
            let batches = LobeBatches::new(&lobe, Transport::Radiance, 0);
            let short = wo.as_slices().range(1, N);
            let mut pdf = vec![0.0; N];
            let error = batches.pdf(short, wi.as_slices(), &mut pdf).unwrap_err();
            assert_eq!((error.name, error.found), ("wo.x", N - 1));
            let mut f_cos = Colours::zeroed(N);
            let to = f_cos.as_mut_slices();
            assert!(batches.eval(0, short, wi.as_slices(), to).is_err());
            let mut samples = Samples::rejected(N);
            let to = samples.as_mut_slices();
            assert!(batches.sample(0, short, [&pdf, &pdf, &pdf], to).is_err());
        }
    }
}
