//! `specula farm` without the Python package: one sentence that says how to have it.

use crate::common::{small_scene, specula, stderr};

#[test]
fn without_the_package_the_farm_says_how_to_install_it() {
    let (folder, _) = small_scene();
    for rest in [
        &["render", "small.pbrt", "--spp", "4"][..],
        &["--help"],
        &[],
    ] {
        let run = specula(folder.path())
            .env("SPECULA_PYTHON", "no-such-interpreter")
            .arg("farm")
            .args(rest)
            .output()
            .unwrap();
        let said = stderr(&run).replace("\n  │ ", " ");
        assert_eq!(run.status.code(), Some(2), "{said}");
        assert!(said.contains("specula-render[farm]"), "{said}");
    }
}

/// An interpreter that has the package is given all arguments, and its exit code is the program's.
#[cfg(unix)]
#[test]
fn the_interpreter_is_given_all_arguments() {
    use std::os::unix::fs::PermissionsExt as _;

    let (folder, _) = small_scene();
    let stand_in = folder.path().join("python");
    let script = "#!/bin/sh\n[ \"$1\" = -c ] && exit 0\nprintf '%s|' \"$@\"\nexit 7\n";
    std::fs::write(&stand_in, script).unwrap();
    std::fs::set_permissions(&stand_in, std::fs::Permissions::from_mode(0o755)).unwrap();
    let run = specula(folder.path())
        .env("SPECULA_PYTHON", &stand_in)
        .args(["farm", "render", "a b.pbrt", "--spp", "4", "--help"])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(7));
    let given = String::from_utf8_lossy(&run.stdout).into_owned();
    assert_eq!(
        given,
        "-m|specula_render.farm|render|a b.pbrt|--spp|4|--help|"
    );
}
