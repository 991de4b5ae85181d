//! Camera rays through lenses, some of which none gets through.

use super::PathTracer;
use super::path_states::PathStates;
use super::ray_queue::RayQueue;
use super::vertex_batch::Floats;
use crate::accel::Ray;
use crate::convert::id;

impl PathTracer<'_> {
    /// Begins the rays of a wavefront's paths. A path that ends in the lenses is not live, and its sample is black.
    ///
    /// * `factors`: from the radiance of each path to the value of its sample.
    /// * `raster`: where they pass the film; as long as there are paths.
    /// * `lens`: random numbers for the pupil.
    pub(super) fn begin_in_lenses(
        &self,
        paths: &mut PathStates,
        live: &mut RayQueue,
        factors: &mut Floats,
        [x, y]: [&[f32]; 2],
        [u, v]: [&Floats; 2],
    ) {
        for (i, (&x, &y)) in x.iter().zip(y).enumerate() {
            let time = self.time(&paths.samplers[i]);
            paths.times[i] = time;
            let ray = self.scene.camera.through_lenses(time, [x, y], [u[i], v[i]]);
            factors[i] = ray.map_or(0.0, |(_, _, weight)| weight);
            if let Some((origin, direction, _)) = ray {
                let t_max = f32::INFINITY;
                let ray = Ray {
                    origin,
                    direction,
                    t_max,
                };
                live.push(id(i), &ray);
            }
        }
    }
}
