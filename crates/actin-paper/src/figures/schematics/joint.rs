//! Figure 2: the junction of monomers and rod, from two sides and along the centre line.

use super::filament::Drawn;
use super::solved::Solved;
use super::{artefact, style};
use crate::figures::Run;
use actin_draw::report::{Artefact, Row};
use actin_draw::scene3d::{Item, Label, Panel, Sheet, View};
use actin_mechanics::Vector3;
use actin_sim::JunctionBond;
use std::time::Instant;

const ID: &str = "fig2";
/// Arc lengths that are shown (nm).
const SHOWN_NM: [f64; 2] = [9.0, 48.0];
const SHOWN_ALONG_NM: [f64; 2] = [20.0, 39.0];
const AXIS_NM: f64 = 3.0;
/// Where the names of monomer and frame of each bond stand (pixels, right and down).
const OFFSETS: [[[f64; 2]; 2]; 2] = [
    [[-100.0, -120.0], [-20.0, -155.0]],
    [[-124.0, 120.0], [-20.0, 155.0]],
];

/// Solves the scene, draws its junction and measures it.
pub(in crate::figures) fn reproduce(Run { out, .. }: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let solved = [Solved::new("figure-2/junction")?];
    let sheet = sheet(&solved[0]);
    let caption = "Where 26 nm of monomers, held at the far end, go over into a rod that 10 pN bend: \
        (a) with the two bonds side by side, (b) along the centre line, from the rod's end, (c) across the plane in which it bends. Two bonds \
        (yellow) run from the centres of the last two monomers to the rod's end; each has a frame \
        of its own, drawn at its middle, between the frame of its monomer and that of the rod's \
        first segment. Ellipsoids are translucent.";
    let title = "The junction of monomers and rod";
    let rows = rows(&solved[0]);
    artefact(
        (ID, title),
        &solved,
        (&sheet, caption.to_owned()),
        rows,
        (out, started),
    )
}

fn sheet(solved: &Solved) -> Sheet {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let both = panel(
        solved,
        "(a) both bonds and their frames",
        [8.0, 6.0, 1064.0, 380.0],
        (2.0 * x + 1.2 * y - 0.5 * z, 1.2 * x - 2.0 * y),
        SHOWN_NM,
    );
    let along = panel(
        solved,
        "(b) along the centre line",
        [8.0, 392.0, 410.0, 330.0],
        (z + 0.12 * x + 0.05 * y, x),
        SHOWN_ALONG_NM,
    );
    let across = panel(
        solved,
        "(c) across the plane of bending",
        [426.0, 392.0, 646.0, 330.0],
        (y + 0.1 * z, x),
        SHOWN_NM,
    );
    let mut legend = style::bodies();
    legend.push(style::junction());
    legend.extend(style::axes());
    Sheet {
        prefix: ID,
        width: 1080.0,
        height: 730.0,
        panels: vec![
            Panel {
                labels: names(&drawn(solved, SHOWN_NM)),
                ..both
            },
            along,
            across,
        ],
        legend,
    }
}

fn drawn(solved: &Solved, range_nm: [f64; 2]) -> Drawn<'_> {
    Drawn {
        range_nm,
        ..Drawn::whole(&solved.assembly)
    }
}

fn panel(
    solved: &Solved,
    title: &str,
    place: [f64; 4],
    (towards_viewer, up): (Vector3, Vector3),
    range_nm: [f64; 2],
) -> Panel {
    let drawn = drawn(solved, range_nm);
    let mut items = drawn.monomers(0.4);
    items.extend(drawn.rods(0.22));
    items.extend(drawn.segment_frames(AXIS_NM * 1.4));
    items.extend(drawn.junction_bonds(4.0));
    items.extend(frames(&drawn));
    Panel {
        title: title.into(),
        place,
        view: View { towards_viewer, up },
        items,
        labels: Vec::new(),
        bar_nm: 5.0,
        room: [20.0, 10.0, 20.0, 8.0],
    }
}

/// The bonds, each with its number counted from the rod's end.
fn numbered(drawn: &Drawn<'_>) -> Vec<(usize, JunctionBond)> {
    let bonds = drawn.assembly.junction_bonds();
    (1..=bonds.len()).rev().zip(bonds).collect()
}

/// Frames of the junction's bonds at their middles.
fn frames(drawn: &Drawn<'_>) -> Vec<Item> {
    let bonds = numbered(drawn).into_iter();
    bonds
        .flat_map(|(_, bond)| {
            let [monomer, node] = actin_view::bodies::ends_of(&bond, drawn.state);
            drawn.frame(bond.frame, 0.5 * (monomer + node), AXIS_NM)
        })
        .collect()
}

/// Names of all that is joined.
fn names(drawn: &Drawn<'_>) -> Vec<Label> {
    let mut labels = Vec::new();
    let mut name = |at, text: String, offset| labels.push(Label { at, text, offset });
    for (k, bond) in numbered(drawn) {
        let [monomer, node] = actin_view::bodies::ends_of(&bond, drawn.state);
        let [monomer_offset, frame_offset] = OFFSETS[k - 1];
        name(monomer, format!("monomer {k}"), monomer_offset);
        let text = format!("frame {k} (Q_MR)");
        name(0.5 * (monomer + node), text, frame_offset);
        if k == 1 {
            name(node, "end of the rod".into(), [60.0, 140.0]);
        }
    }
    labels
}

fn rows(solved: &Solved) -> Vec<Row> {
    let mut rows = solved.counts(ID);
    let drawn = Drawn::whole(&solved.assembly);
    let rest = Drawn {
        state: &solved.assembly.rest,
        ..drawn
    };
    for (k, bond) in numbered(&drawn) {
        let length = |drawn: &Drawn<'_>| {
            let [monomer, node] = actin_view::bodies::ends_of(&bond, drawn.state);
            (node - monomer).norm()
        };
        let turned = solved
            .assembly
            .system
            .state()
            .frames
            .orientation
            .get(bond.frame);
        let turned = turned * rest.state.frames.orientation.get(bond.frame).inverse();
        let row = |name: &str, unit, value, note: &str| {
            Row::measured(ID, format!("bond-{k}/{name}"), unit, value, note)
        };
        let from = "from the monomer's centre to the rod's end";
        rows.push(row("length", "nm", length(&drawn), from));
        rows.push(row("rest_length", "nm", length(&rest), from));
        let note = "of the bond's frame from how it was built";
        rows.push(row("turn", "deg", turned.angle().to_degrees(), note));
    }
    rows
}
