//! `<sensor>`: cameras.

use glam::{DMat4, DVec3};

use super::context::Context;
use super::element::Element;
use super::number::number;
use super::texture::{bad_choice, unknown};
use crate::error::SceneError;
use crate::scene::{Camera, Projection};

impl Context<'_> {
    /// A camera over a picture of `size` pixels.
    pub(super) fn camera(
        &mut self,
        element: &Element,
        size: [u32; 2],
    ) -> Result<Camera, SceneError> {
        element.ignore(&["shutter_open", "shutter_close", "srf"]);
        let far = element.above_zero("far_clip", 1e4)?;
        let near = element.above_zero("near_clip", 1e-2)?;
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        // Mitsuba's +x points to the left of the picture.
        let to_world =
            element.transform("to_world")? * DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let mut camera = Camera {
            to_world,
            motion: None,
            projection: Projection::Orthographic,
            lens_radius: 0.0,
            focal_distance: element.above_zero("focus_distance", far)?,
            screen_window: [-1.0, 1.0, -1.0 / aspect, 1.0 / aspect],
        };
        match element.plugin.as_str() {
            "perspective" => {
                camera.screen_window = self.perspective(element, aspect, &mut camera)?;
            }
            "thinlens" => {
                camera.screen_window = self.perspective(element, aspect, &mut camera)?;
                camera.lens_radius = element.not_negative("aperture_radius", 0.0)?;
                if !element.has("aperture_radius") {
                    return Err(element.error("sensor \"thinlens\" needs its \"aperture_radius\""));
                }
            }
            "orthographic" => {
                // Rays begin on the near plane.
                camera.to_world *= DMat4::from_translation(DVec3::new(0.0, 0.0, near));
            }
            other => return Err(unknown("sensor", other, &element.place)),
        }
        Ok(camera)
    }

    /// Sets the field of view, and returns the screen window.
    fn perspective(
        &mut self,
        element: &Element,
        aspect: f64,
        camera: &mut Camera,
    ) -> Result<[f64; 4], SceneError> {
        let half_width = half_width(element, aspect)?;
        // Screen coordinates of +-1 belong to the shorter side.
        let shorter = if aspect > 1.0 {
            half_width / aspect
        } else {
            half_width
        };
        camera.projection = Projection::Perspective {
            fov_deg: 2.0 * shorter.atan().to_degrees(),
        };
        let (w, h) = if aspect > 1.0 {
            (aspect, 1.0)
        } else {
            (1.0, 1.0 / aspect)
        };
        // In shares of the picture; the view moves against the principal point.
        let dx = 2.0 * w * element.number("principal_point_offset_x", 0.0)?;
        let dy = 2.0 * h * element.number("principal_point_offset_y", 0.0)?;
        Ok([-w + dx, w + dx, -h - dy, h - dy])
    }
}

/// Tangent of half the horizontal field of view.
pub(super) fn half_width(element: &Element, aspect: f64) -> Result<f64, SceneError> {
    let (fov_deg, axis) = if element.has("fov") {
        let axis = element.text("fov_axis")?.unwrap_or("x");
        (
            element.above_zero("fov", 50.0)?,
            axis.trim().to_ascii_lowercase(),
        )
    } else {
        // Equivalent to 35 mm film, over its diagonal.
        let text = element.text("focal_length")?.unwrap_or("50mm").trim();
        let millimetres = number(text.strip_suffix("mm").unwrap_or(text))
            .ok()
            .filter(|x| *x > 0.0)
            .ok_or_else(|| {
                bad_choice(element, "focal_length", text, "a length such as \"50mm\"")
            })?;
        let diagonal = (36.0_f64 * 36.0 + 24.0 * 24.0).sqrt();
        element.ignore(&["fov_axis"]);
        (
            2.0 * (diagonal / (2.0 * millimetres)).atan().to_degrees(),
            "diagonal".to_owned(),
        )
    };
    let tangent = (0.5 * fov_deg.to_radians()).tan();
    let wide = aspect > 1.0;
    let half_width = match axis.as_str() {
        "x" => tangent,
        "y" => tangent * aspect,
        "smaller" if wide => tangent * aspect,
        "larger" if !wide => tangent * aspect,
        "smaller" | "larger" => tangent,
        "diagonal" => tangent / (1.0 + 1.0 / (aspect * aspect)).sqrt(),
        other => {
            return Err(bad_choice(
                element,
                "fov_axis",
                other,
                "x, y, diagonal, smaller or larger",
            ));
        }
    };
    if fov_deg < 180.0 && half_width > 0.0 && half_width.is_finite() {
        return Ok(half_width);
    }
    Err(element.error(format!(
        "\"fov\": expected an angle between 0 and 180 degrees, found {fov_deg}"
    )))
}
