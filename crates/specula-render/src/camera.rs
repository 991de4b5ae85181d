//! Cameras: from a point of the picture to a ray.

mod cone;
mod lens;

use macro_rules_attribute::apply;
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene::{self, EnvironmentMapping, Projection};

use crate::accel::Ray;
use crate::codes;
use crate::convert::{Affine, narrow};
use crate::disk::concentric_disk;
use crate::light::direction_of_sphere;
use crate::movement::Movement;
use crate::simd::simd_levels;
use crate::words::Words;
use lens::Lenses;

/// A camera for a picture of a certain size.
///
/// Raster x runs right and y down, from the upper left corner of the whole picture; camera space is
/// `+x` right, `+y` up, `+z` into the scene (left-handed, as in pbrt).
#[derive(Clone, Debug)]
pub(crate) struct Camera {
    to_world: Affine,
    /// How it moves, if it does; `to_world` is then where the shutter opens.
    movement: Option<Box<Movement>>,
    view: View,
    /// Raster to the plane z = 1, to scene units, to the film upside down, or to the unit square:
    /// `(x, y) = origin + raster * step`.
    origin: [f32; 2],
    step: [f32; 2],
    lens_radius: f32,
    focal_distance: f32,
}

/// [`Projection`] without what is in the steps of the raster.
#[derive(Clone, Debug)]
enum View {
    Perspective,
    Orthographic,
    Spherical(EnvironmentMapping),
    Lenses(Box<Lenses>),
}

impl Camera {
    /// A camera over `resolution` pixels.
    pub(crate) fn new(camera: &scene::Camera, resolution: [u32; 2], window: [f64; 4]) -> Self {
        let (view, [x0, x1, y0, y1]) = match &camera.projection {
            Projection::Perspective { fov_deg } => {
                let spread = (0.5 * fov_deg.to_radians()).tan();
                (View::Perspective, window.map(|v| v * spread))
            }
            Projection::Orthographic => (View::Orthographic, window),
            Projection::Spherical(mapping) => (View::Spherical(*mapping), [0.0, 1.0, 1.0, 0.0]),
            Projection::Lenses(lenses) => {
                let [x0, x1, y0, y1] = window;
                let scale = lenses.film_diagonal / (x1 - x0).hypot(y1 - y0);
                let view = View::Lenses(Box::new(Lenses::new(lenses)));
                (view, window.map(|v| v * scale))
            }
        };
        let has_lens = camera.lens_radius > 0.0
            && camera.focal_distance > 0.0
            && matches!(view, View::Perspective | View::Orthographic);
        let movement = Movement::default().within(camera.to_world, camera.motion.as_ref());
        let movement = movement.moves().then(|| Box::new(movement));
        let to_world = movement.as_ref().map_or(camera.to_world, |m| m.at(0.0));
        Self {
            to_world: Affine::new(&to_world),
            movement,
            view,
            origin: [narrow(x0), narrow(y1)],
            step: [
                narrow((x1 - x0) / f64::from(resolution[0])),
                narrow((y0 - y1) / f64::from(resolution[1])),
            ],
            lens_radius: if has_lens {
                narrow(camera.lens_radius)
            } else {
                0.0
            },
            focal_distance: narrow(camera.focal_distance),
        }
    }

    /// The ray through a point of the raster and of the lens: its origin and unit direction.
    ///
    /// The lens of an orthographic camera is a copy around the origin of every ray; pbrt-v4 puts it
    /// at the origin of camera space, where it would make the view a perspective one.
    #[inline(always)]
    pub(crate) fn ray(&self, raster: [f32; 2], lens: [f32; 2]) -> (Vec3<f32>, Vec3<f32>) {
        self.ray_from(&self.to_world, raster, lens)
    }

    /// [`Camera::ray`] at a time, in exposures.
    pub(crate) fn ray_at(
        &self,
        time: f32,
        raster: [f32; 2],
        lens: [f32; 2],
    ) -> (Vec3<f32>, Vec3<f32>) {
        match &self.movement {
            None => self.ray(raster, lens),
            Some(movement) => self.ray_from(&Affine::new(&movement.at(time)), raster, lens),
        }
    }

    /// Whether its rays pass lenses: [`Camera::through_lenses`].
    pub(crate) fn has_lenses(&self) -> bool {
        matches!(self.view, View::Lenses(_))
    }

