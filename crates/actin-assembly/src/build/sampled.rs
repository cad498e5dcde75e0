//! Quasi-harmonic interfaces: moments of the thermal motion of bonds, and the chain with the same
//! moments.
//!
//! A run of monomers, possibly of several sections, is sampled without external loads in a separate
//! heat bath. In the scene, the energy of other interactions adds to that of the chain. Moments
//! therefore depend on the run alone and are cached per process, since sections that follow a
//! motion need the same runs again. For quadrature bonds all monomers are equivalent: runs of one
//! length share their moments, and a long run repeats the middle of a shorter one.

use super::strand::{Body, Strand};
use crate::InterfaceSampling;
use crate::scene::{Interfaces, SceneProblem, Task};
use crate::whole::to_steps;
use crate::{models, problem_at};
use actin_ellipsoid::{Anchors, Fluctuations, Link, Monomers, Placement, QuasiHarmonic};
use actin_integrate::{Bath, Drag, PEFRL, advance_in, largest_frequency, stable_step};
use actin_mechanics::{Interaction, State, System, Vector3, rotation};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Independent parts of the sampled motion, which run in parallel.
const PARTS: u64 = 4;
/// Rate of the bath (1/ns). Positions of neighbours decorrelate within a few tenths of a
/// nanosecond.
const DRAG: f64 = 5.0;
const WARM_UP_NS: f64 = 5.0;
const APART_NS: f64 = 0.05;
/// Time step over the largest stable step, for a relative error of the potential energy of 1e-3.
const SHARE: f64 = 0.5;

/// Largest number of monomers sampled with quadrature bonds: four periods.
const LONGEST: usize = 52;

/// Links at either end that are not repeated in longer runs: one period. Bonds reach the second
/// neighbour.
const BESIDE_ENDS: usize = 13;

/// Largest number of cached links: 30 MB.
const MOST_KEPT: usize = 50_000;

/// Cache of sampled runs by all their parameters. Sampling is bitwise reproducible, so that results
/// do not depend on the cache.
static KEPT: Mutex<BTreeMap<String, (Vec<Link>, InterfaceSampling)>> = Mutex::new(BTreeMap::new());

#[derive(Clone, Copy, Debug)]
pub(super) struct Sampling {
    thermal_energy: f64,
    duration_ns: f64,
}

impl Sampling {
    /// Sampling of a task; `None` for tasks with bonds at interfaces.
    pub(super) fn from_task(task: &Task) -> Option<Self> {
        let Task::Brownian(task) = task else {
            return None;
        };
        let Interfaces::QuasiHarmonic { sampled_ns } = task.interfaces else {
            return None;
        };
        Some(Self {
            thermal_energy: task.thermal()?.energy_pn_nm(),
            duration_ns: sampled_ns,
        })
    }
}

#[derive(Clone, Copy, Debug)]
struct Piece {
    section: usize,
    /// Lattice index of the first monomer.
    first: i64,
    count: usize,
}

/// Extends `links` to `count` links by repeating the middle.
fn prolonged(links: &[Link], count: usize) -> Vec<Link> {
    let behind = links.len().saturating_sub(BESIDE_ENDS);
    let middle = links[..behind].iter().skip(BESIDE_ENDS).cycle();
    let more = middle.take(count - links.len());
    let all = links[..behind].iter().chain(more).chain(&links[behind..]);
    all.copied().collect()
}

struct IsolatedStrand {
    monomers: Monomers,
    system: System,
    step: f64,
}

