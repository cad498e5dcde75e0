//! Figures 1 to 3: the models, their junction and typical scenes, drawn from equilibria of scenes in `scenarios`. The
//! pictures are described in `data/schematics.ron`.

mod annotations;
mod sheet;
mod style;

use super::draft::{Draft, residuals};
use super::texts::Values;
use crate::run::{doubtful, pose, residual, scenario, solved};
use actin_draw::report::{Picture, save};
use actin_mechanics::Vector3;
use actin_sim::shape::Ribbon;
use actin_sim::{BodyKind, End, Solution};
use actin_view::{Pose, bodies};
use sheet::Sheet;
use std::collections::BTreeSet;

/// Figure 1: monomers, monomers joined to a rod, and a rod under the same force; close-up of bonds.
pub(super) fn figure1(draft: &mut Draft<'_>) -> Result<(), String> {
    let (sheet, solved) = solve(draft)?;
    for (panel, name) in [(0, "a"), (3, "d")] {
        let drawn = annotations::bonds(&sheet.panels[panel].drawing(&solved), 1.0);
        for (kind, count) in ["lateral", "longitudinal"].into_iter().zip(drawn.counts) {
            let quantity = format!("{kind}_bonds_drawn/{name}");
            let note = "lines in the picture, from anchor to anchor";
            draft.row(quantity, "", count as f64, note);
        }
    }
    let (radius, rise) = radius_and_rise_nm(&solved[0]);
    let note = "of the helix through the centres of the bent filament, from root mean square distances to the next two \
        monomers; at rest 1.8 and 2.7385";
    draft.row("radius", "nm", radius, note);
    draft.row("rise", "nm", rise, note);
    finish(draft, sheet, &solved)
}

/// Radius and rise (nm) of the helix in the current state, neglecting curvature.
///
/// For radius `R`, rise `z` and turn `t`, the distances `a` from i to i + 1 and `b` from i to i + 2 are
///
/// ```text
/// a^2 = z^2 + 4 R^2 sin^2(t/2)
/// b^2 = 4 z^2 + 4 R^2 sin^2 t
/// ```
///
/// Squares are means over the monomers.
fn radius_and_rise_nm(solved: &Solution) -> (f64, f64) {
    let points = solved.assembly.points.iter().enumerate();
    let monomers = points.filter(|(_, info)| info.kind == BodyKind::Monomer);
    let centres: Vec<Vector3> = monomers
        .map(|(i, _)| solved.state().points.position.get(i))
        .collect();
    let mean_square = |step: usize| {
        let pairs = centres.iter().zip(&centres[step..]);
        let sum: f64 = pairs.map(|(p, q)| (q - p).norm_squared()).sum();
        sum / (centres.len() - step) as f64
    };
    let turn = solved.assembly.monomers_of(0).turn_deg.to_radians();
    let across = |angle: f64| 4.0 * (0.5 * angle).sin().powi(2);
    let (one, two) = (across(turn), across(2.0 * turn));
    let (a, b) = (mean_square(1), mean_square(2));
    let radius_square = (4.0 * a - b) / (4.0 * one - two);
    (radius_square.sqrt(), (a - one * radius_square).sqrt())
}

/// Figure 2: junction of monomers and rod from three directions.
pub(super) fn figure2(draft: &mut Draft<'_>) -> Result<(), String> {
    let (sheet, solved) = solve(draft)?;
    let drawn = sheet.panels[0].drawing(&solved);
    let rest = &drawn.assembly.rest;
    for (k, bond) in annotations::junction_bonds(&drawn) {
        let [length, rest_length] = [drawn.state, rest].map(|state| {
            let [monomer, node] = bodies::ends_of(&bond, state);
            (node - monomer).norm()
        });
        let [now, built] =
            [drawn.state, rest].map(|state| state.frames.orientation.get(bond.frame));
        let note = "from the centre of the monomer to the end of the rod";
        draft.row(format!("bond-{k}/length"), "nm", length, note);
        draft.row(format!("bond-{k}/rest_length"), "nm", rest_length, note);
        let turn = (now * built.inverse()).angle().to_degrees();
        let note = "rotation of the bond frame relative to the built state";
        draft.row(format!("bond-{k}/turn"), "deg", turn, note);
    }
    finish(draft, sheet, &solved)
}

