//! Bounds on the contribution of indirect light, which take noise away at the price of bias
//! ([`RenderOptions::clamp`](crate::RenderOptions::clamp)).

use specula_bsdf::Rgb;

/// Scattering events of a path from which on its light is indirect: light of the first surface that is seen is
/// never bounded.
const INDIRECT_FROM: u32 = 2;

/// A contribution to a path's radiance, scaled so that no channel exceeds `bound` where it is indirect.
///
/// * `events`: at which the light was scattered on its way to the camera.
#[inline(always)]
pub(super) fn bounded(contribution: Rgb<f32>, events: u32, bound: f32) -> Rgb<f32> {
    let largest = contribution.max_channel();
    if events >= INDIRECT_FROM && largest > bound {
        contribution * (bound / largest)
    } else {
        contribution
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::rgb;

    #[test]
    fn bounds_hold_indirect_light_only_and_keep_its_hue() {
        let c = rgb(4.0, 8.0, 2.0);
        assert_eq!(bounded(c, 1, 1.0), c);
        assert_eq!(bounded(c, 2, 8.0), c);
        assert_eq!(bounded(c, 2, f32::INFINITY), c);
        assert_eq!(bounded(c, 2, 4.0), rgb(2.0, 4.0, 1.0));
        // What is not finite is still found.
        assert!(!bounded(rgb(f32::NAN, 0.0, 0.0), 2, 1.0).is_finite());
        assert!(!bounded(rgb(f32::INFINITY, 0.0, 0.0), 2, 1.0).is_finite());
    }
}