impl Strand<'_> {
    fn bonded_sections(&self) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for (i, body) in self.bodies.iter().enumerate() {
            match (body, runs.last_mut()) {
                (Body::Rod(_), _) => {}
                (Body::Monomers(_), Some(run)) if run.end == i => run.end = i + 1,
                (Body::Monomers(_), _) => runs.push(i..i + 1),
            }
        }
        runs
    }

    /// Chain of each section of monomers, and the accuracy of each run.
    pub(super) fn sample(
        &self,
        sampling: Sampling,
    ) -> Result<(Vec<Option<QuasiHarmonic>>, Vec<InterfaceSampling>), SceneProblem> {
        let mut chains: Vec<Option<QuasiHarmonic>> = vec![None; self.bodies.len()];
        let mut known = Vec::new();
        for sections in self.bonded_sections() {
            let (links, sampled) = self.sample_run(sections.clone(), sampling)?;
            known.push(sampled);
            let Body::Monomers(first) = &self.bodies[sections.start] else {
                continue;
            };
            let run = Monomers {
                count: sampled.monomers,
                ..*first
            };
            let chain = QuasiHarmonic::new(run, links);
            let mut lower = 0;
            for i in sections {
                let count = self.monomers_of(i);
                chains[i] = Some(chain.of_lowers(lower..lower + count));
                lower += count;
            }
        }
        Ok((chains, known))
    }

    fn sample_run(
        &self,
        sections: Range<usize>,
        sampling: Sampling,
    ) -> Result<(Vec<Link>, InterfaceSampling), SceneProblem> {
        let monomers = sections.clone().map(|i| self.monomers_of(i)).sum();
        let pieces = self.pieces(sections);
        let key = self.key(&pieces, sampling);
        // The lock is kept during sampling, so that other threads wait for this run.
        let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        if !kept.contains_key(&key) {
            let (chain, sampled) = self.alone(&pieces)?.sample(sampling)?;
            let found = (chain.links().to_vec(), sampled);
            let links: usize = kept.values().map(|(links, _)| links.len()).sum();
            if links + found.0.len() > MOST_KEPT {
                kept.clear();
            }
            kept.insert(key.clone(), found);
        }
        let (links, sampled) = &kept[&key];
        let sampled = InterfaceSampling {
            monomers,
            ..*sampled
        };
        Ok((prolonged(links, monomers - 1), sampled))
    }

    fn pieces(&self, sections: Range<usize>) -> Vec<Piece> {
        let mut models = self.models[sections.clone()].iter();
        let is_weighted = models.all(|m| m.parameters().anchors == Anchors::Cubature);
        let first_of = |i: usize| match &self.bodies[i] {
            Body::Monomers(monomers) => monomers.first_index,
            Body::Rod(_) => 0,
        };
        let from = if is_weighted {
            first_of(sections.start)
        } else {
            0
        };
        let most = if is_weighted && sections.len() == 1 {
            LONGEST
        } else {
            usize::MAX
        };
        let piece = |section: usize| Piece {
            section,
            first: first_of(section) - from,
            count: self.monomers_of(section).min(most),
        };
        sections.map(piece).collect()
    }

    fn key(&self, pieces: &[Piece], sampling: Sampling) -> String {
        let of_piece = |piece: &Piece| {
            let parameters = self.models[piece.section].parameters();
            (piece.first, piece.count, parameters)
        };
        let run: Vec<_> = pieces.iter().map(of_piece).collect();
        format!("{sampling:?} {run:?}")
    }

    fn monomers_of(&self, i: usize) -> usize {
        match &self.bodies[i] {
            Body::Monomers(monomers) => monomers.count,
            Body::Rod(_) => 0,
        }
    }

    fn alone(&self, pieces: &[Piece]) -> Result<IsolatedStrand, SceneProblem> {
        const SECTIONS: &str = "filament.sections";
        let mut state = State::default();
        let (mut own, mut placement) = (Vec::new(), Placement::default());
        for piece in pieces {
            let i = piece.section;
            let built = self.models[i].build(&mut state, &placement, piece.first, piece.count);
            own.push((i, built.map_err(problem_at(SECTIONS))?));
            // The turn changes half a rise after the last monomer.
            let [turn, next] = self.turns(i);
            let boundary = piece.first as f64 + piece.count as f64 - 0.5;
            placement.rotation *= rotation::exp(Vector3::z() * (boundary * (turn - next)));
        }
        let mut bonds: Vec<Box<dyn Interaction>> = Vec::new();
        for (i, monomers) in &own {
            let run = self.bonded_run(*i, monomers);
            let of_section = self.models[*i].bonds_above(&run, monomers.count, self.turns(*i)[1]);
            let of_section =
                of_section.map_err(|e| models::unbonded(&e, &self.filament.monomers))?;
            bonds.push(Box::new(of_section));
        }
        let monomers = Monomers {
            count: state.points.len(),
            ..own[0].1
        };
        let system = System::new(state, bonds);
        let frequency = largest_frequency(&system).map_err(problem_at(SECTIONS))?;
        let step = stable_step(&PEFRL, frequency, SHARE).map_err(problem_at(SECTIONS))?;
        Ok(IsolatedStrand {
            monomers,
            system,
            step,
        })
    }
}

