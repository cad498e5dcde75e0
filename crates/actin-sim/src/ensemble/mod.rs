//! Replicas of one scene, which differ in their seeds, on all cores: begin with [`Ensemble`].
//!
//! The threads are in `crew.rs`. Runs that are written to directories, and keys that vary, are the business of
//! `actin-sweep`.

mod crew;
mod error;
mod sink;
#[cfg(test)]
mod tests;

pub use error::EnsembleError;

use crate::scene::Drawn;
use crate::{Assembly, Outcome, Plan, Scene, Sink, Status, Trajectory};
use crew::Crew;
use std::fmt;
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

/// Replicas of a scene: the same filaments under the same loads with other seeds.
///
/// Each replica runs on one thread, as many at the same time as there are threads; memory holds the records of
/// these alone, which is not checked beyond what one replica needs: fewer threads take less. Results stand in the order of the replicas and are the same, to the bit, on any number of threads.
///
/// ```
/// use actin_sim::{End, Ensemble, Scene};
/// // A rod of 100 nm on a wall in a heat bath.
/// let scene = Scene::from_ron(
///     "Scene(
///         filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
///         clamps: [Clamp(end: Start)],
///         task: Dynamics(
///             duration_ns: 0.5,
///             record_every_ns: 0.1,
///             drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
///             thermal: Thermal(temperature_k: 298.0, seed: 1),
///         ),
///     )",
/// )?;
/// let tips_nm = Ensemble::new(&scene, 4)?.run(|replica| {
///     let last = replica.sink.records.last().expect("a motion has an end");
///     replica.plan.assembly().tip_nm(&last.state, End::End)
/// })?;
/// assert_eq!(tips_nm.len(), 4);
/// assert_ne!(tips_nm[0], tips_nm[1]);
/// # Ok::<(), actin_sim::SimError>(())
/// ```
#[derive(Clone)]
pub struct Ensemble<'a> {
    scene: &'a Scene,
    seeds: Vec<u64>,
    drawn: Vec<Drawn>,
    threads: Option<NonZeroUsize>,
    interrupted: Option<&'a AtomicBool>,
    progress: &'a (dyn Fn(EnsembleProgress) + Sync),
}

/// A replica that has run to its end.
#[derive(Debug)]
pub struct Replica<'a, S = Trajectory> {
    /// Its number, from 0.
    pub index: usize,
    /// What the seeds of its scene are set to.
    pub seed: u64,
    /// What has run.
    pub plan: &'a Plan<'a>,
    /// What has taken its records.
    pub sink: S,
    /// How it ended and what it cost.
    pub outcome: Outcome,
}

/// How far an ensemble has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnsembleProgress {
    /// Replicas that have ended.
    pub ended: usize,
    /// Replicas that there are.
    pub of: usize,
}

impl<'a> Ensemble<'a> {
    /// So many replicas; everything that the scene draws takes the seeds 1, 2 and so on, as the samples of a sweep do.
    ///
    /// # Errors
    /// Several replicas of a scene that draws nothing: all would be the same.
    pub fn new(scene: &'a Scene, replicas: usize) -> Result<Self, EnsembleError> {
        let seeds = (1..).take(replicas).collect();
        Self::of_seeds(scene, seeds, &Drawn::ALL)
    }

    /// Replicas of these seeds, which go to what is `drawn`; the scene keeps its other seeds.
    ///
    /// # Errors
    /// Several replicas of a scene that draws none of these.
    ///
    /// ```
    /// use actin_sim::{Drawn, Ensemble, Scene};
    /// # let text = "Scene(
    /// #     filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)]),
    /// #     clamps: [Clamp(end: Start)],
    /// #     task: Equilibrium(),
    /// # )";
    /// // Weighted bonds are not drawn, and an equilibrium has no noise.
    /// let scene = Scene::from_ron(text)?;
    /// let refused = Ensemble::of_seeds(&scene, vec![7, 8], &[Drawn::Bonds]);
    /// assert!(refused.is_err());
    /// # Ok::<(), actin_sim::SimError>(())
    /// ```
    pub fn of_seeds(
        scene: &'a Scene,
        seeds: Vec<u64>,
        drawn: &[Drawn],
    ) -> Result<Self, EnsembleError> {
        let ensemble = Self {
            scene,
            drawn: drawn.to_vec(),
            threads: None,
            interrupted: None,
            progress: &|_| (),
            seeds,
        };
        if ensemble.seeds.len() > 1 && ensemble.reseeded(1).1 == 0 {
            return Err(EnsembleError::NothingDrawn);
        }
        Ok(ensemble)
    }

    /// Runs on so many threads; by default there is one for each core.
    #[must_use]
    pub fn on_threads(self, threads: NonZeroUsize) -> Self {
        Self {
            threads: Some(threads),
            ..self
        }
    }

    /// Ends all replicas as soon as they can once this is set.
    #[must_use]
    pub fn interrupted_by(self, flag: &'a AtomicBool) -> Self {
        Self {
            interrupted: Some(flag),
            ..self
        }
    }

    /// Tells how many replicas have ended whenever one more has.
    #[must_use]
    pub fn with_progress(self, progress: &'a (dyn Fn(EnsembleProgress) + Sync)) -> Self {
        Self { progress, ..self }
    }

    /// Runs all replicas into memory and observes each when it has ended, on its thread; what is observed, in the
    /// order of the replicas.
    ///
    /// # Errors
    /// The first replica, in this order, that cannot be built or fails, whatever the number of threads; those behind
    /// it are not run to their ends. An ensemble that is interrupted.
    pub fn run<T: Send>(
        &self,
        observe: impl Fn(Replica<'_>) -> T + Sync,
    ) -> Result<Vec<T>, EnsembleError> {
        self.run_into(|_| Trajectory::default(), observe)
    }

    /// The same with records in sinks of one's own, one for each plan: to keep a few numbers of each record rather
    /// than its state.
    ///
    /// # Errors
    /// As [`run`](Self::run). A sink that interrupts its run leaves a replica whose outcome says so.
    pub fn run_into<S: Sink, T: Send>(
        &self,
        sink: impl Fn(&Plan<'_>) -> S + Sync,
        observe: impl Fn(Replica<'_, S>) -> T + Sync,
    ) -> Result<Vec<T>, EnsembleError> {
        let make = |index: usize, stop: &sink::Stop<'_>| {
            let seed = self.seeds[index];
            let assembly = Assembly::build(&self.reseeded(seed).0)?;
            let plan = Plan::new(&assembly)?;
            let mut sink = sink(&plan);
            let outcome = plan.run_into(&mut stop.over(&mut sink))?;
            if outcome.status == Status::Interrupted && stop.is_set() {
                return Ok(None);
            }
            Ok(Some(observe(Replica {
                index,
                seed,
                plan: &plan,
                sink,
                outcome,
            })))
        };
        Crew::new(self, &make).work_all()
    }

    /// The scene with a seed, and how much of it draws from that.
    fn reseeded(&self, seed: u64) -> (Scene, usize) {
        let mut scene = self.scene.clone();
        let drawn = self.drawn.iter();
        let count = drawn.map(|&what| scene.reseed(what, seed)).sum();
        (scene, count)
    }
}

impl fmt::Debug for Ensemble<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("scene", &self.scene)
            .field("seeds", &self.seeds)
            .field("drawn", &self.drawn)
            .field("threads", &self.threads)
            .finish_non_exhaustive()
    }
}
