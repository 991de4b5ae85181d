//! Lenses of a camera, one behind the other, and where their film is.

/// Spherical interfaces and a stop between scene and film. Lengths are in scene units.
///
/// The film is in the plane z = 0 of the camera's space, its middle at the origin; light arrives through the lenses at
/// z > 0. A sample of the film measures its irradiance:
///
/// ```text
/// E = integral over the plane z = d of the rear vertex of L cos^4(theta) / d^2
/// ```
///
/// Source: Kolb, Mitchell and Hanrahan 1995, "A Realistic Camera Model for Computer Graphics", eqs. 1 and 2.
#[derive(Clone, Debug, PartialEq)]
pub struct LensSystem {
    /// From the scene to the film, at least one; the last one's thickness is the distance to the film.
    pub interfaces: Vec<LensInterface>,
    /// What the stop lets pass; `None`: all of its circle.
    pub stop: Option<StopPicture>,
    /// Diagonal of the film.
    pub film_diagonal: f64,
}

/// An interface of a [`LensSystem`], or its stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensInterface {
    /// Radius of curvature, above 0 where it is convex seen from the scene; 0: the stop, which is flat.
    pub curvature_radius: f64,
    /// Distance along the axis to the next one.
    pub thickness: f64,
    /// Index of refraction between this one and the next.
    pub eta: f64,
    /// Radius of the circle that lets light pass.
    pub aperture_radius: f64,
}

/// Transmittance over the square around a stop, whose mean is pi / 4: that of a circle.
#[derive(Clone, Debug, PartialEq)]
pub struct StopPicture {
    /// Columns along the camera's +x.
    pub width: u32,
    /// Rows along the camera's +y.
    pub height: u32,
    /// `width * height` values, not negative.
    pub values: Vec<f32>,
}

impl StopPicture {
    fn is_sound(&self) -> bool {
        let pixels = u64::from(self.width) * u64::from(self.height);
        let sound = |v: &f32| *v >= 0.0 && v.is_finite();
        pixels > 0 && self.values.len() as u64 == pixels && self.values.iter().all(sound)
    }

    /// A picture scaled to the brightness of a circle; `None` where it is black.
    ///
    /// * `values`: row by row from the top, as it stands in the stop seen from the film.
    pub(crate) fn new(width: u32, values: &[f32]) -> Option<Self> {
        let mean = values.iter().copied().map(f64::from).sum::<f64>() / values.len() as f64;
        let scale = std::f64::consts::FRAC_PI_4 / mean;
        if !(scale.is_finite() && mean > 0.0) {
            return None;
        }
        let rows = values.chunks(width.max(1) as usize).rev();
        let values: Vec<f32> = rows
            .flatten()
            .map(|v| crate::num::f32_of(f64::from(*v) * scale))
            .collect();
        let height = u32::try_from(values.len()).ok()? / width;
        Some(Self {
            width,
            height,
            values,
        })
    }
}

/// Where a [`LensSystem`] has its focal length and its principal planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ThickLens {
    pub(crate) focal_length: f64,
    /// From the front principal plane to the one behind, towards the film.
    gap: f64,
    /// From the rear vertex to the rear principal plane, towards the film.
    rear: f64,
}

impl LensSystem {
    /// Whether all numbers are in their ranges.
    pub(crate) fn is_sound(&self) -> bool {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let sound = |i: &LensInterface| {
            let flat = i.curvature_radius.is_finite() && i.thickness.is_finite();
            flat && i.thickness >= 0.0 && positive(i.eta) && positive(i.aperture_radius)
        };
        let last = self.interfaces.last();
        self.interfaces.iter().all(sound)
            && last.is_some_and(|i| i.thickness > 0.0)
            && positive(self.film_diagonal)
            && self.stop.as_ref().is_none_or(StopPicture::is_sound)
    }

    /// Its thick lens, by rays near the axis; `None` where these do not converge.
    ///
    /// ```text
    /// (h', u')^T = M (h, u)^T,   M = (A B; C D) from the front vertex to the rear one
    /// f = -1 / C,   rear plane: (1 - A) / C behind the rear vertex,   front plane: (D - 1) / C behind the front vertex
    /// ```
    ///
    /// Source: Born and Wolf, section 4.4 (paraxial refraction `n' u' = n u - h (n' - n) / R`, and transfer).
    pub(crate) fn thick_lens(&self) -> Option<ThickLens> {
        let trace = |mut height: f64, mut slope: f64| {
            let mut index = 1.0;
            for (i, interface) in self.interfaces.iter().enumerate() {
                if interface.curvature_radius != 0.0 {
                    let bend = height * (interface.eta - index) / interface.curvature_radius;
                    slope = (index * slope - bend) / interface.eta;
                }
                index = interface.eta;
                if i + 1 < self.interfaces.len() {
                    height += interface.thickness * slope;
                }
            }
            [height, slope]
        };
        let ([a, c], [_, d]) = (trace(1.0, 0.0), trace(0.0, 1.0));
        let lens = ThickLens {
            focal_length: -1.0 / c,
            gap: self.length() + (1.0 - a) / c - (d - 1.0) / c,
            rear: (1.0 - a) / c,
        };
        let focal = lens.focal_length;
        (focal.is_finite() && focal > 0.0 && lens.gap.is_finite()).then_some(lens)
    }

