//! Statuses, messages, versions.

use std::ffi::c_char;

use crate::border;

/// Version of this interface, which `specula_abi_version` returns, too. Programs that were compiled for an older one
/// with the same number run with a newer library.
pub const SPECULA_ABI_VERSION: u32 = 1;

/// Returns SPECULA_ABI_VERSION of the library. May be called from any thread.
#[unsafe(no_mangle)]
pub extern "C" fn specula_abi_version() -> u32 {
    SPECULA_ABI_VERSION
}

/// Returns the version of the library, such as "0.1.0", which stays valid. May be called from any thread.
#[unsafe(no_mangle)]
pub extern "C" fn specula_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// Returns the message of the last call in this thread that failed, in UTF-8; "" before the first one.
///
/// It names the argument and says what was expected. Valid until the next call in this thread; not to be freed.
#[unsafe(no_mangle)]
pub extern "C" fn specula_last_error() -> *const c_char {
    border::last()
}
