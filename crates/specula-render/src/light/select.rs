//! Which light to sample at a point.
//!
//! Lights in the scene are chosen by the tree or the list of them, lights from infinity in proportion to
//! their irradiance. Between the two classes the estimates of irradiance decide, where both are:
//!
//! ```text
//! P(far) = clamp(E_far / (E_far + E_near(receiver)), 0.1, 0.9)
//! ```
//!
//! Neither accounts for occlusion, hence the bounds. Everything is a function of the receiver
//! alone, so that the probability of a light that a ray hit by chance is that of its choice.

use macro_rules_attribute::apply;
use specula_bsdf::Vec3;

use super::alias::AliasTable;
use super::build::Emitter;
use super::node::{Node, Receiver};
use super::tree::LightTree;
use crate::convert::narrow;
use crate::simd::simd_levels;
use crate::words::Words;

/// Smallest share of either class of lights where there are both.
pub const LEAST_SHARE: f32 = 0.1;
/// Irradiance of lights from infinity over that at normal incidence. The mean of the cosine over the normals of all
/// surfaces is 1/4; the tree's estimates, which bound the cosine and the distance of whole nodes, are larger than what arrives
/// in the same measure.
const FAR_COSINE: f64 = 0.35;
/// Unit of the second random number of a choice: the first is a multiple of it.
pub const FINER: f64 = 1.0 / 8_388_608.0;

/// The choice among the lights of a scene.
#[derive(Clone, Debug, Default)]
pub(super) struct Selection {
    near: LightTree,
    /// Over all lights, with weight 0 for those in the scene; empty where none is far.
    pub(super) far: AliasTable,
    /// Relative to the intensities in the tree.
    far_irradiance: f32,
    /// The light that is always sampled, where there is but one.
    pub(super) only: Option<u32>,
    /// That of those from infinity, likewise.
    pub(super) only_far: Option<u32>,
}

impl Selection {
    /// * `near`: what is not brighter than black is left out.
    /// * `far`: lights with their irradiances at normal incidence, or integrals of luminance.
    /// * `lights`: how many there are in all.
    pub(super) fn new(mut near: Vec<Emitter>, far: &[(u32, f64)], lights: usize) -> Self {
        let emits = |x: f64| x > 0.0 && x.is_finite();
        near.retain(|e| emits(e.intensity));
        // Within the range of f32, whatever the units.
        let scale = near.iter().map(|e| e.intensity).fold(0.0, f64::max);
        let scale = if scale > 0.0 { scale } else { 1.0 };
        for e in &mut near {
            e.intensity /= scale;
        }
        let far = || far.iter().filter(|f| emits(f.1));
        let only_far = far().next().map(|f| f.0).filter(|_| far().count() == 1);
        let only = match (near.as_slice(), far().count()) {
            ([], 1) => only_far,
            ([one], 0) => Some(one.light),
            _ => None,
        };
        let mut weights = Vec::new();
        for &(light, strength) in far() {
            weights.resize(lights, 0.0);
            weights[light as usize] = strength;
        }
        let irradiance = FAR_COSINE * weights.iter().sum::<f64>() / scale;
        Self {
            near: LightTree::new(near, lights),
            far: AliasTable::new(&weights),
            far_irradiance: if irradiance > 0.0 {
                narrow(irradiance).clamp(f32::MIN_POSITIVE, 1e37)
            } else {
                0.0
            },
            only,
            only_far,
        }
    }

