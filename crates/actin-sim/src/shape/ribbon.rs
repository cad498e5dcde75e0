//! Centre line of a filament with a frame on each edge, for every resolution.

use super::{extended_writhe, twist};
use crate::{Assembly, End, FilamentSpan};
use actin_mechanics::{State, UnitQuaternion, Vector3};

/// Unit vectors are parallel if 1 minus their cosine is below this. The writhe then belongs to a
/// closed curve to 1e-4 of a turn.
pub(super) const PARALLEL: f64 = 1e-8;

/// Largest number of vertices for the writhe, whose cost is quadratic: 5e7 solid angles take a few
/// seconds.
const MOST_FOR_WRITHE: usize = 10_000;

/// Largest product of the points of a filament and of all filaments for the writhe in a summary.
/// All writhes of a scene then cost at most as much as the largest single one.
const MOST_FOR_SUMMARY: usize = MOST_FOR_WRITHE * MOST_FOR_WRITHE;

/// Writhe of a filament for a summary of all filaments; `None` if too expensive.
pub(crate) fn writhe_of(assembly: &Assembly, filament: usize, ribbon: &Ribbon) -> Option<f64> {
    let own = assembly.filaments[filament].points.len();
    let is_summarised = own * assembly.points.len() <= MOST_FOR_SUMMARY;
    is_summarised.then(|| ribbon.writhe()).flatten()
}

const ENDS: [End; 2] = [End::Start, End::End];

/// Filament as a polyline of `n + 1` vertices and `n` edges, each edge with a frame.
///
/// For rods, vertices are nodes and edges are segments. For monomers, vertices are the midpoints
/// `(c_k + c_{k+1}) / 2` of their smoothed centre line, with `c` the centre moved inward by the
/// radius of the helix. This removes the alternation of the strands and keeps smooth shapes to
/// `kappa rise^2 / 8`, 0.01 nm at 0.01 rad/nm. Each edge has the frame of its monomer without the
/// azimuth of the helix. At a junction the last edge of the monomers ends at the rod's node.
#[derive(Clone, Debug, PartialEq)]
pub struct Ribbon {
    /// Arc length of each vertex at rest (nm).
    pub s_nm: Vec<f64>,
    /// Vertices (nm, lab frame).
    pub points_nm: Vec<Vector3>,
    /// `true` for vertices between monomers, `false` for nodes of a rod.
    pub between_monomers: Vec<bool>,
    /// Arc length of each frame at rest (nm).
    pub frame_s_nm: Vec<f64>,
    /// Frame of each edge (body to lab): at rest the axes as built, third along the filament.
    pub frames: Vec<UnitQuaternion>,
    /// Outermost held frames at start and end in the same axes, with their arc lengths at rest
    /// (nm); `None` at a free end.
    pub ends: [Option<(f64, UnitQuaternion)>; 2],
    /// Outermost frames in the same way, also of ends that turn: the cross-section of a rod under a
    /// hinge or an end couple, or in heat.
    pub(super) outermost: [Option<(f64, UnitQuaternion)>; 2],
    /// Held frame of each hinged end, in the same axes.
    hinges: [Option<UnitQuaternion>; 2],
    /// Unit tangents at the outermost held frames as built; `None` at an end that rotates freely.
    built: [Option<Vector3>; 2],
    /// Distance of each vertex from the axis as built (nm).
    distance_nm: Vec<f64>,
}

impl Ribbon {
    /// Creates the ribbon of filament 0 in `state`.
    pub fn new(assembly: &Assembly, state: &State) -> Self {
        Self::from_state(assembly, 0, state)
    }

