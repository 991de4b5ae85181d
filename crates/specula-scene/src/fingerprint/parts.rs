//! What each type of the scene adds to the fingerprint: bytes that no name has a part in.

use glam::DMat4;
use specula_bsdf::Rgb;
use specula_bsdf::ndf::Masking;

use super::BlockHasher;
use crate::energy::Energy;
use crate::image::{Image, Pixels};
use crate::scene::{
    Bump, BumpRules, Camera, Channel, CoatMedium, ColourParam, ConductorFresnel, CurveKind,
    CurveMesh, CurveMeshId, Emission, EnvironmentMapping, Film, Filter, FloatParam, Geometry,
    GltfMaterial, HairMaterial, HairPigment, ImageId, ImageProjection, Interpolation,
    LensInterface, LensSystem, Light, Material, MaterialId, MaterialKind, MeasuredId, Mesh, MeshId,
    MicrofacetDistribution, Motion, NoiseKind, Object, ObjectId, ObjectInstance, PatchMesh,
    PatchMeshId, PrincipledMaterial, Profile, Projection, QuadricPart, Roughness, RoughnessMapping,
    Shape, SpotFalloff, StopPicture, Texture, TextureId, TextureMapping, UvMapping, Wrap,
};

/// A part of a scene.
pub(super) trait Part {
    /// Adds its bytes to the hash. No two values of a type have the same bytes.
    fn feed(&self, hash: &mut BlockHasher);
}

macro_rules! numbers {
    ($($type:ty),+) => {
        $(impl Part for $type {
            #[inline(always)]
            fn feed(&self, hash: &mut BlockHasher) {
                hash.bytes(&self.to_le_bytes());
            }
        })+
    };
}

numbers!(u8, u32, u64, f32, f64);

impl Part for bool {
    fn feed(&self, hash: &mut BlockHasher) {
        u8::from(*self).feed(hash);
    }
}

impl Part for usize {
    fn feed(&self, hash: &mut BlockHasher) {
        (*self as u64).feed(hash);
    }
}

impl<T: Part> Part for Option<T> {
    fn feed(&self, hash: &mut BlockHasher) {
        self.is_some().feed(hash);
        if let Some(value) = self {
            value.feed(hash);
        }
    }
}

impl<T: Part> Part for Box<T> {
    fn feed(&self, hash: &mut BlockHasher) {
        (**self).feed(hash);
    }
}

/// The length first, so that two lists never look like one.
impl<T: Part> Part for Vec<T> {
    fn feed(&self, hash: &mut BlockHasher) {
        self.len().feed(hash);
        for item in self {
            item.feed(hash);
        }
    }
}

impl<T: Part, const N: usize> Part for [T; N] {
    #[inline(always)]
    fn feed(&self, hash: &mut BlockHasher) {
        for item in self {
            item.feed(hash);
        }
    }
}

impl<A: Part, B: Part> Part for (A, B) {
    fn feed(&self, hash: &mut BlockHasher) {
        self.0.feed(hash);
        self.1.feed(hash);
    }
}

impl Part for Rgb<f32> {
    fn feed(&self, hash: &mut BlockHasher) {
        self.to_array().feed(hash);
    }
}

impl Part for DMat4 {
    fn feed(&self, hash: &mut BlockHasher) {
        self.to_cols_array().feed(hash);
    }
}

impl Part for Masking {
    fn feed(&self, hash: &mut BlockHasher) {
        (*self == Self::Separable).feed(hash);
    }
}

/// Its text is what the command line reads, and stays.
impl Part for Energy {
    fn feed(&self, hash: &mut BlockHasher) {
        self.to_string().into_bytes().feed(hash);
    }
}

impl Part for Pixels {
    fn feed(&self, hash: &mut BlockHasher) {
        self.len().feed(hash);
        for pixel in self.iter() {
            pixel.feed(hash);
        }
    }
}

/// A struct is all its fields; those after the semicolon have no part.
macro_rules! fields {
    ($type:ty { $($field:tt),+ $(; $($silent:ident),+)? }) => {
        impl Part for $type {
            fn feed(&self, hash: &mut BlockHasher) {
                // In full, so that a field added to it is not forgotten here.
                let Self { $($field: _,)+ $($($silent: _,)+)? } = self;
                $(self.$field.feed(hash);)+
            }
        }
    };
}

