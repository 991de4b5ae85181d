//! Files of pbrt-v3 against what pbrt-v4's `--upgrade` makes of them.

use specula_scene::features::FORMATS;
use specula_scene::scene::{FloatParam, Light, MaterialKind};
use specula_scene::{Format, Scene};

use super::common::{Folder, warnings};

const READ_AS: &str =
    "the file is read as pbrt-v3, with the names that pbrt-v4's `--upgrade` gives it";

/// A folder with a picture, which is wide, and a curve.
fn folder() -> Folder {
    let folder = Folder::new();
    let picture = ::image::RgbImage::from_fn(4, 2, |x, y| {
        ::image::Rgb([(x * 60) as u8, (y * 90) as u8, 200])
    });
    picture.save(folder.path().join("a.png")).unwrap();
    folder
}

/// The scene and its warnings but for the one about the version, which is given once.
#[track_caller]
fn read(folder: &Folder, text: &str) -> (Scene, Vec<String>) {
    let loaded = folder
        .load(text)
        .unwrap_or_else(|e| panic!("{}: {e}", e.place()));
    assert_eq!(loaded.format, Format::Pbrt);
    let mut said = warnings(&loaded);
    let before = said.len();
    said.retain(|w| w != READ_AS);
    assert_eq!(before - said.len(), 1, "{said:?}");
    (loaded.scene, said)
}

