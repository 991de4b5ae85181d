//! Ray cones: how wide what a path stands for is, for filtered textures.
//!
//! A cone has a radius at the path's last vertex, and a spread, by which the radius grows with the distance. A camera's
//! pixel covers a circle of the radius by which neighbouring rays differ, as pbrt-v4's footprints have the differences
//! to the next pixels for half axes.
//!
//! Paths of a pixel share its area: the `k`-th sample of a pixel, from 1 on, stands for the share `1 / k` of it, but
//! for no less than 1/64. So do the directions that lobes are sampled in. Radii scale with the root of that. What
//! filters blur falls with the number of samples, to that of 1/64, however many there will be: a picture does not depend
//! on what was planned. (pbrt-v4 scales the footprints of all of `n` samples by `max(1/8, 1/sqrt(n))`.)
//!
//! Source: Akenine-Moeller, Nilsson, Andersson, Barre-Brisebois, Toth and Karras 2019, "Texture Level of Detail
//! Strategies for Real-Time Ray Tracing"; Suykens and Willems 2001, "Path Differentials and Applications", for
//! footprints of sampled lobes.

use core::f32::consts::PI;

/// Largest spread: a cone of 45 degrees around its axis.
const MOST_SPREAD: f32 = 1.0;

/// Least share of a pixel's area, or of a lobe, that a path stands for.
const LEAST_SHARE: f32 = 1.0 / 64.0;

/// A cone around a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RayCone {
    /// At the ray's origin, in the world's unit of length.
    pub(crate) radius: f32,
    /// Growth of the radius with the distance; below 0 where it narrows to a focus.
    pub(crate) spread: f32,
}

/// What scattered a path.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bounce {
    /// A perfect mirror.
    Mirror,
    /// A perfectly smooth interface, by the index beyond it over the index before it.
    Refraction { eta: f32 },
    /// A lobe that is not perfectly smooth, by the density of the sampled direction in 1/sr.
    Lobe { pdf: f32 },
}

impl RayCone {
    /// A line.
    pub(crate) const NONE: Self = Self {
        radius: 0.0,
        spread: 0.0,
    };

    /// The cone of a path that stands for a share of what this one covers.
    ///
    /// * `index`: of the pixel's sample, from 0 on.
    #[inline]
    pub(crate) fn of_sample(self, index: u32) -> Self {
        let scale = share(index).sqrt();
        Self {
            radius: self.radius * scale,
            spread: self.spread * scale,
        }
    }

    /// The cone at a distance; behind its focus it widens.
    #[inline]
    pub(crate) fn at(self, distance: f32) -> Self {
        let radius = self.radius + self.spread * distance;
        if radius < 0.0 {
            return Self {
                radius: -radius,
                spread: -self.spread,
            };
        }
        Self { radius, ..self }
    }

    /// The cone after a surface, whose origin it is at.
    ///
    /// ```text
    /// mirror:      spread + 2 H radius
    /// refraction:  spread / eta - H radius (1 - 1 / eta)
    /// lobe:        max(|spread|, sqrt(share / (pi pdf)))
    /// ```
    ///
    /// The first two hold for directions near the normal (paraxial optics); off it they are the means of what happens
    /// along the plane of incidence and across. A sampled direction stands for the solid angle `share / pdf`, which a
    /// cone of spread `s` fills as `pi s^2`: narrow where a lobe is, wide where it is diffuse.
    ///
    /// * `mean_curvature`: H, above 0 where the surface is convex seen from where the path came; asked for where the
    ///   surface is perfectly smooth.
    /// * `index`: as of [`RayCone::of_sample`].
    #[inline]
    pub(crate) fn after(
        self,
        bounce: Bounce,
        mean_curvature: impl FnOnce() -> f32,
        index: u32,
    ) -> Self {
        let spread = match bounce {
            Bounce::Mirror => self.spread + 2.0 * mean_curvature() * self.radius,
            Bounce::Refraction { eta: 1.0 } => self.spread,
            Bounce::Refraction { eta } => {
                let inverse = 1.0 / eta;
                self.spread * inverse - mean_curvature() * self.radius * (1.0 - inverse)
            }
            Bounce::Lobe { pdf } => {
                let of_lobe = (share(index) / (PI * pdf.max(f32::MIN_POSITIVE))).sqrt();
                self.spread.abs().max(of_lobe)
            }
        };
        Self {
            spread: spread.clamp(-MOST_SPREAD, MOST_SPREAD),
            ..self
        }
    }
}

/// What a sample stands for, of all that a pixel covers.
fn share(index: u32) -> f32 {
    (1.0 / (index as f32 + 1.0)).max(LEAST_SHARE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_grow_and_narrow_to_their_focus() {
        let cone = RayCone {
            radius: 1.0,
            spread: 0.25,
        };
        assert_eq!(cone.at(8.0).radius, 3.0);
        let focussed = RayCone {
            spread: -0.25,
            ..cone
        };
        assert_eq!(focussed.at(4.0).radius, 0.0);
        let behind = focussed.at(8.0);
        assert_eq!((behind.radius, behind.spread), (1.0, 0.25));
    }

    #[test]
    fn samples_share_a_pixel() {
        let whole = RayCone {
            radius: 2.0,
            spread: 1.0,
        };
        assert_eq!(whole.of_sample(0), whole);
        assert_eq!(whole.of_sample(3).radius, 1.0);
        for index in [63, 1000, u32::MAX] {
            assert_eq!(whole.of_sample(index).spread, 0.125);
        }
    }

    /// Focal lengths of mirrors and of single refracting surfaces: R / 2 and n R / (n - 1).
    #[test]
    fn curved_surfaces_focus_where_they_do_in_optics() {
        let parallel = RayCone {
            radius: 0.1,
            spread: 0.0,
        };
        let radius = 3.0;
        let concave = parallel.after(Bounce::Mirror, || -1.0 / radius, 0);
        assert!(concave.at(0.5 * radius).radius < 1e-6);
        let eta = 1.5;
        let ball = parallel.after(Bounce::Refraction { eta }, || 1.0 / radius, 0);
        assert!(ball.at(eta * radius / (eta - 1.0)).radius < 1e-6);
        let pane = parallel.after(Bounce::Refraction { eta: 1.0 }, || 7.0, 0);
        assert_eq!(pane, parallel);
    }

    /// The cone of a sampled direction fills the solid angle that it stands for: all cones together that of the lobe.
    #[test]
    fn lobes_are_filled_by_the_cones_of_their_samples() {
        let cone = RayCone {
            radius: 0.1,
            spread: 0.001,
        };
        for (pdf, index) in [(100.0, 0), (100.0, 15), (1e4, 3)] {
            let spread = cone.after(Bounce::Lobe { pdf }, || f32::NAN, index).spread;
            let solid_angle = PI * spread * spread;
            let expected = 1.0 / (pdf * (index as f32 + 1.0));
            assert!((solid_angle / expected - 1.0).abs() < 1e-5, "{pdf} {index}");
        }
        let narrow = cone.after(Bounce::Lobe { pdf: 1e12 }, || f32::NAN, 0);
        assert_eq!(narrow.spread, cone.spread);
        for pdf in [0.0, 1e-20, f32::NAN] {
            let wide = cone.after(Bounce::Lobe { pdf }, || f32::NAN, 0);
            assert_eq!(wide.spread, MOST_SPREAD, "{pdf}");
        }
    }
}
