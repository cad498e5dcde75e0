//! Rows and tables of Figures 5 and 6.

use super::Figure;
use super::solve::{Balance, Motion, Outcome, SAME_PN_NM};
use crate::figures::draft::{Column, Draft, number, residuals, text};
use crate::figures::expected::Holds;
use crate::figures::model::{Model, models};
use crate::figures::motion::energy_decays;
use crate::figures::texts::Values;
use crate::statistics::{SampleStatistics, largest, sample};

#[derive(Debug)]
struct Spread {
    energy: SampleStatistics,
    /// Largest distance between two centre lines at equal arc length (nm), and description of its location.
    node: f64,
    farthest: String,
    /// Largest relative spread of the force of a linker.
    force: f64,
}

type Pick = fn(&Spread) -> f64;

impl Spread {
    /// Spread of one model and seed over the mixed resolutions, with the pure ones if `with_pure`.
    fn new(outcomes: &[Outcome], model: &Model, seed: u64, with_pure: bool) -> Self {
        let own = outcomes
            .iter()
            .filter(|o| o.case.model == model && o.case.seed == seed);
        let chosen: Vec<(String, &Balance)> = own
            .filter(|o| with_pure || o.case.resolution.is_mixed())
            .map(|o| (o.case.resolution.name(), &o.lowest))
            .collect();
        let linkers = 0..chosen[0].1.forces.len();
        let forces = linkers.map(|k| sample(chosen.iter().map(|(_, b)| b.forces[k])).spread());
        let (node, farthest) = farthest(&chosen);
        Self {
            energy: sample(chosen.iter().map(|(_, b)| b.energy)),
            node,
            farthest,
            force: largest(forces),
        }
    }

    fn over_seeds(outcomes: &[Outcome], model: &Model) -> Vec<Self> {
        let seeds = 0..model.seeds(seeds(outcomes));
        seeds
            .map(|seed| Self::new(outcomes, model, seed, false))
            .collect()
    }

    fn energies(&self) -> String {
        format!("{:.2} to {:.2} pN nm", self.energy.low, self.energy.high)
    }
}

/// Largest distance between two centre lines (nm), and its description.
fn farthest(chosen: &[(String, &Balance)]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (i, (one, a)) in chosen.iter().enumerate() {
        for (other, b) in &chosen[..i] {
            let (distance, s) = a.centre_line.farthest_from(&b.centre_line);
            if distance > worst.0 {
                worst = (distance, format!("{other} and {one} at s = {s:.0} nm"));
            }
        }
    }
    worst
}

fn seeds(outcomes: &[Outcome]) -> u64 {
    outcomes.iter().map(|o| o.case.seed + 1).max().unwrap_or(0)
}

pub(super) fn rows(draft: &mut Draft<'_>, outcomes: &[Outcome]) {
    for model in models("linkers", false) {
        spreads(draft, outcomes, model);
    }
    with_pure(draft, outcomes);
    for o in outcomes.iter().filter(|o| o.case.seed == 0) {
        let found = &o.lowest;
        let note = format!(
            "including {:.2} in the linkers; {} Newton iterations, residual {:.1e} pN and {:.1e} pN nm, lowest \
             eigenvalue {:.1e} pN/nm",
            found.linkers,
            found.iterations,
            found.residual[0],
            found.residual[1],
            found.lowest.unwrap_or(f64::NAN)
        );
        let quantity = format!("energy{}/{}", o.case.model.name, o.case.resolution.name());
        draft.row(quantity, "pN nm", found.energy, note);
    }
    evidence(draft, outcomes);
    motions(draft, outcomes);
}

fn spreads(draft: &mut Draft<'_>, outcomes: &[Outcome], model: &Model) {
    let all = Spread::over_seeds(outcomes, model);
    let (first, words) = (&all[0], &model.words);
    let (count, energies) = (first.energy.count, first.energies());
    let energy = format!("(max - min)/mean over {count} mixed resolutions, {energies}");
    let node = format!("largest between {}", first.farthest);
    let force = "largest (max - min)/mean of the force of a linker".to_owned();
    let picks: [(&str, &str, Pick, String); 3] = [
        ("energy_spread", "", |s| s.energy.spread(), energy),
        ("node_spread", "nm", |s| s.node, node),
        ("linker_force_spread", "", |s| s.force, force),
    ];
    for (name, unit, pick, note) in picks {
        let quantity = format!("{name}{}", model.name);
        draft.row(&*quantity, unit, pick(first), format!("{note}; {words}"));
        if !model.is_mean {
            let s = sample(all.iter().map(pick));
            let note = format!(
                "{} samplings of the bonds, sd {:.4}; {words}",
                s.count,
                s.sd()
            );
            draft.row(format!("{quantity}/mean"), unit, s.mean, note);
        }
    }
}

