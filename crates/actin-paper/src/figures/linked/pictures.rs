//! The panels of Figures 5 and 6: two side views, a view along the filament, energy against time.

use super::case::{FULL, Figure, MEAN, Variant};
use super::solve::{Motion, Outcome};
use super::{is_drawn, is_mean};
use crate::palette;
use actin_draw::report::{Picture, View};
use actin_draw::{Chart, Colour, Series};
use actin_view::{Attitude, Shown, states};
use std::path::Path;

/// Energies are drawn from where they have come down to this multiple of the highest limit.
const DRAWN_TO: f64 = 2.0;
/// Time that is drawn (ns).
const DRAWN_NS: f64 = 60.0;
/// Dots of a limit across the time that is drawn.
const LIMIT_DOTS: usize = 60;
/// Which line is the mean filament.
const IN_BLACK: &str = "Dashed: monomers alone with weighted bonds, the mean filament.";
/// Half the width of the cross that marks an anchor (nm).
const CROSS_NM: f64 = 0.8;
const GREY: Colour = Colour([70, 70, 70]);

const SIDE_X: &str = "x (nm)";
const SIDE_Z: &str = "z along the filament as built (nm)";

/// Draws all panels; those of motions only where motions were followed.
pub(super) fn draw(
    figure: &Figure,
    outcomes: &[Outcome],
    out: &Path,
) -> Result<Vec<Picture>, String> {
    let mut chosen = chosen(outcomes);
    chosen.extend(outcomes.iter().filter(|o| is_mean(&o.case)));
    let mut pictures = views(figure, &chosen, out)?;
    pictures.extend(energies(figure, &chosen, out)?);
    pictures.push(against_resolution(figure, outcomes, out)?);
    Ok(pictures)
}

/// What is drawn as a resolution, from monomers to rod.
fn chosen(outcomes: &[Outcome]) -> Vec<&Outcome> {
    let mut chosen: Vec<&Outcome> = outcomes.iter().filter(|o| is_drawn(&o.case)).collect();
    chosen.sort_by(|a, b| a.case.rod_share().total_cmp(&b.case.rod_share()));
    chosen
}

/// The drawn equilibria for the viewer.
pub(super) fn view_in_space(
    figure: &Figure,
    outcomes: &[Outcome],
    out: &Path,
) -> Result<View, String> {
    let shown: Vec<Shown> = chosen(outcomes)
        .into_iter()
        .map(|o| Shown {
            group: "equilibria".into(),
            name: o.case.name(),
            share: o.case.rod_share(),
            pose: o.lowest.pose.clone(),
        })
        .collect();
    let caption = "The certified equilibria in space, with their linkers and the fixed anchors. \
        The stripe along the rod is its first axis.";
    states::write(figure.id, Attitude::LYING, &shown, caption.into(), out)
}

fn views(figure: &Figure, chosen: &[&Outcome], out: &Path) -> Result<Vec<Picture>, String> {
    type Projection = fn(&[f64; 3]) -> (f64, f64);
    let planes: [(&str, &str, [&str; 2], Projection); 3] = [
        ("side_x", "side view, x against z", [SIDE_Z, SIDE_X], |p| {
            (p[2], p[0])
        }),
        (
            "side_y",
            "Side view, y against z",
            [SIDE_Z, "y (nm)"],
            |p| (p[2], p[1]),
        ),
        ("end", "view along the filament", ["y (nm)", SIDE_X], |p| {
            (p[1], p[0])
        }),
    ];
    let mut pictures = Vec::new();
    for (panel, title, [x_label, y_label], project) in planes {
        let chart = Chart {
            title: &format!("{}: {title}", figure.name),
            x_label,
            y_label,
            series: lines(chosen, project),
            equal_axes: true,
        };
        let file = format!("{}_{panel}.svg", figure.id);
        chart.draw(&out.join(&file))?;
        let caption = format!(
            "Certified equilibria, {title}. Lines: nodes of the rod, and the centre line of the \
             monomers; dots: monomer centres; grey crosses: anchors. {} {IN_BLACK}",
            palette::chosen().ends()
        );
        pictures.push(Picture { file, caption });
    }
    Ok(pictures)
}

