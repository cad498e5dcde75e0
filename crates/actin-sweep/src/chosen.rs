//! Results by name: numbers of a `summary.json`.

use serde_json::Value;

/// What a name such as `filaments[1].tip_nm[0]` stands for; none where the summary has nothing there.
pub(crate) fn find<'a>(summary: &'a Value, name: &str) -> Option<&'a Value> {
    summary.pointer(&pointer(name))
}

/// The number, or the truth, of a result; none of anything else.
pub(crate) fn number(value: &Value) -> Option<f64> {
    value.as_bool().map(f64::from).or_else(|| value.as_f64())
}

/// Why a summary like this one cannot have a result of this name; none if it can. Lists may grow, and what is
/// null may become something.
pub(crate) fn refusal(like: &Value, name: &str) -> Option<String> {
    let steps: Vec<&str> = name.split(['.', '[']).collect();
    let mut here = like;
    for step in steps {
        let step = step.trim_end_matches(']');
        here = match here {
            Value::Null => return None,
            Value::Array(items) => match step.parse::<usize>() {
                Ok(index) if index < items.len() => &items[index],
                Ok(_) if is_fixed(items) => return Some(format!("has {} numbers", items.len())),
                Ok(_) => return None,
                Err(_) => return Some(format!("{step} is not an index")),
            },
            Value::Object(fields) => match fields.get(step) {
                Some(field) => field,
                None => return Some(unknown(step, fields.keys())),
            },
            _ => return Some("is a number itself".into()),
        };
    }
    match here {
        Value::Number(_) | Value::Bool(_) | Value::Null => None,
        Value::Array(_) => Some(format!("is a list: write {name}[0]")),
        Value::Object(fields) => Some(unknown("", fields.keys())),
        Value::String(_) => Some("is not a number".into()),
    }
}

/// Whether a list is a vector.
fn is_fixed(items: &[Value]) -> bool {
    items.len() == 3 && items.iter().all(Value::is_number)
}

fn unknown<'a>(step: &str, known: impl Iterator<Item = &'a String>) -> String {
    let known: Vec<&str> = known.map(String::as_str).collect();
    let known = known.join(", ");
    if step.is_empty() {
        format!("holds several numbers: {known}")
    } else {
        format!("summary.json has no {step} there: known are {known}")
    }
}

fn pointer(name: &str) -> String {
    let steps = name.split(['.', '[']);
    let steps = steps.map(|step| step.trim_end_matches(']'));
    steps.flat_map(|step| ["/", step]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_have_names() {
        let summary = serde_json::json!({
            "tip_nm": [1.0, 2.5, 3.0],
            "stability": null,
            "stable": true,
            "status": "converged",
            "beyond_range": [],
            "energy": { "total": 7.5 },
            "filaments": [{ "tip_nm": [4.0, 5.0, 6.0] }],
        });
        let of = |name| find(&summary, name).and_then(number);
        assert_eq!(of("tip_nm[1]"), Some(2.5));
        assert_eq!(of("filaments[0].tip_nm[2]"), Some(6.0));
        assert_eq!(
            (of("stable"), of("status"), of("tip_nm")),
            (Some(1.0), None, None)
        );
        for name in [
            "tip_nm[1]",
            "stability.negative",
            "beyond_range[3].value",
            "energy.total",
            "stable",
        ] {
            assert_eq!(refusal(&summary, name), None, "{name}");
        }
        for (name, why) in [
            ("tip_nm", "is a list: write tip_nm[0]"),
            ("tip_nm[3]", "has 3 numbers"),
            ("energy.sum", "no sum there: known are total"),
            ("energy", "holds several numbers: total"),
            ("status", "is not a number"),
            ("tip_nm.x", "x is not an index"),
        ] {
            let found = refusal(&summary, name).unwrap();
            assert!(found.contains(why), "{name}: {found}");
        }
    }
}
