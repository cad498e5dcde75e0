//! Figure 1: monomers, monomers joined to a rod, and a rod, of one length under one force; and the
//! bonds between a few monomers from near by.

use super::filament::Drawn;
use super::solved::Solved;
use super::{artefact, style};
use crate::figures::Run;
use actin_draw::report::{Artefact, Row};
use actin_draw::scene3d::{Item, Label, Panel, Sheet, View};
use actin_mechanics::Vector3;
use std::time::Instant;

const ID: &str = "fig1";
/// Length of arrows per force (nm/pN).
const NM_PER_PN: f64 = 0.9;
/// Length of a frame's axes (nm).
const AXIS_NM: f64 = 4.6;
/// Half the width of a wall (nm).
const WALL_NM: f64 = 6.0;
/// Arc lengths of the monomers that are seen from near by (nm).
const NEAR_NM: [f64; 2] = [20.0, 33.0];

/// Solves the scenes, draws them and says what is seen.
pub(in crate::figures) fn reproduce(Run { out, .. }: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let names = ["figure-1/monomers", "figure-1/coupled", "figure-1/rod"];
    let solved: Vec<Solved> = names
        .into_iter()
        .map(Solved::new)
        .collect::<Result<_, _>>()?;
    let sheet = sheet(&solved);
    let caption = "A filament of 52 nm, held below and pulled sideways at its tip by 10 pN: (a) as \
        monomers, (b) as monomers joined to a rod, (c) as a rod whose cylinders have the \
        cross-section of its mass, 38.5 nm^2. (d) The middle of (a) from near by. Ellipsoids are \
        drawn with their own semi-axes, translucent; each bond runs from its anchor on one to that \
        on the other. There are 16 bonds per interface here, and all are drawn; simulations have 64.";
    let title = "The two models and their combination";
    let picture = (&sheet, caption.to_owned());
    artefact((ID, title), &solved, picture, rows(&solved), (out, started))
}

fn sheet(solved: &[Solved]) -> Sheet {
    let titles = ["(a) monomers", "(b) joined", "(c) rod"];
    let filaments = solved.iter().zip(titles).zip(0..);
    let mut panels: Vec<Panel> = filaments
        .map(|((solved, title), k)| filament(solved, title, 8.0 + 230.0 * f64::from(k)))
        .collect();
    panels.push(near(&solved[0]));
    let mut legend = style::bodies();
    legend.extend(style::bonds());
    legend.push(style::junction());
    legend.extend(style::axes());
    legend.extend(style::holds("force"));
    Sheet {
        prefix: ID,
        width: 1040.0,
        height: 550.0,
        panels,
        legend,
    }
}

/// A filament standing upright.
fn filament(solved: &Solved, title: &str, left: f64) -> Panel {
    let drawn = Drawn::whole(&solved.assembly);
    let mut items: Vec<Item> = drawn.walls(WALL_NM);
    items.extend(drawn.monomers(0.8));
    items.extend(drawn.bonds(1.0).items);
    items.extend(drawn.rods(0.28));
    items.extend(drawn.segment_frames(AXIS_NM));
    items.extend(drawn.junction_bonds(3.0));
    items.extend(drawn.arrows(NM_PER_PN));
    let force = actin_view::bodies::forces(drawn.assembly, drawn.state)
        .into_iter()
        .map(|(at, force)| Label {
            at: at + force * NM_PER_PN,
            text: format!("{} pN", force.norm()),
            offset: [0.0, -16.0],
        });
    Panel {
        title: title.into(),
        place: [left, 6.0, 230.0, 540.0],
        view: View {
            towards_viewer: Vector3::new(-0.35, -1.0, 0.25),
            up: Vector3::z(),
        },
        items,
        labels: force.collect(),
        bar_nm: 10.0,
        room: [14.0, 18.0, 14.0, 8.0],
    }
}

/// The bonds of a few monomers.
fn near(solved: &Solved) -> Panel {
    let drawn = near_part(solved);
    let mut items = drawn.monomers(0.3);
    items.extend(drawn.bonds(2.0).items);
    Panel {
        title: "(d) bonds of (a)".into(),
        place: [708.0, 6.0, 324.0, 540.0],
        view: View {
            towards_viewer: Vector3::new(0.3, -1.0, 0.1),
            up: Vector3::z(),
        },
        items,
        labels: Vec::new(),
        bar_nm: 2.0,
        room: [14.0, 8.0, 14.0, 8.0],
    }
}

fn near_part(solved: &Solved) -> Drawn<'_> {
    Drawn {
        range_nm: NEAR_NM,
        ..Drawn::whole(&solved.assembly)
    }
}

fn rows(solved: &[Solved]) -> Vec<Row> {
    let mut rows: Vec<Row> = solved.iter().flat_map(|s| s.counts(ID)).collect();
    let monomers = &solved[0];
    let [lateral, longitudinal] = Drawn::whole(&monomers.assembly).bonds(1.0).counts;
    let [near_lateral, near_longitudinal] = near_part(monomers).bonds(1.0).counts;
    let drawn = [
        ("lateral_bonds_drawn/a", lateral),
        ("longitudinal_bonds_drawn/a", longitudinal),
        ("lateral_bonds_drawn/d", near_lateral),
        ("longitudinal_bonds_drawn/d", near_longitudinal),
    ];
    rows.extend(drawn.map(|(quantity, number)| {
        let note = "lines in the picture, from anchor to anchor";
        Row::measured(ID, quantity, "", number as f64, note)
    }));
    let (radius, rise) = monomers.radius_and_rise_nm();
    let note = "of the helix through the bent filament's centres, from root mean square distances \
                to the next monomer and the one after; at rest 1.8 and 2.7385";
    rows.push(Row::measured(ID, "radius", "nm", radius, note));
    rows.push(Row::measured(ID, "rise", "nm", rise, note));
    rows
}
