//! Initial guess for the equilibrium of long cantilevers of monomers.
//!
//! Monomers at rest have no twist stiffness. Under a transverse torque a filament twists in either
//! sense, by about the square root of the torque, with energies that differ by less than 1 %. From
//! the straight filament, rounding selects the sense at each place, and Newton's method moves the
//! boundary between domains by a few monomers per step. The initial guess therefore twists the
//! whole filament in the sense of lower potential energy of a periodic cell.
//! Monomers are placed as in cells under the local force and torque.
//!
//! Local loads are computed on the straight filament. If they would bend it far, only a part of them
//! is applied. If the sense of lower energy differs between loads (it reverses above about 20 pN
//! nm), no initial guess is made.

use crate::loads::loads_of;
use crate::scene::{Anchors, End, Filament, FreeTranslation, Task};
use crate::shape::Resultants;
use crate::shape::axis::CrossSection;
use crate::{Assembly, FilamentSpan};
use actin_assembly::whole::to_count;
use actin_assembly::{Part, ellipsoids};
use actin_ellipsoid::{Cell, CellResponse, Control, Displacements, Hold, SixVector};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};

/// Number of monomers in a periodic cell: one period of the helix.
const PERIOD: usize = 13;
/// Smallest number of monomers. Shorter filaments converge quickly from the straight state.
const FEWEST_MONOMERS: usize = 1000;
/// Smallest bend (rad) from the held to the free end under the loads of the straight filament.
const SMALLEST_BEND: f64 = 0.01;
/// Largest bend (rad) at which the loads are applied in full.
const FULL_BEND: f64 = 1.0;
/// Largest bend (rad) with an initial guess. Beyond, loads of the straight filament are not
/// representative.
const LARGEST_BEND: f64 = 5.0;
/// Largest axial force times squared length over rigidity. The filament buckles at 2.5, and under
/// tension it bends only near its ends.
const LARGEST_ALONG: f64 = 2.0;
const TWIST: f64 = 2e-3;
const PLACES: u32 = 64;
/// Relative transverse torque below which it is round-off.
const ROUNDING: f64 = 1e-6;
/// Largest rotation of the filament between two cells (rad).
const TURN: f64 = 0.2;
/// Largest relative change of the torque between two cells.
const CHANGE: f64 = 0.5;
/// Smallest distance of cells in rises: the length of a cell.
const CLOSEST: f64 = PERIOD as f64;
/// Smallest relative difference of the potential energies of the two senses.
const LEAST_GAIN: f64 = 1e-3;
/// Largest integration step along the curve in rises.
const STEP: f64 = 1.0;

/// Returns an initial guess for the equilibrium of a scene that needs fewer steps than the state as
/// built; `None` if no better guess is known.
///
/// It exists for scenes without path, linkers and repulsion, with straight filaments of at least
/// 1000 monomers with quadrature bonds, held at their start and bent by loads. The cost is a few
/// tens of milliseconds. Use it with
/// [`Newton::carry_along`](actin_equilibrium::Newton::carry_along).
pub fn near_equilibrium(assembly: &Assembly) -> Option<State> {
    if assembly.scene.start.is_some() {
        return None;
    }
    let is_still = assembly.drive.is_still() && matches!(assembly.scene.task, Task::Equilibrium(_));
    let loads_only = |part| matches!(part, Part::Section(_) | Part::Load(_));
    if !is_still || !assembly.terms.iter().all(|term| loads_only(term.part)) {
        return None;
    }
    let cantilevers = assembly.scene.filaments().enumerate();
    let cantilevers =
        cantilevers.map(|(i, written)| Cantilever::from_filament(assembly, i, written));
    let cantilevers: Vec<_> = cantilevers.collect::<Option<_>>()?;
    let mut state = assembly.system.state().clone();
    for cantilever in &cantilevers {
        let curve = cantilever.curve()?;
        cantilever.lay_along(&curve, &mut state);
    }
    Some(state)
}

/// Straight filament of monomers held at its start.
struct Cantilever<'a> {
    assembly: &'a Assembly,
    span: &'a FilamentSpan,
    /// Infinite filament with quadrature bonds, as a periodic cell under uniform strain.
    cell: Cell,
    rise_nm: f64,
    length_nm: f64,
    /// Loads on the straight filament.
    loads: Resultants,
}

