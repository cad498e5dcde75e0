//! Reads types of a scene from a value, with the path of what is refused.

use super::SceneValue;
use crate::outline::Step;
use crate::read::{in_words, meant};
use ron::error::Error as RonError;
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, Error as _, IntoDeserializer, MapAccess,
    SeqAccess, VariantAccess, Visitor,
};
use std::fmt;

/// What is refused, in the terms of RON, and where.
#[derive(Debug)]
pub struct Refusal {
    code: RonError,
    /// Steps from the innermost value outwards.
    steps: Vec<Step>,
}

impl Refusal {
    fn new(code: RonError) -> Self {
        let steps = Vec::new();
        Self { code, steps }
    }

    /// The same seen from outside of a step.
    fn under(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }

    /// The same of a structure or choice of this name, unless it is of something in it.
    fn of(mut self, name: &str) -> Self {
        if let RonError::NoSuchStructField { outer, .. }
        | RonError::MissingStructField { outer, .. }
        | RonError::NoSuchEnumVariant { outer, .. } = &mut self.code
            && outer.is_none()
        {
            *outer = Some(name.to_owned());
        }
        self
    }

    /// What is refused, in the words of a scene, wherever it stands.
    pub(crate) fn rule(&self) -> String {
        let code = &self.code;
        let rule = in_words(code, "scene").unwrap_or_else(|| code.to_string());
        match meant(code) {
            Some(meant) => format!("{rule}; did you mean {meant}?"),
            None => rule,
        }
    }

    /// The path of the key, as in `filament.sections[1].to_nm`.
    pub(super) fn path(&self) -> String {
        let mut path = String::new();
        for step in self.steps.iter().rev() {
            path = match step {
                Step::Key(key) if path.is_empty() => key.clone(),
                Step::Key(key) => format!("{path}.{key}"),
                Step::Index(index) => format!("{path}[{index}]"),
            };
        }
        path
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.code)
    }
}

impl std::error::Error for Refusal {}

impl de::Error for Refusal {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(RonError::custom(message))
    }

    fn unknown_field(found: &str, expected: &'static [&'static str]) -> Self {
        let found = found.to_owned();
        let step = Step::Key(found.clone());
        Self::new(RonError::NoSuchStructField {
            expected,
            found,
            outer: None,
        })
        .under(step)
    }

    fn unknown_variant(found: &str, expected: &'static [&'static str]) -> Self {
        Self::new(RonError::NoSuchEnumVariant {
            expected,
            found: found.to_owned(),
            outer: None,
        })
    }

    fn missing_field(field: &'static str) -> Self {
        Self::new(RonError::MissingStructField { field, outer: None })
    }
}

impl<'de> Deserializer<'de> for &'de SceneValue {
    type Error = Refusal;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
        match self {
            SceneValue::None => visitor.visit_none(),
            SceneValue::Bool(value) => visitor.visit_bool(*value),
            SceneValue::Whole(value) => match (u64::try_from(*value), i64::try_from(*value)) {
                (Ok(value), _) => visitor.visit_u64(value),
                (_, Ok(value)) => visitor.visit_i64(value),
                _ => Err(Refusal::custom("the number is beyond 64 bits")),
            },
            SceneValue::Number(value) => visitor.visit_f64(*value),
            SceneValue::Text(value) => visitor.visit_borrowed_str(value),
            SceneValue::List(values) => list(values, visitor),
            SceneValue::Keys(values) => visitor.visit_map(KeysAccess {
                left: values.iter(),
                value: None,
            }),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
        match self {
            SceneValue::None => visitor.visit_none(),
            value => visitor.visit_some(value),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        let SceneValue::Keys(_) = self else {
            return Err(Refusal::custom(format!("{name} is a dictionary of keys")));
        };
        self.deserialize_any(visitor).map_err(|r| r.of(name))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        let choice = match self {
            SceneValue::Text(choice) => Choice {
                name: choice,
                value: None,
            },
            SceneValue::Keys(one) if one.len() == 1 => Choice {
                name: &one[0].0,
                value: Some(&one[0].1),
            },
            _ => {
                let known = variants.join(", ");
                return Err(Refusal::custom(format!(
                    "{name} is a name, or a name with its keys as in {{\"{}\": {{}}}}: known are {known}",
                    variants.first().unwrap_or(&"")
                )));
            }
        };
        visitor
            .visit_enum(choice)
            .map_err(|refusal| refusal.of(name))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string
        bytes byte_buf unit unit_struct seq tuple tuple_struct map identifier ignored_any
    }
}

/// Reads a list, all of it.
fn list<'de, V: Visitor<'de>>(values: &'de [SceneValue], visitor: V) -> Result<V::Value, Refusal> {
    let mut access = ListAccess { values, taken: 0 };
    let value = visitor.visit_seq(&mut access)?;
    if access.taken < values.len() {
        let (given, needed) = (values.len(), access.taken);
        return Err(Refusal::custom(format!(
            "has {given} elements, must have {needed}"
        )));
    }
    Ok(value)
}

struct ListAccess<'de> {
    values: &'de [SceneValue],
    taken: usize,
}

impl<'de> SeqAccess<'de> for ListAccess<'de> {
    type Error = Refusal;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Refusal> {
        let Some(value) = self.values.get(self.taken) else {
            return Ok(None);
        };
        let step = Step::Index(self.taken);
        self.taken += 1;
        seed.deserialize(value).map(Some).map_err(|r| r.under(step))
    }
}

struct KeysAccess<'de> {
    left: std::slice::Iter<'de, (String, SceneValue)>,
    value: Option<&'de (String, SceneValue)>,
}

impl<'de> MapAccess<'de> for KeysAccess<'de> {
    type Error = Refusal;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Refusal> {
        self.value = self.left.next();
        let Some((key, _)) = self.value else {
            return Ok(None);
        };
        let key: StrDeserializer<'_, Refusal> = key.as_str().into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Refusal> {
        let (key, value) = self.value.expect("a key comes before its value");
        seed.deserialize(value)
            .map_err(|refusal| refusal.under(Step::Key(key.clone())))
    }
}

/// A choice by its name, with what it holds.
struct Choice<'de> {
    name: &'de str,
    value: Option<&'de SceneValue>,
}

impl Choice<'_> {
    /// What is wrong with a choice that has keys and stands without.
    fn bare(&self) -> Refusal {
        let name = self.name;
        Refusal::custom(format!(
            "{name} has keys: write {{\"{name}\": {{}}}} with them"
        ))
    }
}

impl<'de> EnumAccess<'de> for Choice<'de> {
    type Error = Refusal;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Refusal> {
        let name: StrDeserializer<'_, Refusal> = self.name.into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Choice<'de> {
    type Error = Refusal;

    fn unit_variant(self) -> Result<(), Refusal> {
        match self.value {
            None => Ok(()),
            Some(_) => Err(Refusal::custom(format!(
                "{0} has no keys: write \"{0}\"",
                self.name
            ))),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Refusal> {
        seed.deserialize(self.value.ok_or_else(|| self.bare())?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _len: usize, visitor: V) -> Result<V::Value, Refusal> {
        self.value
            .ok_or_else(|| self.bare())?
            .deserialize_any(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        let value = self.value.ok_or_else(|| self.bare())?;
        let SceneValue::Keys(_) = value else {
            return Err(Refusal::custom(format!(
                "{} is a dictionary of keys",
                self.name
            )));
        };
        value.deserialize_any(visitor).map_err(|r| r.of(self.name))
    }
}
