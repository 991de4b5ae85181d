//! The scene as the artist wrote it: one model for every format, plain data.
//!
//! Lengths are in scene units, colours linear RGB (sRGB primaries), angles in degrees where the
//! name says so. Transforms are row-times-column matrices `p_world = M * p_local`.

use glam::DMat4;
use specula_bsdf::Rgb;

use crate::energy::Energy;
use crate::image::Image;

/// Index into [`Scene::images`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ImageId(pub usize);
/// Index into [`Scene::textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureId(pub usize);
/// Index into [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub usize);
/// Index into [`Scene::meshes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MeshId(pub usize);
/// Index into [`Scene::objects`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ObjectId(pub usize);

/// Everything that a file describes.
///
/// Invariant: every index is in range, every number is finite, every transform is invertible;
/// textures refer only to textures before them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Where pictures are taken from.
    pub camera: Camera,
    /// Size, crop and reconstruction filter of the picture.
    pub film: Film,
    /// What the file asks of the renderer.
    pub settings: Settings,
    /// Decoded pictures, each stored once.
    pub images: Vec<Image>,
    /// Texture nodes.
    pub textures: Vec<Texture>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Triangle meshes in their own space.
    pub meshes: Vec<Mesh>,
    /// Shapes of the world.
    pub shapes: Vec<Shape>,
    /// Groups of shapes that instances refer to.
    pub objects: Vec<Object>,
    /// Copies of objects.
    pub instances: Vec<Instance>,
    /// Lights that are not shapes.
    pub lights: Vec<Light>,
}

/// What the file asks of the renderer; the command line may override each.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Longest path, in scattering events counted as pbrt counts `maxdepth`
    /// (0: emission seen directly only).
    pub max_depth: u32,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
}

/// A perspective camera with a thin lens.
///
/// Camera space is pbrt's: the view direction is +z, +y is up and +x is right in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Camera space to world space.
    pub to_world: DMat4,
    /// Field of view over the shorter side of the picture, in degrees, in (0, 180).
    pub fov_deg: f64,
    /// Radius of the lens, in scene units; 0 for a pinhole.
    pub lens_radius: f64,
    /// Distance along +z to the plane in focus, in scene units.
    pub focal_distance: f64,
    /// Bounds of the picture plane in screen space, `[x0, x1, y0, y1]`; the shorter side spans
    /// `[-1, 1]` unless the file says otherwise.
    pub screen_window: [f64; 4],
}

/// The picture's size, crop and filter.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Width and height of the whole picture in pixels.
    pub resolution: [u32; 2],
    /// Pixels that are rendered, `[x0, x1, y0, y1]`, half open.
    pub crop: [u32; 4],
    /// Reconstruction filter.
    pub filter: Filter,
    /// Factor from radiance to picture values (pbrt: exposure time * iso / 100).
    pub exposure: f32,
    /// File name that the scene asks for.
    pub file_name: Option<String>,
}

/// A separable reconstruction filter; radii in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// Constant.
    Box {
        /// Half widths.
        radius: [f32; 2],
    },
    /// Linear.
    Triangle {
        /// Half widths.
        radius: [f32; 2],
    },
    /// Gaussian, zero at its radius.
    Gaussian {
        /// Half widths.
        radius: [f32; 2],
        /// Standard deviation in pixels.
        sigma: f32,
    },
    /// Mitchell and Netravali 1988.
    Mitchell {
        /// Half widths.
        radius: [f32; 2],
        /// Their B.
        b: f32,
        /// Their C.
        c: f32,
    },
    /// Sinc windowed by a sinc.
    LanczosSinc {
        /// Half widths.
        radius: [f32; 2],
        /// Cycles of the sinc before it is zero.
        tau: f32,
    },
}

/// A number, or a texture that gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FloatParam {
    /// The same everywhere.
    Value(f32),
    /// The red channel of a texture.
    Texture(TextureId),
}

/// A colour, or a texture that gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourParam {
    /// The same everywhere.
    Value(Rgb<f32>),
    /// A texture.
    Texture(TextureId),
}

