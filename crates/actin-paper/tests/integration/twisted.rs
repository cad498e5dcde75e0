//! Rods and mixed filaments under twist with free length, simulated from scenes.

use actin_mechanics::{Loads, State, rotation};
use actin_paper::measure::{SampleStatistics, Specimen, twist};
use actin_sim::{
    Assembly, BodyKind, Outcome, Plan, Resolution, RodLaw, RodModel, Scene, Trajectory,
    rod_constants,
};

/// `B3(kappa)` (pN nm^2) and `xi - 1` at a twist (rad/nm).
type Formula = fn(f64) -> (f64, f64);

/// Published law.
fn published(k: f64) -> (f64, f64) {
    let law = actin_sim::cosserat::TanhTwist::published();
    let (plus, minus) = (law.b_plus, law.b_minus);
    let [l1, l2, l3, l4, l5, l6, l7] = law.lambda;
    let (mean, half) = (0.5 * (plus + minus), 0.5 * (plus - minus));
    let well = ((k - l4) / l5).tanh() - ((k + l6) / l7).tanh();
    let b3 = mean + half * ((k + l1) / l2).tanh() + l3 * mean * well;
    let coefficients = rod_constants::XI_COEFFICIENTS.iter().rev();
    (b3, coefficients.fold(0.0, |sum, p| sum * k + p))
}

/// Law `Fitted`, from the numbers of its scene.
fn fitted(k: f64) -> (f64, f64) {
    let laws = actin_sim::fitted_laws();
    let Some(actin_sim::TwistLaw::Sided(twist)) = laws.twist else {
        panic!("the law of twist is not of the form Sided");
    };
    let Some(actin_sim::TwistStretchLaw::Rooted(length)) = laws.twist_stretch else {
        panic!("the law of length against twist is not of the form Rooted");
    };
    let side = if k < 0.0 { twist.under } else { twist.over };
    let gained = k * k / (k * k + side.slow * k.abs() + side.half.powi(2));
    let root = (k * k + length.half * length.half).sqrt() - length.half;
    let extension = length.slope * k - length.bend * root + length.cubic * k.powi(3);
    (twist.rest + side.rise * gained, extension)
}

/// A rod under uniform twist has the torque `B3(k) k` at both ends and is longer by `L (xi - 1)`.
#[test]
fn a_twisted_rod_has_the_torque_and_length_of_its_law() {
    let laws: [(RodLaw, Formula); 2] = [
        (RodLaw::PublishedExtension, published),
        (RodLaw::Fitted, fitted),
    ];
    for (law, formula) in laws {
        let rod = RodModel::with_law(law);
        let mut specimen = Specimen::rod(75.0, None, rod);
        (specimen.solver.force_pn, specimen.solver.torque_pn_nm) = (1e-9, 1e-9);
        let turns = [-190.0, -90.0, -30.0, 30.0, 90.0, 190.0];
        let curve = twist(&specimen, &turns).unwrap();
        assert!(curve.unreached.is_empty());
        for point in &curve.points {
            let k = point.curvature_rad_per_nm;
            let (b3, extension) = formula(k);
            let couple = point.torque_pn_nm / (b3 * k) - 1.0;
            let near = point.near_torque_pn_nm / (b3 * k) + 1.0;
            let length = point.relative_length_change - extension;
            // Residuals of 1e-9 pN nm relative to 10 pN nm and more; of 1e-9 pN relative to S3.
            assert!(
                couple.abs() < 1e-9 && near.abs() < 1e-9,
                "{couple:e} {near:e}"
            );
            assert!(length.abs() < 1e-12, "{length:e}");
        }
    }
}

fn build(text: &str) -> Assembly {
    let scene = Scene::from_ron(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    Assembly::build(&scene).unwrap_or_else(|problem| panic!("{problem}\n{text}"))
}

/// Runs an assembly to its end.
fn run(assembly: &mut Assembly) -> (Trajectory, Outcome) {
    let ran = Plan::new(assembly).unwrap().run();
    let (trajectory, outcome) = ran.unwrap_or_else(|error| panic!("{error}"));
    *assembly.system.state_mut() = trajectory.records.last().unwrap().state.clone();
    (trajectory, outcome)
}

/// A filament of 150 nm with a sliding far end, turned by `turns_deg`, one stage for each.
fn scene(sections: &str, law: &str, weight: &str, turns_deg: &[f64]) -> String {
    let stage =
        |turn: &f64| format!("Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, {turn:?}))])");
    let stages = turns_deg.iter().map(stage).collect::<Vec<_>>().join(", ");
    format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                rod: RodModel(law: {law}),
                junction: JunctionModel(weight: {weight}),
            ),
            clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
            path: [{stages}],
            task: Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9, largest_step: 1.0),
        )"
    )
}

