//! The sections of a filament: written one by one, chosen by the program, or following a motion.

use super::rules::{positive, show};
use super::{Following, SceneProblem, Section, Where};
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeStructVariant, Serializer};
use serde::{Deserialize, Serialize};
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

/// What sections are left to.
#[derive(Clone, Debug, PartialEq)]
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
            Some(Left::Adaptive(adaptive)) => {
                let is_also = !adaptive.also.is_empty();
                let count = 2 + usize::from(is_also) + usize::from(adaptive.monomers.is_some());
                let mut keys =
                    serializer.serialize_struct_variant("Sections", 0, "Adaptive", count)?;
                keys.serialize_field("length_nm", &adaptive.length_nm)?;
                keys.serialize_field("want", &adaptive.want)?;
                if is_also {
                    keys.serialize_field("also", &adaptive.also)?;
                }
                if let Some(most) = adaptive.monomers {
                    keys.serialize_field("monomers", &most)?;
                }
                keys.end()
            }
            Some(Left::Following(following)) => {
                let mut keys =
                    serializer.serialize_struct_variant("Sections", 1, "Following", 5)?;
                keys.serialize_field("length_nm", &following.length_nm)?;
                keys.serialize_field("monomers_where", &following.monomers_where)?;
                keys.serialize_field("cell_nm", &following.cell_nm)?;
                keys.serialize_field("segments", &following.segments)?;
                keys.serialize_field("least_ns", &following.least_ns)?;
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

/// Keys of `Adaptive` and of `Following`, as their texts have them.
const KEYS: &[&str] = &[
    "length_nm",
    "want",
    "also",
    "monomers",
    "monomers_where",
    "cell_nm",
    "segments",
    "least_ns",
];

/// What a text may have of either.
#[derive(Default)]
struct Keys {
    length_nm: Option<f64>,
    want: Option<Want>,
    also: Option<Vec<Want>>,
    monomers: Option<usize>,
    monomers_where: Option<Vec<Where>>,
    cell_nm: Option<f64>,
    segments: Option<usize>,
    least_ns: Option<f64>,
}

impl Keys {
    fn read<'de, A: MapAccess<'de>>(&mut self, key: &str, access: &mut A) -> Result<(), A::Error> {
        match key {
            "length_nm" => self.length_nm = Some(access.next_value()?),
            "want" => self.want = Some(access.next_value()?),
            "also" => self.also = Some(access.next_value()?),
            "monomers" => self.monomers = Some(access.next_value()?),
            "monomers_where" => self.monomers_where = Some(access.next_value()?),
            "cell_nm" => self.cell_nm = Some(access.next_value()?),
            "segments" => self.segments = Some(access.next_value()?),
            "least_ns" => self.least_ns = Some(access.next_value()?),
            "from_nm" | "to_nm" => {
                let rule = "is a list of sections, as in [Rod(..)], Adaptive(..) or Following(..)";
                return Err(de::Error::custom(rule));
            }
            unknown => return Err(de::Error::unknown_field(unknown, KEYS)),
        }
        Ok(())
    }

    fn sections<E: de::Error>(self) -> Result<Sections, E> {
        let missing = |key| move || E::missing_field(key);
        let length_nm = self.length_nm.ok_or_else(missing("length_nm"))?;
        let Some(monomers_where) = self.monomers_where else {
            let is_following =
                self.cell_nm.is_some() || self.segments.is_some() || self.least_ns.is_some();
            if is_following {
                return Err(E::missing_field("monomers_where"));
            }
            let want = self.want.ok_or_else(missing("want"))?;
            return Ok(Adaptive {
                length_nm,
                want,
                also: self.also.unwrap_or_default(),
                monomers: self.monomers,
            }
            .into());
        };
        if self.want.is_some() || self.monomers.is_some() {
            let rule =
                "has `want` or `monomers` of Adaptive(..) and `monomers_where` of Following(..)";
            return Err(E::custom(rule));
        }
        let mut following = Following::new(length_nm, monomers_where);
        following.cell_nm = self.cell_nm.unwrap_or(following.cell_nm);
        following.segments = self.segments.unwrap_or(following.segments);
        following.least_ns = self.least_ns.unwrap_or(following.least_ns);
        Ok(following.into())
    }
}

struct ListOrAdaptive;

impl<'de> Visitor<'de> for ListOrAdaptive {
    type Value = Sections;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a list of sections, Adaptive(length_nm: .., want: ..) or Following(length_nm: .., monomers_where: [..])"
        )
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Sections, A::Error> {
        let mut list = Vec::new();
        while let Some(section) = access.next_element()? {
            list.push(section);
        }
        Ok(list.into())
    }

    /// RON gives the keys of `Adaptive(..)` or `Following(..)`, a dictionary has them under that name.
    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Sections, A::Error> {
        let mut keys = Keys::default();
        while let Some(key) = access.next_key::<String>()? {
            let named: Sections = match key.as_str() {
                "Adaptive" => access.next_value::<Adaptive>()?.into(),
                "Following" => access.next_value::<Following>()?.into(),
                other => {
                    keys.read(other, &mut access)?;
                    continue;
                }
            };
            return match access.next_key::<String>()? {
                None => Ok(named),
                Some(other) => Err(de::Error::unknown_field(&other, &[])),
            };
        }
        keys.sections()
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
