//! Scenes written and read back.

use super::*;
use crate::scene::{
    ColourParam, FloatParam, Material, MaterialKind, Relief, Roughness, RoughnessMapping, Texture,
};

/// Writes a scene and reads it back.
fn round_trip(scene: &Scene) -> (Scene, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.pbrt");
    let notes = write_pbrt(scene, &path).unwrap();
    let loaded = crate::load(&path).unwrap();
    let warnings: Vec<_> = loaded.warnings.iter().map(|w| w.message()).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
    (loaded.scene, notes)
}

#[test]
fn the_built_in_scene_survives() {
    let scene = crate::builtin::orbs();
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    assert_eq!(back.film.resolution, scene.film.resolution);
    assert_eq!(back.settings, scene.settings);
    assert_eq!(back.camera.projection, scene.camera.projection);
    assert!(
        back.camera
            .to_world
            .abs_diff_eq(scene.camera.to_world, 1e-5)
    );
    assert_eq!(back.shapes.len(), scene.shapes.len());
    for (a, b) in scene.shapes.iter().zip(&back.shapes) {
        let mesh = |scene: &Scene, shape: &crate::scene::Shape| match shape.geometry {
            crate::scene::Geometry::Mesh(id) => scene.meshes[id.0].clone(),
            other => panic!("{other:?}"),
        };
        assert_eq!(mesh(&scene, a), mesh(&back, b));
        assert!(a.to_world.abs_diff_eq(b.to_world, 1e-5));
        assert_eq!(a.emission, b.emission);
        assert_eq!(
            summary_of(&scene, a.material),
            summary_of(&back, b.material)
        );
    }
}

/// What a material is, without the numbers of its textures.
fn summary_of(scene: &Scene, id: crate::scene::MaterialId) -> String {
    match scene.materials[id.0].kind {
        MaterialKind::Diffuse { .. } => "diffuse".to_owned(),
        ref kind => format!("{kind:?}"),
    }
}

#[test]
fn squared_roughness_displacement_and_energy_survive() {
    let mut scene = crate::builtin::orbs();
    scene.textures.push(Texture::Constant(Rgb::splat(0.5)));
    let texture = crate::scene::TextureId(scene.textures.len() - 1);
    let mut material = Material::new(MaterialKind::CoatedDiffuse {
        reflectance: ColourParam::Value(Rgb::from([0.25, 0.5, 0.75])),
        eta: 1.5,
        roughness: Roughness {
            v: FloatParam::Texture(texture),
            ..Roughness::isotropic(FloatParam::Value(0.5), RoughnessMapping::Square)
        },
    });
    material.relief = Some(Relief::Height(FloatParam::Texture(texture)));
    material.energy = Some(crate::Energy::Multibounce(Default::default()));
    scene.materials.push(material);
    let last = crate::scene::MaterialId(scene.materials.len() - 1);
    scene.shapes[0].material = last;
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    let found = &back.materials[back.shapes[0].material.0];
    let MaterialKind::CoatedDiffuse { eta, roughness, .. } = found.kind else {
        panic!("{found:?}")
    };
    assert_eq!((eta, roughness.u), (1.5, FloatParam::Value(0.25)));
    let FloatParam::Texture(v) = roughness.v else {
        panic!("{roughness:?}")
    };
    assert!(matches!(back.textures[v.0], Texture::Scale { a, b } if a == b));
    assert!(matches!(found.relief, Some(Relief::Height(_))));
    assert_eq!(found.energy, scene.materials[last.0].energy);
}

#[test]
fn what_cannot_be_said_is_noted_once() {
    let mut scene = crate::builtin::orbs();
    for material in &mut scene.materials {
        material.one_sided = true;
    }
    let (_, notes) = round_trip(&scene);
    assert_eq!(notes.len(), 1, "{notes:?}");
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let scene = crate::builtin::orbs();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("absent").join("out.pbrt");
    let error = write_pbrt(&scene, &path).unwrap_err();
    assert!(error.to_string().contains("absent"), "{error}");
}

#[test]
fn strings_are_escaped() {
    assert_eq!(quoted("a\"b\\c\n"), "\"a\\\"b\\\\c_\"");
}
