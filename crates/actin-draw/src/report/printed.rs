//! Printed numbers, with tolerances from their last digits.

use super::{Origin, Row};

/// Number of standard deviations within which two samples agree.
pub const DEVIATIONS: f64 = 2.0;

/// Parses a printed number. Returns its value and half a unit of its last significant digit.
///
/// Trailing zeros of integers with three or more digits are not significant: `700` is accurate to 50, `75` to 0.5,
/// `1.6e4` to 500.
///
/// ```
/// use actin_draw::report::printed;
/// assert_eq!(printed("700"), (700.0, 50.0));
/// assert_eq!(printed("1.6e4"), (1.6e4, 500.0));
/// ```
///
/// # Panics
/// If the text is not a number.
pub fn printed(text: &str) -> (f64, f64) {
    let value = text.parse().expect("a number as the paper prints it");
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let exponent: i32 = exponent.parse().expect("a whole exponent");
    let zeros = |text: &str| text.len() - text.trim_end_matches('0').len();
    let last = match digits.split_once('.') {
        Some((_, decimals)) => -places(decimals.len()),
        None if digits.len() > 2 => places(zeros(digits)),
        None => 0,
    };
    (value, 0.5 * 10f64.powi(exponent + last))
}

fn places(count: usize) -> i32 {
    i32::try_from(count).expect("a few digits")
}

impl Row {
    /// Adds a reference value without a verdict.
    #[must_use]
    pub fn with_reference(self, expected: f64, origin: Origin) -> Self {
        Self {
            paper: Some(expected),
            origin: Some(origin),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_unit_of_the_last_digit() {
        let cases = [
            ("1.6e4", 1.6e4, 500.0),
            ("9.6e3", 9.6e3, 50.0),
            ("10", 10.0, 0.5),
            ("75", 75.0, 0.5),
            ("120", 120.0, 5.0),
            ("700", 700.0, 50.0),
            ("5.52", 5.52, 0.005),
            ("1.10", 1.1, 0.005),
            ("349", 349.0, 0.5),
            ("27.96", 27.96, 0.005),
        ];
        for (text, value, half) in cases {
            let (found, tolerance) = printed(text);
            assert!((found - value).abs() <= 1e-12 * value, "{text}");
            assert!((tolerance - half).abs() <= 1e-12 * half, "{text}");
        }
    }
}
