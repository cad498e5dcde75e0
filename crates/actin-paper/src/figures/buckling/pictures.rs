//! Pictures of Figures 8 and 10: projected centre lines, and heights and torques against the length of rod.

use super::case::turn_name;
use super::plane::in_own_plane;
use super::solve::Outcome;
use super::{LENGTH_NM, OBSERVABLES, Observable, Plan, Results};
use crate::figures::charts::{Curve, Filament, Side, against_rod, draw_from};
use crate::figures::draft::Draft;
use crate::figures::model::{Model, Resolution};
use crate::palette;
use crate::run::scenario;
use actin_draw::Colour;
use actin_sim::follow::Follower;
use actin_view::{Attitude, Pose};

/// Coordinates 0, 1 and 2 are along the axis, in the plane of buckling and out of the plane.
const SIDES: [Side; 3] = [
    Side {
        panel: "plane",
        title: "In the plane of buckling of each filament",
        labels: ["along the axis, from the middle (nm)", "in the plane (nm)"],
        project: |p| (p[0], p[1]),
        equal_axes: false,
    },
    Side {
        panel: "side",
        title: "Perpendicular to the plane of buckling",
        labels: [
            "along the axis, from the middle (nm)",
            "out of the plane (nm)",
        ],
        project: |p| (p[0], p[2]),
        equal_axes: false,
    },
    Side {
        panel: "end",
        title: "Along the axis, from the end",
        labels: ["out of the plane (nm)", "in the plane (nm)"],
        project: |p| (p[2], p[1]),
        equal_axes: true,
    },
];

pub(super) fn draw(plan: &Plan, draft: &mut Draft<'_>, results: &Results) -> Result<(), String> {
    for &turn in plan.figure.turns {
        lines(plan, draft, results, turn)?;
    }
    for (observable, what) in OBSERVABLES
        .into_iter()
        .zip(["Largest distance from the axis", "End torque"])
    {
        for &turn in plan.figure.turns {
            against_resolution(plan, draft, results, (observable, what), turn)?;
        }
    }
    view(plan, draft, results)
}

fn in_words(turn: i32) -> String {
    let direction = if turn > 0 {
        "over-twist"
    } else {
        "under-twist"
    };
    format!("{} deg of {direction}", turn.abs())
}

fn drawn<'a>(plan: &Plan, results: &'a Results, turn: i32) -> Vec<&'a Outcome> {
    let cases = plan.resolutions.iter().rev();
    let outcomes = cases.filter_map(|&r| results.of(plan.case(plan.shown(), r, turn, 0)));
    outcomes.collect()
}

fn filaments(plan: &Plan, results: &Results, turn: i32) -> Vec<Filament> {
    let filament = |o: &Outcome, name: String, colour| Filament {
        name,
        colour,
        is_dashed: false,
        line: in_own_plane(&o.measured.centre_line),
        monomers: Vec::new(),
    };
    let drawn = drawn(plan, results, turn).into_iter().map(|o| {
        let colour = palette::resolution(o.case.rod_nm() / LENGTH_NM);
        filament(o, o.case.resolution.name(), colour)
    });
    let mean = plan.models.iter().find(|model| model.is_mean);
    let mean = mean.map(|&model| plan.case(model, Resolution::Ellipsoids, turn, 0));
    let mean = mean.and_then(|case| results.of(case));
    let mean = mean.map(|o| filament(o, "mean, ellipsoids".into(), palette::DATA));
    drawn.chain(mean).collect()
}

fn lines(plan: &Plan, draft: &mut Draft<'_>, results: &Results, turn: i32) -> Result<(), String> {
    let filaments = filaments(plan, results, turn);
    let file = format!("{}_{}", plan.figure.id, turn_name(turn).replace('/', "_"));
    let captions = [
        format!(
            "Centre lines, sampled bonds (seed 0), {}; every filament is rotated about the axis so that its plane \
             of buckling coincides with the page. {} Black: the mean filament without rod. The scales of the two axes \
             differ.",
            plan.figure.rods,
            palette::chosen().ends()
        ),
        "Centre lines out of the plane of buckling.".into(),
        "Centre lines along the axis of the ends, with equal scales.".into(),
    ];
    for (side, caption) in SIDES.iter().zip(captions) {
        let title = format!("{}, {} at each end", side.title, in_words(turn));
        draw_from(
            draft,
            &file,
            (side, &title),
            &filaments,
            Vec::new(),
            caption,
        )?;
    }
    Ok(())
}

