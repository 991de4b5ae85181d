//! Warnings about numbers out of the specification's ranges, which readers clamp.
//!
//! Source: glTF 2.0, section 5, and the extensions' own schemas.

use gltf::json::{Value, serialize};

use super::Reader;
use crate::num::f32_of;

/// The largest number, where there is no other bound.
const ANY: f64 = f64::MAX;

/// Members of materials, and their least and largest numbers.
const OF_MATERIALS: [(&str, f64, f64); 20] = [
    ("pbrMetallicRoughness.baseColorFactor", 0.0, 1.0),
    ("pbrMetallicRoughness.metallicFactor", 0.0, 1.0),
    ("pbrMetallicRoughness.roughnessFactor", 0.0, 1.0),
    // Older files have their strength in the factor: it has no upper bound here.
    ("emissiveFactor", 0.0, ANY),
    ("alphaCutoff", 0.0, ANY),
    (
        "extensions.KHR_materials_anisotropy.anisotropyStrength",
        0.0,
        1.0,
    ),
    (
        "extensions.KHR_materials_clearcoat.clearcoatFactor",
        0.0,
        1.0,
    ),
    (
        "extensions.KHR_materials_clearcoat.clearcoatRoughnessFactor",
        0.0,
        1.0,
    ),
    (
        "extensions.KHR_materials_emissive_strength.emissiveStrength",
        0.0,
        ANY,
    ),
    (
        "extensions.KHR_materials_pbrSpecularGlossiness.diffuseFactor",
        0.0,
        1.0,
    ),
    (
        "extensions.KHR_materials_pbrSpecularGlossiness.glossinessFactor",
        0.0,
        1.0,
    ),
    (
        "extensions.KHR_materials_pbrSpecularGlossiness.specularFactor",
        0.0,
        1.0,
    ),
    ("extensions.KHR_materials_sheen.sheenColorFactor", 0.0, 1.0),
    (
        "extensions.KHR_materials_sheen.sheenRoughnessFactor",
        0.0,
        1.0,
    ),
    (
        "extensions.KHR_materials_specular.specularColorFactor",
        0.0,
        ANY,
    ),
    ("extensions.KHR_materials_specular.specularFactor", 0.0, 1.0),
    (
        "extensions.KHR_materials_transmission.transmissionFactor",
        0.0,
        1.0,
    ),
    ("extensions.KHR_materials_volume.attenuationColor", 0.0, 1.0),
    (
        "extensions.KHR_materials_volume.attenuationDistance",
        0.0,
        ANY,
    ),
    ("extensions.KHR_materials_volume.thicknessFactor", 0.0, ANY),
];

/// Members of lights.
const OF_LIGHTS: [(&str, f64, f64); 4] = [
    ("color", 0.0, ANY),
    ("intensity", 0.0, ANY),
    ("spot.innerConeAngle", 0.0, std::f64::consts::FRAC_PI_2),
    ("spot.outerConeAngle", 0.0, std::f64::consts::FRAC_PI_2),
];

impl Reader<'_> {
    /// Warns of numbers that are clamped to the range of the specification.
    pub(super) fn warn_of_ranges(&mut self) {
        let root = self.document.as_json();
        for (i, material) in root.materials.iter().enumerate() {
            let what = format!("materials[{i}]");
            self.warn_of(&what, serialize::to_value(material), &OF_MATERIALS);
            let ior = material.extensions.as_ref().and_then(|e| e.ior.as_ref());
            if let Some(ior) = ior
                .map(|ior| ior.ior.0)
                .filter(|ior| *ior != 0.0 && *ior < 1.0)
            {
                self.warn(format!(
                    "{what}.extensions.KHR_materials_ior.ior: expected 0 or a number from 1, \
                     found {ior}: 1 is used"
                ));
            }
        }
        let lights = root.extensions.as_ref();
        let lights = lights.and_then(|e| e.khr_lights_punctual.as_ref());
        for (i, light) in lights.iter().flat_map(|l| &l.lights).enumerate() {
            let what = format!("extensions.KHR_lights_punctual.lights[{i}]");
            self.warn_of(&what, serialize::to_value(light), &OF_LIGHTS);
        }
    }

    fn warn_of(
        &mut self,
        what: &str,
        element: Result<Value, gltf::json::Error>,
        ranges: &[(&str, f64, f64)],
    ) {
        let Ok(element) = element else {
            return;
        };
        for (path, least, most) in ranges {
            let mut members = path.split('.');
            let value = members.try_fold(&element, |value, name| value.get(name));
            let numbers = match value {
                Some(Value::Array(list)) => list.as_slice(),
                Some(number) => std::slice::from_ref(number),
                None => continue,
            };
            let is_within = |n: &Value| n.as_f64().is_none_or(|x| (*least..=*most).contains(&x));
            let outside = numbers.iter().find(|n| !is_within(n));
            let Some(found) = outside.and_then(Value::as_f64) else {
                continue;
            };
            let expected = match *most == ANY {
                true => format!("a number from {least}"),
                false => format!("a number from {least} to {}", f32_of(*most)),
            };
            let [found, used] = [found, found.clamp(*least, *most)].map(f32_of);
            self.warn(format!(
                "{what}.{path}: expected {expected}, found {found}: {used} is used"
            ));
        }
    }
}
