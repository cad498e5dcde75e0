//! Figure 7: filament clamped at both ends and turned in its middle by a linker.
//!
//! Both halves of a rod store the same energy. The over-twisted half of a filament of monomers stores more. Variants:
//! the mean filament, and a rod with the energy of the supplement, which couples stretch and twist.

use super::charts::{line, room};
use super::draft::{Column, Draft, number, residuals};
use super::texts::ChartText;
use crate::palette;
use crate::run::{doubtful, energy, pose, residual, scenario, solved};
use crate::statistics::{largest, sample};
use actin_draw::{Colour, Mark, Series};
use actin_sim::shape::{Ribbon, profile};
use actin_sim::{Assembly, FreeTranslation, Hold, Monomers, Part, RodLaw, Scene};
use actin_view::Pose;

/// Samplings of the bonds, by default and with `--quick`. Each is pulled in both directions.
const SEEDS: u64 = 16;
const QUICK_SEEDS: u64 = 4;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FilamentResolution {
    /// 19 segments with constant rigidities and a type of clamp.
    Rod(Hold),
    /// Rod with the energy of the supplement, which couples stretch and twist.
    CoupledRod(Hold),
    /// 67 monomers with this number of sampled bonds per interface.
    Ellipsoids(usize),
    /// Mean filament: 67 monomers with quadrature bonds.
    Mean,
}

use FilamentResolution::{CoupledRod, Ellipsoids, Mean, Rod};

/// Name in quantities and number of ends that slide along the axis. The linker constrains the middle along the axis:
/// with one sliding end, the other half stays in tension.
const SLIDING: [(&str, usize); 3] = [("", 0), ("far-end-slides/", 1), ("both-ends-slide/", 2)];

const KINDS: [(&str, FilamentResolution); 7] = [
    ("rod", Rod(Hold::TwoNodesAndFrame)),
    ("wall/rod", Rod(Hold::Wall)),
    ("coupling-energy/rod", CoupledRod(Hold::TwoNodesAndFrame)),
    ("coupling-energy/wall/rod", CoupledRod(Hold::Wall)),
    ("ellipsoid", Ellipsoids(64)),
    ("bonds-32/ellipsoid", Ellipsoids(32)),
    ("mean-filament/ellipsoid", Mean),
];

#[derive(Clone, Debug)]
struct Case {
    kind: String,
    resolved: FilamentResolution,
    sliding: usize,
    seed: u64,
    /// The linker turns the middle in the opposite direction.
    is_reversed: bool,
}

#[derive(Clone, Debug)]
struct Halves {
    case: Case,
    over_pn_nm: f64,
    under_pn_nm: f64,
    /// Rotation of the middle about the axis, in the direction of the pull (deg).
    turn_deg: f64,
    pull_pn: f64,
    /// Tension at the first end without sliding (pN); zero if both ends slide.
    tension_pn: f64,
    /// Number of negative and unresolved eigenvalues of the stiffness.
    doubtful: usize,
    residual: [f64; 2],
    /// Arc length from the middle towards the over-twisted half (nm), and energy per length (pN).
    profile: Vec<[f64; 2]>,
    pose: Pose,
}

impl Halves {
    fn ratio(&self) -> f64 {
        self.over_pn_nm / self.under_pn_nm
    }
}

pub(super) fn figure7(draft: &mut Draft<'_>) -> Result<(), String> {
    let cases = cases(if draft.quick { QUICK_SEEDS } else { SEEDS });
    let results = draft.solve(&cases, |case| {
        case.solve().map_err(|e| format!("{}: {e}", case.kind))
    })?;
    let residuals = residuals(results.iter().map(|h| h.residual));
    draft.describe(
        "fig7",
        &[("count", &results.len()), ("residuals", &residuals)],
    )?;
    rows(draft, &results);
    tables(draft, &results)?;
    picture(draft, &results)?;
    view(draft, &results)
}

/// All kinds with zero, one or two sliding ends. Filaments of monomers are pulled in both directions.
fn cases(seeds: u64) -> Vec<Case> {
    let mut all = Vec::new();
    for (slides, sliding) in SLIDING {
        for (kind, resolved) in KINDS {
            let (seeds, directions): (u64, &[bool]) = match resolved {
                Rod(_) | CoupledRod(_) => (1, &[false]),
                Ellipsoids(_) => (seeds, &[false, true]),
                Mean => (1, &[false, true]),
            };
            for seed in 0..seeds {
                all.extend(directions.iter().map(|&is_reversed| Case {
                    kind: format!("{slides}{kind}"),
                    resolved,
                    sliding,
                    seed,
                    is_reversed,
                }));
            }
        }
    }
    all
}

