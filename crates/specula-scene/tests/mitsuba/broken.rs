//! Broken scenes: the error says where and what was expected.

use specula_scene::{ErrorKind, LoadOptions, SceneError};

use super::common::{Folder, REST, load, load_shape};

use ErrorKind::{
    Duplicate, EmptyScene, Image, Limit, Mesh, Parameter, Spectrum, Structure, Syntax,
};
use ErrorKind::{UnknownName, Unsupported};

fn check(error: &SceneError, kind: ErrorKind, line: usize, part: &str) {
    let found = (error.kind(), error.line());
    assert_eq!(found, (kind, line), "{error} at {}", error.place());
    let help = error.help().unwrap_or("");
    assert!(
        error.message().contains(part) || help.contains(part),
        "{error} ({help})"
    );
}

#[test]
fn broken_xml_is_located() {
    let folder = Folder::new();
    for (text, line, column, part) in [
        (
            "<scene version=\"3.0.0\">\n  <shape type=\"cube\">\n</scene>",
            3,
            1,
            "XML",
        ),
        ("", 1, 1, "XML"),
        ("<scene version=\"3.0.0\"><a b=c/></scene>", 1, 29, "XML"),
        (
            "<!DOCTYPE x [<!ENTITY a \"b\">]><scene version=\"3\"/>",
            1,
            1,
            "XML",
        ),
    ] {
        let error = folder.load(text).unwrap_err();
        check(&error, ErrorKind::Syntax, line, part);
        assert_eq!(error.column(), column, "{text}: {error}");
    }
    let error = folder
        .load(b"<scene version=\"3.0.0\">\n\xff".as_slice())
        .unwrap_err();
    check(&error, ErrorKind::Encoding, 2, "UTF-8");
    let error = folder
        .load("<bsdf version=\"3.0.0\" type=\"diffuse\"/>")
        .unwrap_err();
    check(&error, ErrorKind::Structure, 1, "expected <scene>");
    let error = folder.load("<scene version=\"new\"/>").unwrap_err();
    check(&error, ErrorKind::Parameter, 1, "\"3.0.0\"");
}

/// What stands in a shape, and the error that it gives.
const IN_A_SHAPE: &[(&str, ErrorKind, &str)] = &[
    ("<bsdf/>", Parameter, "attribute \"type\""),
    (
        "<bsdf type=\"diffuse\"><float name=\"reflectance\" value=\"x\"/></bsdf>",
        Parameter,
        "found \"x\"",
    ),
    (
        "<bsdf type=\"diffuse\"><float value=\"1\"/></bsdf>",
        Parameter,
        "attribute \"name\"",
    ),
    (
        "<bsdf type=\"diffuse\"><string name=\"reflectance\" value=\"1\"/></bsdf>",
        Parameter,
        "found <string>",
    ),
    (
        "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"-1\"/></bsdf>",
        Parameter,
        "not negative",
    ),
    (
        "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1 2\"/></bsdf>",
        Parameter,
        "one or three",
    ),
    (
        "<bsdf type=\"diffuse\"><float name=\"a\" value=\"1\"/><float name=\"a\" value=\"2\"/></bsdf>",
        Duplicate,
        "given twice",
    ),
    (
        "<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"500:1, 400:1\"/></bsdf>",
        Parameter,
        "must increase",
    ),
    (
        "<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" filename=\"no.spd\"/></bsdf>",
        Spectrum,
        "no.spd",
    ),
    (
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"/></bsdf>",
        Parameter,
        "\"filename\"",
    ),
    (
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" value=\"no.png\"/></texture></bsdf>",
        Image,
        "no.png",
    ),
    (
        "<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"cheese\"/></bsdf>",
        UnknownName,
        "diamond",
    ),
    (
        "<bsdf type=\"conductor\"><string name=\"material\" value=\"Xx\"/></bsdf>",
        UnknownName,
        "chemical",
    ),
    (
        "<bsdf type=\"conductor\"><string name=\"material\" value=\"Au\"/><float name=\"eta\" value=\"1\"/></bsdf>",
        Parameter,
        "excludes",
    ),
    (
        "<bsdf type=\"roughconductor\"><float name=\"alpha_u\" value=\"1\"/></bsdf>",
        Parameter,
        "alpha_v",
    ),
    (
        "<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"g\"/></bsdf>",
        Parameter,
        "beckmann or ggx",
    ),
    (
        "<bsdf type=\"principled\"><float name=\"eta\" value=\"1.5\"/><float name=\"specular\" value=\"1\"/></bsdf>",
        Parameter,
        "exclude",
    ),
    ("<bsdf type=\"twosided\"/>", Structure, "a bsdf within"),
    (
        "<bsdf type=\"bumpmap\"><bsdf type=\"diffuse\"/></bsdf>",
        Structure,
        "one texture",
    ),
    (
        "<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/></bsdf>",
        Structure,
        "found 1",
    ),
    ("<bsdf type=\"fancy\"/>", Unsupported, "roughplastic"),
    ("<ref id=\"nothing\"/>", UnknownName, "\"nothing\""),
    ("<ref/>", Parameter, "\"id\""),
    (
        "<transform name=\"to_world\"><shear x=\"1\"/></transform>",
        Syntax,
        "lookat",
    ),
    (
        "<transform name=\"to_world\"><scale value=\"0\"/></transform>",
        EmptyScene,
        "no area",
    ),
    (
        "<transform name=\"to_world\"><translate x=\"1e30\"/></transform>",
        Limit,
        "1e18",
    ),
    (
        "<boolean name=\"flip_normals\" value=\"maybe\"/>",
        Parameter,
        "\"true\"",
    ),
    (
        "<integer name=\"flip_normals\" value=\"1\"/>",
        Parameter,
        "a boolean",
    ),
    ("<frob name=\"x\"/>", Parameter, "no element of a scene"),
    ("<emitter type=\"point\"/>", Unsupported, "unknown emitter"),
    (
        "<bsdf type=\"diffuse\"><float name=\"reflectance\" value=\"$x\"/></bsdf>",
        UnknownName,
        "$x",
    ),
    (
        "<bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"diffuse\" id=\"a\"/>",
        Duplicate,
        "\"a\"",
    ),
];

