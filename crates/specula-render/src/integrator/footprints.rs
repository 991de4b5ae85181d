//! Cones of paths, in scenes with filtered textures.

use specula_bsdf::BsdfSample;
use specula_bsdf::batch::SampleOutcome;
use specula_bsdf::bsdf::Event;

use super::path_states::PathStates;
use super::ray_queue::{RayQueue, index};
use super::vertex_batch::VertexBatch;
use super::{PathState, PathTracer, ShadingPoint};
use crate::accel::{BlockHits, Ray};
use crate::geometry::Surface;
use crate::ray_cone::{Bounce, RayCone};
use crate::sampler::Sampler;

impl PathTracer<'_> {
    /// Begins the cones of the first `n` paths of a wavefront.
    ///
    /// * `raster`: where their camera rays pass.
    pub(super) fn begin_cones(&self, paths: &mut PathStates, raster: [&[f32]; 2]) {
        if !self.scene.textures.is_filtered() {
            return;
        }
        let [x, y] = raster;
        let PathStates {
            cones, samplers, ..
        } = paths;
        for ((cone, sampler), (&x, &y)) in cones.iter_mut().zip(samplers).zip(x.iter().zip(y)) {
            let time = self.time(sampler);
            *cone = self
                .scene
                .camera
                .cone(time, [x, y])
                .of_sample(sampler.index());
        }
    }

    /// A surface that a path hits with its footprint; the path's cone comes there.
    #[inline]
    pub(super) fn with_footprint(
        &self,
        surface: Surface,
        ray: &Ray,
        state: &mut PathState,
    ) -> Surface {
        let (surface, cone) = self.with_footprint_of(surface, ray, state.cone);
        state.cone = cone;
        surface
    }

    /// A surface that a ray hits with the footprint of its cone, and the cone there.
    #[inline]
    pub(super) fn with_footprint_of(
        &self,
        mut surface: Surface,
        ray: &Ray,
        cone: RayCone,
    ) -> (Surface, RayCone) {
        if !self.scene.textures.is_filtered() {
            return (surface, cone);
        }
        let cone = cone.at((surface.position - ray.origin).length());
        let footprint = (self.scene.geometry).footprint(&surface, ray.direction, cone.radius);
        surface.footprint = Some(footprint);
        (surface, cone)
    }

    /// Spreads the cone of a path that was scattered.
    #[inline]
    pub(super) fn spread_cone(
        &self,
        state: &mut PathState,
        vertex: &ShadingPoint<'_>,
        sample: &BsdfSample<f32>,
        sampler: &Sampler,
    ) {
        if !self.scene.textures.is_filtered() {
            return;
        }
        let bounce = match (sample.specular, sample.event) {
            (false, _) => Bounce::Lobe { pdf: sample.pdf },
            (true, Event::Transmission) => Bounce::Refraction { eta: sample.eta },
            (true, _) => Bounce::Mirror,
        };
        let curvature = || self.curvature_from(&vertex.surface, vertex.wo.dot(vertex.surface.ng));
        state.cone = state.cone.after(bounce, curvature, sampler.index());
    }

    /// Spreads the cone of a path that a batch scattered, where textures are filtered.
    ///
    /// * `i`: index of its vertex in the batch.
    /// * `eta`: index beyond the surface over the index before it.
    #[inline]
    pub(super) fn spread_cone_of_batch(
        &self,
        (paths, live, hits): (&mut PathStates, &RayQueue, &BlockHits),
        batch: &VertexBatch,
        i: usize,
        eta: f32,
    ) {
        let k = batch.live_indices[i] as usize;
        let (ray, path) = (live.ray(k), index(batch.path_indices[i]));
        let Some(hit) = hits.get(&self.scene.geometry.accel, k, || ray) else {
            return;
        };
        let scatter = &batch.scatter_samples;
        let bounce = match scatter.outcome[i] {
            SampleOutcome::SpecularTransmission => Bounce::Refraction { eta },
            SampleOutcome::SpecularReflection => Bounce::Mirror,
            _ => Bounce::Lobe {
                pdf: scatter.pdf[i],
            },
        };
        let time = paths.times[path];
        let curvature = || {
            let surface = self.scene.geometry.surface(&ray, &hit, time);
            self.curvature_from(&surface, -ray.direction.dot(surface.ng))
        };
        let cone = paths.cones[path].at(hit.t);
        paths.cones[path] = cone.after(bounce, curvature, paths.samplers[path].index());
    }

    /// Mean curvature of a surface, above 0 where it is convex seen from a side.
    ///
    /// * `cosine`: between that side's direction and the geometric normal.
    fn curvature_from(&self, surface: &Surface, cosine: f32) -> f32 {
        let curvature = self.scene.geometry.mean_curvature(surface);
        if cosine < 0.0 { -curvature } else { curvature }
    }
}