const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 150.0)";
const MIXED: [(&str, &str); 2] = [
    (
        "E-R",
        "Ellipsoids(from_nm: 0.0, to_nm: 75.0), Rod(from_nm: 75.0, to_nm: 150.0)",
    ),
    (
        "R-E-R",
        "Rod(from_nm: 0.0, to_nm: 40.0), Ellipsoids(from_nm: 40.0, to_nm: 110.0),
         Rod(from_nm: 110.0, to_nm: 150.0)",
    ),
];

/// Torques about the axis at the two ends (pN nm).
fn couples(assembly: &Assembly, state: &State) -> [f64; 2] {
    let mut loads = Loads::zeros(state);
    for interaction in assembly.system.interactions() {
        interaction.add_loads(state, &mut loads);
    }
    [0, 1].map(|end| {
        let reaction = assembly.clamps[end].reaction(state, &loads);
        reaction.torque_pn_nm.z
    })
}

/// Arc length (nm) and turn about the axis since rest (rad) of all frames of a kind.
fn turns(assembly: &Assembly, state: &State, kind: BodyKind) -> Turns {
    let q = |state: &State, i: usize| state.frames.orientation.get(i);
    (0..assembly.frames.len())
        .filter(|&i| assembly.frames[i].kind == kind)
        .map(|i| {
            let turn = q(state, i) * q(&assembly.rest, i).inverse();
            (assembly.frames[i].s_nm, rotation::log(turn).z)
        })
        .collect()
}

/// A fully resolved filament under twist of one sign: torques, and turns of its monomers.
struct Resolved(Vec<(f64, Turns)>);

/// Pairs of arc length (nm) and turn (rad).
type Turns = Vec<(f64, f64)>;

impl Resolved {
    fn new(sign: f64) -> Self {
        let angles: Vec<f64> = (10..=34).map(|k| sign * 5.0 * f64::from(k)).collect();
        let mut assembly = build(&scene(MONOMERS, "Constant", "Shared", &angles));
        let (trajectory, _) = run(&mut assembly);
        let ends = trajectory
            .records
            .iter()
            .filter(|r| r.at.value() > 0.5 && r.at.value().fract() == 0.0);
        Self(
            ends.map(|r| {
                let couple = couples(&assembly, &r.state)[1];
                (couple, turns(&assembly, &r.state, BodyKind::Monomer))
            })
            .collect(),
        )
    }

    /// Turns of the monomers at the torque `couple`, by interpolation.
    fn under(&self, couple: f64) -> Turns {
        let after = self.0.iter().position(|(c, _)| c.abs() > couple.abs());
        let after = after.expect("the filament is turned far enough");
        let (a, b) = (&self.0[after - 1], &self.0[after]);
        let share = (couple - a.0) / (b.0 - a.0);
        let pairs = a.1.iter().zip(&b.1);
        pairs
            .map(|(a, b)| (a.0, a.1 + share * (b.1 - a.1)))
            .collect()
    }
}

/// Linear interpolation of turns at arc length `s`.
fn at(turns: &[(f64, f64)], s: f64) -> f64 {
    let after = turns.iter().position(|t| t.0 > s).unwrap();
    let (a, b) = (turns[after - 1], turns[after]);
    a.1 + (b.1 - a.1) * (s - a.0) / (b.0 - a.0)
}

/// Twist and turn in the neighbourhood of a junction.
#[derive(Clone, Copy)]
struct Crossing {
    /// Twist of the rod, and of the same monomers in the resolved filament (rad/nm).
    rod: f64,
    monomers: f64,
    /// Length of rod with the missing turn (nm).
    missing: f64,
}

/// Length of monomers next to the junction that is compared (nm): 10 rises.
const REACH: f64 = 27.385;

