//! Local fields along a filament: position, curvature, twist, energy per length and internal load.

use super::{Ribbon, SectionLoad, SectionLoads};
use crate::Assembly;
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};

/// Tolerance (nm) for equal arc lengths of frames.
const SAME_PLACE_NM: f64 = 1e-9;

/// Local fields at one arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// Arc length at rest (nm).
    pub s_nm: f64,
    /// Position of the centre line (nm, lab frame).
    pub position_nm: Vector3,
    /// Curvature: transverse rotation rate of the frames (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Axial rotation rate of the frames relative to the helix (rad/nm); positive for over-twist.
    pub twist_rad_per_nm: f64,
    /// Elastic energy per length (pN).
    pub energy_per_length_pn: f64,
    /// Internal load of the cross-section.
    pub load: SectionLoad,
    /// `true` for monomers.
    pub is_ellipsoids: bool,
}

/// Returns the fields at each vertex of the [`Ribbon`] of filament 0 in `state`.
///
/// For rods, curvature and twist come from the bending elements. For monomers they come from the
/// rotation between neighbouring monomers without the rotation of the helix, averaged over
/// neighbouring pairs with weights 1/4, 1/2, 1/4 to remove the alternation of the strands. An end
/// without a cross-section of its own repeats the adjacent value.
///
/// Energies of sections and junctions are spread evenly over the arc length of each element, which
/// conserves their sum. Loads and linkers are not included.
pub fn profile(assembly: &Assembly, state: &State) -> Vec<ProfilePoint> {
    profile_of(assembly, 0, state)
}

/// Returns the fields of a filament; see [`profile`].
///
/// # Panics
/// If the index is out of range.
pub fn profile_of(assembly: &Assembly, filament: usize, state: &State) -> Vec<ProfilePoint> {
    let ribbon = Ribbon::from_state(assembly, filament, state);
    let curvatures = ribbon.curvatures();
    let energies = energy_per_length(assembly, filament, state, &ribbon.cells());
    let loads = SectionLoads::new(assembly, filament, state);
    (0..ribbon.s_nm.len())
        .map(|i| ProfilePoint {
            s_nm: ribbon.s_nm[i],
            position_nm: ribbon.points_nm[i],
            curvature_rad_per_nm: curvatures[i].x.hypot(curvatures[i].y),
            twist_rad_per_nm: curvatures[i].z,
            energy_per_length_pn: energies[i],
            load: loads.at(ribbon.s_nm[i]),
            is_ellipsoids: ribbon.between_monomers[i],
        })
        .collect()
}

impl Ribbon {
    /// Curvature vector at each vertex (rad/nm, axes of the frames); see [`profile`].
    pub(crate) fn curvatures(&self) -> Vec<Vector3> {
        let n = self.frames.len();
        let frame = |i: usize| (self.frame_s_nm[i], self.frames[i]);
        let inside: Vec<Vector3> = (1..n).map(|i| bend(frame(i - 1), frame(i))).collect();
        let smooth = smoothed(&inside, &self.between_monomers[1..n]);
        let held = |end: Option<(f64, UnitQuaternion)>, i: usize| {
            end.filter(|(s_nm, _)| (s_nm - self.frame_s_nm[i]).abs() > SAME_PLACE_NM)
        };
        let first = held(self.outermost[0], 0).map(|wall| bend(wall, frame(0)));
        let last = held(self.outermost[1], n - 1).map(|wall| bend(frame(n - 1), wall));
        let beside = |k: Option<&Vector3>| k.copied().unwrap_or_default();
        std::iter::once(first.unwrap_or_else(|| beside(smooth.first())))
            .chain(smooth.iter().copied())
            .chain([last.unwrap_or_else(|| beside(smooth.last()))])
            .collect()
    }

    /// Boundaries (nm) of the interval of each vertex: `n + 2` places for `n + 1` vertices, from
    /// the first vertex over all frames to the last vertex.
    fn cells(&self) -> Vec<f64> {
        let ends = [self.s_nm[0], self.s_nm[self.s_nm.len() - 1]];
        let frames = self.frame_s_nm.iter().copied();
        std::iter::once(ends[0])
            .chain(frames)
            .chain([ends[1]])
            .collect()
    }
}

fn bend((s_a, a): (f64, UnitQuaternion), (s_b, b): (f64, UnitQuaternion)) -> Vector3 {
    rotation::log(a.inverse() * b) / (s_b - s_a)
}

/// Averages values between monomers with their neighbours of the same kind; other values are
/// unchanged.
fn smoothed(values: &[Vector3], between_monomers: &[bool]) -> Vec<Vector3> {
    let of_kind = |i: &usize| *i < values.len() && between_monomers[*i];
    let neighbour = |i: Option<usize>| i.filter(of_kind).map(|i| values[i]);
    let average = |i: usize| match (neighbour(i.checked_sub(1)), neighbour(Some(i + 1))) {
        (Some(a), Some(b)) => 0.5 * values[i] + 0.25 * (a + b),
        (Some(a), None) | (None, Some(a)) => 0.5 * (values[i] + a),
        (None, None) => values[i],
    };
    let one = |i| {
        if between_monomers[i] {
            average(i)
        } else {
            values[i]
        }
    };
    (0..values.len()).map(one).collect()
}

