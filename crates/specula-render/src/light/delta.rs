//! Lights without extent: parallel, point, spot, and those that project images.

use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{Light, SpotFalloff};

use super::cone::EmissionCone;
use super::projected::ProjectedImage;
use crate::codes;
use crate::convert::{narrow, narrow3};
use crate::texture::Textures;
use crate::words::Words;

/// A light without extent: only light sampling can reach it.
#[derive(Clone, Debug)]
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
        falloff: SpotFalloff,
    },
    ProjectedImage(Box<ProjectedImage>),
}

/// Below every cosine: no cone.
const NO_CONE: f32 = -2.0;

impl Delta {
    /// `None` for infinite lights and suns.
    pub(crate) fn new(light: &Light, textures: &Textures) -> Option<Self> {
        match *light {
            Light::Infinite { .. } | Light::Portal { .. } => None,
            Light::Distant { half_angle_deg, .. } if half_angle_deg > 0.0 => None,
            Light::Distant {
                irradiance,
                to_light,
                half_angle_deg: _,
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
                falloff: SpotFalloff::SmoothCosine,
            }),
            Light::Spot {
                position,
                axis,
                intensity,
                cone_angle_deg,
                falloff_start_deg,
                falloff,
            } => Some(Self::Point {
                position: narrow3(position.into()),
                axis: narrow3(axis.into()).normalize(),
                intensity,
                cos_cone: narrow(cone_angle_deg.to_radians().cos()),
                cos_start: narrow(falloff_start_deg.min(cone_angle_deg).to_radians().cos()),
                falloff,
            }),
            Light::Picture {
                ref to_world,
                intensity,
                ref image_projection,
            } => {
                let projected =
                    ProjectedImage::new(to_world, intensity, image_projection, textures);
                Some(Self::ProjectedImage(Box::new(projected)))
            }
        }
    }

    /// Irradiance on a surface at `p` that faces the light, the direction to it, and its place.
    #[inline]
    pub(crate) fn illuminate(
        &self,
        p: Vec3<f32>,
        textures: &Textures,
    ) -> (Rgb<f32>, Vec3<f32>, Option<Vec3<f32>>) {
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
                falloff,
            } => {
                let d = position - p;
                let distance_squared = d.length_squared();
                let wi = d * (1.0 / distance_squared.sqrt());
                let falloff = share(falloff, [cos_cone, cos_start], -axis.dot(wi));
                (intensity * (falloff / distance_squared), wi, Some(position))
            }
            Self::ProjectedImage(ref projected) => {
                let d = projected.position - p;
                let distance_squared = d.length_squared();
                let wi = d * (1.0 / distance_squared.sqrt());
                let intensity = projected.intensity(-wi, textures);
                let irradiance = intensity * (1.0 / distance_squared);
                (irradiance, wi, Some(projected.position))
            }
        }
    }

    /// Kind and parameters, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        match *self {
            Self::Distant {
                irradiance,
                to_light,
            } => {
                to.id(codes::DELTA_DISTANT);
                to.colour(irradiance);
                to.vector(to_light);
            }
            Self::Point {
                position,
                axis,
                intensity,
                cos_cone,
                cos_start,
                falloff,
            } => {
                to.id(codes::DELTA_POINT);
                to.vector(position);
                to.vector(axis);
                to.colour(intensity);
                to.floats([cos_cone, cos_start]);
                to.id(match falloff {
                    SpotFalloff::SmoothCosine => codes::SPOT_SMOOTH_COSINE,
                    SpotFalloff::LinearAngle => codes::SPOT_LINEAR_ANGLE,
                    SpotFalloff::SquaredCosine => codes::SPOT_SQUARED_COSINE,
                });
            }
            Self::ProjectedImage(ref projected) => {
                to.id(codes::DELTA_PROJECTED);
                projected.flatten(to);
            }
        }
    }

    /// Largest intensity in luminance, of a picture the mean; of a distant light, the irradiance.
    pub(crate) fn strength(&self) -> f64 {
        let colour = match self {
            Self::Distant { irradiance, .. } => irradiance,
            Self::Point { intensity, .. } => intensity,
            Self::ProjectedImage(projected) => return projected.mean,
        };
        f64::from(colour.luminance().max(colour.mean()))
    }

    /// TextureCoordinates, and bound on the directions; `None` at infinity.
    pub(super) fn bounds(&self) -> Option<(Vec3<f32>, EmissionCone)> {
        match *self {
            Self::Distant { .. } => None,
            Self::ProjectedImage(ref projected) => Some((projected.position, projected.cone())),
            Self::Point {
                position,
                cos_cone: NO_CONE,
                ..
            } => Some((position, EmissionCone::SPHERE)),
            Self::Point {
                position,
                axis,
                cos_cone,
                cos_start,
                ..
            } => {
                let theta_o = f64::from(cos_start).clamp(-1.0, 1.0).acos();
                let end = f64::from(cos_cone).clamp(-1.0, 1.0).acos();
                let cone = EmissionCone {
                    axis: axis.cast(),
                    theta_o,
                    theta_e: (end - theta_o).max(0.0),
                    two_sided: false,
                };
                Some((position, cone))
            }
        }
    }
}

/// Share of a spot light's intensity at the cosine `x` from its axis: 0 up to `low`, 1 from `high` on.
#[inline]
pub(super) fn share(falloff: SpotFalloff, [low, high]: [f32; 2], x: f32) -> f32 {
    if x >= high {
        return 1.0;
    }
    if x <= low {
        return 0.0;
    }
    let t = (x - low) / (high - low);
    match falloff {
        SpotFalloff::SmoothCosine => t * t * (3.0 - 2.0 * t),
        SpotFalloff::LinearAngle => {
            let [end, start, at] = [low, high, x].map(|c| c.clamp(-1.0, 1.0).acos());
            (end - at) / (end - start)
        }
        SpotFalloff::SquaredCosine => t * t,
    }
}
