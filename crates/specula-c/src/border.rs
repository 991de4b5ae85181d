//! What every exported function goes through: no panic leaves it, and a thread's last failure has its message here.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::failure::{Failure, Status};
use crate::pointers::Caller;

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// The message of this thread's last failure; it is replaced by the next one.
pub(crate) fn last() -> *const c_char {
    LAST.try_with(|last| last.borrow().as_ptr())
        .unwrap_or(c"".as_ptr())
}

fn store(message: &str) {
    let text = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
    // A thread that is about to end has no message any more.
    let _ = LAST.try_with(|last| *last.borrow_mut() = text);
}

/// Runs the body of an exported function: no panic leaves it, and a failure is kept for `specula_last_error`.
pub(crate) fn border(body: impl FnOnce(&Caller) -> Result<(), Failure>) -> Status {
    let outcome = catch_unwind(AssertUnwindSafe(|| body(&Caller::of_exported_function())));
    let failure = match outcome {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(failure)) => failure,
        Err(panic) => Failure::new(Status::Internal, panic_text(&*panic)),
    };
    store(&failure.message);
    failure.status
}

fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = (panic.downcast_ref::<&str>().copied())
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    let text = text.unwrap_or("no message");
    format!("a fault of the library, please report it: {text}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_status_and_a_message() {
        assert_eq!(border(|_| panic!("number {}", 3)), Status::Internal);
        let kept = || LAST.with(|last| last.borrow().to_string_lossy().into_owned());
        assert!(kept().ends_with("please report it: number 3"), "{}", kept());
        assert_eq!(
            border(|_| Err(Failure::invalid("a\0b"))),
            Status::InvalidArgument
        );
        assert_eq!(kept(), "a\u{fffd}b");
        assert_eq!(border(|_| Ok(())), Status::Ok);
        assert_eq!(kept(), "a\u{fffd}b");
    }
}
