//! Pictures of Figures 5 and 6: two side views, a view along the filament, and energies.

use super::solve::{Motion, Outcome};
use super::{FULL, Figure, MEAN, MODELS};
use crate::figures::charts::{Curve, Filament, Side, against_rod, dots, draw_from, line, room};
use crate::figures::draft::Draft;
use crate::palette;
use crate::statistics::{largest, sample};
use actin_draw::{Colour, Series};
use actin_view::Attitude;

/// Largest energy in the picture, relative to the highest limit.
const DRAWN_TO: f64 = 2.0;
const DRAWN_NS: f64 = 60.0;
const LIMIT_DOTS: usize = 60;
const CROSS_NM: f64 = 0.8;
const GREY: Colour = Colour([70, 70, 70]);
const IN_BLACK: &str = "Dashed: the mean filament (monomers with quadrature bonds).";

const ALONG: &str = "z along the filament as built (nm)";
const SIDES: [Side; 3] = [
    Side {
        panel: "side_x",
        title: "side view, x against z",
        labels: [ALONG, "x (nm)"],
        project: |p| (p[2], p[0]),
        equal_axes: true,
    },
    Side {
        panel: "side_y",
        title: "side view, y against z",
        labels: [ALONG, "y (nm)"],
        project: |p| (p[2], p[1]),
        equal_axes: true,
    },
    Side {
        panel: "end",
        title: "view along the filament",
        labels: ["y (nm)", "x (nm)"],
        project: |p| (p[1], p[0]),
        equal_axes: true,
    },
];

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
    for side in &SIDES {
        let title = format!("{}: {}", figure.name, side.title);
        let caption = format!(
            "Certified equilibria, {}. Lines: nodes of the rod and centre line of the monomers; dots: \
             monomer centres; grey crosses: anchors. {} {IN_BLACK}",
            side.title,
            palette::chosen().ends()
        );
        let crosses = crosses(&chosen[0].lowest.anchors, side);
        draw_from(
            draft,
            figure.id,
            (side, &title),
            &filaments,
            crosses,
            caption,
        )?;
    }
    energies(figure, draft, &chosen)?;
    against_resolution(figure, draft, outcomes)
}

fn view(figure: &Figure, draft: &mut Draft<'_>, chosen: &[&Outcome]) -> Result<(), String> {
    let shown = chosen.iter().map(|o| {
        let share = o.case.rod_nm() / figure.length_nm;
        (
            "equilibria".into(),
            o.case.resolution.name(),
            share,
            o.lowest.shape.pose.clone(),
        )
    });
    let caption = "Certified equilibria with linkers and fixed anchors. The stripe along \
        the rod is its first axis.";
    draft.view(figure.id, Attitude::HORIZONTAL, shown, caption)
}

impl Outcome {
    fn filament(&self) -> Filament {
        let (case, shape) = (&self.case, &self.lowest.shape);
        if case.is_drawn_mean() {
            return Filament::mean(case.model.words, shape);
        }
        Filament::new(
            case.resolution.name(),
            case.rod_nm() / case.figure.length_nm,
            shape,
        )
    }
}

/// Crosses at all anchors. The first one has the legend.
fn crosses(anchors: &[[f64; 3]], side: &Side) -> Vec<Series> {
    let strokes = anchors.iter().map(side.project).flat_map(|(x, y)| {
        [(CROSS_NM, CROSS_NM), (CROSS_NM, -CROSS_NM)]
            .map(|(a, b)| vec![(x - a, y - b), (x + a, y + b)])
    });
    let mut series: Vec<Series> = strokes
        .map(|points| line("anchors", GREY, points))
        .collect();
    series.iter_mut().skip(1).for_each(|s| s.label = None);
    series
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
    let caption = format!(
        "Energy of filament and linkers, including kinetic energy, in damped dynamics (drag 0.3 per ns). It \
         starts at {start:.0} pN nm in the linkers; the picture shows energies below {top:.0} pN nm. Dotted: the \
         certified equilibrium at the end of each motion. {IN_BLACK}"
    );
    draft.plot(
        format!("{}_energy.svg", figure.id),
        &format!("{}: energy during the damped motion", figure.name),
        ["time (ns)", "filament, linkers and kinetic energy (pN nm)"],
        series.collect(),
        caption,
    )
}

fn against_resolution(
    figure: &Figure,
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    let first = || outcomes.iter().filter(|o| o.case.seed == 0);
    let curves = MODELS.iter().enumerate().map(|(k, &model)| {
        let own = first().filter(|o| o.case.model == model.solved_as(&MODELS, o.case.resolution));
        Curve {
            name: model.words.into(),
            colour: match model {
                MEAN => palette::DATA,
                FULL => palette::GREY,
                _ => palette::line(k),
            },
            is_dashed: false,
            points: own.map(|o| (o.case.rod_nm(), o.lowest.energy)).collect(),
        }
    });
    let mut series = against_rod(curves.collect());
    let energies = sample(first().map(|o| o.lowest.energy));
    series.push(room((0.0, energies.low - 0.5 * energies.range())));
    let caption = "Certified equilibria against the length of rod, with monomers only at 0 and rod only at the \
        right end; the first sampling of the bonds, and the mean filament.";
    draft.plot(
        format!("{}_resolution.svg", figure.id),
        &format!(
            "{}: energy of the equilibrium against resolution",
            figure.name
        ),
        [
            "rod in the middle of the filament (nm)",
            "energy of filament and linkers (pN nm)",
        ],
        series,
        caption,
    )
}
