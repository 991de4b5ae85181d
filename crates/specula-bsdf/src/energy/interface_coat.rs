//! A coat's interface with the layer under it, of fixed roughness, index and thickness: what depends on these alone is
//! computed once, and what depends on the direction once for both.
//!
//! The values are those of `interface.rs`, `interface_single.rs` and `interface_layer.rs`, bit for bit, whether they are
//! looked up for one direction or for a batch in rows ([`InRows`]).

use super::interface::{self, Knot, cosine_knot, effective_cosine, mean_alpha};
use super::interface_layer::{self, Layer};
use super::interface_single;
use super::interface_single_table::{ABSORPTION_MUS, MUS};
use crate::fresnel::{Refraction, dielectric};
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

    /// Without the tables: that of a smooth interface.
    #[inline(always)]
    pub(crate) fn smooth(&self) -> SmoothInterface<T> {
        SmoothInterface {
            eta: self.eta,
            layer: self.layer,
            is_single: self.is_single,
        }
    }

    /// The tables where the interface is; `None` where it is smooth.
    #[inline]
    pub(crate) fn rows(&self) -> Option<CosineRows<T>> {
        let rough = self.rough?;
        let mut rows = CosineRows {
            entering: [T::ZERO; MUS],
            crossing: [T::ZERO; ABSORPTION_MUS],
        };
        for (k, value) in rows.entering.iter_mut().enumerate() {
            *value = match self.is_single {
                true => interface_single::quotient_at(rough.entering, k),
                false => interface::quotient_at(rough.entering, k),
            };
        }
        for (k, value) in rows.crossing.iter_mut().enumerate() {
            *value = self.layer.share_at(rough.crossing, k);
        }
        Some(rows)
    }

    /// The same interface, looked up in its rows.
    #[inline(always)]
    pub(crate) fn in_rows(&self, rows: CosineRows<T>) -> InRows<T> {
        InRows {
            smooth: self.smooth(),
            alpha: self.rough.map_or(T::ZERO, |rough| rough.alpha),
            rows,
        }
    }
}

/// A coat's interface as light from outside meets it.
pub(crate) trait Entrance<T>: Copy {
    /// What becomes of light from outside at the cosine `mu`.
    fn incident(&self, mu: T) -> Incident<T>;
}

/// A smooth interface, without branches.
#[derive(Clone, Copy)]
pub(crate) struct SmoothInterface<T> {
    eta: T,
    layer: Layer<T>,
    is_single: bool,
}

/// The tables of a rough interface by the knots of the cosine.
#[derive(Clone, Copy)]
pub(crate) struct CosineRows<T> {
    /// Of what enters, over that of the raised cosine.
    entering: [T; MUS],
    /// Of the layer's [`share`](Layer::share).
    crossing: [T; ABSORPTION_MUS],
}

/// A rough interface that is looked up in its rows, without branches: what makes vectors of loops.
#[derive(Clone, Copy)]
pub(crate) struct InRows<T> {
    smooth: SmoothInterface<T>,
    alpha: T,
    rows: CosineRows<T>,
}

impl<T: Real> SmoothInterface<T> {
    /// * `entering`: share that enters.
    /// * `crossing`: share of it that is left behind the layer.
    #[inline(always)]
    fn incident_of(&self, smooth: Refraction<T>, entering: T, crossing: T) -> Incident<T> {
        let reflected = T::select(self.is_single, smooth.reflectance, T::ONE - entering);
        Incident {
            reflected,
            arriving: entering * crossing,
        }
    }
}

impl<T: Real> Entrance<T> for SmoothInterface<T> {
    #[inline(always)]
    fn incident(&self, mu: T) -> Incident<T> {
        let smooth = dielectric(mu, self.eta);
        self.incident_of(smooth, smooth.transmittance, self.layer.left(smooth.cos_t))
    }
}

impl<T: Real> Entrance<T> for InRows<T> {
    #[inline(always)]
    fn incident(&self, mu: T) -> Incident<T> {
        let smooth = dielectric(effective_cosine(mu, self.alpha), self.smooth.eta);
        let quotient = cosine_knot(mu, MUS).lerp_in(&self.rows.entering);
        let entering = (smooth.transmittance * quotient).within(T::ZERO, T::ONE);
        let share = cosine_knot(mu, ABSORPTION_MUS).lerp_in(&self.rows.crossing);
        let crossing = self.smooth.layer.left(smooth.cos_t * share);
        self.smooth.incident_of(smooth, entering, crossing)
    }
}

/// One direction after the other: what need not be computed is not.
impl<T: Real> Entrance<T> for &CoatInterface<T> {
    #[inline(always)]
    fn incident(&self, mu: T) -> Incident<T> {
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
        self.smooth().incident_of(smooth, entering, crossing)
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
                    let got = (&interface).incident(mu);
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
                    let in_batches = match interface.rows() {
                        Some(rows) => interface.in_rows(rows).incident(mu),
                        None => interface.smooth().incident(mu),
                    };
                    assert_eq!(in_batches.arriving.to_bits(), arriving.to_bits());
                    assert_eq!(in_batches.reflected.to_bits(), reflected.to_bits());
                }
            }
        }
    }
}
