//! Codes by which the shaders of `specula-shaders` distinguish this crate's choices.
//!
//! They are stated here. WGSL files, which are valid by themselves, repeat them as constants of the same names, and a
//! test of `specula-shaders` compares the two.

use crate::energy::{EnergyModel, FmsVariant};
use crate::multibounce::{MisPdf, MultibounceModel};
use crate::ndf::Masking;
use crate::vndf::Sampler;

/// Makes a constant of each row, and the list of all.
macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident = $value:literal;)*) => {
        $($(#[$doc])* pub const $name: u32 = $value;)*

        /// All codes, by their names in WGSL.
        pub const ALL: &[(&str, u32)] = &[$((stringify!($name), $name)),*];
    };
}

codes! {
    /// [`Ggx`](crate::ndf::Ggx).
    DISTRIBUTION_GGX = 0;
    /// [`Beckmann`](crate::ndf::Beckmann).
    DISTRIBUTION_BECKMANN = 1;
    /// [`Masking::HeightCorrelated`].
    MASKING_HEIGHT_CORRELATED = 0;
    /// [`Masking::Separable`].
    MASKING_SEPARABLE = 1;
    /// [`Sampler::Heitz`].
    SAMPLER_HEITZ = 0;
    /// [`Sampler::Cap`].
    SAMPLER_CAP = 1;
    /// [`Sampler::Bounded`].
    SAMPLER_BOUNDED = 2;
    /// [`Sampler::Exact`].
    SAMPLER_EXACT = 3;
    /// [`EnergyModel::Turquin`] with [`FmsVariant::NormalIncidence`].
    MODEL_TURQUIN = 0;
    /// [`EnergyModel::Turquin`] with [`FmsVariant::AverageSeries`].
    MODEL_TURQUIN_SERIES = 1;
    /// [`EnergyModel::KullaConty`].
    MODEL_KULLA_CONTY = 2;
    /// [`MultibounceModel::Heitz2016`].
    MULTIBOUNCE_MODEL_HEITZ = 0;
    /// [`MultibounceModel::BitterliDeon2022`].
    MULTIBOUNCE_MODEL_BITTERLI = 1;
    /// [`MultibounceModel::Wang2022`], correlated.
    MULTIBOUNCE_MODEL_WANG = 2;
    /// [`MultibounceModel::Wang2022`], not correlated.
    MULTIBOUNCE_MODEL_WANG_UNCORRELATED = 3;
    /// [`MultibounceModel::Cui2023`].
    MULTIBOUNCE_MODEL_CUI = 4;
    /// [`MultibounceModel::Cui2023`], bidirectional.
    MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL = 5;
    /// [`MultibounceModel::StratifiedBidirectional`].
    MULTIBOUNCE_MODEL_STRATIFIED_BIDIRECTIONAL = 6;
    /// [`MisPdf::Lambert`].
    MIS_PDF_LAMBERT = 0;
    /// [`MisPdf::Hapke`].
    MIS_PDF_HAPKE = 1;
    /// [`MisPdf::Normalised`].
    MIS_PDF_NORMALISED = 2;
}

/// Code of a masking function.
#[must_use]
pub const fn masking(masking: Masking) -> u32 {
    match masking {
        Masking::HeightCorrelated => MASKING_HEIGHT_CORRELATED,
        Masking::Separable => MASKING_SEPARABLE,
    }
}

/// Code of a sampler of visible normals.
#[must_use]
pub const fn sampler(sampler: Sampler) -> u32 {
    match sampler {
        Sampler::Heitz => SAMPLER_HEITZ,
        Sampler::Cap => SAMPLER_CAP,
        Sampler::Bounded => SAMPLER_BOUNDED,
        Sampler::Exact => SAMPLER_EXACT,
    }
}

/// Code of a compensation of energy.
#[must_use]
pub const fn energy(model: EnergyModel) -> u32 {
    match model {
        EnergyModel::Turquin(FmsVariant::NormalIncidence) => MODEL_TURQUIN,
        EnergyModel::Turquin(FmsVariant::AverageSeries) => MODEL_TURQUIN_SERIES,
        EnergyModel::KullaConty => MODEL_KULLA_CONTY,
    }
}

/// Code of a model of multiple bounces.
#[must_use]
pub const fn multibounce(model: MultibounceModel) -> u32 {
    match model {
        MultibounceModel::Heitz2016 => MULTIBOUNCE_MODEL_HEITZ,
        MultibounceModel::BitterliDeon2022 => MULTIBOUNCE_MODEL_BITTERLI,
        MultibounceModel::Wang2022 { correlated: true } => MULTIBOUNCE_MODEL_WANG,
        MultibounceModel::Wang2022 { correlated: false } => MULTIBOUNCE_MODEL_WANG_UNCORRELATED,
        MultibounceModel::Cui2023 {
            bidirectional: false,
        } => MULTIBOUNCE_MODEL_CUI,
        MultibounceModel::Cui2023 {
            bidirectional: true,
        } => MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL,
        MultibounceModel::StratifiedBidirectional => MULTIBOUNCE_MODEL_STRATIFIED_BIDIRECTIONAL,
    }
}

/// Code of a density of simulated bounces.
#[must_use]
pub const fn mis_pdf(pdf: MisPdf) -> u32 {
    match pdf {
        MisPdf::Lambert => MIS_PDF_LAMBERT,
        MisPdf::Hapke => MIS_PDF_HAPKE,
        MisPdf::Normalised => MIS_PDF_NORMALISED,
    }
}
