//! Film, filter, sampler and integrator.

use std::rc::Rc;

use super::context::Context;
use super::element::Element;
use super::texture::unknown;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};
use crate::scene::{Film, Filter};

/// Largest side of a picture.
const MAX_SIDE: u32 = 65_536;
/// Most samples per pixel.
const MAX_SAMPLES: u32 = 1 << 24;

/// Mitsuba's default filter: zero at four deviations of half a pixel.
const DEFAULT_FILTER: Filter = Filter::Gaussian {
    radius: [2.0; 2],
    sigma: 0.5,
};

impl Context<'_> {
    /// The film of a sensor, or the default one.
    pub(super) fn film(&mut self, element: Option<&Rc<Element>>) -> Result<Film, SceneError> {
        let Some(element) = element else {
            return Ok(Film::new([768, 576], DEFAULT_FILTER));
        };
        // Parameters of the output file are not used.
        element.ignore(&[
            "file_format",
            "pixel_format",
            "component_format",
            "compensate",
            "sample_border",
            "banner",
            "attach_log",
            "high_quality_edges",
            "gamma",
            "exposure",
            "tonemap_method",
            "reinhard_params",
            "label",
        ]);
        match element.plugin.as_str() {
            "hdrfilm" => {}
            "ldrfilm" | "tiledhdrfilm" | "mfilm" | "specfilm" => {
                let message = format!("{} is rendered as \"hdrfilm\"", element.title());
                element.properties.iter().for_each(|p| p.used.set(true));
                self.warn(&element.place, message);
            }
            other => return Err(unknown("film", other, &element.place)),
        }
        let width = element.integer_within("width", 768, 1..=MAX_SIDE)?;
        let height = element.integer_within("height", 576, 1..=MAX_SIDE)?;
        let x = element.integer_within("crop_offset_x", 0, 0..=width - 1)?;
        let y = element.integer_within("crop_offset_y", 0, 0..=height - 1)?;
        let crop_width = element.integer_within("crop_width", width - x, 1..=width - x)?;
        let crop_height = element.integer_within("crop_height", height - y, 1..=height - y)?;
        let filter = match self.child(element, "rfilter")? {
            None => DEFAULT_FILTER,
            Some(filter) => self.filter(&filter)?,
        };
        let pixels = u64::from(crop_width) * u64::from(crop_height);
        if pixels > self.limits.max_pixels {
            let message = format!(
                "the picture has {pixels} pixels; at most {} are rendered (`max_pixels`)",
                self.limits.max_pixels
            );
            return Err(SceneError::new(ErrorKind::Limit, &element.place, message));
        }
        Ok(Film {
            crop: [x, x + crop_width, y, y + crop_height],
            ..Film::new([width, height], filter)
        })
    }

    fn filter(&mut self, element: &Element) -> Result<Filter, SceneError> {
        let number = |name: &str, default: f64| -> Result<f32, SceneError> {
            let value = element.above_zero(name, default)?;
            if value > 64.0 {
                let message = format!("\"{name}\": expected at most 64 pixels, found {value}");
                return Err(element.error(message));
            }
            Ok(f32_of(value))
        };
        Ok(match element.plugin.as_str() {
            "box" => {
                element.ignore(&["radius"]);
                Filter::Box { radius: [0.5; 2] }
            }
            "tent" => Filter::Triangle {
                radius: [number("radius", 1.0)?; 2],
            },
            "gaussian" => {
                let sigma = number("stddev", 0.5)?;
                Filter::Gaussian {
                    radius: [4.0 * sigma; 2],
                    sigma,
                }
            }
            "mitchell" => Filter::Mitchell {
                radius: [2.0; 2],
                b: f32_of(element.number("B", 1.0 / 3.0)?),
                c: f32_of(element.number("C", 1.0 / 3.0)?),
            },
            "catmullrom" => Filter::Mitchell {
                radius: [2.0; 2],
                b: 0.0,
                c: 0.5,
            },
            "lanczos" => {
                // Both sincs end with the lobes.
                let lobes = number("lobes", 3.0)?;
                Filter::LanczosSinc {
                    radius: [lobes; 2],
                    tau: lobes,
                }
            }
            other => return Err(unknown("rfilter", other, &element.place)),
        })
    }

    /// Samples per pixel.
    pub(super) fn sampler(&mut self, element: Option<&Rc<Element>>) -> Result<u32, SceneError> {
        let Some(element) = element else {
            return Ok(16);
        };
        // Every sampler converges to the same picture; the seed is an option of the render.
        element.ignore(&["seed", "jitter", "dimension", "scramble"]);
        match element.plugin.as_str() {
            "independent" | "stratified" | "multijitter" | "orthogonal" | "ldsampler"
            | "halton" | "hammersley" | "sobol" => {}
            other => {
                let message = format!("sampler \"{}\" is unknown", shorten(other));
                self.warn(&element.place, message);
            }
        }
        element.integer_within("sample_count", 16, 1..=MAX_SAMPLES)
    }

    /// Longest path, as pbrt counts it.
    pub(super) fn integrator(&mut self, element: Option<&Rc<Element>>) -> Result<u32, SceneError> {
        /// Stands for no limit.
        const ENDLESS: u32 = 1_000_000;
        let Some(element) = element else {
            return Ok(ENDLESS);
        };
        // Russian roulette and the distribution of samples do not change the expectation.
        element.ignore(&[
            "rr_depth",
            "strict_normals",
            "timeout",
            "block_size",
            "samples_per_pass",
            "shading_samples",
            "emitter_samples",
            "bsdf_samples",
        ]);
        self.hide_emitters |= element.boolean("hide_emitters", false)?;
        match element.plugin.as_str() {
            "moment" | "aov" | "adaptive" | "irrcache" | "multichannel" | "stokes" => {
                element.properties.iter().for_each(|p| p.used.set(true));
                let inner = self.children(element, "integrator")?.into_iter().next();
                return self.deeper(element, |context| context.integrator(inner.as_ref()));
            }
            "direct" => return Ok(1),
            "path" => {}
            "depth" => {
                let message = "integrator \"depth\" shows distances: paths are traced here";
                self.warn(&element.place, message);
            }
            other @ ("volpath" | "volpathmis" | "volpath_simple") => {
                let message = format!("integrator \"{other}\": media absorb, and do not scatter");
                self.warn(&element.place, message);
            }
            other @ ("ptracer" | "prb" | "prb_basic" | "prbvolpath" | "direct_projective"
            | "prb_projective" | "bdpt" | "pssmlt" | "mlt" | "erpt" | "photonmapper"
            | "ppm" | "sppm" | "vpl" | "ao") => {
                element.properties.iter().for_each(|p| p.used.set(true));
                let message = format!("integrator \"{other}\" is not supported: paths are traced");
                self.warn(&element.place, message);
            }
            other => return Err(unknown("integrator", other, &element.place)),
        }
        let depth = element.integer("max_depth", -1)?;
        match u32::try_from(depth) {
            // The camera's segment counts, and 0 is a black picture: emission is the least here.
            Ok(depth) => Ok(depth.min(ENDLESS).saturating_sub(1)),
            Err(_) if depth == -1 => Ok(ENDLESS),
            Err(_) => {
                let message = format!("\"max_depth\": expected -1 or more, found {depth}");
                Err(element.error(message))
            }
        }
    }
}
