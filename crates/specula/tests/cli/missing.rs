//! Files that a scene names and that do not exist.

use std::path::Path;

use crate::common::{SMALL, names, run, specula, succeed};

/// The small scene with a picture, two meshes and an include that do not exist.
fn scene(folder: &Path) {
    let text = format!(
        "{SMALL}Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\"\n\
         Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"disk\" \"float radius\" 2\n\
         Shape \"plymesh\" \"string filename\" \"chair.ply\"\n\
         Shape \"plymesh\" \"string filename\" \"table.ply\"\n\
         Include \"lamps.pbrt\"\n"
    );
    std::fs::write(folder.join("room.pbrt"), text).unwrap();
}

#[test]
fn one_report_names_them_all_and_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path());
    for command in ["render", "info"] {
        let (code, said) = run(folder.path(), &[command, "room.pbrt"]);
        assert_eq!(code, Some(2), "{said}");
        // The report breaks lines.
        let said: String = said
            .chars()
            .filter(|c| !c.is_whitespace() && *c != '│')
            .collect();
        for part in [
            "4filesthatthescenenamesaremissing:",
            "room.pbrt:11:",
            "wood.png",
            "room.pbrt:13:",
            "chair.ply",
            "room.pbrt:14:",
            "table.ply",
            "room.pbrt:15:",
            "lamps.pbrt",
            "`--searchFOLDER`",
            "`--missingstand-in`",
        ] {
            assert!(said.contains(part), "{command}: {part}: {said}");
        }
    }
    assert_eq!(names(folder.path()), ["room.pbrt"]);
}

#[test]
fn stand_ins_are_rendered_listed_and_named_in_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    scene(folder);
    let (code, said) = run(
        folder,
        &[
            "render",
            "room.pbrt",
            "--missing",
            "stand-in",
            "--spp",
            "2",
            "-o",
            "a.exr",
            "-o",
            "a.film",
        ],
    );
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains(
            "room.pbrt:11:53: picture wood.png is missing: a grey checker stands in for it"
        ),
        "{said}"
    );
    assert!(
        said.contains("room.pbrt:13:35: mesh chair.ply is missing: its shapes are left out"),
        "{said}"
    );
    assert!(
        said.contains("room.pbrt:15:9: file lamps.pbrt is missing: what it holds is left out"),
        "{said}"
    );
    // A merged picture says so, too.
    succeed(folder, &["merge", "a.film", "-o", "b.exr"]);
    for picture in ["a.exr", "b.exr"] {
        let bytes = std::fs::read(folder.join(picture)).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.contains("specula.missing"), "{picture}");
        assert!(
            text.contains("lamps.pbrt, wood.png, chair.ply, table.ply"),
            "{picture}"
        );
    }
    succeed(
        folder,
        &["convert", "room.pbrt", "copy.pbrt", "--missing=stand-in"],
    );
    let check = specula(folder)
        .args(["check", "room.pbrt", "--missing", "stand-in"])
        .output()
        .unwrap();
    let listed = String::from_utf8_lossy(&check.stdout).into_owned();
    assert_eq!(check.status.code(), Some(0), "{listed}");
    assert!(listed.contains("room.pbrt: 4 warnings"), "{listed}");
}
