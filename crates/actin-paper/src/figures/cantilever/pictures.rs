//! Pictures of Figure 4.

use super::{Case, LENGTH_NM, Outcome};
use crate::figures::charts::{Filament, against_rod, project};
use crate::figures::draft::Draft;
use crate::figures::model::{Resolution, models};
use crate::figures::texts::{ChartText, Values};
use actin_draw::{Mark, Series};

fn drawn(outcomes: &[Outcome], is_chosen: impl Fn(&Case) -> bool) -> Vec<&Outcome> {
    let chosen = outcomes
        .iter()
        .filter(|o| o.case.is_drawn() && is_chosen(&o.case));
    let mut drawn: Vec<&Outcome> = chosen.collect();
    drawn.sort_by(|a, b| a.case.rod_nm().total_cmp(&b.case.rod_nm()));
    drawn
}

/// Model, its mean filament if that is drawn, and part of the name of files.
const PANELS: [(&str, Option<&str>, &str); 4] = [
    ("", Some("mean-filament/"), "2_pN_shared"),
    ("full/", None, "2_pN_full"),
    ("0.5-pN/", Some("0.5-pN/mean-filament/"), "0.5_pN_shared"),
    (
        "preceding-paper/",
        Some("preceding-paper/mean-filament/"),
        "preceding_paper",
    ),
];

/// Draws four models, with the mean filament if it was computed.
pub(super) fn panels(draft: &mut Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    for (model, mean, name) in PANELS {
        let is_mean = |case: &Case| Some(&*case.model.name) == mean;
        let mut chosen = drawn(outcomes, |case| case.model.name == model);
        let words = &chosen[0].case.model.words;
        chosen.extend(drawn(outcomes, |case| {
            is_mean(case) && case.resolution == Resolution::Ellipsoids
        }));
        let filaments = chosen.iter().map(|o| o.filament(is_mean(&o.case)));
        let filaments: Vec<Filament> = filaments.collect();
        let dashed = mean.map_or(
            "",
            |_| " Dashed: the mean filament (monomers with quadrature bonds).",
        );
        let values: Values<'_> = &[("model", words), ("dashed", &dashed)];
        for view in ["side", "end"] {
            let texts = ChartText::new(&format!("fig4_{view}"), values)?;
            let file = format!("fig4_{name}_{view}.svg");
            project(draft, file, &texts, &filaments, &[])?;
        }
        if chosen[0].is_moved {
            let curves = filaments.iter().zip(&chosen);
            let series = curves.map(|(f, o)| f.curve(o.energy.clone()));
            let texts = ChartText::new("fig4_energy", values)?;
            draft.plot(format!("fig4_{name}_energy.svg"), &texts, series.collect())?;
        }
    }
    Ok(())
}

impl Outcome {
    fn share(&self) -> f64 {
        self.case.rod_nm() / LENGTH_NM
    }

    fn filament(&self, is_mean: bool) -> Filament {
        if is_mean {
            return Filament::mean("mean filament", &self.shape);
        }
        Filament::new(self.case.resolution.name(), self.share(), &self.shape)
    }
}

type Value = fn(&Outcome) -> f64;

/// Draws tips and energies of four models against the length of rod.
pub(super) fn against_resolution(
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    let tip: Value = |o| o.tip_drop_nm;
    let energy: Value = |o| o.elastic_pn_nm;
    for (name, quantity, value) in [
        ("tips", "deflection of the tip along the force (nm)", tip),
        ("energies", "elastic energy at equilibrium (pN nm)", energy),
    ] {
        let models = models("fig4", draft.quick);
        let named = ["", "full/", "paper-balance/", "mean-filament/"].into_iter();
        let drawn_models = named.filter_map(|name| models.iter().find(|m| m.name == name));
        let curves = drawn_models.map(|model| {
            let own = drawn(outcomes, |case| {
                case.model == model.solved_at(case.resolution)
            });
            let points = own.iter().map(|o| (o.case.rod_nm(), value(o)));
            let curve = model.curve(points.collect());
            // The curve of the printed balance coincides with the curve of the junction as printed.
            let mark = if model.has_potential() {
                Mark::Line
            } else {
                Mark::Dashes
            };
            Series { mark, ..curve }
        });
        let texts = ChartText::new("fig4_resolution", &[("quantity", &quantity)])?;
        draft.plot(format!("fig4_{name}.svg"), &texts, against_rod(curves))?;
    }
    Ok(())
}

pub(super) fn view(draft: &mut Draft<'_>, outcomes: &[Outcome]) -> Result<(), String> {
    let shown = drawn(outcomes, |_| true).into_iter().map(|o| {
        let (group, name) = (o.case.model.words.clone(), o.case.resolution.name());
        (group, name, o.share(), o.shape.pose.clone())
    });
    draft.view("fig4", "fig4", shown)
}
