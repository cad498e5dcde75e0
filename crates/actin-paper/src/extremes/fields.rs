//! Numbers that no scene should hold, in every field of one: NaN, infinities, overflow, denormals,
//! zero and -1.

use super::row::{Outcome, Row};
use super::text::{Number, numbers, with_number};
use super::verdict::{Verdict, verdict};
use actin_sim::Scene;

/// What each number of a scene is replaced by in turn.
pub(super) const VALUES: [&str; 12] = [
    "NaN", "inf", "-inf", "1e400", "1e308", "-1e308", "1e-310", "1e59", "-1e59", "1e-59", "0", "-1",
];

/// Monomers on a rod, driven and linked, in time.
const MOTION: &str = "Scene(
    filament: Filament(
        sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 8.0),
            Rod(from_nm: 8.0, to_nm: 28.0, segments: 2),
        ],
        monomers: Monomers(anchors: Independent, lateral_bonds: 4, longitudinal_bonds: 4),
        rod: RodModel(law: Constant, material: Rigidities(
            shear_pn: (1.6e4, 1.6e4, 3.4e4), bend_pn_nm2: (3.9e4, 3.9e4, 1.3e4),
        )),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (1.0, 2.0, 3.0))],
    linkers: [
        Linker(at_nm: 10.0, radius_nm: 1.8, azimuth_deg: 30.0, displaced_nm: (1.0, 2.0, 3.0),
            stiffness_pn_per_nm: 5.0, rest_length_nm: 1.0),
        Linker(at_nm: 20.0, anchor_nm: (1.0, 2.0, 20.0), stiffness_pn_per_nm: 5.0),
    ],
    path: [Stage(
        set: [
            LoadFactor(load: 0, factor: 0.5),
            Shift(end: Start, shift_nm: (0.1, 0.2, 0.3)),
            Turn(end: Start, turn_deg: (1.0, 2.0, 3.0)),
            Anchor(linker: 0, shift_nm: (0.5, 0.5, 0.5)),
        ],
        duration_ns: 0.02,
    )],
    task: Dynamics(
        duration_ns: 0.04,
        time_step_ns: 0.0005,
        drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0),
        stop: (force_pn: 1e-6, torque_pn_nm: 1e-6, kinetic_pn_nm: 1e-9),
        record_every_ns: 0.01,
    ),
)";

/// The same in statics.
fn statics() -> String {
    let (scene, _) = MOTION.split_once("task:").expect("the scene has a task");
    format!(
        "{}task: Equilibrium(iterations: 50))",
        scene.replace("duration_ns: 0.02,", "")
    )
}

/// A rod under a law with numbers of all kinds, twisted.
const LAWS: &str = "Scene(
    filament: Filament(
        sections: [Rod(from_nm: 0.0, to_nm: 20.0, segments: 2)],
        rod: RodModel(law: Laws(
            bend: Stiffening(rest_pn_nm2: 3.2e4, rise_pn_nm2: 8e3, curvature_per_nm: 2.8e-3,
                twist_per_nm: 2.9e-3, shear: 0.01, range_per_nm: 0.015),
            twist: TWIST,
            stretch: Sided(tension_pn: 3.3e4, compression_pn: 1.6e4, width: 1e-3),
            shear: Cubic(linear_pn: (1e3, 1e3), cubic_pn: 8e5),
            twist_stretch: LENGTH,
        )),
    ),
    clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
    path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 9.0))])],
    task: Equilibrium(iterations: 50),
)";

/// Both laws of twist and of length, each with numbers of its own.
fn laws() -> [String; 2] {
    let tanh = "Tanh(b_plus_pn_nm2: 1.6e4, b_minus_pn_nm2: 9.6e3, range_per_nm: 0.0462,
        lambda: (1.5928e-2, 7.2455e-3, 4.5982, 1e-6, 1.8196e-2, 4.5935e-3, 1.7203e-2))";
    let polynomial = "Polynomial(range_per_nm: 0.0462,
        coefficients: (0.0, -0.32416, -20.508, 79.376, 1.066e4, -2.4927e4, -2.6662e6))";
    let sided = "Sided(rest_pn_nm2: 225.0, range_per_nm: 0.05,
        under: (rise_pn_nm2: 1.3e4, half_per_nm: 8.7e-3, slow_per_nm: 1.9e-2),
        over: (rise_pn_nm2: 2.3e4, half_per_nm: 1.1e-2, slow_per_nm: 1.8e-2))";
    let rooted = "Rooted(slope_nm: -0.29, bend_nm: 0.46, half_per_nm: 6.6e-3, cubic_nm3: 27.6,
        range_per_nm: 0.05)";
    [(tanh, polynomial), (sided, rooted)]
        .map(|(twist, length)| LAWS.replace("TWIST", twist).replace("LENGTH", length))
}

/// Scenes in which every key with a number is written, defaults included.
pub(super) fn scenes() -> Vec<String> {
    let [first, second] = laws();
    let all = [MOTION.to_owned(), statics(), first, second];
    all.map(|text| {
        let scene = Scene::from_ron(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        scene.to_ron()
    })
    .to_vec()
}

/// One replacement and what came of it.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    /// The number that was replaced.
    pub(super) number: Number,
    /// By what.
    pub(super) value: &'static str,
    /// What the library said.
    pub(super) verdict: Verdict,
}

/// Every number of `text` replaced by `value`.
pub(super) fn trials(text: &str, value: &'static str) -> Vec<Trial> {
    let trial = |number: Number| {
        let text = with_number(text, &number, value);
        Trial {
            verdict: verdict(&text),
            number,
            value,
        }
    };
    numbers(text).into_iter().map(trial).collect()
}

/// A row for each value, over all scenes.
pub(super) fn rows() -> Vec<Row> {
    let scenes = scenes();
    let row = |value| {
        let all: Vec<Trial> = scenes.iter().flat_map(|text| trials(text, value)).collect();
        Row::new(
            "field",
            format!("{value} in each of {} numbers", all.len()),
            counted(&all),
        )
    };
    VALUES.map(row).to_vec()
}

/// How the trials ended, in numbers.
fn counted(trials: &[Trial]) -> Outcome {
    let count = |is: fn(&Verdict) -> bool| trials.iter().filter(|t| is(&t.verdict)).count();
    if let Some(trial) = trials
        .iter()
        .find(|t| matches!(t.verdict, Verdict::NotFinite(_)))
    {
        return Outcome::Wrong(format!(
            "{} = {}: {:?}",
            trial.number.key, trial.value, trial.verdict
        ));
    }
    let refused = count(|v| matches!(v, Verdict::Refused(_)));
    let broke = count(|v| matches!(v, Verdict::Broke(_)));
    Outcome::Refused(format!(
        "{refused} with line and column; {broke} broke with a message; {} ran to finite results or \
         would take long",
        trials.len() - refused - broke
    ))
}
