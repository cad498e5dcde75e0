//! JSON schema of scenes.

use super::scene_file::SceneFile;
use schemars::Schema;
use schemars::transform::{RecursiveTransform, Transform};
use serde_json::{Value, json};

/// Returns the JSON schema of a scene, with the type, default and meaning of every key. `Name(key: value)` of
/// an enum is an object with the single key `Name`, or the string `Name` if all keys have defaults. Relations
/// between numbers are described in words; [`crate::Scene::from_ron`] checks them.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(SceneFile);
    RecursiveTransform(refuse_unknown_keys).transform(&mut schema);
    let mut schema = schema.to_value();
    let definitions = schema["$defs"].clone();
    let all = definitions.as_object();
    for name in all.into_iter().flat_map(|all| all.keys()) {
        if let Some(Value::Array(choices)) = schema["$defs"][name].get_mut("oneOf") {
            let names: Vec<Value> = choices
                .iter()
                .filter_map(|one| name_alone(one, &definitions))
                .collect();
            choices.extend(names);
        }
    }
    schema
}

fn refuse_unknown_keys(schema: &mut Schema) {
    if schema.get("type") == Some(&json!("object")) {
        schema.insert("additionalProperties".to_owned(), json!(false));
    }
}

/// Returns the schema of the name alone for a choice whose keys all have defaults.
fn name_alone(choice: &Value, definitions: &Value) -> Option<Value> {
    let (name, keys) = choice["properties"].as_object()?.iter().next()?;
    let reference = keys["$ref"]
        .as_str()
        .and_then(|path| path.rsplit('/').next());
    let keys = reference.map_or(keys, |reference| &definitions[reference]);
    let description = format!("`{name}` with all defaults.");
    let alone = json!({"type": "string", "const": name, "description": description});
    keys["required"].is_null().then_some(alone)
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
