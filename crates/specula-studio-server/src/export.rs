//! A static site of the studio's pages, for a web server or to be opened from disk.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use specula_scene::atomic;

use crate::{Assets, ServerError};

/// The WebAssembly module as a script: a page that is opened from disk can fetch nothing.
const WASM: &str = "specula-studio.wasm.js";
const INDEX: &str = "index.html";
/// By this an earlier export is known.
const GENERATOR: &str = "<meta name=\"generator\" content=\"specula studio --export\">";
/// `file:` is for pages that are opened from disk, where `'self'` means nothing.
const POLICY: &str = "default-src 'none'; script-src 'self' file: 'wasm-unsafe-eval'; worker-src 'self' file: blob:; \
    style-src 'self' file:; img-src 'self' file: blob: data:; font-src 'self' file: data:; connect-src 'self' blob:; \
    frame-src 'self'; base-uri 'none'; form-action 'none'";

/// Writes the pages' files to `folder`, which is made where it is missing, each whole or not at all.
///
/// * `wasm`: the module that answers without a server.
/// * Returns: the files' names.
///
/// # Errors
///
/// Where the folder has files that are not of an earlier export, or a file cannot be read or written.
pub fn export(
    folder: &Path,
    assets: &Assets,
    wasm: Option<&Path>,
) -> Result<Vec<String>, ServerError> {
    let mut files = assets.all();
    let module = wasm.map(script).transpose()?;
    for (name, bytes) in &mut files {
        if name == INDEX {
            *bytes = index(&String::from_utf8_lossy(bytes), module.is_some()).into_bytes();
        }
    }
    files.extend(module.map(|bytes| (WASM.to_owned(), bytes)));
    fs::create_dir_all(folder).map_err(ServerError::io(folder))?;
    let names: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    refuse_others(folder, &names)?;
    let stale = folder.join(WASM);
    if wasm.is_none() && stale.exists() {
        fs::remove_file(&stale).map_err(ServerError::io(&stale))?;
    }
    // The page is last: it names the others.
    files.sort_by_key(|(name, _)| name == INDEX);
    for (name, bytes) in &files {
        let path = folder.join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(ServerError::io(parent))?;
        }
        atomic::replace(&path, |file| file.write_all(bytes)).map_err(ServerError::io(&path))?;
    }
    Ok(names)
}

/// Fails where the folder has files that no export would write, or a page that none has written.
fn refuse_others(folder: &Path, names: &[String]) -> Result<(), ServerError> {
    let other = |name: &str| ServerError::NotEmpty {
        folder: folder.to_owned(),
        other: name.to_owned(),
    };
    let entries = fs::read_dir(folder).map_err(ServerError::io(folder))?;
    for entry in entries {
        let name = entry
            .map_err(ServerError::io(folder))?
            .file_name()
            .to_string_lossy()
            .into_owned();
        let is_below = |of: &String| of.split('/').next() == Some(&name);
        if name != WASM && !names.iter().any(is_below) {
            return Err(other(&name));
        }
    }
    let is_alone = |name: &String| !folder.join(name).exists();
    let page = fs::read_to_string(folder.join(INDEX)).unwrap_or_default();
    match page.contains(GENERATOR) || names.iter().all(is_alone) {
        true => Ok(()),
        false => Err(other(
            names
                .iter()
                .find(|name| !is_alone(name))
                .map_or(INDEX, String::as_str),
        )),
    }
}

/// The page with its policy, and with the module's script before all others.
fn index(page: &str, has_module: bool) -> String {
    let head = format!(
        "<head>\n{GENERATOR}\n<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">"
    );
    let mut page = page.replacen("<head>", &head, 1);
    // Folders of web servers and disks may be anywhere.
    page = page
        .replace("src=\"/", "src=\"")
        .replace("href=\"/", "href=\"");
    match page.find("<script") {
        Some(at) if has_module => {
            page.insert_str(at, &format!("<script src=\"{WASM}\"></script>\n"))
        }
        _ => {}
    }
    page
}

fn script(wasm: &Path) -> Result<Vec<u8>, ServerError> {
    let module = fs::read(wasm).map_err(ServerError::io(wasm))?;
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    let packed = encoder.write_all(&module).and_then(|()| encoder.finish());
    let packed = packed.map_err(ServerError::io(wasm))?;
    Ok(format!(
        "globalThis.SPECULA_WASM = \"{}\";\n",
        STANDARD.encode(packed)
    )
    .into_bytes())
}
