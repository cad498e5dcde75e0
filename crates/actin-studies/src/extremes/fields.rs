//! Invalid and extreme numbers in every field of a scene: NaN, infinities, overflow, subnormal numbers, zero and -1.

use super::row::{Expected, Outcome, Row};
use actin_sim::{Plan, RunError, Scene, SceneError, SceneProblem, Trajectory};
use std::ops::Range;

const VALUES: [&str; 12] = [
    "NaN", "inf", "-inf", "1e400", "1e308", "-1e308", "1e-310", "1e59", "-1e59", "1e-59", "0", "-1",
];

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
    number: Number,
    value: &'static str,
    verdict: Verdict,
}

fn trials(text: &str, value: &'static str) -> Vec<Trial> {
    let trial = |number: Number| Trial {
        verdict: verdict(&with_number(text, &number, value)),
        number,
        value,
    };
    numbers(text).into_iter().map(trial).collect()
}

pub(super) fn rows(is_wanted: bool) -> Vec<Row> {
    let values = if is_wanted { &VALUES[..] } else { &[] };
    let scenes = scenes();
    let row = |&value: &&'static str| {
        let all: Vec<Trial> = scenes.iter().flat_map(|text| trials(text, value)).collect();
        let case = format!("{value} in each of {} numbers", all.len());
        Row::new("field", case, Ok(counted(&all))).expecting(Expected::Refused)
    };
    values.iter().map(row).collect()
}

fn counted(trials: &[Trial]) -> Outcome {
    let count = |is: fn(&Verdict) -> bool| trials.iter().filter(|t| is(&t.verdict)).count();
    let not_finite = |trial: &&Trial| matches!(trial.verdict, Verdict::NotFinite(_));
    if let Some(trial) = trials.iter().find(not_finite) {
        return Outcome::Wrong(format!(
            "{} = {}: {:?}",
            trial.number.key, trial.value, trial.verdict
        ));
    }
    let refused = count(|v| matches!(v, Verdict::Refused(_)));
    let broke = count(|v| matches!(v, Verdict::Broke(_)));
    Outcome::Refused(format!(
        "{refused} with line and column; {broke} broke with a message; {} ran to finite results or \
         would take long",
        trials.len() - refused - broke
    ))
}

const MOST_STEPS: u64 = 2_000;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Refused when read, built or estimated, with a position in the text.
    Refused(SceneError),
    Broke(String),
    CompletedRun,
    /// Valid, but too long to be run here.
    Accepted,
    /// Completed with a non-finite number, which is a defect.
    NotFinite(String),
}

pub(super) fn verdict(text: &str) -> Verdict {
    let scene = match Scene::from_ron(text) {
        Ok(scene) => scene,
        Err(error) => return Verdict::Refused(error),
    };
    let refused = |problem: &SceneProblem| Verdict::Refused(SceneError::locate(problem, text));
    let assembly = match actin_sim::build(&scene) {
        Ok(assembly) => assembly,
        Err(problem) => return refused(&problem),
    };
    let plan = match Plan::new(&assembly) {
        Ok(plan) => plan,
        Err(problem) => return refused(&problem),
    };
    if plan.estimate().is_some_and(|e| e.steps > MOST_STEPS) {
        return Verdict::Accepted;
    }
    match plan.run() {
        Ok((trajectory, _)) => finite(&trajectory),
        Err(RunError::Refused(problem)) => refused(&problem),
        Err(error) => Verdict::Broke(error.to_string()),
    }
}

fn finite(trajectory: &Trajectory) -> Verdict {
    for (i, record) in trajectory.records.iter().enumerate() {
        let energies = record.energies_pn_nm.iter().sum::<f64>() + record.kinetic_pn_nm;
        let residual = record.residual_force_pn + record.residual_torque_pn_nm;
        if !(record.state.is_finite() && energies.is_finite() && residual.is_finite()) {
            return Verdict::NotFinite(format!("record {i}: {energies} pN nm, {residual} pN"));
        }
    }
    Verdict::CompletedRun
}

#[derive(Clone, Debug, PartialEq)]
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that are not finite, overflow or are subnormal are refused with key, line and
    /// column. Unbounded ranges of laws may be infinite.
    #[test]
    fn invalid_numbers_are_refused_in_every_field() {
        let refused_anywhere = ["NaN", "inf", "-inf", "1e400", "1e308", "-1e308", "1e-310"];
        for text in scenes() {
            for value in VALUES {
                for trial in trials(&text, value) {
                    let (key, verdict) = (&trial.number.key, &trial.verdict);
                    assert!(
                        !matches!(verdict, Verdict::NotFinite(_)),
                        "{key} = {value}: {verdict:?}"
                    );
                    let unbounded = key == "range_per_nm" && ["inf", "1e400"].contains(&value);
                    let Verdict::Refused(error) = verdict else {
                        assert!(
                            unbounded || !refused_anywhere.contains(&value),
                            "{key} = {value}: {verdict:?}"
                        );
                        continue;
                    };
                    let text = with_number(&text, &trial.number, value);
                    let line = text.lines().nth(error.line - 1).unwrap();
                    assert!(error.column <= line.chars().count() + 1, "{error}");
                    if refused_anywhere.contains(&value) {
                        // For whole numbers, the RON parser reports the expected type at the number.
                        let says = error.message.contains(key.as_str()) || line.contains(value);
                        assert!(says, "{key} = {value}: {error}");
                    }
                }
            }
        }
    }
}
