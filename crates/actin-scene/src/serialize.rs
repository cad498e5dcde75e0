//! Serialization of types to the tree of values.

use super::deserialize::AS_WRITTEN;
use super::tree::{Kind, SceneValue};
use serde::Serialize;
use serde_content::{Data, Number, Serializer, Value};
use std::borrow::Cow;

/// Serializes a type, with or without names of structures. Without names, options that are `None` have no key.
///
/// # Panics
/// On bytes, maps and tuple structures, which scenes do not contain.
pub(super) fn to_value<T: Serialize + ?Sized>(value: &T, has_names: bool) -> SceneValue {
    let content = Serializer::new().human_readable().serialize(value);
    let content = content.expect("types of scenes can be serialized");
    Writer { has_names }.value(content)
}

#[derive(Clone, Copy)]
struct Writer {
    has_names: bool,
}

impl Writer {
    fn value(self, content: Value<'_>) -> SceneValue {
        let kind = match content {
            Value::Unit | Value::Option(None) => Kind::None,
            Value::Option(Some(value)) => return self.value(*value),
            Value::Bool(value) => Kind::Bool(value),
            Value::Number(number) => number_kind(number),
            Value::Char(value) => Kind::Text(value.into()),
            Value::String(text) => Kind::Text(text.into_owned()),
            Value::Seq(values) => Kind::List(self.values(values)),
            Value::Tuple(values) => Kind::Group(None, self.values(values)),
            Value::Struct(one) => self.structure(&one.name, one.data),
            Value::Enum(one) => self.choice(one.variant.into_owned(), one.data),
            Value::Bytes(_) | Value::Map(_) => panic!("scenes contain neither bytes nor maps"),
        };
        kind.into()
    }

    fn structure(self, name: &str, data: Data<'_>) -> Kind {
        let group = |values| Kind::Group(self.has_names.then(|| name.to_owned()), values);
        match data {
            Data::Unit => group(Vec::new()),
            Data::NewType { value } => match self.value(value).kind {
                Kind::Text(text) if name == AS_WRITTEN => Kind::Name(text),
                kind => kind,
            },
            Data::Struct { fields } => group(self.keys(fields)),
            Data::Tuple { .. } => panic!("scenes contain no tuple structures: {name}"),
        }
    }

    fn choice(self, name: String, data: Data<'_>) -> Kind {
        let values = match data {
            Data::Unit => return Kind::Name(name),
            Data::NewType { value } => match self.value(value).kind {
                Kind::Group(_, values) => values,
                _ => panic!("scenes contain no choices of numbers or lists: {name}"),
            },
            Data::Struct { fields } => self.keys(fields),
            Data::Tuple { .. } => panic!("scenes contain no choices of tuples: {name}"),
        };
        Kind::Group(Some(name), values)
    }

    fn values(self, values: Vec<Value<'_>>) -> Vec<SceneValue> {
        values.into_iter().map(|value| self.value(value)).collect()
    }

    fn keys(self, fields: Vec<(Cow<'_, str>, Value<'_>)>) -> Vec<SceneValue> {
        let fields = fields.into_iter();
        let keys = fields.map(|(key, value)| self.value(value).with_key(key));
        keys.filter(|value| self.has_names || value.kind != Kind::None)
            .collect()
    }
}

fn number_kind(number: Number) -> Kind {
    Kind::Whole(match number {
        Number::F32(value) => return Kind::Number(value.into()),
        Number::F64(value) => return Kind::Number(value),
        Number::I8(value) => value.into(),
        Number::I16(value) => value.into(),
        Number::I32(value) => value.into(),
        Number::I64(value) => value.into(),
        Number::I128(value) => value,
        Number::U8(value) => value.into(),
        Number::U16(value) => value.into(),
        Number::U32(value) => value.into(),
        Number::U64(value) => value.into(),
        _ => panic!("scenes contain no numbers of this type: {number:?}"),
    })
}
