//! The list of features against what the reader does.

use specula_scene::features::FORMATS;
use specula_scene::{Feature, Loaded, SceneError, Support};

use super::common::{Folder, warnings};

fn features() -> &'static [Feature] {
    let pbrt = FORMATS.iter().find(|f| f.0 == "pbrt-v4");
    pbrt.expect("pbrt-v4 is listed").1
}

/// Files that features refer to.
fn folder() -> Folder {
    let folder = Folder::new();
    let picture = ::image::RgbImage::from_pixel(2, 2, ::image::Rgb([128, 100, 200]));
    picture.save(folder.path().join("a.png")).unwrap();
    folder.write("a.bsdf", crate::measured::file());
    folder.write("lens.dat", "100 0 1.5 20\n-100 50 1 20\n");
    folder.write("more.pbrt", "Shape \"sphere\"\n");
    folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    );
    folder
}

const MEASURED: &str = "Material \"measured\" \"string filename\" \"a.bsdf\"";

/// What stands before and after `WorldBegin` to use a feature.
fn scene(class: &str, name: &str) -> (String, String) {
    let world = |text: String| (String::new(), text);
    let option = |text: String| (text, String::new());
    let png = "\"string filename\" \"a.png\"";
    let height = "Texture \"t\" \"float\" \"dots\"\n";
    match class {
        "directive" => directive(name),
        "shape" => world(format!("Shape {}", shape(name))),
        "shape parameter" => world(format!(
            "{height}Shape \"plymesh\" \"string filename\" \"a.ply\" \"texture {name}\" \"t\""
        )),
        "material" if name == "mix" => world(
            "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"
             Material \"mix\" \"string materials\" [\"a\" \"a\"]"
                .to_owned(),
        ),
        "material" if name == "measured" => world(MEASURED.to_owned()),
        "material" => world(format!("Material \"{name}\"")),
        "material parameter" => world(match name {
            "normalmap" => "Material \"diffuse\" \"string normalmap\" \"a.png\"".to_owned(),
            "displacement" => {
                format!("{height}Material \"diffuse\" \"texture displacement\" \"t\"")
            }
            "eta as a spectrum" => {
                "Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"".to_owned()
            }
            _ => {
                "Material \"conductor\" \"float uroughness\" .1 \"float vroughness\" .2".to_owned()
            }
        }),
        "texture" => {
            let kind = match name {
                "fbm" | "wrinkled" | "windy" => "float",
                _ => "spectrum",
            };
            let file = if name == "imagemap" { png } else { "" };
            world(format!("Texture \"x\" \"{kind}\" \"{name}\" {file}"))
        }
        "mapping" => world(format!(
            "Texture \"x\" \"float\" \"dots\" \"string mapping\" \"{name}\""
        )),
        "light" => {
            let image_projections = ["goniometric", "projection"].contains(&name);
            let file = if image_projections { png } else { "" };
            world(format!("LightSource \"{name}\" {file}"))
        }
        "area light" => {
            let light = "AreaLightSource \"diffuse\" \"float power\" 3 Shape \"sphere\"";
            world(match name {
                "diffuse" => light.to_owned(),
                _ => format!("ObjectBegin \"o\" {light} ObjectEnd"),
            })
        }
        "camera" => {
            let lens = if name == "realistic" {
                "\"string lensfile\" \"lens.dat\""
            } else {
                ""
            };
            option(format!("Camera \"{name}\" {lens}"))
        }
        "film" => option(format!("Film \"{name}\"")),
        "film parameter" if name == "sensor" => {
            option("Film \"rgb\" \"string sensor\" \"canon_eos_100d\"".to_owned())
        }
        "film parameter" => option(format!("Film \"rgb\" \"float {name}\" 200")),
        "filter" => option(format!("PixelFilter \"{name}\"")),
        "colour space" => world(format!(
            "ColorSpace \"{name}\" Material \"diffuse\" \"rgb reflectance\" [.1 .9 .2]"
        )),
        "integrator" => option(format!("Integrator \"{name}\"")),
        "sampler" => option(format!("Sampler \"{name}\"")),
        "spectrum" => world(match name {
            "rgb" => "LightSource \"point\" \"rgb I\" [1 2 3]".to_owned(),
            "blackbody" => "LightSource \"point\" \"blackbody I\" 4000".to_owned(),
            _ => "LightSource \"point\" \"spectrum I\" [400 1 700 2]".to_owned(),
        }),
        other => panic!("no scene for class {other}"),
    }
}

