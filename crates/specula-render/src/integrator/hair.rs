//! What hair does otherwise than surfaces: a fibre scatters to both sides of its normals, from where a ray enters it.

use specula_bsdf::bsdf::Event;
use specula_bsdf::{Frame, Vec3};

use super::{PathTracer, ShadingPoint, estimator};
use crate::geometry::Surface;
use crate::material::PointLobe;

impl ShadingPoint<'_> {
    fn is_hair(&self) -> bool {
        matches!(self.lobe, PointLobe::Hair(_))
    }

    /// Whether a direction is on the same side of both normals, or its lobe takes no notice of them.
    ///
    /// * `wi`: the direction in the shading frame.
    #[inline]
    pub(super) fn lets_through(&self, wi: Vec3<f32>, direction: Vec3<f32>) -> bool {
        self.is_hair() || estimator::sides_agree(wi.z, self.facing.dot(direction))
    }

    /// Whether a scattered path goes beyond the surface.
    #[inline]
    pub(super) fn is_crossed(&self, direction: Vec3<f32>, event: Event) -> bool {
        if self.is_hair() {
            self.facing.dot(direction) < 0.0
        } else {
            event == Event::Transmission
        }
    }
}

impl PathTracer<'_> {
    /// The offset across a fibre that a surface stands for: pbrt-v4's, -1 at `v = 0` and 1 at `v = 1`, but towards the
    /// frame's second tangent from either side.
    pub(super) fn offset_across(&self, surface: &Surface, frame: &Frame<f32>) -> f32 {
        let [_, along_v] = self.scene.geometry.partials(surface).dp;
        let offset = 2.0 * surface.place().uv[1] - 1.0;
        if frame.t.dot(along_v) < 0.0 {
            -offset
        } else {
            offset
        }
    }
}
