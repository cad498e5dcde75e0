//! Input data of a sweep. `rules.rs` validates them.

use actin_sim::{RandomPart, SceneError, read_ron, to_ron};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sweep: a scene, its varied keys, the number of samples, and the tabulated results.
///
/// The points are all combinations of the values of all axes; the last axis changes fastest. Each point is run once,
/// or once for each sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// Title of the sweep.
    #[serde(default)]
    pub title: String,
    /// File of the scene, relative to the folder of the sweep.
    pub scene: String,
    /// Tabulated numbers of `summary.json`, as paths such as `tip_displacement_nm[0]`; at least one. `wall_s` is not
    /// allowed, since run times are not reproducible.
    pub results: Vec<String>,
    /// Values of keys in all runs.
    #[serde(default)]
    pub set: Vec<Value>,
    /// Varied keys.
    #[serde(default)]
    pub vary: Vec<Axis>,
    /// Repeated runs of each point with different seeds. By default each point is run once, with the seeds of the
    /// scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<Samples>,
}

/// A value for a key of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "Set")]
pub struct Value {
    /// Path of the key, with indices of lists and vectors in brackets: `loads[0].force_pn[2]`. The index `*` selects
    /// all elements of a list.
    pub key: String,
    /// Value in RON, as in a scene.
    pub value: Ron,
}

/// Varied keys and their values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Axis {
    /// Values of one key.
    List {
        /// Path of the key.
        key: String,
        /// Values in RON, as in a scene; at least one.
        values: Vec<Ron>,
    },
    /// Numbers at equal differences or, with `scale: Logarithmic`, equal ratios.
    Grid {
        /// Path of the key.
        key: String,
        /// First number; finite.
        from: f64,
        /// Last number; finite.
        to: f64,
        /// Number of values; at least 2.
        number: usize,
        /// Spacing of the values.
        #[serde(default)]
        scale: Scale,
    },
    /// Several keys that are varied together.
    Rows {
        /// Paths of the keys; at least one.
        keys: Vec<String>,
        /// Values of all keys in each row; at least one row.
        rows: Vec<Vec<Ron>>,
    },
    /// Random points, reproducible from the seed.
    Random {
        /// Number of points; at least 1.
        number: usize,
        /// Seed of the random points.
        seed: u64,
        /// Distribution of the points.
        #[serde(default)]
        plan: Plan,
        /// Keys and their ranges; at least one.
        over: Vec<Span>,
    },
}

/// Range of a random key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Span {
    /// Path of the key.
    pub key: String,
    /// Smallest number; finite.
    pub from: f64,
    /// Largest number; finite, greater than `from`.
    pub to: f64,
    /// Scale on which the number is uniformly distributed.
    #[serde(default)]
    pub scale: Scale,
    /// Rounds the values to whole numbers, for keys that require them.
    #[serde(default)]
    pub whole: bool,
}

/// Spacing of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Scale {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios; both ends must be positive.
    Logarithmic,
}

/// Distribution of random points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Plan {
    /// Latin hypercube: each span is divided into as many equal parts as there are points, with one point in each
    /// part.
    #[default]
    LatinHypercube,
    /// Independent, uniform points.
    Independent,
}

/// Repeated runs of each point with different seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Samples {
    /// Number of runs of each point; at least 1.
    pub number: usize,
    /// Seed of the first run; it increases by 1 with each run.
    #[serde(default = "one")]
    pub first_seed: u64,
    /// Seeds of the scene that are set; all by default.
    #[serde(default = "all")]
    pub of: Vec<RandomPart>,
}

fn one() -> u64 {
    1
}

fn all() -> Vec<RandomPart> {
    RandomPart::ALL.to_vec()
}

/// A value in RON: a number, a name, a list, a structure.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename = "$written")]
pub struct Ron(pub String);

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
    /// Reads a sweep from RON. [`ValidatedSweep::new`](crate::ValidatedSweep::new) validates it.
    ///
    /// # Errors
    /// If the text is not RON, or has unknown or missing keys. The error has line and column.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        read_ron(text, "Sweep")
    }

    /// Returns the sweep as RON, with all defaults.
    pub(crate) fn to_ron(&self) -> String {
        to_ron(self, 3) + "\n"
    }
}
