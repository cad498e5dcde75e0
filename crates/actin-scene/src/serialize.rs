//! Serialization of types to the tree of values.

use super::tree::{Kind, SceneValue};
use serde::Serialize;
use serde::ser::{
    Error as _, Impossible, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    Serializer,
};
use std::fmt;

/// Serializes a type, with or without names of structures. Without names, options that are `None` have no key.
///
/// # Panics
/// On bytes, maps and tuple structures, which scenes do not contain.
pub(super) fn to_value<T: Serialize + ?Sized>(value: &T, has_names: bool) -> SceneValue {
    let value = value.serialize(Writer { has_names });
    value.expect("scenes contain only numbers, names, lists and structures")
}

/// Type that a scene cannot contain.
#[derive(Debug)]
pub(super) struct SerializeError(String);

impl fmt::Display for SerializeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for SerializeError {}

impl serde::ser::Error for SerializeError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

type Serialized = Result<SceneValue, SerializeError>;

fn unsupported<T>(what: &str) -> Result<T, SerializeError> {
    Err(SerializeError::custom(format!(
        "scenes cannot contain {what}"
    )))
}

#[derive(Clone, Copy)]
struct Writer {
    has_names: bool,
}

struct Values {
    writer: Writer,
    name: Option<&'static str>,
    all: Vec<SceneValue>,
}

impl Writer {
    fn values(self, name: Option<&'static str>) -> Values {
        let (writer, all) = (self, Vec::new());
        Values { writer, name, all }
    }
}

impl Values {
    fn push<T: ?Sized + Serialize>(
        &mut self,
        key: Option<&str>,
        value: &T,
    ) -> Result<(), SerializeError> {
        let value = value.serialize(self.writer)?;
        if self.writer.has_names || key.is_none() || value.kind != Kind::None {
            let key = key.map(str::to_owned);
            self.all.push(SceneValue { key, ..value });
        }
        Ok(())
    }

    fn group(self) -> SceneValue {
        Kind::Group(self.name.map(str::to_owned), self.all).into()
    }
}

impl Serializer for Writer {
    type Ok = SceneValue;
    type Error = SerializeError;
    type SerializeSeq = Values;
    type SerializeTuple = Values;
    type SerializeTupleStruct = Impossible<SceneValue, SerializeError>;
    type SerializeTupleVariant = Impossible<SceneValue, SerializeError>;
    type SerializeMap = Impossible<SceneValue, SerializeError>;
    type SerializeStruct = Values;
    type SerializeStructVariant = Values;

    fn serialize_bool(self, value: bool) -> Serialized {
        Ok(Kind::Bool(value).into())
    }

    fn serialize_i8(self, value: i8) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_i16(self, value: i16) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_i32(self, value: i32) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_i64(self, value: i64) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_i128(self, value: i128) -> Serialized {
        Ok(Kind::Whole(value).into())
    }

    fn serialize_u8(self, value: u8) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_u16(self, value: u16) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_u32(self, value: u32) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_u64(self, value: u64) -> Serialized {
        self.serialize_i128(value.into())
    }

    fn serialize_f32(self, value: f32) -> Serialized {
        self.serialize_f64(value.into())
    }

    fn serialize_f64(self, value: f64) -> Serialized {
        Ok(Kind::Number(value).into())
    }

    fn serialize_char(self, value: char) -> Serialized {
        Ok(Kind::Text(value.into()).into())
    }

    fn serialize_str(self, value: &str) -> Serialized {
        Ok(Kind::Text(value.to_owned()).into())
    }

    fn serialize_bytes(self, _: &[u8]) -> Serialized {
        unsupported("bytes")
    }

    fn serialize_none(self) -> Serialized {
        Ok(Kind::None.into())
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Serialized {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Serialized {
        Ok(Kind::None.into())
    }

    fn serialize_unit_struct(self, name: &'static str) -> Serialized {
        Ok(self.values(Some(name).filter(|_| self.has_names)).group())
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Serialized {
        Ok(Kind::Name(variant.to_owned()).into())
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(
        self,
        name: &'static str,
        value: &T,
    ) -> Serialized {
        let value = value.serialize(self)?;
        match value.kind {
            Kind::Text(text) if name == super::deserialize::AS_WRITTEN => {
                Ok(Kind::Name(text).into())
            }
            kind => Ok(kind.into()),
        }
    }

    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Serialized {
        let SceneValue { kind, .. } = value.serialize(self)?;
        match kind {
            Kind::Group(_, values) => Ok(Kind::Group(Some(variant.to_owned()), values).into()),
            _ => unsupported(variant),
        }
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Values, SerializeError> {
        Ok(self.values(None))
    }

    fn serialize_tuple(self, _: usize) -> Result<Values, SerializeError> {
        Ok(self.values(None))
    }

    fn serialize_tuple_struct(
        self,
        name: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleStruct, SerializeError> {
        unsupported(name)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, SerializeError> {
        unsupported(variant)
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, SerializeError> {
        unsupported("maps")
    }

    fn serialize_struct(self, name: &'static str, _: usize) -> Result<Values, SerializeError> {
        Ok(self.values(Some(name).filter(|_| self.has_names)))
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Values, SerializeError> {
        Ok(self.values(Some(variant)))
    }
}

impl SerializeSeq for Values {
    type Ok = SceneValue;
    type Error = SerializeError;

    fn serialize_element<T: ?Sized + Serialize>(
        &mut self,
        value: &T,
    ) -> Result<(), SerializeError> {
        self.push(None, value)
    }

    fn end(self) -> Serialized {
        Ok(Kind::List(self.all).into())
    }
}

impl SerializeTuple for Values {
    type Ok = SceneValue;
    type Error = SerializeError;

    fn serialize_element<T: ?Sized + Serialize>(
        &mut self,
        value: &T,
    ) -> Result<(), SerializeError> {
        self.push(None, value)
    }

    fn end(self) -> Serialized {
        Ok(self.group())
    }
}

impl SerializeStruct for Values {
    type Ok = SceneValue;
    type Error = SerializeError;

    fn serialize_field<T: ?Sized + Serialize>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), SerializeError> {
        self.push(Some(key), value)
    }

    fn end(self) -> Serialized {
        Ok(self.group())
    }
}

impl SerializeStructVariant for Values {
    type Ok = SceneValue;
    type Error = SerializeError;

    fn serialize_field<T: ?Sized + Serialize>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), SerializeError> {
        self.push(Some(key), value)
    }

    fn end(self) -> Serialized {
        Ok(self.group())
    }
}