/// Worlds of pbrt-v3, and what they are in pbrt-v4.
const WORLDS: &[(&str, &str)] = &[
    (
        "Material \"matte\" \"color Kd\" [.1 .2 .3] \"float sigma\" 20",
        "Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3]",
    ),
    (
        "Material \"plastic\" \"rgb Kd\" [.1 .2 .3] \"float roughness\" .2 \"bool remaproughness\" \"false\"",
        "Material \"coateddiffuse\" \"rgb reflectance\" [.1 .2 .3] \"float roughness\" .2 \
         \"bool remaproughness\" false",
    ),
    (
        "Material \"plastic\" \"rgb Kd\" [.1 .2 .3] \"rgb Ks\" [0 0 0] \"float roughness\" .2",
        "Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3]",
    ),
    (
        "Material \"uber\" \"rgb Kd\" [.5 .5 .5] \"float index\" 1.3 \"rgb Kr\" [0 0 0] \"rgb opacity\" [1 1 1]",
        "Material \"coateddiffuse\" \"rgb reflectance\" [.5 .5 .5] \"float eta\" 1.3",
    ),
    (
        "Material \"substrate\" \"rgb Kd\" [.1 .2 .3] \"rgb Ks\" [1 1 1] \"float uroughness\" .1 \
         \"float vroughness\" .2",
        "Material \"coateddiffuse\" \"rgb reflectance\" [.1 .2 .3] \"float uroughness\" .1 \
         \"float vroughness\" .2",
    ),
    (
        "Material \"metal\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float roughness\" .1",
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \
         \"float roughness\" .1",
    ),
    (
        "Material \"metal\" \"spectrum eta\" \"spds/Al.eta.spd\" \"spectrum k\" \"spds/Al.k.spd\"",
        "Material \"conductor\" \"spectrum eta\" \"metal-Al-eta\" \"spectrum k\" \"metal-Al-k\"",
    ),
    (
        "Material \"mirror\" \"rgb Kr\" [0 0 0]",
        "Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\" \
         \"float roughness\" 0",
    ),
    (
        "Material \"glass\" \"float index\" 1.7 \"rgb Kr\" [1 1 1] \"rgb Kt\" [1 1 1]",
        "Material \"dielectric\" \"float eta\" 1.7",
    ),
    (
        "Material \"translucent\" \"rgb Kd\" [.1 .2 .3] \"rgb reflect\" [0 0 0] \"rgb transmit\" [1 1 1] \
         \"float roughness\" .3",
        "Material \"diffusetransmission\" \"rgb transmittance\" [.1 .2 .3]",
    ),
    (
        "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"rgb Kd\" [1 0 0]
         MakeNamedMaterial \"b\" \"string type\" \"matte\" \"rgb Kd\" [0 1 0]
         Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" \"rgb amount\" [.3 .3 .3]",
        "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]
         MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 1 0]
         Material \"mix\" \"string materials\" [\"b\" \"a\"] \"float amount\" .3",
    ),
    (
        "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"a.png\" \"bool trilinear\" \"true\" \"bool gamma\" \"false\"
         Texture \"s\" \"color\" \"scale\" \"texture tex1\" \"t\" \"rgb tex2\" [.5 .5 .5]
         Texture \"b\" \"float\" \"scale\" \"float tex1\" .5 \"float tex2\" .3
         Material \"matte\" \"texture Kd\" \"s\" \"texture bumpmap\" \"b\"",
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" \"string encoding\" \"linear\"
         \"string filter\" \"trilinear\"
         Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"t\" \"float scale\" .5
         Texture \"b\" \"float\" \"scale\" \"float tex\" .5 \"float scale\" .3
         Material \"diffuse\" \"texture reflectance\" \"s\" \"texture displacement\" \"b\"",
    ),
    (
        "LightSource \"infinite\" \"string mapname\" \"a.png\" \"rgb L\" [2 2 2] \"rgb scale\" [3 3 3] \
         \"integer nsamples\" 4 Material \"matte\"",
        "LightSource \"infinite\" \"string filename\" \"a.png\" \"float scale\" 6 Material \"diffuse\"",
    ),
    (
        "LightSource \"infinite\" \"string mapname\" \"a.png\" \"spectrum scale\" [400 2 700 2] Material \"matte\"",
        "LightSource \"infinite\" \"string filename\" \"a.png\" \"float scale\" 2 Material \"diffuse\"",
    ),
    (
        "LightSource \"point\" \"blackbody I\" [3000 2] \"color scale\" [3 3 3] Material \"matte\"
         AreaLightSource \"area\" \"rgb L\" [1 2 3] \"integer nsamples\" 8 Shape \"disk\"",
        "LightSource \"point\" \"blackbody I\" 3000 \"float scale\" 6 Material \"diffuse\"
         AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] Shape \"disk\"",
    ),
    (
        "Material \"matte\" Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2] \
         \"float st\" [0 0 1 0 0 1] \"bool discarddegenerateUVs\" \"true\" \"float shadowalpha\" 0",
        "Material \"diffuse\" Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \
         \"point2 uv\" [0 0 1 0 0 1]",
    ),
    (
        "Texture \"t\" \"color\" \"constant\" \"rgb value\" [1 0 0] Material \"matte\" \"texture Kd\" \"t\"
         Shape \"disk\" MakeNamedMaterial \"m\" \"string type\" \"matte\" NamedMaterial \"m\" Shape \"disk\"
         Texture \"t\" \"color\" \"constant\" \"rgb value\" [0 1 0]
         MakeNamedMaterial \"m\" \"string type\" \"matte\" \"texture Kd\" \"t\" NamedMaterial \"m\"",
        "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0] Material \"diffuse\" \"texture reflectance\" \"t\"
         Shape \"disk\" MakeNamedMaterial \"m\" \"string type\" \"diffuse\" NamedMaterial \"m\" Shape \"disk\"
         Texture \"u\" \"spectrum\" \"constant\" \"rgb value\" [0 1 0]
         MakeNamedMaterial \"n\" \"string type\" \"diffuse\" \"texture reflectance\" \"u\" NamedMaterial \"n\"",
    ),
];

#[test]
fn worlds_are_those_of_the_upgrade() {
    let folder = folder();
    for (old, new) in WORLDS {
        let (mut scene, said) = read(
            &folder,
            &format!("WorldBegin\n{old}\nShape \"sphere\"\nWorldEnd\n"),
        );
        assert_eq!(said, [""; 0], "{old}");
        let loaded = folder
            .load(format!("WorldBegin\n{new}\nShape \"sphere\"\n"))
            .unwrap();
        for material in &mut scene.materials {
            // The second of a name gets one of its own.
            material.name = material
                .name
                .take()
                .map(|n| n.replace("m (renamed 2)", "n"));
        }
        assert_eq!(
            format!("{scene:#?}"),
            format!("{:#?}", loaded.scene),
            "{old}"
        );
    }
}

