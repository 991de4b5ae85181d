//! Lobes behind the interface, in two precisions.

use specula_bsdf::bsdf::Bsdf;
use specula_bsdf::measured::{Measured, MeasuredError, MeasuredTables};
use specula_lobes::{AnyLobe, NamedLobe};

/// A lobe: what a surface does with light. `specula_lobe_free` frees it.
pub struct LobeHandle {
    single: AnyLobe<f32>,
    double: AnyLobe<f64>,
}

impl LobeHandle {
    pub(crate) fn named(lobe: &NamedLobe) -> Self {
        Self {
            single: (*lobe.single()).into(),
            double: (*lobe.double()).into(),
        }
    }

    pub(crate) fn measured(tables: &MeasuredTables) -> Result<Self, MeasuredError> {
        Ok(Self {
            single: Measured::new(tables)?.into(),
            double: Measured::new(tables)?.into(),
        })
    }

    pub(crate) fn as_bsdf(&self) -> &dyn Bsdf<f64> {
        self.double.as_bsdf()
    }
}

/// A precision that lobes are kept in.
pub(crate) trait Precision: specula_lobes::Precision {
    /// The lobe in it.
    fn of_pair(lobe: &LobeHandle) -> &AnyLobe<Self>;
}

impl Precision for f32 {
    fn of_pair(lobe: &LobeHandle) -> &AnyLobe<f32> {
        &lobe.single
    }
}

impl Precision for f64 {
    fn of_pair(lobe: &LobeHandle) -> &AnyLobe<f64> {
        &lobe.double
    }
}