/// The colour of a filament's curve.
fn colour(outcome: &Outcome) -> Colour {
    if is_mean(&outcome.case) {
        palette::DATA
    } else {
        palette::resolution(outcome.case.rod_share())
    }
}

/// Its name in legends.
fn name(outcome: &Outcome) -> String {
    if is_mean(&outcome.case) {
        outcome.case.variant.words()
    } else {
        outcome.case.name()
    }
}

/// A filament's line; dashes for the mean filament.
fn line(outcome: &Outcome, points: Vec<(f64, f64)>, equal_axes: bool) -> Vec<Series> {
    let line = Series {
        label: Some(name(outcome)),
        colour: colour(outcome),
        points,
        dots: false,
    };
    if is_mean(&outcome.case) {
        line.dashed(equal_axes)
    } else {
        vec![line]
    }
}

/// Monomer centres under the centre lines, anchors above them, projected by `project`; of the mean
/// filament the centre line alone.
fn lines(chosen: &[&Outcome], project: fn(&[f64; 3]) -> (f64, f64)) -> Vec<Series> {
    let resolutions = chosen.iter().filter(|o| !is_mean(&o.case));
    let dots = resolutions.map(|o| Series {
        label: None,
        colour: colour(o),
        points: o.lowest.monomers.iter().map(project).collect(),
        dots: true,
    });
    let lines = chosen.iter().flat_map(|o| {
        let points = o.lowest.centre_line.points().iter().map(project);
        line(o, points.collect(), true)
    });
    let anchors = chosen.iter().take(1).flat_map(|o| crosses(o, project));
    dots.chain(lines).chain(anchors).collect()
}

/// A cross at each anchor; the first has the name of all.
fn crosses(outcome: &Outcome, project: fn(&[f64; 3]) -> (f64, f64)) -> Vec<Series> {
    let places = outcome.lowest.anchors.iter().map(project);
    let strokes = places.flat_map(|(x, y)| {
        [(CROSS_NM, CROSS_NM), (CROSS_NM, -CROSS_NM)]
            .map(|(a, b)| vec![(x - a, y - b), (x + a, y + b)])
    });
    let named = |k: usize| (k == 0).then(|| "anchors".to_owned());
    let series = strokes.enumerate().map(|(k, points)| Series {
        label: named(k),
        colour: GREY,
        points,
        dots: false,
    });
    series.collect()
}

/// Energy against time, and the limits as dotted lines.
fn energies(figure: &Figure, chosen: &[&Outcome], out: &Path) -> Result<Option<Picture>, String> {
    let moved: Vec<(&Outcome, &Motion)> = chosen
        .iter()
        .filter_map(|o| Some((*o, o.motion.as_ref()?)))
        .collect();
    let limits = moved.iter().map(|(_, m)| m.limit.energy);
    let top = DRAWN_TO * limits.fold(0.0, f64::max);
    let start = moved.iter().filter_map(|(_, m)| Some(m.energy.first()?[1]));
    let start = start.fold(0.0, f64::max);
    if moved.is_empty() {
        return Ok(None);
    }
    let chart = Chart {
        title: &format!(
            "{}: energy while the damped motion comes to rest",
            figure.name
        ),
        x_label: "time (ns)",
        y_label: "filament, linkers and kinetic energy (pN nm)",
        series: curves(&moved, top),
        equal_axes: false,
    };
    let file = format!("{}_energy.svg", figure.id);
    chart.draw(&out.join(&file))?;
    let caption = format!(
        "Energy of filament and linkers, kinetic energy included, in damped dynamics (drag 0.3 per \
         ns). It begins at {start:.0} pN nm, all of it in the linkers, and is drawn from {top:.0} \
         pN nm on. Dotted: the certified equilibrium that each motion tends to. {IN_BLACK}"
    );
    Ok(Some(Picture { file, caption }))
}

