//! Suggestions for unknown keys and choices.

/// Longer suffixes precede their endings.
const UNIT_SUFFIXES: [&str; 10] = [
    "_mpa_s", "_ms", "_per_ns", "_per_nm", "_nm", "_nm2", "_pn", "_ns", "_deg", "_ag",
];

const LONGEST_KEY: usize = 100;

pub(super) fn unknown_key(found: &str, known: &[&'static str], structure: &str) -> String {
    let hint = unit_hint(known, found);
    let hint = hint.unwrap_or_else(|| format!("expected one of {}", known.join(", ")));
    format!("unknown key `{found}` in {structure}: {hint}")
}

/// Known key or choice closest to an unknown one.
pub(super) fn suggestion(found: &str, known: &[&'static str]) -> Option<String> {
    if found.len() > LONGEST_KEY {
        return None;
    }
    if let Some(key) = key_of_unit(known, found) {
        return Some(key.to_owned());
    }
    // One edit for every three letters.
    let most = (found.chars().count() / 3).max(1);
    let near = known.iter().map(|&key| {
        let distance = strsim::damerau_levenshtein(&key.to_lowercase(), &found.to_lowercase());
        (distance, key)
    });
    let (distance, key) = near.min_by_key(|(distance, _)| *distance)?;
    (distance <= most).then(|| key.to_owned())
}

/// Remedy if `found` differs from a known key only by its unit.
fn unit_hint(known: &[&'static str], found: &str) -> Option<String> {
    let key = key_of_unit(known, found);
    key.map(|key| format!("the unit is part of the key, write {key}"))
}

fn key_of_unit(known: &[&'static str], found: &str) -> Option<&'static str> {
    let is_meant = |key: &&&str| {
        let stem = stem(key);
        let rest = found.strip_prefix(stem);
        stem != **key && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let suggestion = known.iter().filter(is_meant);
    suggestion.max_by_key(|key| key.len()).copied()
}

fn stem(key: &str) -> &str {
    let shorter = UNIT_SUFFIXES
        .iter()
        .find_map(|suffix| key.strip_suffix(suffix));
    shorter.map_or(key, stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistaken_unit_is_recognised() {
        assert_eq!(
            stem("longitudinal_rigidity_pn_per_nm"),
            "longitudinal_rigidity"
        );
        assert_eq!(stem("translational_per_ns"), "translational");
        assert_eq!(stem("bend_pn_nm2"), "bend");
        let keys = ["from_nm", "to_nm", "segments", "force_pn", "turn_deg"];
        let hint = |found| unit_hint(&keys, found);
        let to_nm = Some("the unit is part of the key, write to_nm".into());
        assert_eq!((hint("to_um"), hint("to")), (to_nm.clone(), to_nm));
        assert!(hint("turn_rad").unwrap().ends_with("turn_deg"));
        assert_eq!(
            (hint("segments_nm"), hint("total"), hint("")),
            (None, None, None)
        );
    }
}