impl IsolatedStrand {
    fn sample(
        &self,
        sampling: Sampling,
    ) -> Result<(QuasiHarmonic, InterfaceSampling), SceneProblem> {
        let parts = self.parts(sampling)?;
        let mut all = Fluctuations::new(&self.monomers, self.system.state());
        for part in &parts {
            all.add_all(part);
        }
        let kt = sampling.thermal_energy;
        let chain = all.chain(kt).map_err(|error| {
            let value = format!("{:?}", sampling.duration_ns);
            SceneProblem::new("task.interfaces.sampled_ns", value, error.to_string())
        })?;
        let of_part = |part: &Fluctuations| part.distance_from(&chain, kt).powi(2);
        let variance = parts.iter().map(of_part).sum::<f64>() / (PARTS * (PARTS - 1)) as f64;
        let sampled = InterfaceSampling {
            monomers: self.monomers.count,
            error: variance.sqrt(),
        };
        Ok((chain, sampled))
    }

    fn parts(&self, sampling: Sampling) -> Result<Vec<Fluctuations>, SceneProblem> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let numbers: Vec<u64> = (0..PARTS).collect();
        let mut parts = Vec::new();
        for together in numbers.chunks(cores) {
            let found: Vec<_> = std::thread::scope(|scope| {
                let threads = together.iter().map(|&part| {
                    let system = self.system.in_state(self.system.state().clone());
                    scope.spawn(move || self.part(system, sampling, part))
                });
                let threads: Vec<_> = threads.collect();
                let joined = threads.into_iter().map(std::thread::ScopedJoinHandle::join);
                joined.collect()
            });
            for part in found {
                parts.push(part.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?);
            }
        }
        Ok(parts)
    }

    fn part(
        &self,
        mut system: System,
        sampling: Sampling,
        part: u64,
    ) -> Result<Fluctuations, SceneProblem> {
        let refused = |error: &dyn std::error::Error| {
            SceneProblem::new("task.interfaces", "QuasiHarmonic", error.to_string())
        };
        let drag = Drag::new(DRAG, DRAG).map_err(|error| refused(&error))?;
        let bath = Bath::new(drag, sampling.thermal_energy, part);
        let bath = bath.map_err(|error| refused(&error))?;
        let (warm_up, apart) = (times(WARM_UP_NS, self.step), times(APART_NS, self.step));
        let states = times(sampling.duration_ns, PARTS as f64 * APART_NS);
        let mut fluctuations = Fluctuations::new(&self.monomers, system.state());
        advance_in(&mut system, &PEFRL, self.step, warm_up, &bath, 0);
        for state in 0..states {
            let first = warm_up + state * apart;
            advance_in(&mut system, &PEFRL, self.step, apart, &bath, first);
            fluctuations.add(system.state());
        }
        Ok(fluctuations)
    }
}

