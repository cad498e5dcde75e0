//! One cantilever: which scene, what is changed in it, and what came out.

use super::ringdown::{self, RingDown};
use super::variant::Variant;
use crate::run::{run_to_end, scenario};
use actin_sim::{
    Assembly, DragRates, End, Equilibrium, ForceLaw, Outcome, Record, Scene, Section, Task,
};
use actin_view::Pose;

/// Which scene of `scenarios/figure-4` a case starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resolved {
    /// The last so many nm as a rod.
    Mixed(u32),
    /// All of it a rod of so many segments.
    Rod(usize),
    /// All monomers, with this seed of the bonds.
    Ellipsoids(u64),
}

/// One cantilever.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub variant: Variant,
    pub resolved: Resolved,
}

/// What came out of a case.
#[derive(Clone, Debug)]
pub(super) struct Result4 {
    pub case: Case,
    /// Distance by which the tip went along the force (nm).
    pub tip_drop_nm: f64,
    /// Time (ns), elastic plus kinetic energy (pN nm).
    pub energy: Vec<(f64, f64)>,
    /// The same with the load's potential (pN nm), record by record.
    pub total: Vec<f64>,
    /// Whether it was moved in time; the equilibrium was solved for otherwise.
    pub moved: bool,
    /// Evaluations of bonds and segments.
    pub work: f64,
    /// Centre line at the end (nm).
    pub centre_line: Vec<[f64; 3]>,
    /// Monomer centres at the end (nm).
    pub monomers: Vec<[f64; 3]>,
    /// First flexural mode.
    pub ring_down: Option<RingDown>,
    /// The equilibrium that Newton's method finds; none for loads without a potential.
    pub newton: Option<Newton>,
    /// Residual force (pN) and torque (pN nm) at the end.
    pub residual: (f64, f64),
    pub converged: bool,
    pub time_ns: f64,
    pub force_evaluations: u64,
    /// The state at the end.
    pub pose: Pose,
}

/// An equilibrium by Newton's method.
#[derive(Clone, Copy, Debug)]
pub(super) struct Newton {
    /// Distance by which the tip went along the force (nm).
    pub tip_drop_nm: f64,
    /// Elastic energy of monomers, junctions and rod (pN nm).
    pub energy_pn_nm: f64,
    /// Whether it is certified as stable.
    pub certified: bool,
}

impl Result4 {
    /// Elastic energy at equilibrium (pN nm), Newton's where there is one.
    pub(super) fn elastic_pn_nm(&self) -> f64 {
        let at_the_end = self.energy.last().map_or(f64::NAN, |e| e.1);
        self.newton.map_or(at_the_end, |found| found.energy_pn_nm)
    }
}

/// Drag rates while a filament swings (1/ns): the amplitude decays at half this rate.
pub(super) const SWING_DRAG_PER_NS: f64 = 0.04;
/// Time for which it swings (ns): about four periods.
const SWING_NS: f64 = 150.0;

/// Segments of the pure rod at the resolution of the paper, 10 nm each.
pub(super) const ROD_SEGMENTS: usize = 16;

impl Case {
    pub(super) fn mixed(variant: Variant, rod: u32) -> Self {
        let resolved = Resolved::Mixed(rod);
        Self { variant, resolved }
    }

    pub(super) fn rod(variant: Variant) -> Self {
        let resolved = Resolved::Rod(ROD_SEGMENTS);
        Self { variant, resolved }
    }

    pub(super) fn refined_rod(segments: usize) -> Self {
        let (variant, resolved) = (Variant::SHARED, Resolved::Rod(segments));
        Self { variant, resolved }
    }

    pub(super) fn ellipsoids(variant: Variant, seed: u64) -> Self {
        let resolved = Resolved::Ellipsoids(seed);
        Self { variant, resolved }
    }

    /// Its name in quantities.
    pub(super) fn path(&self) -> String {
        let folders = match (self.variant, self.resolved) {
            (Variant::SHARED, Resolved::Mixed(_)) => "shared/".into(),
            (variant, _) => variant.path(),
        };
        folders + &self.name()
    }

