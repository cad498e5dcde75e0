//! Solids of all filaments of an assembly in a state.

use super::style;
use actin_draw::scene3d::{Item, Solid, Stroke};
use actin_mechanics::{Matrix3, State, Vector3, rotation};
use actin_sim::{Assembly, BodyKind, End, Setting};
use actin_view::bodies;

const PIECES: u32 = 24;
/// Distance of arrows and arcs from the clamped point (nm).
const CLEAR_NM: f64 = 3.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct FilamentDrawing<'a> {
    pub assembly: &'a Assembly,
    pub state: &'a State,
    /// Drawn range of arc length (nm).
    pub range_nm: [f64; 2],
}

#[derive(Debug, Default)]
pub(super) struct BondItems {
    pub items: Vec<Item>,
    /// Numbers of lateral and longitudinal bonds.
    pub counts: [usize; 2],
}

impl<'a> FilamentDrawing<'a> {
    /// Complete filaments in the current state of the system.
    pub(super) fn whole(assembly: &'a Assembly) -> Self {
        Self {
            assembly,
            state: assembly.system.state(),
            range_nm: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    fn shows(&self, s_nm: f64) -> bool {
        (self.range_nm[0]..=self.range_nm[1]).contains(&s_nm)
    }

    pub(super) fn place(&self, point: usize) -> Vector3 {
        self.state.points.position.get(point)
    }

    fn matrix(&self, frame: usize) -> Matrix3 {
        let orientation = self.state.frames.orientation.get(frame);
        orientation.to_rotation_matrix().into_inner()
    }

    pub(super) fn points(&self, kind: BodyKind) -> Vec<usize> {
        let points = self.assembly.points.iter().enumerate();
        let shown = points.filter(|(_, info)| info.kind == kind && self.shows(info.s_nm));
        shown.map(|(i, _)| i).collect()
    }

    /// Ellipsoids of monomers in their principal frames.
    pub(super) fn monomers(&self, opacity: f64) -> Vec<Item> {
        let monomers = self.points(BodyKind::Monomer).into_iter();
        let body = monomers.filter_map(|i| Some((i, self.assembly.points[i].frame?)));
        body.map(|(i, frame)| {
            let filament = self.assembly.filament_of_point(i);
            let semi_axes = Vector3::from(self.assembly.monomers_of(filament).semi_axes_nm);
            let solid = Solid::Ellipsoid {
                centre: self.place(i),
                semi_axes: self.matrix(frame) * Matrix3::from_diagonal(&semi_axes),
            };
            Item::new(solid, style::monomer()).with_opacity(opacity)
        })
        .collect()
    }

    /// Lines of all bonds between drawn monomers, from anchor to anchor.
    pub(super) fn bonds(&self, width: f64) -> BondItems {
        let mut drawn = BondItems::default();
        let sections = 0..self.assembly.sections.len();
        for bonds in sections.filter_map(|i| self.assembly.bonds_of(i)) {
            for pair in bonds.pairs() {
                let ends = [pair.lower, pair.upper].map(|k| bonds.monomers().point(k));
                if !ends
                    .iter()
                    .all(|&i| self.shows(self.assembly.points[i].s_nm))
                {
                    continue;
                }
                let kind = pair.upper - pair.lower - 1;
                let stroke = Stroke::solid(style::bond(kind), width);
                let lines = bonds.ends_of(pair, self.state);
                // Anchors lie on the surfaces, in front of the centres of the ellipsoids.
                let lines = lines.map(|ends| Item::line(ends, stroke).nearer(style::ON_SURFACE_NM));
                drawn.counts[kind] += pair.bonds;
                drawn.items.extend(lines);
            }
        }
        drawn
    }

    /// Segments as cylinders of the cross-section of the rod, with centre line and nodes.
    pub(super) fn rods(&self, opacity: f64) -> Vec<Item> {
        let radius = bodies::rod_radius_nm();
        let mut items = Vec::new();
        for ends in self.segments() {
            let cylinder = Item::new(Solid::Cylinder { ends, radius }, style::rod());
            items.push(cylinder.with_opacity(opacity));
            let line = Item::line(ends, Stroke::solid(style::rod().darker(0.3), 1.6));
            items.push(line.nearer(radius));
        }
        items.extend(self.points(BodyKind::Node).into_iter().map(|i| {
            let dot = Solid::Dot {
                at: self.place(i),
                pixels: 3.4,
            };
            Item::new(dot, style::of(|t| t.node)).nearer(2.0 * radius)
        }));
        items
    }

    /// Both nodes of every drawn segment.
    fn segments(&self) -> Vec<[Vector3; 2]> {
        let nodes = self.points(BodyKind::Node);
        let next = nodes.windows(2).filter(|pair| {
            let sections = self.assembly.sections.iter();
            let same = |i: &usize| sections.clone().position(|s| s.points.contains(i));
            pair[1] == pair[0] + 1 && same(&pair[0]) == same(&pair[1])
        });
        next.map(|pair| [self.place(pair[0]), self.place(pair[1])])
            .collect()
    }

    pub(super) fn segment_frames(&self, length_nm: f64) -> Vec<Item> {
        let mut items = Vec::new();
        for section in self.assembly.sections.iter().filter(|s| !s.is_ellipsoids()) {
            for (frame, node) in section.frames.clone().zip(section.points.clone()) {
                let nodes = [node, node + 1];
                if nodes
                    .iter()
                    .all(|&i| self.shows(self.assembly.points[i].s_nm))
                {
                    let middle = 0.5 * (self.place(node) + self.place(node + 1));
                    items.extend(self.frame(frame, middle, length_nm));
                }
            }
        }
        items
    }

    pub(super) fn frame(&self, frame: usize, at: Vector3, length_nm: f64) -> Vec<Item> {
        let axes = self.matrix(frame);
        let axis = |k: usize| {
            let ends = [at, at + axes.column(k) * length_nm];
            let stroke = Stroke::solid(style::axis(k), 2.0);
            Item::new(Solid::Arrow { ends, stroke }, stroke.colour).nearer(style::INSIDE_NM)
        };
        [0, 1, 2].map(axis).into()
    }

    pub(super) fn junction_bonds(&self, width: f64) -> Vec<Item> {
        let bonds = self.assembly.junction_bonds().into_iter();
        let edge = Stroke::solid(style::of(|t| t.junction).darker(0.55), width + 2.0);
        let core = Stroke::solid(style::of(|t| t.junction), width);
        bonds
            .flat_map(|bond| {
                let ends = bodies::ends_of(&bond, self.state);
                let nearer = style::INSIDE_NM;
                [
                    Item::line(ends, edge).nearer(nearer),
                    Item::line(ends, core).nearer(nearer + 0.01),
                ]
            })
            .collect()
    }

    pub(super) fn walls(&self, half_nm: f64) -> Vec<Item> {
        let plates = bodies::plates(self.assembly, self.state, half_nm).into_iter();
        plates
            .map(|corners| {
                let plate = Solid::Plate {
                    corners: corners.into(),
                };
                Item::new(plate, style::of(|t| t.clamp)).with_opacity(0.75)
            })
            .collect()
    }

    /// Position of a clamped end (nm, lab frame), and unit vectors outward and across the built filament. `None` if the
    /// end is free.
    fn held(&self, filament: usize, end: End) -> Option<[Vector3; 3]> {
        let clamp = self.assembly.clamp_at(filament, end)?;
        let built = self.assembly.filaments[filament].rotation;
        let outward = match end {
            End::Start => -Vector3::z(),
            End::End => Vector3::z(),
        };
        Some([
            clamp.point_nm(self.state),
            built * outward,
            built * Vector3::x(),
        ])
    }

    /// Prescribed motions of clamped ends: shifts as arrows to scale, turns as arcs of the true angle about the axis.
    pub(super) fn imposed(&self, radius_nm: f64) -> Vec<Item> {
        let stages = self.assembly.scene.path.iter();
        let settings = stages.flat_map(|stage| &stage.set);
        settings
            .flat_map(|setting| match setting {
                Setting::Shift {
                    filament,
                    end,
                    shift_nm,
                } => self.shift(*filament, *end, (*shift_nm).into()),
                Setting::Turn {
                    filament,
                    end,
                    turn_deg,
                } => self.turn(*filament, *end, (*turn_deg).into(), radius_nm),
                // Loads and anchors are drawn in their final state.
                Setting::LoadFactor { .. } | Setting::Shear { .. } | Setting::Anchor { .. } => {
                    Vec::new()
                }
            })
            .collect()
    }

    fn shift(&self, filament: usize, end: End, shift: Vector3) -> Vec<Item> {
        let Some([at, outward, _]) = self.held(filament, end) else {
            return Vec::new();
        };
        let to = at + outward * CLEAR_NM;
        vec![style::arrow([to - shift, to])]
    }

    fn turn(&self, filament: usize, end: End, turn_deg: Vector3, radius_nm: f64) -> Vec<Item> {
        let Some([at, outward, across]) = self.held(filament, end) else {
            return Vec::new();
        };
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

    /// Forces as arrows from their points of application.
    pub(super) fn arrows(&self, nm_per_pn: f64) -> Vec<Item> {
        let forces = bodies::forces(self.assembly, self.state).into_iter();
        forces
            .map(|(at, force)| style::arrow([at, at + force * nm_per_pn]))
            .collect()
    }

    pub(super) fn linkers(&self) -> Vec<Item> {
        let linkers = self.assembly.linkers.iter().enumerate();
        linkers
            .flat_map(|(i, linker)| {
                let (site, end) = (
                    linker.site().position(self.state),
                    linker.end_position(self.state),
                );
                let stroke = Stroke {
                    dashed: true,
                    ..Stroke::solid(style::of(|t| t.linker), 2.2)
                };
                let dot = |at, pixels, colour| Item::new(Solid::Dot { at, pixels }, colour);
                let on_body =
                    |at| dot(at, 3.0, style::of(|t| t.linker)).nearer(2.0 * style::INSIDE_NM);
                [
                    Item::line([site, end], stroke).nearer(style::INSIDE_NM),
                    on_body(site),
                    match self.assembly.linked_to(i) {
                        None => dot(end, 6.0, style::of(|t| t.anchor)),
                        Some(_) => on_body(end),
                    },
                ]
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace_root;
    use actin_sim::Scene;

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
        let drawn = FilamentDrawing::whole(&assembly);
        let counts = assembly.counts();
        assert_eq!(drawn.monomers(1.0).len(), counts.monomers);
        assert_eq!(drawn.segments().len(), counts.segments);
        assert!(drawn.segments().iter().all(|[a, b]| (b - a).norm() < 11.0));
        assert_eq!(drawn.bonds(1.0).items.len(), counts.bonds);
        assert_eq!(drawn.linkers().len(), 3 * assembly.linkers.len());
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
