//! The dielectric on top: transmission, and reflection from either side.

use crate::bsdf::{Bsdf, BsdfSample, Event, RoughDielectric, SmoothDielectric, Transport};
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb, Stream, Vec3, vec3};
use crate::ndf::{Ggx, Masking, Ndf};

/// An interface; `None`: smooth. Directions under it point down when they enter and up when they
/// leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coat<T> {
    pub(super) ndf: Option<Ggx<T>>,
    /// Index under it over the index above.
    pub(super) eta: T,
}

/// A direction that was sampled.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoatSample<T> {
    /// Of travel.
    pub(super) w: Vec3<T>,
    /// `f |cos| / pdf`.
    pub(super) weight: T,
    /// In 1/sr; of no meaning where smooth.
    pub(super) pdf: T,
}

/// The direction and weight with which a walk continues after a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Onward<T> {
    pub(super) w: Vec3<T>,
    pub(super) weight: Rgb<T>,
}

impl<T: Real> Coat<T> {
    pub(super) fn is_rough(&self) -> bool {
        self.ndf.is_some()
    }

    /// `f |cos|` of light that is reflected from above, in 1/sr, without Dirac deltas.
    #[inline]
    pub(super) fn reflection(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let Some(ggx) = self.ndf else { return T::ZERO };
        let half = wo + wi;
        let squared = half.length_squared();
        let quarter = T::of(0.25) * ggx.d_along(half, squared);
        let fresnel = dielectric(T::HALF * squared.sqrt(), self.eta).reflectance;
        fresnel * quarter * ggx.g2_over_cos(Masking::HeightCorrelated, wo, wi)
    }

    /// The mirror image of `wo` as it is bent by a smooth surface. A view from behind (a backfacing
    /// shading normal) enters as its mirror image does.
    #[inline(always)]
    pub(super) fn below(&self, wo: Vec3<T>) -> Vec3<T> {
        let inverse = T::ONE / self.eta;
        let (x, y) = (-wo.x * inverse, -wo.y * inverse);
        vec3(x, y, (T::ONE - x * x - y * y).safe_sqrt())
    }

    /// A way in for light that comes along `wo` (or that leaves along it, by the other transport).
    #[inline]
    pub(super) fn enter(
        &self,
        wo: Vec3<T>,
        transport: Transport,
        stream: &mut Stream,
    ) -> Option<CoatSample<T>> {
        let Some(ggx) = self.ndf else {
            let b = self.below(wo);
            let passed = dielectric(wo.z.abs(), self.eta).transmittance;
            return Some(CoatSample {
                w: vec3(b.x, b.y, -b.z),
                weight: match transport {
                    Transport::Radiance => passed / (self.eta * self.eta),
                    Transport::Importance => passed,
                },
                pdf: T::ONE,
            });
        };
        let u = [stream.next(), stream.next()];
        let sample =
            RoughDielectric::facing(ggx, self.eta).sample_branch(wo, u, false, transport)?;
        Some(CoatSample {
            w: sample.wi,
            weight: sample.weight.r,
            pdf: sample.pdf,
        })
    }

    /// Light that travels up along `w`, reflected down.
    #[inline]
    pub(super) fn bounce(&self, w: Vec3<T>, stream: &mut Stream) -> Option<Onward<T>> {
        let Some(ggx) = self.ndf else {
            let reflectance = dielectric(w.z, T::ONE / self.eta).reflectance;
            return Some(Onward {
                w: vec3(w.x, w.y, -w.z),
                weight: Rgb::splat(reflectance),
            });
        };
        let u = [stream.next(), stream.next()];
        let lobe = RoughDielectric::new(ggx, self.eta);
        let sample = lobe.sample_branch(-w, u, true, Transport::Importance)?;
        Some(Onward {
            w: sample.wi,
            weight: sample.weight,
        })
    }

