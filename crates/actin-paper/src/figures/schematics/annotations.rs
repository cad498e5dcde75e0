//! Bonds, frames and prescribed motions drawn in addition to the bodies of a [`Drawing`].

use super::style;
use actin_draw::scene3d::{Item, Solid, Stroke};
use actin_mechanics::{Vector3, rotation};
use actin_sim::{BodyKind, End, JunctionBond, Setting};
use actin_view::{Drawing, INSIDE_NM, bodies};

const PIECES: u32 = 24;
/// Distance of arrows and arcs from the clamped point (nm).
const CLEAR_NM: f64 = 3.0;

#[derive(Debug, Default)]
pub(super) struct BondItems {
    pub items: Vec<Item>,
    /// Numbers of lateral and longitudinal bonds.
    pub counts: [usize; 2],
}

/// Lines of all bonds between drawn monomers, from anchor to anchor.
pub(super) fn bonds(drawing: &Drawing<'_>, width: f64) -> BondItems {
    let mut drawn = BondItems::default();
    let sections = 0..drawing.assembly.sections.len();
    for bonds in sections.filter_map(|i| drawing.assembly.bonds_of(i)) {
        for pair in bonds.pairs() {
            let ends = [pair.lower, pair.upper].map(|k| bonds.monomers().point(k));
            if !are_shown(drawing, ends) {
                continue;
            }
            let kind = pair.upper - pair.lower - 1;
            let stroke = Stroke::solid(style::bond(kind), width);
            let lines = bonds.ends_of(pair, drawing.state);
            // Anchors lie on the surfaces, in front of the centres of the ellipsoids.
            let lines = lines.map(|ends| Item::line(ends, stroke).nearer(style::ON_SURFACE_NM));
            drawn.counts[kind] += pair.bonds;
            drawn.items.extend(lines);
        }
    }
    drawn
}

fn are_shown(drawing: &Drawing<'_>, points: [usize; 2]) -> bool {
    let mut places = points.iter().map(|&i| drawing.assembly.points[i].s_nm);
    places.all(|s_nm| drawing.shows(s_nm))
}

/// Cylinders of rod segments with centre lines and nodes.
pub(super) fn rods(drawing: &Drawing<'_>, opacity: f64) -> Vec<Item> {
    let cylinders = drawing.rods(opacity);
    let radius = bodies::rod_radius_nm();
    let stroke = Stroke::solid(style::rod().darker(0.3), 1.6);
    let lines = cylinders.iter().filter_map(|item| match item.solid {
        Solid::Cylinder { ends, .. } => Some(Item::line(ends, stroke).nearer(radius)),
        _ => None,
    });
    let lines: Vec<Item> = lines.collect();
    let nodes = drawing.points(BodyKind::Node).into_iter();
    let dots = nodes.map(|i| Item::dot(drawing.place(i), 3.4, style::of(|t| t.node)));
    let dots = dots.map(|dot| dot.nearer(2.0 * radius));
    cylinders.into_iter().chain(lines).chain(dots).collect()
}

pub(super) fn segment_frames(drawing: &Drawing<'_>, length_nm: f64) -> Vec<Item> {
    let mut items = Vec::new();
    let sections = drawing.assembly.sections.iter();
    for section in sections.filter(|s| !s.is_ellipsoids()) {
        for (axes, node) in section.frames.clone().zip(section.points.clone()) {
            if are_shown(drawing, [node, node + 1]) {
                let middle = 0.5 * (drawing.place(node) + drawing.place(node + 1));
                items.extend(frame(drawing, axes, middle, length_nm));
            }
        }
    }
    items
}

pub(super) fn frame(drawing: &Drawing<'_>, frame: usize, at: Vector3, length_nm: f64) -> Vec<Item> {
    let axes = drawing.axes(frame);
    let axis = |k: usize| {
        let ends = [at, at + axes.column(k) * length_nm];
        let stroke = Stroke::solid(style::axis(k), 2.0);
        Item::arrow(ends, stroke).nearer(INSIDE_NM)
    };
    [0, 1, 2].map(axis).into()
}

/// Bonds of the junction, numbered from the end of the rod.
pub(super) fn junction_bonds(drawn: &Drawing<'_>) -> Vec<(usize, JunctionBond)> {
    let bonds = drawn.assembly.junction_bonds();
    (1..=bonds.len()).rev().zip(bonds).collect()
}

/// Frames of junction bonds, each at the middle of its bond.
pub(super) fn bond_frames(drawing: &Drawing<'_>, length_nm: f64) -> Vec<Item> {
    let bonds = drawing.assembly.junction_bonds().into_iter();
    let frames = bonds.flat_map(|bond| {
        let [monomer, node] = bodies::ends_of(&bond, drawing.state);
        frame(drawing, bond.frame, 0.5 * (monomer + node), length_nm)
    });
    frames.collect()
}

