//! The sections of a filament: written one by one, chosen by the program, or following a motion.

use super::rules::{positive, show};
use super::{Following, SceneProblem, Section};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{EnumAccess, Error as _, SeqAccess, Unexpected, VariantAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};

/// The sections of a filament in order of arc length, a list that may be changed like any other.
///
/// With [`adaptive`](Self::adaptive) the list is one rod of the whole length until
/// `Assembly::build` of `actin-sim` has chosen others; with [`following`](Self::following) until a
/// motion has begun.
#[derive(Clone, Debug, Default)]
pub struct Sections {
    list: Vec<Section>,
    left: Option<Left>,
}

/// Sections that are left to the program are the same if they are left to it in the same way.
impl PartialEq for Sections {
    fn eq(&self, other: &Self) -> bool {
        match (&self.left, &other.left) {
            (None, None) => self.list == other.list,
            (one, other) => one == other,
        }
    }
}

/// Sections that the program chooses.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename = "Sections")]
enum Left {
    Adaptive(Adaptive),
    Following(Following),
}

/// Automatic choice of sections before a run, for a wanted accuracy. The program runs every monomer, rods, and windows of
/// monomers at walls, loads and linkers; for a long motion only the beginning. It chooses the resolution with the least
/// work within the wanted errors. For an equilibrium without a limit of monomers the choice is every monomer, since any
/// measured error requires that run. Not available in heat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Adaptive {
    /// Length of the filament; positive. It is rounded to whole monomers.
    pub length_nm: f64,
    /// Wanted quantity with its largest error against every monomer.
    pub want: Want,
    /// Further wanted quantities.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub also: Vec<Want>,
    /// Largest number of resolved monomers; at least 13, a period. If the wanted errors require more, the program chooses
    /// the resolution with the smallest error and warns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub monomers: Option<usize>,
}

impl Adaptive {
    /// Returns all wanted quantities.
    pub fn wants(&self) -> impl Iterator<Item = &Want> + Clone {
        std::iter::once(&self.want).chain(&self.also)
    }
}

/// A number that is wanted of the equilibrium, with its largest relative error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Want {
    /// The displacement of the tip at the end.
    Tip {
        /// Largest error over the displacement; greater than 0, below 1.
        error: f64,
    },
    /// The largest distance from the axis of the filament as built.
    Height {
        /// Largest error over the distance; greater than 0, below 1.
        error: f64,
    },
    /// The force along the filament as built that the clamp at its end bears.
    EndForce {
        /// Largest error over the force; greater than 0, below 1.
        error: f64,
    },
    /// The couple about the filament as built that the clamp at its end bears.
    EndCouple {
        /// Largest error over the couple; greater than 0, below 1.
        error: f64,
    },
    /// The elastic energy of the filament, without that of linkers and loads.
    Energy {
        /// Largest error over the energy; greater than 0, below 1.
        error: f64,
    },
    /// The size of the force of a linker.
    LinkerForce {
        /// Index of the linker in `linkers`, from 0.
        linker: usize,
        /// Largest error over the force; greater than 0, below 1.
        error: f64,
    },
    /// The size of the curvature about a place.
    Curvature {
        /// Where, by arc length; inside the filament, two periods (71.2 nm) or more from clamped ends and junctions.
        at_nm: f64,
        /// Largest error over the curvature; greater than 0, below 1.
        error: f64,
    },
}

/// A number that is wanted of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Quantity {
    /// The displacement of the tip at the end (nm).
    Tip,
    /// The largest distance from the axis of the filament as built (nm).
    Height,
    /// The force along the filament as built that the clamp at its end bears (pN).
    EndForce,
    /// The couple about the filament as built that the clamp at its end bears (pN nm).
    EndCouple,
    /// The elastic energy of the filament (pN nm): of its sections and junctions, without linkers and loads.
    Energy,
    /// The size of the force of a linker (pN).
    LinkerForce {
        /// Index of the linker in `linkers`, from 0.
        linker: usize,
    },
    /// The size of the curvature about a place (rad/nm): the turn of the mean axes of one period of 13 monomers against
    /// those of the period before it, over its length. Near an end these are the outermost two periods.
    Curvature {
        /// Where, by arc length (nm); inside the filament, two periods (71.2 nm) or more from clamped ends and junctions.
        at_nm: f64,
    },
}

impl Quantity {
    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Tip | Self::Height => "nm",
            Self::EndForce | Self::LinkerForce { .. } => "pN",
            Self::EndCouple | Self::Energy => "pN nm",
            Self::Curvature { .. } => "rad/nm",
        }
    }
}

impl Quantity {
    /// A value of it in words.
    pub fn show(self, value: f64) -> String {
        match self {
            Self::Curvature { .. } => format!("{value:.4e} {}", self.unit()),
            _ => format!("{value:.5} {}", self.unit()),
        }
    }
}

/// As a scene writes it.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LinkerForce { linker } => write!(f, "LinkerForce(linker: {linker})"),
            Self::Curvature { at_nm } => write!(f, "Curvature(at_nm: {at_nm:?})"),
            other => write!(f, "{other:?}"),
        }
    }
}

