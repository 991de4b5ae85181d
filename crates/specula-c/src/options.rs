//! Options of callers.

/// `wo` leads to the camera: radiance is scaled by 1/eta^2 on refraction.
pub const SPECULA_TRANSPORT_RADIANCE: u32 = 0;
/// `wo` leads to a light: importance is not scaled.
pub const SPECULA_TRANSPORT_IMPORTANCE: u32 = 1;

/// How elements are computed. `specula_batch_options_init` sets the defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct BatchOptions {
    /// Size of this struct in bytes, as the caller's header has it.
    pub size: usize,
    /// Of lobes that are themselves estimates: each element has its own stream of random numbers. 0 by default.
    pub seed: u64,
    /// SPECULA_TRANSPORT_RADIANCE by default.
    pub transport: u32,
    /// Threads that share the work; 0: all of the machine; 1 by default. The result does not depend on it.
    pub threads: u32,
}

impl Default for BatchOptions {
    fn default() -> Self {
        Self {
            size: size_of::<Self>(),
            seed: 0,
            transport: SPECULA_TRANSPORT_RADIANCE,
            threads: 1,
        }
    }
}

/// Textures are filtered as the scene says.
pub const SPECULA_TEXTURE_FILTER_SCENE: u32 = 0;
/// Pictures are interpolated bilinearly, not over footprints.
pub const SPECULA_TEXTURE_FILTER_BILINEAR: u32 = 1;
/// Over footprints, trilinearly.
pub const SPECULA_TEXTURE_FILTER_TRILINEAR: u32 = 2;
/// Over footprints, by elliptical Gaussian means.
pub const SPECULA_TEXTURE_FILTER_EWA: u32 = 3;

/// What a render is asked for. `specula_render_options_init` sets the defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct RenderOptions {
    /// Size of this struct in bytes, as the caller's header has it.
    pub size: usize,
    /// Samples per pixel; 0, the default: as many as the scene says, or as the noise or the time take.
    pub samples_per_pixel: u32,
    /// Renders with different seeds are independent; 0 by default.
    pub seed: u32,
    /// Threads; 0, the default: all of the machine. The picture does not depend on it.
    pub threads: u32,
    /// Columns of the picture; 0, the default: those of the scene. Either both are given or none.
    pub width: u32,
    /// Rows of the picture; 0, the default: those of the scene.
    pub height: u32,
    /// Longest path in scattering events; 0 shows emission only; -1, the default: as the scene says.
    pub max_depth: i32,
    /// Estimated relative error at which the picture is done, such as 0.02; 0, the default: none. Samples are spread
    /// by their error and cost.
    pub noise: f64,
    /// Seconds after which the render ends; 0, the default: none. One sample of each pixel is taken in any case.
    pub seconds: f64,
    /// SPECULA_TEXTURE_FILTER_SCENE by default.
    pub texture_filter: u32,
    /// 1: normal maps are filtered into roughness, by LEAN mapping; 0 by default: their mean normal alone is left.
    pub filter_normal_maps: u32,
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            size: size_of::<Self>(),
            samples_per_pixel: 0,
            seed: 0,
            threads: 0,
            width: 0,
            height: 0,
            max_depth: -1,
            noise: 0.0,
            seconds: 0.0,
            texture_filter: SPECULA_TEXTURE_FILTER_SCENE,
            filter_normal_maps: 0,
        }
    }
}
