//! Pointers of callers in C: the one file with `unsafe` blocks.
//!
//! What each block relies on is the contract of the header: a pointer is NULL, or it points to as many values as the
//! function's documentation says, which nobody else writes during the call.
#![allow(
    unsafe_code,
    reason = "callers in C pass pointers, which only they can answer for"
)]

use std::ffi::{CStr, c_char};
use std::marker::PhantomData;
use std::mem::offset_of;

use crate::failure::Failure;
use crate::options::{BatchOptions, RenderOptions};

/// Stands for the promises that the caller of an exported function makes; what is borrowed of it ends with the call.
pub(crate) struct Caller(());

/// Options that may grow: a struct of integers and floating-point numbers, of which any bytes are a value, that begins
/// with its size in a `usize`.
///
/// # Safety
/// The type is `repr(C)`, its first field is a `usize`, and every field takes any bytes.
pub(crate) unsafe trait Growing: Copy + Default {
    /// Its size in the first version of the interface.
    const FIRST_SIZE: usize;
}

// SAFETY: `repr(C)`, a `usize` first, numbers throughout.
unsafe impl Growing for BatchOptions {
    const FIRST_SIZE: usize = offset_of!(Self, threads) + size_of::<u32>();
}

// SAFETY: `repr(C)`, a `usize` first, numbers throughout.
unsafe impl Growing for RenderOptions {
    const FIRST_SIZE: usize = offset_of!(Self, seconds) + size_of::<f64>();
}

/// No struct of options will be larger.
const LARGEST_OPTIONS: usize = 4096;

/// Fails where a pointer is NULL or not aligned.
fn usable<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        Err(Failure::invalid(format!("{name}: is NULL")))
    } else if !pointer.is_aligned() {
        Err(Failure::invalid(format!(
            "{name}: is not aligned to {} bytes",
            align_of::<T>()
        )))
    } else {
        Ok(())
    }
}

impl Caller {
    /// For `border` alone, which exported functions call: they are `unsafe`, and what their callers promise is what
    /// this stands for.
    pub(crate) fn of_exported_function() -> Self {
        Self(())
    }

    /// A text, which ends with a zero.
    pub(crate) fn text<'a>(&'a self, name: &str, text: *const c_char) -> Result<&'a str, Failure> {
        usable(name, text)?;
        // SAFETY: not NULL; the caller promises a zero at the end.
        let text = unsafe { CStr::from_ptr(text) };
        text.to_str()
            .map_err(|_| Failure::invalid(format!("{name}: is not UTF-8")))
    }

    /// A value that the caller lends.
    pub(crate) fn lent<'a, T>(&'a self, name: &str, value: *const T) -> Result<&'a T, Failure> {
        usable(name, value)?;
        // SAFETY: not NULL and aligned; the caller promises that it points to a value, such as one of this library.
        Ok(unsafe { &*value })
    }

    /// `n` values that the caller lends; none where `n` is 0.
    pub(crate) fn items<'a, T>(
        &'a self,
        name: &str,
        items: *const T,
        n: usize,
    ) -> Result<&'a [T], Failure> {
        if n == 0 {
            return Ok(&[]);
        }
        usable(name, items)?;
        fits::<T>(name, n, 1)?;
        // SAFETY: not NULL and aligned, and fewer than `isize::MAX` bytes; the caller promises `n` values.
        Ok(unsafe { std::slice::from_raw_parts(items, n) })
    }

    /// Fails where nothing can be written to a place.
    pub(crate) fn place<T>(&self, name: &str, to: *mut T) -> Result<(), Failure> {
        usable(name, to)
    }

    /// Writes a value.
    pub(crate) fn write<T: Copy>(&self, name: &str, to: *mut T, value: T) -> Result<(), Failure> {
        usable(name, to)?;
        // SAFETY: not NULL and aligned; the caller promises room for a value.
        unsafe { to.write(value) };
        Ok(())
    }

    /// Hands a value over: the caller gives it back to `free`.
    pub(crate) fn hand_over<T>(
        &self,
        name: &str,
        to: *mut *mut T,
        value: T,
    ) -> Result<(), Failure> {
        usable(name, to)?;
        self.write(name, to, Box::into_raw(Box::new(value)))
    }

    /// Frees what was handed over; NULL is nothing.
    pub(crate) fn free<T>(&self, value: *mut T) -> Result<(), Failure> {
        if value.is_null() {
            return Ok(());
        }
        usable("the pointer to free", value)?;
        // SAFETY: the caller promises that `hand_over` made it, and that it is not used any more.
        drop(unsafe { Box::from_raw(value) });
        Ok(())
    }

    /// Options: the defaults where they are NULL, and for what an older header did not have.
    pub(crate) fn options<T: Growing>(&self, given: *const T) -> Result<T, Failure> {
        let mut options = T::default();
        if given.is_null() {
            return Ok(options);
        }
        usable("options", given)?;
        // SAFETY: not NULL and aligned; a `usize` comes first, as `Growing` says.
        let size = unsafe { given.cast::<usize>().read() };
        size_fits::<T>(size)?;
        let known = size.min(size_of::<T>());
        // SAFETY: the caller promises `size` bytes, of which these are the last.
        let unknown =
            unsafe { std::slice::from_raw_parts(given.cast::<u8>().add(known), size - known) };
        if unknown.iter().any(|&byte| byte != 0) {
            return Err(Failure::invalid(
                "options: something is set that this version of the library does not have",
            ));
        }
        let (from, to) = (given.cast::<u8>(), (&raw mut options).cast::<u8>());
        // SAFETY: both have `known` bytes, and any bytes are a value, as `Growing` says.
        unsafe { from.copy_to_nonoverlapping(to, known) };
        Ok(options)
    }

    /// Writes the defaults of options whose size the caller's header says.
    pub(crate) fn initialise<T: Growing>(&self, to: *mut T, size: usize) -> Result<(), Failure> {
        usable("options", to)?;
        size_fits::<T>(size)?;
        let defaults = T::default();
        let from = (&raw const defaults).cast::<u8>();
        // SAFETY: the caller promises room for `size` bytes, in which the first is that of a `usize`; the defaults
        // have as many as are copied.
        unsafe {
            to.cast::<u8>().write_bytes(0, size);
            from.copy_to_nonoverlapping(to.cast::<u8>(), size.min(size_of::<T>()));
            to.cast::<usize>().write(size);
        }
        Ok(())
    }

    /// Arrays to read `n` elements of.
    pub(crate) fn source<'a, T: Copy, const N: usize>(
        &'a self,
        names: [&str; N],
        components: [*const T; N],
        stride: usize,
        n: usize,
    ) -> Result<Source<'a, T, N>, Failure> {
        for (name, component) in names.iter().zip(components) {
            if n > 0 {
                usable(name, component)?;
            }
            fits::<T>(name, n, stride)?;
        }
        Ok(Source {
            components,
            stride,
            n,
            lent: PhantomData,
        })
    }

    /// Arrays to write `n` elements to.
    pub(crate) fn target<'a, T: Copy, const N: usize>(
        &'a self,
        names: [&str; N],
        components: [*mut T; N],
        stride: usize,
        n: usize,
    ) -> Result<Target<'a, T, N>, Failure> {
        for (name, component) in names.iter().zip(components) {
            if n > 0 {
                usable(name, component)?;
                if stride == 0 {
                    return Err(Failure::invalid(format!(
                        "{name}: expected a stride of 1 or more, got 0"
                    )));
                }
            }
            fits::<T>(name, n, stride)?;
        }
        Ok(Target {
            components,
            stride,
            n,
            lent: PhantomData,
        })
    }
}