impl Case {
    fn scene(&self) -> Result<Scene, String> {
        let mut scene = scenario(match self.resolved {
            Rod(_) | CoupledRod(_) => "figure-7/rod.ron",
            _ => "figure-7/ellipsoids.ron",
        })?;
        if let Rod(hold) | CoupledRod(hold) = self.resolved {
            scene.clamps.iter_mut().for_each(|clamp| clamp.hold = hold);
        }
        let filament = &mut scene.filament;
        match self.resolved {
            Rod(_) => {}
            CoupledRod(_) => filament.rod.law = RodLaw::CouplingEnergy,
            Mean => filament.monomers = Monomers::default(),
            Ellipsoids(bonds) => {
                filament.monomers.seed = self.seed;
                filament.monomers.lateral_bonds = bonds;
                filament.monomers.longitudinal_bonds = bonds;
            }
        }
        for clamp in scene.clamps.iter_mut().rev().take(self.sliding) {
            clamp.slides = FreeTranslation::AlongAxis;
        }
        if self.is_reversed {
            let linkers = scene.linkers.iter_mut();
            let anchors = linkers.filter_map(|linker| linker.displaced_nm.as_mut());
            anchors.flatten().for_each(|v| *v = -*v);
        }
        Ok(scene)
    }

    fn solve(&self) -> Result<Halves, String> {
        let mut solved = solved(&self.scene()?)?;
        let loads = solved.assembly.system.loads().clone();
        let assembly = &solved.assembly;
        let clamp = assembly
            .clamps
            .iter()
            .find(|c| c.slides == FreeTranslation::Nowhere);
        let tension = clamp.map_or(0.0, |c| -c.reaction(solved.state(), &loads).force_pn.z);
        let energy = energy(&solved.assembly, solved.last(), |part| {
            matches!(part, Part::Linker(_))
        });
        let stiffness = assembly.scene.linkers[0].stiffness_pn_per_nm;
        let turn_deg = turn_of_middle(assembly).to_degrees();
        let ([first, second], profile) = halves(assembly, turn_deg.signum());
        let (over, under) = if turn_deg > 0.0 {
            (first, second)
        } else {
            (second, first)
        };
        Ok(Halves {
            case: self.clone(),
            over_pn_nm: over,
            under_pn_nm: under,
            turn_deg: turn_deg.abs(),
            pull_pn: (2.0 * stiffness * energy).sqrt(),
            tension_pn: tension,
            doubtful: doubtful(&solved)
                .ok_or("the equilibrium has no certificate of stability")?
                .iter()
                .sum(),
            residual: residual(&solved),
            profile,
            pose: pose(&solved),
        })
    }
}

/// Rotation of the middle frame about lab z (rad).
fn turn_of_middle(assembly: &Assembly) -> f64 {
    let middle = 0.5 * assembly.length_nm();
    let distance = |i: usize| (assembly.frames[i].s_nm - middle).abs();
    let frames = 0..assembly.frames.len();
    let nearest = frames.min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    let i = nearest.unwrap_or_default();
    let now = assembly.system.state().frames.orientation.get(i);
    let turn = now * assembly.rest.frames.orientation.get(i).inverse();
    2.0 * turn.k.atan2(turn.w)
}

/// Elastic energies of the first and the second half (pN nm), and profile of energy per length. The over-twisted half,
/// which is the first one for positive `sign`, has positive abscissae.
fn halves(assembly: &Assembly, sign: f64) -> ([f64; 2], Vec<[f64; 2]>) {
    let state = assembly.system.state();
    let points = profile(assembly, state);
    let ribbon = Ribbon::new(assembly, state);
    let mut cells = vec![points[0].s_nm];
    cells.extend(&ribbon.frame_s_nm);
    cells.push(points[points.len() - 1].s_nm);
    let middle = 0.5 * assembly.length_nm();
    let mut energies = [0.0; 2];
    for (point, cell) in points.iter().zip(cells.windows(2)) {
        let half = usize::from(0.5 * (cell[0] + cell[1]) > middle);
        energies[half] += point.energy_per_length_pn * (cell[1] - cell[0]);
    }
    let along = points.iter();
    let along = along.map(|p| [sign * (middle - p.s_nm), p.energy_per_length_pn]);
    let mut along: Vec<[f64; 2]> = along.collect();
    along.sort_by(|a, b| a[0].total_cmp(&b[0]));
    (energies, along)
}

type Quantity = (&'static str, &'static str, fn(&Halves) -> f64);

const QUANTITIES: [Quantity; 6] = [
    ("half_energy_ratio", "", Halves::ratio),
    ("half_energy_excess", "pN nm", |h| {
        h.over_pn_nm - h.under_pn_nm
    }),
    ("energy", "pN nm", |h| h.over_pn_nm + h.under_pn_nm),
    ("turn", "deg", |h| h.turn_deg),
    ("pull", "pN", |h| h.pull_pn),
    ("tension", "pN", |h| h.tension_pn),
];

