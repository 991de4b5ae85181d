//! Files that do not exist: all of them in one error, or stand-ins and warnings.

use specula_scene::{LoadOptions, Missing};

use super::common::{Folder, REST};

const FILES: &str = r#"<include filename="materials.xml"/>
<shape type="sphere"><bsdf type="diffuse"><texture type="bitmap" name="reflectance">
<string name="filename" value="a.png"/></texture></bsdf></shape>
<shape type="obj"><string name="filename" value="b.obj"/></shape>
<shape type="cube"><ref id="elsewhere"/></shape>
<shape type="cube"><bsdf type="roughconductor"><spectrum name="eta" filename="n.spd"/></bsdf></shape>
"#;

#[test]
fn all_are_named_at_once_or_stood_in_for() {
    let folder = Folder::new();
    let scene = format!("<scene version=\"3.0.0\">\n{FILES}{REST}</scene>");
    let error = folder.load(&scene).unwrap_err();
    let lines: Vec<usize> = error.missing().iter().map(|f| f.place().line()).collect();
    assert_eq!(lines, [2, 4, 5, 7], "{error}");
    assert!(error.message().starts_with("4 files"), "{error}");

    let mut options = LoadOptions::default();
    options.missing = Missing::StandIn;
    let loaded = folder.load_with(&scene, &options).unwrap();
    assert!(loaded.scene.validate().is_ok());
    assert_eq!(loaded.scene.shapes.len(), 3);
    assert_eq!(loaded.missing.len(), 4);
    let about = |part: &str| {
        loaded
            .warnings
            .iter()
            .filter(|w| w.message().contains(part))
            .count()
    };
    assert_eq!(about("is missing: "), 4, "{:#?}", loaded.warnings);
    assert_eq!(about("\"elsewhere\": a missing file may have it"), 1);
}
