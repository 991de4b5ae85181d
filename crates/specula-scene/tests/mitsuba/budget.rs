//! Small files that ask for much: an answer in little time, with the name of what is exceeded.

use std::fmt::Write;

use specula_scene::{ErrorKind, LoadOptions, Severity, check};

use super::common::{Folder, REST, load};

#[test]
fn files_that_include_each_other_twice() {
    let folder = Folder::new();
    for level in 0..20 {
        let next = format!("<include filename=\"{}.xml\"/>", level + 1);
        folder.write(
            &format!("{level}.xml"),
            format!("<scene version=\"3.0.0\">{}</scene>", next.repeat(2)),
        );
    }
    folder.write(
        "20.xml",
        "<scene version=\"3.0.0\"><shape type=\"cube\"/></scene>",
    );
    let scene = |file: &str| {
        format!("<scene version=\"3.0.0\">{REST}\n<include filename=\"{file}\"/></scene>")
    };
    let load = |text: String, max_files: usize| {
        let mut options = LoadOptions::default();
        options.limits.max_files = max_files;
        folder.load_with(text, &options)
    };
    let error = load(scene("0.xml"), 100).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    assert!(error.message().contains("more than 100 files"), "{error}");
    assert!(load(scene("20.xml"), 1).is_ok());
    // The rest is left out in a check, not read to its end.
    let path = folder.write("scene.xml", scene("0.xml"));
    let mut options = LoadOptions::default();
    options.limits.max_files = 100;
    let report = check(&path, &options);
    assert!((1..50).contains(&report.count(Severity::Error)));
}

#[test]
fn parameters_that_double() {
    let mut text = "<default name=\"a0\" value=\"xxxxxxxx\"/>\n".to_owned();
    for level in 1..=40 {
        let before = level - 1;
        writeln!(
            text,
            "<default name=\"a{level}_\" value=\"$a{before}_$a{before}_\"/>"
        )
        .unwrap();
    }
    let text = text.replace("a0\"", "a0_\"");
    let error = load(&text).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    assert!(
        error
            .message()
            .contains("unfold to more than 1048576 bytes"),
        "{error}"
    );
    assert!(error.line() > 10);
}

#[test]
fn textures_that_share_their_inputs() {
    let chain = |leaf: &str| {
        let mut text = format!("<texture type=\"{leaf}\" id=\"t0\"/>\n");
        for level in 1..=40 {
            let before = level - 1;
            writeln!(
                text,
                "<texture type=\"checkerboard\" id=\"t{level}\"><ref name=\"color0\" id=\"t{before}\"/>\
                 <ref name=\"color1\" id=\"t{before}\"/></texture>"
            )
            .unwrap();
        }
        text += "<shape type=\"cube\"><bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t40\"/></bsdf></shape>";
        text
    };
    let loaded = load(&chain("checkerboard")).unwrap();
    assert!(loaded.scene.textures.len() < 200);
    let loaded = load(&chain("uniform")).unwrap();
    assert!(loaded.scene.textures.len() < 200);
}
