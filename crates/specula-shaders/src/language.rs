//! The languages that the library is written in.

use std::fmt;
use std::str::FromStr;

use crate::names::nearest;

/// A language of shaders or renderers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// WebGPU Shading Language: the sources as they are.
    Wgsl,
    /// High Level Shading Language, shader model 5.1 and later.
    Hlsl,
    /// OpenGL Shading Language 4.50, for Vulkan and OpenGL.
    Glsl,
    /// OpenGL ES Shading Language 3.10.
    GlslEs,
    /// Metal Shading Language 2.0.
    Msl,
    /// SPIR-V 1.3.
    SpirV,
    /// C++17, CUDA and HIP.
    Cpp,
    /// Slang 2025 and later, a module.
    Slang,
}

impl Language {
    /// All of them, in the order of the documentation.
    pub const ALL: [Self; 8] = [
        Self::Wgsl,
        Self::Hlsl,
        Self::Glsl,
        Self::GlslEs,
        Self::Msl,
        Self::SpirV,
        Self::Cpp,
        Self::Slang,
    ];

    /// What it is called at the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Hlsl => "hlsl",
            Self::Glsl => "glsl",
            Self::GlslEs => "glsl-es",
            Self::Msl => "msl",
            Self::SpirV => "spirv",
            Self::Cpp => "cpp",
            Self::Slang => "slang",
        }
    }

    /// The library's file.
    #[must_use]
    pub fn text_file(self) -> &'static str {
        match self {
            Self::Wgsl => "specula.wgsl",
            Self::Hlsl => "specula.hlsl",
            Self::Glsl => "specula.glsl",
            Self::GlslEs => "specula_es.glsl",
            Self::Msl => "specula.metal",
            Self::SpirV => "specula.spv",
            Self::Cpp => "specula.hpp",
            Self::Slang => "specula.slang",
        }
    }

    /// The worked example's file.
    #[must_use]
    pub fn example_file(self) -> &'static str {
        match self {
            Self::Wgsl => "example.wgsl",
            Self::Hlsl => "example.hlsl",
            Self::Glsl => "example.comp",
            Self::GlslEs => "example_es.comp",
            Self::Msl => "example.metal",
            Self::SpirV => "example.spv",
            Self::Cpp => "example.cpp",
            Self::Slang => "example.slang",
        }
    }

    /// What the worked example calls.
    #[must_use]
    pub fn example_modules(self) -> &'static [&'static str] {
        match self {
            Self::Cpp => &["reflectance", "rough_conductor"],
            _ => &["bounded", "ggx"],
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Language {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        // One header serves the three.
        let name = match name {
            "cuda" | "hip" | "c++" => Self::Cpp.name(),
            other => other,
        };
        let found = Self::ALL.into_iter().find(|l| l.name() == name);
        found.ok_or_else(|| {
            let names = Self::ALL.map(Self::name);
            let near = match nearest(name, names).first() {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("expected one of {}", names.join(", ")),
            };
            format!("there is no shading language `{name}`; {near}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for language in Language::ALL {
            assert_eq!(language.name().parse(), Ok(language));
        }
        assert_eq!("cuda".parse(), Ok(Language::Cpp));
        assert_eq!(
            "hlsls".parse::<Language>().unwrap_err(),
            "there is no shading language `hlsls`; did you mean `hlsl`?"
        );
        assert_eq!(
            "cuda-c".parse::<Language>().unwrap_err(),
            "there is no shading language `cuda-c`; expected one of wgsl, hlsl, glsl, glsl-es, msl, spirv, cpp, slang"
        );
    }
}
