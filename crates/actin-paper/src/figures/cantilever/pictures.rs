//! Pictures of Figure 4.

use super::{
    AS_PRINTED, Case, FULL, LENGTH_NM, MEAN, MODELS, Outcome, SHARED, STIFF, STIFF_MEAN, WEAK,
    WEAK_MEAN,
};
use crate::figures::charts::{Curve, Filament, Side, against_rod, draw_from};
use crate::figures::draft::Draft;
use crate::figures::model::{Model, Resolution};
use crate::palette;
use actin_draw::Colour;
use actin_view::Attitude;

const X_LABEL: &str = "x (nm); the force pulls towards -x";
const SIDES: [Side; 2] = [
    Side {
        panel: "side",
        title: "Side view",
        labels: ["z along the unloaded filament (nm)", X_LABEL],
        project: |p| (p[2], p[0]),
        equal_axes: true,
    },
    Side {
        panel: "end",
        title: "End view",
        labels: ["y (nm)", X_LABEL],
        project: |p| (p[1], p[0]),
        equal_axes: true,
    },
];

fn drawn(outcomes: &[Outcome], is_chosen: impl Fn(&Case) -> bool) -> Vec<&Outcome> {
    let chosen = outcomes
        .iter()
        .filter(|o| o.case.is_drawn() && is_chosen(&o.case));
    let mut drawn: Vec<&Outcome> = chosen.collect();
    drawn.sort_by(|a, b| a.case.rod_nm().total_cmp(&b.case.rod_nm()));
    drawn
}

/// Draws four models, with the mean filament if it was computed.
pub(super) fn panels(draft: &mut Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    for (model, mean, name) in [
        (SHARED, Some(MEAN), "2_pN_shared"),
        (FULL, None, "2_pN_full"),
        (WEAK, Some(WEAK_MEAN), "0.5_pN_shared"),
        (STIFF, Some(STIFF_MEAN), "preceding_paper"),
    ] {
        let mut chosen = drawn(outcomes, |case| case.model == model);
        chosen.extend(drawn(outcomes, |case| {
            Some(case.model) == mean && case.resolution == Resolution::Ellipsoids
        }));
        let filaments = chosen.iter();
        let filaments = filaments.map(|o| o.filament(Some(o.case.model) == mean));
        let filaments: Vec<Filament> = filaments.collect();
        let dashed = mean.map_or(
            "",
            |_| " Dashed: the mean filament (monomers with quadrature bonds).",
        );
        let file = format!("fig4_{name}");
        views(draft, &file, (model.words, dashed), &filaments)?;
        if chosen[0].is_moved {
            let curves = filaments.iter().zip(&chosen);
            let series = curves.map(|(f, o)| f.curve(o.energy.clone()));
            draft.plot(
                format!("{file}_energy.svg"),
                &format!("Energy, {}", model.words),
                ["time (ns)", "elastic and kinetic energy (pN nm)"],
                series.collect(),
                format!("Elastic and kinetic energy during the damped motion.{dashed}"),
            )?;
        }
    }
    Ok(())
}

fn views(
    draft: &mut Draft<'_>,
    file: &str,
    (words, dashed): (&str, &str),
    filaments: &[Filament],
) -> Result<(), String> {
    let captions = [
        format!(
            "Equilibria, {words}. Lines: nodes of the rod and centre line of the monomers; dots: monomer \
             centres. {}{dashed}",
            palette::chosen().ends()
        ),
        format!("Equilibria seen along the unloaded filament.{dashed}"),
    ];
    for (side, caption) in SIDES.iter().zip(captions) {
        let title = format!("{}, {words}", side.title);
        draw_from(draft, file, (side, &title), filaments, Vec::new(), caption)?;
    }
    Ok(())
}

impl Outcome {
    fn filament(&self, is_mean: bool) -> Filament {
        if is_mean {
            return Filament::mean("mean filament", &self.shape);
        }
        let share = self.case.rod_nm() / LENGTH_NM;
        Filament::new(self.case.resolution.name(), share, &self.shape)
    }
}

type Value = fn(&Outcome) -> f64;

/// Curve of a model against the length of rod, without points if the model was not computed.
fn curve(outcomes: &[Outcome], model: Model, colour: Colour, value: Value) -> Curve {
    let is_computed = outcomes.iter().any(|o| o.case.model == model);
    let own = drawn(outcomes, |case| {
        is_computed && case.model == model.solved_as(&MODELS, case.resolution)
    });
    Curve {
        name: model.words.into(),
        colour,
        // This curve coincides with the curve of `FULL`.
        is_dashed: model == AS_PRINTED,
        points: own.iter().map(|o| (o.case.rod_nm(), value(o))).collect(),
    }
}

pub(super) fn against_resolution(
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    let charts: [(&str, &str, Value); 2] = [
        ("tips", "deflection of the tip along the force (nm)", |o| {
            o.tip_drop_nm
        }),
        ("energies", "elastic energy at equilibrium (pN nm)", |o| {
            o.elastic_pn_nm
        }),
    ];
    for (name, y_label, value) in charts {
        let curves = [
            (SHARED, palette::line(0)),
            (FULL, palette::line(1)),
            (AS_PRINTED, palette::line(3)),
            (MEAN, palette::DATA),
        ];
        let curves = curves.map(|(model, colour)| curve(outcomes, model, colour, value));
        let caption = format!(
            "The {y_label} against the length of rod, from monomers only at 0 to rod only at 160 nm; first sampling \
             of the bonds, and the mean filament (black)."
        );
        draft.plot(
            format!("fig4_{name}.svg"),
            "Equilibria under 2 pN against resolution",
            ["rod at the tip (nm)", y_label],
            against_rod(curves.into()),
            caption,
        )?;
    }
    Ok(())
}

pub(super) fn view(draft: &mut Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    let shown = drawn(outcomes, |_| true).into_iter().map(|o| {
        let share = o.case.rod_nm() / LENGTH_NM;
        (
            o.case.model.words.into(),
            o.case.resolution.name(),
            share,
            o.shape.pose.clone(),
        )
    });
    let caption = "Final states of the damped motions: monomers with their semi-axes and \
        orientations, rod with a stripe along its first axis. The force acts at the tip.";
    draft.view("fig4", Attitude::HORIZONTAL, shown, caption)
}
