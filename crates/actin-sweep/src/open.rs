//! Validation of a sweep with its scene, and its cost.

use crate::design::Run;
use crate::sweep::{Axis, Samples};
use crate::{Design, Sweep, SweepError, chosen, rules};
use actin_sim::{
    Override, ParseReport, Plan, Scene, SceneError, SceneProblem, SceneText, Summary, Timing,
    read_all,
};
use std::collections::BTreeSet;
use std::path::Path;

/// A valid sweep with its scene.
#[derive(Clone, Debug)]
pub struct ValidatedSweep {
    /// Sweep.
    pub sweep: Sweep,
    /// Points and runs.
    pub design: Design,
    /// Text of the scene file.
    pub(crate) scene: String,
    /// Text of the scene with the values that all runs set.
    base: SceneText,
}

/// Estimated cost of a sweep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepCost {
    /// Index of the timed point, the one with the most evaluations of bonds and elements.
    pub timed: Option<usize>,
    /// Measured time of its first run on one core of this machine; `None` if not measured.
    pub timing: Option<Timing>,
    /// Largest memory of a run (bytes).
    pub bytes: f64,
    /// Points with invalid scenes, and the reasons.
    pub refused: Vec<(usize, String)>,
    /// Number of points that were built.
    pub points: usize,
}

impl SweepCost {
    /// Returns the estimated time of the timed run (s).
    pub fn run_s(&self) -> Option<f64> {
        self.timing?.total_s
    }
}

