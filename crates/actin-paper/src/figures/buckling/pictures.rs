//! Pictures of Figures 8 and 10: centre lines in the plane of buckling and from its side, and
//! heights and couples against the length of rod.

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

/// Along the axis, in the plane of buckling and out of it are the coordinates 0, 1 and 2.
const SIDES: [Side; 3] = [
    Side {
        panel: "plane",
        title: "In each filament's own plane of buckling",
        labels: ["along the axis, from the middle (nm)", "in the plane (nm)"],
        project: |p| (p[0], p[1]),
        equal_axes: false,
    },
    Side {
        panel: "side",
        title: "From the side of that plane",
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

/// Draws all pictures.
pub(super) fn draw(plan: &Plan, draft: &mut Draft<'_>, results: &Results) -> Result<(), String> {
    for &turn in plan.figure.turns {
        lines(plan, draft, results, turn)?;
    }
    for (observable, what) in OBSERVABLES
        .into_iter()
        .zip(["Largest distance from the axis", "End couple"])
    {
        for &turn in plan.figure.turns {
            against_resolution(plan, draft, results, (observable, what), turn)?;
        }
    }
    view(plan, draft, results)
}

/// Text for a turn.
fn in_words(turn: i32) -> String {
    let direction = if turn > 0 {
        "over-twist"
    } else {
        "under-twist"
    };
    format!("{} deg of {direction}", turn.abs())
}

/// The outcomes that are drawn at a turn, from monomers to rod.
fn drawn<'a>(plan: &Plan, results: &'a Results, turn: i32) -> Vec<&'a Outcome> {
    let cases = plan.resolutions.iter().rev();
    let outcomes = cases.filter_map(|&r| results.of(plan.case(plan.shown(), r, turn, 0)));
    outcomes.collect()
}

/// The filaments that are drawn at a turn, each in its own plane of buckling.
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

/// The views of the centre lines at one turn.
fn lines(plan: &Plan, draft: &mut Draft<'_>, results: &Results, turn: i32) -> Result<(), String> {
    let filaments = filaments(plan, results, turn);
    let file = format!("{}_{}", plan.figure.id, turn_name(turn).replace('/', "_"));
    let captions = [
        format!(
            "Centre lines, drawn bonds (seed 0), {}; every filament is turned about the axis until its own plane \
             of buckling lies in the page. {} Black: the mean filament, all monomers. The scales of the two axes \
             differ.",
            plan.figure.rods,
            palette::chosen().ends()
        ),
        "The same lines from the side: what leaves the plane.".into(),
        "The same lines seen along the axis of the ends, at equal scales.".into(),
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

/// The colour of a model in charts against the length of rod.
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

/// An observable against the length of rod at one turn, all models.
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
        "{what} against the length of rod, {}. Drawn bonds, 64 per interface, are means over {} samplings; the \
         mean filament has 12 weighted bonds per interface that stand for all, and the balance as printed is \
         solved for it.",
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

/// The drawn states for the viewer.
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
    let caption = "The equilibria of seed 0 in space, each in the plane in which it buckled; the stripe along rods \
        is their first axis and shows the twist. The weak pull that breaks the symmetry is left out.";
    draft.view(plan.figure.id, Attitude::LYING, shown, caption)
}

/// Times of the states that are shown of the motion whose resolution follows it (ns): straight, bent, buckled, at
/// rest.
const TIMES_NS: [f64; 5] = [0.0, 95.0, 125.0, 145.0, 400.0];
/// Records are every 5 ns, at whole steps.
const NEAR_NS: f64 = 1.0;

/// A filament that buckles while its resolution follows, for the viewer.
pub(super) fn followed(draft: &mut Draft<'_>) -> Result<(), String> {
    let fail = |error: &dyn std::fmt::Display| format!("following.ron: {error}");
    let follower = Follower::new(&scenario("following.ron")?).map_err(|e| fail(&e))?;
    let run = follower.run().map_err(|e| fail(&e))?;
    let mut shown = Vec::new();
    for time_ns in TIMES_NS {
        // After a switch the later stretch shows what it made.
        let found = run.stretches.iter().rev().find_map(|ran| {
            let mut records = ran.trajectory.records.iter();
            let record = records.find(|record| (record.at.value() - time_ns).abs() < NEAR_NS)?;
            let cells = &ran.stretch.beginning.is_monomers;
            let monomers = cells.iter().filter(|is_monomers| **is_monomers).count();
            Some((
                "Pushed together by a fifth in 300 ns".into(),
                format!("{time_ns} ns"),
                1.0 - monomers as f64 / cells.len() as f64,
                Pose::of(&ran.stretch.assembly, &record.state),
            ))
        });
        shown.push(found.ok_or_else(|| fail(&format!("no state at {time_ns} ns")))?);
    }
    let caption = "A motion in time whose resolution follows it (scenarios/following.ron): cells of the rod become \
        monomers where it bends by more than 0.008 per nm, and rod again below 0.005.";
    draft.view("fig10_following", Attitude::LYING, shown, caption)
}