#[test]
fn options_are_those_of_the_upgrade() {
    let folder = folder();
    for (old, new) in [
        (
            "Film \"image\" \"integer xresolution\" 20 \"integer yresolution\" 10 \"float scale\" 2 \
             \"float maxsampleluminance\" 5 \"string filename\" \"a.exr\"",
            "Film \"rgb\" \"integer xresolution\" 20 \"integer yresolution\" 10 \"float iso\" 200 \
             \"float maxcomponentvalue\" 5 \"string filename\" \"a.exr\"",
        ),
        (
            "PixelFilter \"gaussian\" \"float xwidth\" 1 \"float ywidth\" 2 \"float alpha\" 2 Film \"image\"",
            "PixelFilter \"gaussian\" \"float xradius\" 1 \"float yradius\" 2 \"float sigma\" .5 Film \"rgb\"",
        ),
        (
            "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 7",
            "Sampler \"paddedsobol\" \"integer pixelsamples\" 7",
        ),
        (
            "Sampler \"random\" \"integer pixelsamples\" 7",
            "Sampler \"independent\" \"integer pixelsamples\" 7",
        ),
        (
            "Integrator \"directlighting\"",
            "Integrator \"path\" \"integer maxdepth\" 1",
        ),
        (
            "Integrator \"path\" \"string lightsamplestrategy\" \"spatial\" Film \"image\"",
            "Integrator \"path\" Film \"rgb\"",
        ),
        (
            "Camera \"environment\"",
            "Camera \"spherical\" \"string mapping\" \"equirectangular\"",
        ),
    ] {
        let (scene, said) = read(&folder, &format!("{old}\nWorldBegin\nShape \"sphere\"\n"));
        assert_eq!(said, [""; 0], "{old}");
        let loaded = folder
            .load(format!("{new}\nWorldBegin\nShape \"sphere\"\n"))
            .unwrap();
        assert_eq!(
            format!("{scene:#?}"),
            format!("{:#?}", loaded.scene),
            "{old}"
        );
    }
}

/// Bounds of the shapes that pbrt-v4 has no more.
#[test]
fn old_shapes_are_meshes() {
    let patch = "\"integer nu\" 2 \"integer nv\" 2 \"integer uorder\" 2 \"integer vorder\" 2
        \"float uknots\" [0 0 1 1] \"float vknots\" [0 0 1 1] \"point P\" [0 0 0  2 0 0  0 3 0  2 3 1]";
    for (shape, low, high, triangles) in [
        (
            "\"cone\" \"float height\" 3 \"float radius\" 2",
            [-2.0, -2.0, 0.0],
            [2.0, 2.0, 3.0],
            256,
        ),
        (
            "\"paraboloid\" \"float zmax\" 2",
            [-1.0, -1.0, 0.0],
            [1.0, 1.0, 2.0],
            1024 * 98 - 512,
        ),
        (
            "\"hyperboloid\" \"point p1\" [1 0 -1] \"point p2\" [1 0 1]",
            [-1.0; 3],
            [1.0; 3],
            1024,
        ),
        (
            "\"heightfield\" \"integer nu\" 3 \"integer nv\" 2 \"float Pz\" [0 1 2 3 4 5]",
            [0.0; 3],
            [1.0, 1.0, 5.0],
            4,
        ),
        (
            &format!("\"nurbs\" {patch}"),
            [0.0; 3],
            [2.0, 3.0, 1.0],
            2 * 29 * 29,
        ),
    ] {
        let (scene, said) = read(&folder(), &format!("WorldBegin Shape {shape}"));
        assert_eq!(said, Vec::<String>::new(), "{shape}");
        let mesh = &scene.meshes[0];
        assert_eq!(mesh.triangles.len(), triangles, "{shape}");
        for axis in 0..3 {
            let ends = mesh.positions.iter().map(|p| f64::from(p[axis]));
            let (a, b) = ends.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
            assert!(
                (a - low[axis]).abs() < 1e-6 && (b - high[axis]).abs() < 1e-6,
                "{shape}: {a} {b}"
            );
        }
    }
}

