//! Memory in pages of two megabytes, where the system has them: rays go all over a large tree, and of pages of four
//! kilobytes the processor remembers too few. What has not been read for a second is read many times as fast, too: the
//! processor finds each page in tables that are no longer in its caches.
#![allow(
    unsafe_code,
    reason = "advice to the system on memory that a list owns"
)]

/// Asks for huge pages for the memory that a list has reserved, best before it is written. Those of lists that lie side by
/// side hold parts of several.
///
/// Only a wish: where the system has none, nothing changes.
pub(crate) fn advise<T>(list: &Vec<T>) {
    advise_range(list.as_ptr().cast(), list.capacity() * size_of::<T>());
}

#[cfg(target_os = "linux")]
fn advise_range(start: *const u8, bytes: usize) {
    /// Lists from this size on: allocators give them pages of their own.
    const LARGE: usize = 128 << 10;
    /// The usual size of a page, to which the start of a range must be aligned. Systems with larger ones refuse.
    const PAGE: usize = 4 << 10;
    let before = start.align_offset(PAGE);
    if let Some(bytes) = bytes.checked_sub(before).filter(|_| bytes >= LARGE) {
        let aligned = start.wrapping_add(before).cast_mut();
        // SAFETY: the range lies within memory that the list owns. The advice changes how its pages are kept, not what
        // they hold, and a failure leaves them as they are.
        unsafe { libc::madvise(aligned.cast(), bytes, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
fn advise_range(_: *const u8, _: usize) {}
