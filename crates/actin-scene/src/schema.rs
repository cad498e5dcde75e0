//! The keys of scene files as a JSON schema, from the types that read them.

use super::written::Written;
use serde_json::Value;

/// The JSON schema of a scene: every key with its type, default and meaning; types under `$defs`. It
/// describes the data that the RON text of a scene stands for: `Name(key: value)` of an enum is an object
/// with the one key `Name`. Rules between numbers are in the descriptions; [`crate::Scene::from_ron`]
/// enforces them.
pub fn schema() -> Value {
    schemars::schema_for!(Written).to_value()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every key and every variant has a description.
    #[test]
    fn everything_is_described() {
        fn undescribed(value: &Value, path: &str, found: &mut Vec<String>) {
            if let Some(keys) = value["properties"].as_object() {
                for (key, below) in keys {
                    // The one key of an enum is the name of a variant, described above it.
                    let is_variant = key.starts_with(char::is_uppercase);
                    let described = if is_variant { value } else { below };
                    if described["description"].is_null() {
                        found.push(format!("{path}.{key}"));
                    }
                    undescribed(below, &format!("{path}.{key}"), found);
                }
            }
            for variant in value["oneOf"].as_array().into_iter().flatten() {
                if variant["description"].is_null() {
                    found.push(format!("{path}: {variant}"));
                }
                undescribed(variant, path, found);
            }
        }
        let schema = schema();
        let mut found = Vec::new();
        undescribed(&schema, "Scene", &mut found);
        for (name, definition) in schema["$defs"].as_object().unwrap() {
            undescribed(definition, name, &mut found);
        }
        assert_eq!(found, [""; 0]);
    }
}
