//! Ctrl-C: the first one asks for the results so far, the second ends the program.

use std::io::{self, IsTerminal, Write};
use std::sync::OnceLock;

use roundel::{CancelToken, Error, Result};

/// The exit code that a shell reports for a program killed by SIGINT: 128 plus the number of the signal.
const KILLED: i32 = 130;

/// The token of the process, once Ctrl-C is caught.
static TOKEN: OnceLock<CancelToken> = OnceLock::new();

/// A token by which Ctrl-C has the run finished with the best integers so far.
///
/// Every call gives the same token. A second Ctrl-C ends the program at once.
pub fn cancel_token() -> Result<CancelToken> {
    if let Some(token) = TOKEN.get() {
        return Ok(token.clone());
    }
    let token = TOKEN.get_or_init(CancelToken::new).clone();
    let set = token.clone();
    ctrlc::set_handler(move || {
        if set.is_finishing() {
            std::process::exit(KILLED);
        }
        set.finish();
        let mut stderr = io::stderr();
        if stderr.is_terminal() {
            // If stderr is closed, nobody reads the line.
            let _ = writeln!(
                stderr,
                "\nroundel: finishing with the best so far; Ctrl-C again ends at once"
            );
        }
    })
    .map_err(|reason| Error::Io {
        message: format!("Ctrl-C cannot be caught: {reason}"),
    })?;
    Ok(token)
}

/// Whether Ctrl-C asked for the results so far.
pub fn was_asked() -> bool {
    TOKEN.get().is_some_and(CancelToken::is_finishing)
}
