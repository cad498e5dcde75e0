//! Deserialization of types from the tree of values, with positions of errors.

use super::suggestion::{suggestion, unknown_key};
use super::tree::{Kind, SceneValue, Source};
use serde::de::value::{StrDeserializer, StringDeserializer};
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Expected, IntoDeserializer,
    MapAccess, SeqAccess, Unexpected, VariantAccess, Visitor,
};
use std::borrow::Cow;
use std::fmt;

/// Name of a newtype that receives the source text of a value.
pub(super) const AS_WRITTEN: &str = "$written";

/// Enum whose keys may be written without the name of the choice.
const UNNAMED: &str = "Drag";

#[derive(Debug)]
pub(super) struct DeserializeError {
    reason: Reason,
    /// Name of the structure or enum that the reason refers to.
    parent: String,
    /// Position in the text; `None` until the value is known.
    pub(super) at: Option<usize>,
    /// Indices of children that lead to the value, innermost first.
    steps: Vec<usize>,
}

#[derive(Debug)]
enum Reason {
    UnknownKey(String, &'static [&'static str]),
    UnknownChoice(String, &'static [&'static str]),
    Missing(&'static str),
    Duplicate(&'static str),
    Message(String),
}

impl From<Reason> for DeserializeError {
    fn from(reason: Reason) -> Self {
        Self {
            reason,
            parent: String::new(),
            at: None,
            steps: Vec::new(),
        }
    }
}

impl DeserializeError {
    fn new(at: usize, message: impl Into<String>) -> Self {
        let unplaced = Self::from(Reason::Message(message.into()));
        let at = Some(at);
        Self { at, ..unplaced }
    }

    /// Indices of children that lead to the value, outermost first.
    pub(super) fn indices(&self) -> Vec<usize> {
        self.steps.iter().rev().copied().collect()
    }

    pub(super) fn suggestion(&self) -> Option<String> {
        match &self.reason {
            Reason::UnknownKey(found, known) | Reason::UnknownChoice(found, known) => {
                suggestion(found, known)
            }
            _ => None,
        }
    }

    pub(super) fn missing(&self) -> Option<&'static str> {
        match self.reason {
            Reason::Missing(key) => Some(key),
            _ => None,
        }
    }

    /// Returns `true` if the text has the same meaning without the value.
    pub(super) fn is_needless(&self) -> bool {
        matches!(self.reason, Reason::UnknownKey(..) | Reason::Duplicate(_))
    }

    /// Returns `true` if the message includes its key.
    pub(super) fn is_complete(&self) -> bool {
        !matches!(self.reason, Reason::Message(_))
    }

    /// Extends the path of an error by the parent `node`, whose child `step` contains it.
    fn under(mut self, step: usize, node: &SceneValue) -> Self {
        self.steps.push(step);
        self.at.get_or_insert(node.place.value.start);
        self
    }

    /// Sets structure and position of an error about the key of child `index` or a missing key.
    fn in_structure(mut self, name: &str, node: &SceneValue, index: usize) -> Self {
        if !self.parent.is_empty() || matches!(self.reason, Reason::UnknownChoice(..)) {
            return self;
        }
        name.clone_into(&mut self.parent);
        if self.is_needless() {
            let child = &node.children()[index];
            self.at = Some(child.place.start);
            return self.under(index, child);
        }
        if self.missing().is_some() {
            self.at = Some(node.place.close.unwrap_or(node.place.value.end));
        }
        self
    }

    /// Sets enum and position of an error about an unknown choice.
    fn in_choice(mut self, kind: &str, node: &SceneValue) -> Self {
        if self.parent.is_empty() && matches!(self.reason, Reason::UnknownChoice(..)) {
            kind.clone_into(&mut self.parent);
            self.at = Some(node.place.value.start);
        }
        self
    }
}

