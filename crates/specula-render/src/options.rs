//! What a render may be asked for.

use core::fmt;
use core::str::FromStr;

use specula_bsdf::multibounce::MisPdf;
use specula_bsdf::vndf;
use specula_scene::scene::{Interpolation, Texture};
use specula_scene::{Energy, Scene};

use crate::codes;

/// What stands before the options that bias a picture, at the end of [`RenderOptions::settings`].
pub(crate) const BIASED: &str = "biased: ";

/// How direct light is estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// By lights and by lobes, combined by the power heuristic (Veach 1997, 9.2.4) with exponent 3/2.
    /// Squared error over that with 2, in nine scenes: 0.94 to 1.00, 0.98 on average.
    #[default]
    Mis,
    /// As [`Strategy::Mis`] with the balance heuristic. For comparison: slower.
    Balance,
    /// By lights only, except off perfect mirrors. For checks: noisy on shiny surfaces.
    LightsOnly,
    /// By lobes only, except from lights without extent. For checks: noisy with small lights.
    BsdfOnly,
    /// As [`Strategy::Mis`] with exponent 2, as other renderers have it. For comparison: slower.
    Power,
}

impl Strategy {
    /// Its code in shaders.
    #[must_use]
    pub const fn code(self) -> u32 {
        match self {
            Self::Mis => codes::STRATEGY_MIS,
            Self::Balance => codes::STRATEGY_BALANCE,
            Self::LightsOnly => codes::STRATEGY_LIGHTS_ONLY,
            Self::BsdfOnly => codes::STRATEGY_BSDF_ONLY,
            Self::Power => codes::STRATEGY_POWER,
        }
    }
}

/// The name in [`RenderOptions::settings`], by which films are compared.
impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mis => "Mis",
            Self::Balance => "Balance",
            Self::LightsOnly => "LightsOnly",
            Self::BsdfOnly => "BsdfOnly",
            Self::Power => "Power",
        })
    }
}

/// How textures are filtered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureFilter {
    /// As the scene says.
    #[default]
    Scene,
    /// Not over footprints: pictures are interpolated bilinearly.
    Bilinear,
    /// All pictures that the scene interpolates: [`Interpolation::Trilinear`].
    Trilinear,
    /// All pictures that the scene interpolates: [`Interpolation::EWA`].
    Ewa,
}

impl TextureFilter {
    /// What becomes of a texture's filter. Nearest pixels stay.
    #[must_use]
    pub fn of(self, filter: Interpolation) -> Interpolation {
        match (self, filter) {
            (Self::Scene, _) | (_, Interpolation::Nearest) => filter,
            (Self::Bilinear, _) => Interpolation::Bilinear,
            (Self::Trilinear, _) => Interpolation::Trilinear,
            (Self::Ewa, Interpolation::Ewa { .. }) => filter,
            (Self::Ewa, _) => Interpolation::EWA,
        }
    }

    /// Changes the filters of a scene's textures.
    pub(crate) fn apply(self, scene: &mut Scene) {
        for texture in &mut scene.textures {
            if let Texture::Image { filter, .. } = texture {
                *filter = self.of(*filter);
            }
        }
    }
}

/// From the name that [`Display`](fmt::Display) writes.
impl FromStr for TextureFilter {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let all = [Self::Scene, Self::Bilinear, Self::Trilinear, Self::Ewa];
        let found = all.into_iter().find(|filter| filter.to_string() == name);
        found.ok_or_else(|| {
            format!("no such texture filter: '{name}' (expected scene, bilinear, trilinear or ewa)")
        })
    }
}

/// The name in [`RenderOptions::settings`].
impl fmt::Display for TextureFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scene => "scene",
            Self::Bilinear => "bilinear",
            Self::Trilinear => "trilinear",
            Self::Ewa => "ewa",
        })
    }
}

