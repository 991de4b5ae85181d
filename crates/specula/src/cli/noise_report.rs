//! What is said of a render's noise: why it does not fall, and what it leaves out.

use std::time::Duration;

use crate::render::{FilmBuffer, NoiseEstimate, NoiseOutlook, NoiseTrend, RenderOptions};

use super::progress::short;

/// Nothing is said before so many samples a pixel.
const LEAST_SAMPLES: f64 = 64.0;
/// Nor before the render has taken so long.
const LEAST_TIME: Duration = Duration::from_secs(10);
/// Work that is foreseen beyond this multiple of what was done is never done.
const FAR: f64 = 100.0;
/// From this share on pixels that are left out are most of the error.
const MOST: f32 = 0.5;
/// From this share on they are told where nobody asked for a noise.
const NOTABLE: f32 = 0.1;

/// Watches the noise of a render that aims at one, and says once why it will not come to that.
pub(crate) struct NoiseWatch {
    /// Noise that is aimed at; 0: none.
    aim: f32,
    trend: NoiseTrend,
    told: bool,
    /// What is on offer, as the options do not have it yet.
    offers: &'static str,
}

impl NoiseWatch {
    /// For a render with these options.
    pub(crate) fn new(options: &RenderOptions) -> Self {
        Self {
            aim: options.noise.unwrap_or(0.0),
            trend: NoiseTrend::default(),
            told: false,
            offers: match (options.regularize, options.clamp.is_some()) {
                (false, false) => "--regularize or --clamp 10 takes most of it away",
                (true, false) => "--clamp 10 takes most of it away",
                (false, true) => "--regularize takes most of it away",
                (true, true) => "a smaller --clamp takes more of it away",
            },
        }
    }

    /// Whether there may yet be something to say.
    pub(crate) fn is_watching(&self) -> bool {
        self.aim > 0.0 && !self.told
    }

    /// What is to be said after a pass; `None`: nothing.
    ///
    /// * `samples`, `estimate`: of a pixel on average, and the noise by now.
    /// * `elapsed`, `limit`: time since the start, and what the render may take; `most`: work that it may do, in
    ///   samples of every pixel.
    pub(crate) fn after_pass(
        &mut self,
        (samples, estimate): (f64, &NoiseEstimate),
        (elapsed, limit): (Duration, Option<Duration>),
        most: u32,
    ) -> Option<String> {
        if !self.is_watching() {
            return None;
        }
        self.trend.record(samples, estimate.relative);
        if elapsed < LEAST_TIME {
            return None;
        }
        let outlook = self.trend.outlook(self.aim)?;
        if outlook.samples < LEAST_SAMPLES || outlook.noise <= self.aim {
            return None;
        }
        let said = message(
            self.aim,
            &outlook,
            estimate,
            (elapsed, limit),
            most,
            self.offers,
        );
        self.told = said.is_some();
        said
    }
}

/// Why a noise will not be reached, in words; `None`: it will, and most of the error is in it.
fn message(
    aim: f32,
    outlook: &NoiseOutlook,
    estimate: &NoiseEstimate,
    (elapsed, limit): (Duration, Option<Duration>),
    most: u32,
    offers: &str,
) -> Option<String> {
    let times = outlook.needed / outlook.samples;
    let seconds = elapsed.as_secs_f64() * times;
    let beyond = if !times.is_finite() {
        Some(" and does not fall".to_owned())
    } else if limit.is_some_and(|limit| seconds > limit.as_secs_f64()) {
        Some(format!(", which would take {}", short(seconds)))
    } else if outlook.needed > f64::from(most) {
        let needed = outlook.needed;
        Some(format!(", which would take {needed:.0} samples a pixel"))
    } else if times > FAR {
        Some(format!(", which would take {}", short(seconds)))
    } else {
        None
    };
    let outliers = estimate.share_left_out >= MOST;
    if beyond.is_none() && !outliers {
        return None;
    }
    let percent = |x: f32| format!("{:.1} %", 100.0 * x);
    let state = format!(
        "noise is {} after {:.0} samples a pixel, {} is asked for",
        percent(outlook.noise),
        outlook.samples,
        percent(aim)
    );
    let apart = match left_out(estimate) {
        Some(apart) if estimate.share_left_out >= NOTABLE => format!("; {apart}"),
        _ => String::new(),
    };
    let rare = if outliers {
        format!(
            ": light that paths rarely hit, as a rule after rough surfaces and then shiny ones \
             (caustics). {offers}, at the price of bias: pictures get darker, caustics blurred"
        )
    } else if outlook.rate < 0.4 {
        let rate = outlook.rate;
        format!(
            ". It falls by the power {rate:.2} of the samples in place of 1/2: paths rarely hit the light. \
             {offers}, at the price of bias"
        )
    } else {
        String::new()
    };
    let beyond = beyond.unwrap_or_default();
    Some(format!("note: {state}{beyond}{apart}{rare}"))
}

