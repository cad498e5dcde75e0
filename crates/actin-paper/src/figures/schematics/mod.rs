//! Figures 1 to 3: the models, their junction and typical scenes, drawn from equilibria of scenes in `scenarios`.

mod annotations;
mod style;

use super::draft::{Draft, residuals};
use crate::palette;
use crate::run::{SolvedScene, scenario};
use actin_draw::report::{Picture, save};
use actin_draw::scene3d::{Camera, Item, Key, Label, Panel, Sheet};
use actin_mechanics::Vector3;
use actin_sim::shape::Ribbon;
use actin_sim::{BodyKind, End, JunctionBond};
use actin_view::{Attitude, Drawing, Pose, bodies};
use std::collections::BTreeSet;

const CAPTION_1: &str = "Filament of 52 nm, clamped at the bottom, with a lateral tip force of 10 pN: (a) monomers, \
    (b) monomers joined to a rod, (c) a rod; its cylinders have the cross-section of its mass, 38.5 nm^2. (d) \
    close-up of the middle of (a). Ellipsoids are translucent and have their true semi-axes; each bond connects its \
    two anchors. All 16 bonds per interface are drawn; simulations have 64.";
const CAPTION_2: &str = "Junction between 26 nm of monomers, clamped at the far end, and a rod bent by 10 pN: (a) \
    with the two bonds side by side, (b) along the centre line, from the end of the rod, (c) perpendicular to the \
    plane of bending. Two bonds (yellow) connect the centres of the last two monomers with the end of the rod. Each \
    has its own frame, drawn at its middle, between the frame of its monomer and the frame of the first segment. \
    Ellipsoids are translucent.";
const CAPTION_3: &str = "Filaments of monomers and rod: (a) 100 nm, clamped, with a tip force of 5 pN; (b) 160 nm, \
    both ends turned by 150 deg in opposite directions (over-twist) and moved inwards by 8 nm each. The filament \
    buckles slightly out of a plane; it is seen from the side and along its axis. Arcs show the turns, straight \
    arrows the shifts, both to scale; (c) 110 nm, held only by four linkers to fixed anchors.";

/// Figure 1: monomers, monomers joined to a rod, and a rod under the same force; close-up of bonds.
pub(super) fn figure1(draft: &mut Draft<'_>) -> Result<(), String> {
    let names = ["figure-1/monomers", "figure-1/coupled", "figure-1/rod"];
    let solved = solve(draft, &names)?;
    let titles = ["(a) monomers", "(b) joined", "(c) rod"];
    let filaments = solved.iter().zip(titles).zip(0..);
    let mut panels: Vec<Panel> = filaments
        .map(|((solved, title), k)| standing(solved, title, 8.0 + 230.0 * f64::from(k)))
        .collect();
    let monomers = whole(&solved[0]);
    let near = Drawing {
        range_nm: [20.0, 33.0],
        ..monomers
    };
    panels.push(bonds_of(&near));
    bond_counts(draft, [&monomers, &near]);
    let (radius, rise) = radius_and_rise_nm(&solved[0]);
    draft.row("radius", "nm", radius, HELIX);
    draft.row("rise", "nm", rise, HELIX);
    let junction = [style::junction()];
    let legend = [
        style::bodies(),
        style::bonds(),
        junction.into(),
        style::axes(),
        style::holds("force"),
    ];
    finish(
        draft,
        (&names, &solved),
        ([1040.0, 550.0], panels, &legend),
        CAPTION_1,
    )
}

const HELIX: &str = "of the helix through the centres of the bent filament, from root mean square distances to the \
    next two monomers; at rest 1.8 and 2.7385";

fn bonds_of(drawn: &Drawing<'_>) -> Panel {
    let place = [708.0, 6.0, 324.0, 540.0];
    let items = [drawn.monomers(0.3), annotations::bonds(drawn, 2.0).items].concat();
    Panel {
        title: "(d) bonds of (a)".into(),
        place,
        camera: camera(
            (Vector3::new(0.3, -1.0, 0.1), Vector3::z()),
            &items,
            place,
            [14.0, 8.0, 14.0, 8.0],
        ),
        items,
        labels: Vec::new(),
        bar_nm: 2.0,
    }
}

fn whole(solved: &SolvedScene) -> Drawing<'_> {
    Drawing::new(&solved.assembly, solved.state(), palette::chosen())
}