impl Want {
    /// What is wanted.
    pub fn quantity(&self) -> Quantity {
        match *self {
            Self::Tip { .. } => Quantity::Tip,
            Self::Height { .. } => Quantity::Height,
            Self::EndForce { .. } => Quantity::EndForce,
            Self::EndCouple { .. } => Quantity::EndCouple,
            Self::Energy { .. } => Quantity::Energy,
            Self::LinkerForce { linker, .. } => Quantity::LinkerForce { linker },
            Self::Curvature { at_nm, .. } => Quantity::Curvature { at_nm },
        }
    }

    /// Its largest relative error.
    pub fn error(&self) -> f64 {
        match *self {
            Self::Tip { error }
            | Self::Height { error }
            | Self::EndForce { error }
            | Self::EndCouple { error }
            | Self::Energy { error }
            | Self::LinkerForce { error, .. }
            | Self::Curvature { error, .. } => error,
        }
    }
}

/// The least limit of monomers.
const FEWEST_MONOMERS: usize = 13;

/// Checks what the sections of a filament are chosen by.
pub(super) fn check_adaptive(adaptive: &Adaptive) -> Result<(), SceneProblem> {
    positive("filament.sections.length_nm", adaptive.length_nm)?;
    if let Some(few) = adaptive.monomers.filter(|&most| most < FEWEST_MONOMERS) {
        let rule = format!("must be at least {FEWEST_MONOMERS}, a period of the helix");
        return Err(SceneProblem::new("filament.sections.monomers", few, rule));
    }
    let mut errors = adaptive.wants().map(Want::error);
    let Some(error) = errors.find(|error| !(*error > 0.0 && *error < 1.0)) else {
        return Ok(());
    };
    let (key, rule) = (
        "filament.sections.want.error",
        "must be greater than 0 and below 1",
    );
    Err(SceneProblem::new(key, show(error), rule))
}

impl Sections {
    /// What the program is to choose them by; none where they are written.
    pub fn adaptive(&self) -> Option<&Adaptive> {
        match &self.left {
            Some(Left::Adaptive(adaptive)) => Some(adaptive),
            _ => None,
        }
    }

    /// The same list, to follow a motion.
    #[must_use]
    pub fn with_following(self, following: Following) -> Self {
        Self {
            left: Some(Left::Following(following)),
            ..self
        }
    }

    /// How they follow a motion; none where they stay.
    pub fn following(&self) -> Option<&Following> {
        match &self.left {
            Some(Left::Following(following)) => Some(following),
            _ => None,
        }
    }
}

impl From<Vec<Section>> for Sections {
    fn from(list: Vec<Section>) -> Self {
        Self { list, left: None }
    }
}

impl From<Adaptive> for Sections {
    fn from(adaptive: Adaptive) -> Self {
        Self {
            list: vec![Section::rod(0.0, adaptive.length_nm, None)],
            left: Some(Left::Adaptive(adaptive)),
        }
    }
}

impl From<Following> for Sections {
    fn from(following: Following) -> Self {
        Self {
            list: vec![Section::rod(0.0, following.length_nm, None)],
            left: Some(Left::Following(following)),
        }
    }
}

impl Deref for Sections {
    type Target = Vec<Section>;

    fn deref(&self) -> &Vec<Section> {
        &self.list
    }
}

impl DerefMut for Sections {
    fn deref_mut(&mut self) -> &mut Vec<Section> {
        &mut self.list
    }
}

impl<'a> IntoIterator for &'a Sections {
    type Item = &'a Section;
    type IntoIter = std::slice::Iter<'a, Section>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.iter()
    }
}

impl Serialize for Sections {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.left {
            None => self.list.serialize(serializer),
            Some(left) => left.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Sections {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ListOrLeft)
    }
}

struct ListOrLeft;

impl<'de> Visitor<'de> for ListOrLeft {
    type Value = Sections;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of sections, as in [Rod(..)], Adaptive(..) or Following(..)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Sections, A::Error> {
        let list: Vec<Section> = Deserialize::deserialize(SeqAccessDeserializer::new(list))?;
        Ok(list.into())
    }

    fn visit_enum<A: EnumAccess<'de>>(self, left: A) -> Result<Sections, A::Error> {
        let (name, keys): (String, _) = left.variant()?;
        match name.as_str() {
            "Adaptive" => keys.newtype_variant::<Adaptive>().map(Sections::from),
            "Following" => keys.newtype_variant::<Following>().map(Sections::from),
            _ => Err(A::Error::invalid_type(Unexpected::Enum, &self)),
        }
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Sections {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Sections".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let list = generator.subschema_for::<Vec<Section>>();
        let adaptive = generator.subschema_for::<Adaptive>();
        let following = generator.subschema_for::<Following>();
        schemars::json_schema!({
            "oneOf": [
                { "description": "Sections one by one.", "allOf": [list] },
                {
                    "description": "The program chooses them; see there.",
                    "type": "object",
                    "properties": { "Adaptive": adaptive },
                    "required": ["Adaptive"],
                    "additionalProperties": false
                },
                {
                    "description": "They change while a motion goes on; see there.",
                    "type": "object",
                    "properties": { "Following": following },
                    "required": ["Following"],
                    "additionalProperties": false
                }
            ]
        })
    }
}
