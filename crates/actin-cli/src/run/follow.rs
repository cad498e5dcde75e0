//! `actin run` with time-dependent resolution: a chain of run directories, one for each stretch.

use super::{RunSink, by_default, checkpoints, refuse_own_sources};
use crate::RunArguments;
use crate::failure::{BuiltScene, Failure};
use crate::report::print;
use crate::signals;
use actin_rundir::{Checkpoints, FollowedDirectory, RunDirectory, RunLock};
use actin_sim::follow::{Follower, Stretch, StretchEnd, StretchStart};
use actin_sim::{Outcome, Plan, RunError, SavedRun, Sink, Status, Summary};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

struct Chain<'a> {
    arguments: &'a RunArguments,
    opened: &'a BuiltScene,
    follower: &'a Follower,
    directory: FollowedDirectory,
    beginnings: Vec<StretchStart>,
    /// Set by a signal, also between stretches.
    interrupted: Arc<AtomicBool>,
}

pub(crate) fn run(arguments: &RunArguments, opened: &BuiltScene) -> Result<(), Failure> {
    let out = arguments.out.clone();
    let out = out.unwrap_or_else(|| by_default(&arguments.source));
    let follower = Follower::new(&opened.assembly.scene).map_err(|p| opened.refuse(&p))?;
    let directory = FollowedDirectory::new(&out);
    let beginnings = if arguments.resume {
        directory.beginnings()?
    } else {
        Vec::new()
    };
    if !beginnings.is_empty() && is_finished(&out, &follower)? {
        println!("{} is finished: nothing to resume", out.display());
        return Ok(());
    }
    // Held until the end of the run.
    let _lock = claim(arguments, &out, beginnings.is_empty())?;
    if beginnings.is_empty() {
        directory.remove_from(0)?;
        RunDirectory::existing(&out).write_scene(follower.scene())?;
    }
    let chain = Chain {
        arguments,
        opened,
        follower: &follower,
        directory,
        beginnings,
        interrupted: signals::interruption()?,
    };
    let summary = chain.advance()?;
    print(&summary, &opened.notes(&opened.plan()?), &out);
    if let Some(following) = &summary.following {
        println!(
            "{} resolution switch(es) added {:.4} pN nm; on average {:.0} % of the cells were monomers",
            following.switches,
            following.switches_pn_nm,
            100.0 * following.share_of_monomers
        );
    }
    Ok(())
}

/// Returns whether the run in `out` has ended. A run of another scene or a failed run is an error.
fn is_finished(out: &Path, follower: &Follower) -> Result<bool, Failure> {
    let place = out.display();
    let written = std::fs::read_to_string(out.join("scene.ron")).unwrap_or_default();
    if written != follower.scene().to_ron() {
        let message = format!("{place} holds a run of another scene: nothing to resume");
        return Err(Failure::Input(message));
    }
    match ending(out) {
        Some(Status::Failed) => Err(Failure::Numerical(format!(
            "{place} holds a failed run, which cannot be resumed: use --overwrite"
        ))),
        ended => Ok(ended.is_some()),
    }
}

fn ending(directory: &Path) -> Option<Status> {
    let summary = RunDirectory::existing(directory).summary().ok()?;
    (summary.status != Status::Interrupted).then_some(summary.status)
}

fn claim(arguments: &RunArguments, out: &Path, is_new: bool) -> Result<RunLock, Failure> {
    if !is_new {
        return Ok(RunLock::acquire(out)?);
    }
    refuse_own_sources(arguments, None, out)?;
    let is_left = arguments.resume && RunDirectory::existing(out).is_unfinished();
    let (_, lock) = RunDirectory::create_locked(out, arguments.overwrite || is_left)?;
    Ok(lock)
}

