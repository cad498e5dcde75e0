//! `println!` and `eprintln!` that do not panic on write errors.
//!
//! The macros of the standard library panic if a line cannot be written, which would lose the run. After the reader
//! of standard output has closed the pipe (`| head`), lines are dropped and the exit code is unaffected. Other
//! failures of standard output (disk full) are returned by [`ending`]. Control characters, which file names can
//! contain, are escaped as `\u{1b}`.

use std::fmt;
use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};

/// First write error of standard output.
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

/// Writes a line to standard output, unless an earlier write failed.
pub(crate) fn print_line(line: fmt::Arguments<'_>) {
    if cfg!(test) {
        // Captured by the test harness.
        return std::println!("{line}");
    }
    let mut failure = FAILURE.lock().unwrap_or_else(PoisonError::into_inner);
    if failure.is_none() {
        *failure = writeln!(io::stdout(), "{}", visible(line)).err();
    }
}

pub(crate) fn print_error_line(line: fmt::Arguments<'_>) {
    if cfg!(test) {
        return std::eprintln!("{line}");
    }
    let _ = writeln!(io::stderr(), "{}", visible(line));
}

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

/// Flushes standard output and returns its first write error. A closed pipe is not an error.
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
