//! The perspective camera with a thin lens.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene;

use crate::convert::{Affine, narrow};

/// A camera for a picture of a certain size.
///
/// Raster x runs right and y down, from the upper left corner of the whole picture; camera space is
/// `+x` right, `+y` up, `+z` into the scene (left-handed, as in pbrt).
#[derive(Clone, Debug)]
pub(crate) struct Camera {
    to_world: Affine,
    /// Raster to the plane z = 1: `(x, y) = origin + raster * step`.
    origin: [f32; 2],
    step: [f32; 2],
    lens_radius: f32,
    focal_distance: f32,
}

impl Camera {
    /// A camera over `resolution` pixels.
    pub(crate) fn new(camera: &scene::Camera, resolution: [u32; 2], window: [f64; 4]) -> Self {
        let spread = (0.5 * camera.fov_deg.to_radians()).tan();
        let [x0, x1, y0, y1] = window.map(|v| v * spread);
        let to_world = Affine::new(&camera.to_world);
        Self {
            to_world,
            origin: [narrow(x0), narrow(y1)],
            step: [
                narrow((x1 - x0) / f64::from(resolution[0])),
                narrow((y0 - y1) / f64::from(resolution[1])),
            ],
            lens_radius: narrow(camera.lens_radius),
            focal_distance: narrow(camera.focal_distance),
        }
    }

    /// The ray through a point of the raster and of the lens: its origin and unit direction.
    #[inline]
    pub(crate) fn ray(&self, raster: [f32; 2], lens: [f32; 2]) -> (Vec3<f32>, Vec3<f32>) {
        let through = vec3(
            self.origin[0] + raster[0] * self.step[0],
            self.origin[1] + raster[1] * self.step[1],
            1.0,
        );
        if self.lens_radius > 0.0 && self.focal_distance > 0.0 {
            let d = concentric_disk(lens);
            let from = vec3(d[0] * self.lens_radius, d[1] * self.lens_radius, 0.0);
            let focus = through * self.focal_distance;
            return (
                self.to_world.point(from),
                self.to_world.vector(focus - from).normalize(),
            );
        }
        (
            self.to_world.translation,
            self.to_world.vector(through).normalize(),
        )
    }
}

/// A point of the unit disk, area-preserving and continuous.
///
/// Source: Shirley and Chiu 1997, in the branch-lean form of Cline (Shirley 2011).
#[inline]
pub(crate) fn concentric_disk(u: [f32; 2]) -> [f32; 2] {
    use core::f32::consts::{FRAC_PI_2, FRAC_PI_4};
    let a = 2.0 * u[0] - 1.0;
    let b = 2.0 * u[1] - 1.0;
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (r, phi) = if a * a > b * b {
        (a, FRAC_PI_4 * (b / a))
    } else {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    };
    [r * phi.cos(), r * phi.sin()]
}

/// The screen window for a new size: the file's own where it was no default, else the default of
/// the new aspect (the shorter side spans `[-1, 1]`).
pub(crate) fn screen_window(camera: &scene::Camera, file: [u32; 2], new: [u32; 2]) -> [f64; 4] {
    let default = |size: [u32; 2]| {
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        if aspect > 1.0 {
            [-aspect, aspect, -1.0, 1.0]
        } else {
            [-1.0, 1.0, -1.0 / aspect, 1.0 / aspect]
        }
    };
    let old = default(file);
    let unchanged = old
        .iter()
        .zip(&camera.screen_window)
        .all(|(a, b)| (a - b).abs() < 1e-4 * a.abs().max(1.0));
    if unchanged {
        default(new)
    } else {
        camera.screen_window
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;

    fn camera() -> scene::Camera {
        scene::Camera {
            to_world: DMat4::IDENTITY,
            fov_deg: 90.0,
            lens_radius: 0.0,
            focal_distance: 4.0,
            screen_window: [-2.0, 2.0, -1.0, 1.0],
        }
    }

    #[test]
    fn raster_runs_right_and_down_and_fov_spans_the_shorter_side() {
        let c = Camera::new(&camera(), [200, 100], [-2.0, 2.0, -1.0, 1.0]);
        let (_, corner) = c.ray([0.0, 0.0], [0.0; 2]);
        let (_, top) = c.ray([100.0, 0.0], [0.0; 2]);
        assert!(
            (corner.x / corner.z + 2.0).abs() < 1e-5 && (corner.y / corner.z - 1.0).abs() < 1e-5
        );
        assert!(top.x.abs() < 1e-5 && (top.y - top.z).abs() < 1e-5);
    }

    #[test]
    fn every_point_of_the_lens_sees_the_same_point_in_focus() {
        let lens = scene::Camera {
            lens_radius: 0.5,
            ..camera()
        };
        let c = Camera::new(&lens, [200, 100], lens.screen_window);
        for u in [[0.1, 0.9], [0.5, 0.01], [0.99, 0.4]] {
            let (o, d) = c.ray([50.0, 25.0], u);
            let p = o + d * ((4.0 - o.z) / d.z);
            assert!(
                (p.x + 4.0).abs() < 1e-4 && (p.y - 2.0).abs() < 1e-4,
                "{p:?}"
            );
        }
    }

    #[test]
    fn a_new_aspect_widens_the_default_window_only() {
        let c = camera();
        assert_eq!(
            screen_window(&c, [200, 100], [100, 100]),
            [-1.0, 1.0, -1.0, 1.0]
        );
        let odd = scene::Camera {
            screen_window: [-0.5, 0.5, -0.5, 0.5],
            ..c
        };
        assert_eq!(
            screen_window(&odd, [200, 100], [100, 100]),
            [-0.5, 0.5, -0.5, 0.5]
        );
    }
}
