//! Figure 4: cantilever at seven resolutions.
//!
//! Each case is damped dynamics to a prescribed residual. A second run with less drag gives frequency and decay of the
//! first flexural mode. `--quick` computes equilibria only. Variants: the mean filament, the model as printed, and the
//! rigidity of the preceding paper.

mod pictures;

use super::draft::{Column, Draft, number, residuals};
use super::model::{Model, Resolution, models};
use super::motion::{RingDown, energy_decays, ring_down};
use super::texts::Values;
use crate::run::{Shape, doubtful, energy, residual, scenario, solved};
use crate::statistics::{largest, sample};
use actin_sim::{Assembly, DragModel, End, Equilibrium, Part, Record, Scene, Section, Task};

const LENGTH_NM: f64 = 160.0;
/// Lengths of rod (nm) in the paper and with `--quick`.
const RODS: [u32; 7] = [20, 40, 60, 80, 100, 120, 140];
const QUICK_RODS: [u32; 3] = [20, 80, 140];
/// Bond samplings of the filament of monomers.
const SEEDS: u64 = 8;
/// Numbers of segments for the extrapolation to short segments.
const REFINED: [u32; 3] = [32, 64, 128];
/// Drag rates of the oscillation (1/ns). The amplitude decays at half this rate.
const SWING_DRAG_PER_NS: f64 = 0.04;
/// Duration of the oscillation (ns), about four periods.
const SWING_NS: f64 = 150.0;
/// Force (pN), length (nm), E (pN/nm^2) and I (nm^4) of the deflection in Section 4.1 of the paper.
const PRINTED: [f64; 4] = [2.0, 160.0, 2000.0, 120.0];

#[derive(Clone, Copy, Debug)]
struct Case {
    model: &'static Model,
    resolution: Resolution,
    seed: u64,
    segments: Option<u32>,
}

#[derive(Debug)]
struct Outcome {
    case: Case,
    /// Deflection of the tip along the force (nm).
    tip_drop_nm: f64,
    /// Elastic energy at equilibrium (pN nm), by Newton's method if the loads have a potential.
    elastic_pn_nm: f64,
    /// Difference from the tip of Newton's equilibrium (nm), and stability; `None` for loads without a potential.
    newton: Option<(f64, bool)>,
    /// True for damped dynamics, false for Newton's method.
    is_moved: bool,
    /// Time (ns), and elastic plus kinetic energy (pN nm).
    energy: Vec<(f64, f64)>,
    /// Energy including the potential of the load (pN nm), by record.
    total: Vec<f64>,
    work: f64,
    ring_down: Option<RingDown>,
    shape: Shape,
    residual: [f64; 2],
    has_converged: bool,
    time_ns: f64,
    force_evaluations: u64,
}

pub(super) fn figure4(draft: &mut Draft<'_>) -> Result<(), String> {
    let quick = draft.quick;
    let outcomes = draft.solve(&cases(quick), |case| {
        let outcome = case.solve(!quick);
        outcome.map_err(|e| format!("{}: {e}", case.path()))
    })?;
    settings(draft, &outcomes)?;
    rows(draft, &outcomes);
    tables(draft, &outcomes)?;
    pictures::panels(draft, &outcomes)?;
    pictures::against_resolution(draft, &outcomes)?;
    pictures::view(draft, &outcomes)
}

fn cases(quick: bool) -> Vec<Case> {
    let rods: &[u32] = if quick { &QUICK_RODS } else { &RODS };
    let case = |model, resolution, seed, segments| Case {
        model,
        resolution,
        seed,
        segments,
    };
    let mut all = Vec::new();
    let models = models("fig4", quick);
    for &model in &models {
        let mixed = rods.iter().map(|&rod| Resolution::Mixed(rod));
        let resolutions = mixed.chain([Resolution::Rod, Resolution::Ellipsoids]);
        let own = resolutions.filter(|&r| model.solved_at(r) == model);
        all.extend(own.map(|resolution| case(model, resolution, 0, None)));
    }
    let shared = models[0];
    all.extend(REFINED.map(|n| case(shared, Resolution::Rod, 0, Some(n))));
    if !quick {
        all.extend((1..SEEDS).map(|seed| case(shared, Resolution::Ellipsoids, seed, None)));
    }
    all
}