    /// The ray through a point of the raster and of the lenses: origin, unit direction, and the factor from its
    /// radiance to the sample's value. `None`: none gets through.
    ///
    /// * `time`: in exposures.
    pub(crate) fn through_lenses(
        &self,
        time: f32,
        raster: [f32; 2],
        lens: [f32; 2],
    ) -> Option<(Vec3<f32>, Vec3<f32>, f32)> {
        let View::Lenses(lenses) = &self.view else {
            let (origin, direction) = self.ray_at(time, raster, lens);
            return Some((origin, direction, 1.0));
        };
        let moved = self.movement.as_ref().map(|m| Affine::new(&m.at(time)));
        let to_world = moved.as_ref().unwrap_or(&self.to_world);
        // The film's picture is upside down.
        let film = [0, 1].map(|i| -(self.origin[i] + raster[i] * self.step[i]));
        let ray = lenses.sample(film, lens)?;
        let direction = to_world.vector(ray.direction).normalize();
        Some((to_world.point(ray.origin), direction, ray.weight))
    }

    /// Whether it moves.
    pub(crate) fn moves(&self) -> bool {
        self.movement.is_some()
    }

    #[inline(always)]
    fn ray_from(
        &self,
        to_world: &Affine,
        raster: [f32; 2],
        lens: [f32; 2],
    ) -> (Vec3<f32>, Vec3<f32>) {
        let x = self.origin[0] + raster[0] * self.step[0];
        let y = self.origin[1] + raster[1] * self.step[1];
        let (from, towards) = match &self.view {
            View::Perspective => (Vec3::ZERO, vec3(x, y, 1.0)),
            View::Orthographic => (vec3(x, y, 0.0), Vec3::Z),
            View::Spherical(mapping) => {
                let uv = within_sphere(*mapping, [x, y]);
                (Vec3::ZERO, direction_of_sphere(*mapping, uv))
            }
            // Through the middle of the pupil; samples take `through_lenses`.
            View::Lenses(lenses) => (Vec3::ZERO, lenses.chief([-x, -y]).0),
        };
        if self.lens_radius > 0.0 {
            let d = concentric_disk(lens);
            let on_lens = from + vec3(d[0] * self.lens_radius, d[1] * self.lens_radius, 0.0);
            let focus = from + towards * self.focal_distance;
            return (
                to_world.point(on_lens),
                to_world.vector(focus - on_lens).normalize(),
            );
        }
        (to_world.point(from), to_world.vector(towards).normalize())
    }
}

impl Camera {
    /// [`Camera::ray`] for many points, as many as random numbers for the lens.
    ///
    /// * `store`: receives each ray with the point's index.
    pub(crate) fn rays(
        &self,
        raster: [&[f32]; 2],
        lens: [&[f32]; 2],
        store: impl FnMut(usize, Ray),
    ) {
        rays(self, raster, lens, store);
    }
}

#[apply(simd_levels)]
fn rays<S: FnMut(usize, Ray)>(
    camera: &Camera,
    [x, y]: [&[f32]; 2],
    [u, v]: [&[f32]; 2],
    mut store: S,
) {
    let points = x.iter().zip(y).zip(u.iter().zip(v));
    for (i, ((&x, &y), (&u, &v))) in points.enumerate() {
        let (origin, direction) = camera.ray([x, y], [u, v]);
        let ray = Ray {
            origin,
            direction,
            t_max: f32::INFINITY,
        };
        store(i, ray);
    }
}

impl Camera {
    /// The camera for shaders; views of the sphere are numbered as its mappings, from 2 on.
    pub(crate) fn flatten(&self, words: &mut Words) {
        let view = match &self.view {
            // Lenses are no shader's: see `has_lenses`.
            View::Perspective | View::Lenses(_) => codes::CAMERA_PERSPECTIVE,
            View::Orthographic => codes::CAMERA_ORTHOGRAPHIC,
            View::Spherical(mapping) => codes::CAMERA_SPHERICAL + *mapping as u32,
        };
        words.constant("CAMERA_VIEW", view);
        words.begin("CAMERA");
        words.affine(&self.to_world);
        words.floats(self.origin);
        words.floats(self.step);
        words.floats([self.lens_radius, self.focal_distance]);
    }
}