impl Chain<'_> {
    fn advance(mut self) -> Result<Summary, Failure> {
        if let Some(summary) = self.all_done()? {
            return Ok(summary);
        }
        let (mut stretch, mut is_begun) = self.take_up()?;
        loop {
            let plan = self.planned(&stretch)?;
            let directory = RunDirectory::existing(self.path(&stretch));
            let mut kept = self.checkpoints(&plan, &directory);
            let saved = if is_begun {
                Some(kept.resume(&plan)?)
            } else {
                self.create(&stretch, &plan)?;
                None
            };
            let left = self.left(&stretch, &plan, saved, &mut kept)?;
            let (outcome, next) = match left {
                StretchEnd::Over(outcome) => (outcome, None),
                StretchEnd::Switched(outcome, next) => {
                    self.begin(&next.stretch, &next.saved)?;
                    (outcome, Some(next.stretch))
                }
            };
            let summary = directory.write(&plan, &kept, &outcome)?;
            if outcome.status == Status::Interrupted {
                return Err(self.interrupted(&summary)?);
            }
            directory.remove_checkpoint()?;
            let Some(next) = next else {
                return Ok(self.directory.write(&self.beginnings, &summary)?);
            };
            drop(plan);
            (stretch, is_begun) = (next, true);
        }
    }

    fn checkpoints(&self, plan: &Plan<'_>, directory: &RunDirectory) -> Checkpoints {
        let interrupted = Arc::clone(&self.interrupted);
        checkpoints(self.arguments, plan, directory, interrupted)
    }

    fn path(&self, stretch: &Stretch) -> std::path::PathBuf {
        self.directory.stretch(stretch.beginning.index)
    }

    fn planned<'s>(&self, stretch: &'s Stretch) -> Result<Plan<'s>, Failure> {
        Plan::new(&stretch.assembly).map_err(|problem| self.opened.refuse(&problem))
    }

    fn done(&self) -> impl Iterator<Item = RunDirectory> + '_ {
        let paths = self.beginnings.iter();
        let paths = paths.map(|one| self.directory.stretch(one.index));
        let ended = paths.take_while(|path| ending(path).is_some());
        ended.map(RunDirectory::existing)
    }

    /// Returns the summary of the whole motion if all stretches have ended.
    ///
    /// The directory of the next stretch is created before a stretch ends, so the last directory belongs to the last
    /// stretch.
    fn all_done(&self) -> Result<Option<Summary>, Failure> {
        // A killed process can leave a checkpoint next to final results.
        for directory in self.done() {
            directory.remove_checkpoint()?;
        }
        let Some(last) = self.beginnings.last() else {
            return Ok(None);
        };
        if self.done().count() < self.beginnings.len() {
            return Ok(None);
        }
        let last = RunDirectory::existing(self.directory.stretch(last.index)).summary()?;
        Ok(Some(self.directory.write(&self.beginnings, &last)?))
    }

    /// Returns the stretch to run next and whether it has a checkpoint. Directories after a stretch without results
    /// are removed.
    fn take_up(&mut self) -> Result<(Stretch, bool), Failure> {
        let refused = |problem| self.opened.refuse(&problem);
        let first = self.done().count();
        let stretch = match self.beginnings.get(first) {
            Some(beginning) => self.follower.again(beginning.clone()).map_err(refused)?,
            None => self.follower.begin().map_err(refused)?,
        };
        self.beginnings.truncate(stretch.beginning.index);
        self.beginnings.push(stretch.beginning.clone());
        self.directory.remove_from(stretch.beginning.index + 1)?;
        let is_begun = RunDirectory::existing(self.path(&stretch)).has_checkpoint();
        Ok((stretch, is_begun))
    }

    fn create(&self, stretch: &Stretch, plan: &Plan<'_>) -> Result<(), Failure> {
        let directory = RunDirectory::create(self.path(stretch), true)?;
        directory.write_scene(plan.scene())?;
        Ok(self.directory.note(&self.beginnings)?)
    }

    /// Creates the directory of the stretch after a switch, with its first record and a checkpoint.
    fn begin(&mut self, stretch: &Stretch, saved: &SavedRun) -> Result<(), Failure> {
        self.beginnings.push(stretch.beginning.clone());
        let plan = self.planned(stretch)?;
        self.create(stretch, &plan)?;
        let directory = RunDirectory::existing(self.path(stretch));
        let mut kept = self.checkpoints(&plan, &directory);
        saved
            .recorded
            .last
            .as_ref()
            .into_iter()
            .for_each(|r| kept.record(r));
        kept.checkpoint(&saved.position, &saved.recorded, saved.wall_s);
        if kept.last_failed() {
            let place = directory.path().display();
            let message = format!("the initial state of {place} could not be written");
            return Err(Failure::Unwritten(message));
        }
        Ok(())
    }

    fn left(
        &self,
        stretch: &Stretch,
        plan: &Plan<'_>,
        saved: Option<SavedRun>,
        kept: &mut Checkpoints,
    ) -> Result<StretchEnd, Failure> {
        let mut sink = RunSink::new(kept);
        let left = self.follower.advance((stretch, plan), saved, &mut sink);
        sink.finish();
        left.map_err(|error| match error {
            RunError::Refused(problem) => Failure::Numerical(self.opened.locate(&problem)),
            RunError::Failed(failed) => self.broken((stretch, plan), kept, &failed.outcome),
        })
    }

    fn broken(
        &self,
        (stretch, plan): (&Stretch, &Plan<'_>),
        kept: &Checkpoints,
        outcome: &Outcome,
    ) -> Failure {
        let why = &outcome.failure;
        let directory = RunDirectory::existing(self.path(stretch));
        let written = directory.write(plan, kept, outcome).and_then(|summary| {
            let all = self.directory.write(&self.beginnings, &summary);
            all.map(drop)
        });
        let place = self.directory.path().display();
        Failure::Numerical(match written {
            Ok(()) => format!("{why}; everything up to the last good state is in {place}"),
            Err(error) => format!("{why}; and {error}"),
        })
    }

    fn interrupted(&self, last: &Summary) -> Result<Failure, Failure> {
        self.directory.write(&self.beginnings, last)?;
        let place = self.directory.path().display();
        let scene = self.arguments.source.scene.display();
        Ok(Failure::Interrupted(format!(
            "a checkpoint is in {place}, with everything recorded so far; to continue: actin run {scene} --out \
             {place} --resume"
        )))
    }
}