/// Cell of monomers at an arc length (nm): strain and displacements.
struct CellStrain {
    at: f64,
    strain: SixVector,
    displacements: Displacements,
}

impl CellStrain {
    fn new(at: f64, cell: &CellResponse) -> Self {
        Self {
            at,
            strain: cell.strain,
            displacements: cell.displacements.clone(),
        }
    }
}

type Curve = Vec<CellStrain>;

impl<'a> Cantilever<'a> {
    fn from_filament(assembly: &'a Assembly, index: usize, written: &Filament) -> Option<Self> {
        let span = &assembly.filaments[index];
        let [section] = assembly.sections_of(index) else {
            return None;
        };
        let is_plain = section.is_ellipsoids()
            && section.points.len() >= FEWEST_MONOMERS
            && written.monomers.anchors == Anchors::Cubature
            && written.shape.is_none()
            && written.imperfection.is_none()
            && !written.sections[0].is_altered();
        let clamp = assembly.clamp_at(index, End::Start)?;
        let is_open = assembly.clamp_at(index, End::End).is_none();
        if !is_plain || !is_open || clamp.slides != FreeTranslation::Nowhere {
            return None;
        }
        let state = assembly.system.state();
        let terms = assembly.terms.iter().zip(assembly.system.interactions());
        let of_loads = terms.filter(|(term, _)| matches!(term.part, Part::Load(_)));
        let loads = loads_of(of_loads.map(|(_, interaction)| interaction), state);
        let monomers = ellipsoids(&written.monomers.with_quadrature_bonds(), 0).ok()?;
        Some(Self {
            assembly,
            span,
            cell: Cell::new(&monomers, PERIOD, Hold::Means).ok()?,
            rise_nm: written.monomers.rise_nm,
            length_nm: section.to_nm,
            loads: Resultants::new(assembly, index, state, &loads),
        })
    }

    /// Index of a point's monomer within its cell.
    fn monomer(&self, point: usize) -> usize {
        let rises = self.assembly.points[point].s_nm / self.rise_nm;
        to_count(rises.round().rem_euclid(PERIOD as f64))
    }

    /// Torque and force at an arc length (nm) of the straight filament in `axes`, exerted by the
    /// part beyond on the part before.
    fn load(&self, at: f64, axes: UnitQuaternion) -> SixVector {
        let section = (self.span.axis_place(at), axes);
        let (force, couple) = self.loads.beyond(at, section).unwrap_or_default();
        SixVector::new(couple.x, couple.y, couple.z, force.x, force.y, force.z)
    }

    /// Returns the response of the cell to a load, with the equilibrium at a fixed twist (rad/nm) as
    /// the initial guess. `near` is the guess for that equilibrium: the response to a similar load.
    fn response(
        &self,
        load: &SixVector,
        twist: f64,
        near: Option<&CellResponse>,
    ) -> Option<CellResponse> {
        let controls = std::array::from_fn(|k| Control::Load(load[k]));
        let mut held = controls;
        held[2] = Control::Strain(twist);
        let held = self.cell.relax_under(&held, near).ok()?;
        self.cell.relax_under(&controls, Some(&held)).ok()
    }

    /// Strains along the curve; `None` if the straight filament is not representative or a cell has
    /// no equilibrium.
    fn curve(&self) -> Option<Curve> {
        let places = (0..PLACES).map(|k| self.length_nm * (f64::from(k) + 0.5) / f64::from(PLACES));
        let loads: Vec<_> = places.map(|at| self.load(at, self.span.rotation)).collect();
        let largest = loads
            .iter()
            .max_by(|a, b| across(a).total_cmp(&across(b)))?;
        let lever = largest.norm() + self.length_nm * largest.fixed_rows::<3>(3).norm();
        if across(largest) <= ROUNDING * lever {
            return None;
        }
        // Under a torque of 1 pN nm the curvature equals the compliance.
        let unit = largest / across(largest);
        let sides = [-TWIST, TWIST].map(|twist| self.response(&unit, twist, None));
        let [Some(left), Some(right)] = sides else {
            return None;
        };
        let softness = across(&left.strain);
        let along = loads.iter().map(|load| load[5].abs()).fold(0.0, f64::max);
        if along * softness * self.length_nm.powi(2) > LARGEST_ALONG {
            return None;
        }
        let mean = loads.iter().map(across).sum::<f64>() / f64::from(PLACES);
        let bend = softness * mean * self.length_nm;
        let is_moderate = (SMALLEST_BEND..LARGEST_BEND).contains(&bend);
        let sides = [left, right];
        let lower = self.lower(&sides, &unit)?;
        if !is_moderate || self.lower(&sides, largest)? != lower {
            return None;
        }
        self.follow(&sides[lower], (FULL_BEND / bend).min(1.0))
    }

