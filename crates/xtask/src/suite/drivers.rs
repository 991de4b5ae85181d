//! The software GPU of the tests.
//!
//! Chromium includes SwiftShader, which compiles the tracer's shaders ten times faster than Mesa's lavapipe. Where it is
//! installed, tests find it beside the machine's own drivers. A real GPU is preferred to both; ray queries are
//! lavapipe's.

use std::path::Path;

/// The variables by which a person chooses Vulkan's drivers.
const CHOSEN_BY: [&str; 3] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"];

/// Where distributions install it.
const SWIFTSHADER: [&str; 3] = [
    "/usr/lib/chromium/vk_swiftshader_icd.json",
    "/usr/lib64/chromium-browser/vk_swiftshader_icd.json",
    "/opt/google/chrome/vk_swiftshader_icd.json",
];

/// The variable that adds SwiftShader to Vulkan's drivers; `None` where a person chose drivers, or it is not there.
pub(super) fn variable() -> Option<(&'static str, &'static str)> {
    of(
        |name| std::env::var_os(name).is_some(),
        |path| Path::new(path).exists(),
    )
}

fn of(
    is_set: impl Fn(&str) -> bool,
    exists: impl Fn(&str) -> bool,
) -> Option<(&'static str, &'static str)> {
    if CHOSEN_BY.into_iter().any(is_set) {
        return None;
    }
    let found = SWIFTSHADER.into_iter().find(|path| exists(path))?;
    Some(("VK_ADD_DRIVER_FILES", found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_persons_choice_stays() {
        let there = |path: &str| path == SWIFTSHADER[1];
        let added = ("VK_ADD_DRIVER_FILES", SWIFTSHADER[1]);
        assert_eq!(of(|_| false, there), Some(added));
        assert_eq!(of(|_| false, |_| false), None);
        for name in CHOSEN_BY {
            assert_eq!(of(|set| set == name, there), None, "{name}");
        }
    }
}
