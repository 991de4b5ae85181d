//! The program where there is nothing but a C library, the Vulkan loader and a driver: no toolchain, no network, no
//! other file.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::common::stderr;

const WHAT: &str = "the program in an empty root";

/// A folder that stands for a machine.
struct Root(tempfile::TempDir);

impl Root {
    /// The program with what it links to.
    fn with_program() -> Self {
        let root = Self(tempfile::tempdir().unwrap());
        let program = assert_cmd::cargo::cargo_bin("specula");
        root.place(&program, Path::new("/specula"));
        root.place_libraries_of(&program);
        fs::create_dir(root.inside(Path::new("/tmp"))).unwrap();
        root
    }

    fn inside(&self, path: &Path) -> PathBuf {
        self.0.path().join(path.strip_prefix("/").unwrap_or(path))
    }

    /// A file at `path`, linked where the file systems are one: the program of tests is large.
    fn place(&self, file: &Path, path: &Path) {
        let target = self.inside(path);
        fs::create_dir_all(target.parent().unwrap()).unwrap();
        let file = fs::canonicalize(file).unwrap();
        if !target.exists() && fs::hard_link(&file, &target).is_err() {
            fs::copy(&file, &target).unwrap();
        }
    }

    /// What the dynamic linker loads for a program or a library.
    fn place_libraries_of(&self, file: &Path) {
        let output = Command::new("ldd").arg(file).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        for library in text.split_whitespace().filter(|word| word.starts_with('/')) {
            self.place(Path::new(library), Path::new(library));
        }
    }

    /// The Vulkan loader, where linkers find it.
    fn place_loader(&self) -> PathBuf {
        let listed = Command::new("ldconfig").arg("-p").output().unwrap();
        let text = String::from_utf8_lossy(&listed.stdout).into_owned();
        let loader = text.lines().find(|line| line.contains("libvulkan.so.1"));
        let loader = PathBuf::from(loader.unwrap().split(" => ").nth(1).unwrap());
        self.place(&loader, &loader);
        self.place_libraries_of(&loader);
        loader
    }

    /// A driver, where loaders look for it.
    fn place_driver(&self, library: &Path, loader: &Path) {
        let name = library.file_name().unwrap();
        self.place(library, &loader.with_file_name(name));
        self.place_libraries_of(library);
        let folder = self.inside(Path::new("/etc/vulkan/icd.d"));
        fs::create_dir_all(&folder).unwrap();
        let text = format!(
            r#"{{"file_format_version": "1.0.0", "ICD": {{"library_path": {name:?}, "api_version": "1.0.5"}}}}"#
        );
        fs::write(folder.join("driver.json"), text).unwrap();
    }

    /// The program there, run by `launcher` without any variable.
    fn run(&self, launcher: &[&str], arguments: &[&str]) -> Output {
        let mut run = Command::new(launcher[0]);
        run.args(&launcher[1..]).arg(self.0.path()).arg("/specula");
        let path = std::env::var_os("PATH").unwrap_or_default();
        run.args(arguments).env_clear().env("PATH", path);
        run.output().unwrap()
    }

    /// What changes the root for this user.
    fn launcher(&self) -> Option<&'static [&'static str]> {
        let known: [&[&str]; 2] = [&["chroot"], &["unshare", "--map-root-user", "chroot"]];
        let works = |launcher: &&[&str]| self.run(launcher, &["--version"]).status.success();
        known.into_iter().find(works)
    }
}

/// SwiftShader, the driver that needs least: beside a file of `VK_ADD_DRIVER_FILES`, or with Chromium.
fn driver() -> Option<PathBuf> {
    let named = std::env::var("VK_ADD_DRIVER_FILES").unwrap_or_default();
    let named = named.split(':').map(PathBuf::from);
    let usual = PathBuf::from("/usr/lib/chromium/vk_swiftshader_icd.json");
    let libraries = named
        .chain([usual])
        .map(|file| file.with_file_name("libvk_swiftshader.so"));
    libraries.into_iter().find(|library| library.exists())
}

#[test]
fn a_gpu_is_measured_in_an_empty_root() {
    let Some(driver) = driver() else {
        specula_testing::skip(WHAT, "no SwiftShader", "apt-get install chromium");
        return;
    };
    let root = Root::with_program();
    let Some(launcher) = root.launcher() else {
        specula_testing::not_of_this_machine(WHAT, "this user may not change the root");
        return;
    };
    let output = root.run(launcher, &["devices"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("no GPU found"), "{said}");
    let report = ["gpu-report", "--quick", "--part", "rays", "-o", "/report"];
    let refused = root.run(launcher, &report);
    let said = stderr(&refused);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(
        said.contains("the loader is the package libvulkan1"),
        "{said}"
    );
    assert!(!root.inside(Path::new("/report")).exists());

    let loader = root.place_loader();
    root.place_driver(&driver, &loader);
    let output = root.run(launcher, &report);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = fs::read_to_string(root.inside(Path::new("/report/README.md"))).unwrap();
    assert!(
        text.contains("SwiftShader") && text.contains("## Rays alone"),
        "{text}"
    );
}