#[test]
fn mistakes_in_old_shapes_are_located() {
    for (shape, what) in [
        ("\"cone\" \"float radius\" -1", "above 0"),
        (
            "\"paraboloid\" \"float zmin\" -3 \"float zmax\" -1",
            "\"zmin\" below \"zmax\"",
        ),
        (
            "\"hyperboloid\" \"point p1\" [0 0 1] \"point p2\" [0 0 2]",
            "not both on the axis",
        ),
        (
            "\"heightfield\" \"integer nu\" 2 \"integer nv\" 2 \"float Pz\" [1 2 3]",
            "2 times 2 heights",
        ),
        (
            "\"heightfield\" \"integer nu\" 1 \"float Pz\" [1 2 3]",
            "\"nu\": expected an integer",
        ),
        (
            "\"nurbs\" \"integer nu\" 2 \"integer nv\" 2 \"integer uorder\" 2 \"integer vorder\" 2
             \"float uknots\" [0 0 1 1] \"float vknots\" [0 1 0 1]",
            "knots that do not fall",
        ),
        (
            "\"nurbs\" \"integer nu\" 2 \"integer nv\" 2 \"integer uorder\" 3 \"integer vorder\" 2",
            "at least 3 control points",
        ),
    ] {
        let error = folder()
            .load(format!("WorldBegin\nShape {shape}"))
            .unwrap_err();
        assert!(error.message().contains(what), "{shape}: {error}");
        assert!(error.line() >= 2, "{error}");
    }
}

#[test]
fn what_the_upgrade_leaves_out_is_a_warning() {
    let folder = folder();
    let (scene, said) = read(
        &folder,
        "WorldBegin Material \"uber\" \"rgb Ks\" [.2 .2 .2] \"rgb opacity\" [.2 .3 .4]\nShape \"sphere\"
         Material \"fourier\" \"string bsdffile\" \"a.bsdf\" Shape \"disk\" \"float alpha\" .5
         Material \"disney\" \"color color\" [1 0 0] \"float metallic\" 1 Shape \"disk\"
         LightSource \"point\" \"rgb scale\" [1 2 3]",
    );
    for part in [
        "\"Ks\" of pbrt-v3's \"uber\" is left out",
        "\"opacity\" of pbrt-v3's \"uber\" becomes",
        "material \"fourier\"",
        "material \"disney\" of pbrt-v3 is diffuse",
        "\"scale\" is a number in pbrt-v4: the mean of its values is used",
    ] {
        assert_eq!(
            said.iter().filter(|w| w.contains(part)).count(),
            1,
            "{part}: {said:#?}"
        );
    }
    assert_eq!(said.len(), 5, "{said:#?}");
    let FloatParam::Value(alpha) = scene.shapes[0].alpha else {
        panic!("a number")
    };
    assert!((alpha - 0.3).abs() < 1e-6);
    assert_eq!(scene.shapes[1].alpha, FloatParam::Value(0.5));
    assert!(matches!(
        scene.materials[scene.shapes[2].material.0].kind,
        MaterialKind::Diffuse { .. }
    ));
    assert!(
        matches!(scene.lights[0], Light::Point { intensity, .. } if (intensity.r - 2.0).abs() < 1e-5)
    );
}

#[test]
fn every_material_of_the_list_is_read() {
    let folder = folder();
    let list = FORMATS.iter().find(|f| f.0 == "pbrt-v3").unwrap().1;
    for feature in list
        .iter()
        .filter(|f| f.class == "material" && f.name != "mix")
    {
        let text = format!(
            "WorldBegin\nMaterial \"{}\"\nShape \"sphere\"\nWorldEnd",
            feature.name
        );
        read(&folder, &text);
    }
    for class in ["shape", "sampler", "integrator"] {
        let names = list
            .iter()
            .filter(|f| f.class == class)
            .flat_map(|f| f.name.split(':').next().unwrap().split(", "));
        // These need their points.
        let bare = ["trianglemesh", "loopsubdiv", "heightfield", "nurbs"];
        for name in names.filter(|n| !bare.contains(n)) {
            let text = match class {
                "shape" => format!("WorldBegin\nShape \"{name}\" Shape \"sphere\""),
                "sampler" => format!("Sampler \"{name}\" WorldBegin\nShape \"sphere\""),
                _ => format!("Integrator \"{name}\" WorldBegin\nShape \"sphere\""),
            };
            read(&folder, &text);
        }
    }
}
