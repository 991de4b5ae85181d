//! Memory in pages of two megabytes, where the system has them: rays go all over a large tree, and of pages of four
//! kilobytes the processor remembers too few. What has not been read for a second is read many times as fast, too: the
//! processor finds each page in tables that are no longer in its caches.
#![allow(
    unsafe_code,
    reason = "advice to the system on memory that a list owns"
)]

/// Asks for huge pages for the memory that a list has reserved, best before it is written. Lists of less than two
/// megabytes get none, and what is left at the ends of larger ones.
///
/// Only a wish: where the system has none, nothing changes.
pub(crate) fn advise<T>(list: &Vec<T>) {
    advise_range(list.as_ptr().cast(), list.capacity() * size_of::<T>());
}

#[cfg(target_os = "linux")]
fn advise_range(start: *const u8, bytes: usize) {
    /// Any page's size, to which the start of a range must be aligned, is a divisor of it.
    const HUGE: usize = 2 << 20;
    let before = start.align_offset(HUGE);
    if let Some(bytes) = bytes.checked_sub(before).filter(|&bytes| bytes >= HUGE) {
        let aligned = start.wrapping_add(before).cast_mut();
        // SAFETY: the range lies within memory that the list owns. The advice changes how its pages are kept, not what
        // they hold, and a failure leaves them as they are.
        unsafe { libc::madvise(aligned.cast(), bytes, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
fn advise_range(_: *const u8, _: usize) {}
