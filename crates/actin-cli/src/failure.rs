//! Failures of the program and their exit codes.

use crate::{SceneArguments, excerpt};
use actin_rundir::{CheckpointError, RunDirectoryError};
use actin_sim::{Assembly, Note, Plan, RandomPart, Scene, SceneError, SceneText};
use std::fmt;
use std::io::Read as _;
use std::path::Path;
use std::process::ExitCode;

#[derive(Debug)]
pub(crate) enum Failure {
    /// The scene, the arguments or the output directory are not usable: exit code 2.
    Input(String),
    /// Numerical failure: exit code 3.
    Numerical(String),
    /// Results or standard output could not be written: exit code 74.
    Unwritten(String),
    /// Interrupted by a signal: exit code 130.
    Interrupted(String),
}

impl Failure {
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Input(_) => ExitCode::from(2),
            Self::Numerical(_) => ExitCode::from(3),
            // `EX_IOERR` of `sysexits.h`.
            Self::Unwritten(_) => ExitCode::from(74),
            // 128 + 2, as a shell reports a program ended by SIGINT (signal 2).
            Self::Interrupted(_) => ExitCode::from(130),
        }
    }
}

impl From<RunDirectoryError> for Failure {
    fn from(error: RunDirectoryError) -> Self {
        match error {
            RunDirectoryError::NotFinite { .. } => Self::Numerical(error.to_string()),
            RunDirectoryError::Export { .. } => Self::Unwritten(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}

impl From<CheckpointError> for Failure {
    fn from(error: CheckpointError) -> Self {
        Self::Input(error.to_string())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(message) | Self::Numerical(message) | Self::Unwritten(message) => {
                write!(f, "error: {message}")
            }
            Self::Interrupted(message) => write!(f, "interrupted: {message}"),
        }
    }
}

pub(crate) struct ParsedScene {
    pub(crate) scene: Scene,
    text: SceneText,
    name: String,
}

impl ParsedScene {
    pub(crate) fn new(source: &SceneArguments) -> Result<Self, Failure> {
        let name = source.scene.display().to_string();
        let bytes = if source.is_standard_input() {
            let mut bytes = Vec::new();
            std::io::stdin().read_to_end(&mut bytes).map(|_| bytes)
        } else {
            std::fs::read(&source.scene)
        };
        let bytes = bytes.map_err(|error| Failure::Input(format!("{name}: {error}")))?;
        let text = Scene::text(bytes).map_err(|error| input(&name, &error))?;
        let mut text = SceneText::new(&text);
        for one in &source.set {
            text.set(one.clone())
                .map_err(|error| input(&name, &error))?;
        }
        // Standard input has no folder: paths are relative to the working directory.
        let beside = source.scene.parent();
        let folder = beside.filter(|_| !source.is_standard_input());
        let read = text.resolve_paths(folder.unwrap_or(Path::new("")));
        read.map_err(|error| Failure::Input(shown(&name, &text, &error)))?;
        let mut scene = text.scene().map_err(|first| all(&name, &text, first))?;
        if let Some(seed) = source.seed {
            let reseeded = RandomPart::ALL.map(|what| scene.reseed(what, seed));
            if reseeded.iter().sum::<usize>() == 0 {
                return Err(Failure::Input(format!(
                    "--seed {seed}: {name} has nothing random (sampled bonds, thermal noise, imperfections, linker events): remove --seed"
                )));
            }
        }
        Ok(Self { scene, text, name })
    }

    pub(crate) fn refuse(&self, problem: &actin_sim::SceneProblem) -> Failure {
        all(&self.name, &self.text, self.text.locate(problem))
    }
}

pub(crate) struct BuiltScene {
    pub(crate) assembly: Assembly,
    pub(crate) text: SceneText,
    name: String,
}

impl BuiltScene {
    pub(crate) fn notes(&self, plan: &Plan<'_>) -> Vec<Note> {
        [self.assembly.notes(), plan.notes()].concat()
    }

    pub(crate) fn open(source: &SceneArguments) -> Result<Self, Failure> {
        let ParsedScene { scene, text, name } = ParsedScene::new(source)?;
        let assembly = actin_rundir::build(&scene)
            .map_err(|problem| all(&name, &text, text.locate(&problem)))?;
        Ok(Self {
            assembly,
            text,
            name,
        })
    }

    pub(crate) fn plan(&self) -> Result<Plan<'_>, Failure> {
        Plan::new(&self.assembly).map_err(|problem| self.refuse(&problem))
    }

    pub(crate) fn refuse(&self, problem: &actin_sim::SceneProblem) -> Failure {
        Failure::Input(self.show(problem))
    }

    pub(crate) fn locate(&self, problem: &actin_sim::SceneProblem) -> String {
        placed(&self.name, &self.text.locate(problem))
    }

    fn show(&self, problem: &actin_sim::SceneProblem) -> String {
        shown(&self.name, &self.text, &self.text.locate(problem))
    }
}

fn input(name: &str, error: &SceneError) -> Failure {
    Failure::Input(placed(name, error))
}

fn all(name: &str, text: &SceneText, first: SceneError) -> Failure {
    let mut mistakes = text.mistakes();
    if mistakes.is_empty() {
        mistakes.push(first);
    }
    listed(name, text, &mistakes)
}

const LISTED: usize = 20;

pub(crate) fn listed(name: &str, text: &SceneText, mistakes: &[SceneError]) -> Failure {
    let listed = mistakes.iter().take(LISTED);
    let listed = listed.map(|mistake| shown(name, text, mistake));
    let mut listed = listed.collect::<Vec<_>>().join("\nerror: ");
    if mistakes.len() >= LISTED {
        let more =
            format!("\nerror: {name} may contain more mistakes; the first {LISTED} are shown");
        listed.push_str(&more);
    }
    Failure::Input(listed)
}

fn shown(name: &str, text: &SceneText, mistake: &SceneError) -> String {
    format!("{}{}", placed(name, mistake), excerpt::of(text, mistake))
}

fn placed(name: &str, error: &SceneError) -> String {
    match error.set {
        None => format!("{name}:{error}"),
        Some(_) => format!("--set {error}"),
    }
}
