//! Shading normals under bump maps, of surfaces and of their clear coats.

use specula_bsdf::{Frame, Vec3};
use specula_scene::scene::BumpRules;

use super::PathTracer;
use crate::bump::{self, BumpedFrame};
use crate::geometry::Surface;
use crate::material::{Coat, Material};
use crate::prepared::PreparedScene;

impl PathTracer<'_> {
    /// Shading normal and tangent, with the material's bump map and rotation.
    #[inline]
    pub(super) fn bumped_frame(&self, surface: &Surface, material: &Material) -> BumpedFrame {
        let bent = match &material.bump {
            None => BumpedFrame {
                normal: surface.ns,
                tangent: surface.tangent,
                spread: None,
            },
            Some(r) => {
                let PreparedScene {
                    textures, geometry, ..
                } = self.scene;
                bump::bend(r, material.bump_rules, textures, geometry, surface)
            }
        };
        let rotation_rad = material.rotation_rad(&self.scene.textures, || surface.place());
        if rotation_rad == 0.0 {
            return bent;
        }
        let [_, along_v] = self.scene.geometry.partials(surface).dp;
        let frame = Frame::from_normal_tangent(bent.normal, bent.tangent);
        let side = if frame.t.dot(along_v) < 0.0 {
            -1.0
        } else {
            1.0
        };
        let (sin, cos) = rotation_rad.sin_cos();
        BumpedFrame {
            tangent: frame.s * cos + frame.t * (sin * side),
            ..bent
        }
    }

    /// The normal of a clear coat, on the side of `facing`.
    pub(super) fn bumped_coat(
        &self,
        coat: Coat,
        surface: &Surface,
        facing: Vec3<f32>,
    ) -> BumpedFrame {
        let scene = self.scene;
        let bent = match &coat.0 {
            None => BumpedFrame {
                normal: surface.ns,
                tangent: surface.tangent,
                spread: None,
            },
            Some(r) => {
                let rules = BumpRules::Plain;
                bump::bend(r, rules, &scene.textures, &scene.geometry, surface)
            }
        };
        let side = if bent.normal.dot(facing) < 0.0 {
            -1.0
        } else {
            1.0
        };
        BumpedFrame {
            normal: bent.normal * side,
            ..bent
        }
    }
}
