//! Lights that are not shapes.

use glam::DMat4;
use specula_bsdf::Rgb;

use super::{ColourParam, ImageId};

/// How a picture covers the sphere of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentMapping {
    /// Equal-area octahedral square (Clarberg 2008), as pbrt-v4 does; +z is the centre of the
    /// square, -z its corners. With `(x, y)` in `[0, 1]^2` over the stored picture, x to the right
    /// and y *down* from the first row (no flip here), `u = 2x - 1`, `v = 2y - 1`,
    /// `d = 1 - |u| - |v|`, `r = 1 - |d|`, `phi = (pi/4) ((|v| - |u|)/r + 1)`:
    /// `direction = (sgn(u) cos(phi) r sqrt(2 - r^2), sgn(v) sin(phi) r sqrt(2 - r^2), sgn(d) (1 - r^2))`.
    EqualAreaOctahedral,
    /// Latitude and longitude; z is the pole, the first row is at +z, u runs with the azimuth.
    LatitudeLongitude,
    /// The same, but the first and the last row lie on the poles: row `i` of `n` is at the polar
    /// angle `pi i / (n - 1)` (Mitsuba).
    LatitudeLongitudePoles,
}

/// A light that is not a shape. Powers, scales and filters of the file are folded in.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// An environment light: radiance from every direction.
    Infinite {
        /// Radiance, or factor on the picture.
        radiance: Rgb<f32>,
        /// Picture of the sphere of directions.
        image: Option<(ImageId, EnvironmentMapping)>,
        /// Light space to world space (only directions matter).
        to_world: DMat4,
    },
    /// An environment light that is seen through a portal alone, a rectangle: from where the ray through it
    /// begins on one side, in directions to the other.
    Portal {
        /// Radiance, or factor on the picture.
        radiance: Rgb<f32>,
        /// Picture of the sphere of directions.
        image: Option<(ImageId, EnvironmentMapping)>,
        /// Light space to world space (only directions matter).
        to_world: DMat4,
        /// Corners in the world, one after the other; light comes from the side of
        /// `(p3 - p0) x (p1 - p0)`.
        corners: [[f64; 3]; 4],
    },
    /// Parallel light, or a small round light infinitely far away (the sun).
    Distant {
        /// Irradiance on a surface that faces it.
        irradiance: Rgb<f32>,
        /// Unit vector in the world, from the scene to the light.
        to_light: [f64; 3],
        /// Half the angle that it fills, in degrees, in `[0, 90)`; 0 for parallel light.
        half_angle_deg: f64,
    },
    /// A point light.
    Point {
        /// Its position.
        position: [f64; 3],
        /// Radiant intensity, per steradian.
        intensity: Rgb<f32>,
    },
    /// A spot light.
    Spot {
        /// Its position.
        position: [f64; 3],
        /// Unit vector along the axis of the cone.
        axis: [f64; 3],
        /// Intensity along the axis.
        intensity: Rgb<f32>,
        /// Half angle of the cone, in degrees.
        cone_angle_deg: f64,
        /// Half angle within which the intensity is whole.
        falloff_start_deg: f64,
        /// How it falls to 0 between the two.
        falloff: SpotFalloff,
    },
    /// A projector: a point light whose intensity is an image by direction.
    Picture {
        /// Light space to world space: the light is at its origin. Lengths do not matter.
        to_world: DMat4,
        /// Intensity: a texture at the coordinates that `image_projection` gives.
        intensity: ColourParam,
        /// The projection of the picture.
        image_projection: ImageProjection,
    },
}

/// The projection of a light's picture, as `(s, t)` with the origin at the lower left, by the
/// direction `(x, y, z)` in light space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImageProjection {
    /// In all directions: [`EnvironmentMapping::EqualAreaOctahedral`], so that s is its x and t
    /// its 1 - y (pbrt's `goniometric`).
    Sphere,
    /// Through a window about +z, `s = (x / (z half[0]) + 1) / 2`, `t` in the same way from y;
    /// dark elsewhere.
    Window {
        /// Half width and half height at the distance 1.
        half: [f64; 2],
        /// The factor on the picture.
        profile: Profile,
    },
}

/// The factor on a picture that is projected through a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// It is the radiant intensity (pbrt's `projection`).
    Intensity,
    /// It is the irradiance at the distance 1 along z: `1 / cos^3` (Mitsuba's `projector`).
    Irradiance,
    /// A spot light's, linear in the angle (Mitsuba's `spot` with a texture).
    Spot {
        /// Half angle of the cone, in degrees, below 90.
        cone_angle_deg: f64,
        /// Half angle within which the intensity is whole.
        falloff_start_deg: f64,
    },
}

/// How a spot light's intensity falls between its two angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpotFalloff {
    /// Smoothstep in the cosine (pbrt).
    SmoothCosine,
    /// Linear in the angle (Mitsuba).
    LinearAngle,
    /// The square of a linear ramp in the cosine (glTF).
    SquaredCosine,
}
