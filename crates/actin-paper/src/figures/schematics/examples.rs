//! Figure 3: the three kinds of scenes: a cantilever, a filament turned and pushed together until
//! it buckles, a filament held by linkers.

use super::filament::Drawn;
use super::solved::Solved;
use super::{artefact, imposed, style};
use crate::figures::Run;
use actin_draw::report::{Artefact, Row};
use actin_draw::scene3d::{Item, Label, Panel, Sheet, View};
use actin_mechanics::Vector3;
use actin_sim::shape::Ribbon;
use std::time::Instant;

const ID: &str = "fig3";
/// Half the width of a wall (nm).
const WALL_NM: f64 = 8.0;
/// Radius of the arcs of turns (nm).
const ARC_NM: f64 = 6.0;
/// Length of arrows per force (nm/pN).
const NM_PER_PN: f64 = 3.5;

/// Solves the scenes, draws them and says what is seen.
pub(in crate::figures) fn reproduce(Run { out, .. }: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let names = [
        "figure-3/cantilever",
        "figure-3/buckling",
        "figure-3/linkers",
    ];
    let solved: Vec<Solved> = names
        .into_iter()
        .map(Solved::new)
        .collect::<Result<_, _>>()?;
    let sheet = sheet(&solved);
    let caption = "Filaments of monomers and rod: (a) 100 nm on a wall, 5 pN down at the tip; (b) 160 \
        nm, both ends turned by 150 deg in opposite senses, which over-twists, and moved in by 8 nm \
        each, so that it buckles, a little out of a plane, seen from the side and along its axis; arcs show the turns, straight arrows the shifts, both to scale; (c) 110 nm held by nothing but four \
        linkers to fixed anchors.";
    let title = "Three kinds of scenes";
    let picture = (&sheet, caption.to_owned());
    artefact(
        (ID, title),
        &solved,
        picture,
        rows(&solved)?,
        (out, started),
    )
}

fn sheet(solved: &[Solved]) -> Sheet {
    let mut legend = style::bodies();
    legend.extend(style::holds("force, shift, turn"));
    legend.extend(style::linkers());
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let side = y + 0.3 * x + 0.2 * z;
    let panels = [
        (0, "(a) cantilever", [8.0, 6.0, 410.0, 330.0], side),
        (
            1,
            "(b) turned and pushed together",
            [426.0, 6.0, 646.0, 330.0],
            side,
        ),
        (
            2,
            "(c) linkers",
            [8.0, 342.0, 690.0, 330.0],
            y + 0.5 * x + 0.2 * z,
        ),
        (
            1,
            "(b) along the axis",
            [706.0, 342.0, 366.0, 330.0],
            z + 0.1 * x,
        ),
    ];
    let panels = panels.map(|(k, title, place, towards_viewer)| {
        let view = View {
            towards_viewer,
            up: x,
        };
        panel(&solved[k], title, place, view)
    });
    Sheet {
        prefix: ID,
        width: 1080.0,
        height: 680.0,
        panels: panels.into(),
        legend,
    }
}

fn panel(solved: &Solved, title: &str, place: [f64; 4], view: View) -> Panel {
    let drawn = Drawn::whole(&solved.assembly);
    let mut items: Vec<Item> = drawn.walls(WALL_NM);
    items.extend(drawn.monomers(1.0));
    items.extend(drawn.rods(0.3));
    items.extend(drawn.arrows(NM_PER_PN));
    items.extend(imposed::arrows(&drawn, ARC_NM));
    if solved.assembly.clamps.is_empty() {
        items.extend(drawn.linkers());
    }
    let forces = actin_view::bodies::forces(drawn.assembly, drawn.state)
        .into_iter()
        .map(|(at, force)| Label {
            at: at + force * (0.5 * NM_PER_PN),
            text: format!("{} pN", force.norm()),
            offset: [-14.0, 0.0],
        });
    Panel {
        title: title.into(),
        place,
        view,
        items,
        labels: forces.collect(),
        bar_nm: 20.0,
        room: [20.0, 8.0, 20.0, 26.0],
    }
}

fn rows(solved: &[Solved]) -> Result<Vec<Row>, String> {
    let mut rows: Vec<Row> = solved.iter().flat_map(|s| s.counts(ID)).collect();
    let state = |k: usize| solved[k].assembly.system.state();
    let tip = |k: usize, state| solved[k].assembly.tip_nm(state, actin_sim::End::End);
    let moved = tip(0, state(0)) - tip(0, &solved[0].assembly.rest);
    let ribbon = Ribbon::new(&solved[1].assembly, state(1));
    let row =
        |quantity: &str, unit, value, note: &str| Row::measured(ID, quantity, unit, value, note);
    rows.push(row(
        "cantilever/deflection",
        "nm",
        -moved.x,
        "of the tip, along the force",
    ));
    rows.push(row(
        "buckling/height",
        "nm",
        ribbon.largest_distance_nm(),
        "largest distance of the centre line from the axis",
    ));
    let writhe = ribbon.writhe().ok_or("too many vertices for a writhe")?;
    let note =
        "of the filament, straight beyond both ends; 0 for a plane curve: how far it is a helix";
    rows.push(row("buckling/writhe", "", writhe, note));
    let linkers = solved[2].assembly.linkers.iter().enumerate();
    rows.extend(linkers.map(|(i, linker)| {
        let force = linker.force(state(2)).norm();
        row(
            &format!("linkers/{i}/force"),
            "pN",
            force,
            "pull of the linker",
        )
    }));
    Ok(rows)
}