/// Energy per length (pN) of each cell of a filament with the ascending boundaries `cells` (nm).
pub(crate) fn energy_per_length(
    assembly: &Assembly,
    filament: usize,
    state: &State,
    cells: &[f64],
) -> Vec<f64> {
    let mut energies = vec![0.0; cells.len() - 1];
    let terms = assembly.filaments[filament].terms.clone();
    let interactions = &assembly.system.interactions()[terms.clone()];
    for (interaction, spans) in interactions.iter().zip(&assembly.spans[terms]) {
        let mut elements = vec![0.0; interaction.elements()];
        interaction.write_energies(state, &mut elements);
        for (energy, span) in elements.iter().zip(spans) {
            spread(*energy, *span, cells, &mut energies);
        }
    }
    let lengths = cells.windows(2).map(|pair| pair[1] - pair[0]);
    energies.iter().zip(lengths).map(|(e, l)| e / l).collect()
}

/// Spreads an energy evenly over the part of `span` within the cells, or over the nearest cell if
/// there is none.
fn spread(energy: f64, [from, to]: [f64; 2], cells: &[f64], energies: &mut [f64]) {
    let (first, last) = (cells[0], cells[cells.len() - 1]);
    let (from, to) = (from.clamp(first, last), to.clamp(first, last));
    let begin = cells[1..cells.len() - 1].partition_point(|&place| place <= from);
    if to - from <= SAME_PLACE_NM {
        energies[begin] += energy;
        return;
    }
    for (i, cell) in cells.windows(2).enumerate().skip(begin) {
        if cell[0] >= to {
            break;
        }
        let share = (cell[1].min(to) - cell[0].max(from)) / (to - from);
        energies[i] += energy * share;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::shape::tests::{CLAMPS, SECTIONS};
    use actin_mechanics::{Xorshift, perturb};

    const QUASI_HARMONIC: &str = "Brownian(
        duration_ms: 1e-3, temperature_k: 298.0, interfaces: QuasiHarmonic(sampled_ns: 4.0))";

    fn build(sections: &str, clamps: &str) -> Assembly {
        build_for(sections, clamps, "Equilibrium()")
    }

    fn build_for(sections: &str, clamps: &str, task: &str) -> Assembly {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
                clamps: [{clamps}],
                linkers: [Linker(
                    at_nm: 20.0, displaced_nm: (3.0, 0.0, 0.0), stiffness_pn_per_nm: 10.0,
                )],
                task: {task},
            )"
        );
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    #[test]
    fn the_energy_of_the_filament_is_kept() {
        let mut noise = Xorshift::new(6);
        let of_bonds = SECTIONS.iter().flat_map(|s| CLAMPS.map(|c| build(s, c)));
        let of_links = SECTIONS
            .iter()
            .map(|s| build_for(s, CLAMPS[1], QUASI_HARMONIC));
        for assembly in of_bonds.chain(of_links) {
            for (interaction, spans) in assembly.system.interactions().iter().zip(&assembly.spans) {
                let expected = match interaction.term() {
                    "linker" => 0,
                    _ => interaction.elements(),
                };
                assert_eq!(spans.len(), expected);
            }
            let mut state = assembly.rest.clone();
            perturb(&mut state, &mut noise, 0.05, 0.05);
            let cells = Ribbon::new(&assembly, &state).cells();
            let points = profile(&assembly, &state);
            let lengths = cells.windows(2).map(|pair| pair[1] - pair[0]);
            let sum: f64 = points
                .iter()
                .zip(lengths)
                .map(|(point, length)| point.energy_per_length_pn * length)
                .sum();
            let of_parts = assembly.system.interactions().iter();
            let expected: f64 = of_parts
                .filter(|i| i.term() != "linker")
                .map(|i| i.energy(&state))
                .sum();
            // Round-off of some hundred additions.
            assert!((sum / expected - 1.0).abs() < 1e-12, "{sum} {expected}");
        }
    }

    #[test]
    fn energy_stands_where_it_is() {
        let assembly = build(SECTIONS[0], "");
        let mut state = assembly.rest.clone();
        for (i, info) in assembly.frames.iter().enumerate() {
            if info.s_nm > 40.0 {
                let q = rotation::exp(Vector3::z() * 0.1);
                state.frames.orientation.set(i, q);
            }
        }
        let points = profile(&assembly, &state);
        // B3 = 1.3e4 pN nm^2 at a twist of 0.1 over 10 nm.
        let expected = 0.5 * 1.3e4 * 1e-4;
        for point in points {
            let here = (point.s_nm - 40.0).abs() < 1.0;
            let energy = if here { expected } else { 0.0 };
            assert!((point.energy_per_length_pn - energy).abs() < 1e-12);
            let twist = if here { 0.01 } else { 0.0 };
            assert!((point.twist_rad_per_nm - twist).abs() < 1e-15);
        }
    }

    #[test]
    fn alternating_rotations_give_no_twist() {
        let assembly = build(SECTIONS[1], "");
        let mut state = assembly.rest.clone();
        for i in 0..assembly.frames.len() {
            let side = if i % 2 == 0 { 0.01 } else { -0.01 };
            let q = rotation::exp(Vector3::new(side, 0.0, side)) * state.frames.orientation.get(i);
            state.frames.orientation.set(i, q);
        }
        for point in profile(&assembly, &state) {
            assert!(point.curvature_rad_per_nm < 1e-13 && point.twist_rad_per_nm.abs() < 1e-13);
        }
    }
}
