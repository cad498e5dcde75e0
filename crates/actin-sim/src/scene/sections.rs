//! The sections of a filament: written one by one, or left to the program.

use super::rules::{positive, show};
use super::{SceneProblem, Section};
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeStructVariant, Serializer};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::{Deref, DerefMut};

/// The sections of a filament in order of arc length, a list that may be changed like any other.
///
/// With [`adaptive`](Self::adaptive) the list is one rod of the whole length until
/// [`Assembly::build`](crate::Assembly::build) has chosen others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sections {
    list: Vec<Section>,
    adaptive: Option<Adaptive>,
}

/// Sections that the program chooses: a rod, and monomers where the wanted number needs them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Adaptive {
    /// Length of the filament; positive. It is rounded to whole monomers.
    /// Where every parameter of the `rod` is its default, written or not, the rod is under `Homogenised`, and a note says
    /// so.
    pub length_nm: f64,
    /// What is wanted, and how far it may be from the same filament with every monomer resolved.
    pub want: Want,
    /// Most monomers that may be resolved; at least 13, a period. Where what is wanted needs more, the least estimated
    /// error of the resolutions tried counts, and the run says so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub monomers: Option<usize>,
}

/// A number that is wanted of the equilibrium, with its largest relative error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
}

/// A number that is wanted of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
}

impl Quantity {
    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Tip | Self::Height => "nm",
            Self::EndForce | Self::LinkerForce { .. } => "pN",
            Self::EndCouple | Self::Energy => "pN nm",
        }
    }
}

/// As a scene writes it.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LinkerForce { linker } => write!(f, "LinkerForce(linker: {linker})"),
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
            | Self::LinkerForce { error, .. } => error,
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
    let error = adaptive.want.error();
    if error > 0.0 && error < 1.0 {
        return Ok(());
    }
    let (key, rule) = (
        "filament.sections.want.error",
        "must be greater than 0 and below 1",
    );
    Err(SceneProblem::new(key, show(error), rule))
}

impl Sections {
    /// What the program is to choose them by; none where they are written.
    pub fn adaptive(&self) -> Option<&Adaptive> {
        self.adaptive.as_ref()
    }
}

impl From<Vec<Section>> for Sections {
    fn from(list: Vec<Section>) -> Self {
        let adaptive = None;
        Self { list, adaptive }
    }
}

impl From<Adaptive> for Sections {
    fn from(adaptive: Adaptive) -> Self {
        Self {
            list: vec![Section::rod(0.0, adaptive.length_nm, None)],
            adaptive: Some(adaptive),
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
        match &self.adaptive {
            None => self.list.serialize(serializer),
            Some(adaptive) => {
                let count = 2 + usize::from(adaptive.monomers.is_some());
                let mut keys =
                    serializer.serialize_struct_variant("Sections", 0, "Adaptive", count)?;
                keys.serialize_field("length_nm", &adaptive.length_nm)?;
                keys.serialize_field("want", &adaptive.want)?;
                if let Some(most) = adaptive.monomers {
                    keys.serialize_field("monomers", &most)?;
                }
                keys.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for Sections {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ListOrAdaptive)
    }
}

/// Keys of `Adaptive`, as its text has them.
const KEYS: &[&str] = &["length_nm", "want", "monomers"];

struct ListOrAdaptive;

impl<'de> Visitor<'de> for ListOrAdaptive {
    type Value = Sections;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a list of sections, or Adaptive(length_nm: .., want: ..)"
        )
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Sections, A::Error> {
        let mut list = Vec::new();
        while let Some(section) = access.next_element()? {
            list.push(section);
        }
        Ok(list.into())
    }

    /// RON gives the keys of `Adaptive(..)`, a dictionary has them under its name.
    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Sections, A::Error> {
        let (mut length_nm, mut want, mut monomers) = (None, None, None);
        while let Some(key) = access.next_key::<String>()? {
            match key.as_str() {
                "Adaptive" => {
                    let adaptive: Adaptive = access.next_value()?;
                    return match access.next_key::<String>()? {
                        None => Ok(adaptive.into()),
                        Some(other) => Err(de::Error::unknown_field(&other, &["Adaptive"])),
                    };
                }
                "length_nm" => length_nm = Some(access.next_value()?),
                "want" => want = Some(access.next_value()?),
                "monomers" => monomers = Some(access.next_value()?),
                "from_nm" | "to_nm" => {
                    let rule = "is a list of sections, as in [Rod(..)], or Adaptive(..)";
                    return Err(de::Error::custom(rule));
                }
                unknown => return Err(de::Error::unknown_field(unknown, KEYS)),
            }
        }
        let missing = |key| move || de::Error::missing_field(key);
        let length_nm = length_nm.ok_or_else(missing("length_nm"))?;
        let want = want.ok_or_else(missing("want"))?;
        let adaptive = Adaptive {
            length_nm,
            want,
            monomers,
        };
        Ok(adaptive.into())
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
        schemars::json_schema!({
            "oneOf": [
                { "description": "Sections one by one.", "allOf": [list] },
                {
                    "description": "The program chooses them; see there.",
                    "type": "object",
                    "properties": { "Adaptive": adaptive },
                    "required": ["Adaptive"],
                    "additionalProperties": false
                }
            ]
        })
    }
}
