//! Scenes: read, asked, freed.

use std::ffi::c_char;

use crate::border::border;
use crate::failure::{Failure, Status};
use crate::scene::SceneHandle;

/// Reads a scene of pbrt-v4, Mitsuba's XML or glTF 2.0, or a single mesh (OBJ, PLY); the content tells which.
///
/// * `path`: the file, in UTF-8.
/// * `scene`: where the scene goes, NULL where the call fails. The caller frees it by `specula_scene_free`.
/// * Returns: SPECULA_STATUS_UNREADABLE where there is no scene in it; the message begins with file, line and column.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_scene_load(
    path: *const c_char,
    scene: *mut *mut SceneHandle,
) -> Status {
    border(|caller| {
        caller.write("scene", scene, std::ptr::null_mut())?;
        let path = caller.text("path", path)?;
        caller.hand_over("scene", scene, SceneHandle::load(path)?)
    })
}

/// Makes the built-in scene: orbs of metal and glass, 960 x 400 pixels, 64 samples per pixel.
///
/// * `scene`: as for `specula_scene_load`.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_scene_builtin(scene: *mut *mut SceneHandle) -> Status {
    border(|caller| {
        caller.write("scene", scene, std::ptr::null_mut())?;
        caller.hand_over("scene", scene, SceneHandle::builtin())
    })
}

/// Gives the size of a scene's picture in pixels.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_scene_resolution(
    scene: *const SceneHandle,
    width: *mut u32,
    height: *mut u32,
) -> Status {
    border(|caller| {
        let [columns, rows] = caller.lent("scene", scene)?.scene.film.resolution;
        caller.place("height", height)?;
        caller.write("width", width, columns)?;
        caller.write("height", height, rows)
    })
}

/// Gives the number of warnings that a scene was read with: what is rendered otherwise than the file says.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_scene_warning_count(
    scene: *const SceneHandle,
    count: *mut usize,
) -> Status {
    border(|caller| {
        let found = caller.lent("scene", scene)?.warnings.len();
        caller.write("count", count, found)
    })
}

/// Gives a warning: file, line, column and what differs, in UTF-8.
///
/// * `index`: from 0.
/// * `text`: where its address goes, which is valid until the scene is freed.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_scene_warning(
    scene: *const SceneHandle,
    index: usize,
    text: *mut *const c_char,
) -> Status {
    border(|caller| {
        caller.write("text", text, std::ptr::null())?;
        let warnings = &caller.lent("scene", scene)?.warnings;
        let warning = warnings.get(index).ok_or_else(|| {
            Failure::invalid(format!(
                "index: expected one below {}, got {index}",
                warnings.len()
            ))
        })?;
        caller.write("text", text, warning.as_ptr())
    })
}

/// Frees a scene, which no thread may use any more; NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_scene_free(scene: *mut SceneHandle) {
    border(|caller| caller.free(scene));
}
