//! `<medium>`: what absorbs, and what is said of the rest.

use specula_scene::Loaded;
use specula_scene::scene::Material;

use super::common::{load, warnings};

/// The first shape's material.
fn first(loaded: &Loaded) -> &Material {
    &loaded.scene.materials[loaded.scene.shapes[0].material.0]
}

fn glass(medium: &str) -> Loaded {
    load(&format!(
        "<integrator type=\"volpath\"/>
         <shape type=\"sphere\"><bsdf type=\"dielectric\"/>{medium}</shape>"
    ))
    .unwrap()
}

#[test]
fn absorption_is_extinction_less_what_scatters() {
    let loaded = glass(
        "<medium name=\"interior\" type=\"homogeneous\">
           <rgb name=\"sigma_t\" value=\"1 2 4\"/><float name=\"albedo\" value=\"0.25\"/>
           <float name=\"scale\" value=\"2\"/>
           <phase type=\"hg\"><float name=\"g\" value=\"0.5\"/></phase>
         </medium>",
    );
    let material = first(&loaded);
    assert_eq!(material.absorption.to_array(), [1.5, 3.0, 6.0]);
    assert_eq!(material.around.map(|a| a.to_array()), Some([0.0; 3]));
    let said = warnings(&loaded).join("\n");
    assert!(said.contains("0.25, 0.5, 1 per unit"), "{said}");
}

#[test]
fn exteriors_volumes_and_references_are_read() {
    let loaded = load(
        "<integrator type=\"volpathmis\"/>
         <medium type=\"homogeneous\" id=\"ink\">
           <volume type=\"constvolume\" name=\"sigma_t\"><rgb name=\"value\" value=\"1 2 3\"/></volume>
           <float name=\"albedo\" value=\"0\"/>
         </medium>
         <shape type=\"sphere\"><bsdf type=\"null\"/><ref name=\"exterior\" id=\"ink\"/></shape>
         <shape type=\"sphere\"><ref name=\"interior\" id=\"ink\"/></shape>",
    )
    .unwrap();
    let material = first(&loaded);
    assert!(material.absorption.is_black());
    assert_eq!(material.around.map(|a| a.to_array()), Some([1.0, 2.0, 3.0]));
    assert_eq!(warnings(&loaded).len(), 1, "{:?}", loaded.warnings);
}

#[test]
fn the_older_dialects_names_are_known() {
    let medium = |inside: &str| {
        let loaded = super::common::Folder::new()
            .load(format!(
                "<scene version=\"0.6.0\"><integrator type=\"volpath\"/>
                 <sensor type=\"perspective\"/><emitter type=\"constant\"/>
                 <shape type=\"sphere\"><bsdf type=\"dielectric\"/>
                 <medium name=\"interior\" type=\"homogeneous\">{inside}</medium></shape></scene>"
            ))
            .unwrap();
        first(&loaded).absorption.to_array()
    };
    let pair = "<rgb name=\"sigmaA\" value=\"1, 2, 3\"/><rgb name=\"sigmaS\" value=\"0, 0, 0\"/>";
    assert_eq!(medium(pair), [1.0, 2.0, 3.0]);
    let milk = "<string name=\"material\" value=\"wholemilk\"/>";
    assert_eq!(medium(milk), [0.0011, 0.0024, 0.014]);
}

#[test]
fn media_that_do_nothing_are_empty_space() {
    let grid = glass(
        "<medium name=\"interior\" type=\"heterogeneous\">
         <volume name=\"sigma_t\" type=\"gridvolume\"/></medium>",
    );
    assert_eq!(first(&grid).around, None);
    assert!(warnings(&grid).join("\n").contains("varies in space"));
    let ink = "<medium name=\"interior\" type=\"homogeneous\"/>";
    let path = load(&format!(
        "<integrator type=\"path\"/><shape type=\"sphere\"><bsdf type=\"dielectric\"/>{ink}</shape>"
    ))
    .unwrap();
    assert_eq!(first(&path).around, None);
    let said = warnings(&path).join("\n");
    assert!(said.contains("is empty space, as with Mitsuba's"), "{said}");
    let camera = super::common::Folder::new()
        .load(
            "<scene version=\"3.0.0\"><integrator type=\"volpath\"/>
             <medium type=\"homogeneous\" id=\"fog\"/>
             <sensor type=\"perspective\"><ref name=\"medium\" id=\"fog\"/></sensor>
             <emitter type=\"constant\"/><shape type=\"sphere\"><bsdf type=\"dielectric\"/>
             <ref name=\"exterior\" id=\"fog\"/></shape></scene>",
        )
        .unwrap();
    assert_eq!(first(&camera).around, None);
    assert!(warnings(&camera).join("\n").contains("the camera is in"));
}

#[test]
fn faults_of_media_are_named() {
    for (medium, message) in [
        (
            "<medium type=\"homogeneous\"/>",
            "\"interior\" or \"exterior\"",
        ),
        ("<medium name=\"interior\" type=\"gas\"/>", "medium"),
        (
            "<medium name=\"interior\" type=\"homogeneous\"><float name=\"scale\" value=\"-1\"/></medium>",
            "\"scale\"",
        ),
        (
            "<medium name=\"interior\" type=\"homogeneous\"><rgb name=\"sigma_t\" value=\"1 -1 1\"/></medium>",
            "\"sigma_t\"",
        ),
    ] {
        let shape = format!("<shape type=\"sphere\">{medium}</shape>");
        let error = load(&shape).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}