    /// Sense with the lower potential energy under a load, if the difference is large enough.
    fn lower(&self, sides: &[CellResponse; 2], load: &SixVector) -> Option<usize> {
        let potential = |side: &CellResponse| {
            let side = self.on_side(load, side)?;
            Some(side.energy - load.dot(&side.strain))
        };
        let [a, b] = sides.each_ref().map(potential);
        let (a, b) = (a?, b?);
        let is_clear = (a - b).abs() > LEAST_GAIN * a.abs();
        is_clear.then_some(usize::from(b < a))
    }

    /// Integrates along the filament from the held end under a part of the loads, with cells
    /// twisted in the sense of `side`.
    fn follow(&self, side: &CellResponse, part: f64) -> Option<Curve> {
        let mut section = (Vector3::zeros(), self.span.rotation);
        let load = |at: f64, axes| self.load(at, axes) * part;
        let mut here = self.on_side(&load(0.0, section.1), side)?;
        let mut curve = vec![CellStrain::new(0.0, &here)];
        let mut at = 0.0;
        while at < self.length_nm {
            let to = at + self.step(at, &here.strain);
            let ahead = [at, to].map(|at| CellStrain::new(at, &here));
            let ahead = self.carry(section, [at, to], &ahead);
            let next = self.on_side(&load(to, ahead.1), &here)?;
            curve.push(CellStrain::new(to, &next));
            section = self.carry(section, [at, to], &curve);
            (at, here) = (to, next);
        }
        Some(curve)
    }

    /// Cell under another load with the twist sense of `near`. All strains except the curvature
    /// scale with the root of the torque.
    fn on_side(&self, load: &SixVector, near: &CellResponse) -> Option<CellResponse> {
        let ratio = across(load) / across(&near.loads);
        let root = if ratio.is_finite() { ratio.sqrt() } else { 1.0 };
        let mut start = near.clone();
        start.strain *= root;
        start.displacements *= root;
        start.strain[0] *= root;
        start.strain[1] *= root;
        let twist = start.strain[2];
        self.response(load, twist, Some(&start))
    }

    fn step(&self, at: f64, strain: &SixVector) -> f64 {
        let left = self.length_nm - at;
        let couple = |at| self.load(at, self.span.rotation).fixed_rows::<3>(0).norm();
        let turning = strain.fixed_rows::<3>(0).norm();
        let closest = CLOSEST * self.rise_nm;
        let mut step = (TURN / turning).min(left);
        while step > closest && (couple(at + step) - couple(at)).abs() > CHANGE * couple(at) {
            step *= 0.7;
        }
        let step = step.max(closest);
        // Avoids a short last step.
        if left < step + 0.5 * closest {
            left
        } else {
            step
        }
    }

    /// Integrates the cross-section from one arc length to another.
    fn carry(&self, from: CrossSection, [at, to]: [f64; 2], curve: &[CellStrain]) -> CrossSection {
        let (mut place, mut axes) = from;
        let mut at = at;
        while at < to {
            let next = (at + STEP * self.rise_nm).min(to);
            let strain = strain_at(curve, 0.5 * (at + next));
            let step = next - at;
            let half = rotation::exp(Vector3::new(strain[0], strain[1], strain[2]) * (0.5 * step));
            axes *= half;
            place += axes * Vector3::new(strain[3], strain[4], 1.0 + strain[5]) * step;
            axes *= half;
            at = next;
        }
        (place, axes)
    }

    /// Places the free monomers on their cross-sections, at their positions in the straight
    /// filament.
    fn lay_along(&self, curve: &Curve, state: &mut State) {
        let back = self.span.rotation.inverse();
        let mut section = (self.span.axis_place(0.0), self.span.rotation);
        let mut at = 0.0;
        for i in self.span.points.clone().filter(|&i| self.is_beyond_wall(i)) {
            let s_nm = self.assembly.points[i].s_nm;
            section = self.carry(section, [at, s_nm], curve);
            at = s_nm;
            let (shift, turn) = motion_at(curve, s_nm, self.monomer(i));
            let arm = back * (state.points.position.get(i) - self.span.axis_place(s_nm));
            let place = section.0 + section.1 * (arm + shift);
            state.points.position.set(i, place);
            if let Some(f) = self.assembly.points[i].frame {
                let q = back * state.frames.orientation.get(f);
                let q = section.1 * rotation::exp(turn) * q;
                state.frames.orientation.set(f, q);
            }
        }
    }