fn rows(draft: &mut Draft<'_>, results: &[Halves]) {
    for halves in results.chunk_by(|a, b| a.case.kind == b.case.kind) {
        let case = &halves[0].case;
        for (name, unit, of) in QUANTITIES {
            let s = sample(halves.iter().map(of));
            let samplings = match case.resolved {
                Ellipsoids(_) => "samplings, ",
                _ => "",
            };
            let note = match s.count {
                1 => "one equilibrium".into(),
                n => format!(
                    "mean over {n} ({samplings}both directions), sd {:.4}, standard error {:.4}, range {:.4} to {:.4}",
                    s.sd(),
                    s.sd() / (n as f64).sqrt(),
                    s.low,
                    s.high
                ),
            };
            draft.scattered(
                format!("{name}/{}", case.kind),
                unit,
                (s.mean, s.sd()),
                note,
            );
        }
    }
    let doubtful = results.iter().filter(|r| r.doubtful > 0).count();
    let note = format!("of {} equilibria", results.len());
    draft.row("not_certified_stable", "", doubtful as f64, note);
}

const COLUMNS: [Column<Halves>; 12] = [
    ("kind", |h| h.case.kind.clone()),
    ("seed", |h| h.case.seed.to_string()),
    ("reversed", |h| h.case.is_reversed.to_string()),
    ("over_twisted_half_pn_nm", |h| number(h.over_pn_nm)),
    ("under_twisted_half_pn_nm", |h| number(h.under_pn_nm)),
    ("ratio", |h| number(h.ratio())),
    ("turn_deg", |h| number(h.turn_deg)),
    ("pull_pn", |h| number(h.pull_pn)),
    ("tension_pn", |h| number(h.tension_pn)),
    ("not_positive_eigenvalues", |h| h.doubtful.to_string()),
    ("residual_pn", |h| number(h.residual[0])),
    ("residual_pn_nm", |h| number(h.residual[1])),
];

fn tables(draft: &Draft<'_>, results: &[Halves]) -> Result<(), String> {
    draft.table("fig7.csv", results, &COLUMNS)?;
    let profiles = results.iter().map(|h| {
        let case = &h.case;
        let names = [
            case.kind.clone(),
            case.seed.to_string(),
            case.is_reversed.to_string(),
        ];
        (names.into(), h.profile.clone())
    });
    let header = [
        "kind",
        "seed",
        "reversed",
        "s_from_middle_nm",
        "energy_per_length_pn",
    ];
    draft.curves("fig7_profile.csv", &header, profiles)
}

fn picture(draft: &mut Draft<'_>, results: &[Halves]) -> Result<(), String> {
    let curve = |label: &str, colour: Colour, kind: &str| -> Series {
        let own = results.iter().filter(|h| h.case.kind == kind);
        line(label, colour, mean_profile(&own.collect::<Vec<_>>()))
    };
    let [monomers, sliding, rod] = [0.0, 0.4, 1.0].map(palette::resolution);
    let mut series = vec![
        curve("rod", rod, "rod"),
        curve("rod, C3 energy", palette::line(4), "coupling-energy/rod"),
        curve("ellipsoids", monomers, "ellipsoid"),
        curve(
            "ellipsoids, both ends slide",
            sliding,
            "both-ends-slide/ellipsoid",
        ),
    ];
    let values = series.iter().flat_map(|s| s.points.iter().map(|p| p.1));
    let top = 1.4 * largest(values);
    series.push(room((0.0, top)));
    series.push(Series {
        mark: Mark::Dashes,
        ..curve("mean filament", palette::DATA, "mean-filament/ellipsoid")
    });
    draft.plot(
        "fig7_energy.svg",
        &ChartText::new("fig7_energy", &[])?,
        series,
    )
}

/// Mean of profiles with equal abscissae.
fn mean_profile(halves: &[&Halves]) -> Vec<(f64, f64)> {
    let places = halves.first().map_or(0, |first| first.profile.len());
    let mean = |i: usize| sample(halves.iter().map(|h| h.profile[i][1])).mean;
    (0..places)
        .map(|i| (halves[0].profile[i][0], mean(i)))
        .collect()
}

fn view(draft: &mut Draft<'_>, results: &[Halves]) -> Result<(), String> {
    let shown = [("rod", 1.0), ("ellipsoid", 0.0)];
    let shown = shown.into_iter().filter_map(|(kind, share)| {
        let first = results.iter().find(|h| h.case.kind == kind)?;
        let group = "both ends clamped".to_owned();
        Some((group, kind.into(), share, first.pose.clone()))
    });
    draft.view("fig7", "fig7", shown)
}
