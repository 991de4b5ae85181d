//! Parameters, includes, references and properties.

use specula_scene::scene::{ColourParam, Light, MaterialKind};
use specula_scene::{LoadOptions, Loaded};

use super::common::{Folder, REST, load, load_shape, warnings};

fn reflectance(loaded: &Loaded, material: usize) -> [f32; 3] {
    match loaded.scene.materials[material].kind {
        MaterialKind::Diffuse {
            reflectance: ColourParam::Value(c),
            ..
        } => c.to_array(),
        ref other => panic!("{other:?}"),
    }
}

#[test]
fn parameters_win_over_defaults_and_the_longest_name_wins() {
    let text = format!(
        r#"<scene version="3.0.0"><default name="r" value="0.9"/><default name="red" value="0.25"/>
        <default name="kind" value="diffuse"/>
        <shape type="rectangle"><bsdf type="$kind"><rgb name="reflectance" value="$red $r 0"/>
        </bsdf></shape>{REST}</scene>"#
    );
    let folder = Folder::new();
    assert_eq!(
        reflectance(&folder.load(&text).unwrap(), 0),
        [0.25, 0.9, 0.0]
    );
    let mut options = LoadOptions::default();
    options.parameters = vec![("r".to_owned(), "0.5".to_owned())];
    let loaded = folder.load_with(&text, &options).unwrap();
    assert_eq!(reflectance(&loaded, 0), [0.25, 0.5, 0.0]);
}

#[test]
fn references_may_come_before_what_they_name() {
    let loaded = load(
        r#"<shape type="rectangle"><ref id="b"/></shape><shape type="cube"><ref id="c"/></shape>
        <shape type="sphere"><ref name="surface" id="a"/></shape>
        <bsdf type="diffuse" id="a"><rgb name="reflectance" value="0.1"/></bsdf>
        <alias id="a" as="b"/><alias id="b" as="c"/>"#,
    )
    .unwrap();
    // One material for both meshes; the sphere has other coordinates and so a material of its own.
    let materials: Vec<usize> = loaded.scene.shapes.iter().map(|s| s.material.0).collect();
    assert_eq!(materials[0], materials[1]);
    assert_eq!(reflectance(&loaded, materials[0]), [0.1; 3]);
    assert_eq!(warnings(&loaded), [""; 0]);
}

#[test]
fn included_files_find_theirs_beside_them() {
    let folder = Folder::new();
    folder.write(
        "parts/shapes.xml",
        r#"<scene version="3.0.0"><shape type="obj"><string name="filename" value="a.obj"/></shape>
        <include filename="more.xml"/></scene>"#,
    );
    folder.write("parts/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write(
        "parts/more.xml",
        r#"<bsdf version="3.0.0" type="diffuse" id="m"/>"#,
    );
    folder.write("meshes/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let loaded = folder
        .load(format!(
            r#"<scene version="3.0.0"><path value="meshes"/><include filename="parts/shapes.xml"/>
            <shape type="obj"><string name="filename" value="b.obj"/><ref id="m"/></shape>
            {REST}</scene>"#
        ))
        .unwrap();
    assert_eq!(loaded.scene.shapes.len(), 2);
    assert_eq!(warnings(&loaded), [""; 0]);
}

#[test]
fn what_nobody_uses_is_reported_with_its_place() {
    let loaded = load_shape(r#"<bsdf type="diffuse"><float name="emit" value="1"/></bsdf>"#);
    let loaded = loaded.unwrap();
    assert_eq!(
        warnings(&loaded),
        ["\"emit\" of bsdf \"diffuse\" is unused"]
    );
    assert_eq!(
        (loaded.warnings[0].line(), loaded.warnings[0].column()),
        (2, 46)
    );
    let quiet = load(
        r#"<bsdf type="diffuse" id="spare"><float name="x" value="1"/></bsdf><shape type="cube"/>"#,
    );
    assert_eq!(
        warnings(&quiet.unwrap()),
        [""; 0],
        "a plugin that nobody refers to"
    );
}

#[test]
fn meshes_and_pictures_are_stored_once() {
    let folder = Folder::new();
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let shape = r#"<shape type="obj"><string name="filename" value="a.obj"/></shape>"#;
    let loaded = folder
        .load(format!(
            r#"<scene version="3.0.0">{shape}{shape}{REST}</scene>"#
        ))
        .unwrap();
    assert_eq!(
        (loaded.scene.shapes.len(), loaded.scene.meshes.len()),
        (2, 1)
    );
    assert_eq!(loaded.scene.materials.len(), 1, "one default material");
    assert!(matches!(loaded.scene.lights[0], Light::Infinite { .. }));
}
