//! A coat's interface with the layer under it, of fixed roughness, index and thickness: what depends on these alone is
//! computed once, and what depends on the direction once for both.
//!
//! The values are those of `interface.rs`, `interface_single.rs` and `interface_layer.rs`, bit for bit.

use super::interface::{self, Knot, effective_cosine, mean_alpha};
use super::interface_layer::{self, Layer};
use super::interface_single;
use crate::fresnel::dielectric;
use crate::math::Real;
use crate::ndf::Ggx;

/// The interface and the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CoatInterface<T> {
    eta: T,
    layer: Layer<T>,
    /// Whether facets scatter once.
    is_single: bool,
    /// `None`: smooth.
    rough: Option<Rough<T>>,
}

/// Of a rough interface: its alpha, and its places in the tables of what enters and of what crosses the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rough<T> {
    alpha: T,
    entering: [Knot<T>; 2],
    crossing: [Knot<T>; 2],
}

/// Light from one direction.
#[derive(Clone, Copy)]
pub(crate) struct Incident<T> {
    /// Share that the coat reflects; an estimate where its facets scatter singly.
    pub(crate) reflected: T,
    /// Share that reaches the base.
    pub(crate) arriving: T,
}

impl<T: Real> CoatInterface<T> {
    /// * `coat`: `None` for a smooth interface.
    /// * `eta`: index inside over outside, in `[1, 3]`.
    #[inline]
    pub(crate) fn new(coat: Option<Ggx<T>>, eta: T, layer: Layer<T>, is_single: bool) -> Self {
        let rough = coat.map(|ggx| {
            let alpha = mean_alpha(ggx);
            Rough {
                alpha,
                entering: match is_single {
                    true => interface_single::places(eta, alpha),
                    false => interface::places(eta, alpha),
                },
                crossing: interface_layer::places(eta, alpha),
            }
        });
        Self {
            eta,
            layer,
            is_single,
            rough,
        }
    }

    /// Share of diffuse light from inside that is reflected and has crossed the layer twice.
    ///
    /// * `coat`: that of [`new`](Self::new).
    #[inline]
    pub(crate) fn internal_reflectance(&self, coat: Option<Ggx<T>>) -> T {
        let reflected = match self.is_single {
            true => interface_single::internal_reflectance(coat, self.eta),
            false => interface::internal_reflectance(coat, self.eta),
        };
        reflected * self.layer.there_and_back(coat, self.eta)
    }

    /// What becomes of light from outside at the cosine `mu`.
    #[inline(always)]
    pub(crate) fn incident(&self, mu: T) -> Incident<T> {
        let raised = self
            .rough
            .map_or(mu, |rough| effective_cosine(mu, rough.alpha));
        let smooth = dielectric(raised, self.eta);
        let entering = match &self.rough {
            None => smooth.transmittance,
            Some(rough) => {
                let quotient = match self.is_single {
                    true => interface_single::quotient(rough.entering, mu),
                    false => interface::quotient(rough.entering, mu),
                };
                (smooth.transmittance * quotient).within(T::ZERO, T::ONE)
            }
        };
        let crossing = match &self.rough {
            _ if self.layer.is_empty() => T::ONE,
            None => self.layer.left(smooth.cos_t),
            Some(rough) => {
                let share = self.layer.share(rough.crossing, mu);
                self.layer.left(smooth.cos_t * share)
            }
        };
        Incident {
            reflected: match self.is_single {
                true => smooth.reflectance,
                false => T::ONE - entering,
            },
            arriving: entering * crossing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Alpha;

    #[test]
    fn values_are_those_of_the_interface_and_of_the_layer() {
        for (alpha, eta, thickness) in [
            (None, 1.5_f32, 0.0),
            (None, 2.0, 0.3),
            (Some([0.1, 0.1]), 1.5, 0.0),
            (Some([0.5, 0.2]), 1.33, 0.01),
            (Some([1.0, 1.0]), 2.4, 2.0),
        ] {
            let coat = alpha.map(|[x, y]| Ggx::new(Alpha::clamped(x, y)));
            let layer = Layer::new(thickness);
            for is_single in [false, true] {
                let interface = CoatInterface::new(coat, eta, layer, is_single);
                for mu in [1e-3, 0.1, 0.37, 0.8, 1.0] {
                    let got = interface.incident(mu);
                    let entering = match is_single {
                        true => interface_single::transmittance(coat, eta, mu),
                        false => interface::transmittance(coat, eta, mu),
                    };
                    let arriving = entering * layer.crossing(coat, eta, mu);
                    assert_eq!(got.arriving.to_bits(), arriving.to_bits());
                    let reflected = match is_single {
                        true => interface_single::reflectance_estimate(coat, eta, mu),
                        false => 1.0 - entering,
                    };
                    assert_eq!(got.reflected.to_bits(), reflected.to_bits());
                }
            }
        }
    }
}
