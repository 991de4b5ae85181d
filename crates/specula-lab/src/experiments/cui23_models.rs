//! Names and line styles of the models of multiple bounces in the experiments on Cui et al. 2023.

use specula_bsdf::multibounce::MultibounceModel;

/// A model with its name and style.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    /// The model.
    pub(super) model: MultibounceModel,
    /// In legends and tables.
    pub(super) label: &'static str,
    /// Its style in plots.
    pub(super) style: usize,
}

/// Heitz et al. 2016: all others are compared with it.
pub(super) const HEITZ: Shown = shown(MultibounceModel::Heitz2016, "Heitz 2016", 3);
/// Bitterli and d'Eon 2022.
pub(super) const BITTERLI: Shown = shown(
    MultibounceModel::BitterliDeon2022,
    "Bitterli, d'Eon 2022",
    5,
);
/// Wang et al. 2022, height-correlated: the version that Cui et al. compare with.
pub(super) const WANG: Shown = shown(
    MultibounceModel::Wang2022 { correlated: true },
    "Wang 2022",
    4,
);
/// Wang et al. 2022, uncorrelated.
pub(super) const WANG_UNCORRELATED: Shown = shown(
    MultibounceModel::Wang2022 { correlated: false },
    "Wang 2022, uncorrelated",
    7,
);
/// Cui et al. 2023, from one end ("PT").
pub(super) const CUI: Shown = shown(
    MultibounceModel::Cui2023 {
        bidirectional: false,
    },
    "Cui 2023",
    2,
);
/// Cui et al. 2023, from both ends ("BDPT").
pub(super) const CUI_BIDIRECTIONAL: Shown = shown(
    MultibounceModel::Cui2023 {
        bidirectional: true,
    },
    "Cui 2023, bidirectional",
    6,
);
/// Specula's.
pub(super) const SPECULA: Shown = shown(MultibounceModel::StratifiedBidirectional, "Specula", 1);

/// A note on the implementations.
pub(super) const IMPLEMENTATIONS: &str = "All models are this project's implementations, tidied and several times faster than the \
     published code (Heitz 2016: about six times), so that efficiencies compare methods and not \
     code; the bidirectional estimator of Cui et al. is without the thresholds that bias the \
     released one, and its roulette is 0.7 a bounce where the paper's is clamp(S_k, 0.3, 0.95).";

const fn shown(model: MultibounceModel, label: &'static str, style: usize) -> Shown {
    Shown {
        model,
        label,
        style,
    }
}
