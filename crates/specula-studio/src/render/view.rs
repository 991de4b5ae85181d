//! A perspective camera as a page moves it: eye, target, up and field of view.

use glam::{DMat4, DVec3};
use serde::{Deserialize, Serialize};
use specula_scene::scene::{Camera, Film, Projection};

use crate::AskError;

/// Largest coordinate: rays are not followed farther.
const FARTHEST: f64 = 1e15;
/// Bounds of the field of view, in degrees.
const FIELD_OF_VIEW: [f64; 2] = [1e-3, 179.0];

/// Where a camera is, and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct View {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Over the shorter side of the picture.
    fov_degrees: f64,
}

impl View {
    /// The view of a camera; `None` of one without a perspective.
    ///
    /// * `distance`: to its target.
    pub(super) fn of(camera: &Camera, distance: f64) -> Option<Self> {
        let Projection::Perspective { fov_deg } = camera.projection else {
            return None;
        };
        let m = &camera.to_world;
        let [y, z] = [m.y_axis, m.z_axis].map(|a| a.truncate().normalize_or_zero());
        let eye = m.w_axis.truncate();
        let [x0, x1, y0, y1] = camera.screen_window;
        let half = 0.5 * (x1 - x0).abs().min((y1 - y0).abs());
        let spread = half * (0.5 * fov_deg.to_radians()).tan();
        Some(Self {
            eye: eye.to_array(),
            target: (eye + z * distance).to_array(),
            up: upright(y, z).to_array(),
            fov_degrees: 2.0 * spread.atan().to_degrees(),
        })
    }

    /// A camera of this view. It has the lens of `own`, and mirrors the world where that does.
    pub(super) fn camera(&self, own: &Camera, film: &Film) -> Result<Camera, AskError> {
        let vectors = [("eye", self.eye), ("target", self.target), ("up", self.up)];
        for (name, vector) in vectors {
            if !vector.iter().all(|x| x.abs() <= FARTHEST) {
                let most = format!("camera.{name}: expected coordinates up to {FARTHEST:e}");
                return Err(AskError::new(most));
            }
        }
        let [least, most] = FIELD_OF_VIEW;
        if !(least..=most).contains(&self.fov_degrees) {
            return Err(AskError::new(format!(
                "camera.fovDegrees: expected an angle in [{least}, {most}], got {}",
                self.fov_degrees
            )));
        }
        let [eye, target, up] = [self.eye, self.target, self.up].map(DVec3::from);
        let forward = (target - eye).try_normalize();
        let forward = forward.filter(|_| target != eye);
        let forward = forward.ok_or_else(|| AskError::new("camera.target: it is the eye"))?;
        let across = up.try_normalize().map(|up| forward.cross(up).length());
        if across.is_none_or(|across| across < 1e-9) {
            return Err(AskError::new(
                "camera.up: expected a vector across the view direction",
            ));
        }
        let mut camera = Camera::look_at(eye, target, up, self.fov_degrees, film);
        let m = &own.to_world;
        if m.determinant() > 0.0 {
            camera.to_world *= DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        }
        camera.lens_radius = own.lens_radius * m.x_axis.truncate().length();
        if own.lens_radius > 0.0 {
            camera.focal_distance = own.focal_distance * m.z_axis.truncate().length();
        }
        Ok(camera)
    }
}

/// The axis of the world that is upwards in the picture, where the camera does not lean to a side; else the camera's own.
///
/// * `y`, `z`: the camera's, unit.
fn upright(y: DVec3, z: DVec3) -> DVec3 {
    let x = y.cross(z);
    let axes = [DVec3::Z, DVec3::Y, DVec3::X];
    let all = axes.iter().flat_map(|&axis| [axis, -axis]);
    let upwards = all.filter(|a| a.dot(x).abs() < 1e-6 && a.dot(y) > 1e-3);
    upwards
        .max_by(|a, b| a.dot(y).total_cmp(&b.dot(y)))
        .unwrap_or(y)
}
