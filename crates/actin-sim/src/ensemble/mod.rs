//! Replicas of one scene with different seeds, run in parallel; see [`Ensemble`].
//!
//! Sweeps over keys and output to directories are in `actin-sweep`.

mod pool;
#[cfg(test)]
mod tests;

use crate::run::InterruptibleTrajectory;
use crate::scene::RandomPart;
use crate::{Outcome, Plan, Record, RunError, Scene, Status, Trajectory};
use std::num::NonZeroUsize;
use thiserror::Error;

/// Replicas of a scene with different seeds.
///
/// Each replica runs on one thread. Memory holds the records of the running replicas; only the
/// memory of a single replica is checked, and fewer threads need less. Results are in the order of
/// the replicas and bitwise independent of the number of threads.
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
#[derive(Clone, Debug)]
pub struct Ensemble<'a> {
    scene: &'a Scene,
    seeds: Vec<u64>,
    drawn: Vec<RandomPart>,
    threads: Option<NonZeroUsize>,
}

/// Replica at the end of its run.
#[derive(Debug)]
pub struct Replica<'a> {
    /// Index of the replica.
    pub index: usize,
    /// Seed of its scene.
    pub seed: u64,
    /// Plan of the run.
    pub plan: &'a Plan<'a>,
    /// Records of the run.
    pub sink: Trajectory,
    /// Outcome of the run.
    pub outcome: Outcome,
}

/// Error of an ensemble.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EnsembleError {
    /// All replicas would be identical.
    #[error(
        "the scene has nothing that depends on a seed (bonds with anchors: Independent, thermal noise, \
         imperfections): all replicas would be identical"
    )]
    NothingDrawn,
    /// A replica could not be built, or failed.
    #[error("replica {index} (seed {seed}): {error}")]
    Replica {
        /// Index of the replica.
        index: usize,
        /// Seed of the replica.
        seed: u64,
        /// Cause of the failure.
        error: RunError,
    },
}

impl<'a> Ensemble<'a> {
    /// Creates `replicas` replicas. All random parts of the scene use the seeds 1, 2, ..., as
    /// samples of a sweep do.
    ///
    /// # Errors
    /// If several replicas would be identical, because the scene has no random part.
    pub fn new(scene: &'a Scene, replicas: usize) -> Result<Self, EnsembleError> {
        let seeds = (1..).take(replicas).collect();
        Self::from_seeds(scene, seeds, &RandomPart::ALL)
    }

    /// Creates replicas with these seeds for the random parts in `drawn`; other seeds of the scene
    /// are kept.
    ///
    /// # Errors
    /// If several replicas would be identical, because the scene has none of these random parts.
    ///
    /// ```
    /// use actin_sim::{RandomPart, Ensemble, Scene};
    /// # let text = "Scene(
    /// #     filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)]),
    /// #     clamps: [Clamp(end: Start)],
    /// #     task: Equilibrium(),
    /// # )";
    /// // Quadrature bonds are not sampled, and an equilibrium has no noise.
    /// let scene = Scene::from_ron(text)?;
    /// let refused = Ensemble::from_seeds(&scene, vec![7, 8], &[RandomPart::Bonds]);
    /// assert!(refused.is_err());
    /// # Ok::<(), actin_sim::SimError>(())
    /// ```
    pub fn from_seeds(
        scene: &'a Scene,
        seeds: Vec<u64>,
        drawn: &[RandomPart],
    ) -> Result<Self, EnsembleError> {
        let ensemble = Self {
            scene,
            drawn: drawn.to_vec(),
            threads: None,
            seeds,
        };
        if ensemble.seeds.len() > 1 && ensemble.reseeded(1).1 == 0 {
            return Err(EnsembleError::NothingDrawn);
        }
        Ok(ensemble)
    }

    /// Sets the number of threads; the default is the number of cores.
    #[must_use]
    pub fn on_threads(self, threads: NonZeroUsize) -> Self {
        Self {
            threads: Some(threads),
            ..self
        }
    }

    /// Runs all replicas with records in memory. Calls `observe` at the end of each replica, on its
    /// thread, and returns the results in the order of the replicas.
    ///
    /// # Errors
    /// The first failed replica in this order, for any number of threads; later replicas are
    /// stopped.
    pub fn run<T: Send>(
        &self,
        observe: impl Fn(Replica<'_>) -> T + Sync,
    ) -> Result<Vec<T>, EnsembleError> {
        let replica = |index: usize, is_stopped: &dyn Fn() -> bool| {
            let seed = self.seeds[index];
            let assembly = crate::build(&self.reseeded(seed).0)?;
            let plan = Plan::new(&assembly)?;
            let mut sink = InterruptibleTrajectory::new(|_: &[Record]| is_stopped());
            let outcome = plan.run_into(&mut sink)?;
            if outcome.status == Status::Interrupted {
                return Ok(None);
            }
            Ok(Some(observe(Replica {
                index,
                seed,
                plan: &plan,
                sink: sink.trajectory,
                outcome,
            })))
        };
        let cores = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let threads = self.threads.map_or_else(cores, NonZeroUsize::get);
        let replicas = self.seeds.len();
        pool::on_threads(threads.min(replicas), replicas, replica).map_err(|(index, error)| {
            let seed = self.seeds[index];
            EnsembleError::Replica { index, seed, error }
        })
    }

    /// Returns the scene with a seed, and the number of its random parts with that seed.
    fn reseeded(&self, seed: u64) -> (Scene, usize) {
        let mut scene = self.scene.clone();
        let drawn = self.drawn.iter();
        let count = drawn.map(|&what| scene.reseed(what, seed)).sum();
        (scene, count)
    }
}
