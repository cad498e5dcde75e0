//! Results of a `summary.json`, selected by name.

use serde_json::{Map, Value};

/// Returns the value with a name such as `filaments[1].tip_nm[0]` or `observables.tip[0]_x_nm.mean`.
pub(crate) fn find<'a>(summary: &'a Value, name: &str) -> Option<&'a Value> {
    let (mut here, mut rest) = (summary, name);
    while !rest.is_empty() {
        (here, rest) = match here {
            Value::Object(fields) => {
                let (key, behind) = key(rest, fields);
                (fields.get(key)?, behind)
            }
            Value::Array(items) => {
                let (step, behind) = step(rest);
                (items.get(step.parse::<usize>().ok()?)?, behind)
            }
            _ => return None,
        };
    }
    Some(here)
}

/// Splits a path after its first step, which is returned without brackets.
fn step(path: &str) -> (&str, &str) {
    let path = path.strip_prefix('.').unwrap_or(path);
    match path
        .strip_prefix('[')
        .and_then(|index| index.split_once(']'))
    {
        Some(step) => step,
        None => path.split_at(path.find(['.', '[']).unwrap_or(path.len())),
    }
}

/// Splits a path after its first key. Keys of observables contain dots and brackets, so the longest matching key is
/// used.
fn key<'a>(path: &'a str, fields: &Map<String, Value>) -> (&'a str, &'a str) {
    let inside = path.strip_prefix('.').unwrap_or(path);
    let is_meant = |key: &&String| {
        let rest = inside.strip_prefix(key.as_str());
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    };
    let known = fields.keys().filter(is_meant).max_by_key(|key| key.len());
    known.map_or_else(|| step(path), |key| inside.split_at(key.len()))
}

pub(crate) fn number(value: &Value) -> Option<f64> {
    value.as_bool().map(f64::from).or_else(|| value.as_f64())
}

/// Returns the reason why summaries with the structure of `like` have no result of this name.
///
/// Lists may be longer in other summaries, and null values may be numbers.
pub(crate) fn refusal(like: &Value, name: &str) -> Option<String> {
    let (mut here, mut rest) = (like, name);
    while !rest.is_empty() {
        (here, rest) = match here {
            Value::Null => return None,
            Value::Array(items) => {
                let (step, behind) = step(rest);
                match step.parse::<usize>() {
                    Ok(index) if index < items.len() => (&items[index], behind),
                    Ok(_) if is_fixed(items) => {
                        return Some(format!("has {} numbers", items.len()));
                    }
                    Ok(_) => return None,
                    Err(_) => return Some(format!("{step} is not an index")),
                }
            }
            Value::Object(fields) => {
                let (key, behind) = key(rest, fields);
                match fields.get(key) {
                    Some(field) => (field, behind),
                    None => return Some(unknown(key, fields.keys())),
                }
            }
            _ => return Some("is a number".into()),
        };
    }
    match here {
        Value::Number(_) | Value::Bool(_) | Value::Null => None,
        Value::Array(_) => Some(format!("is a list: write {name}[0]")),
        Value::Object(fields) => Some(unknown("", fields.keys())),
        Value::String(_) => Some("is not a number".into()),
    }
}

fn is_fixed(items: &[Value]) -> bool {
    items.len() == 3 && items.iter().all(Value::is_number)
}

fn unknown<'a>(step: &str, known: impl Iterator<Item = &'a String>) -> String {
    let known: Vec<&str> = known.map(String::as_str).collect();
    let known = known.join(", ");
    if step.is_empty() {
        format!("contains several numbers: {known}")
    } else {
        format!("summary.json has no {step} there: expected one of {known}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary() -> Value {
        serde_json::json!({
            "tip_nm": [1.0, 2.5, 3.0],
            "stability": null,
            "stable": true,
            "status": "converged",
            "beyond_range": [],
            "energy": { "total": 7.5 },
            "filaments": [{ "tip_nm": [4.0, 5.0, 6.0] }],
            "observables": {
                "twist[0]_at_12.5nm_rad_per_nm": { "last": 0.5, "mean": null },
                "twist[0]_at_12nm_rad_per_nm": { "last": 0.25 },
            },
        })
    }

    #[test]
    fn results_have_names() {
        let summary = summary();
        let of = |name| find(&summary, name).and_then(number);
        assert_eq!(of("tip_nm[1]"), Some(2.5));
        assert_eq!(of("filaments[0].tip_nm[2]"), Some(6.0));
        assert_eq!(
            of("observables.twist[0]_at_12.5nm_rad_per_nm.last"),
            Some(0.5)
        );
        assert_eq!(
            of("observables.twist[0]_at_12nm_rad_per_nm.last"),
            Some(0.25)
        );
        assert_eq!(
            (of("stable"), of("status"), of("tip_nm")),
            (Some(1.0), None, None)
        );
    }

    #[test]
    fn names_that_no_summary_has_are_refused() {
        let summary = summary();
        for name in [
            "tip_nm[1]",
            "stability.negative",
            "beyond_range[3].value",
            "energy.total",
            "stable",
            "observables.twist[0]_at_12.5nm_rad_per_nm.mean",
        ] {
            assert_eq!(refusal(&summary, name), None, "{name}");
        }
        for (name, why) in [
            ("tip_nm", "is a list: write tip_nm[0]"),
            ("tip_nm[3]", "has 3 numbers"),
            ("energy.sum", "no sum there: expected one of total"),
            ("energy", "contains several numbers: total"),
            ("status", "is not a number"),
            ("tip_nm.x", "x is not an index"),
            (
                "observables.twist[0]_at_12.5nm_rad_per_nm",
                "contains several numbers: last, mean",
            ),
            (
                "observables.tip[0]_x_nm.last",
                "no tip there: expected one of twist[0]_at_12.5nm",
            ),
        ] {
            let found = refusal(&summary, name).unwrap();
            assert!(found.contains(why), "{name}: {found}");
        }
    }
}