    /// `f(wo, -w)` of light along `wo` that enters, or of light that travels up along `w` and leaves, by
    /// the other transport; and the density with which [`enter`](Self::enter) samples `-w`. Zeros
    /// where smooth.
    #[inline]
    pub(super) fn passes(&self, wo: Vec3<T>, w: Vec3<T>, transport: Transport) -> (T, T) {
        let Some(ggx) = self.ndf else {
            return (T::ZERO, T::ZERO);
        };
        if w.z <= T::ZERO {
            return (T::ZERO, T::ZERO);
        }
        let lobe = RoughDielectric::facing(ggx, self.eta);
        let (f_cos, pdf) = lobe.eval_branch(wo, -w, transport);
        (f_cos / w.z, pdf)
    }

    /// What becomes of light from above: a reflection or a way in, sampled by what they carry.
    #[inline]
    pub(super) fn scatter_above(&self, wo: Vec3<T>, u: [T; 3]) -> Option<BsdfSample<T>> {
        if let Some(ggx) = self.ndf {
            return RoughDielectric::facing(ggx, self.eta).sample(wo, u, Transport::Importance);
        }
        let bent = dielectric(wo.z.abs(), self.eta);
        let b = self.below(wo);
        let (up, down) = (vec3(-wo.x, -wo.y, wo.z), vec3(b.x, b.y, -b.z));
        let white = Rgb::WHITE;
        let passes = |weight, p| BsdfSample::delta(down, weight, p, Event::Transmission, T::ONE);
        if wo.z <= T::ZERO {
            // A mirror that faces away is not seen.
            return Some(passes(Rgb::splat(bent.transmittance), T::ONE));
        }
        Some(if u[0] < bent.reflectance {
            BsdfSample::delta(up, white, bent.reflectance, Event::Reflection, T::ONE)
        } else {
            passes(white, bent.transmittance)
        })
    }

    /// What becomes of light that travels up along `w`.
    #[inline]
    pub(super) fn scatter_below(&self, w: Vec3<T>, stream: &mut Stream) -> Option<BsdfSample<T>> {
        let u = [stream.next(), stream.next(), stream.next()];
        if let Some(ggx) = self.ndf {
            return RoughDielectric::new(ggx, self.eta).sample(-w, u, Transport::Importance);
        }
        SmoothDielectric::new(self.eta).sample(-w, u, Transport::Importance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alpha::Alpha;

    /// What is sampled weighs its value over its density, on the way in and on the way back.
    #[test]
    fn weights_are_values_over_densities() {
        let mut stream = Stream::new(5);
        for (x, y) in [(0.3, 0.3), (0.05, 0.4), (0.9, 0.9)] {
            let ggx = Ggx::new(Alpha::clamped(x, y));
            let coat = Coat {
                ndf: Some(ggx),
                eta: 1.5,
            };
            let inside = RoughDielectric::new(ggx, 1.5);
            for wo in [vec3(0.0, 0.6, 0.8), vec3(-0.99, 0.0, 0.141_067_36)] {
                for transport in [Transport::Radiance, Transport::Importance] {
                    for _ in 0..300 {
                        let Some(sampled) = coat.enter(wo, transport, &mut stream) else {
                            continue;
                        };
                        let (f, pdf) = coat.passes(wo, -sampled.w, transport);
                        assert!((pdf / sampled.pdf - 1.0).abs() < 1e-6, "{pdf} {sampled:?}");
                        let weight = f * sampled.w.z.abs() / pdf;
                        assert!(
                            (weight / sampled.weight - 1.0).abs() < 1e-6,
                            "{f} {sampled:?}"
                        );
                    }
                }
                for _ in 0..300 {
                    let Some(next) = coat.bounce(wo, &mut stream) else {
                        continue;
                    };
                    let (f_cos, pdf) = inside.eval_branch(-wo, next.w, Transport::Importance);
                    assert!((f_cos / pdf / next.weight.r - 1.0).abs() < 1e-6, "{next:?}");
                }
            }
        }
    }
}