    /// Creates the ribbon of a filament.
    ///
    /// # Panics
    /// If the index is out of range.
    pub(crate) fn from_state(assembly: &Assembly, filament: usize, state: &State) -> Self {
        let mut ribbon = Self {
            s_nm: Vec::new(),
            points_nm: Vec::new(),
            between_monomers: Vec::new(),
            frame_s_nm: Vec::new(),
            frames: Vec::new(),
            ends: ENDS.map(|end| held_frame(assembly, filament, state, end)),
            outermost: ENDS.map(|end| outermost_frame(assembly, filament, state, end)),
            hinges: ENDS.map(|end| hinge_frame(assembly, filament, state, end)),
            built: ENDS.map(|end| built_axis(assembly, filament, end)),
            distance_nm: Vec::new(),
        };
        let sections = assembly.sections_of(filament);
        let last = sections.len() - 1;
        for (i, section) in sections.iter().enumerate() {
            let centre = |k: usize| (assembly.points[k].s_nm, assembly.centre_line_nm(state, k));
            let mut frames = section.frames.clone();
            if section.is_ellipsoids() {
                let next = sections.get(i + 1).filter(|next| next.is_ellipsoids());
                let past = section.points.end - usize::from(next.is_none());
                for k in section.points.start..past {
                    let (one, other) = (centre(k), centre(k + 1));
                    ribbon.push_vertex(0.5 * (one.0 + other.0), 0.5 * (one.1 + other.1), true);
                }
                // The outermost monomer of the filament has no edge.
                frames.start += usize::from(i == 0);
                frames.end -= usize::from(i == last);
            } else {
                // Neighbouring rods share a node.
                let is_shared = i > 0 && !sections[i - 1].is_ellipsoids();
                for k in section.points.clone().skip(usize::from(is_shared)) {
                    let (s_nm, point) = centre(k);
                    ribbon.push_vertex(s_nm, point, false);
                }
            }
            for frame in frames {
                ribbon.frame_s_nm.push(assembly.frames[frame].s_nm);
                ribbon.frames.push(from_rest(assembly, state, frame));
            }
        }
        ribbon.distance_nm = distances(&assembly.filaments[filament], &ribbon.points_nm);
        ribbon
    }

    fn push_vertex(&mut self, s_nm: f64, point: Vector3, between_monomers: bool) {
        self.s_nm.push(s_nm);
        self.points_nm.push(point);
        self.between_monomers.push(between_monomers);
    }

    /// Unit vectors along the edges; an edge without length has the direction of its frame.
    pub fn tangents(&self) -> Vec<Vector3> {
        let edges = self.points_nm.windows(2).zip(&self.frames);
        edges
            .map(|(pair, q)| {
                let edge = (pair[1] - pair[0]).try_normalize(0.0);
                edge.unwrap_or_else(|| q * Vector3::z())
            })
            .collect()
    }

    /// Frame and unit vector of the straight extension of either end: of the held frame, or along
    /// the last edge at an end that turns.
    fn extensions(&self, tangents: &[Vector3]) -> [(UnitQuaternion, Vector3); 2] {
        let free = [0, self.frames.len() - 1];
        [0, 1].map(|k| match self.ends[k] {
            Some((_, q)) => (q, q * Vector3::z()),
            None => (
                self.outermost[k].map_or(self.frames[free[k]], |(_, q)| q),
                tangents[free[k]],
            ),
        })
    }

    /// Twist in turns of the frames about the tangents, between the extensions.
    ///
    /// Shear does not count as twist, and `twist + writhe = link` holds exactly for the polyline.
    pub fn twist(&self) -> f64 {
        let (frames, tangents) = self.edges();
        twist(&frames, &tangents)
    }

    /// Frames and unit vectors of all edges including both extensions. Vertex `i` joins edges `i`
    /// and `i + 1`.
    pub(super) fn edges(&self) -> (Vec<UnitQuaternion>, Vec<Vector3>) {
        let tangents = self.tangents();
        let [first, last] = self.extensions(&tangents);
        let inside = self.frames.iter().copied().zip(tangents);
        std::iter::once(first).chain(inside).chain([last]).unzip()
    }

    /// Frames and unit vectors including the joints of hinges: after the cross-section the held
    /// frame of the spring. `None` if an end is free.
    pub(super) fn held_edges(&self) -> Option<(Vec<UnitQuaternion>, Vec<Vector3>)> {
        let (mut frames, mut tangents) = self.edges();
        for k in [0, 1] {
            if self.ends[k].is_some() {
                continue;
            }
            let held = self.hinges[k]?;
            frames.insert(k * frames.len(), held);
            tangents.insert(k * tangents.len(), held * Vector3::z());
        }
        Some((frames, tangents))
    }