/// A line for each motion, and a dotted one for its limit.
fn curves(moved: &[(&Outcome, &Motion)], top: f64) -> Vec<Series> {
    let series = |(o, motion): &(&Outcome, &Motion)| {
        let mut series = line(o, drawn(motion, top), false);
        series.push(Series {
            label: None,
            colour: colour(o),
            points: limit(motion),
            dots: true,
        });
        series
    };
    moved.iter().flat_map(series).collect()
}

/// The part of a motion that is drawn.
fn drawn(motion: &Motion, top: f64) -> Vec<(f64, f64)> {
    let points = motion.energy.iter().map(|e| (e[0], e[1]));
    let late = points.skip_while(|p| p.1 > top);
    late.take_while(|p| p.0 < DRAWN_NS).collect()
}

/// The limit of a motion over the second half of the time that is drawn.
fn limit(motion: &Motion) -> Vec<(f64, f64)> {
    let share = |k: usize| k as f64 / LIMIT_DOTS as f64;
    let dots = LIMIT_DOTS / 2..=LIMIT_DOTS;
    dots.map(|k| (DRAWN_NS * share(k), motion.limit.energy))
        .collect()
}

/// Energy of the equilibrium against the length of rod, for every variant.
fn against_resolution(
    figure: &Figure,
    outcomes: &[Outcome],
    out: &Path,
) -> Result<Picture, String> {
    let length = f64::from(figure.length);
    let series = super::VARIANTS
        .iter()
        .enumerate()
        .flat_map(|(k, &variant)| {
            let colour = match variant {
                MEAN => palette::DATA,
                FULL => palette::GREY,
                _ => palette::line(k),
            };
            let points = by_rod(outcomes, variant, length);
            let series = |label, dots| Series {
                label,
                colour,
                points: points.clone(),
                dots,
            };
            [series(Some(variant.words()), false), series(None, true)]
        });
    let chart = Chart {
        title: &format!(
            "{}: energy of the equilibrium against resolution",
            figure.name
        ),
        x_label: "rod in the middle of the filament (nm)",
        y_label: "energy of filament and linkers (pN nm)",
        series: series.chain(room_below(outcomes)).collect(),
        equal_axes: false,
    };
    let file = format!("{}_resolution.svg", figure.id);
    chart.draw(&out.join(&file))?;
    let caption =
        "Certified equilibria against the length of the rod, pure monomers at 0 and pure \
                   rod at the right end; the first sampling of the bonds, and the mean filament."
            .into();
    Ok(Picture { file, caption })
}

/// A white dot that makes room for the legend below all curves.
fn room_below(outcomes: &[Outcome]) -> Option<Series> {
    let first = outcomes.iter().filter(|o| o.case.seed == 0);
    let energies: Vec<f64> = first.map(|o| o.lowest.energy).collect();
    let largest = energies.iter().copied().reduce(f64::max)?;
    let smallest = energies.iter().copied().reduce(f64::min)?;
    Some(Series {
        label: None,
        colour: Colour([255, 255, 255]),
        points: vec![(0.0, smallest - 0.5 * (largest - smallest))],
        dots: true,
    })
}

/// Energies of a variant in order of the length of rod; its pure filaments may be another's.
fn by_rod(outcomes: &[Outcome], variant: Variant, length: f64) -> Vec<(f64, f64)> {
    let belongs = |o: &&Outcome| o.case.variant == variant.of_pure(o.case.resolved);
    let first = outcomes.iter().filter(|o| o.case.seed == 0);
    let mut points: Vec<(f64, f64)> = first
        .filter(belongs)
        .map(|o| (o.case.rod_share() * length, o.lowest.energy))
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}