/// Camera that fits all items into a panel with margins, for directions towards the viewer and upwards.
fn camera(
    (towards, up): (Vector3, Vector3),
    items: &[Item],
    place: [f64; 4],
    margins: [f64; 4],
) -> Camera {
    let attitude = Attitude {
        towards: towards.into(),
        up: up.into(),
    };
    let balls = items.iter().flat_map(|item| item.solid.balls());
    Camera::fitted(attitude, balls, Panel::area(place, margins))
}

fn bond_counts(draft: &mut Draft<'_>, drawn: [&Drawing<'_>; 2]) {
    for (drawn, panel) in drawn.into_iter().zip(["a", "d"]) {
        for (kind, count) in ["lateral", "longitudinal"]
            .into_iter()
            .zip(annotations::bonds(drawn, 1.0).counts)
        {
            let note = "lines in the picture, from anchor to anchor";
            draft.row(
                format!("{kind}_bonds_drawn/{panel}"),
                "",
                count as f64,
                note,
            );
        }
    }
}

fn standing(solved: &SolvedScene, title: &str, left: f64) -> Panel {
    let drawn = whole(solved);
    let nm_per_pn = 0.9;
    let place = [left, 6.0, 230.0, 540.0];
    let items = [
        drawn.clamps(6.0),
        drawn.monomers(0.8),
        annotations::bonds(&drawn, 1.0).items,
        annotations::rods(&drawn, 0.28),
        annotations::segment_frames(&drawn, 4.6),
        drawn.junction_bonds(3.0),
        drawn.forces(3.0, |force| force * nm_per_pn),
    ]
    .concat();
    Panel {
        title: title.into(),
        place,
        camera: camera(
            (Vector3::new(-0.35, -1.0, 0.25), Vector3::z()),
            &items,
            place,
            [14.0, 18.0, 14.0, 8.0],
        ),
        items,
        labels: forces(&drawn, nm_per_pn, [0.0, -16.0]),
        bar_nm: 10.0,
    }
}