impl Case {
    fn path(&self) -> String {
        let folder = match (&*self.model.name, self.resolution) {
            ("", Resolution::Mixed(_)) => "shared/",
            (name, _) => name,
        };
        let name = self.resolution.name();
        match (self.segments, self.seed) {
            (Some(segments), _) => format!("{folder}rod-of-{segments}-segments"),
            (None, 0) => format!("{folder}{name}"),
            (None, seed) => format!("{folder}{name}/seed-{seed}"),
        }
    }

    fn is_drawn(&self) -> bool {
        self.segments.is_none() && self.seed == 0
    }

    fn rod_nm(&self) -> f64 {
        self.resolution.rod_nm(LENGTH_NM)
    }

    /// True for cases whose first flexural mode is compared.
    fn swings(&self) -> bool {
        self.is_drawn() && (self.is_compared() || self.model.name == "paper-balance/")
    }

    /// True for the models whose work is compared.
    fn is_compared(&self) -> bool {
        ["", "mean-filament/"].contains(&&*self.model.name)
    }

    fn scene(&self) -> Result<Scene, String> {
        let file = match self.resolution {
            Resolution::Mixed(rod) => format!("rod-{rod:03}.ron"),
            other => format!("{}.ron", other.name()),
        };
        let mut scene = scenario(&format!("figure-4/{file}"))?;
        self.model.apply(&mut scene, self.seed);
        if let (Some(n), Section::Rod { segments, .. }) =
            (self.segments, &mut scene.filament.sections[0])
        {
            *segments = Some(n as usize);
        }
        Ok(scene)
    }

    /// Solves the case, by damped dynamics if `moving` and if the model allows it.
    fn solve(&self, moving: bool) -> Result<Outcome, String> {
        let scene = self.scene()?;
        // The rigidity of the preceding paper is compared in equilibrium only.
        let is_moved = moving && !self.model.is_stiff;
        let mut statics = scene.clone();
        statics.task = Task::Equilibrium(Equilibrium::default());
        let has_potential = self.model.has_potential();
        let newton = has_potential.then(|| solved(&statics)).transpose()?;
        let moved = is_moved.then(|| solved(&scene)).transpose()?;
        let solved = moved
            .as_ref()
            .or(newton.as_ref())
            .ok_or("the case has neither dynamics nor an equilibrium")?;
        let drop = tip_drop(&solved.assembly, solved.last());
        let newton = newton.as_ref().map(|n| {
            let tip = tip_drop(&n.assembly, n.last());
            let energy = internal_energy(&n.assembly, n.last());
            (energy, ((drop - tip).abs(), doubtful(n) == Some([0, 0])))
        });
        let records = solved.records().iter();
        let energies = records.map(|r| (r.at.value(), internal_energy(&solved.assembly, r)));
        let energy: Vec<(f64, f64)> = energies.collect();
        let counts = solved.assembly.counts();
        let total = |r: &Record| r.potential_pn_nm() + r.kinetic_pn_nm;
        Ok(Outcome {
            case: *self,
            tip_drop_nm: drop,
            elastic_pn_nm: newton.map_or(energy[energy.len() - 1].1, |n| n.0),
            newton: newton.map(|n| n.1),
            is_moved,
            energy,
            total: solved.records().iter().map(total).collect(),
            work: solved.outcome.force_evaluations as f64 * (counts.bonds + counts.segments) as f64,
            ring_down: self.ring_down(is_moved, &scene, drop)?,
            shape: Shape::new(solved),
            residual: residual(solved),
            has_converged: solved.outcome.has_converged(),
            time_ns: solved.last().at.value(),
            force_evaluations: solved.outcome.force_evaluations,
        })
    }

