//! Rules of single numbers and vectors of a scene.

use super::problem::Problems;
use super::tree::{Kind, SceneValue};
use super::{SceneProblem, rules::show};
use std::collections::HashMap;
use std::sync::LazyLock;

const LARGEST: f64 = 1e60;

const SMALLEST: f64 = 1e-60;

/// Rules of numbers by the key of their structure and their own key, each of which may be `any`. All other numbers
/// must be finite. Constitutive laws check their own numbers (`law`).
static RULES: LazyLock<HashMap<(&str, &str), &str>> = LazyLock::new(|| {
    let lines = include_str!("number_rules.csv").lines().skip(1);
    let row = |line: &'static str| {
        let (structure, rest) = line.split_once(',')?;
        let (key, rule) = rest.split_once(',')?;
        Some(((structure, key), rule))
    };
    lines.filter_map(row).collect()
});

/// Returns the rule of the numbers at `key` of the structure at the key `structure`.
fn rule(structure: &str, key: &str) -> &'static str {
    let names = [(structure, key), (structure, "any"), ("any", key)];
    let mut rules = names.iter().filter_map(|name| RULES.get(name));
    rules.next().unwrap_or(&"finite")
}

/// Checks all numbers of a scene or of a scene file.
pub(super) fn check(scene: &SceneValue, problems: &mut Problems) {
    walk(scene, "", ["", ""], problems);
}

/// Checks the numbers at `path`, whose last two keys are `keys`.
fn walk(value: &SceneValue, path: &str, keys: [&str; 2], problems: &mut Problems) {
    if let Some(numbers) = numbers(value) {
        return problems.note(check_numbers(path, &numbers, rule(keys[0], keys[1])));
    }
    for (i, child) in value.children().iter().enumerate() {
        match child.key() {
            None => walk(child, &format!("{path}[{i}]"), keys, problems),
            Some(key) if path.is_empty() => walk(child, key, ["", key], problems),
            Some(key) => walk(child, &format!("{path}.{key}"), [keys[1], key], problems),
        }
    }
}

/// Returns a number or the components of a vector.
fn numbers(value: &SceneValue) -> Option<Vec<f64>> {
    match &value.kind {
        Kind::Number(number) => Some(vec![*number]),
        Kind::Group(None, parts) if !parts.is_empty() => {
            let number = |part: &SceneValue| match part.kind {
                Kind::Number(number) if part.key.is_none() => Some(number),
                _ => None,
            };
            parts.iter().map(number).collect()
        }
        _ => None,
    }
}

fn check_numbers(path: &str, numbers: &[f64], rule: &str) -> Result<(), SceneProblem> {
    let all = |is_valid: fn(f64) -> bool| numbers.iter().all(|x| x.is_finite() && is_valid(*x));
    let each = if numbers.len() > 1 { "each " } else { "" };
    let rule = match rule {
        "positive" if !all(|x| x > 0.0) => format!("{each}must be finite and greater than 0"),
        "not negative" if !all(|x| x >= 0.0) => format!("{each}must be finite and not negative"),
        "direction" if all(|x| x == 0.0) => "must not be zero".to_owned(),
        "law" => return check_magnitudes(path, numbers),
        _ if !all(|_| true) => "must be finite".to_owned(),
        _ => return check_magnitudes(path, numbers),
    };
    let value = match numbers {
        [number] => show(number),
        _ => show(numbers),
    };
    Err(SceneProblem::new(path, value, rule))
}

/// Refuses magnitudes for which products of a few numbers may overflow or underflow.
fn check_magnitudes(path: &str, numbers: &[f64]) -> Result<(), SceneProblem> {
    let is_extreme =
        |x: &f64| x.is_finite() && *x != 0.0 && !(SMALLEST..=LARGEST).contains(&x.abs());
    let Some(i) = numbers.iter().position(is_extreme) else {
        return Ok(());
    };
    let index = (numbers.len() > 1).then(|| format!("[{i}]"));
    let path = format!("{path}{}", index.unwrap_or_default());
    let rule = format!("numbers are 0 or have magnitudes from {SMALLEST:e} to {LARGEST:e}");
    Err(SceneProblem::new(path, show(numbers[i]), rule))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;
    use std::collections::HashSet;

    fn collect(schema: &Value, keys: &mut HashSet<String>) {
        match schema {
            Value::Object(all) => {
                let properties = all.get("properties").and_then(Value::as_object);
                keys.extend(properties.into_iter().flatten().map(|(key, _)| key.clone()));
                all.values().for_each(|one| collect(one, keys));
            }
            Value::Array(all) => all.iter().for_each(|one| collect(one, keys)),
            _ => {}
        }
    }

    #[test]
    fn rules_are_known_and_belong_to_keys_of_scenes() {
        let mut keys = HashSet::from(["any".to_owned()]);
        collect(&crate::schema(), &mut keys);
        let rows = include_str!("number_rules.csv").lines().count() - 1;
        assert_eq!(RULES.len(), rows);
        for ((structure, key), rule) in RULES.iter() {
            assert!(
                keys.contains(*structure) && keys.contains(*key),
                "{structure}, {key}"
            );
            let known = ["direction", "law", "not negative", "positive"];
            assert!(known.contains(rule), "{rule}");
        }
    }
}
