//! The boundary of the library: no panic leaves it or prints, and a handle that was in use during a panic
//! becomes unusable.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::{Failure, Outcome};
use super::input::aligned;
use super::status::roundel_status;

thread_local! {
    /// The number of entries of the library that this thread is in: more than one inside a callback.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
}

struct Inside;

impl Inside {
    fn enter() -> Self {
        // Rust's default hook prints. It is replaced once, by one that asks whose thread it is,
        // so that a Rust program that uses this interface keeps its own messages.
        static HOOK: Once = Once::new();
        HOOK.call_once(|| {
            let before = panic::take_hook();
            panic::set_hook(Box::new(move |info| {
                if DEPTH.try_with(Cell::get).unwrap_or(0) == 0 {
                    before(info);
                }
            }));
        });
        DEPTH.set(DEPTH.get() + 1);
        Inside
    }
}

impl Drop for Inside {
    fn drop(&mut self) {
        DEPTH.set(DEPTH.get() - 1);
    }
}

/// Runs the body of an entry. A panic becomes a status and raises `unusable`.
pub(super) fn boundary(
    unusable: Option<&AtomicBool>,
    body: impl FnOnce() -> Outcome,
) -> roundel_status {
    // This catch is the outermost: recording a failure allocates, and may itself fail.
    let recorded = panic::catch_unwind(AssertUnwindSafe(|| {
        let _inside = Inside::enter();
        let outcome = panic::catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
            if let Some(flag) = unusable {
                flag.store(true, Ordering::Relaxed);
            }
            Err(Failure::Panic(text_of(&*payload)))
        });
        match outcome {
            Ok(()) => roundel_status::ROUNDEL_OK,
            Err(failure) => failure.record(),
        }
    }));
    recorded.unwrap_or(roundel_status::ROUNDEL_ERROR_PANIC)
}

fn text_of(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("unknown").into()
}

/// The content of every handle.
pub(super) struct Guarded<T> {
    value: T,
    /// Set through `const` handles too, which several threads may hold.
    unusable: AtomicBool,
}

/// A type that C holds by pointer.
pub(super) trait Object: Sized {
    type Value;
    /// The name of the type in messages.
    const NAME: &'static str;
    fn new(guarded: Guarded<Self::Value>) -> Self;
    fn guarded(&self) -> &Guarded<Self::Value>;
    fn guarded_mut(&mut self) -> &mut Guarded<Self::Value>;
}

/// Makes `$object`, a tuple struct of one `Guarded<$value>`, an [`Object`].
macro_rules! object {
    ($object:ident, $value:ty, $name:literal) => {
        impl $crate::capi::guard::Object for $object {
            type Value = $value;
            const NAME: &'static str = $name;
            fn new(guarded: $crate::capi::guard::Guarded<$value>) -> Self {
                $object(guarded)
            }
            fn guarded(&self) -> &$crate::capi::guard::Guarded<$value> {
                &self.0
            }
            fn guarded_mut(&mut self) -> &mut $crate::capi::guard::Guarded<$value> {
                &mut self.0
            }
        }
    };
}
pub(super) use object;

impl<T> Guarded<T> {
    fn usable(&self) -> Outcome {
        if self.unusable.load(Ordering::Relaxed) {
            return Err(Failure::Unusable);
        }
        Ok(())
    }
}

/// A new handle for `value`, owned by whoever takes the pointer.
pub(super) fn handle<H: Object>(value: H::Value) -> *mut H {
    let unusable = AtomicBool::new(false);
    Box::into_raw(Box::new(H::new(Guarded { value, unusable })))
}

/// The value behind a handle.
///
/// # Safety
/// `handle` is NULL or a live handle that nobody writes to.
pub(super) unsafe fn value<'a, H: Object + 'a>(handle: *const H) -> Outcome<&'a H::Value> {
    aligned(H::NAME, handle)?;
    // SAFETY: not NULL and aligned by the line above; live by the caller's word.
    let guarded = unsafe { &*handle }.guarded();
    guarded.usable()?;
    Ok(&guarded.value)
}

/// The value behind a handle, or `default` where that is NULL.
///
/// # Safety
/// As [`value`].
pub(super) unsafe fn value_or<'a, H: Object + 'a>(
    handle: *const H,
    default: &'a H::Value,
) -> Outcome<&'a H::Value> {
    if handle.is_null() {
        return Ok(default);
    }
    // SAFETY: handed on.
    unsafe { value(handle) }
}

/// An entry that reads one handle. A panic in `body` gives the handle up.
///
/// # Safety
/// `handle` is NULL or a live handle that nobody writes to.
pub(super) unsafe fn read<H: Object>(
    handle: *const H,
    body: impl FnOnce(&H::Value) -> Outcome,
) -> roundel_status {
    if let Err(failure) = aligned(H::NAME, handle) {
        return boundary(None, || Err(failure));
    }
    // SAFETY: not NULL and aligned by the lines above; live by the caller's word.
    let guarded = unsafe { &*handle }.guarded();
    boundary(Some(&guarded.unusable), || {
        guarded.usable()?;
        body(&guarded.value)
    })
}

/// An entry that changes one handle. A panic in `body` gives the handle up.
///
/// # Safety
/// `handle` is NULL or a live handle that nobody else uses.
pub(super) unsafe fn write<H: Object>(
    handle: *mut H,
    body: impl FnOnce(&mut H::Value) -> Outcome,
) -> roundel_status {
    if let Err(failure) = aligned(H::NAME, handle) {
        return boundary(None, || Err(failure));
    }
    // SAFETY: not NULL and aligned by the lines above; live and ours alone by the caller's word.
    let Guarded { value, unusable } = unsafe { &mut *handle }.guarded_mut();
    boundary(Some(&*unusable), || {
        if unusable.load(Ordering::Relaxed) {
            return Err(Failure::Unusable);
        }
        body(value)
    })
}

/// An entry that frees a handle; NULL is none.
///
/// # Safety
/// `handle` is NULL or a live handle that nobody else uses, now or later.
pub(super) unsafe fn free<H: Object>(handle: *mut H) -> roundel_status {
    boundary(None, || {
        if !handle.is_null() {
            // SAFETY: made by `handle` above, by the caller's word, and not freed before.
            drop(unsafe { Box::from_raw(handle) });
        }
        Ok(())
    })
}
