//! Solvers for scenes, and a search for critical loads.

use crate::theory::bisect;
use actin_cosserat::{Rigidities, RodMaterial};
use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions, Residual};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Interaction, State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, Outcome};

pub(crate) use crate::common::{
    BEND, LENGTH, apart, build, failure, ran, rod_scene, run, run_anyway,
};

pub(crate) fn solved(text: &str) -> (Assembly, Outcome) {
    let (assembly, _, outcome) = ran(text);
    (assembly, outcome)
}

pub(crate) const MIXED: &str = "Filament(
    sections: [
        Ellipsoids(from_nm: 0.0, to_nm: 20.0),
        Rod(from_nm: 20.0, to_nm: 40.0, segments: 2),
    ],
    monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
    rod: RodModel(law: Constant),
)";

/// Scene of a cantilever rod under a tip force (pN).
pub(crate) fn cantilever(segments: usize, force: [f64; 3], task: &str) -> String {
    let [x, y, z] = force;
    let loads = format!("loads: [EndForce(end: End, force_pn: ({x:?}, {y:?}, {z:?}))],");
    let rest = format!("{loads} {task}");
    rod_scene(segments, (SHEAR, 1.3e4), "Clamp(end: Start)", &rest)
}

/// Shear and stretch rigidity of [`cantilever`] (pN).
pub(crate) const SHEAR: f64 = 1e5;

/// Relative precision of critical loads: far below the smallest mesh error, 1e-5.
pub(crate) const PRECISION: f64 = 1e-9;

/// Solver for the free bodies of an assembly, in the order of arc length.
pub(crate) fn newton(assembly: &Assembly, tolerance: f64) -> Newton {
    let order = BodyOrder {
        points: assembly.points.iter().map(|p| p.s_nm).collect(),
        frames: assembly.frames.iter().map(|f| f.s_nm).collect(),
    };
    let layout = Layout::new(assembly.system.state(), Some(&order)).unwrap();
    Newton::new(layout, to(tolerance)).unwrap()
}

pub(crate) fn to(tolerance: f64) -> NewtonOptions {
    NewtonOptions {
        tolerance: Residual {
            force: tolerance,
            torque: tolerance,
        },
        ..NewtonOptions::default()
    }
}

/// First control at which the stiffness of the equilibrium near `straight` becomes indefinite, by
/// bisection. Each equilibrium is solved from `straight`.
pub(crate) fn critical(
    newton: &mut Newton,
    straight: &State,
    interactions: &[Box<dyn Interaction>],
    bounds: [f64; 2],
) -> f64 {
    let is_unstable = |control: f64| {
        let mut state = straight.clone();
        let factor = state.controls.ids().next().unwrap();
        state.controls[factor] = control;
        newton.solve(&mut state, interactions).unwrap().is_saddle()
    };
    bisect(is_unstable, bounds, PRECISION)
}

pub(crate) fn material(shear: [f64; 3], bend: [f64; 3]) -> RodMaterial {
    let (shear, bend) = (shear.into(), bend.into());
    RodMaterial::new(Rigidities { shear, bend }).unwrap()
}

pub(crate) fn point(state: &mut State, position: Vector3) -> usize {
    push_point(state, position, 1.0)
}

pub(crate) fn frame(state: &mut State, orientation: UnitQuaternion) -> usize {
    push_frame(state, orientation, [1.0, 1.0, 2.0])
}
