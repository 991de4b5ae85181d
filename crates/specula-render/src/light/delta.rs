//! Lights without extent: distant, point and spot.

use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::Light;

use crate::convert::{narrow, narrow3};

/// A light that only its own sampling can find.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Delta {
    Distant {
        irradiance: Rgb<f32>,
        to_light: Vec3<f32>,
    },
    /// A point; a whole sphere of directions where `cos_cone` is -2.
    Point {
        position: Vec3<f32>,
        axis: Vec3<f32>,
        intensity: Rgb<f32>,
        cos_cone: f32,
        cos_start: f32,
    },
}

/// Below every cosine: no cone.
const NO_CONE: f32 = -2.0;

impl Delta {
    /// `None` for infinite lights.
    pub(crate) fn new(light: &Light) -> Option<Self> {
        match *light {
            Light::Infinite { .. } => None,
            Light::Distant {
                irradiance,
                to_light,
            } => Some(Self::Distant {
                irradiance,
                to_light: narrow3(to_light.into()).normalize(),
            }),
            Light::Point {
                position,
                intensity,
            } => Some(Self::Point {
                position: narrow3(position.into()),
                axis: Vec3::Z,
                intensity,
                cos_cone: NO_CONE,
                cos_start: NO_CONE,
            }),
            Light::Spot {
                position,
                axis,
                intensity,
                cone_angle_deg,
                falloff_start_deg,
            } => Some(Self::Point {
                position: narrow3(position.into()),
                axis: narrow3(axis.into()).normalize(),
                intensity,
                cos_cone: narrow(cone_angle_deg.to_radians().cos()),
                cos_start: narrow(falloff_start_deg.min(cone_angle_deg).to_radians().cos()),
            }),
        }
    }

    /// Irradiance on a surface at `p` that faces the light, the direction to it, and its place.
    #[inline]
    pub(crate) fn illuminate(&self, p: Vec3<f32>) -> (Rgb<f32>, Vec3<f32>, Option<Vec3<f32>>) {
        match *self {
            Self::Distant {
                irradiance,
                to_light,
            } => (irradiance, to_light, None),
            Self::Point {
                position,
                axis,
                intensity,
                cos_cone,
                cos_start,
            } => {
                let d = position - p;
                let distance_squared = d.length_squared();
                let wi = d * (1.0 / distance_squared.sqrt());
                let falloff = smoothstep(cos_cone, cos_start, -axis.dot(wi));
                (intensity * (falloff / distance_squared), wi, Some(position))
            }
        }
    }

    /// Emitted power in luminance; of a distant light, what meets a disk of radius `scene_radius`.
    pub(crate) fn power(&self, scene_radius: f64) -> f64 {
        use core::f64::consts::PI;
        let (colour, factor) = match *self {
            Self::Distant { irradiance, .. } => (irradiance, PI * scene_radius * scene_radius),
            Self::Point {
                intensity,
                cos_cone: NO_CONE,
                ..
            } => (intensity, 4.0 * PI),
            // The mean of the smoothstep over its range is 1/2.
            Self::Point {
                intensity,
                cos_cone,
                cos_start,
                ..
            } => (
                intensity,
                2.0 * PI * (1.0 - 0.5 * f64::from(cos_cone + cos_start)),
            ),
        };
        f64::from(colour.luminance().max(colour.mean())) * factor
    }
}

/// 0 below `low`, 1 from `high` on, smooth between.
#[inline]
fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    if x >= high {
        return 1.0;
    }
    if x <= low {
        return 0.0;
    }
    let t = (x - low) / (high - low);
    t * t * (3.0 - 2.0 * t)
}
