//! The cancel token: a flag by which any thread ends a solve.

use super::guard::{self, Guarded, boundary, object};
use super::output::Out;
use super::status::roundel_status;
use crate::monitor::CancelToken;

/// A flag by which any thread may cancel or finish a call. Unlike other objects it may be set while other
/// threads use it; only free it when nobody does.
pub struct roundel_cancel_token(Guarded<CancelToken>);

object!(roundel_cancel_token, CancelToken, "cancel token");

/// Makes a token that is not set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cancel_token_new(
    token: *mut *mut roundel_cancel_token,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("cancel token", token) }?;
        out.set(guard::handle(CancelToken::new()));
        Ok(())
    })
}

/// Frees a token. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cancel_token_free(
    token: *mut roundel_cancel_token,
) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(token) }
}

/// Asks every solve that holds this token to end, those yet to begin included.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cancel_token_cancel(
    token: *const roundel_cancel_token,
) -> roundel_status {
    let body = |token: &CancelToken| {
        token.cancel();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(token, body) }
}

/// Asks every call that holds this token to finish with the best integers so far, as the callback does by
/// ROUNDEL_FLOW_FINISH. A token that is cancelled stays so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cancel_token_finish(
    token: *const roundel_cancel_token,
) -> roundel_status {
    let body = |token: &CancelToken| {
        token.finish();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(token, body) }
}

/// Takes the request back, so that the token can be used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cancel_token_reset(
    token: *const roundel_cancel_token,
) -> roundel_status {
    let body = |token: &CancelToken| {
        token.reset();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(token, body) }
}

/// Gives 1 if the token is cancelled, 0 if not.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cancel_token_is_cancelled(
    token: *const roundel_cancel_token,
    cancelled: *mut i32,
) -> roundel_status {
    let body = |token: &CancelToken| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("cancelled", cancelled) }?.set(token.is_cancelled().into());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(token, body) }
}