    fn ring_down(
        &self,
        is_moved: bool,
        scene: &Scene,
        equilibrium_nm: f64,
    ) -> Result<Option<RingDown>, String> {
        let mut scene = scene.clone();
        let Task::Dynamics(dynamics) = &mut scene.task else {
            return Err("the task of the scene is not `Dynamics`".into());
        };
        if !is_moved || !self.swings() {
            return Ok(None);
        }
        dynamics.drag = DragModel::rates_per_ns([SWING_DRAG_PER_NS; 2]);
        dynamics.duration_ns = SWING_NS;
        dynamics.stop = None;
        let swung = solved(&scene)?;
        let records = swung.records().iter();
        let approach: Vec<(f64, f64)> = records
            .map(|record| (record.at.value(), tip_drop(&swung.assembly, record)))
            .collect();
        Ok(ring_down(&approach, equilibrium_nm))
    }
}

fn tip_drop(assembly: &Assembly, record: &Record) -> f64 {
    -(assembly.tip_nm(&record.state, End::End) - assembly.tip_nm(&assembly.rest, End::End)).x
}

/// Energy without the potential of the load (pN nm).
fn internal_energy(assembly: &Assembly, record: &Record) -> f64 {
    let elastic = energy(assembly, record, |part| !matches!(part, Part::Load(_)));
    elastic + record.kinetic_pn_nm
}

fn settings(draft: &mut Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    let unfinished = outcomes.iter().filter(|o| !o.has_converged).count();
    let method = if outcomes.iter().any(|o| o.is_moved) {
        "damped dynamics, and equilibria by Newton's method with the rigidity of the preceding paper"
    } else {
        "equilibria by Newton's method, without the printed balance, which has no potential"
    };
    let residuals = residuals(outcomes.iter().map(|o| o.residual));
    let values: Values<'_> = &[
        ("count", &outcomes.len()),
        ("method", &method),
        ("residuals", &residuals),
        ("unfinished", &unfinished),
    ];
    draft.describe("fig4", values)
}

fn rows(draft: &mut Draft<'_>, outcomes: &[Outcome]) {
    for o in outcomes {
        let path = o.case.path();
        draft.row(format!("tip_drop/{path}"), "nm", o.tip_drop_nm, o.ending());
        let note = "elastic energy of monomers, junctions and rod at equilibrium, without the potential of the load";
        draft.row(format!("energy/{path}"), "pN nm", o.elastic_pn_nm, note);
        if let Some(ring) = o.ring_down {
            let note = format!(
                "from extrema of the tip, drag rates {SWING_DRAG_PER_NS} per ns; expected decay: half of this rate; \
                 theory for small oscillations of the rod: 0.170 rad/ns"
            );
            let frequency = ring.frequency_rad_per_ns;
            draft.row(format!("frequency/{path}"), "rad/ns", frequency, &*note);
            draft.row(format!("decay/{path}"), "1/ns", ring.decay_per_ns, note);
        }
        if o.is_moved && o.case.is_compared() {
            let note = "evaluations of bonds and segments until the stop rule is met";
            draft.row(format!("work/{path}"), "", o.work, note);
        }
    }
    for model in models("fig4", draft.quick) {
        spreads(draft, outcomes, model);
    }
    checks(draft, outcomes);
    let [force, length, modulus, inertia] = PRINTED;
    let deflection = force * length.powi(3) / (3.0 * modulus * inertia);
    draft.row("claim/printed_deflection", "nm", deflection, "");
}

impl Outcome {
    fn ending(&self) -> String {
        let end = match (self.is_moved, self.has_converged) {
            (false, _) => "by Newton's method",
            (true, true) => "stop rule met",
            (true, false) => "ended at the time limit",
        };
        format!(
            "{end} at {:.0} ns, residual {:.1e} pN and {:.1e} pN nm, {} force evaluations",
            self.time_ns, self.residual[0], self.residual[1], self.force_evaluations
        )
    }
}

