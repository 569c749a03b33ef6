//! Ctrl-C: the first one asks the solver to end with its best solution, the second ends the program.

use roundel::{CancelToken, Error, Result};

/// The exit code that a shell reports for a program killed by SIGINT: 128 plus the number of the signal.
const KILLED: i32 = 130;

/// A token that Ctrl-C sets.
///
/// A second Ctrl-C ends the program at once, for parts that do not check the token, such as reading.
pub fn cancel_token() -> Result<CancelToken> {
    let token = CancelToken::new();
    let set = token.clone();
    ctrlc::set_handler(move || {
        if set.is_cancelled() {
            std::process::exit(KILLED);
        }
        set.cancel();
    })
    .map_err(|reason| Error::Io {
        message: format!("Ctrl-C cannot be caught: {reason}"),
    })?;
    Ok(token)
}