/// A texture node. Nodes that give a number hold it in all three channels.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// The same everywhere.
    Constant(Rgb<f32>),
    /// A picture, bilinearly filtered: `scale * value`, then `max(0, 1 - it)` where `invert`.
    ///
    /// Pictures are stored from the top, and `(s, t) = mapping(u, v)` has its origin at the lower
    /// left: the value is that of column `s * width` and row `(1 - t) * height`, pixel centres at
    /// halves. (pbrt-v4 flips `t` at every lookup, too.)
    Image {
        /// The picture, already linear.
        image: ImageId,
        /// How surface coordinates become picture coordinates.
        mapping: UvMapping,
        /// What lies outside `[0, 1]^2`.
        wrap: Wrap,
        /// Whether 1 - value is meant.
        invert: bool,
        /// Factor on the value.
        scale: f32,
        /// Whether a number is meant: the mean of the channels.
        as_float: bool,
    },
    /// The product of two textures.
    Scale {
        /// First factor.
        a: TextureId,
        /// Second factor.
        b: TextureId,
    },
    /// Interpolation: `(1 - amount) a + amount b`.
    Mix {
        /// At amount 0.
        a: TextureId,
        /// At amount 1.
        b: TextureId,
        /// Between them.
        amount: FloatParam,
    },
    /// Two-dimensional checks of unit size in mapped coordinates.
    Checkerboard {
        /// Where floor(u) + floor(v) is even.
        even: TextureId,
        /// Where it is odd.
        odd: TextureId,
        /// How surface coordinates become check coordinates.
        mapping: UvMapping,
    },
}

/// `(su u + du, sv v + dv)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvMapping {
    /// Factors on u and v.
    pub scale: [f32; 2],
    /// Offsets of u and v.
    pub offset: [f32; 2],
}

/// What a picture is outside `[0, 1]^2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// It repeats.
    Repeat,
    /// It is black.
    Black,
    /// Its border extends.
    Clamp,
}

/// A material with its name, if it has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file's name for it.
    pub name: Option<String>,
    /// What it is.
    pub kind: MaterialKind,
    /// Treatment of multiple scattering, where the file chooses one; else the render's.
    pub energy: Option<Energy>,
}

/// How a file's roughness becomes alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoughnessMapping {
    /// alpha = roughness.
    Alpha,
    /// alpha = sqrt(roughness): pbrt's `remaproughness`.
    Sqrt,
    /// alpha = roughness^2: glTF, OpenPBR.
    Square,
}

/// Roughness along the two tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Along dp/du.
    pub u: FloatParam,
    /// Along the other tangent.
    pub v: FloatParam,
    /// How it becomes alpha.
    pub mapping: RoughnessMapping,
}

/// A conductor's reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConductorFresnel {
    /// Complex index of refraction `eta + i k` relative to vacuum.
    Index {
        /// Real part.
        eta: ColourParam,
        /// Imaginary part.
        k: ColourParam,
    },
    /// Reflectance at normal incidence, by pbrt's rule: eta = 1 and k from it.
    Reflectance(ColourParam),
}

/// What a material is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaterialKind {
    /// Lambert, or energy-preserving Oren-Nayar where roughness is not 0.
    Diffuse {
        /// Albedo.
        reflectance: ColourParam,
        /// Oren-Nayar roughness in `[0, 1]`.
        roughness: FloatParam,
    },
    /// Lambert on both sides.
    DiffuseTransmission {
        /// Albedo of the reflected part.
        reflectance: ColourParam,
        /// Albedo of the transmitted part.
        transmittance: ColourParam,
    },
    /// Metal.
    Conductor {
        /// Its Fresnel term.
        fresnel: ConductorFresnel,
        /// Its roughness.
        roughness: Roughness,
    },
    /// Glass.
    Dielectric {
        /// Index of refraction, inside over outside.
        eta: f32,
        /// Its roughness.
        roughness: Roughness,
    },
    /// A thin pane: both interfaces in one surface, no refraction.
    ThinDielectric {
        /// Index of refraction of the pane.
        eta: f32,
    },
    /// A dielectric coat over Lambert.
    CoatedDiffuse {
        /// Albedo of the base.
        reflectance: ColourParam,
        /// Index of refraction of the coat.
        eta: f32,
        /// Roughness of the coat.
        roughness: Roughness,
    },
    /// A dielectric coat over metal.
    CoatedConductor {
        /// Index of refraction of the coat.
        coat_eta: f32,
        /// Roughness of the coat.
        coat_roughness: Roughness,
        /// The metal.
        fresnel: ConductorFresnel,
        /// Roughness of the metal.
        roughness: Roughness,
    },
    /// One of two materials, chosen at random at every hit.
    Mix {
        /// Chosen with probability 1 - amount, and with probability amount.
        materials: [MaterialId; 2],
        /// Share of the second.
        amount: FloatParam,
    },
    /// No surface at all: rays pass straight through.
    Interface,
}

