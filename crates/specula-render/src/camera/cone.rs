//! The cones of a camera's pixels.

use core::f32::consts::PI;

use specula_bsdf::math::vec3;
use specula_scene::scene::EnvironmentMapping;

use super::{Camera, View, within_sphere};
use crate::convert::Affine;
use crate::ray_cone::RayCone;

impl Camera {
    /// The cone of a whole pixel around the ray through a point of the raster: a circle of the pixel's radius, whose
    /// square is the area, or the solid angle, by which a step right and a step down differ.
    ///
    /// With `v` the image of `(x, y, 1)`, the solid angle of a perspective camera's pixel is
    /// `|det M| dx dy / |v|^3`. A circle stands for the ellipse that a pixel next to the picture's border is.
    ///
    /// * `time`: of the ray, in exposures.
    pub(crate) fn cone(&self, time: f32, raster: [f32; 2]) -> RayCone {
        let moving = (self.movement.as_ref()).map(|movement| Affine::new(&movement.at(time)));
        let to_world = moving.as_ref().unwrap_or(&self.to_world);
        let [a, b, c] = to_world.columns;
        let pixel = (self.step[0] * self.step[1]).abs();
        let x = self.origin[0] + raster[0] * self.step[0];
        let y = self.origin[1] + raster[1] * self.step[1];
        let solid_angle = match &self.view {
            View::Perspective => {
                let length = to_world.vector(vec3(x, y, 1.0)).length();
                a.cross(b).dot(c).abs() * pixel / (length * length * length)
            }
            View::Lenses(lenses) => {
                // What is in focus: the pixel through the middle of the pupil.
                let (chief, spread) = lenses.chief([-x, -y]);
                let length = to_world.vector(chief).length();
                let turned = a.cross(b).dot(c).abs() / (length * length * length);
                turned * pixel * spread * spread
            }
            View::Orthographic => {
                return RayCone {
                    radius: (a.cross(b).length() * pixel).sqrt(),
                    spread: 0.0,
                };
            }
            View::Spherical(mapping) => {
                let [_, v] = within_sphere(*mapping, [x, y]);
                match mapping {
                    EnvironmentMapping::EqualAreaOctahedral => 4.0 * PI * pixel,
                    EnvironmentMapping::LatitudeLongitude
                    | EnvironmentMapping::LatitudeLongitudePoles => {
                        2.0 * PI * PI * (PI * v).sin().abs() * pixel
                    }
                }
            }
        };
        RayCone {
            radius: 0.0,
            spread: solid_angle.sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DVec3};
    use specula_scene::scene::{self, Projection};

    /// Solid angles and areas against the differences of neighbouring rays.
    #[test]
    fn cones_have_the_size_of_pixels() {
        let moved = DMat4::from_translation(DVec3::new(3.0, 1.0, -2.0))
            * DMat4::from_rotation_y(0.7)
            * DMat4::from_scale(DVec3::splat(2.5));
        for projection in [
            Projection::Perspective { fov_deg: 75.0 },
            Projection::Orthographic,
            Projection::Spherical(EnvironmentMapping::EqualAreaOctahedral),
            Projection::Spherical(EnvironmentMapping::LatitudeLongitude),
        ] {
            let file = scene::Camera {
                to_world: moved,
                motion: None,
                projection: projection.clone(),
                lens_radius: 0.0,
                focal_distance: 4.0,
                screen_window: [-2.0, 2.0, -1.0, 1.0],
            };
            let camera = Camera::new(&file, [200, 100], file.screen_window);
            for [x, y] in [[90.0, 47.0], [30.0, 81.0], [190.5, 8.5]] {
                let ray = |x: f32, y: f32| camera.ray([x, y], [0.5; 2]);
                let step = 0.25;
                let across = |dx: f32, dy: f32| {
                    let (o0, d0) = ray(x - dx, y - dy);
                    let (o1, d1) = ray(x + dx, y + dy);
                    let scale = 1.0 / (2.0 * (dx + dy));
                    [(o1 - o0) * scale, (d1 - d0) * scale]
                };
                let ([ox, dx], [oy, dy]) = (across(step, 0.0), across(0.0, step));
                let cone = camera.cone(0.0, [x, y]);
                let radius = ox.cross(oy).length().sqrt();
                let spread = dx.cross(dy).length().sqrt();
                assert!(
                    (cone.radius - radius).abs() < 1e-3 * radius + 1e-6,
                    "{projection:?}"
                );
                assert!(
                    (cone.spread - spread).abs() < 0.01 * spread + 1e-6,
                    "{projection:?} {x} {y}: {} and {spread}",
                    cone.spread
                );
            }
        }
    }
}