impl fmt::Display for DeserializeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parent = &self.parent;
        match &self.reason {
            Reason::UnknownKey(found, known) => f.write_str(&unknown_key(found, known, parent)),
            Reason::UnknownChoice(found, known) => {
                let known = known.join(", ");
                write!(f, "unknown {parent} {found}: expected one of {known}")
            }
            Reason::Missing(key) => write!(f, "missing key `{key}` in {parent}"),
            Reason::Duplicate(key) => write!(f, "key `{key}` is written twice in {parent}"),
            Reason::Message(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for DeserializeError {}

impl de::Error for DeserializeError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Reason::Message(message.to_string()).into()
    }

    fn invalid_type(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::custom(format!("is {expected}"))
    }

    fn unknown_variant(found: &str, known: &'static [&'static str]) -> Self {
        Reason::UnknownChoice(found.to_owned(), known).into()
    }

    fn missing_field(key: &'static str) -> Self {
        Reason::Missing(key).into()
    }

    fn duplicate_field(key: &'static str) -> Self {
        Reason::Duplicate(key).into()
    }
}

pub(super) fn deserialize<T: DeserializeOwned>(
    node: &SceneValue,
    text: &str,
) -> Result<T, DeserializeError> {
    T::deserialize(Value::new(node, text))
}

#[derive(Clone, Copy)]
struct Value<'de> {
    node: &'de SceneValue,
    text: &'de str,
    /// `true` after the name before the bracket has been read as a choice.
    is_chosen: bool,
}

impl<'de> Value<'de> {
    fn new(node: &'de SceneValue, text: &'de str) -> Self {
        let is_chosen = false;
        Self {
            node,
            text,
            is_chosen,
        }
    }

    fn child(self, index: usize) -> Self {
        Self::new(&self.node.children()[index], self.text)
    }

    fn written(&self) -> Cow<'de, str> {
        match self.node.place.source {
            Source::Ron | Source::Json => self.text[self.node.place.value.clone()].into(),
            Source::Memory | Source::Override(_) => self.node.to_string().into(),
        }
    }

    fn refused(&self, message: impl Into<String>) -> DeserializeError {
        DeserializeError::new(self.node.place.value.start, message)
    }

    /// Error for a value of another kind than expected.
    fn expected(&self, what: &str, remedy: &str) -> DeserializeError {
        if self.node.is_dictionary() {
            return self.refused(format!("{what} is expected, not {}", self.node));
        }
        match self.node.kind {
            Kind::Text(_) if remedy.is_empty() => {
                self.refused(format!("{what} is expected, without quotation marks"))
            }
            _ => self.refused(format!("{what} is expected{remedy}")),
        }
    }

    fn whole<T: TryFrom<i128>>(&self) -> Result<T, DeserializeError> {
        let what = "a whole number";
        match self.node.kind {
            Kind::Whole(value) => {
                T::try_from(value).map_err(|_| self.expected(what, ", from 0 to 2^64 - 1"))
            }
            Kind::Number(_) => {
                let refusal = self.expected(what, "");
                let fraction = match self.node.place.source {
                    Source::Ron => self.written().find(['.', 'e', 'E']).unwrap_or_default(),
                    _ => 0,
                };
                let at = refusal.at.map(|at| at + fraction);
                Err(DeserializeError { at, ..refusal })
            }
            _ => Err(self.expected(what, "")),
        }
    }

    fn number(&self) -> Result<f64, DeserializeError> {
        match self.node.kind {
            Kind::Whole(value) => Ok(value as f64),
            Kind::Number(value) => Ok(value),
            _ => Err(self.expected("a number", "")),
        }
    }

    /// Error for a value that is not in round brackets after `name`, which may be empty.
    fn unbracketed(&self, name: &str) -> DeserializeError {
        let node = self.node;
        match &node.kind {
            _ if node.is_dictionary() && name.is_empty() => self.expected("a list", ""),
            _ if node.is_dictionary() => self.refused(format!("{name} is a dictionary of keys")),
            Kind::Name(found) if name.is_empty() || found == name => DeserializeError::new(
                node.place.value.end,
                format!("{found} requires round brackets: write {found}()"),
            ),
            Kind::Name(found) => self.refused(format!("{name} is expected, not {found}")),
            Kind::Bool(found) if !name.is_empty() => {
                self.refused(format!("{name}(...) is expected, not {found}"))
            }
            _ => self
                .refused("a ( is expected: structures and vectors are written in round brackets"),
        }
    }

    /// Reads a structure, whose keys must be `known`.
    fn keys<V: Visitor<'de>>(
        self,
        name: &str,
        known: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        let mut children = Children::new(self, known);
        let value = visitor.visit_map(&mut children);
        value.map_err(|refusal| refusal.in_structure(name, self.node, children.next.max(1) - 1))
    }

    fn list<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        visitor.visit_seq(&mut Children::new(self, &[]))
    }

    fn unkeyed(&self) -> DeserializeError {
        let place = &self.node.place;
        match &self.node.kind {
            Kind::Name(name) if name.starts_with(|c: char| c.is_lowercase() || c == '_') => {
                DeserializeError::new(place.value.end, "a colon is expected between key and value")
            }
            Kind::Number(_) | Kind::Whole(_) => self.refused(format!(
                "a key is expected, not {}; decimals are written with a point",
                self.written()
            )),
            _ => self.expected("a name", ""),
        }
    }
}