fn times(whole: f64, part: f64) -> u64 {
    to_steps((whole / part).ceil())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::SceneParts;
    use crate::scene::Scene;

    const SAMPLING: Sampling = Sampling {
        thermal_energy: 4.11,
        duration_ns: 2.0,
    };

    fn of<T>(sections: &str, anchors: &str, ask: impl Fn(&Strand<'_>) -> T) -> T {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [{sections}],
                    monomers: Monomers(anchors: {anchors}),
                    rod: (law: Constant),
                ),
                task: Dynamics(duration_ns: 1.0),
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        let mut strand = Strand::new(
            (0, &scene.filament),
            ([None; 2], Vec::new()),
            0,
            Some(298.0),
        )
        .unwrap();
        strand.push_bodies(&mut SceneParts::default()).unwrap();
        ask(&strand)
    }

    const BEFORE: &str = "Rod(from_nm: 0.0, to_nm: 35.6), Ellipsoids(from_nm: 35.6, to_nm: 71.2),
        Rod(from_nm: 71.2, to_nm: 142.4)";
    const BEHIND: &str = "Rod(from_nm: 0.0, to_nm: 71.2), Ellipsoids(from_nm: 71.2, to_nm: 106.8),
        Rod(from_nm: 106.8, to_nm: 142.4)";

    #[test]
    fn sampling_repeats_to_the_bit() {
        let found = [(); 2].map(|()| {
            of(BEHIND, "Cubature", |strand| {
                let alone = strand.alone(&strand.pieces(1..2)).unwrap();
                let (chain, sampled) = alone.sample(SAMPLING).unwrap();
                (chain.links().to_vec(), sampled)
            })
        });
        assert!(found[0] == found[1]);
        let kept = of(BEHIND, "Cubature", |s| {
            s.sample_run(1..2, SAMPLING).unwrap()
        });
        assert!(kept == found[0]);
    }

    /// Quadrature bonds depend on the length of a run, sampled bonds also on its place.
    #[test]
    fn runs_are_keyed_by_the_parameters_of_bonds() {
        let key = |sections: &str, anchors: &str| {
            of(sections, anchors, |strand| {
                assert_eq!(strand.monomers_of(1), 13);
                strand.key(&strand.pieces(1..2), SAMPLING)
            })
        };
        assert_eq!(key(BEFORE, "Cubature"), key(BEHIND, "Cubature"));
        assert_ne!(key(BEFORE, "Independent"), key(BEHIND, "Independent"));
        let longer = Sampling {
            duration_ns: 3.0,
            ..SAMPLING
        };
        let other = of(BEFORE, "Cubature", |strand| {
            strand.key(&strand.pieces(1..2), longer)
        });
        assert_ne!(other, key(BEFORE, "Cubature"));
        assert_ne!(key(TURNED, "Cubature"), key(BEHIND, "Cubature"));
    }

    const TURNED: &str = "Rod(from_nm: 0.0, to_nm: 71.2),
        Ellipsoids(from_nm: 71.2, to_nm: 106.8, altered: (turn_deg: -162.0)),
        Ellipsoids(from_nm: 106.8, to_nm: 142.4), Rod(from_nm: 142.4, to_nm: 180.0)";

    /// Rounding of places of 100 nm times the stiffness of an interface, 3e3 pN/nm.
    #[test]
    fn sections_of_different_turn_are_sampled_from_rest() {
        let residual = of(TURNED, "Independent", |strand| {
            let mut alone = strand.alone(&strand.pieces(1..3)).unwrap();
            let loads = alone.system.loads().clone();
            loads.residual(alone.system.state())
        });
        assert!(
            residual.force < 1e-8 && residual.torque < 1e-7,
            "{residual:?}"
        );
    }

    #[test]
    fn long_runs_repeat_the_middle_of_shorter_ones() {
        let long = "Ellipsoids(from_nm: 0.0, to_nm: 300.0)";
        let (links, sampled) = of(long, "Cubature", |s| s.sample_run(0..1, SAMPLING).unwrap());
        let short = "Ellipsoids(from_nm: 0.0, to_nm: 136.9)";
        let (few, _) = of(short, "Cubature", |s| s.sample_run(0..1, SAMPLING).unwrap());
        assert_eq!((few.len(), links.len()), (51, sampled.monomers - 1));
        assert!(links.len() > 100);
        assert!(links[..38] == few[..38] && links[38..63] == few[13..38]);
        assert!(links[links.len() - 13..] == few[38..]);
        let drawn = of(long, "Independent", |s| s.pieces(0..1)[0].count);
        assert_eq!(drawn, sampled.monomers);
    }
}
