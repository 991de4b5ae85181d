//! Files of pbrt-v3.

use crate::common::{run, succeed};

const OLD: &str = r#"
LookAt 0 -4 1  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Film "image" "integer xresolution" 24 "integer yresolution" 16 "string filename" "old.png"
Sampler "lowdiscrepancy" "integer pixelsamples" 4
PixelFilter "gaussian" "float xwidth" 1.5 "float ywidth" 1.5 "float alpha" 2
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "infinite" "rgb L" [0.7 0.8 1.0] "integer nsamples" 4
Material "uber" "color Kd" [0.9 0.6 0.3] "color Ks" [0 0 0]
Shape "sphere" "float radius" 1
WorldEnd
"#;

const NEW: &str = r#"
LookAt 0 -4 1  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "old.png"
Sampler "paddedsobol" "integer pixelsamples" 4
PixelFilter "gaussian" "float xradius" 1.5 "float yradius" 1.5 "float sigma" 0.5
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "infinite" "rgb L" [0.7 0.8 1.0]
Material "diffuse" "rgb reflectance" [0.9 0.6 0.3]
Shape "sphere" "float radius" 1
"#;

#[test]
fn an_old_file_is_rendered_as_its_upgrade_with_one_warning() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("old.pbrt"), OLD).unwrap();
    std::fs::write(folder.join("new.pbrt"), NEW).unwrap();
    let (code, said) = run(folder, &["render", "old.pbrt", "-o", "old.exr"]);
    assert_eq!(code, Some(0), "{said}");
    let warnings: Vec<&str> = said.lines().filter(|l| l.starts_with("warning")).collect();
    let [warning] = warnings.as_slice() else {
        panic!("{said}")
    };
    assert!(
        warning.contains("old.pbrt:4:1: the file is read as pbrt-v3"),
        "{warning}"
    );
    succeed(folder, &["render", "new.pbrt", "-o", "new.exr"]);
    succeed(
        folder,
        &[
            "compare",
            "old.exr",
            "new.exr",
            "--metric",
            "mae",
            "--fail-above",
            "0",
        ],
    );
}