/// Position of a clamped end (nm, lab frame), and unit vectors outward and across the built filament. `None` if the
/// end is free.
fn held(drawing: &Drawing<'_>, filament: usize, end: End) -> Option<[Vector3; 3]> {
    let clamp = drawing.assembly.clamp_at(filament, end)?;
    let built = drawing.assembly.filaments[filament].rotation;
    let outward = match end {
        End::Start => -Vector3::z(),
        End::End => Vector3::z(),
    };
    Some([
        clamp.point_nm(drawing.state),
        built * outward,
        built * Vector3::x(),
    ])
}

/// Prescribed motions of clamped ends: shifts as arrows to scale, turns as arcs of the true angle about the axis.
pub(super) fn imposed(drawing: &Drawing<'_>, radius_nm: f64) -> Vec<Item> {
    let stages = drawing.assembly.scene.path.iter();
    let settings = stages.flat_map(|stage| &stage.set);
    let items = settings.filter_map(|setting| match *setting {
        Setting::Shift {
            filament,
            end,
            shift_nm,
        } => Some(shift(held(drawing, filament, end)?, shift_nm.into())),
        Setting::Turn {
            filament,
            end,
            turn_deg,
        } => Some(turn(
            held(drawing, filament, end)?,
            turn_deg.into(),
            radius_nm,
        )),
        // Loads and anchors are drawn in their final state.
        Setting::LoadFactor { .. } | Setting::Shear { .. } | Setting::Anchor { .. } => None,
    });
    items.flatten().collect()
}

fn shift([at, outward, _]: [Vector3; 3], shift: Vector3) -> Vec<Item> {
    let to = at + outward * CLEAR_NM;
    vec![style::arrow([to - shift, to])]
}

fn turn([at, outward, across]: [Vector3; 3], turn_deg: Vector3, radius_nm: f64) -> Vec<Item> {
    let centre = at + outward * CLEAR_NM;
    let on_arc = |k: u32| {
        let share = f64::from(k) / f64::from(PIECES);
        let angle = turn_deg.map(f64::to_radians) * share;
        centre + rotation::exp(angle) * across * radius_nm
    };
    let stroke = Stroke::solid(style::of(|t| t.force), 2.2);
    let pieces = (0..PIECES - 1).map(|k| Item::line([on_arc(k), on_arc(k + 1)], stroke));
    let head = style::arrow([on_arc(PIECES - 3), on_arc(PIECES)]);
    pieces.chain([head]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{palette, workspace_root};
    use actin_sim::{Assembly, Scene};

    /// Three linked filaments with a force at the tip of the third one.
    fn linked() -> Assembly {
        let path = workspace_root().join("scenarios/crosslinked.ron");
        let text = std::fs::read_to_string(path).unwrap();
        let pulled = text.replace("EndForce(end", "EndForce(filament: 2, end");
        assert_ne!(pulled, text);
        Assembly::build(&Scene::from_ron(&pulled).unwrap()).unwrap()
    }

    /// Guards against drawing only the first filament, segments between filaments, and forces or clamps at the first
    /// one.
    #[test]
    fn all_filaments_are_drawn_at_their_positions() {
        let assembly = linked();
        let drawn = Drawing::new(&assembly, assembly.system.state(), palette::chosen());
        let counts = assembly.counts();
        assert_eq!(drawn.monomers(1.0).len(), counts.monomers);
        let rods = drawn.rods(1.0);
        assert_eq!(rods.len(), counts.segments);
        assert!(rods.iter().all(|item| match item.solid {
            Solid::Cylinder { ends: [a, b], .. } => (b - a).norm() < 11.0,
            _ => false,
        }));
        assert_eq!(bonds(&drawn, 1.0).items.len(), counts.bonds);
        assert_eq!(
            drawn.linkers(1.0, 1.0, true).len(),
            3 * assembly.linkers.len()
        );
        assert!(bodies::anchors(&assembly, assembly.system.state()).is_empty());
        for (plate, axis_x) in bodies::plates(&assembly, drawn.state, 6.0)
            .iter()
            .zip([0.0, 12.0, 24.0])
        {
            let middle = plate.iter().sum::<Vector3>() / 4.0;
            assert!((middle - Vector3::new(axis_x, 0.0, 0.0)).norm() < 1e-9);
        }
        let [(at, force)] = bodies::forces(&assembly, drawn.state)[..] else {
            panic!("one force");
        };
        assert!((at.x - 24.0).abs() < 1e-9 && (force.x + 2.0).abs() < 1e-12);
    }
}
