// Codes of the models of multiple bounces.

/// Heitz et al. 2016. Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::Heitz2016.
const MULTIBOUNCE_MODEL_HEITZ: u32 = 0u;
/// Bitterli and d'Eon 2022, unidirectional. Metals only.
/// Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::BitterliDeon2022.
const MULTIBOUNCE_MODEL_BITTERLI: u32 = 1u;
/// Wang et al. 2022, masking and shadowing of each bounce correlated by its height. Metals only.
/// Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::Wang2022.
const MULTIBOUNCE_MODEL_WANG: u32 = 2u;
/// Wang et al. 2022, uncorrelated. Metals only.
/// Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::Wang2022.
const MULTIBOUNCE_MODEL_WANG_UNCORRELATED: u32 = 3u;
/// Cui et al. 2023. Metals only.
/// Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::Cui2023.
const MULTIBOUNCE_MODEL_CUI: u32 = 4u;
/// Cui et al. 2023, paths connected from both ends. Metals only.
/// Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::Cui2023.
const MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL: u32 = 5u;
/// This project's. Twin: specula-bsdf/src/multibounce/model.rs, MultibounceModel::StratifiedBidirectional.
const MULTIBOUNCE_MODEL_STRATIFIED_BIDIRECTIONAL: u32 = 6u;
