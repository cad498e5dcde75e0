//! Pictures of Figures 5 and 6: two side views, a view along the filament, and energies.

use super::Figure;
use super::solve::{Motion, Outcome};
use crate::figures::charts::{Filament, against_rod, dots, project, room};
use crate::figures::draft::Draft;
use crate::figures::model::models;
use crate::figures::texts::{ChartText, Values};
use crate::statistics::{largest, sample};
use actin_draw::page::name;

/// Largest energy in the picture, relative to the highest limit.
const DRAWN_TO: f64 = 2.0;
const DRAWN_NS: f64 = 60.0;
const LIMIT_DOTS: usize = 60;

/// Draws all pictures, energies against time only with motions.
pub(super) fn draw(
    figure: &Figure,
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    let mut chosen: Vec<&Outcome> = outcomes.iter().filter(|o| o.case.is_drawn()).collect();
    chosen.sort_by(|a, b| a.case.rod_nm().total_cmp(&b.case.rod_nm()));
    view(figure, draft, &chosen)?;
    chosen.extend(outcomes.iter().filter(|o| o.case.is_drawn_mean()));
    let filaments: Vec<Filament> = chosen.iter().map(|o| o.filament()).collect();
    for view in ["side_x", "side_y", "end"] {
        let texts = ChartText::new(&format!("linkers_{view}"), &[("figure", &name(figure.id))])?;
        let (file, anchors) = (
            format!("{}_{view}.svg", figure.id),
            &chosen[0].lowest.anchors,
        );
        project(draft, file, &texts, &filaments, anchors)?;
    }
    energies(figure, draft, &chosen)?;
    against_resolution(figure, draft, outcomes)
}

fn view(figure: &Figure, draft: &mut Draft<'_>, chosen: &[&Outcome]) -> Result<(), String> {
    let shown = chosen.iter().map(|o| {
        let (group, name) = ("equilibria".to_owned(), o.case.resolution.name());
        (group, name, o.share(), o.lowest.shape.pose.clone())
    });
    draft.view(figure.id, "linkers", shown)
}

impl Outcome {
    fn share(&self) -> f64 {
        self.case.rod_nm() / self.case.figure.length_nm
    }

    fn filament(&self) -> Filament {
        let (case, shape) = (&self.case, &self.lowest.shape);
        if case.is_drawn_mean() {
            return Filament::mean(&case.model.words, shape);
        }
        Filament::new(case.resolution.name(), self.share(), shape)
    }
}

fn energies(figure: &Figure, draft: &mut Draft<'_>, chosen: &[&Outcome]) -> Result<(), String> {
    let moved = chosen.iter().filter_map(|o| Some((*o, o.motion.as_ref()?)));
    let moved: Vec<(&Outcome, &Motion)> = moved.collect();
    if moved.is_empty() {
        return Ok(());
    }
    let top = DRAWN_TO * largest(moved.iter().map(|(_, m)| m.limit.energy));
    let start = largest(moved.iter().map(|(_, m)| m.energy[0][1]));
    let series = moved.iter().flat_map(|(o, motion)| {
        let filament = o.filament();
        let points = motion.energy.iter().map(|e| (e[0], e[1]));
        let late = points
            .skip_while(|p| p.1 > top)
            .take_while(|p| p.0 < DRAWN_NS);
        let line = filament.curve(late.collect());
        let share = |k: usize| k as f64 / LIMIT_DOTS as f64;
        let limit =
            (LIMIT_DOTS / 2..=LIMIT_DOTS).map(|k| (DRAWN_NS * share(k), motion.limit.energy));
        [line, dots(filament.colour, limit.collect())]
    });
    let values: Values<'_> = &[
        ("figure", &name(figure.id)),
        ("start", &format!("{start:.0}")),
        ("top", &format!("{top:.0}")),
    ];
    let texts = ChartText::new("linkers_energy", values)?;
    let file = format!("{}_energy.svg", figure.id);
    draft.plot(file, &texts, series.collect())
}

fn against_resolution(
    figure: &Figure,
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    let first = || outcomes.iter().filter(|o| o.case.seed == 0);
    let curves = models("linkers", false).into_iter().map(|model| {
        let own = first().filter(|o| o.case.model == model.solved_at(o.case.resolution));
        let points = own.map(|o| (o.case.rod_nm(), o.lowest.energy));
        model.curve(points.collect())
    });
    let mut series = against_rod(curves);
    let energies = sample(first().map(|o| o.lowest.energy));
    series.push(room((0.0, energies.low - 0.5 * energies.range())));
    let texts = ChartText::new("linkers_resolution", &[("figure", &name(figure.id))])?;
    draft.plot(format!("{}_resolution.svg", figure.id), &texts, series)
}