fn with_pure(draft: &mut Draft<'_>, outcomes: &[Outcome]) {
    let all = Spread::new(outcomes, outcomes[0].case.model, 0, true);
    let note = format!("pure rod and pure monomers included; {}", all.energies());
    draft.row("energy_spread/with-pure", "", all.energy.spread(), note);
    let note = format!("between {}", all.farthest);
    draft.row("node_spread/with-pure", "nm", all.node, note);
    let standard = outcomes.iter().filter(|o| o.case.is_drawn());
    let rolls = sample(standard.map(|o| o.lowest.roll));
    let note = "rotation of the body with the second linker relative to the built state, over all mixed resolutions \
                and the pure cases";
    draft.row("roll/least", "deg", rolls.low, note);
    draft.row("roll/most", "deg", rolls.high, note);
}

fn evidence(draft: &mut Draft<'_>, outcomes: &[Outcome]) {
    let of = format!("of {} filaments", outcomes.len());
    let unstable = outcomes.iter().filter(|o| !o.lowest.is_stable).count();
    let note = format!("{of}: equilibria whose stiffness is not positive definite");
    draft.row("not_certified_stable", "", unstable as f64, note);
    let above = outcomes
        .iter()
        .map(|o| largest(o.starts.iter().map(|e| e - o.lowest.energy)));
    let above: Vec<f64> = above.collect();
    let several = above.iter().filter(|above| **above > SAME_PN_NM).count();
    let note = format!(
        "{of}: filaments whose starts, rotated by 0, 90, 180 and 270 deg, reach energies more than {SAME_PN_NM} \
         pN nm apart"
    );
    draft.row("several_equilibria", "", several as f64, note);
    let note = "largest energy of an equilibrium relative to the lowest one of its filament";
    draft.row("highest_equilibrium", "pN nm", largest(above), note);
}

fn moved(outcomes: &[Outcome]) -> impl Iterator<Item = (&Outcome, &Motion)> {
    outcomes
        .iter()
        .filter_map(|o| Some((o, o.motion.as_ref()?)))
}

fn motions(draft: &mut Draft<'_>, outcomes: &[Outcome]) {
    let count = moved(outcomes).count();
    if count == 0 {
        return;
    }
    let above = |m: &Motion| m.energy[m.energy.len() - 1][1] - m.limit.energy;
    let difference = largest(moved(outcomes).map(|(_, m)| above(m).abs()));
    let unfinished = moved(outcomes).filter(|(_, m)| !m.has_converged).count();
    let note = format!(
        "largest difference between the end of damped dynamics and the certified equilibrium that Newton's \
         method reaches from there, {count} motions; {unfinished} ended at the time limit, all others by the stop rule"
    );
    draft.row("newton_difference/energy", "pN nm", difference, &*note);
    let nodes = moved(outcomes).map(|(_, m)| m.from_limit_nm);
    draft.row("newton_difference/node", "nm", largest(nodes), note);
    let elsewhere = moved(outcomes).filter(|(o, m)| m.limit.energy > o.lowest.energy + SAME_PN_NM);
    let elsewhere = elsewhere.count() as f64;
    let note = format!("of {count} motions: motions that do not end in the lowest equilibrium");
    draft.row("motions_to_a_higher_equilibrium", "", elsewhere, note);
    let energies = moved(outcomes).map(|(_, m)| m.energy.iter().map(|e| e[1]).collect());
    energy_decays(draft, &energies.collect::<Vec<_>>());
}