fn forces(drawn: &Drawing<'_>, nm_per_pn: f64, offset: [f64; 2]) -> Vec<Label> {
    let forces = bodies::forces(drawn.assembly, drawn.state).into_iter();
    let labels = forces.map(|(at, force)| Label {
        at: at + force * nm_per_pn,
        text: format!("{} pN", force.norm()),
        offset,
    });
    labels.collect()
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
fn radius_and_rise_nm(solved: &SolvedScene) -> (f64, f64) {
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
    let turn = solved
        .assembly
        .scene
        .filament
        .monomers
        .turn_deg
        .to_radians();
    let across = |angle: f64| 4.0 * (0.5 * angle).sin().powi(2);
    let (one, two) = (across(turn), across(2.0 * turn));
    let (a, b) = (mean_square(1), mean_square(2));
    let radius_square = (4.0 * a - b) / (4.0 * one - two);
    (radius_square.sqrt(), (a - one * radius_square).sqrt())
}

/// Figure 2: junction of monomers and rod from three directions.
pub(super) fn figure2(draft: &mut Draft<'_>) -> Result<(), String> {
    let names = ["figure-2/junction"];
    let solved = solve(draft, &names)?;
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let shown_nm = [9.0, 48.0];
    let both = (2.0 * x + 1.2 * y - 0.5 * z, 1.2 * x - 2.0 * y);
    let along = (z + 0.12 * x + 0.05 * y, x);
    let mut panels: Vec<Panel> = [
        (
            "(a) both bonds and their frames",
            [8.0, 6.0, 1064.0, 380.0],
            both,
            shown_nm,
        ),
        (
            "(b) along the centre line",
            [8.0, 392.0, 410.0, 330.0],
            along,
            [20.0, 39.0],
        ),
        (
            "(c) across the plane of bending",
            [426.0, 392.0, 646.0, 330.0],
            (y + 0.1 * z, x),
            shown_nm,
        ),
    ]
    .into_iter()
    .map(|(title, place, view, range_nm)| joint(&solved[0], title, place, view, range_nm))
    .collect();
    let drawn = whole(&solved[0]);
    panels[0].labels = bond_names(&drawn);
    bond_rows(draft, &drawn);
    let legend = [style::bodies(), vec![style::junction()], style::axes()];
    finish(
        draft,
        (&names, &solved),
        ([1080.0, 730.0], panels, &legend),
        CAPTION_2,
    )
}

fn joint(
    solved: &SolvedScene,
    title: &str,
    place: [f64; 4],
    view: (Vector3, Vector3),
    range_nm: [f64; 2],
) -> Panel {
    let drawn = Drawing {
        range_nm,
        ..whole(solved)
    };
    let frames: Vec<Item> = numbered_bonds(&drawn)
        .into_iter()
        .flat_map(|(_, bond)| {
            let [monomer, node] = bodies::ends_of(&bond, drawn.state);
            annotations::frame(&drawn, bond.frame, 0.5 * (monomer + node), 3.0)
        })
        .collect();
    let items = [
        drawn.monomers(0.4),
        annotations::rods(&drawn, 0.22),
        annotations::segment_frames(&drawn, 4.2),
        drawn.junction_bonds(4.0),
        frames,
    ]
    .concat();
    Panel {
        title: title.into(),
        place,
        camera: camera(view, &items, place, [20.0, 10.0, 20.0, 8.0]),
        items,
        labels: Vec::new(),
        bar_nm: 5.0,
    }
}

/// Bonds of the junction, numbered from the end of the rod.
fn numbered_bonds(drawn: &Drawing<'_>) -> Vec<(usize, JunctionBond)> {
    let bonds = drawn.assembly.junction_bonds();
    (1..=bonds.len()).rev().zip(bonds).collect()
}

/// Labels of monomer and frame of each bond, with offsets in pixels (right, down).
fn bond_names(drawn: &Drawing<'_>) -> Vec<Label> {
    let offsets = [
        [[-100.0, -120.0], [-20.0, -155.0]],
        [[-124.0, 120.0], [-20.0, 155.0]],
    ];
    let mut labels = Vec::new();
    let mut name = |at, text: String, offset| labels.push(Label { at, text, offset });
    for (k, bond) in numbered_bonds(drawn) {
        let [monomer, node] = bodies::ends_of(&bond, drawn.state);
        let [monomer_offset, frame_offset] = offsets[k - 1];
        name(monomer, format!("monomer {k}"), monomer_offset);
        name(
            0.5 * (monomer + node),
            format!("frame {k} (Q_MR)"),
            frame_offset,
        );
        if k == 1 {
            name(node, "end of the rod".into(), [60.0, 140.0]);
        }
    }
    labels
}

fn bond_rows(draft: &mut Draft<'_>, drawn: &Drawing<'_>) {
    let rest = &drawn.assembly.rest;
    for (k, bond) in numbered_bonds(drawn) {
        let [length, rest_length] = [drawn.state, rest].map(|state| {
            let [monomer, node] = bodies::ends_of(&bond, state);
            (node - monomer).norm()
        });
        let [now, built] =
            [drawn.state, rest].map(|state| state.frames.orientation.get(bond.frame));
        let from = "from the centre of the monomer to the end of the rod";
        draft.row(format!("bond-{k}/length"), "nm", length, from);
        draft.row(format!("bond-{k}/rest_length"), "nm", rest_length, from);
        let turn = (now * built.inverse()).angle().to_degrees();
        draft.row(
            format!("bond-{k}/turn"),
            "deg",
            turn,
            "rotation of the bond frame relative to the built state",
        );
    }
}

/// Figure 3: cantilever, buckled filament, and filament on linkers.
pub(super) fn figure3(draft: &mut Draft<'_>) -> Result<(), String> {
    let names = [
        "figure-3/cantilever",
        "figure-3/buckling",
        "figure-3/linkers",
    ];
    let solved = solve(draft, &names)?;
    let panels = example_panels(&solved);
    example_rows(draft, &solved)?;
    let legend = [
        style::bodies(),
        style::holds("force, shift, turn"),
        style::linkers(),
    ];
    finish(
        draft,
        (&names, &solved),
        ([1080.0, 680.0], panels, &legend),
        CAPTION_3,
    )
}

fn example_panels(solved: &[SolvedScene]) -> Vec<Panel> {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let side = y + 0.3 * x + 0.2 * z;
    let panels = [
        (0, "(a) cantilever", [8.0, 6.0, 410.0, 330.0], side),
        (
            1,
            "(b) twisted and compressed",
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
    let panels = panels.into_iter();
    let panels =
        panels.map(|(k, title, place, towards)| example(&solved[k], title, place, towards));
    panels.collect()
}

fn example(solved: &SolvedScene, title: &str, place: [f64; 4], towards_viewer: Vector3) -> Panel {
    let drawn = whole(solved);
    let nm_per_pn = 3.5;
    let mut items = [
        drawn.clamps(8.0),
        drawn.monomers(1.0),
        annotations::rods(&drawn, 0.3),
        drawn.forces(3.0, |force| force * nm_per_pn),
        annotations::imposed(&drawn, 6.0),
    ]
    .concat();
    if solved.assembly.clamps.is_empty() {
        items.extend(drawn.linkers(2.2, 6.0, true));
    }
    Panel {
        title: title.into(),
        place,
        camera: camera(
            (towards_viewer, Vector3::x()),
            &items,
            place,
            [20.0, 8.0, 20.0, 26.0],
        ),
        items,
        labels: forces(&drawn, 0.5 * nm_per_pn, [-14.0, 0.0]),
        bar_nm: 20.0,
    }
}

fn example_rows(draft: &mut Draft<'_>, solved: &[SolvedScene]) -> Result<(), String> {
    let [cantilever, buckled, linked] = solved else {
        return Err("Figure 3 requires three scenes".into());
    };
    let tip = |state| cantilever.assembly.tip_nm(state, End::End);
    let moved = tip(cantilever.state()) - tip(&cantilever.assembly.rest);
    draft.row(
        "cantilever/deflection",
        "nm",
        -moved.x,
        "of the tip, along the force",
    );
    let ribbon = Ribbon::new(&buckled.assembly, buckled.state());
    let note = "largest distance of the centre line from the axis";
    draft.row("buckling/height", "nm", ribbon.largest_distance_nm(), note);
    let writhe = ribbon.writhe().ok_or("too many vertices for a writhe")?;
    let note = "of the filament with straight extensions of both ends; 0 for a plane curve";
    draft.row("buckling/writhe", "", writhe, note);
    for (i, linker) in linked.assembly.linkers.iter().enumerate() {
        let force = linker.force(linked.state()).norm();
        draft.row(
            format!("linkers/{i}/force"),
            "pN",
            force,
            "force of the linker",
        );
    }
    Ok(())
}

fn solve(draft: &Draft<'_>, names: &[&str]) -> Result<Vec<SolvedScene>, String> {
    let solved = draft.solve(names, |name| {
        let scene = scenario(&format!("{name}.ron"))?;
        SolvedScene::new(&scene).map_err(|e| format!("{name}.ron: {e}"))
    });
    solved.into_iter().collect()
}

fn file_name(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or(name)
}

/// Size (pixels), panels and legend of a picture.
type Composition<'a> = ([f64; 2], Vec<Panel>, &'a [Vec<(Key, String)>]);

fn finish(
    draft: &mut Draft<'_>,
    (names, solved): (&[&str], &[SolvedScene]),
    ([width, height], panels, legend): Composition<'_>,
    caption: &str,
) -> Result<(), String> {
    let sheet = Sheet {
        prefix: draft.id,
        width,
        height,
        panels,
        legend: legend.concat(),
    };
    let file = format!("{}.svg", draft.id);
    save(draft.out, &file, &sheet.svg())?;
    draft.pictures.push(Picture {
        file,
        caption: caption.into(),
    });
    let shown: Vec<_> = names
        .iter()
        .zip(solved)
        .map(|(name, solved)| counted(draft, file_name(name), solved))
        .collect();
    let attitude = match draft.id {
        "fig1" => Attitude::VERTICAL,
        _ => Attitude::HORIZONTAL,
    };
    draft.settings = settings(names, solved);
    draft.view(
        draft.id,
        attitude,
        shown,
        "Equilibria in the interactive view.",
    )
}

/// Adds rows of counts of bodies, and returns the state for the viewer.
fn counted(draft: &mut Draft<'_>, name: &str, solved: &SolvedScene) -> (String, String, f64, Pose) {
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
    ("all".to_owned(), name.to_owned(), share, solved.pose())
}

fn settings(names: &[&str], solved: &[SolvedScene]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("{name}.ron")).collect();
    let stable = solved
        .iter()
        .filter(|s| s.doubtful() == Some([0, 0]))
        .count();
    let seeds = solved
        .iter()
        .map(|s| s.assembly.scene.filament.monomers.seed);
    let seeds: BTreeSet<u64> = seeds.collect();
    let seeds: Vec<String> = seeds.iter().map(u64::to_string).collect();
    format!(
        "Scenes scenarios/: {}. Each is drawn in equilibrium: {}, {stable} of {} certified stable. Positions, \
         orientations, semi-axes and ends of bonds are from the state; the projection is \
         orthographic. Seed of the bonds: {}.",
        names.join(", "),
        residuals(solved.iter().map(SolvedScene::residual)),
        solved.len(),
        seeds.join(", "),
    )
}
