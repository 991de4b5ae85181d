//! Pictures that a light projects from a point.

use core::f64::consts::PI;

use glam::{DMat3, DMat4, DVec3};
use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{ColourParam, ImageProjection, Profile, SpotFalloff};

use super::cone::EmissionCone;
use super::delta::share;
use super::octahedral::{direction_of, square_of};
use crate::codes;
use crate::convert::{Affine, narrow, narrow3};
use crate::layout;
use crate::texture::{TextureCoordinates, Textures, colour_parameter};
use crate::words::Words;

/// Cells along each side of a picture over which its brightness is averaged.
const CELLS: u32 = 256;

/// A picture and where it goes: see [`ImageProjection`].
#[derive(Clone, Debug)]
pub(super) struct ProjectedImage {
    pub(super) position: Vec3<f32>,
    /// +z of the light in the world.
    axis: Vec3<f32>,
    to_light: Affine,
    intensity: ColourParam,
    window: Option<Window>,
    /// Largest angle between its directions and the axis.
    reach_rad: f64,
    /// Mean intensity in luminance over the directions that it goes to.
    pub(super) mean: f64,
}

#[derive(Clone, Copy, Debug)]
struct Window {
    half: [f32; 2],
    profile: Beside,
}

/// [`Profile`] in single precision; the cosines at the end of a spot and at its start.
#[derive(Clone, Copy, Debug)]
enum Beside {
    Intensity,
    Irradiance,
    Spot([f32; 2]),
}

impl ProjectedImage {
    pub(super) fn new(
        to_world: &DMat4,
        intensity: ColourParam,
        image_projection: &ImageProjection,
        textures: &Textures,
    ) -> Self {
        let linear = DMat3::from_mat4(*to_world);
        let (window, reach_rad) = match image_projection {
            ImageProjection::Sphere => (None, PI),
            ImageProjection::Window { half, profile } => {
                (Some(Window::new(*half, profile)), reach(&linear, *half))
            }
        };
        let mut light = Self {
            position: narrow3(to_world.w_axis.truncate()),
            axis: narrow3(linear.z_axis.normalize()),
            to_light: Affine::linear(&linear.inverse()),
            intensity: textures.fold_colour(intensity),
            window,
            reach_rad,
            mean: 0.0,
        };
        light.mean = light.mean_luminance(textures);
        // Cells may miss all that is bright; a light of no strength would never be asked.
        let dark = matches!(light.intensity, ColourParam::Value(c) if c.is_black());
        if light.mean <= 0.0 && !dark {
            light.mean = 1.0;
        }
        light
    }

    /// Radiant intensity towards `w` (unit, world).
    #[inline]
    pub(super) fn intensity(&self, w: Vec3<f32>, textures: &Textures) -> Rgb<f32> {
        self.towards(self.to_light.vector(w), textures)
    }

    /// Radiant intensity towards a direction in light space, of any length.
    fn towards(&self, w: Vec3<f32>, textures: &Textures) -> Rgb<f32> {
        let Some((uv, factor)) = self.coordinates(w) else {
            return Rgb::BLACK;
        };
        let place = TextureCoordinates {
            uv,
            ..TextureCoordinates::default()
        };
        let colour = textures.colour(self.intensity, &place);
        colour.map(|v| v.max(0.0)) * factor
    }

    /// The picture's coordinates, and the factor on it; `None` where it is dark.
    fn coordinates(&self, w: Vec3<f32>) -> Option<([f32; 2], f32)> {
        let Some(window) = self.window else {
            let [x, y] = square_of(w.normalize());
            return Some(([x, 1.0 - y], 1.0));
        };
        let uv = [w.x / window.half[0], w.y / window.half[1]].map(|t| 0.5 * (t / w.z + 1.0));
        let inside = w.z > 0.0 && uv.iter().all(|t| (0.0..=1.0).contains(t));
        if !inside {
            return None;
        }
        let cos = w.z / w.length();
        let factor = match window.profile {
            Beside::Intensity => 1.0,
            Beside::Irradiance => 1.0 / (cos * cos * cos),
            Beside::Spot(cosines) => share(SpotFalloff::LinearAngle, cosines, cos),
        };
        Some((uv, factor))
    }

    /// Parameters, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        let record = to.offset();
        to.vector(self.position);
        to.field(record, layout::PROJECTED_TO_LIGHT);
        to.affine(&self.to_light);
        let (through, half, cosines) = match self.window {
            None => (codes::WINDOW_NONE, [0.0; 2], [0.0; 2]),
            Some(Window { half, profile }) => match profile {
                Beside::Intensity => (codes::WINDOW_INTENSITY, half, [0.0; 2]),
                Beside::Irradiance => (codes::WINDOW_IRRADIANCE, half, [0.0; 2]),
                Beside::Spot(cosines) => (codes::WINDOW_SPOT, half, cosines),
            },
        };
        to.field(record, layout::PROJECTED_THROUGH);
        to.id(through);
        to.field(record, layout::PROJECTED_HALF);
        to.floats(half);
        to.field(record, layout::PROJECTED_COSINES);
        to.floats(cosines);
        to.field(record, layout::PROJECTED_INTENSITY);
        colour_parameter(to, self.intensity);
    }

    fn mean_luminance(&self, textures: &Textures) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for i in 0..CELLS * CELLS {
            let cell = [i % CELLS, i / CELLS].map(|k| (k as f32 + 0.5) / CELLS as f32);
            // Solid angles: equal over the sphere, cos^3 through a window.
            let (w, weight) = match self.window {
                None => (direction_of(cell), 1.0),
                Some(Window { half, .. }) => {
                    let at = |k: usize| (2.0 * cell[k] - 1.0) * half[k];
                    let w = vec3(at(0), at(1), 1.0);
                    (w, f64::from(w.length()).powi(-3))
                }
            };
            let colour = self.towards(w, textures);
            sum += weight * f64::from(colour.luminance().max(colour.mean()));
            weights += weight;
        }
        sum / weights
    }

    /// Bound on its directions.
    pub(super) fn cone(&self) -> EmissionCone {
        match self.window {
            None => EmissionCone::SPHERE,
            Some(_) => EmissionCone {
                axis: self.axis.cast(),
                theta_o: self.reach_rad,
                theta_e: 0.0,
                two_sided: false,
            },
        }
    }
}

impl Window {
    fn new(half: [f64; 2], profile: &Profile) -> Self {
        Self {
            half: half.map(narrow),
            profile: match *profile {
                Profile::Intensity => Beside::Intensity,
                Profile::Irradiance => Beside::Irradiance,
                Profile::Spot {
                    cone_angle_deg,
                    falloff_start_deg,
                } => Beside::Spot(
                    [cone_angle_deg, falloff_start_deg].map(|a| narrow(a.to_radians().cos())),
                ),
            },
        }
    }
}

/// Largest angle between +z and a corner of a window, in the world, and a little more for rounding.
fn reach(linear: &DMat3, [x, y]: [f64; 2]) -> f64 {
    let angle = |corner: DVec3| (*linear * corner).angle_between(linear.z_axis);
    [(x, y), (x, -y), (-x, y), (-x, -y)]
        .into_iter()
        .map(|(x, y)| angle(DVec3::new(x, y, 1.0)))
        .fold(0.0, f64::max)
        + 1e-3
}
