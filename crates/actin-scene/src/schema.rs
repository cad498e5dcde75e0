//! JSON schema of scenes.

use super::scene_file::SceneFile;
use serde_json::Value;

/// Returns the JSON schema of a scene, with the type, default and meaning of every key. `Name(key: value)` of
/// an enum is an object with the single key `Name`. Relations between numbers are described in words;
/// [`crate::Scene::from_ron`] checks them.
pub fn schema() -> Value {
    schemars::schema_for!(SceneFile).to_value()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_described() {
        fn undescribed(value: &Value, path: &str, found: &mut Vec<String>) {
            if let Some(keys) = value["properties"].as_object() {
                for (key, below) in keys {
                    // Variants are described one level higher.
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
