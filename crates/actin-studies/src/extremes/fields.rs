//! Invalid and extreme numbers in every field of a scene: NaN, infinities, overflow, subnormal numbers, zero and -1.

use super::row::{CaseResult, Expected, Outcome, Row};
use super::scenes::build;
use actin_sim::{Plan, RunError, Scene, SceneError, Trajectory};
use std::ops::Range;

/// Numbers that are not finite, overflow or are subnormal.
const INVALID: [&str; 7] = ["NaN", "inf", "-inf", "1e400", "1e308", "-1e308", "1e-310"];
const EXTREME: [&str; 5] = ["1e59", "-1e59", "1e-59", "0", "-1"];

const MOTION: &str = include_str!("motion.ron");

const LAWS: [&str; 2] = [
    include_str!("laws-tanh.ron"),
    include_str!("laws-sided.ron"),
];

/// Returns scenes with all numeric keys, including defaults: the motion, its equilibrium, and the laws.
fn scenes() -> Vec<String> {
    let (scene, _) = MOTION.split_once("task:").expect("the scene has a task");
    let scene = scene.replace("duration_ns: 0.02,", "");
    let statics = format!("{scene}task: Equilibrium(iterations: 50))");
    let written = |text: &str| {
        let scene = Scene::from_ron(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        scene.to_ron()
    };
    let all = [MOTION, &statics, LAWS[0], LAWS[1]];
    all.map(written).to_vec()
}

struct Trial {
    key: String,
    value: &'static str,
    text: String,
    outcome: Result<Outcome, SceneError>,
}

fn trials(text: &str, value: &'static str) -> Vec<Trial> {
    let trial = |number: Number| {
        let text = with_number(text, &number, value);
        Trial {
            key: number.key,
            value,
            outcome: run_short(&text),
            text,
        }
    };
    numbers(text).into_iter().map(trial).collect()
}

impl Trial {
    /// Results are finite, and errors have a position in the text. Values of [`INVALID`] are
    /// refused with their key, except as unbounded ranges of laws.
    fn is_sound(&self) -> bool {
        let (key, value) = (self.key.as_str(), self.value);
        let is_invalid = INVALID.contains(&value);
        match &self.outcome {
            Err(error) => self.text.lines().nth(error.line - 1).is_some_and(|line| {
                // For whole numbers, the RON parser reports the expected type at the number.
                let is_named = error.message.contains(key) || line.contains(value);
                error.column <= line.chars().count() + 1 && (is_named || !is_invalid)
            }),
            Ok(Outcome::Wrong(_)) => false,
            Ok(_) => !is_invalid || key == "range_per_nm" && ["inf", "1e400"].contains(&value),
        }
    }
}

pub(super) fn rows() -> Vec<Row> {
    let scenes = scenes();
    let row = |value| {
        let all: Vec<Trial> = scenes.iter().flat_map(|text| trials(text, value)).collect();
        let case = format!("{value} in each of {} numbers", all.len());
        Row::new("field", case, counted(&all)).expecting(Expected::Refused)
    };
    INVALID.into_iter().chain(EXTREME).map(row).collect()
}

fn counted(trials: &[Trial]) -> CaseResult {
    if let Some(trial) = trials.iter().find(|trial| !trial.is_sound()) {
        return Err(Outcome::Wrong(format!(
            "{} = {}: {:?}",
            trial.key, trial.value, trial.outcome
        )));
    }
    let count = |is: fn(&Trial) -> bool| trials.iter().filter(|&trial| is(trial)).count();
    let refused = count(|trial| trial.outcome.is_err());
    let broke = count(|trial| matches!(trial.outcome, Ok(Outcome::Fails(_))));
    Ok(Outcome::Refused(format!(
        "{refused} with line and column; {broke} broke with a message; {} ran to finite results or \
         would take long",
        trials.len() - refused - broke
    )))
}

const MOST_STEPS: u64 = 2_000;

/// Runs a scene of few steps; longer scenes are only planned.
///
/// # Errors
/// The scene is refused.
pub(super) fn run_short(text: &str) -> Result<Outcome, SceneError> {
    let assembly = build(text)?;
    let refused = |problem| SceneError::locate(&problem, text);
    let plan = Plan::new(&assembly).map_err(refused)?;
    if plan.estimate().is_some_and(|e| e.steps > MOST_STEPS) {
        return Ok(FINITE);
    }
    match plan.run() {
        Ok((trajectory, _)) => Ok(finite(&trajectory)),
        Err(RunError::Refused(problem)) => Err(refused(problem)),
        Err(error) => Ok(Outcome::Fails(error.to_string())),
    }
}

const FINITE: Outcome = Outcome::Correct {
    what: "finite numbers",
    error: 0.0,
};

fn finite(trajectory: &Trajectory) -> Outcome {
    for (i, record) in trajectory.records.iter().enumerate() {
        let energies = record.energies_pn_nm.iter().sum::<f64>() + record.kinetic_pn_nm;
        let residual = record.residual_force_pn + record.residual_torque_pn_nm;
        if !(record.state.is_finite() && energies.is_finite() && residual.is_finite()) {
            return Outcome::Wrong(format!("record {i}: {energies} pN nm, {residual} pN"));
        }
    }
    FINITE
}

struct Number {
    place: Range<usize>,
    key: String,
}

fn numbers(text: &str) -> Vec<Number> {
    let bytes = text.as_bytes();
    let (mut found, mut key, mut i) = (Vec::new(), String::new(), 0);
    while i < bytes.len() {
        let rest = &text[i..];
        let length = match bytes[i] {
            b'/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            b'"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            b'0'..=b'9' | b'-' | b'+' => {
                let length = token(rest, |c| c.is_ascii_alphanumeric() || "+-._".contains(c));
                let place = i..i + length;
                let key = key.clone();
                found.push(Number { place, key });
                length
            }
            c if c.is_ascii_alphabetic() || c == b'_' => {
                let length = token(rest, |c| c.is_ascii_alphanumeric() || c == '_');
                if rest[length..].trim_start().starts_with(':') {
                    rest[..length].clone_into(&mut key);
                }
                length
            }
            c if c < 0x80 => 1,
            _ => rest.chars().next().map_or(1, char::len_utf8),
        };
        i += length.max(1);
    }
    found
}

fn token(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

fn with_number(text: &str, number: &Number, value: &str) -> String {
    let Range { start, end } = number.place;
    format!("{}{value}{}", &text[..start], &text[end..])
}