/// Relative spread of tip drop and energy over the mixed resolutions.
fn spreads(draft: &mut Draft<'_>, outcomes: &[Outcome], model: &Model) {
    let of_model = outcomes.iter().filter(|o| o.case.model == model);
    let mixed: Vec<&Outcome> = of_model.filter(|o| o.case.resolution.is_mixed()).collect();
    if mixed.is_empty() {
        return;
    }
    let name = model.label("shared");
    let tips = sample(mixed.iter().map(|o| o.tip_drop_nm));
    let energies = sample(mixed.iter().map(|o| o.elastic_pn_nm));
    for (quantity, unit, s) in [
        ("tip_spread", "nm", tips),
        ("energy_spread", "pN nm", energies),
    ] {
        let note = format!(
            "(max - min)/mean over {} mixed resolutions, {:.3} to {:.3} {unit}",
            s.count, s.low, s.high
        );
        draft.row(format!("{quantity}/{name}"), "", s.spread(), note);
    }
}

fn checks(draft: &mut Draft<'_>, outcomes: &[Outcome]) {
    let shared = |resolution| {
        let own = outcomes.iter().filter(|o| o.case.model.is_shown());
        own.filter(move |o| o.case.resolution == resolution)
    };
    let rod = |segments: Option<u32>| {
        let mut own = shared(Resolution::Rod).filter(|o| o.case.segments == segments);
        own.next().map_or(f64::NAN, |o| o.tip_drop_nm)
    };
    let fine = rod(Some(128));
    // The error is proportional to the square of the segment length.
    let limit = fine + (fine - rod(Some(64))) / 3.0;
    let note = format!(
        "segments of 10 nm relative to the limit {limit:.4} nm, extrapolated from 2.5 and 1.25 nm; expected within \
         0.005"
    );
    draft.row("rod_mesh_error", "", rod(None) / limit - 1.0, note);
    let newton = || outcomes.iter().filter_map(|o| o.newton);
    let note = "largest difference of the tip between damped dynamics and Newton's method over all \
        cases, due to the stopping residual or to a second equilibrium nearby";
    let difference = largest(newton().map(|(difference, _)| difference));
    draft.row("newton_difference/largest", "nm", difference, note);
    let unstable = newton().filter(|(_, is_stable)| !is_stable).count();
    let note = "equilibria of Newton's method whose stiffness is not positive definite";
    draft.row("not_certified_stable", "", unstable as f64, note);
    let drops = sample(shared(Resolution::Ellipsoids).map(|o| o.tip_drop_nm));
    if drops.count > 1 {
        let note = format!(
            "{} seeds of the bonds, 64 independent bonds per interface",
            drops.count
        );
        draft.row("tip_drop/ellipsoids/mean", "nm", drops.mean, &*note);
        draft.row("tip_drop/ellipsoids/sd", "nm", drops.sd(), note);
    }
    let moved = outcomes.iter().filter(|o| o.is_moved && o.newton.is_some());
    let totals: Vec<Vec<f64>> = moved.map(|o| o.total.clone()).collect();
    energy_decays(draft, &totals);
}

fn tables(draft: &Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    let places = |keep: fn(&Outcome) -> &Vec<[f64; 3]>| {
        outcomes
            .iter()
            .map(move |o| (vec![o.case.path()], keep(o).clone()))
    };
    let header = ["case", "x_nm", "y_nm", "z_nm"];
    draft.curves("fig4_centre_lines.csv", &header, places(|o| &o.shape.line))?;
    draft.curves("fig4_monomers.csv", &header, places(|o| &o.shape.monomers))?;
    let energies = outcomes.iter().map(|o| {
        let energy = o.energy.iter().map(|&(t, e)| [t, e]);
        (vec![o.case.path()], energy.collect())
    });
    draft.curves(
        "fig4_energy.csv",
        &["case", "time_ns", "energy_pn_nm"],
        energies,
    )?;
    draft.table("fig4.csv", outcomes, &COLUMNS)
}

const COLUMNS: [Column<Outcome>; 7] = [
    ("case", |o| o.case.path()),
    ("tip_drop_nm", |o| number(o.tip_drop_nm)),
    ("energy_pn_nm", |o| number(o.elastic_pn_nm)),
    ("residual_pn", |o| number(o.residual[0])),
    ("residual_pn_nm", |o| number(o.residual[1])),
    ("time_ns", |o| number(o.time_ns)),
    ("force_evaluations", |o| o.force_evaluations.to_string()),
];