impl<'de> Deserializer<'de> for Value<'de> {
    type Error = DeserializeError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        let node = self.node;
        match &node.kind {
            Kind::None | Kind::Invalid | Kind::Removed => visitor.visit_unit(),
            Kind::Bool(value) => visitor.visit_bool(*value),
            Kind::Whole(_) => visitor.visit_i64(self.whole()?),
            Kind::Number(value) => visitor.visit_f64(*value),
            Kind::Text(text) | Kind::Name(text) => visitor.visit_borrowed_str(text),
            Kind::List(_) => self.list(visitor),
            Kind::Group(..) => visitor.visit_enum(Choice {
                value: self,
                default: "",
            }),
        }
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        match self.node.kind {
            Kind::Bool(value) => visitor.visit_bool(value),
            _ => Err(self.expected("true or false", "")),
        }
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        visitor.visit_i64(self.whole()?)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        visitor.visit_u64(self.whole()?)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        visitor.visit_f64(self.number()?)
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        match &self.node.kind {
            Kind::Text(text) => visitor.visit_borrowed_str(text),
            _ => Err(self.expected("text", ", in quotation marks")),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        match self.node.kind {
            Kind::None => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        if name == AS_WRITTEN {
            let written = self.written().trim().to_owned();
            let written: StringDeserializer<DeserializeError> = written.into_deserializer();
            return visitor.visit_newtype_struct(written);
        }
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeserializeError> {
        match self.node.kind {
            Kind::List(_) => self.list(visitor),
            _ => Err(self.expected("a list", ", in square brackets")),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        count: usize,
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        let node = self.node;
        match &node.kind {
            Kind::List(_) if node.is_dictionary() => {}
            Kind::Group(None, _) => {}
            _ => return Err(self.unbracketed("")),
        }
        let values = node.children();
        if values.len() == count {
            return self.list(visitor);
        }
        let checked = (0..values.len()).try_for_each(|i| match values[i].kind {
            Kind::Invalid => Err(self.child(i).expected("a number", "").under(i, &values[i])),
            _ => Ok(()),
        });
        checked?;
        let place = &node.place;
        let at = values.get(count).map(|extra| extra.place.start);
        let at = at.or(place.close).unwrap_or(place.value.start);
        let found = values.len();
        let message = format!("{count} numbers are expected, not {found}");
        Err(DeserializeError::new(at, message))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        match &self.node.kind {
            Kind::Group(Some(found), _) if !self.is_chosen && found != name => {
                Err(self.refused(format!("{name} is expected, not {found}")))
            }
            Kind::Group(..) => self.keys(name, fields, visitor),
            _ if self.is_chosen => self.keys(name, fields, visitor),
            _ => Err(self.unbracketed(name)),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        kind: &'static str,
        choices: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        let node = self.node;
        match &node.kind {
            Kind::Name(_) | Kind::Group(Some(_), _) => {}
            Kind::Text(_) if node.is_dictionary() => {}
            Kind::Group(None, _) if kind == UNNAMED => {}
            _ if node.is_dictionary() => {
                let (first, known) = (choices.first().unwrap_or(&""), choices.join(", "));
                return Err(self.refused(format!(
                    "{kind} is a name, or a name with its keys as in {{\"{first}\": {{}}}}: expected one of {known}"
                )));
            }
            _ if kind == UNNAMED => {
                let known = choices.join("(..) or ");
                return Err(self.expected(&format!("{known}(..)"), ""));
            }
            _ => return Err(self.expected("a name", "")),
        }
        let value = visitor.visit_enum(Choice {
            value: self,
            default: kind,
        });
        value.map_err(|refusal| refusal.in_choice(kind, node))
    }

    serde::forward_to_deserialize_any! {
        i8 i16 i32 i128 u8 u16 u32 u128 f32 char bytes byte_buf unit unit_struct tuple_struct map identifier ignored_any
    }
}

struct Children<'de> {
    value: Value<'de>,
    next: usize,
    /// Keys of a structure.
    known: &'static [&'static str],
}

impl<'de> Children<'de> {
    fn new(value: Value<'de>, known: &'static [&'static str]) -> Self {
        let next = 0;
        Self { value, next, known }
    }

    /// Returns the next value that has not been refused.
    fn next(&mut self) -> Option<Value<'de>> {
        let all = self.value.node.children();
        while matches!(all.get(self.next)?.kind, Kind::Removed) {
            self.next += 1;
        }
        self.next += 1;
        Some(self.value.child(self.next - 1))
    }
}

impl<'de> SeqAccess<'de> for &mut Children<'de> {
    type Error = DeserializeError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, DeserializeError> {
        let Some(value) = self.next() else {
            return Ok(None);
        };
        let index = self.next - 1;
        let read = seed.deserialize(value);
        read.map(Some)
            .map_err(|refusal| refusal.under(index, value.node))
    }
}

