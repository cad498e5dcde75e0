//! Execution of one run of a sweep.

use crate::design::Run;
use crate::summary::summary;
use crate::{Settings, SweepDirectory, SweepError, ValidatedSweep};
use actin_rundir::{
    CheckpointError, Checkpoints, Existing, OpenedRun, RunDirectory, RunDirectoryError,
};
use actin_sim::{Outcome, Plan, RecordsError, RunError, SceneText, Status};
use std::path::Path;
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    /// Finished, successfully or not, with a summary.
    Finished,
    /// Interrupted, with a checkpoint if it had started.
    Interrupted,
}

/// Makes a run, unless it has ended.
///
/// # Errors
/// If results cannot be written, or the directory contains foreign files. Failures of the run are in its summary.
pub(crate) fn make(
    opened: &ValidatedSweep,
    directory: &SweepDirectory,
    run: Run,
    settings: &Settings,
) -> Result<State, SweepError> {
    let path = directory.run(run.index);
    if summary(&path).is_some() {
        return Ok(State::Finished);
    }
    let title = &opened.sweep.title;
    let (scene, text) = match opened.scene_of(run) {
        Ok(found) => found,
        Err(error) => return fail(&path, title, &error.to_string()),
    };
    let refused = |problem: &_| fail(&path, &scene.title, &text.locate(problem).to_string());
    let assembly = match actin_rundir::build(&scene) {
        Ok(assembly) => assembly,
        Err(problem) => return refused(&problem),
    };
    match Plan::new(&assembly) {
        Ok(plan) => make_planned(&path, &plan, &text, settings),
        Err(problem) => refused(&problem),
    }
}

fn make_planned(
    path: &Path,
    plan: &Plan<'_>,
    text: &SceneText,
    settings: &Settings,
) -> Result<State, SweepError> {
    let kept = RunDirectory::existing(path);
    let mut checkpoints = Checkpoints::new(
        &kept,
        plan,
        settings.checkpoint_every,
        Arc::clone(&settings.interrupted),
        settings.warn,
    );
    let opened = open(&kept, plan, &mut checkpoints, settings.warn)?;
    let OpenedRun::Begun { saved, lock: _lock } = opened else {
        return Ok(State::Finished);
    };
    let outcome = match saved {
        None => plan.run_into(&mut checkpoints),
        Some(saved) => plan.resume_into(*saved, &mut checkpoints),
    };
    match outcome {
        Ok(outcome) if outcome.status == Status::Interrupted => Ok(State::Interrupted),
        Ok(outcome) => write(&kept, plan, &checkpoints, &outcome),
        Err(RunError::Refused(problem)) => {
            let why = text.locate(&problem).to_string();
            kept.write_failure(&plan.scene().title, &why)?;
            kept.remove_checkpoint()?;
            Ok(State::Finished)
        }
        Err(RunError::Failed(failed)) => write(&kept, plan, &checkpoints, &failed.outcome),
    }
}

/// Opens the directory of a run. A checkpoint that cannot be read is replaced with a warning.
fn open(
    kept: &RunDirectory,
    plan: &Plan<'_>,
    checkpoints: &mut Checkpoints,
    warn: fn(&CheckpointError),
) -> Result<OpenedRun, RunDirectoryError> {
    if kept.has_checkpoint() {
        match checkpoints.open(plan, Existing::Resume) {
            Err(RunDirectoryError::Checkpoint(error)) => warn(&error),
            opened => return opened,
        }
    }
    checkpoints.open(plan, Existing::Overwrite)
}

/// Writes the results of a run. A non-finite result is a failure of the run.
fn write(
    kept: &RunDirectory,
    plan: &Plan<'_>,
    checkpoints: &Checkpoints,
    outcome: &Outcome,
) -> Result<State, SweepError> {
    match kept.write(plan, checkpoints, outcome) {
        Ok(_) => {}
        Err(RunDirectoryError::Records(RecordsError::Empty)) => {
            kept.write_failure(&plan.scene().title, &outcome.failure)?;
        }
        Err(error @ RunDirectoryError::NotFinite { .. }) => {
            kept.write_failure(&plan.scene().title, &error.to_string())?;
        }
        Err(error) => return Err(error.into()),
    }
    kept.remove_checkpoint()?;
    Ok(State::Finished)
}

fn fail(path: &Path, title: &str, why: &str) -> Result<State, SweepError> {
    let (directory, _lock) = RunDirectory::create_locked(path, true)?;
    directory.write_failure(title, why)?;
    Ok(State::Finished)
}
