//! Writes types of a scene as a value.

use super::SceneValue;
use serde::ser::{
    Error as _, Impossible, Serialize, SerializeSeq, SerializeStruct, SerializeStructVariant,
    SerializeTuple, Serializer,
};
use std::fmt;

/// What no scene holds.
#[derive(Debug)]
pub(super) struct Unwritable(String);

impl fmt::Display for Unwritable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unwritable {}

impl serde::ser::Error for Unwritable {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

fn unwritable(what: &str) -> Unwritable {
    Unwritable::custom(format!("no scene holds {what}"))
}

type Written = Result<SceneValue, Unwritable>;

/// Makes a value of what it is given.
#[derive(Clone, Copy)]
pub(super) struct Writer;

/// The elements of a list.
pub(super) struct Elements(Vec<SceneValue>);

/// Keys with their values, and the choice that they belong to.
pub(super) struct Keys {
    choice: Option<&'static str>,
    all: Vec<(String, SceneValue)>,
}

impl Keys {
    fn of(choice: Option<&'static str>) -> Self {
        let all = Vec::new();
        Self { choice, all }
    }
}

/// A choice with what it holds.
fn chosen(name: &str, value: SceneValue) -> SceneValue {
    SceneValue::Keys(vec![(name.to_owned(), value)])
}

impl Serializer for Writer {
    type Ok = SceneValue;
    type Error = Unwritable;
    type SerializeSeq = Elements;
    type SerializeTuple = Elements;
    type SerializeTupleStruct = Impossible<SceneValue, Unwritable>;
    type SerializeTupleVariant = Impossible<SceneValue, Unwritable>;
    type SerializeMap = Impossible<SceneValue, Unwritable>;
    type SerializeStruct = Keys;
    type SerializeStructVariant = Keys;

    fn serialize_bool(self, v: bool) -> Written {
        Ok(SceneValue::Bool(v))
    }

    fn serialize_i8(self, v: i8) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_i16(self, v: i16) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_i32(self, v: i32) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_i64(self, v: i64) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_u8(self, v: u8) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_u16(self, v: u16) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_u32(self, v: u32) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_u64(self, v: u64) -> Written {
        Ok(SceneValue::Whole(v.into()))
    }

    fn serialize_f32(self, v: f32) -> Written {
        Ok(SceneValue::Number(v.into()))
    }

    fn serialize_f64(self, v: f64) -> Written {
        Ok(SceneValue::Number(v))
    }

    fn serialize_char(self, v: char) -> Written {
        Ok(SceneValue::Text(v.into()))
    }

    fn serialize_str(self, v: &str) -> Written {
        Ok(SceneValue::Text(v.to_owned()))
    }

    fn serialize_bytes(self, _v: &[u8]) -> Written {
        Err(unwritable("bytes"))
    }

    fn serialize_none(self) -> Written {
        Ok(SceneValue::None)
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Written {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Written {
        Ok(SceneValue::None)
    }

    fn serialize_unit_struct(self, _name: &'static str) -> Written {
        Ok(SceneValue::Keys(Vec::new()))
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Written {
        Ok(SceneValue::Text(variant.to_owned()))
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(
        self,
        _name: &'static str,
        value: &T,
    ) -> Written {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Written {
        Ok(chosen(variant, value.serialize(self)?))
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Self::SerializeSeq, Unwritable> {
        Ok(Elements(Vec::new()))
    }

    fn serialize_tuple(self, _: usize) -> Result<Self::SerializeTuple, Unwritable> {
        Ok(Elements(Vec::new()))
    }

    fn serialize_tuple_struct(
        self,
        name: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleStruct, Unwritable> {
        Err(unwritable(name))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, Unwritable> {
        Err(unwritable(variant))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, Unwritable> {
        Err(unwritable("maps"))
    }

    fn serialize_struct(
        self,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStruct, Unwritable> {
        Ok(Keys::of(None))
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStructVariant, Unwritable> {
        Ok(Keys::of(Some(variant)))
    }
}

impl Elements {
    fn push<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), Unwritable> {
        self.0.push(value.serialize(Writer)?);
        Ok(())
    }
}

impl Keys {
    /// Adds a key; what is left out is no key.
    fn push<T: ?Sized + Serialize>(&mut self, key: &str, value: &T) -> Result<(), Unwritable> {
        let value = value.serialize(Writer)?;
        if value != SceneValue::None {
            self.all.push((key.to_owned(), value));
        }
        Ok(())
    }

    fn keys(self) -> SceneValue {
        let keys = SceneValue::Keys(self.all);
        match self.choice {
            None => keys,
            Some(name) => chosen(name, keys),
        }
    }
}

impl SerializeSeq for Elements {
    type Ok = SceneValue;
    type Error = Unwritable;

    fn serialize_element<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), Unwritable> {
        self.push(value)
    }

    fn end(self) -> Written {
        Ok(SceneValue::List(self.0))
    }
}

impl SerializeTuple for Elements {
    type Ok = SceneValue;
    type Error = Unwritable;

    fn serialize_element<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), Unwritable> {
        self.push(value)
    }

    fn end(self) -> Written {
        Ok(SceneValue::List(self.0))
    }
}

impl SerializeStruct for Keys {
    type Ok = SceneValue;
    type Error = Unwritable;

    fn serialize_field<T: ?Sized + Serialize>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), Unwritable> {
        self.push(key, value)
    }

    fn end(self) -> Written {
        Ok(self.keys())
    }
}

impl SerializeStructVariant for Keys {
    type Ok = SceneValue;
    type Error = Unwritable;

    fn serialize_field<T: ?Sized + Serialize>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), Unwritable> {
        self.push(key, value)
    }

    fn end(self) -> Written {
        Ok(self.keys())
    }
}
