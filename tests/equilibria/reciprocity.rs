//! Maxwell-Betti reciprocity of couple and force at a held end, by differences of separately solved
//! equilibria.

use super::common::{newton, solved};
use actin_mechanics::{Loads, State, Vector3, rotation};
use actin_sim::Assembly;

struct Held {
    assembly: Assembly,
    state: State,
}

fn scene(sections: &str, law: &str, turn_deg: f64, shift_nm: f64) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: {law})),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [
                Turn(end: End, turn_deg: (0.0, 0.0, {turn_deg:?})),
                Shift(end: End, shift_nm: (0.0, 0.0, {shift_nm:?})),
            ])],
            task: Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9, leave_saddles: 20),
        )"
    )
}

impl Held {
    fn at(sections: &str, law: &str, turn_deg: f64, shift_nm: f64) -> Self {
        let (assembly, report) = solved(&scene(sections, law, turn_deg, shift_nm));
        let certificate = report.equilibrium.unwrap().certificate;
        assert_eq!(certificate.negative, 0, "{sections}, {law}");
        let state = assembly.system.state().clone();
        Self { assembly, state }
    }

    /// Axial force (pN) and couple (pN nm) on the far end after a further turn (rad) and shift
    /// (nm).
    fn beside(&self, turn: f64, shift: f64) -> (f64, f64) {
        let mut state = self.state.clone();
        let end = &self.assembly.clamps[1];
        let about = end.point_nm(&state);
        let q = rotation::exp(Vector3::z() * turn);
        for &i in &end.points {
            let x = about + q * (state.points.position.get(i) - about);
            state.points.position.set(i, x + Vector3::z() * shift);
        }
        for &i in &end.frames {
            let turned = q * state.frames.orientation.get(i);
            state.frames.orientation.set(i, turned);
        }
        let interactions = self.assembly.system.interactions();
        newton(&self.assembly, 1e-9)
            .solve(&mut state, interactions)
            .unwrap();
        let mut loads = Loads::zeros(&state);
        for interaction in interactions {
            interaction.add_loads(&state, &mut loads);
        }
        let reaction = end.reaction(&state, &loads);
        (reaction.force_pn.z, reaction.torque_pn_nm.z)
    }

    /// `d couple / d shift` and `d force / d turn` (pN), by fourth-order central differences with
    /// steps of 2e-3 nm and 2e-3 rad.
    fn cross_derivatives(&self) -> (f64, f64) {
        let h = 2e-3;
        let fourth = |of: &dyn Fn(f64) -> f64| {
            (8.0 * (of(h) - of(-h)) - (of(2.0 * h) - of(-2.0 * h))) / (12.0 * h)
        };
        (
            fourth(&|h| self.beside(0.0, h).1),
            fourth(&|h| self.beside(h, 0.0).0),
        )
    }
}

const ROD: &str = "Rod(from_nm: 0.0, to_nm: 75.0)";
const MIXED: &str = "Rod(from_nm: 0.0, to_nm: 20.0), Ellipsoids(from_nm: 20.0, to_nm: 55.0),
    Rod(from_nm: 55.0, to_nm: 75.0)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 75.0)";

#[test]
fn couple_against_shift_is_force_against_turn() {
    for (sections, law) in [
        (ROD, "PublishedExtension"),
        (ROD, "CouplingEnergy"),
        (ROD, "Fitted"),
        (ROD, "Homogenised"),
        (MIXED, "PublishedExtension"),
        (MIXED, "Fitted"),
        (MONOMERS, "Constant"),
    ] {
        for turn_deg in [100.0, -80.0] {
            let held = Held::at(sections, law, turn_deg, 0.15);
            let (of_shift, of_turn) = held.cross_derivatives();
            let difference = of_shift / of_turn - 1.0;
            assert!(of_turn.abs() > 10.0, "no coupling: {of_turn}");
            // Residuals of 1e-9 over steps of 2e-3 give 1e-6 pN of 50; the truncation error is
            // smaller.
            assert!(difference.abs() < 1e-7, "{difference:e}");
        }
    }
}

/// A rod under tension is straight and stable with every law. Tension along d3 would buckle a rod
/// with cubic shear.
#[test]
fn tension_holds_a_rod_straight() {
    for (law, pull) in [("CouplingEnergy", 3.4e4), ("Fitted", 3.3544e4)] {
        for shift_nm in [1.5e-3, 0.15] {
            let held = Held::at(ROD, law, 0.0, shift_nm);
            let (force, _) = held.beside(0.0, 0.0);
            let expected = pull * shift_nm / 75.0;
            assert!((force - expected).abs() < 1e-8, "{law}");
            let positions = held.state.points.position.iter();
            let farthest = positions.map(|x| x.xy().norm()).fold(0.0, f64::max);
            // 1e-9 pN over the softest transverse spring, the tension over a segment: 0.07 pN/nm.
            assert!(farthest < 1e-7, "{law}: {farthest:e} nm off the axis");
        }
    }
}
