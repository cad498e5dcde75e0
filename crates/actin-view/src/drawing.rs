//! Solids of all filaments in a state, for pictures.

use crate::{Palette, bodies, outlines};
use actin_draw::Colour;
use actin_draw::scene3d::{Item, Matrix3, Solid, Stroke};
use actin_sim::mechanics::{State, Vector3};
use actin_sim::{Assembly, BodyKind};

/// Depth offset of items inside bodies, which are drawn in front of them (nm).
pub const INSIDE_NM: f64 = 8.0;

/// A state of all filaments, or of a range of arc length.
#[derive(Clone, Copy, Debug)]
pub struct Drawing<'a> {
    /// Bodies.
    pub assembly: &'a Assembly,
    /// Positions and orientations.
    pub state: &'a State,
    /// Drawn range of arc length (nm).
    pub range_nm: [f64; 2],
    /// Smallest radius of bodies (nm).
    pub least_nm: f64,
    /// Colours.
    pub palette: Palette,
}

impl<'a> Drawing<'a> {
    /// Creates a drawing of complete filaments.
    pub fn new(assembly: &'a Assembly, state: &'a State, palette: Palette) -> Self {
        Self {
            assembly,
            state,
            range_nm: [f64::NEG_INFINITY, f64::INFINITY],
            least_nm: 0.0,
            palette,
        }
    }

    /// Returns whether an arc length is in the drawn range.
    pub fn shows(&self, s_nm: f64) -> bool {
        (self.range_nm[0]..=self.range_nm[1]).contains(&s_nm)
    }

    /// Returns the position of a point (nm, lab frame).
    pub fn place(&self, point: usize) -> Vector3 {
        self.state.points.position.get(point)
    }

    /// Returns the axes of a frame as columns (lab frame).
    pub fn axes(&self, frame: usize) -> Matrix3 {
        let orientation = self.state.frames.orientation.get(frame);
        orientation.to_rotation_matrix().into_inner()
    }

    /// Returns the drawn points of a kind.
    pub fn points(&self, kind: BodyKind) -> Vec<usize> {
        let points = self.assembly.points.iter().enumerate();
        let shown = points.filter(|(_, info)| info.kind == kind && self.shows(info.s_nm));
        shown.map(|(i, _)| i).collect()
    }

    /// Returns the ellipsoids of monomers. The two strands differ in shade.
    pub fn monomers(&self, opacity: f64) -> Vec<Item> {
        let colour = self.palette.ramp().at(0.0);
        let shades = [colour, colour.lighter(0.28)];
        let monomers = self.points(BodyKind::Monomer).into_iter().enumerate();
        let body = monomers.filter_map(|(k, i)| Some((k, i, self.assembly.points[i].frame?)));
        body.map(|(k, i, frame)| {
            let filament = self.assembly.filament_of_point(i);
            let semi_axes = Vector3::from(self.assembly.monomers_of(filament).semi_axes_nm);
            let semi_axes = semi_axes.map(|a| a.max(self.least_nm));
            let solid = Solid::Ellipsoid {
                centre: self.place(i),
                semi_axes: self.axes(frame) * Matrix3::from_diagonal(&semi_axes),
            };
            Item::new(solid, shades[k % 2]).with_opacity(opacity)
        })
        .collect()
    }

    /// Returns the cylinders of rod segments, with a stripe along d1.
    pub fn rods(&self, opacity: f64) -> Vec<Item> {
        let sections = self.assembly.sections.iter().filter(|s| !s.is_ellipsoids());
        let mut items = Vec::new();
        for section in sections {
            let nodes: Vec<Vector3> = section.points.clone().map(|i| self.place(i)).collect();
            let tangents: Vec<Vector3> = nodes
                .windows(2)
                .map(|ends| (ends[1] - ends[0]).normalize())
                .collect();
            let stripes: Vec<Vector3> = section
                .frames
                .clone()
                .map(|frame| self.axes(frame).column(0).into())
                .collect();
            let points = section.points.clone().zip(section.points.clone().skip(1));
            let shown = points.enumerate().filter(|(_, (a, b))| {
                [a, b]
                    .iter()
                    .all(|i| self.shows(self.assembly.points[**i].s_nm))
            });
            items.extend(shown.map(|(k, _)| {
                let solid = Solid::Cylinder {
                    ends: [nodes[k], nodes[k + 1]],
                    radius: bodies::rod_radius_nm().max(self.least_nm),
                    normals: at_ends(&tangents, k),
                    stripe: at_ends(&stripes, k),
                };
                Item::new(solid, self.palette.ramp().at(1.0)).with_opacity(opacity)
            }));
        }
        items
    }

