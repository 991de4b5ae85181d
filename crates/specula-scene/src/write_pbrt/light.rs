//! Lights, and environment maps resampled to pbrt's square.

use core::f64::consts::{FRAC_PI_4, PI, TAU};

use glam::{DMat4, DVec3};
use rayon::prelude::*;
use specula_bsdf::Rgb;

use super::{WriteError, Writer, list, quoted, rgb_list, transform};
use crate::image::Image;
use crate::num::f32_of;
use crate::scene::{EnvironmentMapping, ImageId, Light, SpotFalloff};

/// Samples along each side of a pixel of a resampled environment.
const SAMPLES: u32 = 4;

impl Writer<'_> {
    pub(super) fn light(&mut self, index: usize, light: &Light) -> Result<(), WriteError> {
        let (place, directive) = match light {
            Light::Infinite {
                radiance,
                image,
                to_world,
            } => (*to_world, self.infinite(index, *radiance, *image)?),
            Light::Portal {
                radiance,
                image,
                to_world,
                corners,
            } => {
                let sky = self.infinite(index, *radiance, *image)?;
                let portal = list(corners.as_flattened());
                (*to_world, format!("{sky} \"point3 portal\" [ {portal} ]"))
            }
            Light::Distant {
                irradiance,
                to_light,
                half_angle_deg,
            } => {
                if *half_angle_deg > 0.0 {
                    self.note("the sun's disk cannot be said: it is written as parallel light");
                }
                let directive = format!(
                    "\"distant\" \"point3 from\" [ {} ] \"point3 to\" [ 0 0 0 ] \"rgb L\" [ {} ]",
                    list(to_light),
                    rgb_list(*irradiance)
                );
                (DMat4::IDENTITY, directive)
            }
            Light::Point {
                position,
                intensity,
            } => {
                let directive = format!(
                    "\"point\" \"point3 from\" [ {} ] \"rgb I\" [ {} ]",
                    list(position),
                    rgb_list(*intensity)
                );
                (DMat4::IDENTITY, directive)
            }
            Light::Spot {
                position,
                axis,
                intensity,
                cone_angle_deg,
                falloff_start_deg,
                falloff,
            } => {
                if *falloff != SpotFalloff::SmoothCosine {
                    self.note("spot lights fall off smoothly in the cosine of the angle");
                }
                let to = DVec3::from(*position) + DVec3::from(*axis);
                let directive = format!(
                    "\"spot\" \"point3 from\" [ {} ] \"point3 to\" [ {} ] \"rgb I\" [ {} ] \
                     \"float coneangle\" [ {cone_angle_deg} ] \"float conedeltaangle\" [ {} ]",
                    list(position),
                    list(&to.to_array()),
                    rgb_list(*intensity),
                    cone_angle_deg - falloff_start_deg
                );
                (DMat4::IDENTITY, directive)
            }
            Light::Picture {
                to_world,
                intensity,
                image_projection,
            } => self.projected(index, to_world, *intensity, image_projection)?,
        };
        let place = transform(&place);
        self.line(&format!(
            "AttributeBegin\n{place}\nLightSource {directive}\nAttributeEnd"
        ));
        Ok(())
    }

    fn infinite(
        &mut self,
        index: usize,
        radiance: Rgb<f32>,
        image: Option<(ImageId, EnvironmentMapping)>,
    ) -> Result<String, WriteError> {
        let Some((id, mapping)) = image else {
            return Ok(format!("\"infinite\" \"rgb L\" [ {} ]", rgb_list(radiance)));
        };
        let source = &self.scene.images[id.0];
        let square;
        let picture = match mapping {
            EnvironmentMapping::EqualAreaOctahedral => source,
            EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
                square = equal_area(source, mapping);
                &square
            }
        };
        // pbrt has no factor on a picture's colour: it is multiplied into the pixels.
        let name = format!("environment-{index}.exr");
        let scaled = Image {
            name: String::new(),
            width: picture.width,
            height: picture.height,
            pixels: (picture.pixels.iter())
                .map(|p| (Rgb::from(p) * radiance).to_array())
                .collect(),
        };
        let file = self.picture(&name, &scaled, |c| c)?;
        Ok(format!(
            "\"infinite\" \"string filename\" [ {} ]",
            quoted(&file)
        ))
    }
}