/// An enum is the number of its variant and all fields of that.
macro_rules! variants {
    ($type:ty {
        $($code:literal => $variant:ident $(($($item:ident),+))? $({ $($field:ident),+ })?),+ $(,)?
    }) => {
        impl Part for $type {
            fn feed(&self, hash: &mut BlockHasher) {
                match self {
                    $(Self::$variant $(($($item),+))? $({ $($field),+ })? => {
                        hash.bytes(&[$code]);
                        $($($item.feed(hash);)+)?
                        $($($field.feed(hash);)+)?
                    })+
                }
            }
        }
    };
}

fields!(ImageId { 0 });
fields!(TextureId { 0 });
fields!(MaterialId { 0 });
fields!(MeasuredId { 0 });
fields!(MeshId { 0 });
fields!(PatchMeshId { 0 });
fields!(CurveMeshId { 0 });
fields!(ObjectId { 0 });

fields!(Camera {
    to_world,
    projection,
    lens_radius,
    focal_distance,
    screen_window;
    motion
});
variants!(Projection {
    0 => Perspective { fov_deg },
    1 => Orthographic,
    2 => Spherical(mapping),
    3 => Lenses(lenses),
});
fields!(LensSystem {
    interfaces,
    stop,
    film_diagonal
});
fields!(LensInterface {
    curvature_radius,
    thickness,
    eta,
    aperture_radius
});
fields!(StopPicture {
    width,
    height,
    values
});
fields!(Film { resolution, crop, filter, exposure, max_component, balance; file_name });
variants!(Filter {
    0 => Box { radius },
    1 => Triangle { radius },
    2 => Gaussian { radius, sigma },
    3 => Mitchell { radius, b, c },
    4 => LanczosSinc { radius, tau },
});

fields!(Image { width, height, pixels; name });
fields!(Mesh {
    positions,
    normals,
    uvs,
    second_uvs,
    tangents,
    colours,
    triangles;
    is_fibre
});
fields!(PatchMesh {
    positions,
    normals,
    uvs,
    patches,
    are_polygons
});
variants!(CurveKind {
    0 => Flat,
    1 => Cylinder,
    2 => Ribbon,
});
fields!(CurveMesh {
    kind,
    segments,
    width_at_ends,
    normals,
    is_fibre
});
variants!(Geometry {
    0 => Mesh(id),
    1 => Sphere { radius },
    2 => Disk { radius, height },
    3 => QuadricPart(part),
    4 => Patches(id),
    5 => Curves(id),
});
variants!(QuadricPart {
    0 => Sphere { radius, z, phi_max },
    1 => Cylinder { radius, z, phi_max },
    2 => Disk { radius, inner, height, phi_max },
});
fields!(Emission {
    radiance,
    two_sided
});
fields!(Shape {
    geometry,
    to_world,
    material,
    emission,
    reverse_orientation,
    alpha;
    motion
});
fields!(Object { shapes; name });
fields!(ObjectInstance { object, to_world; motion });
fields!(Motion { end, times });

variants!(FloatParam { 0 => Value(value), 1 => Texture(id) });
variants!(ColourParam { 0 => Value(value), 1 => Texture(id) });
variants!(Texture {
    0 => Constant(value),
    1 => Image { image, mapping, wrap, filter, invert, scale, channel },
    2 => Scale { a, b },
    3 => Mix { a, b, amount },
    4 => Checkerboard { even, odd, mapping },
    5 => Checkerboard3d { even, odd, to_texture },
    6 => Bilinear { corners, mapping },
    7 => Dots { inside, outside, mapping },
    8 => Noise { kind, octaves, roughness, to_texture },
    9 => Sum { a, b },
    10 => Threshold { texture, cutoff },
    11 => DirectionMix { a, b, axis },
    12 => VertexColour,
});
variants!(NoiseKind { 0 => Fbm, 1 => Turbulence, 2 => Windy, 3 => Marble { scale, variation } });
variants!(Channel { 0 => Rgb, 1 => Mean, 2 => Luminance, 3 => Red, 4 => Green, 5 => Blue });
variants!(Interpolation {
    0 => Bilinear,
    1 => Nearest,
    2 => Trilinear,
    3 => Ewa { max_anisotropy },
});
variants!(TextureMapping {
    0 => Uv(mapping),
    1 => SecondUv(mapping),
    2 => Planar { to_texture, s, t },
    3 => Spherical { to_texture },
    4 => Cylindrical { to_texture },
});
fields!(UvMapping { 0 });
variants!(Wrap { 0 => Repeat, 1 => Black, 2 => Clamp, 3 => Mirror });