    /// From the first vertex to the last.
    pub(crate) fn length(&self) -> f64 {
        let inner = &self.interfaces[..self.interfaces.len() - 1];
        inner.iter().map(|i| i.thickness).sum()
    }
}

impl ThickLens {
    /// The distance from the rear vertex to the film for a plane in focus; `None` where it is nearer than
    /// [`ThickLens::nearest`].
    ///
    /// With `L` the distance less the gap, and the image `s'` behind its principal plane:
    ///
    /// ```text
    /// 1 / (L - s') + 1 / s' = 1 / f   =>   s' = 2 f L / (L + sqrt(L (L - 4 f)))
    /// ```
    ///
    /// * `distance`: from the film to the plane.
    pub(crate) fn film_distance(&self, distance: f64) -> Option<f64> {
        let (l, f) = (distance - self.gap, self.focal_length);
        let root = (l * (l - 4.0 * f)).sqrt();
        (l > 4.0 * f).then(|| 2.0 * f * l / (l + root) + self.rear)
    }

    /// The distance from the film to the nearest plane that it can be focused on: `4 f` and the gap.
    pub(crate) fn nearest(&self) -> f64 {
        4.0 * self.focal_length + self.gap
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn system(rows: &[[f64; 4]]) -> LensSystem {
        let interface =
            |&[curvature_radius, thickness, eta, aperture_radius]: &[f64; 4]| LensInterface {
                curvature_radius,
                thickness,
                eta,
                aperture_radius,
            };
        LensSystem {
            interfaces: rows.iter().map(interface).collect(),
            stop: None,
            film_diagonal: 1.0,
        }
    }

    #[test]
    fn a_thin_lens_has_the_lensmaker_s_focal_length() {
        let lens = system(&[[100.0, 0.0, 1.5, 20.0], [-100.0, 50.0, 1.0, 20.0]]);
        let thick = lens.thick_lens().unwrap();
        assert!((thick.focal_length - 100.0).abs() < 1e-9);
        assert!(thick.gap.abs() < 1e-9 && thick.rear.abs() < 1e-9);
        // 1 / 300 + 1 / 150 = 1 / 100.
        assert!((thick.film_distance(450.0).unwrap() - 150.0).abs() < 1e-9);
        assert_eq!(thick.film_distance(399.0), None);
        assert!((thick.nearest() - 400.0).abs() < 1e-9);
        let wide = system(&[[-100.0, 0.0, 1.5, 20.0], [100.0, 50.0, 1.0, 20.0]]);
        assert_eq!(wide.thick_lens(), None);
    }

    /// Rays of f64 near the axis, from a point at the distance in focus, meet in the film.
    #[test]
    fn thick_lenses_focus_where_they_say() {
        let rows = [
            [30.0, 12.0, 1.7, 20.0],
            [80.0, 9.0, 1.0, 20.0],
            [0.0, 4.0, 1.0, 5.0],
            [-50.0, 7.0, 1.6, 20.0],
            [-20.0, 1.0, 1.0, 20.0],
        ];
        let mut lens = system(&rows);
        let thick = lens.thick_lens().unwrap();
        for distance in [1.001 * thick.nearest(), 300.0, 1e3, 1e6] {
            let film = thick.film_distance(distance).unwrap();
            lens.interfaces.last_mut().unwrap().thickness = film;
            // A ray of slope 1e-7 from the axis, by the law of refraction for spheres.
            let (mut z, mut h, mut u) = (-(distance - film - lens.length()), 0.0_f64, 1e-7_f64);
            let (mut vertex, mut index) = (0.0, 1.0);
            for i in &lens.interfaces {
                h += (vertex - z) * u;
                z = vertex;
                if i.curvature_radius != 0.0 {
                    let normal = h / i.curvature_radius;
                    u = ((u + normal) * index / i.eta) - normal;
                    index = i.eta;
                }
                vertex += i.thickness;
            }
            h += (vertex - z) * u;
            assert!(h.abs() < 1e-9 * distance * 1e-7 * 1e3, "{distance}: {h}");
        }
    }

    #[test]
    fn stops_are_as_bright_as_a_circle_and_have_their_first_row_below() {
        let stop = StopPicture::new(2, &[0.0, 1.0, 2.0, 5.0]).unwrap();
        assert_eq!([stop.width, stop.height], [2, 2]);
        let mean = stop.values.iter().sum::<f32>() / 4.0;
        assert!((mean - core::f32::consts::FRAC_PI_4).abs() < 1e-6);
        assert!(stop.values[2] == 0.0 && stop.values[1] > stop.values[0]);
        assert_eq!(StopPicture::new(2, &[0.0; 4]), None);
    }
}
