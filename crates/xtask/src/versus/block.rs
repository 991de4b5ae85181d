//! The blocks of the comparison: Specula's defaults, its best without shared paths, and with them.

use super::renderers::Specula;

/// What of Specula is compared, in the order of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Block {
    /// What `specula render` does without options.
    Defaults,
    /// The best of even and adaptive sampling, every path alone.
    Alone,
    /// The best of adaptive sampling with paths that pixels share.
    Shared,
}

impl Block {
    pub(crate) const ALL: [Self; 3] = [Self::Defaults, Self::Alone, Self::Shared];

    /// The samplers that it chooses from on a device; none with shared paths on a GPU, which has none.
    pub(crate) fn samplers(self, device: &str) -> &'static [&'static str] {
        match self {
            Self::Defaults => &Specula::SAMPLERS[..1],
            Self::Alone => &Specula::SAMPLERS[1..3],
            Self::Shared if device == "cpu" => &Specula::SAMPLERS[3..],
            Self::Shared => &[],
        }
    }

    /// As part of a row's name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Defaults => "defaults",
            Self::Alone => "alone",
            Self::Shared => "shared",
        }
    }

    /// As a heading.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Defaults => "Defaults",
            Self::Alone => "Best without shared paths",
            Self::Shared => "With shared paths",
        }
    }

    /// What is compared, as a sentence.
    pub(crate) fn description(self) -> &'static str {
        match self {
            Self::Defaults => {
                "`specula render SCENE --spp N`, without any option that changes the picture."
            }
            Self::Alone => "The better of even sampling and `--adaptive`, every path alone.",
            Self::Shared => {
                "The better of `--adaptive --share-paths 8` and `16`. Noise that pixels have in common \
                 lowers the RMSE more than what is seen from afar."
            }
        }
    }

    /// Whether the goal is asked of it.
    pub(crate) fn has_goal(self) -> bool {
        self != Self::Shared
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_all_samplers_and_gpus_share_no_paths() {
        let of = |device| Block::ALL.map(|b| b.samplers(device));
        assert_eq!(of("cpu").concat(), Specula::SAMPLERS);
        assert_eq!(of("gpu:1").concat(), Specula::SAMPLERS[..3]);
        assert_eq!(of("cpu").map(<[_]>::len), [1, 2, 2]);
    }
}
