//! Pictures: asked, read, written, freed.

use std::ffi::c_char;

use crate::border::border;
use crate::failure::Status;
use crate::picture::{PictureHandle, Place};

/// Gives the size of a picture in pixels.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_picture_size(
    picture: *const PictureHandle,
    width: *mut u32,
    height: *mut u32,
) -> Status {
    border(|caller| {
        let picture = &caller.lent("picture", picture)?.picture;
        caller.place("height", height)?;
        caller.write("width", width, picture.width)?;
        caller.write("height", height, picture.height)
    })
}

/// Copies a layer of a picture, rows from the top. Channel `c` of pixel (x, y) goes to
/// `to[y * row_stride + x * pixel_stride + c]`.
///
/// * `layer`: SPECULA_LAYER_...
/// * `to`: an array of `room` floats.
/// * `pixel_stride`: floats from one pixel to the next; 0: as many as there are channels.
/// * `row_stride`: floats from one row to the next; 0: `width * pixel_stride`.
/// * Returns: SPECULA_STATUS_INVALID_ARGUMENT where there is too little room; the message says how much is needed.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_picture_read(
    picture: *const PictureHandle,
    layer: u32,
    to: *mut f32,
    room: usize,
    pixel_stride: usize,
    row_stride: usize,
) -> Status {
    border(|caller| {
        let place = Place {
            to,
            room,
            pixel_stride,
            row_stride,
        };
        caller.lent("picture", picture)?.read(caller, layer, &place)
    })
}

/// Writes a picture: all layers as OpenEXR, or the colours as PNG in 8-bit sRGB. A file of that name is replaced whole.
///
/// * `path`: UTF-8; it ends with .exr or .png.
/// * Returns: SPECULA_STATUS_UNWRITABLE where the file cannot be written.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_picture_write(
    picture: *const PictureHandle,
    path: *const c_char,
) -> Status {
    border(|caller| {
        let picture = caller.lent("picture", picture)?;
        picture.write(caller.text("path", path)?)
    })
}

/// Frees a picture, which no thread may use any more; NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_picture_free(picture: *mut PictureHandle) {
    border(|caller| caller.free(picture));
}
