//! The studio in WebAssembly: requests and answers as bytes in the module's memory.
//!
//! ```text
//! at = studio_allocate(length)            the page writes a request of `length` bytes there
//! answer = studio_answer(at, length)      a length of 4 bytes, little-endian, and as many bytes of an answer
//! studio_free(at, length)
//! studio_free(answer, 4 + its length)
//! ```
//!
//! The page gives the module a clock: `env.now() -> f64`, milliseconds since some moment.
#![expect(
    unsafe_code,
    reason = "addresses are exchanged with a page, and a clock is imported from it"
)]

use std::alloc::Layout;
use std::sync::OnceLock;

use crate::Studio;

#[link(wasm_import_module = "env")]
unsafe extern "C" {
    /// Milliseconds since some moment.
    safe fn now() -> f64;
}

/// The page's clock, in milliseconds.
pub(crate) fn milliseconds() -> f64 {
    now()
}

/// The one studio of the module.
fn studio() -> &'static Studio {
    static STUDIO: OnceLock<Studio> = OnceLock::new();
    STUDIO.get_or_init(Studio::default)
}

/// Blocks have no alignment: they hold bytes.
fn layout(length: usize) -> Option<Layout> {
    Layout::array::<u8>(length).ok().filter(|l| l.size() > 0)
}

/// Memory for `length` bytes, zeroed; null where there is none, or `length` is 0.
#[unsafe(no_mangle)]
pub extern "C" fn studio_allocate(length: usize) -> *mut u8 {
    match layout(length) {
        // SAFETY: the layout's size is not 0.
        Some(layout) => unsafe { std::alloc::alloc_zeroed(layout) },
        None => std::ptr::null_mut(),
    }
}

/// Frees memory that [`studio_allocate`] or [`studio_answer`] gave; null is left alone.
///
/// # Safety
/// `at` is null, or was given for `length` bytes and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn studio_free(at: *mut u8, length: usize) {
    if let Some(layout) = layout(length).filter(|_| !at.is_null()) {
        // SAFETY: the caller got `at` from this allocator, for this layout.
        unsafe { std::alloc::dealloc(at, layout) };
    }
}

/// The answer to a request: its length and its bytes, which the caller frees.
///
/// # Safety
/// `length` bytes can be read from `at`; null has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn studio_answer(at: *const u8, length: usize) -> *mut u8 {
    let request = match at.is_null() {
        true => &[],
        // SAFETY: the caller says that they can be read; nothing writes to them meanwhile, as there is one thread.
        false => unsafe { std::slice::from_raw_parts(at, length) },
    };
    let answer = studio().answer(request);
    let count = u32::try_from(answer.len()).unwrap_or(u32::MAX);
    let mut bytes = Vec::with_capacity(answer.len() + 4);
    bytes.extend_from_slice(&count.to_le_bytes());
    bytes.extend_from_slice(&answer);
    Box::into_raw(bytes.into_boxed_slice()).cast()
}
