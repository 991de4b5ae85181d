//! What is done with each feature of glTF 2.0.

use crate::features::Feature;

/// Every feature that is known, by class.
pub const FEATURES: &[Feature] = &[
    Feature::full("file", ".gltf with files or data URIs"),
    Feature::full("file", ".glb"),
    Feature::refused("file", "addresses of a network", "nothing is fetched"),
    Feature::full("mesh", "triangles, strips, fans"),
    Feature::approximated("mesh", "points, lines", "left out"),
    Feature::approximated("mesh", "morph targets", "undeformed"),
    Feature::approximated("mesh", "skins", "undeformed"),
    Feature::full("mesh", "sparse accessors"),
    Feature::full("mesh", "COLOR_0"),
    Feature::approximated(
        "mesh",
        "several sets of texture coordinates",
        "one set for each material",
    ),
    Feature::full("mesh", "KHR_mesh_quantization"),
    Feature::refused("mesh", "KHR_draco_mesh_compression", "no kept decoder"),
    Feature::refused("mesh", "EXT_meshopt_compression", "no kept decoder"),
    Feature::full("material", "metallic-roughness"),
    Feature::full("material", "normal map"),
    Feature::approximated(
        "material",
        "occlusion map",
        "left out: occlusion is simulated",
    ),
    Feature::full("material", "emission"),
    Feature::full("material", "alpha mask and blend"),
    Feature::approximated("material", "single-sided", "seen from both sides"),
    Feature::approximated(
        "material",
        "KHR_materials_anisotropy",
        "of its texture the strength",
    ),
    Feature::approximated(
        "material",
        "KHR_materials_clearcoat",
        "without its own normal map",
    ),
    Feature::full("material", "KHR_materials_emissive_strength"),
    Feature::full("material", "KHR_materials_ior"),
    Feature::full("material", "KHR_materials_specular"),
    Feature::full("material", "KHR_materials_sheen"),
    Feature::full("material", "KHR_materials_transmission"),
    Feature::approximated(
        "material",
        "KHR_materials_volume",
        "light bends; no absorption",
    ),
    Feature::approximated(
        "material",
        "KHR_materials_unlit",
        "shines with its base colour",
    ),
    Feature::approximated(
        "material",
        "KHR_materials_pbrSpecularGlossiness",
        "a rough dielectric of its diffuse colour",
    ),
    Feature::approximated("material", "KHR_materials_variants", "the default variant"),
    Feature::full("texture", "PNG, JPEG"),
    Feature::refused("texture", "KHR_texture_basisu", "no kept decoder"),
    Feature::refused("texture", "EXT_texture_webp", "not read"),
    Feature::full("texture", "KHR_texture_transform"),
    Feature::full("texture", "wrap modes"),
    Feature::approximated("texture", "filters", "nearest or bilinear, no mip maps"),
    Feature::full("light", "KHR_lights_punctual"),
    Feature::full("camera", "perspective"),
    Feature::full("camera", "orthographic"),
    Feature::approximated(
        "scene",
        "animations",
        "nodes stand where the file puts them",
    ),
];