/// A point next to the unit square, where filters reach over its edges, as the point of the square
/// for the same direction.
fn within_sphere(mapping: EnvironmentMapping, [mut u, mut v]: [f32; 2]) -> [f32; 2] {
    let over = |x: f32| !(0.0..=1.0).contains(&x);
    let folded = |x: f32| if x < 0.0 { -x } else { 2.0 - x };
    match mapping {
        EnvironmentMapping::EqualAreaOctahedral => {
            // Each edge of the square is folded about its middle.
            if over(u) {
                (u, v) = (folded(u), 1.0 - v);
            }
            if over(v) {
                (u, v) = (1.0 - u, folded(v));
            }
        }
        EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
            if over(v) {
                (u, v) = (u + 0.5, folded(v));
            }
            u -= u.floor();
        }
    }
    [u, v].map(|x| x.clamp(0.0, 1.0))
}

/// The screen window for a new size: the file's own where it was no default, else the default of
/// the new aspect (the shorter side spans `[-1, 1]`).
///
/// * `file`: the film's size; `new`: that of the picture.
#[must_use]
pub fn screen_window(camera: &scene::Camera, file: [u32; 2], new: [u32; 2]) -> [f64; 4] {
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
            motion: None,
            projection: scene::Projection::Perspective { fov_deg: 90.0 },
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
    fn parallel_rays_leave_from_where_they_are_seen_and_focus_all_the_same() {
        let mut parallel = scene::Camera {
            projection: Projection::Orthographic,
            to_world: DMat4::from_translation([10.0, 0.0, 0.0].into()),
            screen_window: [-4.0, 4.0, -2.0, 2.0],
            ..camera()
        };
        let c = Camera::new(&parallel, [200, 100], parallel.screen_window);
        assert_eq!(
            c.ray([50.0, 100.0], [0.3; 2]),
            (vec3(8.0, -2.0, 0.0), Vec3::Z)
        );
        parallel.lens_radius = 0.5;
        let c = Camera::new(&parallel, [200, 100], parallel.screen_window);
        let mut origins = Vec::new();
        for u in [[0.1, 0.9], [0.5, 0.01], [0.99, 0.4]] {
            let (o, d) = c.ray([50.0, 100.0], u);
            let p = o + d * ((4.0 - o.z) / d.z);
            assert!((p - vec3(8.0, -2.0, 4.0)).length() < 1e-5, "{p:?}");
            let from_centre = (o - vec3(8.0, -2.0, 0.0)).length();
            assert!(from_centre > 0.05 && from_centre <= 0.5);
            origins.push(o);
        }
        assert_ne!(origins[0], origins[1]);
    }

    #[test]
    fn spherical_pictures_are_the_maps_that_environments_are_read_from() {
        for mapping in [
            EnvironmentMapping::EqualAreaOctahedral,
            EnvironmentMapping::LatitudeLongitude,
        ] {
            let round = scene::Camera {
                projection: Projection::Spherical(mapping),
                lens_radius: 1.0,
                ..camera()
            };
            let c = Camera::new(&round, [64, 32], round.screen_window);
            for raster in [[3.5, 4.5], [40.25, 30.0], [63.9, 0.1], [20.0, 17.0]] {
                let (o, d) = c.ray(raster, [0.7; 2]);
                let uv = [raster[0] / 64.0, raster[1] / 32.0];
                let expected = direction_of_sphere(mapping, uv);
                assert!(o == Vec3::ZERO && (d - expected).length() < 1e-5);
            }
            // Beyond the edge the map goes on where the sphere does.
            for (x, y) in [(0.0, 9.0), (64.0, 9.0), (12.0, 0.0), (12.0, 32.0)] {
                let step = |x: f32, size: f32| match x {
                    0.0 => 1e-3,
                    _ if x == size => -1e-3,
                    _ => 0.0,
                };
                let (dx, dy) = (step(x, 64.0), step(y, 32.0));
                let (_, inside) = c.ray([x + dx, y + dy], [0.0; 2]);
                let (_, outside) = c.ray([x - dx, y - dy], [0.0; 2]);
                let (_, far) = c.ray([x + 300.0 * dx, y + 300.0 * dy], [0.0; 2]);
                assert!((inside - outside).length() < 2e-2, "{mapping:?} ({x}, {y})");
                assert!((inside - far).length() > 0.02);
            }
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
