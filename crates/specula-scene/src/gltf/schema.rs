//! The schema of a glTF 2.0 document: the members that the reader uses.
//!
//! Source: glTF 2.0, section 5, and the extensions' own schemas.

/// The type that a value must have.
#[derive(Clone, Copy, Debug)]
pub(super) enum ValueKind {
    Boolean,
    Number,
    Text,
    /// A whole number from the first to the second.
    Integer(u64, u64),
    /// That many numbers; any number of them for 0.
    Numbers(usize),
    /// One of these numbers.
    Choice(&'static [u64]),
    /// One of these words.
    Word(&'static [&'static str]),
    /// The number of an element of a list of the root.
    Index(&'static str),
    List(&'static ValueKind),
    Object(&'static [Member]),
    /// An object of any names with values of one kind.
    Map(&'static ValueKind),
}

/// A member of an object.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    pub(super) name: &'static str,
    pub(super) needed: bool,
    pub(super) kind: ValueKind,
}

const fn need(name: &'static str, kind: ValueKind) -> Member {
    Member {
        name,
        needed: true,
        kind,
    }
}

const fn may(name: &'static str, kind: ValueKind) -> Member {
    Member {
        name,
        needed: false,
        kind,
    }
}

/// A list of the root, and what stands in for an element with a mistake. What elements refer to comes
/// first.
#[derive(Clone, Copy, Debug)]
pub(super) struct RootList {
    pub(super) name: &'static str,
    pub(super) element: ValueKind,
    pub(super) stand_in: &'static str,
    /// Whether what refers to the stand-in is left out: it holds nothing.
    pub(super) is_data: bool,
}

const fn list(name: &'static str, element: ValueKind, stand_in: &'static str) -> RootList {
    RootList {
        name,
        element,
        stand_in,
        is_data: false,
    }
}

const fn data(name: &'static str, element: ValueKind, stand_in: &'static str) -> RootList {
    RootList {
        is_data: true,
        ..list(name, element, stand_in)
    }
}

use ValueKind::{Boolean, Choice, Index, Integer, List, Map, Number, Numbers, Object, Text, Word};

const WHOLE: ValueKind = Integer(0, u64::MAX);
const SMALL: ValueKind = Integer(0, u32::MAX as u64);

pub(super) const ROOT: &[Member] = &[
    need("asset", Object(&[need("version", Text)])),
    may("scene", Index("scenes")),
    may("extensionsUsed", List(&Text)),
    may("extensionsRequired", List(&Text)),
];

pub(super) const LISTS: [RootList; 13] = [
    data(
        "buffers",
        BUFFER,
        r#"{"byteLength":0,"uri":"data:;base64,"}"#,
    ),
    data("bufferViews", VIEW, r#"{"buffer":0,"byteLength":0}"#),
    data(
        "accessors",
        ACCESSOR,
        r#"{"bufferView":0,"componentType":5126,"count":1,"type":"SCALAR"}"#,
    ),
    data("images", IMAGE, r#"{"uri":"data:;base64,"}"#),
    list("samplers", SAMPLER, "{}"),
    data("textures", TEXTURE, r#"{"source":0}"#),
    list("materials", MATERIAL, "{}"),
    list(
        "cameras",
        CAMERA,
        r#"{"type":"perspective","perspective":{"yfov":1,"znear":1}}"#,
    ),
    list("meshes", MESH, r#"{"primitives":[]}"#),
    list("skins", SKIN, r#"{"joints":[]}"#),
    list("nodes", NODE, "{}"),
    list("scenes", SCENE, r#"{"nodes":[]}"#),
    list("animations", ANIMATION, r#"{"channels":[],"samplers":[]}"#),
];

/// The list of lights, within the root's extension.
pub(super) const LIGHTS: RootList = list("lights", LIGHT, r#"{"type":"point"}"#);

const BUFFER: ValueKind = Object(&[may("byteLength", WHOLE), may("uri", Text)]);

const VIEW: ValueKind = Object(&[
    need("buffer", Index("buffers")),
    need("byteLength", WHOLE),
    may("byteOffset", WHOLE),
    may("byteStride", Integer(4, 252)),
    may("target", Choice(&[34_962, 34_963])),
]);

const ACCESSOR: ValueKind = Object(&[
    may("bufferView", Index("bufferViews")),
    may("byteOffset", WHOLE),
    need(
        "componentType",
        Choice(&[5120, 5121, 5122, 5123, 5125, 5126]),
    ),
    need("count", WHOLE),
    need(
        "type",
        Word(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]),
    ),
    may("normalized", Boolean),
    may(
        "sparse",
        Object(&[
            need("count", WHOLE),
            need(
                "indices",
                Object(&[
                    need("bufferView", Index("bufferViews")),
                    may("byteOffset", WHOLE),
                    need("componentType", Choice(&[5121, 5123, 5125])),
                ]),
            ),
            need(
                "values",
                Object(&[
                    need("bufferView", Index("bufferViews")),
                    may("byteOffset", WHOLE),
                ]),
            ),
        ]),
    ),
]);

const IMAGE: ValueKind = Object(&[
    may("uri", Text),
    may("mimeType", Text),
    may("bufferView", Index("bufferViews")),
]);

const WRAPS: ValueKind = Choice(&[33_071, 33_648, 10_497]);

const SAMPLER: ValueKind = Object(&[
    may("magFilter", Choice(&[9728, 9729])),
    may("minFilter", Choice(&[9728, 9729, 9984, 9985, 9986, 9987])),
    may("wrapS", WRAPS),
    may("wrapT", WRAPS),
]);

const TEXTURE: ValueKind = Object(&[
    may("sampler", Index("samplers")),
    may("source", Index("images")),
    may(
        "extensions",
        Object(&[may(
            "EXT_texture_webp",
            Object(&[need("source", Index("images"))]),
        )]),
    ),
]);

const TRANSFORM: Member = may(
    "extensions",
    Object(&[may(
        "KHR_texture_transform",
        Object(&[
            may("offset", Numbers(2)),
            may("rotation", Number),
            may("scale", Numbers(2)),
            may("texCoord", SMALL),
        ]),
    )]),
);

/// A reference to a texture, with the number that some have.
const fn info(scale: &'static str) -> [Member; 4] {
    [
        need("index", Index("textures")),
        may("texCoord", SMALL),
        may(scale, Number),
        TRANSFORM,
    ]
}

const INFO: ValueKind = Object(&info("scale"));

const MATERIAL: ValueKind = Object(&[
    may(
        "pbrMetallicRoughness",
        Object(&[
            may("baseColorFactor", Numbers(4)),
            may("baseColorTexture", INFO),
            may("metallicFactor", Number),
            may("roughnessFactor", Number),
            may("metallicRoughnessTexture", INFO),
        ]),
    ),
    may("normalTexture", INFO),
    may("occlusionTexture", Object(&info("strength"))),
    may("emissiveTexture", INFO),
    may("emissiveFactor", Numbers(3)),
    may("alphaMode", Word(&["OPAQUE", "MASK", "BLEND"])),
    may("alphaCutoff", Number),
    may("doubleSided", Boolean),
    may("extensions", MATERIAL_EXTENSIONS),
]);

const MATERIAL_EXTENSIONS: ValueKind = Object(&[
    may(
        "KHR_materials_emissive_strength",
        Object(&[may("emissiveStrength", Number)]),
    ),
    may("KHR_materials_ior", Object(&[may("ior", Number)])),
    may(
        "KHR_materials_pbrSpecularGlossiness",
        Object(&[
            may("diffuseFactor", Numbers(4)),
            may("diffuseTexture", INFO),
            may("specularFactor", Numbers(3)),
            may("glossinessFactor", Number),
            may("specularGlossinessTexture", INFO),
        ]),
    ),
    may(
        "KHR_materials_specular",
        Object(&[
            may("specularFactor", Number),
            may("specularTexture", INFO),
            may("specularColorFactor", Numbers(3)),
            may("specularColorTexture", INFO),
        ]),
    ),
    may(
        "KHR_materials_transmission",
        Object(&[
            may("transmissionFactor", Number),
            may("transmissionTexture", INFO),
        ]),
    ),
    may("KHR_materials_unlit", Object(&[])),
    may(
        "KHR_materials_volume",
        Object(&[
            may("thicknessFactor", Number),
            may("thicknessTexture", INFO),
            may("attenuationDistance", Number),
            may("attenuationColor", Numbers(3)),
        ]),
    ),
]);

const CAMERA: ValueKind = Object(&[
    need("type", Word(&["perspective", "orthographic"])),
    may(
        "perspective",
        Object(&[
            may("aspectRatio", Number),
            need("yfov", Number),
            may("zfar", Number),
            need("znear", Number),
        ]),
    ),
    may(
        "orthographic",
        Object(&[
            need("xmag", Number),
            need("ymag", Number),
            need("zfar", Number),
            need("znear", Number),
        ]),
    ),
]);

const MESH: ValueKind = Object(&[
    need(
        "primitives",
        List(&Object(&[
            need("attributes", Map(&Index("accessors"))),
            may("indices", Index("accessors")),
            may("material", Index("materials")),
            may("mode", Choice(&[0, 1, 2, 3, 4, 5, 6])),
            may("targets", List(&Map(&Index("accessors")))),
        ])),
    ),
    may("weights", Numbers(0)),
]);

const SKIN: ValueKind = Object(&[
    may("inverseBindMatrices", Index("accessors")),
    need("joints", List(&Index("nodes"))),
    may("skeleton", Index("nodes")),
]);

const NODE: ValueKind = Object(&[
    may("camera", Index("cameras")),
    may("children", List(&Index("nodes"))),
    may("matrix", Numbers(16)),
    may("mesh", Index("meshes")),
    may("rotation", Numbers(4)),
    may("scale", Numbers(3)),
    may("translation", Numbers(3)),
    may("skin", Index("skins")),
    may("weights", Numbers(0)),
    may(
        "extensions",
        Object(&[may(
            "KHR_lights_punctual",
            Object(&[need("light", Index("lights"))]),
        )]),
    ),
]);

const SCENE: ValueKind = Object(&[need("nodes", List(&Index("nodes")))]);

const ANIMATION: ValueKind = Object(&[
    need(
        "channels",
        List(&Object(&[
            need("sampler", WHOLE),
            need(
                "target",
                Object(&[
                    need("node", Index("nodes")),
                    need(
                        "path",
                        Word(&["translation", "rotation", "scale", "weights"]),
                    ),
                ]),
            ),
        ])),
    ),
    need(
        "samplers",
        List(&Object(&[
            need("input", Index("accessors")),
            need("output", Index("accessors")),
            may("interpolation", Word(&["LINEAR", "STEP", "CUBICSPLINE"])),
        ])),
    ),
]);

const LIGHT: ValueKind = Object(&[
    may("color", Numbers(3)),
    may("intensity", Number),
    may("range", Number),
    may(
        "spot",
        Object(&[may("innerConeAngle", Number), may("outerConeAngle", Number)]),
    ),
    need("type", Word(&["directional", "point", "spot"])),
]);