    /// Tree, table and what decides between them, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        self.near.flatten(to);
        self.far.flatten(to);
        to.float_constant("LIGHTS_LEAST_SHARE", LEAST_SHARE);
        to.float_constant("LIGHTS_FINER", narrow(FINER));
        to.begin("LIGHT_FAR_IRRADIANCE");
        to.number(self.far_irradiance);
        to.constant("LIGHT_ONLY", self.only.unwrap_or(u32::MAX));
    }

    /// Whether there is no light to choose.
    pub(super) fn is_empty(&self) -> bool {
        self.near.is_empty() && self.far_irradiance <= 0.0
    }

    /// A light and its probability; `None` where there is no light.
    ///
    /// * `u`: uniform in `[0, 1)`, multiples of `2^-23`: the second adds digits to the first, which
    ///   run out over hundreds of thousands of lights.
    #[inline]
    pub(super) fn sample(&self, receiver: &Receiver, u: [f32; 2]) -> Option<(u32, f32)> {
        let importance = self.importances(receiver);
        self.choose(&importance, self.share(&importance), u)
    }

    /// [`Selection::sample`] by treelets, after the share of lights from infinity.
    ///
    /// * `receiver`: point and normal, zero where light from every side counts.
    #[inline(always)]
    pub(super) fn sample_by_treelets(
        &self,
        receiver: (Vec3<f32>, Vec3<f32>),
        u: [f32; 2],
    ) -> (f32, Option<(u32, f32)>) {
        let Some(top) = self.near.top(receiver) else {
            return (0.0, None);
        };
        let share = self.share_of(top[0] + top[1]);
        if let Some(light) = self.only {
            return (share, Some((light, 1.0)));
        }
        // No closure: it would be compiled for the baseline.
        let class = Class::of(share, u);
        let choice = match class.is_far {
            true => self.far.sample(class.u),
            false => self.near.sample_by_treelets(top, receiver, class.u),
        };
        (share, class.weigh(choice))
    }

    /// Importances of the tree's nodes.
    #[inline]
    pub(super) fn importances(&self, receiver: &Receiver) -> impl Fn(usize) -> f32 {
        self.near.importances(receiver)
    }

    /// [`Selection::sample`] by the importances of the tree's nodes.
    ///
    /// * `share`: what [`Selection::share`] makes of them.
    #[inline]
    pub(super) fn choose(
        &self,
        importance: &impl Fn(usize) -> f32,
        share: f32,
        u: [f32; 2],
    ) -> Option<(u32, f32)> {
        if let Some(light) = self.only {
            return Some((light, 1.0));
        }
        let class = Class::of(share, u);
        class.weigh(match class.is_far {
            true => self.far.sample(class.u),
            false => self.near.sample(importance, class.u),
        })
    }

    /// Probability with which [`Selection::sample`] samples a light in the scene.
    #[inline]
    pub(super) fn probability_near(&self, receiver: &Receiver, light: u32) -> f32 {
        if self.near.is_list() {
            let weights = self.near.weights(&self.near.importances(receiver));
            let share = 1.0 - self.share_of(weights.total);
            return share * self.near.probability_in_list(&weights, light);
        }
        let at = (receiver.point, receiver.normal.unwrap_or(Vec3::ZERO));
        probability_by_treelets(self, at, light)
    }

    /// Whether there are so many lights in the scene that they are chosen by treelets, one receiver at a time.
    #[inline(always)]
    pub(super) fn by_treelets(&self) -> bool {
        !self.near.is_list()
    }

    /// Probability with which [`Selection::sample`] samples any light from infinity.
    #[inline]
    pub(super) fn share_far(&self, receiver: &Receiver) -> f32 {
        self.share(&self.near.importances(receiver))
    }

    /// [`Selection::share_far`] by the importances of the tree's nodes.
    #[inline(always)]
    pub(super) fn share(&self, importance: &impl Fn(usize) -> f32) -> f32 {
        if self.far_irradiance <= 0.0 || self.near.is_empty() {
            return self.share_of(0.0);
        }
        self.share_of(self.near.total(importance))
    }

    /// * `near`: the estimate of the irradiance by the tree's lights.
    #[inline(always)]
    pub(super) fn share_of(&self, near: f32) -> f32 {
        let share = self.far_irradiance / (self.far_irradiance + near);
        let between = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
        let of_far = if near <= 0.0 { 1.0 } else { between };
        if self.far_irradiance <= 0.0 {
            0.0
        } else {
            of_far
        }
    }

    /// Whether there is more than one light to choose from.
    pub(super) fn chooses(&self) -> bool {
        self.only.is_none()
    }

    /// The nodes of the tree over the lights in the scene, or their list.
    pub(super) fn nodes(&self) -> &[Node] {
        self.near.nodes()
    }

    /// Probability of a light from infinity among those.
    #[inline]
    pub(super) fn probability_far(&self, light: u32) -> f32 {
        self.far.probability(light)
    }
}

/// Whether a light from infinity is chosen or one in the scene, and what is left of the random number.
pub(super) struct Class {
    pub(super) is_far: bool,
    pub(super) probability: f32,
    pub(super) u: f64,
}

impl Class {
    /// * `share`: of lights from infinity.
    /// * `u`: as of [`Selection::sample`].
    #[inline(always)]
    pub(super) fn of(share: f32, u: [f32; 2]) -> Self {
        let u = f64::from(u[0]) + FINER * f64::from(u[1]);
        let threshold = f64::from(share);
        let is_far = u < threshold;
        let above = if is_far { u } else { u - threshold };
        let width = if is_far { threshold } else { 1.0 - threshold };
        Self {
            is_far,
            probability: if is_far { share } else { 1.0 - share },
            u: (above / width).min(1.0 - f64::EPSILON),
        }
    }

    /// A light of the class, with its probability among all.
    #[inline(always)]
    fn weigh(&self, choice: Option<(u32, f32)>) -> Option<(u32, f32)> {
        choice.map(|(light, probability)| (light, self.probability * probability))
    }
}

/// [`Selection::probability_near`] by treelets.
#[apply(simd_levels)]
fn probability_by_treelets(
    selection: &Selection,
    receiver: (Vec3<f32>, Vec3<f32>),
    light: u32,
) -> f32 {
    let Some(top) = selection.near.top(receiver) else {
        return 0.0;
    };
    let share = 1.0 - selection.share_of(top[0] + top[1]);
    let descent = selection.near.descent(top);
    share * selection.near.probability(Some(descent), receiver, light)
}
