//! The header is what cbindgen makes of the sources.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use std::fs;
use std::path::Path;

/// The files that it is made of: what is declared, and the opaque types behind it.
const SOURCES: [&str; 11] = [
    "failure.rs",
    "abi/status.rs",
    "lobe.rs",
    "abi/lobe.rs",
    "options.rs",
    "abi/batch.rs",
    "scene.rs",
    "abi/scene.rs",
    "picture.rs",
    "abi/render.rs",
    "abi/picture.rs",
];

fn generated() -> String {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(here.join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(here.join("src").join(source));
    }
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn the_header_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/specula.h");
    let generated = generated();
    if std::env::var_os("SPECULA_WRITE").is_some() {
        fs::write(&path, &generated).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    let differs = (committed.lines().zip(generated.lines()))
        .enumerate()
        .find(|(_, (a, b))| a != b);
    assert!(
        committed == generated,
        "include/specula.h is out of date (SPECULA_WRITE=1 writes it): {differs:?}"
    );
}

#[test]
fn every_exported_function_is_declared() {
    let abi = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/abi");
    let header = generated();
    let mut functions = 0;
    for file in fs::read_dir(abi).unwrap() {
        let text = fs::read_to_string(file.unwrap().path()).unwrap();
        for line in text
            .lines()
            .filter(|line| line.contains("extern \"C\" fn specula_"))
        {
            let name = line.split("fn ").nth(1).unwrap().split('(').next().unwrap();
            assert!(
                header.contains(&format!("{name}(")),
                "{name} is not declared"
            );
            functions += 1;
        }
    }
    assert!(functions > 25, "{functions} functions");
}

/// Pointers are turned into values in one file.
#[test]
fn unsafe_blocks_are_in_one_file() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if fs::read_to_string(&path).unwrap().contains("unsafe {") {
                found.push(path.file_name().unwrap().to_owned());
            }
        }
    }
    assert_eq!(found, ["pointers.rs"]);
}
