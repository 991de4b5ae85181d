//! References of a comparison.

use specula_bsdf::Rgb;
use specula_bsdf::vndf::Sampler;
use specula_render::PreparedScene;
use specula_render::picture::{Picture, compare};
use specula_scene::Energy;

use super::turns::Render;
use super::{Clock, CompareOptions};
use crate::{Lab, Result};

/// Seconds of a reference over those of a combination.
pub(super) const TIMES: f64 = 4.0;
/// Number of the first reference: beyond those of the combinations.
const FIRST_NUMBER: usize = 512;

/// A reference.
pub(super) struct Reference {
    /// All that is known.
    pub(super) picture: Picture,
    /// Two independent halves of it, where it was rendered: with them, its own error drops out of the
    /// error of what is compared with it.
    pub(super) halves: Option<[Picture; 2]>,
    /// What it took.
    pub(super) seconds: f64,
}

impl Reference {
    /// The user's.
    pub(super) fn given(picture: Picture) -> Self {
        Self {
            picture,
            halves: None,
            seconds: 0.0,
        }
    }

    /// Two renders by the exact sampler with seeds of their own.
    ///
    /// * `number`: of the treatment of energy.
    pub(super) fn render(
        options: &CompareOptions<'_>,
        energy: Energy,
        number: usize,
        clock: &Clock,
        lab: &Lab<'_>,
    ) -> Result<Self> {
        let what = format!("reference, {energy}");
        let time = 0.5 * TIMES * options.seconds;
        let mut seconds = 0.0;
        let mut half = |i: usize| -> Result<(Picture, u32)> {
            let place = FIRST_NUMBER + 2 * number + i;
            let mut render = Render::new(options, Sampler::Exact, energy, place);
            let scene = render.prepare(options)?;
            let before = TIMES * options.seconds * number as f64 + seconds;
            let step = |now: f64| lab.step(clock.share(before + now), &what);
            render.until(time, &scene, lab, step)?;
            seconds += render.seconds;
            Ok((render.picture()?, render.samples))
        };
        let (a, samples_a) = half(0)?;
        let (b, samples_b) = half(1)?;
        Ok(Self {
            picture: mean(
                &a,
                &b,
                f64::from(samples_a) / f64::from(samples_a + samples_b),
            ),
            halves: Some([a, b]),
            seconds,
        })
    }

    /// The two pictures whose errors are independent; twice the same where it was given.
    pub(super) fn pair(&self) -> [&Picture; 2] {
        match &self.halves {
            Some([a, b]) => [a, b],
            None => [&self.picture; 2],
        }
    }

    /// Mean luminance and its standard error; that is 0 where it was given.
    pub(super) fn brightness(&self) -> [f64; 2] {
        let n = self.picture.colour.len().max(1) as f64;
        let mean = |p: &Picture| {
            p.colour
                .iter()
                .map(|c| f64::from(c.luminance()))
                .sum::<f64>()
                / n
        };
        let variance: f64 = match &self.halves {
            None => 0.0,
            Some(_) => self
                .picture
                .variance
                .iter()
                .map(variance_of_luminance)
                .sum(),
        };
        [mean(&self.picture), variance.sqrt() / n]
    }
}

/// Fails where the user's reference is of another size than the render, before that has begun.
pub(super) fn check_size(options: &CompareOptions<'_>, reference: &Picture) -> Result<()> {
    let [x0, x1, y0, y1] = PreparedScene::new(options.scene, &options.render)?.crop();
    let (width, height) = (x1 - x0, y1 - y0);
    let pixels = width as usize * height as usize;
    let blank = Picture::from_colour(width, height, vec![Rgb::BLACK; pixels]);
    compare(reference, &blank)?;
    Ok(())
}

/// An upper bound on the variance of the luminance: channels that vary together.
pub(super) fn variance_of_luminance(variance: &Rgb<f32>) -> f64 {
    let deviation = variance.map(|v| v.max(0.0).sqrt()).luminance();
    f64::from(deviation).powi(2)
}

/// `a` times `share` and `b` times the rest, with the variance of that.
#[expect(clippy::cast_possible_truncation, reason = "a share needs no more")]
fn mean(a: &Picture, b: &Picture, share: f64) -> Picture {
    let (p, q) = (share as f32, (1.0 - share) as f32);
    let both = |x: &[Rgb<f32>], y: &[Rgb<f32>], p: f32, q: f32| {
        let pairs = x.iter().zip(y);
        pairs.map(|(x, y)| *x * p + *y * q).collect()
    };
    Picture {
        variance: both(&a.variance, &b.variance, p * p, q * q),
        ..Picture::from_colour(a.width, a.height, both(&a.colour, &b.colour, p, q))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_weighed() {
        let flat = |v: f32| Picture {
            variance: vec![Rgb::splat(v); 4],
            ..Picture::from_colour(2, 2, vec![Rgb::splat(v); 4])
        };
        let both = mean(&flat(1.0), &flat(5.0), 0.75);
        assert_eq!(both.colour[3], Rgb::splat(2.0));
        assert_eq!(both.variance[0].g, 0.5625 + 5.0 * 0.0625);
        let reference = Reference {
            halves: Some([flat(1.0), flat(5.0)]),
            picture: both,
            seconds: 1.0,
        };
        let [mean, error] = reference.brightness();
        assert!((mean - 2.0).abs() < 1e-6 && error > 0.0);
    }
}
