//! Lines for the standard streams: `println!` and `eprintln!` as this program means them.
//!
//! Those of the standard library panic where a line cannot be written, and a run would be lost with
//! its reader. Those of this module stand in their place. A reader that has gone away (`| head`) wants no
//! more lines: they are dropped, the program goes on, and its exit code says what it has done. If standard
//! output fails for another reason (a full disk), [`ending`] tells. Control characters, which names of files may hold,
//! are written as `\u{1b}`: no terminal obeys them.

use std::fmt;
use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};

/// Why standard output is not written to any more.
static FAILURE: Mutex<Option<io::Error>> = Mutex::new(None);

macro_rules! println {
    ($($line:tt)*) => {
        $crate::streams::print_line(format_args!($($line)*))
    };
}

macro_rules! eprintln {
    ($($line:tt)*) => {
        $crate::streams::print_error_line(format_args!($($line)*))
    };
}

/// Writes a line to standard output, as long as that can be written to.
pub(crate) fn print_line(line: fmt::Arguments<'_>) {
    if cfg!(test) {
        // Which the test harness captures.
        return std::println!("{line}");
    }
    let mut failure = FAILURE.lock().unwrap_or_else(PoisonError::into_inner);
    if failure.is_none() {
        *failure = writeln!(io::stdout(), "{}", visible(line)).err();
    }
}

/// Writes a line to standard error. A failure to write there is ignored.
pub(crate) fn print_error_line(line: fmt::Arguments<'_>) {
    if cfg!(test) {
        return std::eprintln!("{line}");
    }
    let _ = writeln!(io::stderr(), "{}", visible(line));
}

/// A line with control characters in words, but for line feeds and tabs.
fn visible(line: fmt::Arguments<'_>) -> String {
    let line = line.to_string();
    let mut visible = String::with_capacity(line.len());
    for c in line.chars() {
        if c.is_control() && !matches!(c, '\n' | '\t') {
            visible.extend(c.escape_unicode());
        } else {
            visible.push(c);
        }
    }
    visible
}

/// Whether all lines have been written to standard output, or to a reader that has had enough of them.
pub(crate) fn ending() -> Result<(), String> {
    let mut failure = FAILURE.lock().unwrap_or_else(PoisonError::into_inner);
    let failure = failure.take().or_else(|| io::stdout().flush().err());
    match failure {
        Some(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(format!("standard output: {error}"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::visible;

    #[test]
    fn control_characters_are_shown() {
        let name = "\u{1b}]0;title\u{7}\u{9b}2J\r\n\tå.ron";
        let shown = "\\u{1b}]0;title\\u{7}\\u{9b}2J\\u{d}\n\tå.ron";
        assert_eq!(visible(format_args!("{name}")), shown);
    }
}
