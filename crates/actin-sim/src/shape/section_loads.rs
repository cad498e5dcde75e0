//! Internal forces and moments of a filament.

use super::Ribbon;
use super::axis::{Axis, CrossSection};
use crate::loads::loads_of;
use crate::{Assembly, End};
use actin_mechanics::{Loads, State, Vector3};

/// Force and moment that the part of a filament after a cross-section exerts on the part before it,
/// in the axes of the cross-section (z along the filament towards its end).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionLoad {
    /// Force (pN): shear forces across and tension along the filament; compression is negative.
    pub force_pn: Vector3,
    /// Moment about the centre of the cross-section (pN nm): bending moments and torque.
    pub couple_pn_nm: Vector3,
}

impl SectionLoad {
    /// Axial force (pN); negative in compression.
    pub fn tension_pn(&self) -> f64 {
        self.force_pn.z
    }

    /// Magnitude of the shear force (pN).
    pub fn shear_pn(&self) -> f64 {
        self.force_pn.xy().norm()
    }

    /// Magnitude of the bending moment (pN nm).
    pub fn bending_moment_pn_nm(&self) -> f64 {
        self.couple_pn_nm.xy().norm()
    }

    /// Axial torque (pN nm).
    pub fn torque_pn_nm(&self) -> f64 {
        self.couple_pn_nm.z
    }
}

/// Distance (nm) from a body at the end of the cross-section before it.
const BEFORE_NM: f64 = 1e-6;

/// Force and moment about the lab origin on all bodies from the end of a filament up to an arc length.
#[derive(Clone, Copy, Debug, Default)]
struct Resultant {
    s_nm: f64,
    force: Vector3,
    moment: Vector3,
}

/// Resultants of loads on a filament, in order of descending arc length.
#[derive(Debug)]
pub(crate) struct Resultants(Vec<Resultant>);

impl Resultants {
    /// Sums `loads` over the bodies of a filament.
    pub(crate) fn new(assembly: &Assembly, filament: usize, state: &State, loads: &Loads) -> Self {
        let span = &assembly.filaments[filament];
        let points = span.points.clone().map(|i| {
            let force = loads.force.get(i);
            Resultant {
                s_nm: assembly.points[i].s_nm,
                force,
                moment: state.points.position.get(i).cross(&force),
            }
        });
        let frames = span.frames.clone().map(|i| Resultant {
            s_nm: assembly.frames[i].s_nm,
            force: Vector3::zeros(),
            moment: state.frames.orientation.get(i) * loads.torque.get(i),
        });
        let mut all: Vec<Resultant> = points.chain(frames).collect();
        all.sort_by(|a, b| b.s_nm.total_cmp(&a.s_nm));
        let mut sum = Resultant::default();
        for one in &mut all {
            sum.force += one.force;
            sum.moment += one.moment;
            (one.force, one.moment) = (sum.force, sum.moment);
        }
        Self(all)
    }

    /// Returns force and couple about `place` of the bodies beyond an arc length (nm), in `axes`;
    /// `None` beyond the last body.
    pub(crate) fn beyond(
        &self,
        s_nm: f64,
        (place, axes): CrossSection,
    ) -> Option<(Vector3, Vector3)> {
        let after = self.0.partition_point(|one| one.s_nm > s_nm);
        let Resultant { force, moment, .. } = self.0[after.checked_sub(1)?];
        let to_body = axes.inverse();
        Some((to_body * force, to_body * (moment - place.cross(&force))))
    }
}

/// Internal loads of one filament in one state.
///
/// Loads follow from balance: the elastic forces and torques on all bodies after a cross-section have the resultant that
/// the part before exerts. Sections and junctions are included, external loads and linkers act on the bodies. The same
/// holds for monomers, rods and mixed filaments, in equilibrium and in motion.
#[derive(Debug)]
pub(crate) struct SectionLoads {
    resultants: Resultants,
    axis: Axis,
    limits: [Limit; 2],
}