/// What stands in the scene, and the error that it gives.
const IN_THE_SCENE: &[(&str, ErrorKind, &str)] = &[
    ("<shape type=\"obj\"/>", Parameter, "\"filename\""),
    (
        "<shape type=\"obj\"><string name=\"filename\" value=\"no.obj\"/></shape>",
        Mesh,
        "no.obj",
    ),
    (
        "<shape type=\"sphere\"><float name=\"radius\" value=\"0\"/></shape>",
        Parameter,
        "above 0",
    ),
    ("<shape type=\"instance\"/>", Parameter, "shapegroup"),
    ("<emitter type=\"area\"/>", Parameter, "within a shape"),
    ("<include filename=\"no.xml\"/>", ErrorKind::Io, "no.xml"),
    ("<alias id=\"a\" as=\"b\"/>", UnknownName, "\"a\""),
    ("<default name=\"a\"/>", Parameter, "\"value\""),
    ("<sensor type=\"distant\"/>", Unsupported, "perspective"),
    (
        "<sensor type=\"perspective\"><float name=\"fov\" value=\"180\"/></sensor><shape type=\"cube\"/>",
        Parameter,
        "180 degrees",
    ),
    (
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"-2\"/></integrator>",
        Parameter,
        "-1 or more",
    ),
];

#[test]
fn faults_of_properties_are_located() {
    for (inside, kind, part) in IN_A_SHAPE {
        check(&load_shape(inside).unwrap_err(), *kind, 2, part);
    }
    for (inside, kind, part) in IN_THE_SCENE {
        check(&load(inside).unwrap_err(), *kind, 2, part);
    }
}

#[test]
fn scenes_without_a_part_are_errors() {
    let folder = Folder::new();
    let error = folder
        .load("<scene version=\"3.0.0\"><shape type=\"cube\"/></scene>")
        .unwrap_err();
    check(&error, ErrorKind::Structure, 1, "no <sensor>");
    let error = folder
        .load(format!("<scene version=\"3.0.0\">{REST}</scene>"))
        .unwrap_err();
    check(&error, ErrorKind::EmptyScene, 1, "no shapes");
}

#[test]
fn rings_and_depths_end_in_errors() {
    let folder = Folder::new();
    folder.write(
        "loop.xml",
        "<scene version=\"3.0.0\"><include filename=\"loop.xml\"/></scene>",
    );
    let error = folder
        .load("<scene version=\"3.0.0\"><include filename=\"loop.xml\"/></scene>")
        .unwrap_err();
    check(&error, ErrorKind::RecursiveInclude, 1, "includes itself");
    let error =
        load_shape("<ref id=\"a\"/><bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/></bsdf>");
    assert!(error.is_err());
    let error = load(
        "<shape type=\"cube\"><ref id=\"a\"/></shape><bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/></bsdf>",
    )
    .unwrap_err();
    check(&error, ErrorKind::Limit, 2, "refers to itself");
    let deep = format!(
        "<scene version=\"3.0.0\">{}{}</scene>",
        "<bsdf type=\"mask\">".repeat(100_000),
        "</bsdf>".repeat(100_000)
    );
    check(
        &folder.load(deep).unwrap_err(),
        ErrorKind::Limit,
        1,
        "elements within elements",
    );
}

#[test]
fn limits_hold() {
    let folder = Folder::new();
    let text = format!("<scene version=\"3.0.0\"><shape type=\"cube\"/>{REST}</scene>");
    let mut options = LoadOptions::default();
    options.limits.max_bytes = 16;
    let error = folder.load_with(&text, &options).unwrap_err();
    check(&error, ErrorKind::Io, 1, "more than 16 bytes");
    let mut options = LoadOptions::default();
    options.limits.max_pixels = 16;
    let film =
        "<sensor type=\"perspective\"><film type=\"hdrfilm\"/></sensor><shape type=\"cube\"/>";
    let error = folder
        .load_with(format!("<scene version=\"3.0.0\">{film}</scene>"), &options)
        .unwrap_err();
    check(&error, ErrorKind::Limit, 1, "at most 16");
    assert!(folder.path().exists());
}

/// Twenty blends, each of the one before with itself: 2^20 materials.
#[test]
fn blends_that_double_end_in_an_error() {
    let mut text = "<scene version=\"3.0.0\"><bsdf type=\"diffuse\" id=\"b0\"/>\n".to_owned();
    for i in 0..20 {
        let next = i + 1;
        text += &format!(
            "<bsdf type=\"blendbsdf\" id=\"b{next}\"><ref id=\"b{i}\"/><ref id=\"b{i}\"/></bsdf>\n"
        );
    }
    text += &format!("<shape type=\"cube\"><ref id=\"b20\"/></shape>{REST}</scene>");
    let error = Folder::new().load(&text).unwrap_err();
    assert_eq!(error.kind(), Limit, "{error}");
    assert!(error.message().contains("131072"), "{error}");
}