impl<'de> MapAccess<'de> for &mut Children<'de> {
    type Error = DeserializeError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, DeserializeError> {
        let Some(value) = self.next() else {
            return Ok(None);
        };
        let Some(key) = &value.node.key else {
            return Err(value.unkeyed().under(self.next - 1, value.node));
        };
        if !self.known.contains(&key.as_str()) {
            return Err(Reason::UnknownKey(key.clone(), self.known).into());
        }
        let key: StrDeserializer<'_, DeserializeError> = key.as_str().into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<T::Value, DeserializeError> {
        let index = self.next - 1;
        let value = self.value.child(index);
        let read = seed.deserialize(value);
        read.map_err(|refusal| refusal.under(index, value.node))
    }
}

struct Choice<'de> {
    value: Value<'de>,
    default: &'static str,
}

impl<'de> Choice<'de> {
    fn name(&self) -> &'de str {
        match &self.value.node.kind {
            Kind::Name(name) | Kind::Text(name) | Kind::Group(Some(name), _) => name,
            _ => self.default,
        }
    }

    /// Keys of the choice; a name alone has none, so that all keys have their defaults.
    fn inner(&self) -> Value<'de> {
        Value {
            is_chosen: true,
            ..self.value
        }
    }
}

impl<'de> EnumAccess<'de> for Choice<'de> {
    type Error = DeserializeError;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(
        self,
        seed: V,
    ) -> Result<(V::Value, Self), DeserializeError> {
        let name: StrDeserializer<'_, DeserializeError> = self.name().into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Choice<'de> {
    type Error = DeserializeError;

    fn unit_variant(self) -> Result<(), DeserializeError> {
        let (node, name) = (self.value.node, self.name());
        match node.kind {
            Kind::Group(..) if node.is_dictionary() => Err(self
                .value
                .refused(format!("{name} has no keys: write \"{name}\""))),
            Kind::Group(..) => {
                let at = node.place.open.unwrap_or(node.place.value.start);
                let message = format!("{name} has no keys: write it without brackets");
                Err(DeserializeError::new(at, message))
            }
            _ => Ok(()),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(
        self,
        seed: T,
    ) -> Result<T::Value, DeserializeError> {
        seed.deserialize(self.inner())
    }

    fn tuple_variant<V: Visitor<'de>>(
        self,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        self.inner().list(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeserializeError> {
        self.inner().keys(self.name(), fields, visitor)
    }
}