/// Settings of a render.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderOptions {
    /// Samples per pixel that the render aims at; passes decide what is taken. In adaptive sampling: as
    /// much work as so many samples of every pixel take.
    pub samples_per_pixel: u32,
    /// Longest path in scattering events, as pbrt counts `maxdepth`: 0 shows emission only.
    pub max_depth: u32,
    /// Renders with different seeds are independent.
    pub seed: u32,
    /// Which sampler samples reflections off rough surfaces.
    pub vndf_sampler: vndf::Sampler,
    /// What is done about multiple scattering where a material does not say it itself.
    pub energy: Energy,
    /// Density of simulated bounces in MIS with lights.
    pub mis_pdf: MisPdf,
    /// Size of the whole picture; `None`: as the scene says.
    pub resolution: Option<[u32; 2]>,
    /// Pixels to render, `[x0, x1, y0, y1]`, half open; `None`: as the scene says, scaled with the
    /// resolution.
    pub crop: Option<[u32; 4]>,
    /// How direct light is estimated.
    pub strategy: Strategy,
    /// Whether, with both strategies, environment lights are sampled by what exceeds their mean, as lobes sample the
    /// rest well (MIS compensation: Karlik et al. 2019). Otherwise by luminance.
    pub mis_compensation: bool,
    /// Paths of how many neighbouring pixels share what lies behind their first rough vertices (Bekaert et
    /// al. 2002), at most [`RenderOptions::MOST_SHARING`]; 1: none. Less noise for the time between rough
    /// surfaces that light each other; pixels that share have some of their noise in common.
    pub share_paths: u32,
    /// Index of each pixel's first sample: renders from different indices are parts of one picture.
    pub first_sample: u32,
    /// Estimated error at which the picture is done, with samples spread by their error and cost (see
    /// [`FilmBuffer::noise`](crate::FilmBuffer::noise)); at 0 it is done after the samples that were asked
    /// for. `None`: as many for every pixel.
    pub noise: Option<f32>,
    /// In adaptive sampling: only the tiles `i` with `from <= i % of < to` of one round, as `[from, to, of]`, for other
    /// machines to take the rest ([`FilmBuffer::merge`](crate::FilmBuffer::merge)). `None`: all tiles and rounds.
    pub round_share: Option<[u32; 3]>,
    /// Bias: the largest contribution of indirect light in any channel, in picture values (1 is white,
    /// the film's exposure applied, its white balance not); larger ones are scaled down whole, which preserves their
    /// hue. Indirect is light that was scattered twice or more, as in Cycles' "clamp indirect". Takes away fireflies
    /// and with them the light that they stand for: the picture gets darker. Finite and above 0; `None`: unbounded.
    pub clamp: Option<f32>,
    /// Bias: whether surfaces that a path hits behind a surface that is not perfectly smooth are made rougher, as
    /// by pbrt-v4's `regularize`: alphas `alpha` below 0.3 become `clamp(2 alpha, 0.1, 0.3)`, so that mirrors and
    /// clear glass have `alpha` 0.1. Caustics become blurred, and light sampling works through glass.
    pub regularize: bool,
    /// How textures are filtered.
    pub texture_filter: TextureFilter,
    /// Whether normal maps are filtered into roughness: where a footprint averages normals, alphas grow by how much
    /// their slopes vary over it (LEAN mapping: Olano and Baker 2010). Otherwise the mean normal alone is left. Normal
    /// maps that are interpolated bilinearly are filtered by [`Interpolation::EWA`] then, others as
    /// [`RenderOptions::texture_filter`] says; nearest pixels stay.
    pub filter_normal_maps: bool,
    /// Whether cylinders, parts of spheres and disks, bilinear patches and curves become triangles
    /// ([their meshes](specula_scene::scene::QuadricPart::mesh), [those of patches](specula_scene::scene::PatchMesh::mesh)
    /// and [of curves](specula_scene::scene::CurveMesh::mesh)), as they must for the GPU. Those that emit always do.
    pub triangulate_exact_shapes: bool,
}

impl RenderOptions {
    /// Most paths that share.
    pub const MOST_SHARING: u32 = 16;

    /// Those that change a sample, as text: films agree in it where their samples are of one picture.
    #[must_use]
    pub fn settings(&self) -> String {
        // In full, so that an option added is not forgotten here.
        let Self {
            samples_per_pixel: _,
            max_depth,
            seed,
            vndf_sampler,
            energy,
            mis_pdf,
            resolution: _,
            crop: _,
            strategy,
            mis_compensation,
            share_paths,
            first_sample: _,
            noise,
            round_share: _,
            clamp: _,
            regularize: _,
            texture_filter,
            filter_normal_maps,
            // Of the same shapes, within the rounding of their triangles.
            triangulate_exact_shapes: _,
        } = self;
        // Not which noise: a film goes on to a smaller one as if that had been asked for at first.
        let spread = if noise.is_some() { ", adaptive" } else { "" };
        let sampled = if *mis_compensation {
            ""
        } else {
            ", lights by luminance"
        };
        let shared = match share_paths {
            0 | 1 => String::new(),
            n => format!(", {n} share"),
        };
        let filtered = match texture_filter {
            TextureFilter::Scene => String::new(),
            other => format!(", textures {other}"),
        };
        let normals = match filter_normal_maps {
            true => ", normal maps filtered into roughness",
            false => "",
        };
        let biased = self.bias().map(|bias| format!(", {BIASED}{bias}"));
        let biased = biased.unwrap_or_default();
        format!(
            "depth {max_depth}, seed {seed}, sampler {vndf_sampler}, energy {energy}, {mis_pdf}, \
             {strategy}{sampled}{shared}{spread}{filtered}{normals}{biased}"
        )
    }

    /// The options that bias the picture, in words; `None`: there is none.
    #[must_use]
    pub fn bias(&self) -> Option<String> {
        let clamped = self
            .clamp
            .map(|most| format!("indirect light clamped to {most}"));
        let regularized = self.regularize.then(|| "regularized".to_owned());
        let all: Vec<String> = clamped.into_iter().chain(regularized).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }

    /// What the scene's file asks for.
    pub fn from_scene(scene: &Scene) -> Self {
        Self {
            samples_per_pixel: scene.settings.samples_per_pixel,
            max_depth: scene.settings.max_depth,
            energy: scene.settings.energy,
            ..Self::default()
        }
    }
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            samples_per_pixel: 16,
            max_depth: 5,
            seed: 0,
            vndf_sampler: vndf::Sampler::default(),
            energy: Energy::default(),
            mis_pdf: MisPdf::default(),
            resolution: None,
            crop: None,
            strategy: Strategy::default(),
            mis_compensation: true,
            share_paths: 1,
            first_sample: 0,
            noise: None,
            round_share: None,
            clamp: None,
            regularize: false,
            texture_filter: TextureFilter::Scene,
            filter_normal_maps: false,
            triangulate_exact_shapes: false,
        }
    }
}