    /// Share of rod, for the colour.
    pub(super) fn rod_share(&self) -> f64 {
        match self.resolved {
            Resolved::Mixed(rod) => f64::from(rod) / 160.0,
            Resolved::Rod(_) => 1.0,
            Resolved::Ellipsoids(_) => 0.0,
        }
    }

    /// Name in tables, legends and quantities.
    pub(super) fn name(&self) -> String {
        match self.resolved {
            Resolved::Mixed(rod) => format!("rod-{rod}"),
            Resolved::Rod(ROD_SEGMENTS) => "rod".into(),
            Resolved::Rod(segments) => format!("rod-of-{segments}-segments"),
            Resolved::Ellipsoids(0) => "ellipsoids".into(),
            Resolved::Ellipsoids(seed) => format!("ellipsoids/seed-{seed}"),
        }
    }

    fn scene(&self) -> Result<Scene, String> {
        let file = match self.resolved {
            Resolved::Mixed(rod) => format!("rod-{rod:03}.ron"),
            Resolved::Rod(_) => "rod.ron".into(),
            Resolved::Ellipsoids(_) => "ellipsoids.ron".into(),
        };
        let mut scene = scenario(&format!("figure-4/{file}"))?;
        self.apply(&mut scene);
        Ok(scene)
    }

    fn apply(&self, scene: &mut Scene) {
        self.variant.apply(scene);
        match (self.resolved, &mut scene.filament.sections[0]) {
            (Resolved::Rod(n), Section::Rod { segments, .. }) => *segments = Some(n),
            (Resolved::Ellipsoids(seed), _) => scene.filament.monomers.seed = seed,
            _ => {}
        }
    }

    /// The scene, whose task is the equilibrium alone if it is not `moving`.
    fn scene_of(&self, moving: bool) -> Result<Scene, String> {
        let mut scene = self.scene()?;
        if !moving {
            scene.task = Task::Equilibrium(Equilibrium::default());
        }
        Ok(scene)
    }

    /// Runs the case to its end, in time if `moving` and its variant does.
    pub(super) fn run(&self, moving: bool) -> Result<Result4, String> {
        let moving = moving && self.variant.moves();
        let Done {
            assembly,
            records,
            report,
        } = self.done(&self.scene_of(moving)?)?;
        let last = &records[records.len() - 1];
        let counts = assembly.counts();
        let tip_drop_nm = tip_drop(&assembly, last);
        let positions = |keep: &dyn Fn(usize) -> Option<[f64; 3]>| -> Vec<[f64; 3]> {
            (0..assembly.points.len()).filter_map(keep).collect()
        };
        Ok(Result4 {
            case: *self,
            tip_drop_nm,
            energy: energies(&assembly, &records),
            total: records.iter().map(total_energy).collect(),
            moved: moving,
            work: report.force_evaluations as f64 * (counts.bonds + counts.segments) as f64,
            centre_line: positions(&|i| Some(assembly.centre_line_nm(&last.state, i).into())),
            monomers: positions(&|i| {
                let monomer = assembly.points[i].frame.is_some();
                monomer.then(|| last.state.points.position.get(i).into())
            }),
            ring_down: self.ring_down(moving, tip_drop_nm)?,
            newton: self.newton()?,
            residual: (last.residual_force_pn, last.residual_torque_pn_nm),
            converged: report.has_converged(),
            time_ns: last.at.value(),
            force_evaluations: report.force_evaluations,
            pose: Pose::of(&assembly, &last.state),
        })
    }
}

/// A scene that has been run.
struct Done {
    assembly: Assembly,
    /// At least one.
    records: Vec<Record>,
    report: Outcome,
}

