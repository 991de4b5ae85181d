//! A camera, light and a floor for files that have none; y is up.

mod floor;

use glam::{DMat4, DVec3, DVec4};
use specula_bsdf::Rgb;

use crate::bounds::BoundingBox;
use crate::builtin;
use crate::scene::{Camera, EnvironmentMapping, Film, Filter, ImageId, Light, Projection, Scene};

/// Field of view of the framing camera, over the shorter side.
const FOV_DEG: f64 = 30.0;

/// A film of a size, with a narrow filter.
pub(crate) fn film(resolution: [u32; 2]) -> Film {
    let filter = Filter::Gaussian {
        radius: [1.5; 2],
        sigma: 0.5,
    };
    Film::new(resolution, filter)
}

/// A camera that sees all of `bounds` from the front, a little from the right and from above.
pub(crate) fn camera(bounds: BoundingBox, resolution: [u32; 2]) -> Camera {
    let (centre, radius) = if bounds.is_empty() {
        (DVec3::ZERO, 1.0)
    } else {
        (bounds.centre(), bounds.radius().max(f64::MIN_POSITIVE))
    };
    let from = DVec3::new(0.5, 0.35, 1.0).normalize();
    let distance = radius / (0.5 * FOV_DEG.to_radians()).sin();
    let forward = -from;
    let right = forward.cross(DVec3::Y).normalize();
    let mut camera = Camera {
        to_world: DMat4::from_cols(
            right.extend(0.0),
            right.cross(forward).extend(0.0),
            forward.extend(0.0),
            (centre + from * distance).extend(1.0),
        ),
        motion: None,
        projection: Projection::Perspective { fov_deg: FOV_DEG },
        lens_radius: 0.0,
        focal_distance: distance,
        screen_window: [0.0; 4],
    };
    fit_screen(&mut camera, resolution);
    camera
}

/// The screen window in which the picture's shorter side spans `[-1, 1]`, for perspective.
pub(crate) fn fit_screen(camera: &mut Camera, [width, height]: [u32; 2]) {
    if let Projection::Perspective { .. } = camera.projection {
        let aspect = f64::from(width) / f64::from(height);
        let (x, y) = (aspect.max(1.0), aspect.recip().max(1.0));
        camera.screen_window = [-x, x, -y, y];
    }
}

/// The studio's axes in the world: it has z up and is seen from -y; here y is up and the view is
/// from +z.
const Z_UP: DMat4 = DMat4::from_cols(
    DVec4::X,
    DVec4::new(0.0, 0.0, -1.0, 0.0),
    DVec4::Y,
    DVec4::W,
);

/// What [`light`] added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AddedLight {
    /// The environment light alone.
    Alone,
    /// The environment light, and a floor that receives the object's shadow.
    OverFloor,
}

/// Adds the built-in studio's environment light, its front towards the framing camera, and a floor under what the
/// scene shows, unless its camera looks from below.
///
/// The floor's radiance equals that of the horizon behind it, and of all directions below, so that
/// it has no visible rim. It is much wider than the object: the size of the scene is that of
/// `bounds`, which the caller computes before.
pub(crate) fn light(scene: &mut Scene, bounds: BoundingBox) -> AddedLight {
    scene
        .images
        .push(builtin::studio_above_floor(f64::from(floor::ALBEDO)));
    scene.lights.push(Light::Infinite {
        radiance: Rgb::WHITE,
        image: Some((
            ImageId(scene.images.len() - 1),
            EnvironmentMapping::LatitudeLongitude,
        )),
        to_world: Z_UP,
    });
    let eye = scene.camera.to_world.w_axis.y;
    match floor::under(scene, bounds) {
        Some((material, shape)) if eye > shape.to_world.w_axis.y => {
            scene.floor = Some(shape.material);
            scene.materials.push(material);
            scene.shapes.push(shape);
            AddedLight::OverFloor
        }
        _ => AddedLight::Alone,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_framing_camera_sees_every_corner() {
        let bounds = BoundingBox {
            min: DVec3::new(-3.0, 0.0, 2.0),
            max: DVec3::new(5.0, 1.0, 9.0),
        };
        for resolution in [[1280, 720], [300, 900]] {
            let camera = camera(bounds, resolution);
            let inverse = camera.to_world.inverse();
            let spread = (0.5 * FOV_DEG.to_radians()).tan();
            let [x0, x1, y0, y1] = camera.screen_window;
            for i in 0..8 {
                let pick =
                    |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
                let corner = DVec3::new(
                    pick(0, bounds.min.x, bounds.max.x),
                    pick(1, bounds.min.y, bounds.max.y),
                    pick(2, bounds.min.z, bounds.max.z),
                );
                let p = inverse.transform_point3(corner);
                let (x, y) = (p.x / p.z / spread, p.y / p.z / spread);
                assert!(p.z > 0.0 && x0 <= x && x <= x1 && y0 <= y && y <= y1, "{p}");
            }
        }
    }
}