/// Outermost cross-section of an end with the complete load: inside of its held bodies, or of the bodies that share
/// the load of a free end.
#[derive(Clone, Copy, Debug)]
struct Limit {
    /// Arc length of this cross-section (nm).
    cut_nm: f64,
    /// Outermost arc length about which moments are taken (nm). Held bodies are rigid up to the end.
    about_nm: f64,
}

impl Limit {
    fn new(assembly: &Assembly, filament: usize, end: End) -> Self {
        let tips = assembly.tip_points_of(filament, end);
        let clamp = assembly.clamp_at(filament, end);
        let points = clamp.map_or_else(|| tips.collect(), |clamp| clamp.points.clone());
        let frames = clamp.map_or(&[][..], |clamp| &clamp.frames);
        let points = points.iter().map(|&i| assembly.points[i].s_nm);
        let bodies = points.chain(frames.iter().map(|&i| assembly.frames[i].s_nm));
        let (cut_nm, end_nm) = match end {
            End::Start => (bodies.fold(f64::NEG_INFINITY, f64::max), 0.0),
            End::End => (
                bodies.fold(f64::INFINITY, f64::min) - BEFORE_NM,
                assembly.length_of(filament),
            ),
        };
        Self {
            cut_nm,
            about_nm: if clamp.is_some() { end_nm } else { cut_nm },
        }
    }
}

impl SectionLoads {
    /// Computes the internal loads of a filament.
    ///
    /// # Panics
    /// If the index is out of range.
    pub(crate) fn new(assembly: &Assembly, filament: usize, state: &State) -> Self {
        let terms = assembly.filaments[filament].terms.clone();
        let loads = loads_of(&assembly.system.interactions()[terms], state);
        Self {
            resultants: Resultants::new(assembly, filament, state, &loads),
            axis: Axis::from_ribbon(&Ribbon::from_state(assembly, filament, state)),
            limits: [End::Start, End::End].map(|end| Limit::new(assembly, filament, end)),
        }
    }

