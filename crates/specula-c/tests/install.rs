//! Installed as the README says, the library is found by pkg-config and by CMake.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tools::{here, libraries, text};

/// Lays the files out below a prefix.
fn install(prefix: &Path) {
    let folder = |name: &str| -> PathBuf {
        let folder = prefix.join(name);
        fs::create_dir_all(&folder).unwrap();
        folder
    };
    let header = folder("include").join("specula.h");
    fs::copy(here().join("include/specula.h"), header).unwrap();
    for library in ["libspecula_c.so", "libspecula_c.a"] {
        // Large: not copied.
        let (from, to) = (libraries().join(library), folder("lib").join(library));
        fs::hard_link(&from, &to)
            .or_else(|_| fs::copy(&from, &to).map(drop))
            .unwrap();
    }
    let config = "SpeculaConfig.cmake";
    let from = here().join("cmake").join(config);
    fs::copy(from, folder("lib/cmake/Specula").join(config)).unwrap();
    let pc = fs::read_to_string(here().join("specula.pc.in")).unwrap();
    let pc = pc
        .replace("@PREFIX@", prefix.to_str().unwrap())
        .replace("@VERSION@", env!("CARGO_PKG_VERSION"));
    fs::write(folder("lib/pkgconfig").join("specula.pc"), pc).unwrap();
}

/// Whether programs are there; a line for one that is not.
#[track_caller]
fn are_there(programs: &[&str], what: &str) -> bool {
    if cfg!(not(target_os = "linux")) {
        specula_testing::not_of_this_machine(what, "it is tested on Linux");
        return false;
    }
    programs.iter().all(|name| {
        let is_there = Command::new(name).arg("--version").output().is_ok();
        if !is_there {
            let why = format!("{name} is not installed");
            specula_testing::skip(what, why, format!("apt-get install {name}"));
        }
        is_there
    })
}

fn done(command: &mut Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}:\n{}", text(&output));
    String::from_utf8(output.stdout).unwrap()
}

/// Three lines, the first of gold seen from above.
fn assert_albedo(printed: &str) {
    assert_eq!(printed.lines().count(), 3, "{printed}");
    assert!(printed.starts_with("0.87454"), "{printed}");
}

#[test]
fn pkg_config_finds_the_library() {
    if !are_there(&["pkg-config", "gcc"], "the library by pkg-config") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let prefix = folder.path();
    install(prefix);
    let ask = |options: &[&str]| {
        let mut command = Command::new("pkg-config");
        command.env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig"));
        done(command.args(options).arg("specula"))
    };
    let version = ask(&["--modversion"]);
    assert_eq!(version.trim(), env!("CARGO_PKG_VERSION"));
    let program = prefix.join("program");
    let flags = ask(&["--cflags", "--libs"]);
    let mut gcc = Command::new("gcc");
    gcc.arg(here().join("examples/furnace.c"))
        .args(flags.split_whitespace());
    done(gcc.arg("-o").arg(&program));
    let mut run = Command::new(&program);
    assert_albedo(&done(run.env("LD_LIBRARY_PATH", prefix.join("lib"))));
    // Without the shared library, the static one with what it needs.
    fs::remove_file(prefix.join("lib/libspecula_c.so")).unwrap();
    let flags = ask(&["--static", "--cflags", "--libs"]);
    let mut gcc = Command::new("gcc");
    gcc.arg(here().join("examples/furnace.c"))
        .args(flags.split_whitespace());
    done(gcc.arg("-o").arg(&program));
    assert_albedo(&done(&mut Command::new(&program)));
}

#[test]
fn cmake_finds_the_library() {
    if !are_there(&["cmake", "make", "gcc"], "the library by CMake") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (prefix, build) = (folder.path().join("prefix"), folder.path().join("build"));
    let source = folder.path().join("source");
    install(&prefix);
    fs::create_dir(&source).unwrap();
    for file in ["tests/cmake/CMakeLists.txt", "examples/furnace.c"] {
        let from = here().join(file);
        fs::copy(&from, source.join(from.file_name().unwrap())).unwrap();
    }
    let mut configure = Command::new("cmake");
    configure.arg("-S").arg(&source).arg("-B").arg(&build);
    let found = format!("-DCMAKE_PREFIX_PATH={}", prefix.display());
    done(configure.args(["-G", "Unix Makefiles", &found]));
    done(Command::new("cmake").arg("--build").arg(&build));
    for program in ["shared", "static"] {
        let mut run = Command::new(build.join(program));
        // Cargo names folders where an older library may lie.
        assert_albedo(&done(run.env_remove("LD_LIBRARY_PATH")));
    }
    // Programs know the library's name, not its place.
    let moved = folder.path().join("moved");
    fs::rename(prefix.join("lib"), &moved).unwrap();
    let mut run = Command::new(build.join("shared"));
    assert_albedo(&done(run.env("LD_LIBRARY_PATH", &moved)));
    fs::rename(&moved, prefix.join("lib")).unwrap();
    // Nothing is found where there is no library.
    for library in ["libspecula_c.so", "libspecula_c.a"] {
        fs::remove_file(prefix.join("lib").join(library)).unwrap();
    }
    fs::remove_file(build.join("CMakeCache.txt")).unwrap();
    let output = configure.output().unwrap();
    let said = text(&output);
    assert!(
        !output.status.success() && said.contains("no library of Specula in"),
        "{said}"
    );
}