/// Figure 3: cantilever, buckled filament, and filament on linkers.
pub(super) fn figure3(draft: &mut Draft<'_>) -> Result<(), String> {
    let (sheet, solved) = solve(draft)?;
    let [cantilever, buckled, linked] = &solved[..] else {
        return Err("Figure 3 requires three scenes".into());
    };
    let tip = |state| cantilever.assembly.tip_nm(state, End::End);
    let moved = tip(cantilever.state()) - tip(&cantilever.assembly.rest);
    let note = "of the tip, along the force";
    draft.row("cantilever/deflection", "nm", -moved.x, note);
    let ribbon = Ribbon::new(&buckled.assembly, buckled.state());
    let note = "largest distance of the centre line from the axis";
    draft.row("buckling/height", "nm", ribbon.largest_distance_nm(), note);
    let writhe = ribbon.writhe().ok_or("too many vertices for a writhe")?;
    let note = "of the filament with straight extensions of both ends; 0 for a plane curve";
    draft.row("buckling/writhe", "", writhe, note);
    for (i, linker) in linked.assembly.linkers.iter().enumerate() {
        let force = linker.force(linked.state()).norm();
        let quantity = format!("linkers/{i}/force");
        draft.row(quantity, "pN", force, "force of the linker");
    }
    finish(draft, sheet, &solved)
}

/// Sheet of the figure, and its scenes in equilibrium.
fn solve(draft: &Draft<'_>) -> Result<(&'static Sheet, Vec<Solution>), String> {
    let sheet = Sheet::of(draft.id)?;
    let solved = draft.solve(&sheet.scenes, |name| {
        let scene = scenario(&format!("{name}.ron"))?;
        solved(&scene).map_err(|e| format!("{name}.ron: {e}"))
    });
    Ok((sheet, solved?))
}

fn finish(draft: &mut Draft<'_>, sheet: &Sheet, solved: &[Solution]) -> Result<(), String> {
    let file = format!("{}.svg", draft.id);
    save(draft.out, &file, &sheet.svg(draft.id, solved))?;
    let caption = sheet.caption.clone();
    draft.pictures.push(Picture { file, caption });
    let scenes = sheet.scenes.iter().zip(solved);
    let shown: Vec<_> = scenes
        .map(|(name, solved)| counted(draft, name, solved))
        .collect();
    settings(draft, &sheet.scenes, solved)?;
    draft.view(draft.id, "schematics", shown)
}

/// Adds rows of counts of bodies, and returns the state for the viewer.
fn counted(draft: &mut Draft<'_>, name: &str, solved: &Solution) -> (String, String, f64, Pose) {
    let name = name.rsplit('/').next().unwrap_or(name);
    let counts = solved.assembly.counts();
    for (quantity, number) in [
        ("monomers", counts.monomers),
        ("bonds", counts.bonds),
        ("segments", counts.segments),
        ("junctions", counts.junctions),
    ] {
        let note = "in the scene that is drawn";
        draft.row(format!("{name}/{quantity}"), "", number as f64, note);
    }
    let rods = counts.segments as f64;
    // Approximate share: segments are up to 10 nm long, monomers have a rise of 2.7 nm.
    let share = rods / (rods + counts.monomers as f64);
    ("all".to_owned(), name.to_owned(), share, pose(solved))
}

fn settings(draft: &mut Draft<'_>, names: &[String], solved: &[Solution]) -> Result<(), String> {
    let names: Vec<String> = names.iter().map(|name| format!("{name}.ron")).collect();
    let stable = solved.iter().filter(|s| doubtful(s) == Some([0, 0]));
    let seeds = solved
        .iter()
        .map(|s| s.assembly.scene.filament.monomers.seed);
    let seeds: BTreeSet<u64> = seeds.collect();
    let seeds: Vec<String> = seeds.iter().map(u64::to_string).collect();
    let values: Values<'_> = &[
        ("files", &names.join(", ")),
        ("residuals", &residuals(solved.iter().map(residual))),
        ("stable", &stable.count()),
        ("count", &solved.len()),
        ("seeds", &seeds.join(", ")),
    ];
    draft.describe("schematics", values)
}
