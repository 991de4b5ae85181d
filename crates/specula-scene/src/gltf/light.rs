//! Lights of `KHR_lights_punctual`, which point along -z of their node.

use glam::{DMat4, DVec3};
use gltf::khr_lights_punctual::Kind;
use specula_bsdf::Rgb;

use super::Reader;
use crate::scene::{Light, SpotFalloff};

impl Reader<'_> {
    pub(super) fn light(&mut self, light: &gltf::khr_lights_punctual::Light<'_>, place: &DMat4) {
        let position = place.transform_point3(DVec3::ZERO).to_array();
        let Some(axis) = place.transform_vector3(DVec3::NEG_Z).try_normalize() else {
            return self.warn("a light without a direction is left out");
        };
        if light.range().is_some() {
            self.warn("lights reach beyond their range, as light does");
        }
        let strength = light.intensity().max(0.0);
        let intensity = Rgb::from(light.color().map(|x| x.max(0.0))) * strength;
        self.lights.push(match light.kind() {
            Kind::Directional => Light::Distant {
                irradiance: intensity,
                to_light: (-axis).to_array(),
                half_angle_deg: 0.0,
            },
            Kind::Point => Light::Point {
                position,
                intensity,
            },
            Kind::Spot {
                inner_cone_angle,
                outer_cone_angle,
            } => {
                let outer = f64::from(outer_cone_angle).to_degrees().clamp(0.1, 90.0);
                Light::Spot {
                    position,
                    axis: axis.to_array(),
                    intensity,
                    cone_angle_deg: outer,
                    falloff_start_deg: f64::from(inner_cone_angle).to_degrees().clamp(0.0, outer),
                    falloff: SpotFalloff::SquaredCosine,
                }
            }
        });
    }
}