/// A triangle mesh. Optional attributes are empty or one per vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices.
    pub positions: Vec<[f32; 3]>,
    /// Shading normals, not necessarily unit.
    pub normals: Vec<[f32; 3]>,
    /// Surface coordinates.
    pub uvs: Vec<[f32; 2]>,
    /// Triangles, as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// A shape's geometry in its own space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// Triangles.
    Mesh(MeshId),
    /// A full sphere about the origin.
    Sphere {
        /// Radius.
        radius: f32,
    },
    /// A full disk perpendicular to z.
    Disk {
        /// Radius.
        radius: f32,
        /// Its z.
        height: f32,
    },
}

/// Light that a shape sends out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Radiance.
    pub radiance: Rgb<f32>,
    /// Whether both sides send it; else the side of the surface normal.
    pub two_sided: bool,
}

/// A shape in the world, or in an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Geometry in its own space.
    pub geometry: Geometry,
    /// Its space to the world's (or the object's).
    pub to_world: DMat4,
    /// Its surface.
    pub material: MaterialId,
    /// Light that it sends out.
    pub emission: Option<Emission>,
    /// Whether the file reverses the surface normal (the flip of a mirroring transform is *not*
    /// in it: the renderer adds it, as pbrt does).
    pub reverse_orientation: bool,
    /// Opacity: 0 lets rays pass.
    pub alpha: FloatParam,
}

/// A named group of shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object {
    /// The file's name for it.
    pub name: String,
    /// Its shapes; `Shape::to_world` leads to the object's space.
    pub shapes: Vec<Shape>,
}

/// A copy of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// What is copied.
    pub object: ObjectId,
    /// The object's space to the world's.
    pub to_world: DMat4,
}

/// How a picture covers the sphere of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentMapping {
    /// Equal-area octahedral square (Clarberg 2008), as pbrt-v4 does; +z is the centre of the
    /// square, -z its corners. With `(x, y)` in `[0, 1]^2` over the stored picture, x to the right
    /// and y *down* from the first row (no flip here), `u = 2x - 1`, `v = 2y - 1`,
    /// `d = 1 - |u| - |v|`, `r = 1 - |d|`, `phi = (pi/4) ((|v| - |u|)/r + 1)`:
    /// `direction = (sgn(u) cos(phi) r sqrt(2 - r^2), sgn(v) sin(phi) r sqrt(2 - r^2), sgn(d) (1 - r^2))`.
    EqualAreaOctahedral,
    /// Latitude and longitude; z is the pole, the first row is at +z, u runs with the azimuth.
    LatitudeLongitude,
}

/// A light that is not a shape. Powers, scales and filters of the file are folded in.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// Radiance from every direction.
    Infinite {
        /// Radiance, or factor on the picture.
        radiance: Rgb<f32>,
        /// Picture of the sphere of directions.
        image: Option<(ImageId, EnvironmentMapping)>,
        /// Light space to world space (only directions matter).
        to_world: DMat4,
    },
    /// Parallel light.
    Distant {
        /// Irradiance on a surface that faces it.
        irradiance: Rgb<f32>,
        /// Unit vector in the world, from the scene to the light.
        to_light: [f64; 3],
    },
    /// Light from a point.
    Point {
        /// Where.
        position: [f64; 3],
        /// Radiant intensity, per steradian.
        intensity: Rgb<f32>,
    },
    /// Light from a point within a cone.
    Spot {
        /// Where.
        position: [f64; 3],
        /// Unit vector along the axis of the cone.
        axis: [f64; 3],
        /// Intensity along the axis.
        intensity: Rgb<f32>,
        /// Half angle of the cone, in degrees.
        cone_angle_deg: f64,
        /// Half angle within which the intensity is whole; smoothstep in cosine between.
        falloff_start_deg: f64,
    },
}