    /// Returns `true` if the extensions along these unit vectors have the directions as built.
    pub(super) fn points_as_built(&self, beyond: [Vector3; 2]) -> bool {
        let mut ends = beyond.iter().zip(&self.built);
        let is_same = |(now, built): (&Vector3, &Option<Vector3>)| {
            built.is_some_and(|built| is_parallel(*now, built))
        };
        ends.all(is_same)
    }

    /// Writhe of the filament with straight extensions; see `extended_writhe`. `None` for more
    /// than ten thousand vertices.
    pub fn writhe(&self) -> Option<f64> {
        let [(_, first), (_, last)] = self.extensions(&self.tangents());
        self.writhe_between([first, last])
    }

    /// Writhe with extensions along these unit vectors.
    pub(super) fn writhe_between(&self, beyond: [Vector3; 2]) -> Option<f64> {
        let few = self.points_nm.len() <= MOST_FOR_WRITHE;
        few.then(|| extended_writhe(&self.points_nm, beyond))
    }

    /// Largest distance of the centre line from the axis as built (nm). For a curved filament, the
    /// axis is the straight line from its start along its direction.
    ///
    /// It is the maximum of the parabola through the farthest vertex and its neighbours. For
    /// segments `h` the vertices alone can miss `kappa h^2 / 8`, 0.25 nm at 0.02 rad/nm.
    pub fn largest_distance_nm(&self) -> f64 {
        let distance = &self.distance_nm;
        let furthest = (0..distance.len()).max_by(|&i, &j| distance[i].total_cmp(&distance[j]));
        let Some(top) = furthest.filter(|&i| i > 0 && i + 1 < distance.len()) else {
            return furthest.map_or(0.0, |i| distance[i]);
        };
        let near = [top - 1, top, top + 1];
        top_of_parabola(near.map(|i| self.s_nm[i]), near.map(|i| distance[i]))
    }
}

fn distances(span: &FilamentSpan, points_nm: &[Vector3]) -> Vec<f64> {
    let seen = points_nm.iter().map(|&p| span.to_filament_frame(p));
    seen.map(|p| p.x.hypot(p.y)).collect()
}

/// Maximum of the parabola through three points with the highest in the middle.
fn top_of_parabola(x: [f64; 3], y: [f64; 3]) -> f64 {
    let (before, after) = (x[1] - x[0], x[2] - x[1]);
    let (rise, fall) = ((y[1] - y[0]) / before, (y[2] - y[1]) / after);
    let curvature = 2.0 * (fall - rise) / (before + after);
    if curvature >= 0.0 {
        return y[1];
    }
    let slope = (rise * after + fall * before) / (before + after);
    y[1] - 0.5 * slope * slope / curvature
}

/// Axes of the filament at frame `i` as built, rotated with the frame.
pub(crate) fn from_rest(assembly: &Assembly, state: &State, i: usize) -> UnitQuaternion {
    let turned =
        state.frames.orientation.get(i) * assembly.rest.frames.orientation.get(i).inverse();
    let span = &assembly.filaments[assembly.filament_of_frame(i)];
    turned * span.frame_at(assembly.frames[i].s_nm)
}

fn hinge_frame(
    assembly: &Assembly,
    filament: usize,
    state: &State,
    end: End,
) -> Option<UnitQuaternion> {
    let [held, _] = assembly.hinge_frames(filament, end)?;
    Some(from_rest(assembly, state, held))
}

fn held_frame(
    assembly: &Assembly,
    filament: usize,
    state: &State,
    end: End,
) -> Option<(f64, UnitQuaternion)> {
    let clamp = assembly.held.fixed_at(filament, end)?;
    let frame = assembly.clamps[clamp].outermost_frame(end)?;
    let s_nm = assembly.frames[frame].s_nm;
    Some((s_nm, from_rest(assembly, state, frame)))
}

fn outermost_frame(
    assembly: &Assembly,
    filament: usize,
    state: &State,
    end: End,
) -> Option<(f64, UnitQuaternion)> {
    held_frame(assembly, filament, state, end).or_else(|| {
        let frame = assembly.end_frame(filament, end)?;
        let s_nm = assembly.frames[frame].s_nm;
        Some((s_nm, from_rest(assembly, state, frame)))
    })
}

fn built_axis(assembly: &Assembly, filament: usize, end: End) -> Option<Vector3> {
    assembly
        .built_frame(filament, end)
        .map(|frame| frame * Vector3::z())
}

