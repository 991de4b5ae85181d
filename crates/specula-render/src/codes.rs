//! Codes that the renderer writes into a scene's words and shaders read: each is stated here alone, and written in
//! front of every shader as a constant of its name.

/// Makes a constant of each row, and the list of all.
macro_rules! shared_constants {
    ($($(#[$doc:meta])* $name:ident = $value:expr;)*) => {
        $($(#[$doc])* pub(crate) const $name: u32 = $value;)*

        /// All of them, by their names.
        pub(crate) const ALL: &[(&str, u32)] = &[$((stringify!($name), $name)),*];
    };
}

pub(crate) use shared_constants;

shared_constants! {
    /// No light, no texture, no hit.
    NONE = u32::MAX;

    /// A light that is part of a shape; the kind of a light is its first word.
    LIGHTS_AREA = 0;
    /// A light at infinity with extent.
    LIGHTS_FAR = 1;
    /// A light without extent.
    LIGHTS_DELTA = 2;
    /// A light that is part of a shape, with a texture.
    LIGHTS_TEXTURED = 3;

    /// An environment map or a constant: kind of a light at infinity.
    LIGHTS_ENVIRONMENT = 0;
    /// A disk at infinity.
    LIGHTS_SUN = 1;

    /// Kind of a light's shape: a triangle.
    AREA_TRIANGLE = 0;
    /// A parallelogram.
    AREA_PARALLELOGRAM = 1;
    /// A sphere.
    AREA_SPHERE = 2;
    /// A disk.
    AREA_DISK = 3;
    /// An ellipsoid.
    AREA_ELLIPSOID = 4;

    /// Kind of a light without extent: parallel.
    DELTA_DISTANT = 0;
    /// A point, also a spot.
    DELTA_POINT = 1;
    /// A picture projected from a point.
    DELTA_PROJECTED = 2;

    /// Falloff of a spot's edge: smooth step of the cosine.
    SPOT_SMOOTH_COSINE = 0;
    /// Linear in the angle.
    SPOT_LINEAR_ANGLE = 1;
    /// Square of what is linear in the cosine.
    SPOT_SQUARED_COSINE = 2;

    /// What a projected picture goes through: all directions.
    WINDOW_NONE = 0;
    /// A window; values are intensities.
    WINDOW_INTENSITY = 1;
    /// A window; values are irradiances on a plane.
    WINDOW_IRRADIANCE = 2;
    /// A window within a spot.
    WINDOW_SPOT = 3;

    /// Mapping of an environment map: equal areas (Clarberg 2008).
    ENVIRONMENT_EQUAL_AREA = 0;
    /// Latitude and longitude.
    ENVIRONMENT_LATITUDE_LONGITUDE = 1;
    /// The same, with rows of pixels at the poles.
    ENVIRONMENT_LATITUDE_LONGITUDE_POLES = 2;

    /// Kind of a texture's node without inputs: a colour.
    TEXTURE_CONSTANT = 0;
    /// A picture.
    TEXTURE_IMAGE = 1;
    /// Between four colours.
    TEXTURE_BILINEAR = 2;
    /// A sum of octaves.
    TEXTURE_NOISE = 3;
    /// The colour of the mesh.
    TEXTURE_VERTEX_COLOUR = 4;
    /// Kind of a node that selects one of two inputs, and the first of these: checks.
    TEXTURE_CHECKERBOARD = 5;
    /// Checks in three dimensions.
    TEXTURE_CHECKERBOARD_SOLID = 6;
    /// Dots of one on another.
    TEXTURE_DOTS = 7;
    /// Kind of a node that waits for its inputs, and the first of these: a product.
    TEXTURE_SCALE = 8;
    /// A sum.
    TEXTURE_SUM = 9;
    /// Interpolation by a scalar.
    TEXTURE_MIX = 10;
    /// 1 from a bound on.
    TEXTURE_THRESHOLD = 11;
    /// Interpolation by the normal.
    TEXTURE_DIRECTION_MIX = 12;

    /// Channel of a picture: its colour.
    TEXTURE_CHANNEL_RGB = 0;
    /// Mean of the colour's three.
    TEXTURE_CHANNEL_MEAN = 1;
    /// Luminance of linear sRGB.
    TEXTURE_CHANNEL_LUMINANCE = 2;
    /// Red.
    TEXTURE_CHANNEL_RED = 3;
    /// Green.
    TEXTURE_CHANNEL_GREEN = 4;
    /// Blue.
    TEXTURE_CHANNEL_BLUE = 5;

    /// What a picture is outside of its square: repeated.
    TEXTURE_RASTER_REPEAT = 0;
    /// Black.
    TEXTURE_RASTER_BLACK = 1;
    /// Its border extends.
    TEXTURE_RASTER_CLAMP = 2;
    /// Repeated, every other copy mirrored.
    TEXTURE_RASTER_MIRROR = 3;

    /// What lies between a picture's pixels: interpolated.
    TEXTURE_FILTER_BILINEAR = 0;
    /// The nearest one.
    TEXTURE_FILTER_NEAREST = 1;
    /// The first kind that is a mean over a footprint: interpolated in and between levels of a pyramid.
    TEXTURE_FILTER_TRILINEAR = 2;
    /// Gaussian means over ellipses.
    TEXTURE_FILTER_EWA = 3;
    /// Added to a filter where what the picture itself contributes is left out.
    TEXTURE_FILTER_MEANS_ONLY = 4;

    /// Kind of noise: fractional Brownian motion.
    TEXTURE_NOISE_FBM = 0;
    /// Its octaves' absolute values.
    TEXTURE_NOISE_TURBULENCE = 1;
    /// Waves of varying strength.
    TEXTURE_NOISE_WINDY = 2;
    /// Marble.
    TEXTURE_NOISE_MARBLE = 3;

    /// Where texture coordinates come from: those of the surface.
    TEXTURE_MAPPING_UV = 0;
    /// The second set of the surface.
    TEXTURE_MAPPING_SECOND_UV = 1;
    /// Linear in the position.
    TEXTURE_MAPPING_PLANAR = 2;
    /// From the direction to the position.
    TEXTURE_MAPPING_SPHERICAL = 3;
    /// From the direction about an axis, and along it.
    TEXTURE_MAPPING_CYLINDRICAL = 4;

    /// Kind of a bump map: there is none.
    BUMP_NONE = 0;
    /// Heights.
    BUMP_HEIGHT = 1;
    /// Normals.
    BUMP_NORMAL = 2;
    /// Normals that are filtered into roughness.
    BUMP_FILTERED_NORMAL = 3;

    /// Rules of a bump map: normals are bent as it says, and nothing more.
    BUMP_PLAIN = 0;
    /// Mitsuba's.
    BUMP_MITSUBA = 1;
    /// Mitsuba's, and light fades towards the horizon.
    BUMP_FADES = 2;

    /// Kind of a quadric: a sphere.
    QUADRIC_SPHERE = 0;
    /// A disk.
    QUADRIC_DISK = 1;

    /// How a camera projects: perspective.
    CAMERA_PERSPECTIVE = 0;
    /// Parallel.
    CAMERA_ORTHOGRAPHIC = 1;
    /// The sphere of directions; the mapping of environment maps is added.
    CAMERA_SPHERICAL = 2;

    /// What a roughness is: alpha itself.
    ROUGHNESS_ALPHA = 0;
    /// Its square.
    ROUGHNESS_SQRT = 1;
    /// Its root.
    ROUGHNESS_SQUARE = 2;
    /// Mask of the three above.
    ROUGHNESS_MAPPING = 3;
    /// Added where the surface is behind a rough one, which makes it rougher.
    ROUGHNESS_REGULARIZED = 4;

    /// What the two colours of a metal are: eta and k.
    METAL_INDEX = 0;
    /// Reflectance at normal incidence, of a conductor.
    METAL_REFLECTANCE = 1;
    /// Reflectance at normal incidence, by Schlick's approximation.
    METAL_SCHLICK = 2;
    /// Nothing: all is reflected.
    METAL_MIRROR = 3;

    /// What a material bounds: nothing that absorbs.
    BOUNDARY_NONE = 0;
    /// What is inside absorbs; what is around it is not known.
    BOUNDARY_INSIDE = 1;
    /// Both sides are known.
    BOUNDARY_BOTH = 2;

    /// How a path combines light and lobe samples: the power heuristic with exponent 3/2.
    STRATEGY_MIS = 0;
    /// The balance heuristic.
    STRATEGY_BALANCE = 1;
    /// Light samples only.
    STRATEGY_LIGHTS_ONLY = 2;
    /// Lobe samples only.
    STRATEGY_BSDF_ONLY = 3;
    /// The power heuristic with exponent 2.
    STRATEGY_POWER = 4;

    /// Flag of glTF's material: it bounds a volume.
    GLTF_VOLUME = 1;
    /// Flag of glTF's material: its metal is compensated.
    GLTF_COMPENSATED = 2;
}