fn directive(name: &str) -> (String, String) {
    let medium = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" ";
    let (before, after) = match name {
        "Accelerator" => ("Accelerator \"bvh\"", ""),
        "ActiveTransform" => ("ActiveTransform All", ""),
        "AreaLightSource" => ("", "AreaLightSource \"diffuse\""),
        "Attribute" => ("", "Attribute \"shape\" \"float radius\" 2"),
        "AttributeBegin" | "AttributeEnd" => ("", "AttributeBegin AttributeEnd"),
        "Camera" => ("Camera \"perspective\"", ""),
        "ColorSpace" => ("ColorSpace \"rec2020\"", ""),
        "ConcatTransform" => ("ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]", ""),
        "CoordSysTransform" | "CoordinateSystem" => {
            ("", "CoordinateSystem \"a\" CoordSysTransform \"a\"")
        }
        "Film" => ("Film \"rgb\"", ""),
        "Identity" => ("Identity", ""),
        "Import" => ("", "Import \"more.pbrt\""),
        "Include" => ("", "Include \"more.pbrt\""),
        "Integrator" => ("Integrator \"path\"", ""),
        "LightSource" => ("", "LightSource \"point\""),
        "LookAt" => ("LookAt 0 0 -5 0 0 0 0 1 0", ""),
        "MakeNamedMaterial" | "NamedMaterial" => (
            "",
            "MakeNamedMaterial \"m\" \"string type\" \"diffuse\" NamedMaterial \"m\"",
        ),
        "MakeNamedMedium" => (medium, ""),
        "Material" => ("", "Material \"diffuse\""),
        "MediumInterface" => (medium, "MediumInterface \"m\" \"\""),
        "ObjectBegin" | "ObjectEnd" | "ObjectInstance" => (
            "",
            "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\"",
        ),
        "Option" => ("Option \"seed\" 3", ""),
        "PixelFilter" => ("PixelFilter \"box\"", ""),
        "ReverseOrientation" => ("", "ReverseOrientation"),
        "Rotate" => ("Rotate 30 0 0 1", ""),
        "Sampler" => ("Sampler \"zsobol\"", ""),
        "Scale" => ("Scale 1 2 3", ""),
        "Shape" => ("", "Shape \"sphere\""),
        "Texture" => ("", "Texture \"t\" \"float\" \"constant\""),
        "Transform" => ("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]", ""),
        "TransformBegin" | "TransformEnd" => ("", "TransformBegin TransformEnd"),
        "TransformTimes" => ("TransformTimes 0 1", ""),
        "Translate" => ("Translate 1 2 3", ""),
        "WorldBegin" => ("", ""),
        other => panic!("no scene for directive {other}"),
    };
    (before.to_owned(), after.to_owned())
}

fn shape(name: &str) -> String {
    let (kind, parameters) = name.split_once(": ").unwrap_or((name, ""));
    let points = "\"point3 P\" [0 0 0 1 0 0 0 1 0";
    let given = match (kind, parameters) {
        ("trianglemesh", _) => format!("{points}]"),
        ("loopsubdiv", _) => format!("{points}] \"integer indices\" [0 1 2]"),
        ("bilinearmesh", _) => format!("{points} 1 1 1]"),
        ("plymesh", _) => "\"string filename\" \"a.ply\"".to_owned(),
        ("curve", "ribbon") => {
            format!("{points} 1 1 1] \"string type\" \"ribbon\" \"normal N\" [0 0 1 0 0 1]")
        }
        ("curve", look) => format!("{points} 1 1 1] \"string type\" \"{look}\""),
        (_, "") => String::new(),
        (_, names) => names
            .split(", ")
            .map(|n| {
                let value = if n == "phimax" { "90" } else { "0.5" };
                let sign = if n == "zmin" { "-" } else { "" };
                format!("\"float {n}\" {sign}{value} ")
            })
            .collect(),
    };
    format!("\"{kind}\" {given}")
}

fn load(folder: &Folder, feature: &Feature) -> Result<Loaded, SceneError> {
    let (before, after) = scene(feature.class, feature.name);
    folder.load(format!("{before}\nWorldBegin\n{after}\nShape \"sphere\"\n"))
}

#[test]
fn each_feature_is_treated_as_listed() {
    let folder = folder();
    for feature in features() {
        let what = format!("{} {}", feature.class, feature.name);
        let result = load(&folder, feature);
        match feature.support {
            Support::Full => {
                let loaded = result.unwrap_or_else(|e| panic!("{what}: {e}"));
                assert!(
                    warnings(&loaded).is_empty(),
                    "{what}: {:?}",
                    warnings(&loaded)
                );
            }
            Support::Approximated(how) => {
                result.unwrap_or_else(|e| panic!("{what}: {e}"));
                assert!(!how.is_empty(), "{what}");
            }
            Support::Refused(_) => assert!(result.is_err(), "{what}"),
        }
    }
}

/// Approximations that change a picture visibly are told.
#[test]
fn stand_ins_are_told() {
    let folder = folder();
    for (class, name) in [
        ("shape parameter", "displacement"),
        ("material", "subsurface"),
        ("texture", "ptex"),
        ("film", "spectral"),
        ("film parameter", "sensor"),
        ("integrator", "sppm"),
        ("directive", "MediumInterface"),
        ("area light", "diffuse in an object"),
    ] {
        let feature = features()
            .iter()
            .find(|f| (f.class, f.name) == (class, name));
        let feature = feature.unwrap_or_else(|| panic!("{class} {name} is not listed"));
        assert!(
            matches!(feature.support, Support::Approximated(_)),
            "{name}"
        );
        let loaded = load(&folder, feature).unwrap();
        assert!(!warnings(&loaded).is_empty(), "{class} {name}");
    }
}

#[test]
fn what_is_not_listed_is_refused() {
    let folder = folder();
    for class in [
        "camera",
        "film",
        "filter",
        "integrator",
        "sampler",
        "shape",
        "material",
        "texture",
        "mapping",
        "light",
        "colour space",
    ] {
        let feature = Feature::full(class, "nonsense");
        assert!(load(&folder, &feature).is_err(), "{class}");
    }
    let names: Vec<_> = features().iter().map(|f| (f.class, f.name)).collect();
    for (i, name) in names.iter().enumerate() {
        assert!(!names[..i].contains(name), "{name:?} is listed twice");
    }
}