/// A latitude-longitude picture as an equal-area square of as many pixels.
fn equal_area(source: &Image, mapping: EnvironmentMapping) -> Image {
    let pixels = f64::from(source.width) * f64::from(source.height);
    let mut side = 1_u32;
    while f64::from(side) * f64::from(side) < pixels && side < 1 << 14 {
        side *= 2;
    }
    let step = 1.0 / f64::from(side * SAMPLES);
    let pixel = |index: u32| {
        let (x, y) = (index % side, index / side);
        let mut sum = [0.0_f64; 3];
        for i in 0..SAMPLES * SAMPLES {
            let s = (f64::from(x * SAMPLES + i % SAMPLES) + 0.5) * step;
            let t = (f64::from(y * SAMPLES + i / SAMPLES) + 0.5) * step;
            for (sum, value) in sum
                .iter_mut()
                .zip(lookup(source, mapping, direction([s, t])))
            {
                *sum += value;
            }
        }
        sum.map(|v| f32_of(v / f64::from(SAMPLES * SAMPLES)))
    };
    Image {
        name: source.name.clone(),
        width: side,
        height: side,
        pixels: (0..side * side)
            .into_par_iter()
            .map(pixel)
            .collect::<Vec<_>>()
            .into(),
    }
}

/// The direction of a point of the square, as [`EnvironmentMapping::EqualAreaOctahedral`] says.
fn direction([s, t]: [f64; 2]) -> DVec3 {
    let (u, v) = (2.0 * s - 1.0, 2.0 * t - 1.0);
    let d = 1.0 - (u.abs() + v.abs());
    let r = 1.0 - d.abs();
    let phi = if r == 0.0 {
        FRAC_PI_4
    } else {
        FRAC_PI_4 * ((v.abs() - u.abs()) / r + 1.0)
    };
    let planar = r * (2.0 - r * r).sqrt();
    DVec3::new(
        (planar * phi.cos()).copysign(u),
        (planar * phi.sin()).copysign(v),
        (1.0 - r * r).copysign(d),
    )
}

/// Bilinear interpolation in a latitude-longitude picture.
fn lookup(image: &Image, mapping: EnvironmentMapping, w: DVec3) -> [f64; 3] {
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    let azimuth = w.y.atan2(w.x) / TAU;
    let x = (azimuth - azimuth.floor()) * width - 0.5;
    let v = w.z.clamp(-1.0, 1.0).acos() / PI;
    let y = match mapping {
        EnvironmentMapping::LatitudeLongitudePoles => v * (height - 1.0),
        _ => v * height - 0.5,
    };
    let (fx, fy) = (x - x.floor(), y - y.floor());
    #[allow(
        clippy::cast_possible_truncation,
        reason = "within the sides of a picture"
    )]
    let (x0, y0) = (x.floor() as i64, y.floor() as i64);
    let at = |dx: i64, dy: i64| {
        let column = (x0 + dx).rem_euclid(i64::from(image.width));
        let row = (y0 + dy).clamp(0, i64::from(image.height) - 1);
        let index = usize::try_from(row * i64::from(image.width) + column).unwrap_or(0);
        image.pixels.rgb(index).map(f64::from)
    };
    let [a, b, c, d] = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
    [0, 1, 2].map(|i| {
        (a[i] * (1.0 - fx) + b[i] * fx) * (1.0 - fy) + (c[i] * (1.0 - fx) + d[i] * fx) * fy
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resampled_sky_keeps_its_light_and_its_place() {
        // A bright patch about azimuth 90 degrees, 45 degrees up, on a grey ground.
        let (width, height) = (128, 64);
        let pixels = (0..width * height)
            .map(|i| {
                let (x, y) = (i % width, i / width);
                let hit = (28..36).contains(&x) && (12..20).contains(&y);
                [if hit { 9.0 } else { 0.5 }; 3]
            })
            .collect();
        let source = Image {
            name: String::new(),
            width,
            height,
            pixels,
        };
        let square = equal_area(&source, EnvironmentMapping::LatitudeLongitude);
        let mean = |image: &Image, weight: &dyn Fn(u32) -> f64| {
            let (mut sum, mut total) = (0.0, 0.0);
            for (i, p) in (0_u32..).zip(image.pixels.iter()) {
                let w = weight(i / image.width);
                sum += w * f64::from(p[0]);
                total += w;
            }
            sum / total
        };
        let whole = mean(&source, &|row| {
            ((f64::from(row) + 0.5) * PI / f64::from(height)).sin()
        });
        let found = mean(&square, &|_| 1.0);
        assert!((found / whole - 1.0).abs() < 5e-3, "{found} {whole}");
        let brightest = (0_u32..)
            .zip(square.pixels.iter())
            .filter(|(_, p)| p[0] > 8.9)
            .map(|(i, _)| {
                let at = |k: u32| (f64::from(k) + 0.5) / f64::from(square.width);
                direction([at(i % square.width), at(i / square.width)])
            })
            .fold(DVec3::ZERO, |sum, w| sum + w)
            .normalize();
        let expected = DVec3::new(0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt());
        assert!((brightest - expected).length() < 0.02, "{brightest}");
    }
}