/// `31 of 12288 pixels, left out of it, have 92 % of the squared error`; `None`: none is left out.
fn left_out(estimate: &NoiseEstimate) -> Option<String> {
    let NoiseEstimate {
        left_out, pixels, ..
    } = estimate;
    let share = 100.0 * estimate.share_left_out;
    (*left_out > 0).then(|| {
        let (have, are) = if *left_out == 1 {
            ("has", "is")
        } else {
            ("have", "are")
        };
        format!(
            "{left_out} of {pixels} pixels, which {are} not counted, {have} {share:.0} % of the squared error"
        )
    })
}

/// `, noise 4.97 %`, and what is left out of it where that is notable; nothing where no noise is known.
///
/// * `asked_for`: whether the render aims at a noise.
pub(crate) fn summary(film: &FilmBuffer, asked_for: bool) -> String {
    let estimate = film.noise_estimate();
    if !estimate.relative.is_finite() {
        return String::new();
    }
    let noise = format!(", noise {:.2} %", 100.0 * estimate.relative);
    let is_told = asked_for || estimate.share_left_out >= NOTABLE;
    match left_out(&estimate).filter(|_| is_told) {
        Some(apart) => format!("{noise} ({apart})"),
        None => noise,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(left_out: usize, share_left_out: f32) -> NoiseEstimate {
        NoiseEstimate {
            relative: 0.083,
            of_all: 0.3,
            left_out,
            pixels: 12_288,
            share_left_out,
        }
    }

    fn said(needed: f64, share_left_out: f32, limit: Option<u64>, most: u32) -> Option<String> {
        let outlook = NoiseOutlook {
            noise: 0.083,
            samples: 1000.0,
            rate: 0.3,
            needed,
        };
        let watch = NoiseWatch::new(&RenderOptions::default());
        let time = (Duration::from_secs(20), limit.map(Duration::from_secs));
        message(
            0.05,
            &outlook,
            &estimate(31, share_left_out),
            time,
            most,
            watch.offers,
        )
    }

    #[test]
    fn what_will_be_reached_needs_no_word() {
        assert_eq!(said(3000.0, 0.2, Some(100), 65_536), None);
        assert_eq!(said(3000.0, 0.2, None, 65_536), None);
    }

    #[test]
    fn what_will_not_is_told_with_figures() {
        let text = said(1e4, 0.2, Some(100), 65_536).unwrap();
        assert!(
            text.starts_with(
                "note: noise is 8.3 % after 1000 samples a pixel, 5.0 % is asked for, which would \
                 take 3:20 min; 31 of 12288 pixels, which are not counted, have 20 %"
            ),
            "{text}"
        );
        assert!(text.contains("by the power 0.30"), "{text}");
        let text = said(1e5, 0.01, None, 65_536).unwrap();
        assert!(text.contains("would take 100000 samples a pixel"), "{text}");
        assert!(!text.contains("of 12288"), "{text}");
        let text = said(f64::INFINITY, 0.2, None, 65_536).unwrap();
        assert!(text.contains("and does not fall"), "{text}");
        let text = said(2e5, 0.0, None, 1 << 24).unwrap();
        assert!(text.contains("would take 1:06 h"), "{text}");
    }

    #[test]
    fn fireflies_are_told_with_what_helps() {
        let text = said(2000.0, 0.92, None, 65_536).unwrap();
        assert!(
            text.contains("have 92 % of the squared error: light that paths rarely hit"),
            "{text}"
        );
        assert!(text.contains("--regularize or --clamp 10"), "{text}");
        assert!(text.contains("bias"), "{text}");
    }

    #[test]
    fn one_pixel_is_one() {
        let text = left_out(&estimate(1, 0.5)).unwrap();
        assert!(
            text.starts_with("1 of 12288 pixels, which is not counted, has 50 %"),
            "{text}"
        );
        assert_eq!(left_out(&estimate(0, 0.0)), None);
    }
}
