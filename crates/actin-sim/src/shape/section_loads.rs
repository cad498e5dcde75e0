//! Internal forces and moments of a filament.

use super::Ribbon;
use super::axis::{Axis, CrossSection};
use crate::Assembly;
use crate::loads::loads_of;
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

/// Distance (nm) from the last body of the cross-section whose load an end has.
const BEFORE_END_NM: f64 = 1e-6;

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
        }
    }

    /// Returns the internal load at an arc length (nm). An end has the load of the adjacent cross-section; interfaces
    /// between held monomers before the start have the load of the start.
    pub(crate) fn within(&self, s_nm: f64) -> SectionLoad {
        let end = self.resultants.0.first().map_or(0.0, |last| last.s_nm);
        self.at(s_nm.min(end - BEFORE_END_NM).max(0.0))
    }

    /// Returns the internal load at an arc length (nm); zero beyond the ends of the filament.
    pub(crate) fn at(&self, s_nm: f64) -> SectionLoad {
        let resultant = self.resultants.beyond(s_nm, self.axis.at(s_nm));
        resultant.map_or_else(SectionLoad::default, |(force, couple)| SectionLoad {
            force_pn: -force,
            couple_pn_nm: -couple,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{End, Plan, Scene};

    const SECTIONS: [&str; 3] = [
        "Rod(from_nm: 0.0, to_nm: 100.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 100.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 50.0), Rod(from_nm: 50.0, to_nm: 100.0)",
    ];

    fn solved(sections: &str, load: &str) -> (SectionLoads, Vector3) {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start)],
                loads: [{load}],
                task: Equilibrium(),
            )"
        );
        let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
        let (trajectory, _) = Plan::new(&assembly).unwrap().run().unwrap();
        let state = &trajectory.records.last().unwrap().state;
        let tip = assembly.tip_nm(state, End::End);
        (SectionLoads::new(&assembly, 0, state), tip)
    }

    #[test]
    fn internal_loads_balance_a_force_at_the_tip() {
        let force = Vector3::new(0.5, -0.2, 1.0);
        for sections in SECTIONS {
            let load = "EndForce(end: End, force_pn: (0.5, -0.2, 1.0))";
            let (loads, tip) = solved(sections, load);
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
            assert_eq!(loads.at(200.0), SectionLoad::default());
        }
    }

    #[test]
    fn internal_loads_balance_a_couple_at_the_tip() {
        for sections in SECTIONS {
            let (loads, _) = solved(sections, "Couple(end: End, couple_pn_nm: (0.0, 0.0, 5.0))");
            for s_nm in [10.3, 48.0, 71.9, 90.2] {
                let found = loads.at(s_nm);
                assert!((found.couple_pn_nm.z - 5.0).abs() < 1e-3, "{found:?}");
                assert!(found.force_pn.norm() < 1e-5, "{found:?}");
            }
        }
    }
}
