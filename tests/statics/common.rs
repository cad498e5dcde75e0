//! Rods under a tip force, and scenes as text, relaxed to rest.

use crate::common::ran;
use actin_mechanics::{State, Vector3};
use actin_sim::{Assembly, End, Outcome, Record, Trajectory};

/// Rod on a wall with a force across its tip.
#[derive(Clone, Debug)]
pub(crate) struct Rod {
    pub(crate) length_nm: f64,
    pub(crate) segments: usize,
    pub(crate) shear_pn: [f64; 3],
    pub(crate) bend_pn_nm2: [f64; 3],
    pub(crate) hold: &'static str,
    pub(crate) force_law: &'static str,
    pub(crate) force_pn: f64,
}

impl Rod {
    /// Unloaded actin of 160 nm.
    pub(crate) fn actin(segments: usize) -> Self {
        Self {
            length_nm: 160.0,
            segments,
            shear_pn: [1.6e4, 1.6e4, 3.4e4],
            bend_pn_nm2: [3.9e4, 3.9e4, 1.3e4],
            hold: "Wall",
            force_law: "EnergyGradient",
            force_pn: 0.0,
        }
    }

    /// Deflection of the tip (nm) at the end of a task.
    pub(crate) fn deflection_after(&self, task: &str) -> f64 {
        let Self {
            length_nm,
            segments,
            shear_pn: [s1, s2, s3],
            bend_pn_nm2: [b1, b2, b3],
            hold,
            force_law,
            force_pn,
        } = self;
        let settled = settle(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: {length_nm:?}, segments: {segments})],
                    rod: RodModel(law: Constant, force_law: {force_law}, material: Rigidities(
                        shear_pn: ({s1:?}, {s2:?}, {s3:?}),
                        bend_pn_nm2: ({b1:?}, {b2:?}, {b3:?}),
                    )),
                ),
                clamps: [Clamp(end: Start, hold: {hold})],
                loads: [EndForce(end: End, force_pn: ({force_pn:?}, 0.0, 0.0))],
                task: {task},
            )"
        ));
        settled.tip_displacement_nm(End::End).x
    }

    pub(crate) fn deflection_nm(&self) -> f64 {
        self.deflection_after("Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9)")
    }
}

pub(crate) struct Settled {
    pub(crate) assembly: Assembly,
    pub(crate) trajectory: Trajectory,
    pub(crate) report: Outcome,
}

impl Settled {
    pub(crate) fn last(&self) -> &Record {
        self.trajectory.records.last().unwrap()
    }

    pub(crate) fn tip_displacement_nm(&self, end: End) -> Vector3 {
        let assembly = &self.assembly;
        assembly.tip_nm(&self.last().state, end) - assembly.tip_nm(&assembly.rest, end)
    }
}

pub(crate) fn settle(text: &str) -> Settled {
    let (assembly, trajectory, report) = ran(text);
    let settled = Settled {
        assembly,
        trajectory,
        report,
    };
    let last = settled.last();
    assert!(settled.report.has_converged(), "{}", last.at.value());
    settled
}

pub(crate) fn free_bodies(state: &State) -> (usize, usize) {
    let points = (0..state.points.len()).filter(|&i| state.points.is_free(i));
    let frames = (0..state.frames.len()).filter(|&i| state.frames.is_free(i));
    (points.count(), frames.count())
}

/// Slopes of `ln |error|` against `ln h` between successively halved meshes.
pub(crate) fn orders<const N: usize>(errors: [f64; N]) -> Vec<f64> {
    errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).abs().log2())
        .collect()
}
