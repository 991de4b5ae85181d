//! The glTF version of a document.

use gltf::json::Value;

use super::locate::Step;

/// The path of an unsupported version in a document, and the message about it.
///
/// * `asset`: the root's member of that name.
pub(super) fn fault(asset: &Value) -> Option<(Vec<Step>, String)> {
    let text = |name: &str| asset.get(name).and_then(Value::as_str);
    let at = |member: &str| ["asset", member].map(|n| Step::Name(n.to_owned())).into();
    // A later version that says that readers of 2.0 can read it is one of 2.0.
    if let Some(least) = text("minVersion") {
        let is_read = numbers(least).is_some_and(|least| least <= (2, 0));
        let message = || format!("the file needs a reader of glTF {least}; this one is of 2.0");
        return (!is_read).then(|| (at("minVersion"), message()));
    }
    let version = text("version")?;
    let is_read = numbers(version).is_some_and(|(major, _)| major == 2);
    let message = || format!("expected \"2.0\", found {version:?}");
    (!is_read).then(|| (at("version"), message()))
}

/// Major and minor version.
fn numbers(version: &str) -> Option<(u32, u32)> {
    let (major, minor) = version.split_once('.').unwrap_or((version, "0"));
    Some((major.trim().parse().ok()?, minor.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gltf::locate::written;

    #[test]
    fn two_is_read_and_what_it_can_read() {
        let fault = |text: &str| {
            let asset = gltf::json::deserialize::from_str(text).unwrap();
            fault(&asset).map(|(path, _)| written(&path))
        };
        for sound in [
            r#"{"version": "2.0"}"#,
            r#"{"version": "2.1"}"#,
            r#"{"version": "3.0", "minVersion": "2.0"}"#,
            r#"{"version": 2}"#,
        ] {
            assert_eq!(fault(sound), None, "{sound}");
        }
        for (broken, path) in [
            (r#"{"version": "1.0"}"#, "asset.version"),
            (r#"{"version": "3.0"}"#, "asset.version"),
            (r#"{"version": "two"}"#, "asset.version"),
            (
                r#"{"version": "2.1", "minVersion": "2.1"}"#,
                "asset.minVersion",
            ),
        ] {
            assert_eq!(fault(broken).as_deref(), Some(path), "{broken}");
        }
    }
}
