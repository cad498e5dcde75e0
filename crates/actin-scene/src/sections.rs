//! Sections of a filament: listed, chosen by the program, or adapted during a motion.

use super::rules::show;
use super::{AdaptiveResolution, SceneProblem, Section};
use schemars::JsonSchema;
use serde::de::value::SeqAccessDeserializer;
use serde::de::{EnumAccess, Error as _, SeqAccess, Unexpected, VariantAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};

/// Sections of a filament in order of arc length.
///
/// With [`adaptive`](Self::adaptive) the list is one rod until `build` of `actin-sim` chooses
/// sections. With [`following`](Self::following) it is one rod until a motion starts.
#[derive(Clone, Debug, Default)]
pub struct Sections {
    list: Vec<Section>,
    automatic: Option<AutoSections>,
}

impl PartialEq for Sections {
    fn eq(&self, other: &Self) -> bool {
        match (&self.automatic, &other.automatic) {
            (None, None) => self.list == other.list,
            (one, other) => one == other,
        }
    }
}

/// Automatic sections.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename = "Sections")]
enum AutoSections {
    Adaptive(Adaptive),
    Following(AdaptiveResolution),
}

/// Automatic choice of sections before a run, for target accuracies. The program compares monomers, rods, and
/// intervals of monomers at walls, loads and linkers; for a long motion only its beginning. It chooses the
/// resolution with the least work among those within the target errors. For an equilibrium without a limit of
/// monomers the choice is monomers everywhere, since the measured errors require this run. Not available with
/// thermal noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Adaptive {
    /// Length of the filament; positive. It is rounded to a whole number of monomers.
    pub length_nm: f64,
    /// Target quantity, with its largest error relative to a filament of monomers.
    pub want: Target,
    /// Further target quantities.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub also: Vec<Target>,
    /// Largest number of resolved monomers; at least 13, a period of the helix. If the target errors require
    /// more, the program chooses the resolution with the smallest error and warns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub monomers: Option<usize>,
}

impl Adaptive {
    /// Returns all target quantities.
    pub fn targets(&self) -> impl Iterator<Item = &Target> + Clone {
        std::iter::once(&self.want).chain(&self.also)
    }
}

/// Target quantity of the equilibrium, with its largest relative error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Want")]
pub enum Target {
    /// Displacement of the end of the filament.
    Tip {
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
    /// Largest distance from the axis as built.
    Height {
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
    /// Reaction force of the clamp at the end, along the filament as built.
    EndForce {
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
    /// Reaction torque of the clamp at the end, about the filament as built.
    EndCouple {
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
    /// Elastic energy of the filament, without linkers and loads.
    Energy {
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
    /// Magnitude of the force of a linker.
    LinkerForce {
        /// Index of the linker in `linkers`, from 0.
        linker: usize,
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
    /// Magnitude of the curvature near an arc length.
    Curvature {
        /// Arc length inside the filament; at least two periods (71.2 nm) from clamped ends and junctions.
        at_nm: f64,
        /// Largest relative error; greater than 0, below 1.
        error: f64,
    },
}

/// Quantity of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Quantity {
    /// Displacement of the end of the filament (nm).
    Tip,
    /// Largest distance from the axis as built (nm).
    Height,
    /// Reaction force of the clamp at the end, along the filament as built (pN).
    EndForce,
    /// Reaction torque of the clamp at the end, about the filament as built (pN nm).
    EndCouple,
    /// Elastic energy of sections and junctions (pN nm), without linkers and loads.
    Energy,
    /// Magnitude of the force of a linker (pN).
    LinkerForce {
        /// Index of the linker in `linkers`, from 0.
        linker: usize,
    },
    /// Magnitude of the curvature near an arc length (rad/nm): the angle between the mean axes of two
    /// successive periods of 13 monomers, divided by the length of a period. Near an end the outermost two
    /// periods are used.
    Curvature {
        /// Arc length inside the filament; at least two periods (71.2 nm) from clamped ends and junctions.
        at_nm: f64,
    },
}

impl Quantity {
    /// Returns the unit.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Tip | Self::Height => "nm",
            Self::EndForce | Self::LinkerForce { .. } => "pN",
            Self::EndCouple | Self::Energy => "pN nm",
            Self::Curvature { .. } => "rad/nm",
        }
    }

    /// Formats a value with its unit.
    pub fn show(self, value: f64) -> String {
        match self {
            Self::Curvature { .. } => format!("{value:.4e} {}", self.unit()),
            _ => format!("{value:.5} {}", self.unit()),
        }
    }
}

/// Formats the quantity as in a scene.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LinkerForce { linker } => write!(f, "LinkerForce(linker: {linker})"),
            Self::Curvature { at_nm } => write!(f, "Curvature(at_nm: {at_nm:?})"),
            other => write!(f, "{other:?}"),
        }
    }
}

