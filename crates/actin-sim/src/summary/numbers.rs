//! Numbers of a summary by key.

use serde::Serialize;
use serde_content::{Data, Number, Serializer, Value};

/// Returns all floating-point numbers, with the paths of their keys in the file.
pub(super) fn of(summary: &impl Serialize) -> Vec<(String, f64)> {
    let value = Serializer::new().serialize(summary);
    let value = value.expect("a summary can be serialized");
    let mut numbers = Vec::new();
    collect(&value, "", &mut numbers);
    numbers
}

fn collect(value: &Value<'_>, key: &str, numbers: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(Number::F64(number)) => numbers.push((key.to_owned(), *number)),
        Value::Option(Some(value)) => collect(value, key, numbers),
        Value::Struct(one) => {
            if let Data::Struct { fields } = &one.data {
                for (name, value) in fields {
                    collect(value, &below(key, name), numbers);
                }
            }
        }
        // Also structures with flattened fields.
        Value::Map(entries) => {
            for (name, value) in entries {
                if let Value::String(name) = name {
                    collect(value, &below(key, name), numbers);
                }
            }
        }
        Value::Seq(values) | Value::Tuple(values) => {
            for (i, value) in values.iter().enumerate() {
                collect(value, &format!("{key}[{i}]"), numbers);
            }
        }
        _ => {}
    }
}

fn below(key: &str, name: &str) -> String {
    if key.is_empty() {
        name.to_owned()
    } else {
        format!("{key}.{name}")
    }
}
