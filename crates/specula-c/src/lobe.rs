//! Lobes behind the interface, in two precisions.

use specula_bsdf::bsdf;
use specula_bsdf::math::Real;
use specula_lobes::NamedLobe;

/// A lobe: what a surface does with light. `specula_lobe_free` frees it.
pub struct LobeHandle(pub(crate) NamedLobe);

/// A precision that lobes are kept in.
pub(crate) trait Precision: Real {
    /// The lobe in it.
    fn of_pair(lobe: &LobeHandle) -> &bsdf::Lobe<Self>;
}

impl Precision for f32 {
    fn of_pair(lobe: &LobeHandle) -> &bsdf::Lobe<f32> {
        lobe.0.single()
    }
}

impl Precision for f64 {
    fn of_pair(lobe: &LobeHandle) -> &bsdf::Lobe<f64> {
        lobe.0.double()
    }
}