impl Case {
    /// Runs `scene`.
    fn done(&self, scene: &Scene) -> Result<Done, String> {
        let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", self.path());
        let mut assembly = Assembly::build(scene).map_err(|e| fail(&e))?;
        let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| fail(&e))?;
        if trajectory.records.is_empty() {
            return Err(fail(&"no record"));
        }
        Ok(Done {
            assembly,
            records: trajectory.records,
            report,
        })
    }

    /// Solves for the equilibrium directly, from the straight state; loads that the printed balance
    /// gives have no potential, and no equilibrium in this sense.
    fn newton(&self) -> Result<Option<Newton>, String> {
        if self.variant.balance == ForceLaw::PaperBalance {
            return Ok(None);
        }
        let Done {
            assembly,
            records,
            report,
        } = self.done(&self.scene_of(false)?)?;
        let last = &records[records.len() - 1];
        let certified = report.equilibrium.is_some_and(|e| {
            let counts = e.certificate;
            counts.negative == 0 && counts.unresolved == 0
        });
        Ok(Some(Newton {
            tip_drop_nm: tip_drop(&assembly, last),
            energy_pn_nm: internal_energy(&assembly, last),
            certified,
        }))
    }

    /// Lets the filament swing about its equilibrium with little drag, the same for all cases.
    fn ring_down(&self, moving: bool, equilibrium_nm: f64) -> Result<Option<RingDown>, String> {
        if !moving || !self.swings() {
            return Ok(None);
        }
        let mut scene = self.scene()?;
        let Task::Dynamics(dynamics) = &mut scene.task else {
            return Err(format!("{}: the scene asks for no dynamics", self.path()));
        };
        dynamics.drag = DragRates {
            translational_per_ns: SWING_DRAG_PER_NS,
            rotational_per_ns: SWING_DRAG_PER_NS,
        }
        .into();
        dynamics.duration_ns = SWING_NS;
        dynamics.stop = None;
        let Done {
            assembly, records, ..
        } = self.done(&scene)?;
        let approach: Vec<(f64, f64)> = records
            .iter()
            .map(|record| (record.at.value(), tip_drop(&assembly, record)))
            .collect();
        Ok(ringdown::fit(&approach, equilibrium_nm))
    }

    /// Whether the case is one of those whose frequencies are compared.
    fn swings(&self) -> bool {
        let drawn = matches!(
            self.resolved,
            Resolved::Mixed(_) | Resolved::Rod(ROD_SEGMENTS) | Resolved::Ellipsoids(0)
        );
        drawn && self.variant.swings()
    }
}

/// Distance by which the tip went along the force, towards -x (nm).
fn tip_drop(assembly: &Assembly, record: &Record) -> f64 {
    -(assembly.tip_nm(&record.state, End::End) - assembly.tip_nm(&assembly.rest, End::End)).x
}

/// Energy with the potential of the load (pN nm).
fn total_energy(record: &Record) -> f64 {
    record.potential_pn_nm() + record.kinetic_pn_nm
}

/// Energy without the potential of the load (pN nm).
fn internal_energy(assembly: &Assembly, record: &Record) -> f64 {
    let elastic: f64 = assembly
        .terms
        .iter()
        .zip(&record.energies_pn_nm)
        .filter(|(term, _)| !matches!(term.part, actin_sim::Part::Load(_)))
        .map(|(_, energy)| energy)
        .sum();
    elastic + record.kinetic_pn_nm
}

/// Time (ns) and [`internal_energy`] of every record.
fn energies(assembly: &Assembly, records: &[Record]) -> Vec<(f64, f64)> {
    let each = records.iter();
    each.map(|record| (record.at.value(), internal_energy(assembly, record)))
        .collect()
}

/// How the cases were run, in words.
pub(super) fn settings(results: &[Result4]) -> String {
    let worst = |pick: fn(&Result4) -> f64| results.iter().map(pick).fold(0.0, f64::max);
    let unfinished = results.iter().filter(|r| !r.converged).count();
    let how = if results.iter().any(|r| r.moved) {
        "damped dynamics, and equilibria by Newton's method where the preceding paper's rigidity is \
         named"
    } else {
        "equilibria by Newton's method, none of the printed balance, which has no potential"
    };
    format!(
        "Scenes scenarios/figure-4/*.ron, {} cases, {how}; at the end every force is below {:.1e} \
         pN and every torque below {:.1e} pN nm; {unfinished} case(s) ended before. Seed 0 unless \
         named; the mean filament has weighted bonds and no seed.",
        results.len(),
        worst(|r| r.residual.0),
        worst(|r| r.residual.1),
    )
}
