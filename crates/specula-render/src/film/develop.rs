//! From a sample's radiance to picture values: exposure, bound, white balance.

use specula_bsdf::Rgb;
use specula_scene::scene::Film;

use crate::words::Words;

/// What a film does with radiance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Develop {
    exposure: f32,
    max_component: f32,
    /// `None` for the identity.
    balance: Option<[[f32; 3]; 3]>,
}

impl Develop {
    pub(crate) fn new(film: &Film) -> Self {
        Self {
            exposure: film.exposure,
            max_component: film.max_component.unwrap_or(f32::INFINITY),
            balance: (film.balance != Film::NO_BALANCE).then_some(film.balance),
        }
    }

    /// Picture values of a radiance of 1, before bound and balance.
    pub(crate) fn exposure(&self) -> f32 {
        self.exposure
    }

    /// Exposure, bound, and rows of the balance where there is one.
    pub(crate) fn flatten(&self, to: &mut Words) {
        to.constant("FILM_BOUNDED", u32::from(self.max_component.is_finite()));
        to.constant("FILM_BALANCED", u32::from(self.balance.is_some()));
        to.begin("FILM");
        to.floats([self.exposure, self.max_component.min(f32::MAX)]);
        to.floats(self.balance.iter().flatten().flatten().copied());
    }

    /// Picture values of a radiance.
    #[inline(always)]
    pub(crate) fn of(&self, radiance: Rgb<f32>) -> Rgb<f32> {
        let mut c = radiance * self.exposure;
        let largest = c.r.max(c.g).max(c.b);
        if largest > self.max_component {
            c = bounded(c, largest, self.max_component);
        }
        let Some(rows) = self.balance else {
            return c;
        };
        let row = |[x, y, z]: [f32; 3]| x * c.r + y * c.g + z * c.b;
        Rgb {
            r: row(rows[0]),
            g: row(rows[1]),
            b: row(rows[2]),
        }
    }
}

/// A colour whose largest component is to be another. Rare, so that it is not worth a division for each sample.
#[cold]
#[inline(never)]
fn bounded(c: Rgb<f32>, largest: f32, bound: f32) -> Rgb<f32> {
    c * (bound / largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_exposed_bounded_and_balanced_in_this_order() {
        let plain = Develop {
            exposure: 2.0,
            max_component: f32::INFINITY,
            balance: None,
        };
        let colour = Rgb {
            r: 1.0,
            g: 2.0,
            b: 4.0,
        };
        assert_eq!(plain.of(colour).to_array(), [2.0, 4.0, 8.0]);
        let bounded = Develop {
            max_component: 4.0,
            ..plain
        };
        assert_eq!(bounded.of(colour).to_array(), [1.0, 2.0, 4.0]);
        let balanced = Develop {
            balance: Some([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]),
            ..bounded
        };
        assert_eq!(balanced.of(colour).to_array(), [4.0, 1.0, 4.0]);
    }
}
