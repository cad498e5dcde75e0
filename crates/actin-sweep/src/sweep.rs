//! What a sweep says. What its numbers may be is in `rules.rs`.

use actin_sim::{Drawn, SceneError, read_ron};
use ron::value::RawValue;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A sweep: a scene, what is varied in it, how often each point is sampled, and which results are kept.
///
/// Points are all combinations of what the axes vary, the last of which changes fastest. Each point is run once,
/// or once for each sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// What the sweep shows, in words.
    #[serde(default)]
    pub title: String,
    /// File of the scene, seen from the folder of the sweep.
    pub scene: String,
    /// Numbers of `summary.json` that the table holds, as paths: `tip_displacement_nm[0]`; at least one. Not
    /// `wall_s`, which differs from run to run.
    pub results: Vec<String>,
    /// Values that keys of the scene have in all runs.
    #[serde(default)]
    pub set: Vec<Value>,
    /// What is varied.
    #[serde(default)]
    pub vary: Vec<Axis>,
    /// How often each point is run with other seeds; once as the scene stands by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<Samples>,
}

/// A value for a key of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, rename = "Set")]
pub struct Value {
    /// Path of the key, with indices of lists and vectors in brackets: `loads[0].force_pn[2]`.
    pub key: String,
    /// Its value, as a scene writes it.
    pub value: Ron,
}

/// Something that is varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Axis {
    /// Values of one key.
    List {
        /// Path of the key.
        key: String,
        /// Its values, as a scene writes them; at least one.
        values: Vec<Ron>,
    },
    /// Numbers at equal distances or, with `scale: Logarithmic`, equal ratios.
    Grid {
        /// Path of the key.
        key: String,
        /// First number; finite.
        from: f64,
        /// Last number; finite.
        to: f64,
        /// How many numbers; at least 2.
        number: usize,
        /// Whether differences or ratios are equal.
        #[serde(default)]
        scale: Scale,
    },
    /// Several keys that change together.
    Rows {
        /// Paths of the keys; at least one.
        keys: Vec<String>,
        /// Values of all keys, row by row; at least one row.
        rows: Vec<Vec<Ron>>,
    },
    /// Points drawn at random, the same for the same seed.
    Random {
        /// How many points; at least 1.
        number: usize,
        /// Seed of the draw.
        seed: u64,
        /// How they are drawn.
        #[serde(default)]
        plan: Plan,
        /// Keys and the numbers between which they are drawn; at least one.
        over: Vec<Span>,
    },
}

/// Numbers between which a key is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Span {
    /// Path of the key.
    pub key: String,
    /// Smallest number; finite.
    pub from: f64,
    /// Largest number; finite, greater than `from`.
    pub to: f64,
    /// Whether the number or its logarithm is uniform.
    #[serde(default)]
    pub scale: Scale,
    /// Whether the key takes whole numbers: those drawn are rounded.
    #[serde(default)]
    pub whole: bool,
}

/// How numbers are spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Scale {
    /// By differences.
    #[default]
    Linear,
    /// By ratios; both ends must be positive.
    Logarithmic,
}

/// How random points are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Plan {
    /// Latin hypercube: each key has one point in each of as many equal parts of its span as there are points.
    #[default]
    LatinHypercube,
    /// Every point on its own.
    Independent,
}

/// Runs of one point that differ in their seeds alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Samples {
    /// How many runs of each point; at least 1.
    pub number: usize,
    /// Seed of the first; each other has the next.
    #[serde(default = "one")]
    pub first_seed: u64,
    /// What takes the seed, where the scene draws it: all of it by default.
    #[serde(default = "all")]
    pub of: Vec<Drawn>,
}

fn one() -> u64 {
    1
}

fn all() -> Vec<Drawn> {
    Drawn::ALL.to_vec()
}

/// A value as a scene writes it: a number, a name, a list, a structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ron(pub String);

impl<'de> Deserialize<'de> for Ron {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let raw = Box::<RawValue>::deserialize(deserializer)?;
        Ok(Self(raw.trim().get_ron().to_owned()))
    }
}

impl Serialize for Ron {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let raw = RawValue::from_ron(&self.0).map_err(serde::ser::Error::custom)?;
        raw.serialize(serializer)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Ron {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Ron".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "any value" })
    }
}

impl Sweep {
    /// Reads a sweep. Its rules are checked when it is [opened](crate::Opened::new) with its scene.
    ///
    /// # Errors
    /// Text that is no RON, an unknown or missing key, each with line and column.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        read_ron(text, "Sweep")
    }

    /// The sweep as RON with every default written out.
    ///
    /// # Panics
    /// Never: sweeps hold only what RON can write.
    pub fn to_ron(&self) -> String {
        let config = ron::ser::PrettyConfig::new()
            .struct_names(true)
            .depth_limit(3)
            .compact_arrays(true);
        let options = ron::Options::default()
            .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
            .with_default_extension(ron::extensions::Extensions::UNWRAP_VARIANT_NEWTYPES);
        let text = options.to_string_pretty(self, config);
        text.expect("sweeps hold numbers, texts and lists only, which RON can write") + "\n"
    }
}