fn colour(model: Model) -> Colour {
    match model.name {
        "" => palette::line(3),
        "mean-filament/" => palette::DATA,
        "wall/" => palette::LIGHT_GREY,
        "standard/" => palette::line(1),
        "coupling-energy/" => palette::line(2),
        _ => palette::line(0),
    }
}

fn against_resolution(
    plan: &Plan,
    draft: &mut Draft<'_>,
    results: &Results,
    ((name, unit, of), what): (Observable, &str),
    turn: i32,
) -> Result<(), String> {
    let curves = plan.models.iter().map(|&model| {
        let is_compared = plan.turns_of(model).any(|t| t == turn);
        let means = plan
            .resolutions
            .iter()
            .filter(|_| is_compared)
            .filter_map(|&r| {
                let case = plan.case(model, r, turn, 0);
                Some((case.rod_nm(), results.sample(case, of)?.mean))
            });
        Curve {
            name: model.words.into(),
            colour: colour(model),
            is_dashed: false,
            points: means.collect(),
        }
    });
    let file = format!(
        "{}_{}_{name}.svg",
        plan.figure.id,
        turn_name(turn).replace('/', "_")
    );
    let caption = format!(
        "{what} against the length of rod, {}. Sampled bonds: 64 per interface, mean over {} samplings. The mean \
         filament has 12 quadrature bonds per interface, which represent all possible bonds. The balance as printed \
         uses it.",
        plan.figure.rods, plan.seeds,
    );
    draft.plot(
        file,
        &format!("{what}, {} at each end", in_words(turn)),
        [
            "length of rod (nm); 0 is all monomers, 300 all rod",
            &format!("{name} ({unit})"),
        ],
        against_rod(curves.collect()),
        caption,
    )
}

fn view(plan: &Plan, draft: &mut Draft<'_>, results: &Results) -> Result<(), String> {
    let mut shown = Vec::new();
    for &turn in plan.figure.turns {
        shown.extend(drawn(plan, results, turn).into_iter().map(|o| {
            let share = o.case.rod_nm() / LENGTH_NM;
            (
                in_words(turn),
                o.case.resolution.name(),
                share,
                o.pose.clone(),
            )
        }));
    }
    let caption = "Equilibria of seed 0, each in its plane of buckling; the stripe along rods \
        is their first axis and shows the twist. The weak symmetry-breaking force is not shown.";
    draft.view(plan.figure.id, Attitude::HORIZONTAL, shown, caption)
}

/// Times of the states of the adaptive motion (ns): straight, bent, buckled, at rest.
const TIMES_NS: [f64; 5] = [0.0, 95.0, 125.0, 145.0, 400.0];
/// Tolerance of the time of a record (ns). Records are every 5 ns, rounded to time steps.
const NEAR_NS: f64 = 1.0;

/// Writes a buckling filament with adaptive resolution for the viewer.
pub(super) fn followed(draft: &mut Draft<'_>) -> Result<(), String> {
    let fail = |error: &dyn std::fmt::Display| format!("following.ron: {error}");
    let follower = Follower::new(&scenario("following.ron")?).map_err(|e| fail(&e))?;
    let run = follower.run().map_err(|e| fail(&e))?;
    let mut shown = Vec::new();
    for time_ns in TIMES_NS {
        // At a switch of the resolution, the later stretch is shown.
        let found = run.stretches.iter().rev().find_map(|ran| {
            let mut records = ran.trajectory.records.iter();
            let record = records.find(|record| (record.at.value() - time_ns).abs() < NEAR_NS)?;
            let cells = &ran.stretch.beginning.is_monomers;
            let monomers = cells.iter().filter(|is_monomers| **is_monomers).count();
            Some((
                "Compressed by a fifth in 300 ns".into(),
                format!("{time_ns} ns"),
                1.0 - monomers as f64 / cells.len() as f64,
                Pose::new(&ran.stretch.assembly, &record.state),
            ))
        });
        shown.push(found.ok_or_else(|| fail(&format!("no state at {time_ns} ns")))?);
    }
    let caption = "Motion with adaptive resolution (scenarios/following.ron): cells of the rod become \
        monomers where the curvature exceeds 0.008 per nm, and rod again below 0.005 per nm.";
    draft.view("fig10_following", Attitude::HORIZONTAL, shown, caption)
}