impl ValidatedSweep {
    /// Reads a sweep and its scene from files.
    ///
    /// # Errors
    /// If a file cannot be read, or contains mistakes.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, SweepError> {
        let path = path.as_ref();
        let text = read(path)?;
        let refused = |mistakes| SweepError::refused(path, &text, mistakes);
        let ParseReport {
            value,
            mut mistakes,
        } = read_all::<Sweep>(&text, "Sweep");
        let at = |problem: &SceneProblem| SceneError::locate(problem, &text);
        let sweep = match value {
            Some(sweep) if mistakes.is_empty() => sweep,
            known => {
                let problems = known.iter().flat_map(rules::problems);
                mistakes.extend(problems.map(|problem| at(&problem)));
                return Err(refused(mistakes));
            }
        };
        let scene_path = path.parent().unwrap_or(Path::new("")).join(&sweep.scene);
        let mut scene = SceneText::new(&read(&scene_path)?);
        // Mistakes of the scene itself are reported with its own file.
        let folder = scene_path.parent().unwrap_or(Path::new(""));
        let points = scene.resolve_paths(folder);
        let in_scene = |mistakes| SweepError::refused(&scene_path, scene.written(), mistakes);
        points.map_err(|error| in_scene(vec![error]))?;
        if let Err(error) = scene.read() {
            let mut all = scene.mistakes();
            if all.is_empty() {
                all.push(error);
            }
            return Err(in_scene(all));
        }
        let opened = Self::with(sweep, scene.text());
        opened.map_err(|problems| refused(problems.iter().map(at).collect()))
    }

    /// Validates a sweep with the text of its scene.
    ///
    /// # Errors
    /// The first violated rule: an invalid number of the sweep, a key or value that the scene does not accept, an
    /// unknown result, or samples of a scene without random parts. Points with scenes that violate other rules fail
    /// when run.
    pub fn new(sweep: Sweep, scene: String) -> Result<Self, SceneProblem> {
        Self::with(sweep, scene).map_err(|problems| problems[0].clone())
    }

    fn with(sweep: Sweep, scene: String) -> Result<Self, Vec<SceneProblem>> {
        let all = |problems: Vec<SceneProblem>| {
            if problems.is_empty() {
                Ok(())
            } else {
                Err(problems)
            }
        };
        all(rules::problems(&sweep))?;
        let mut base = SceneText::new(&scene);
        let values = sweep.set.iter().enumerate();
        let set_all = values.map(|(i, value)| {
            let key = format!("set[{i}].value");
            set(&mut base, &value.key, &value.value.0, &key)
        });
        all(set_all.filter_map(Result::err).collect())?;
        let design = Design::new(&sweep);
        let opened = Self {
            sweep,
            design,
            scene,
            base,
        };
        let mut problems = opened.problems_of_values();
        problems.extend(opened.check_samples().err());
        problems.extend(opened.replaced_seeds());
        problems.extend(opened.problems_of_results());
        all(problems).map(|()| opened)
    }

    fn text(&self, point: usize) -> Result<SceneText, SceneError> {
        let mut text = self.base.clone();
        for one in self.design.overrides(point) {
            text.set(one)?;
        }
        Ok(text)
    }

    /// Returns the scene of a run and its text, which locates problems.
    ///
    /// # Errors
    /// If the scene is invalid.
    pub(crate) fn scene_of(&self, run: Run) -> Result<(Scene, SceneText), SceneError> {
        let text = self.text(run.point)?;
        let mut scene = text.scene()?;
        if let (Some(seed), Some(samples)) = (run.seed, &self.sweep.samples) {
            for &what in &samples.of {
                scene.reseed(what, seed);
            }
        }
        Ok((scene, text))
    }

    fn problems_of_values(&self) -> Vec<SceneProblem> {
        let mut first = 0;
        let axes = self.sweep.vary.iter().enumerate();
        axes.filter_map(|(i, axis)| {
            let before = first;
            first += axis.keys().len();
            self.check_axis((i, axis), before).err()
        })
        .collect()
    }

    /// Checks the values of an axis; `first` is the number of keys of the axes before it.
    fn check_axis(&self, (i, axis): (usize, &Axis), first: usize) -> Result<(), SceneProblem> {
        let keys = axis.keys();
        let mut text = self.base.clone();
        let before = self.design.overrides(0).take(first);
        before.for_each(|one| drop(text.set(one)));
        let mut seen = BTreeSet::new();
        for (k, row) in axis.rows().iter().enumerate() {
            if !seen.insert(row.iter().map(|value| kind(value)).collect::<Vec<_>>()) {
                continue;
            }
            let mut text = text.clone();
            for (j, (key, value)) in keys.iter().zip(row).enumerate() {
                set(&mut text, key, value, &place(i, axis, k, j))?;
            }
        }
        Ok(())
    }

    fn example(&self) -> Option<Scene> {
        let points = 0..self.design.points.len();
        points
            .into_iter()
            .find_map(|point| self.text(point).ok()?.scene().ok())
    }

    fn check_samples(&self) -> Result<(), SceneProblem> {
        let (Some(samples), Some(mut scene)) = (&self.sweep.samples, self.example()) else {
            return Ok(());
        };
        let drawn: usize = samples.of.iter().map(|&what| scene.reseed(what, 1)).sum();
        if drawn > 0 || samples.number == 1 {
            return Ok(());
        }
        let rule = "the scene has nothing random (sampled bonds, thermal noise, imperfections, linker events), so that all \
                    samples would be identical: remove samples";
        Err(SceneProblem::new("samples", "", rule))
    }

    /// Returns keys of seeds that the samples replace.
    fn replaced_seeds(&self) -> Vec<SceneProblem> {
        let Some(samples) = &self.sweep.samples else {
            return Vec::new();
        };
        let fixed = self.sweep.set.iter().enumerate();
        let fixed = fixed.map(|(i, one)| (format!("set[{i}]"), one.key.as_str()));
        let axes = self.sweep.vary.iter().enumerate();
        let varied = axes.flat_map(|(i, axis)| {
            let keys = axis.keys().into_iter();
            keys.map(move |key| (format!("vary[{i}]"), key))
        });
        let seeds = fixed.chain(varied).filter(|(_, key)| key.ends_with("seed"));
        let rule = "has no effect, because the samples set this seed: remove the key, or its part from samples.of";
        seeds
            .filter(|(_, key)| self.is_replaced(samples, key))
            .map(|(place, key)| SceneProblem::new(place, key, rule))
            .collect()
    }

    fn is_replaced(&self, samples: &Samples, key: &str) -> bool {
        let sampled = |value: &str| {
            let mut text = self.base.clone();
            set(&mut text, key, value, key).ok()?;
            let mut scene = text.scene().ok()?;
            for &what in &samples.of {
                scene.reseed(what, 0);
            }
            Some(scene)
        };
        sampled("1").is_some_and(|one| sampled("2") == Some(one))
    }

    /// Returns results that do not occur in the summary of the first valid point.
    fn problems_of_results(&self) -> Vec<SceneProblem> {
        let assembly = self.example().map(|scene| actin_sim::build(&scene));
        let Some(Ok(assembly)) = assembly else {
            return Vec::new();
        };
        let summary = serde_json::to_value(Summary::as_built(&assembly));
        let summary = summary.expect("a summary can be converted to JSON");
        let names = self.sweep.results.iter().enumerate();
        names
            .filter_map(|(i, name)| {
                let why = chosen::refusal(&summary, name)?;
                Some(SceneProblem::new(format!("results[{i}]"), name, why))
            })
            .collect()
    }

    /// Estimates the cost: builds the first run of at most `most` points, and times the largest of them.
    ///
    /// A larger design is sampled, with one point from each of `most` equal parts, including the first and the last
    /// point.
    pub fn estimate_cost(&self, most: usize) -> SweepCost {
        let mut all = SweepCost::default();
        let points = self.design.sample_points(most);
        all.points = points.len();
        let mut most_work = 0.0;
        for point in points {
            match self.with_plan(point, |plan: &Plan<'_>| plan.cost()) {
                Err(why) => all.refused.push((point, why)),
                Ok(cost) => {
                    all.bytes = all.bytes.max(cost.bytes);
                    let each = (cost.bonds + cost.elements) as f64;
                    let work = each * cost.evaluations.unwrap_or(1) as f64;
                    if all.timed.is_none() || work > most_work {
                        (all.timed, most_work) = (Some(point), work);
                    }
                }
            }
        }
        let timing = |point| {
            self.with_plan(point, |plan: &Plan<'_>| plan.timing())
                .ok()
                .flatten()
        };
        all.timing = all.timed.and_then(timing);
        all
    }

    /// Evaluates a function of the plan of the first run of a point.
    fn with_plan<T>(&self, point: usize, of: impl Fn(&Plan<'_>) -> T) -> Result<T, String> {
        let run = self.design.run(point * self.design.runs_of_point());
        let (scene, text) = self.scene_of(run).map_err(|error| error.to_string())?;
        let in_words = |problem: SceneProblem| text.locate(&problem).to_string();
        let assembly = actin_sim::build(&scene).map_err(in_words)?;
        Ok(of(&Plan::new(&assembly).map_err(in_words)?))
    }
}

/// Returns a representative of equivalent values: decimal numbers, and non-negative whole numbers. Any other value
/// represents itself.
fn kind(value: &str) -> &str {
    match (value.parse::<u64>(), value.parse::<f64>()) {
        (Ok(_), _) => "1",
        (_, Ok(number)) if number.is_finite() && value.contains(['.', 'e', 'E']) => "1.0",
        _ => value,
    }
}

fn place(i: usize, axis: &Axis, row: usize, column: usize) -> String {
    match axis {
        Axis::List { .. } => format!("vary[{i}].values[{row}]"),
        Axis::Grid { .. } => format!("vary[{i}].key"),
        Axis::Rows { .. } => format!("vary[{i}].rows[{row}][{column}]"),
        Axis::Random { .. } => format!("vary[{i}].over[{column}]"),
    }
}

/// Sets a key to a value written at `place`, and checks that the key accepts the value.
fn set(text: &mut SceneText, key: &str, value: &str, place: &str) -> Result<(), SceneProblem> {
    let one = Override {
        key: key.to_owned(),
        value: value.to_owned(),
    };
    let outcome = text.set(one).and_then(|()| text.read().map(drop));
    outcome.map_err(|error| SceneProblem::new(place, value, error.to_string()))
}

fn read(path: &Path) -> Result<String, SweepError> {
    let bytes = std::fs::read(path).map_err(SweepError::io(path))?;
    Scene::text(bytes).map_err(|error| SweepError::refused(path, "", vec![error]))
}
