//! How a render's noise falls with its samples, and at how many it will reach the aim.

/// Ratio of the samples of two points that are stored.
const APART: f64 = 1.15;
/// The rate is that of the points with at least this share of the samples now.
const WINDOW: f64 = 0.25;
/// Their samples span this ratio at least; before, no rate is known.
const LEAST_SPAN: f64 = 2.0;
/// What independent samples of finite variance have: noise falls by the root of their number. Sequences that are
/// better than that are not extrapolated.
const LARGEST_RATE: f64 = 0.5;
/// A rate below which noise does not fall.
const LEAST_RATE: f64 = 0.02;

/// A render's noise by its samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NoiseTrend {
    /// Samples on average, and noise.
    points: Vec<(f64, f64)>,
}

/// A forecast of noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseOutlook {
    /// Noise now.
    pub noise: f32,
    /// Samples a pixel now, on average.
    pub samples: f64,
    /// `r` of noise in proportion to `samples^-r`, in `[0, 1/2]`: 1/2 where all goes well, less where lights are rarely
    /// hit.
    pub rate: f64,
    /// Samples a pixel at which the aim will be reached at that rate; infinite where noise does not fall.
    pub needed: f64,
}

impl NoiseTrend {
    /// Stores the noise at a number of samples.
    ///
    /// * `samples`: of a pixel on average.
    /// * `noise`: as of [`FilmBuffer::noise`](crate::FilmBuffer::noise).
    pub fn record(&mut self, samples: f64, noise: f32) {
        let last = self.points.last().map_or(0.0, |p| p.0);
        if noise.is_finite() && noise > 0.0 && samples > 0.0 && samples >= APART * last {
            self.points.push((samples, f64::from(noise)));
        }
    }

    /// When the noise will be `aim`; `None` before samples have doubled since the first state.
    pub fn outlook(&self, aim: f32) -> Option<NoiseOutlook> {
        let &(samples, noise) = self.points.last()?;
        let recent = || self.points.iter().filter(|p| p.0 >= WINDOW * samples);
        let span = samples / recent().next()?.0;
        if span < LEAST_SPAN {
            return None;
        }
        // The slope of least squares between the logarithms.
        let count = recent().count() as f64;
        let (mut x, mut y) = (0.0, 0.0);
        for p in recent() {
            x += p.0.ln() / count;
            y += p.1.ln() / count;
        }
        let (mut xx, mut xy) = (0.0, 0.0);
        for p in recent() {
            xx += (p.0.ln() - x).powi(2);
            xy += (p.0.ln() - x) * (p.1.ln() - y);
        }
        let rate = (-xy / xx).clamp(0.0, LARGEST_RATE);
        let ratio = noise / f64::from(aim);
        let needed = if ratio <= 1.0 {
            samples
        } else if rate < LEAST_RATE {
            f64::INFINITY
        } else {
            samples * ratio.powf(1.0 / rate)
        };
        Some(NoiseOutlook {
            noise: crate::convert::narrow(noise),
            samples,
            rate,
            needed,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::narrow;

    /// A trend whose noise is `noise` of the samples.
    fn trend(most: f64, noise: impl Fn(f64) -> f64) -> NoiseTrend {
        let mut trend = NoiseTrend::default();
        let mut samples = 16.0;
        while samples <= most {
            trend.record(samples, narrow(noise(samples)));
            samples *= 1.05;
        }
        trend
    }

    #[test]
    fn what_falls_by_the_root_is_foreseen() {
        let outlook = trend(200.0, |n| 0.8 / n.sqrt()).outlook(0.02).unwrap();
        assert!((outlook.rate - 0.5).abs() < 1e-6, "{outlook:?}");
        assert!((outlook.needed / 1600.0 - 1.0).abs() < 1e-3, "{outlook:?}");
        // No faster than that, whatever came before.
        let outlook = trend(200.0, |n| 10.0 / n).outlook(0.02).unwrap();
        assert_eq!(outlook.rate, 0.5);
        let ratio = f64::from(outlook.noise / 0.02).powi(2);
        assert!((outlook.needed / outlook.samples / ratio - 1.0).abs() < 1e-3);
        // What is reached is.
        let outlook = trend(200.0, |n| 0.8 / n.sqrt()).outlook(0.5).unwrap();
        assert_eq!(outlook.needed, outlook.samples);
    }

    #[test]
    fn what_stands_still_never_ends() {
        let outlook = trend(1000.0, |n| 0.08 + 1e-7 * n).outlook(0.05).unwrap();
        assert_eq!((outlook.rate, outlook.needed), (0.0, f64::INFINITY));
        let slow = trend(1000.0, |n| 0.3 * n.powf(-0.2)).outlook(0.02).unwrap();
        assert!((slow.rate - 0.2).abs() < 1e-6);
        let needed = 15_f64.powi(5);
        assert!((slow.needed / needed - 1.0).abs() < 0.01, "{slow:?}");
    }

    #[test]
    fn little_tells_nothing() {
        assert_eq!(NoiseTrend::default().outlook(0.1), None);
        assert_eq!(trend(30.0, |n| 1.0 / n).outlook(0.1), None);
        let mut unknown = NoiseTrend::default();
        for (samples, noise) in [(1.0, f32::INFINITY), (8.0, 0.0), (0.0, 0.3)] {
            unknown.record(samples, noise);
        }
        assert_eq!(unknown, NoiseTrend::default());
    }
}