pub(super) fn is_parallel(one: Vector3, other: Vector3) -> bool {
    1.0 - one.dot(&other) <= PARALLEL
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::tests::{CLAMPS, SECTIONS, build};
    use actin_mechanics::rotation;
    use actin_mechanics::testing::move_rigidly;
    use actin_mechanics::{Xorshift, perturb};

    #[test]
    fn the_ribbon_of_a_filament_at_rest_is_straight() {
        for (sections, clamps) in SECTIONS.iter().flat_map(|s| CLAMPS.map(|c| (s, c))) {
            let assembly = build(sections, clamps);
            let ribbon = Ribbon::new(&assembly, &assembly.rest);
            assert_eq!(ribbon.points_nm.len(), ribbon.frames.len() + 1);
            for (s_nm, point) in ribbon.s_nm.iter().zip(&ribbon.points_nm) {
                // Round-off of positions of 60 nm.
                assert!((point - Vector3::z() * *s_nm).norm() < 1e-13);
            }
            for (i, q) in ribbon.frames.iter().enumerate() {
                assert!(q.angle() < 1e-14);
                let middle = 0.5 * (ribbon.s_nm[i] + ribbon.s_nm[i + 1]);
                assert!((ribbon.frame_s_nm[i] - middle).abs() < 1e-12);
            }
            assert!(ribbon.twist().abs() < 1e-13 && ribbon.writhe().unwrap().abs() < 1e-13);
            assert!(ribbon.largest_distance_nm() < 1e-13);
        }
    }

    #[test]
    fn a_turned_filament_twists_by_its_turn() {
        for sections in SECTIONS {
            let assembly = build(sections, CLAMPS[2]);
            let mut state = assembly.rest.clone();
            for (i, info) in assembly.frames.iter().enumerate() {
                let turn = rotation::exp(Vector3::z() * (0.2 * info.s_nm));
                let q = turn * state.frames.orientation.get(i);
                state.frames.orientation.set(i, q);
            }
            for (i, info) in assembly.points.iter().enumerate() {
                let turn = rotation::exp(Vector3::z() * (0.2 * info.s_nm));
                let x = turn * state.points.position.get(i);
                state.points.position.set(i, x);
            }
            let ribbon = Ribbon::new(&assembly, &state);
            let [first, last] = ribbon.ends.map(|end| end.unwrap().0);
            let expected = 0.2 * (last - first) / (2.0 * std::f64::consts::PI);
            assert!((ribbon.twist() - expected).abs() < 1e-13);
            assert!(ribbon.writhe().unwrap().abs() < 1e-13);
        }
    }

    #[test]
    fn a_rigid_motion_changes_neither() {
        let assembly = build(SECTIONS[2], CLAMPS[1]);
        let mut noise = Xorshift::new(3);
        let mut state = assembly.rest.clone();
        perturb(&mut state, &mut noise, 1.5, 0.2);
        let before = Ribbon::new(&assembly, &state);
        move_rigidly(&mut state, noise.vector(), noise.vector() * 20.0);
        let after = Ribbon::new(&assembly, &state);
        let (one, other) = (before.writhe().unwrap(), after.writhe().unwrap());
        assert!(one.abs() > 1e-3 && (one - other).abs() < 1e-12);
        assert!((before.twist() - after.twist()).abs() < 1e-12);
    }

    #[test]
    fn the_zigzag_of_two_strands_drops_out() {
        let assembly = build(SECTIONS[1], "");
        let mut state = assembly.rest.clone();
        for i in 0..assembly.points.len() {
            let side = if i % 2 == 0 { 0.3 } else { -0.3 };
            state.points.position.add(i, Vector3::x() * side);
        }
        let ribbon = Ribbon::new(&assembly, &state);
        assert!(ribbon.largest_distance_nm() < 1e-13);
    }

    #[test]
    fn the_top_lies_between_vertices() {
        let at = |x: f64| 5.0 - 0.1 * (x - 0.4).powi(2);
        let x = [-10.0, 0.0, 7.0];
        assert!((top_of_parabola(x, x.map(at)) - 5.0).abs() < 1e-14);
        assert!((top_of_parabola([0.0, 1.0, 2.0], [1.0, 1.0, 1.0]) - 1.0).abs() < 1e-15);
    }
}