impl Target {
    /// Returns the quantity.
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

    /// Returns the largest relative error.
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

const FEWEST_MONOMERS: usize = 13;

/// Checks automatic sections, whose keys begin with `key`.
pub(super) fn check_adaptive(key: &str, adaptive: &Adaptive) -> Result<(), SceneProblem> {
    if let Some(few) = adaptive.monomers.filter(|&most| most < FEWEST_MONOMERS) {
        let rule = format!("must be at least {FEWEST_MONOMERS}, a period of the helix");
        return Err(SceneProblem::new(format!("{key}.monomers"), few, rule));
    }
    let mut errors = adaptive.targets().map(Target::error);
    let Some(error) = errors.find(|error| !(*error > 0.0 && *error < 1.0)) else {
        return Ok(());
    };
    let rule = "must be greater than 0 and below 1";
    let key = format!("{key}.want.error");
    Err(SceneProblem::new(key, show(error), rule))
}

impl Sections {
    /// Returns the targets of automatic sections, or `None`.
    pub fn adaptive(&self) -> Option<&Adaptive> {
        match &self.automatic {
            Some(AutoSections::Adaptive(adaptive)) => Some(adaptive),
            _ => None,
        }
    }

    /// Returns whether the program chooses the sections.
    pub(crate) fn is_automatic(&self) -> bool {
        self.automatic.is_some()
    }

    /// Makes the sections follow a motion.
    #[must_use]
    pub fn with_following(self, following: AdaptiveResolution) -> Self {
        Self {
            automatic: Some(AutoSections::Following(following)),
            ..self
        }
    }

    /// Returns the parameters of sections that follow a motion, or `None`.
    pub fn following(&self) -> Option<&AdaptiveResolution> {
        match &self.automatic {
            Some(AutoSections::Following(following)) => Some(following),
            _ => None,
        }
    }
}

impl From<Vec<Section>> for Sections {
    fn from(list: Vec<Section>) -> Self {
        Self {
            list,
            automatic: None,
        }
    }
}

impl From<Adaptive> for Sections {
    fn from(adaptive: Adaptive) -> Self {
        Self {
            list: vec![Section::rod(0.0, adaptive.length_nm, None)],
            automatic: Some(AutoSections::Adaptive(adaptive)),
        }
    }
}

impl From<AdaptiveResolution> for Sections {
    fn from(following: AdaptiveResolution) -> Self {
        Self {
            list: vec![Section::rod(0.0, following.length_nm, None)],
            automatic: Some(AutoSections::Following(following)),
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
        match &self.automatic {
            None => self.list.serialize(serializer),
            Some(automatic) => automatic.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Sections {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SectionsVisitor)
    }
}

struct SectionsVisitor;

impl<'de> Visitor<'de> for SectionsVisitor {
    type Value = Sections;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of sections, as in [Rod(..)], Adaptive(..) or Following(..)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Sections, A::Error> {
        let list: Vec<Section> = Deserialize::deserialize(SeqAccessDeserializer::new(list))?;
        Ok(list.into())
    }

    fn visit_enum<A: EnumAccess<'de>>(self, automatic: A) -> Result<Sections, A::Error> {
        let (name, keys): (String, _) = automatic.variant()?;
        match name.as_str() {
            "Adaptive" => keys.newtype_variant::<Adaptive>().map(Sections::from),
            "Following" => keys
                .newtype_variant::<AdaptiveResolution>()
                .map(Sections::from),
            _ => Err(A::Error::invalid_type(Unexpected::Enum, &self)),
        }
    }
}

impl JsonSchema for Sections {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Sections".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let list = generator.subschema_for::<Vec<Section>>();
        let adaptive = generator.subschema_for::<Adaptive>();
        let following = generator.subschema_for::<AdaptiveResolution>();
        schemars::json_schema!({
            "oneOf": [
                { "description": "List of sections.", "allOf": [list] },
                {
                    "description": "Sections chosen by the program.",
                    "type": "object",
                    "properties": { "Adaptive": adaptive },
                    "required": ["Adaptive"],
                    "additionalProperties": false
                },
                {
                    "description": "Sections that follow a motion.",
                    "type": "object",
                    "properties": { "Following": following },
                    "required": ["Following"],
                    "additionalProperties": false
                }
            ]
        })
    }
}
