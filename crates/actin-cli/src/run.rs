//! `actin run`: runs a scene and writes its run directory.

mod follow;

use crate::failure::{BuiltScene, Failure};
use crate::progress::Progress;
use crate::report::{in_words, print, print_remarks};
use crate::signals;
use crate::{RunArguments, SceneArguments};
use actin_rundir::{
    Checkpoints, Existing, FollowedDirectory, OpenedRun, RunDirectory, RunDirectoryError,
};
use actin_sim::{
    FailedRun, Failure as Broken, Outcome, Plan, Record, RecordSummary, Records, RecordsError,
    RunError, RunPosition, SavedRun, Sink, Start, Status,
};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let opened = BuiltScene::open(&arguments.source)?;
    let plan = opened.plan()?;
    for note in opened.notes(&plan) {
        println!("{note}");
    }
    if opened
        .assembly
        .scene
        .filament
        .sections
        .following()
        .is_some()
    {
        return follow::run(arguments, &opened);
    }
    run_plan(arguments, &opened, &plan)
}

fn run_plan(arguments: &RunArguments, opened: &BuiltScene, plan: &Plan<'_>) -> Result<(), Failure> {
    let out = arguments.out.clone();
    let out = out.unwrap_or_else(|| by_default(&arguments.source));
    let directory = RunDirectory::existing(&out);
    let mut checkpoints = checkpoints(arguments, plan, &directory, signals::interruption()?);
    refuse_own_sources(arguments, plan.scene().start.as_ref(), &out)?;
    if arguments.overwrite && FollowedDirectory::exists_at(&out) {
        // An earlier run with time-dependent resolution.
        FollowedDirectory::new(&out).remove_from(0)?;
    }
    let existing = match (arguments.overwrite, arguments.resume) {
        (_, true) => Existing::Resume,
        (true, false) => Existing::Overwrite,
        (false, false) => Existing::Refuse,
    };
    let opened_run = checkpoints.open(plan, existing);
    // The lock is held until the end of the run.
    let (saved, _lock) = match opened_run.map_err(|error| hint(&out, error))? {
        OpenedRun::Begun { saved, lock } => (saved, lock),
        OpenedRun::Finished(status) => return finished(&out, status),
    };
    let task = Task {
        arguments,
        opened,
        plan,
        directory: &directory,
    };
    let outcome = task.advance(saved.map(|saved| *saved), &mut checkpoints)?;
    if outcome.status == Status::Interrupted {
        return Err(task.interrupted(&checkpoints, &outcome));
    }
    let written = directory.write(plan, &checkpoints, &outcome);
    let removed = written.and_then(|summary| checkpoints.finish(outcome.status).map(|()| summary));
    let summary = removed.map_err(|error| unwritten(arguments, &directory, error))?;
    print(&summary, &opened.notes(plan), &out);
    Ok(())
}

pub(crate) fn by_default(source: &SceneArguments) -> PathBuf {
    let name = match source.scene.file_stem() {
        Some(name) if !source.is_standard_input() => name,
        _ => "stdin".as_ref(),
    };
    Path::new("runs").join(name)
}

/// Refuses to overwrite a directory that contains the scene, or the run from which it starts.
pub(crate) fn refuse_own_sources(
    arguments: &RunArguments,
    start: Option<&Start>,
    out: &Path,
) -> Result<(), Failure> {
    let start = start.map(|Start::Run { directory }| (Path::new(directory), "use another --out"));
    let own = (
        arguments.source.scene.as_path(),
        "move the scene to another folder",
    );
    let directory = RunDirectory::existing(out);
    let mut sources = std::iter::once(own).chain(start);
    let held = sources.find(|(path, _)| arguments.overwrite && directory.holds(path));
    held.map_or(Ok(()), |(path, advice)| {
        let (path, out) = (path.display(), out.display());
        Err(Failure::Input(format!(
            "{path} lies in {out}, which --overwrite would replace: {advice}"
        )))
    })
}

pub(crate) fn checkpoints(
    arguments: &RunArguments,
    plan: &Plan<'_>,
    directory: &RunDirectory,
    interrupted: Arc<AtomicBool>,
) -> Checkpoints {
    Checkpoints::new(
        directory,
        plan,
        arguments.checkpoint_every,
        interrupted,
        |error| eprintln!("warning: no checkpoint: {error}; the run continues"),
    )
}

/// Reports a finished run; a failed one is an error.
fn finished(out: &Path, status: Status) -> Result<(), Failure> {
    let place = out.display();
    if status == Status::Failed {
        let message =
            format!("{place} holds a failed run, which cannot be resumed: use --overwrite");
        return Err(Failure::Numerical(message));
    }
    println!(
        "{place} is finished ({}): nothing to resume",
        in_words(status)
    );
    Ok(())
}

/// Converts an error of the directory. If it holds a checkpoint, the message suggests `--resume`.
fn hint(out: &Path, error: RunDirectoryError) -> Failure {
    let is_resumable = matches!(error, RunDirectoryError::NotEmpty(_))
        && RunDirectory::existing(out).has_checkpoint();
    match Failure::from(error) {
        Failure::Input(message) if is_resumable => {
            Failure::Input(format!("{message}; --resume continues from its checkpoint"))
        }
        failure => failure,
    }
}