/// Claims that deviations of shape and energy are larger in Figure 6 than in Figure 5. Models of the paper have
/// verdicts, with energies in pN nm as in Figure 6(c).
pub(super) fn larger_claims(draft: &mut Draft<'_>, figures: [&[Outcome]; 2]) {
    let shape = "deviations of shape are more noticeable";
    let range = "energies vary more (in pN nm)";
    let spread = "energies vary more (relative to the mean)";
    let claims: [(&str, &str, Pick); 3] = [
        ("node_spread", shape, |s| s.node),
        ("energy_range", range, |s| s.energy.range()),
        ("energy_spread", spread, |s| s.energy.spread()),
    ];
    for model in models("linkers", false) {
        let spreads = figures.map(|outcomes| Spread::over_seeds(outcomes, model));
        for (name, words, pick) in claims {
            let [here, there] = [&spreads[0], &spreads[1]].map(|s| sample(s.iter().map(pick)));
            let statement = format!(
                "{words} than in Figure 5. Means over {} samplings: {:.4} (sd {:.4}) here, {:.4} (sd {:.4}) there; {}",
                here.count,
                here.mean,
                here.sd(),
                there.mean,
                there.sd(),
                model.words
            );
            let is_judged = ["", "/full"].contains(&&*model.name) && name != "energy_spread";
            let bound = is_judged.then_some((Holds::AtLeast, 1.0));
            let quantity = format!("{name}_over_fig5{}", model.name);
            draft.claim(&quantity, here.mean / there.mean, bound, statement);
        }
    }
}

pub(super) fn settings(
    figure: &Figure,
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    let residuals = residuals(outcomes.iter().map(|o| o.lowest.residual));
    let values: Values<'_> = &[
        ("file", &figure.file),
        ("count", &outcomes.len()),
        ("seeds", &seeds(outcomes)),
        ("residuals", &residuals),
    ];
    draft.describe("linkers", values)
}

const COLUMNS: [Column<Outcome>; 13] = [
    ("case", |o| o.case.resolution.name()),
    ("variant", |o| o.case.model.label("standard")),
    ("seed", |o| o.case.seed.to_string()),
    ("energy_pn_nm", |o| number(o.lowest.energy)),
    ("linkers_pn_nm", |o| number(o.lowest.linkers)),
    ("stable", |o| o.lowest.is_stable.to_string()),
    ("lowest_eigenvalue_pn_per_nm", |o| {
        text(o.lowest.lowest.map(number))
    }),
    ("newton_iterations", |o| o.lowest.iterations.to_string()),
    ("roll_deg", |o| format!("{:.3}", o.lowest.roll)),
    ("energies_by_start_pn_nm", |o| {
        let starts: Vec<String> = o.starts.iter().map(|e| format!("{e:.6}")).collect();
        starts.join(" ")
    }),
    ("motion_limit_pn_nm", |o| {
        of_motion(o, |m| number(m.limit.energy))
    }),
    ("motion_time_ns", |o| {
        of_motion(o, |m| format!("{:.2}", m.time_ns))
    }),
    ("motion_force_evaluations", |o| {
        of_motion(o, |m| m.force_evaluations.to_string())
    }),
];

fn of_motion(outcome: &Outcome, cell: fn(&Motion) -> String) -> String {
    text(outcome.motion.as_ref().map(cell))
}

pub(super) fn tables(draft: &Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    let file = |name: &str| format!("{}{name}.csv", draft.id);
    draft.table(&file(""), outcomes, &COLUMNS)?;
    let lines = outcomes.iter().map(|o| {
        let line = &o.lowest.centre_line;
        let points = line.arc_lengths().iter().zip(line.points());
        let case = &o.case;
        (
            vec![
                case.resolution.name(),
                case.model.label("standard"),
                case.seed.to_string(),
            ],
            points.map(|(s, [x, y, z])| [*s, *x, *y, *z]).collect(),
        )
    });
    let header = ["case", "variant", "seed", "s_nm", "x_nm", "y_nm", "z_nm"];
    draft.curves(&file("_centre_lines"), &header, lines)?;
    let energies = moved(outcomes).map(|(o, m)| (vec![o.case.resolution.name()], m.energy.clone()));
    let header = ["case", "time_ns", "total_pn_nm", "potential_pn_nm"];
    draft.curves(&file("_energy"), &header, energies)
}
