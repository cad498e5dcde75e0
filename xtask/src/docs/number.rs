//! Numbers as they stand in a text: found, and written with as many digits.

/// The number that `word` is, brackets, stars and commas around it left out, with its place.
pub(super) fn in_word(word: &str) -> Option<(usize, &str)> {
    let around = |c: char| !(c.is_ascii_digit() || "+-.".contains(c));
    let start = word.find(|c: char| c.is_ascii_digit() || "+-".contains(c))?;
    let is_opening = |c: char| "(*[".contains(c);
    if !word[..start].chars().all(is_opening) {
        return None;
    }
    let number = word[start..].trim_end_matches(around);
    let number = number.strip_suffix('.').unwrap_or(number);
    let is_number = number.parse::<f64>().is_ok_and(f64::is_finite);
    is_number.then_some((start, number))
}

/// `value` with the digits, the exponent and the sign of `shown`.
pub(super) fn like(shown: &str, value: f64) -> String {
    let (mantissa, exponent) = shown
        .split_once('e')
        .map_or((shown, None), |(mantissa, e)| (mantissa, Some(e)));
    let decimals = mantissa
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    let power: i32 = exponent.and_then(|e| e.parse().ok()).unwrap_or(0);
    let scaled = value / 10_f64.powi(power);
    let digits = if mantissa.starts_with('+') {
        format!("{scaled:+.decimals$}")
    } else {
        format!("{scaled:.decimals$}")
    };
    // A minus before nothing but zeros says less than none.
    let is_zero = digits.chars().all(|c| "-0.".contains(c));
    let digits = digits.trim_start_matches(if is_zero { "-" } else { "" });
    exponent.map_or(digits.to_owned(), |e| format!("{digits}e{e}"))
}

#[cfg(test)]
mod tests {
    use super::{in_word, like};

    #[test]
    fn numbers_are_written_as_they_were() {
        assert_eq!(like("36.74", 36.7449), "36.74");
        assert_eq!(like("1137", 1136.6), "1137");
        assert_eq!(like("3.936e4", 39_412.0), "3.941e4");
        assert_eq!(like("+4.4", 4.36), "+4.4");
        assert_eq!(like("+4.4", -4.36), "-4.4");
        assert_eq!(like("0.0", -0.01), "0.0");
    }

    /// Powers in units, formulas and names are no numbers.
    #[test]
    fn numbers_are_told_from_words() {
        assert_eq!(in_word("36.74"), Some((0, "36.74")));
        assert_eq!(in_word("**1.72**,"), Some((2, "1.72")));
        assert_eq!(in_word("(-4.4);"), Some((1, "-4.4")));
        assert_eq!(in_word("1.6e4."), Some((0, "1.6e4")));
        for word in ["nm^2", "rod-140", "-", "per", "2x3", "F/3B"] {
            assert_eq!(in_word(word), None, "{word}");
        }
    }
}