fn unwritten(
    arguments: &RunArguments,
    directory: &RunDirectory,
    error: RunDirectoryError,
) -> Failure {
    if let RunDirectoryError::NotFinite { .. } = error {
        return Failure::from(error);
    }
    let message = format!("the run has ended, but its results could not be written: {error}");
    if let RunDirectoryError::Records(RecordsError::Unreadable(_)) = error {
        return Failure::Unwritten(format!("{message}; run it again with --overwrite"));
    }
    Failure::Unwritten(if directory.has_checkpoint() {
        let go_on = go_on(arguments, directory);
        format!(
            "{message}; a checkpoint is kept; once the cause is removed, write them with: {go_on}"
        )
    } else {
        format!("{message}; a checkpoint could not be written either, so they are lost")
    })
}

fn go_on(arguments: &RunArguments, directory: &RunDirectory) -> String {
    let place = directory.path().display();
    if !arguments.source.is_as_written() {
        // The resolved scene in the run directory, which is equivalent.
        return format!("actin run {place}/scene.ron --out {place} --resume");
    }
    let scene = arguments.source.scene.display();
    format!("actin run {scene} --out {place} --resume")
}

pub(crate) struct RunSink<'a> {
    checkpoints: &'a mut Checkpoints,
    progress: Progress,
    started: Instant,
    /// Number of steps at the first update.
    first: Option<u64>,
}

impl<'a> RunSink<'a> {
    pub(crate) fn new(checkpoints: &'a mut Checkpoints) -> Self {
        Self {
            checkpoints,
            progress: Progress::new(),
            started: Instant::now(),
            first: None,
        }
    }

    pub(crate) fn finish(&mut self) {
        self.progress.finish();
    }
}

impl Sink for RunSink<'_> {
    fn record(&mut self, record: &Record) {
        self.checkpoints.record(record);
    }

    fn progress(&mut self, at: &actin_sim::Progress) {
        let made = at.steps - *self.first.get_or_insert(at.steps);
        let seconds = self.started.elapsed().as_secs_f64();
        self.progress.show(at, made as f64 / seconds);
    }

    fn is_interrupted(&mut self) -> bool {
        self.checkpoints.is_interrupted()
    }

    fn is_checkpoint_due(&mut self) -> bool {
        self.checkpoints.is_checkpoint_due()
    }

    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        self.checkpoints.checkpoint(position, recorded, wall_s);
    }
}

struct Task<'a> {
    arguments: &'a RunArguments,
    opened: &'a BuiltScene,
    plan: &'a Plan<'a>,
    directory: &'a RunDirectory,
}

impl Task<'_> {
    fn advance(
        &self,
        saved: Option<SavedRun>,
        checkpoints: &mut Checkpoints,
    ) -> Result<Outcome, Failure> {
        let mut sink = RunSink::new(checkpoints);
        let outcome = match saved {
            None => self.plan.run_into(&mut sink),
            Some(saved) => self.plan.resume_into(saved, &mut sink),
        };
        sink.finish();
        outcome.map_err(|error| match error {
            RunError::Refused(problem) => self.opened.refuse(&problem),
            RunError::Failed(failed) => self.broken(checkpoints, &failed),
        })
    }

    fn interrupted(&self, checkpoints: &Checkpoints, outcome: &Outcome) -> Failure {
        let directory = self.directory;
        let place = directory.path().display();
        let mut message = if !checkpoints.last_failed() {
            format!("a checkpoint is in {place}")
        } else if directory.has_checkpoint() {
            format!("{place} keeps the last checkpoint that could be written")
        } else {
            format!("no checkpoint could be written to {place}")
        };
        if checkpoints.count() > 0 {
            match directory.write(self.plan, checkpoints, outcome) {
                Ok(_) => message += ", with everything recorded so far",
                Err(error) => message = format!("{message}, but {error}"),
            }
        }
        if !directory.has_checkpoint() {
            return Failure::Unwritten(message);
        }
        let go_on = go_on(self.arguments, directory);
        Failure::Interrupted(format!("{message}; to continue: {go_on}"))
    }

    fn broken(&self, checkpoints: &Checkpoints, failed: &FailedRun) -> Failure {
        let (why, kept) = match &failed.failure {
            Broken::LoadBelowResidual(problem) => {
                (self.opened.locate(problem), "the equilibria are")
            }
            Broken::Saddle(problem) => (self.opened.locate(problem), "all results are"),
            failure @ Broken::ModelLimitExceeded(_) => (failure.to_string(), "all results are"),
            failure => (failure.to_string(), GOOD),
        };
        if checkpoints.count() == 0 {
            return Failure::Numerical(why);
        }
        match self
            .directory
            .write(self.plan, checkpoints, &failed.outcome)
        {
            Ok(summary) => {
                print_remarks(&summary, &self.opened.notes(self.plan));
                let place = self.directory.path().display();
                Failure::Numerical(format!("{why}; {kept} in {place}"))
            }
            Err(unwritten) => Failure::Numerical(format!("{why}; and {unwritten}")),
        }
    }
}

const GOOD: &str = "everything up to the last good state is";
