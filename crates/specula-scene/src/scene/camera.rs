//! Camera and film.

use glam::{DMat4, DVec3};

use super::lens::LensSystem;
use super::light::EnvironmentMapping;
use super::motion::Motion;

/// A camera with a thin lens, or with real ones.
///
/// Camera space is pbrt's: the view direction is +z, +y is up and +x is right in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Camera space to world space.
    pub to_world: DMat4,
    /// How it moves from there; `None` where it does not.
    pub motion: Option<Motion>,
    /// The projection onto the picture.
    pub projection: Projection,
    /// Radius of the lens, in scene units; 0 for a pinhole. Spherical pictures and [`Projection::Lenses`] have none.
    pub lens_radius: f64,
    /// Distance along +z to the plane in focus, in scene units.
    pub focal_distance: f64,
    /// Bounds of the picture plane in screen space, `[x0, x1, y0, y1]`; the shorter side spans
    /// `[-1, 1]` unless the file says otherwise. Of [`Projection::Lenses`] only the aspect counts.
    pub screen_window: [f64; 4],
}

impl Camera {
    /// A pinhole camera, in focus at `target`.
    ///
    /// * `up`: upwards in the picture; not along the view direction.
    /// * `fov_deg`: field of view over the shorter side of the picture, in degrees, in (0, 180).
    #[must_use]
    pub fn look_at(eye: DVec3, target: DVec3, up: DVec3, fov_deg: f64, film: &Film) -> Self {
        let [width, height] = film.resolution.map(f64::from);
        let forward = (target - eye).normalize();
        let right = forward.cross(up).normalize();
        let to_world = DMat4::from_cols(
            right.extend(0.0),
            right.cross(forward).extend(0.0),
            forward.extend(0.0),
            eye.extend(1.0),
        );
        let aspect = width / height;
        let [x, y] = [aspect.max(1.0), (1.0 / aspect).max(1.0)];
        Self {
            to_world,
            motion: None,
            projection: Projection::Perspective { fov_deg },
            lens_radius: 0.0,
            focal_distance: (target - eye).length(),
            screen_window: [-x, x, -y, y],
        }
    }
}

/// A projection of camera space onto the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// Rays leave from one point.
    Perspective {
        /// Angle over which screen coordinates span `[-1, 1]`, in degrees, in (0, 180).
        fov_deg: f64,
    },
    /// Parallel rays along +z; screen coordinates are scene units.
    Orthographic,
    /// Every direction: the picture is a map of the sphere about the camera. Camera space has +z
    /// where maps have their pole.
    Spherical(EnvironmentMapping),
    /// Through lenses; samples are irradiances of the film.
    Lenses(Box<LensSystem>),
}

/// The picture's size, crop and filter.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Width and height of the whole picture in pixels.
    pub resolution: [u32; 2],
    /// Pixels that are rendered, `[x0, x1, y0, y1]`, half open.
    pub crop: [u32; 4],
    /// Reconstruction filter.
    pub filter: Filter,
    /// Factor from radiance to picture values (pbrt: exposure time * iso / 100).
    pub exposure: f32,
    /// Largest component of an exposed sample: brighter samples are scaled down to it (pbrt's
    /// `maxcomponentvalue`).
    pub max_component: Option<f32>,
    /// White balance of exposed linear RGB: rows of a matrix, [`Film::NO_BALANCE`] for none.
    pub balance: [[f32; 3]; 3],
    /// File name that the scene asks for.
    pub file_name: Option<String>,
}

impl Film {
    /// The identity: no white balance.
    pub const NO_BALANCE: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// A film of linear radiance: no crop, exposure 1, no white balance.
    #[must_use]
    pub fn new(resolution: [u32; 2], filter: Filter) -> Self {
        let [width, height] = resolution;
        Self {
            resolution,
            crop: [0, width, 0, height],
            filter,
            exposure: 1.0,
            max_component: None,
            balance: Self::NO_BALANCE,
            file_name: None,
        }
    }
}

/// A separable reconstruction filter; radii in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// Constant.
    Box {
        /// Half width and half height.
        radius: [f32; 2],
    },
    /// Linear.
    Triangle {
        /// Half width and half height.
        radius: [f32; 2],
    },
    /// Gaussian, zero at its radius.
    Gaussian {
        /// Half width and half height.
        radius: [f32; 2],
        /// Standard deviation in pixels.
        sigma: f32,
    },
    /// Mitchell and Netravali 1988.
    Mitchell {
        /// Half width and half height.
        radius: [f32; 2],
        /// Their B.
        b: f32,
        /// Their C.
        c: f32,
    },
    /// Sinc windowed by a sinc.
    LanczosSinc {
        /// Half width and half height.
        radius: [f32; 2],
        /// Cycles of the sinc before it is zero.
        tau: f32,
    },
}