impl Crossing {
    /// The junction at arc length `boundary`. The reference turn between a monomer at the distance
    /// [`REACH`] and the second segment is the turn of the same monomers in `resolved` at the same
    /// torque, continued by a uniform rod. `missing` is the difference.
    fn new(assembly: &Assembly, boundary: f64, rod_first: bool, resolved: &[(f64, f64)]) -> Self {
        let state = assembly.system.state();
        let mut segments = turns(assembly, state, BodyKind::Segment);
        segments.sort_by(|a, b| (a.0 - boundary).abs().total_cmp(&(b.0 - boundary).abs()));
        let (second, third) = (segments[1], segments[2]);
        let rod = (third.1 - second.1) / (third.0 - second.0);
        let side = if rod_first { 1.0 } else { -1.0 };
        let far = boundary + side * REACH;
        let resolved_turn = side * (at(resolved, far) - at(resolved, boundary));
        let monomers = turns(assembly, state, BodyKind::Monomer);
        let found = side * (at(&monomers, far) - second.1);
        let expected = resolved_turn + rod * (second.0 - boundary).abs();
        Self {
            rod,
            monomers: resolved_turn / REACH,
            missing: (expected - found) / rod,
        }
    }
}

/// Largest relative difference between `B3(k) k` in the bending elements of a rod and `couple`.
fn unlike(assembly: &Assembly, law: &str, couple: f64) -> f64 {
    let q = &assembly.system.state().frames.orientation;
    let is_segment = |i: usize| assembly.frames[i].kind == BodyKind::Segment;
    (1..assembly.frames.len())
        .filter(|&i| is_segment(i - 1) && is_segment(i))
        .map(|i| {
            let length = assembly.frames[i].s_nm - assembly.frames[i - 1].s_nm;
            let k = rotation::log(q.get(i - 1).inverse() * q.get(i)).z / length;
            let b3 = if law == "Constant" {
                1.3e4
            } else {
                fitted(k).0
            };
            (b3 * k / couple - 1.0).abs()
        })
        .fold(0.0, f64::max)
}

/// The junctions of a mixed filament turned by `angle` (deg), and the torque.
fn crossings(scene: &str, law: &str, resolved: &Resolved) -> (f64, Vec<Crossing>) {
    let mut assembly = build(scene);
    let (_, report) = run(&mut assembly);
    assert_eq!(report.equilibrium.unwrap().certificate.negative, 0);
    let [near, couple] = couples(&assembly, assembly.system.state());
    // Residuals of 1e-9 pN and pN nm at a few nanometres from the axis.
    assert!((near / couple + 1.0).abs() < 1e-9, "{near} {couple}");
    let unlike = unlike(&assembly, law, couple);
    // The rod is tilted by about 0.01 rad, which reduces the torque about d3 by half its square,
    // and has the moment of a small lateral force.
    assert!(unlike < 1e-3, "{unlike:e}");
    let monomers = resolved.under(couple);
    let junctions = assembly.sections.windows(2).map(|pair| {
        let rod_first = matches!(pair[0].resolution, Resolution::Rod { .. });
        Crossing::new(&assembly, pair[0].to_nm, rod_first, &monomers)
    });
    (couple, junctions.collect())
}

/// The torque is uniform, and the missing turn at a junction is as tabulated in
/// `docs/measured/fitted-law.md`. The twist of the rod equals the twist of the monomers under a law
/// fitted to them. A junction of shared weight has no missing turn.
#[test]
fn a_mixed_filament_has_one_torque_through_its_junctions() {
    println!("| filament | law | weight | turn | couple | rod | monomers | missing |");
    for angle in [90.0, -90.0] {
        let resolved = Resolved::new(angle / 90.0);
        for (name, sections) in MIXED {
            for law in ["Constant", "Fitted"] {
                let [shared, full] = ["Shared", "Full"].map(|weight| {
                    let scene = scene(sections, law, weight, &[angle]);
                    let (couple, all) = crossings(&scene, law, &resolved);
                    let mean = |of: fn(&Crossing) -> f64| SampleStatistics::from_values(all.iter().map(of));
                    let missing = mean(|c| c.missing);
                    println!(
                        "| {name} | {law} | {weight} | {angle:+} | {:.1} | {:.5} | {:.5} | {:+.2} |",
                        couple,
                        mean(|c| c.rod).mean,
                        mean(|c| c.monomers).mean,
                        missing.mean,
                    );
                    missing.mean
                });
                // Full weight doubles the stiffness of the same springs.
                assert!(full - shared > 2.0, "{name}, {law}");
                if law == "Fitted" {
                    // Half a rise of a monomer, and one rise.
                    assert!(shared.abs() < 1.37 && full < 2.74, "{shared} {full}");
                }
            }
        }
    }
}