fn size_fits<T: Growing>(size: usize) -> Result<(), Failure> {
    if (T::FIRST_SIZE..=LARGEST_OPTIONS).contains(&size) {
        return Ok(());
    }
    Err(Failure::invalid(format!(
        "options: a size of {size} bytes (expected {} or more: were they initialised?)",
        T::FIRST_SIZE
    )))
}

/// Fails where `n` elements are more than memory can hold.
fn fits<T>(name: &str, n: usize, stride: usize) -> Result<(), Failure> {
    let bytes = (n.checked_mul(stride.max(1))).and_then(|n| n.checked_mul(size_of::<T>()));
    match bytes.is_some_and(|bytes| isize::try_from(bytes).is_ok()) {
        true => Ok(()),
        false => Err(Failure::invalid(format!(
            "{name}: {n} elements with a stride of {stride} are more than memory holds"
        ))),
    }
}

/// Arrays of a caller to read, element `i` of each at `i * stride`.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a, T, const N: usize> {
    components: [*const T; N],
    stride: usize,
    n: usize,
    lent: PhantomData<&'a [T]>,
}

// SAFETY: it stands for slices that are read, which nobody writes during the call.
unsafe impl<T: Sync, const N: usize> Send for Source<'_, T, N> {}
// SAFETY: as above.
unsafe impl<T: Sync, const N: usize> Sync for Source<'_, T, N> {}

impl<T: Copy, const N: usize> Source<'_, T, N> {
    /// Copies elements from `from` on.
    ///
    /// # Panics
    /// Where there are not so many.
    pub(crate) fn read(&self, from: usize, mut to: [&mut [T]; N]) {
        for (component, to) in self.components.iter().zip(&mut to) {
            assert!(from <= self.n && to.len() <= self.n - from);
            if to.is_empty() {
                continue;
            }
            // SAFETY: the caller promises values at `i * stride` for all `i < n`, and no `i` here is greater;
            // their bytes were found to fit into memory. `to` is of this library.
            unsafe {
                let first = component.add(from * self.stride);
                match self.stride {
                    0 => to.fill(first.read()),
                    1 => first.copy_to_nonoverlapping(to.as_mut_ptr(), to.len()),
                    stride => {
                        for (i, to) in to.iter_mut().enumerate() {
                            *to = first.add(i * stride).read();
                        }
                    }
                }
            }
        }
    }
}

/// Arrays of a caller to write, element `i` of each at `i * stride`.
#[derive(Clone, Copy)]
pub(crate) struct Target<'a, T, const N: usize> {
    components: [*mut T; N],
    stride: usize,
    n: usize,
    lent: PhantomData<&'a mut [T]>,
}

// SAFETY: it stands for slices that are written; threads write elements of their own, which the caller promises not to
// overlap.
unsafe impl<T: Send, const N: usize> Send for Target<'_, T, N> {}
// SAFETY: as above.
unsafe impl<T: Send, const N: usize> Sync for Target<'_, T, N> {}

impl<T: Copy, const N: usize> Target<'_, T, N> {
    /// Writes elements from `to` on.
    ///
    /// # Panics
    /// Where there are not so many.
    pub(crate) fn write(&self, to: usize, values: [&[T]; N]) {
        for (component, values) in self.components.iter().zip(values) {
            assert!(to <= self.n && values.len() <= self.n - to);
            if values.is_empty() {
                continue;
            }
            // SAFETY: the caller promises room at `i * stride` for all `i < n`, and no `i` here is greater; their
            // bytes were found to fit into memory. `values` are of this library.
            unsafe {
                let first = component.add(to * self.stride);
                if self.stride == 1 {
                    first.copy_from_nonoverlapping(values.as_ptr(), values.len());
                    continue;
                }
                for (i, &value) in values.iter().enumerate() {
                    first.add(i * self.stride).write(value);
                }
            }
        }
    }
}
