//! Point, distant and environment lights, to be added to a scene.

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_scene::Scene;
use specula_scene::scene::{ImageId, Light};

/// One of the lights of a scene that is lit in several ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lighting {
    /// The built-in studio, all around, times a factor.
    Studio(f32),
    /// Parallel light from a direction, with the irradiance on a surface that faces it.
    Parallel(DVec3, f32),
    /// A point with its radiant intensity.
    Point(DVec3, f32),
}

impl Lighting {
    /// Adds it to a scene.
    pub(crate) fn add_to(self, scene: &mut Scene) {
        let light = match self {
            Self::Studio(factor) => return studio(scene, factor),
            Self::Parallel(to_light, irradiance) => Light::Distant {
                irradiance: Rgb::splat(irradiance),
                to_light: to_light.normalize().to_array(),
                half_angle_deg: 0.0,
            },
            Self::Point(position, intensity) => Light::Point {
                position: position.to_array(),
                intensity: Rgb::splat(intensity),
            },
        };
        scene.lights.push(light);
    }
}

/// The environment of the built-in scene.
fn studio(scene: &mut Scene, factor: f32) {
    let built_in = specula_scene::builtin::orbs();
    for light in &built_in.lights {
        if let Light::Infinite {
            image: Some((ImageId(image), mapping)),
            ..
        } = light
        {
            scene.images.push(built_in.images[*image].clone());
            scene.lights.push(Light::Infinite {
                radiance: Rgb::splat(factor),
                image: Some((ImageId(scene.images.len() - 1), *mapping)),
                to_world: DMat4::IDENTITY,
            });
        }
    }
}
