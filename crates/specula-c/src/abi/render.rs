//! Renders.

use std::ffi::{c_int, c_void};

use crate::border::border;
use crate::failure::{Failure, Status};
use crate::options::RenderOptions;
use crate::picture::PictureHandle;
use crate::render::render;
use crate::scene::SceneHandle;

/// Tells how far a render is, in the thread that called `specula_render`.
///
/// * `share_done`: in [0, 1].
/// * `samples_per_pixel`: samples so far, on average.
/// * `user`: the pointer that was given to `specula_render`.
/// * Returns: 0 to go on; anything else ends the render. No exception may leave it.
pub type Progress =
    Option<extern "C" fn(share_done: f64, samples_per_pixel: f64, user: *mut c_void) -> c_int>;

/// Sets the defaults of options.
///
/// * `options`: room for `size` bytes.
/// * `size`: `sizeof(specula_render_options)` of the caller's header.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_render_options_init(
    options: *mut RenderOptions,
    size: usize,
) -> Status {
    border(|caller| caller.initialise(options, size))
}

/// Renders a scene on the CPU.
///
/// * `options`: NULL for the defaults.
/// * `progress`: called after every pass over the picture and about 20 times a second; may be NULL.
/// * `user`: given to `progress`; may be NULL.
/// * `picture`: where the picture goes, NULL where the call fails. The caller frees it by `specula_picture_free`.
/// * Returns: SPECULA_STATUS_CANCELLED where `progress` ended the render: the picture so far is given all the same.
///   SPECULA_STATUS_OUT_OF_MEMORY where the render would take more than there is.
///
/// The same options give the same picture bit for bit, unless a time ends it. May be called from any thread, by several
/// with one scene.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_render(
    scene: *const SceneHandle,
    options: *const RenderOptions,
    progress: Progress,
    user: *mut c_void,
    picture: *mut *mut PictureHandle,
) -> Status {
    border(|caller| {
        caller.write("picture", picture, std::ptr::null_mut())?;
        let scene = caller.lent("scene", scene)?;
        let options = caller.options(options)?;
        let mut tell = |share: f64, samples: f64| {
            progress.is_none_or(|progress| progress(share, samples, user) == 0)
        };
        let (rendered, cancelled) = render(scene, &options, &mut tell)?;
        caller.hand_over("picture", picture, rendered)?;
        match cancelled {
            false => Ok(()),
            true => Err(Failure::new(
                Status::Cancelled,
                "the progress function ended the render",
            )),
        }
    })
}