variants!(Light {
    0 => Infinite { radiance, image, to_world },
    1 => Distant { irradiance, to_light, half_angle_deg },
    2 => Point { position, intensity },
    3 => Spot { position, axis, intensity, cone_angle_deg, falloff_start_deg, falloff },
    4 => Picture { to_world, intensity, image_projection },
    5 => Portal { radiance, image, to_world, corners },
});
variants!(EnvironmentMapping {
    0 => EqualAreaOctahedral,
    1 => LatitudeLongitude,
    2 => LatitudeLongitudePoles,
});
variants!(ImageProjection { 0 => Sphere, 1 => Window { half, profile } });
variants!(Profile {
    0 => Intensity,
    1 => Irradiance,
    2 => Spot { cone_angle_deg, falloff_start_deg },
});
variants!(SpotFalloff { 0 => SmoothCosine, 1 => LinearAngle, 2 => SquaredCosine });

fields!(Material { kind, energy, bump, bump_rules, one_sided, absorption, around; name });
variants!(Bump { 0 => Height(height), 1 => Normal { map, scale } });
variants!(BumpRules { 0 => Plain, 1 => Mitsuba { fades } });
variants!(RoughnessMapping { 0 => Alpha, 1 => Sqrt, 2 => Square });
variants!(MicrofacetDistribution { 0 => Ggx, 1 => Beckmann });
fields!(Roughness {
    u,
    v,
    mapping,
    distribution,
    masking,
    rotation_rad
});
variants!(ConductorFresnel {
    0 => Index { eta, k },
    1 => Reflectance(colour),
    2 => Schlick(colour),
    3 => Mirror,
});
fields!(CoatMedium {
    thickness,
    max_depth,
    samples,
    albedo,
    g
});
variants!(MaterialKind {
    0 => Diffuse { reflectance, roughness },
    1 => DiffuseTransmission { reflectance, transmittance },
    2 => Conductor { fresnel, roughness, tint },
    3 => Dielectric { eta, roughness, reflection_tint, transmission_tint },
    4 => ThinDielectric { eta, reflection_tint, transmission_tint },
    5 => CoatedDiffuse { reflectance, eta, roughness, medium, lossless },
    6 => CoatedConductor { coat_eta, coat_roughness, fresnel, roughness, medium },
    7 => Plastic { diffuse, specular, eta, roughness, nonlinear },
    8 => Principled(parameters),
    9 => Gltf(parameters),
    10 => Mix { materials, amount },
    14 => Sided(materials),
    11 => Interface,
    12 => Measured(id),
    13 => Hair(parameters),
});
fields!(PrincipledMaterial {
    base_colour,
    roughness,
    anisotropic,
    metallic,
    spec_trans,
    eta,
    spec_tint,
    sheen,
    sheen_tint,
    clearcoat,
    clearcoat_gloss,
    flatness,
    diff_trans,
    thin
});
fields!(HairMaterial {
    pigment,
    eta,
    beta_m,
    beta_n,
    alpha_deg
});
variants!(HairPigment {
    0 => Absorption(colour),
    1 => Reflectance(colour),
    2 => Melanin { eumelanin, pheomelanin },
});
fields!(GltfMaterial {
    base_colour,
    metallic,
    roughness,
    anisotropy,
    anisotropy_rotation_rad,
    anisotropy_direction,
    ior,
    specular,
    specular_colour,
    transmission,
    volume,
    clearcoat,
    clearcoat_roughness,
    clearcoat_bump,
    sheen_colour,
    sheen_roughness
});
