//! What materials scatter by, as shaders distinguish it.

use core::fmt;

/// A kind of material, with what is done about multiple scattering: the first word of its record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
#[repr(u32)]
pub enum LobeKind {
    /// Lambert, or Oren-Nayar where it is rough.
    Diffuse,
    /// Diffuse on both sides.
    DiffuseTransmission,
    /// Metal with single scattering.
    Conductor,
    /// Metal with compensated energy.
    CompensatedConductor,
    /// Metal whose bounces are simulated.
    MultibounceConductor,
    /// Glass with single scattering.
    Dielectric,
    /// Glass with compensated energy.
    CompensatedDielectric,
    /// Glass whose bounces are simulated.
    MultibounceDielectric,
    /// A thin pane.
    ThinDielectric,
    /// Lambert under a coat.
    CoatedDiffuse,
    /// A walk between a coat and what is under it.
    Layered,
    /// Mitsuba's plastics.
    Plastic,
    /// Mitsuba's principled.
    Principled,
    /// glTF's metallic-roughness.
    Gltf,
    /// One of two materials by chance.
    Mix,
    /// No surface.
    Interface,
}

impl fmt::Display for LobeKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Diffuse => "diffuse materials",
            Self::DiffuseTransmission => "diffuse transmission",
            Self::Conductor => "metal",
            Self::CompensatedConductor => "metal with compensated energy",
            Self::MultibounceConductor => "metal with simulated bounces",
            Self::Dielectric => "glass",
            Self::CompensatedDielectric => "glass with compensated energy",
            Self::MultibounceDielectric => "glass with simulated bounces",
            Self::ThinDielectric => "thin panes",
            Self::CoatedDiffuse => "coated diffuse materials",
            Self::Layered => "layers between which light walks",
            Self::Plastic => "plastic",
            Self::Principled => "the principled material",
            Self::Gltf => "glTF's material",
            Self::Mix => "mixed materials",
            Self::Interface => "materials without a surface",
        })
    }
}