    /// Returns lines with an edge for the bonds of junctions, with a width in pixels.
    pub fn junction_bonds(&self, width: f64) -> Vec<Item> {
        let colour = Colour(self.palette.body_colours().junction);
        let lines = [
            Stroke::solid(colour.darker(0.55), width + 2.0),
            Stroke::solid(colour, width),
        ];
        let bonds = self.assembly.junction_bonds().into_iter();
        let ends = bonds.map(|bond| bodies::ends_of(&bond, self.state));
        let line = |ends| {
            let nearer = [INSIDE_NM, INSIDE_NM + 0.01];
            [0, 1].map(|k| Item::line(ends, lines[k]).nearer(nearer[k]))
        };
        ends.flat_map(line).collect()
    }

    /// Returns plates at clamps.
    pub fn clamps(&self, half_nm: f64) -> Vec<Item> {
        let colour = Colour(self.palette.body_colours().clamp);
        let plates = bodies::plates(self.assembly, self.state, half_nm).into_iter();
        let plate = |corners: [Vector3; 4]| Solid::Plate {
            corners: corners.into(),
        };
        plates
            .map(|corners| Item::new(plate(corners), colour).with_opacity(0.75))
            .collect()
    }

    /// Returns the outlines of walls and of the periodic box, with a width in pixels.
    pub fn outlines(&self, width: f64) -> Vec<Item> {
        let stroke = Stroke::solid(Colour(self.palette.body_colours().wall), width);
        let mut lines = outlines::walls(self.assembly);
        lines.push(outlines::periodic_box(self.assembly, self.state));
        let ends = lines.iter().flat_map(|line| line.windows(2));
        ends.map(|ends| Item::line([ends[0], ends[1]], stroke))
            .collect()
    }

    /// Returns the spheres of beads.
    pub fn beads(&self) -> Vec<Item> {
        let colour = Colour(self.palette.body_colours().bead);
        let beads = self.assembly.beads_in(self.state).into_iter();
        let ball = |(centre, radius): (Vector3, f64)| Solid::Ellipsoid {
            centre,
            semi_axes: Matrix3::from_diagonal_element(radius.max(self.least_nm)),
        };
        beads.map(|bead| Item::new(ball(bead), colour)).collect()
    }

    /// Returns arrows from the points of application of forces along `arrow` of each force.
    pub fn forces(&self, width: f64, arrow: impl Fn(Vector3) -> Vector3) -> Vec<Item> {
        let stroke = Stroke::solid(Colour(self.palette.body_colours().force), width);
        let forces = bodies::forces(self.assembly, self.state).into_iter();
        forces
            .map(|(at, force)| Item::arrow([at, at + arrow(force)], stroke).nearer(4.0 * INSIDE_NM))
            .collect()
    }

    /// Returns lines with dots at their sites for the linkers that hold, and the anchors of all linkers outside
    /// filaments. The width of lines and the radius of anchors are in pixels.
    pub fn linkers(&self, width: f64, radius: f64, dashed: bool) -> Vec<Item> {
        let colours = self.palette.body_colours();
        let [line, anchor] = [colours.linker, colours.anchor].map(Colour);
        let stroke = Stroke {
            dashed,
            ..Stroke::solid(line, width)
        };
        let dot = |at| Item::dot(at, 0.9 * width, line).nearer(2.0 * INSIDE_NM);
        let mut items = Vec::new();
        for i in 0..self.assembly.linkers.len() {
            let (ends, holds) = self.assembly.linker_ends(i, self.state);
            let is_anchored = self.assembly.linked_to(i).is_none();
            if holds {
                items.extend([Item::line(ends, stroke).nearer(INSIDE_NM), dot(ends[0])]);
            }
            if is_anchored {
                items.push(Item::dot(ends[1], radius, anchor).nearer(INSIDE_NM));
            } else if holds {
                items.push(dot(ends[1]));
            }
        }
        items
    }
}

/// Returns the means of entry `k` and its neighbours, at both ends of entry `k`.
fn at_ends(all: &[Vector3], k: usize) -> [Vector3; 2] {
    let neighbours = [k.saturating_sub(1), (k + 1).min(all.len() - 1)];
    neighbours.map(|j| (all[k] + all[j]).normalize())
}