    /// Returns the internal load at an arc length (nm).
    ///
    /// Cross-sections between held bodies transmit the reaction of the clamp. Those between the bodies that share the
    /// load of a free end, and any beyond the ends, have the load of the nearest other cross-section.
    pub(crate) fn at(&self, s_nm: f64) -> SectionLoad {
        let [first, last] = self.limits;
        let cut = s_nm.min(last.cut_nm).max(first.cut_nm);
        let about = s_nm.min(last.about_nm).max(first.about_nm);
        let resultant = self.resultants.beyond(cut, self.axis.at(about));
        resultant.map_or_else(SectionLoad::default, |(force, couple)| SectionLoad {
            force_pn: -force,
            couple_pn_nm: -couple,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, Scene};

    const SECTIONS: [&str; 3] = [
        "Rod(from_nm: 0.0, to_nm: 100.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 100.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 50.0), Rod(from_nm: 50.0, to_nm: 100.0)",
    ];

    fn build(sections: &str, clamp: &str, load: &str) -> Assembly {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
                clamps: [{clamp}],
                loads: [{load}],
                task: Equilibrium(),
            )"
        );
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    fn solved(assembly: &Assembly) -> State {
        let (trajectory, _) = Plan::new(assembly).unwrap().run().unwrap();
        trajectory.records.last().unwrap().state.clone()
    }

    fn loaded(sections: &str, load: &str) -> (SectionLoads, Vector3) {
        let assembly = build(sections, "Clamp(end: Start)", load);
        let state = solved(&assembly);
        let tip = assembly.tip_nm(&state, End::End);
        (SectionLoads::new(&assembly, 0, &state), tip)
    }

    #[test]
    fn internal_loads_balance_a_force_at_the_tip() {
        let force = Vector3::new(0.5, -0.2, 1.0);
        for sections in SECTIONS {
            let load = "EndForce(end: End, force_pn: (0.5, -0.2, 1.0))";
            let (loads, tip) = loaded(sections, load);
            for s_nm in [10.3, 48.0, 71.9, 90.2] {
                let (place, axes) = loads.axis.at(s_nm);
                let found = loads.at(s_nm);
                let of_force = (axes * found.force_pn - force).norm();
                let moment = (tip - place).cross(&force);
                let of_couple = (axes * found.couple_pn_nm - moment).norm();
                // The residual of an equilibrium is 1e-7, summed over less than 100 bodies with arms below 100 nm.
                assert!(of_force < 1e-5, "{sections} at {s_nm}: {of_force:e}");
                assert!(of_couple < 1e-3, "{sections} at {s_nm}: {of_couple:e}");
            }
        }
    }

    /// The load at a held end is the reaction of its clamp. Along the filament it balances the load at the other end.
    #[test]
    fn ends_transmit_the_whole_load() {
        let rod = ["Wall", "NodeAndFrame", "TwoNodesAndFrame"].map(|hold| (SECTIONS[0], hold));
        let monomers = SECTIONS[1..].iter().map(|sections| (*sections, "Wall"));
        for (sections, hold) in rod.into_iter().chain(monomers) {
            for (held, free) in [(End::Start, End::End), (End::End, End::Start)] {
                let assembly = build(
                    sections,
                    &format!("Clamp(end: {held:?}, hold: {hold})"),
                    &format!("EndForce(end: {free:?}, force_pn: (1.0, 0.0, 0.5))"),
                );
                check_ends(&assembly, (held, free));
            }
        }
    }

    fn check_ends(assembly: &Assembly, (held, free): (End, End)) {
        let state = &solved(assembly);
        let loads = SectionLoads::new(assembly, 0, state);
        // The part after exerts the end force on the part before, or the reaction of the end on all.
        let sign = if free == End::End { 1.0 } else { -1.0 };
        let force = Vector3::new(sign, 0.0, 0.5 * sign);
        let tip = assembly.tip_nm(state, free);
        let in_lab = |s_nm: f64| {
            let (place, axes) = loads.axis.at(s_nm);
            let found = loads.at(s_nm);
            (place, axes * found.force_pn, axes * found.couple_pn_nm)
        };
        for s_nm in Ribbon::new(assembly, state).s_nm {
            let (place, of_force, couple) = in_lab(s_nm.clamp(0.0, assembly.length_nm()));
            let expected = (tip - place).cross(&force);
            assert!(
                (of_force - force).norm() < 1e-5,
                "{held:?} at {s_nm}: {of_force}"
            );
            // At an end of monomers the load equals the load before the last two, 1.5 rises of 2.7 nm away.
            let error = (couple - expected).norm();
            assert!(error < 4.2 * force.norm(), "{held:?} at {s_nm}: {error}");
            assert_eq!(
                loads.at(s_nm),
                loads.at(s_nm.clamp(0.0, assembly.length_nm()))
            );
        }
        let all = loads_of(assembly.system.interactions(), state);
        let clamp = assembly.clamp_at(0, held).unwrap();
        let torque = -sign * clamp.reaction(state, &all).torque_pn_nm;
        let at_nm = if held == End::Start {
            0.0
        } else {
            assembly.length_nm()
        };
        let (place, _, couple) = in_lab(at_nm);
        let arm = clamp.point_nm(state) - place;
        // The residual of an equilibrium is 1e-7, summed over less than 100 bodies with arms below 100 nm.
        let error = (couple - torque - arm.cross(&force)).norm();
        assert!(
            error < 1e-3 && arm.norm() < 0.2,
            "{held:?}: {error:e} {arm}"
        );
    }

    #[test]
    fn internal_loads_balance_a_couple_at_the_tip() {
        for sections in SECTIONS {
            let (loads, _) = loaded(sections, "Couple(end: End, couple_pn_nm: (0.0, 0.0, 5.0))");
            for s_nm in [10.3, 48.0, 71.9, 90.2] {
                let found = loads.at(s_nm);
                assert!((found.couple_pn_nm.z - 5.0).abs() < 1e-3, "{found:?}");
                assert!(found.force_pn.norm() < 1e-5, "{found:?}");
            }
        }
    }
}