    fn is_beyond_wall(&self, point: usize) -> bool {
        let is_free = self.assembly.system.state().points.is_free(point);
        is_free && self.assembly.points[point].s_nm > 0.0
    }
}

fn across(six: &SixVector) -> f64 {
    six[0].hypot(six[1])
}

fn about(curve: &[CellStrain], at: f64) -> (&CellStrain, &CellStrain, f64) {
    let after = curve.partition_point(|place| place.at < at);
    let after = after.clamp(1, curve.len() - 1);
    let (a, b) = (&curve[after - 1], &curve[after]);
    (a, b, ((at - a.at) / (b.at - a.at)).clamp(0.0, 1.0))
}

fn strain_at(curve: &[CellStrain], at: f64) -> SixVector {
    let (a, b, t) = about(curve, at);
    a.strain * (1.0 - t) + b.strain * t
}

/// Displacement and rotation of a monomer of a cell (axes of its cross-section).
fn motion_at(curve: &[CellStrain], at: f64, monomer: usize) -> (Vector3, Vector3) {
    let (a, b, t) = about(curve, at);
    let [a, b] = [a, b].map(|place| place.displacements.fixed_rows::<6>(6 * monomer));
    let d = a * (1.0 - t) + b * t;
    (
        Vector3::new(d[0], d[1], d[2]),
        Vector3::new(d[3], d[4], d[5]),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, Scene};

    /// Cantilever of monomers under a tip force, with replacements in its scene.
    fn build(length_nm: f64, changes: &[(&str, &str)]) -> Assembly {
        let force = 2.0 * (160.0 / length_nm).powi(2);
        let mut text = format!(
            "Scene(
                filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: {length_nm:?})]),
                clamps: [Clamp(end: Start)],
                loads: [Force(end: End, force_pn: ({force:?}, 0.0, 0.0))],
                task: Equilibrium(force_pn: 1e-6, torque_pn_nm: 1e-6),
            )"
        );
        for (from, to) in changes {
            text = text.replace(from, to);
        }
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    #[test]
    fn other_starts_stay() {
        let end = "clamps: [Clamp(end: Start)";
        let sections = "Filament(sections";
        let imperfect = "Filament(imperfection: (amplitude_nm: 0.01, seed: 1), sections";
        let drawn = "Filament(monomers: Monomers(anchors: Independent), sections";
        let others: [&[(&str, &str)]; 4] = [
            &[
                (
                    end,
                    "clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)",
                ),
                ("loads: [Force(end: End", "loads: [Force(at_nm: 2000.0"),
            ],
            &[(sections, imperfect)],
            &[(sections, drawn)],
            &[("0.0, 0.0))]", "0.0, 1.0))]")],
        ];
        assert!(near_equilibrium(&build(3000.0, &[])).is_some());
        for changes in others {
            assert!(
                near_equilibrium(&build(3000.0, changes)).is_none(),
                "{changes:?}"
            );
        }
        assert!(near_equilibrium(&build(2000.0, &[])).is_none());
    }

    /// Newton's method takes 12 steps, compared with 22 from the straight filament, and reaches no
    /// higher energy.
    #[test]
    fn few_steps_are_left() {
        let assembly = build(8000.0, &[]);
        let start = near_equilibrium(&assembly).unwrap();
        let built = assembly.system.state();
        for i in (0..start.points.len()).filter(|&i| !start.points.is_free(i)) {
            assert_eq!(start.points.position.get(i), built.points.position.get(i));
        }
        let (trajectory, outcome) = Plan::new(&assembly).unwrap().run().unwrap();
        let steps = outcome.equilibrium.unwrap().newton_iterations;
        let last = trajectory.records.last().unwrap();
        let energy = last.energies_pn_nm.iter().sum::<f64>();
        assert!(steps <= 15, "{steps} steps");
        assert!(energy < -1.4890, "{energy} pN nm");
    }
}
