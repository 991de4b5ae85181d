//! Regularized materials, which paths hit behind rough surfaces, where these are made rougher
//! ([`RenderOptions::regularize`]).
//!
//! Each material that this changes has a twin behind all others: prepared once, and used like any other.

use specula_scene::scene::{MaterialId, MaterialKind};

use super::{Material, Materials};
use crate::convert::id;

impl Materials {
    /// Adds the twins.
    ///
    /// * `prepare`: makes the twin of a material of the scene, by its index.
    pub(super) fn add_twins(&mut self, prepare: impl Fn(usize) -> Material) {
        let count = self.materials.len();
        let mut twins = Vec::new();
        for (i, material) in self.materials.iter().enumerate() {
            let twin = material.depends_on_alpha().then(|| prepare(i));
            match twin.filter(|twin| !material.is_same_everywhere_as(twin)) {
                Some(twin) => {
                    self.behind_rough.push(id(count + twins.len()));
                    twins.push(twin);
                }
                None => self.behind_rough.push(id(i)),
            }
        }
        for twin in &mut twins {
            if let MaterialKind::Mix { materials, .. } | MaterialKind::Sided(materials) =
                &mut twin.kind
            {
                *materials = materials.map(|m| MaterialId(self.behind_rough[m.0] as usize));
            }
        }
        self.materials.extend(twins);
    }

    /// The material that a path hits where a shape has `material`.
    ///
    /// * `rough`: whether it was scattered by a lobe that is not perfectly smooth.
    #[inline(always)]
    pub(crate) fn on_path(&self, material: u32, rough: bool) -> u32 {
        if rough && self.are_regularized() {
            self.behind_rough[material as usize]
        } else {
            material
        }
    }

    /// Whether materials are others behind rough surfaces.
    #[inline(always)]
    pub(crate) fn are_regularized(&self) -> bool {
        !self.behind_rough.is_empty()
    }
}

impl Material {
    fn depends_on_alpha(&self) -> bool {
        !matches!(
            self.kind,
            MaterialKind::Diffuse { .. }
                | MaterialKind::DiffuseTransmission { .. }
                | MaterialKind::ThinDielectric { .. }
                | MaterialKind::Interface
                | MaterialKind::Measured(_)
                | MaterialKind::Hair(_)
        )
    }

    fn is_same_everywhere_as(&self, twin: &Self) -> bool {
        self.constant.is_some() && self.constant == twin.constant
    }
}
