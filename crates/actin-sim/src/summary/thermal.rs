//! Thermal motion in `summary.json`.

use crate::Assembly;
use crate::scene::{BOLTZMANN_PN_NM_PER_K, Task, Thermal};
use serde::{Deserialize, Serialize};

/// Prescribed and measured temperature.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThermalSummary {
    /// Temperature of the bath (K).
    pub temperature_k: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// Temperature of the motion (K); `None` for overdamped motion.
    ///
    /// ```text
    /// T = 2 K / (n k_B)
    /// ```
    ///
    /// `K` is the kinetic energy of the `n` degrees of freedom, averaged over the second half of
    /// the records, or that of the last record if only that is available. The standard deviation of
    /// one record is `T sqrt(2/n)`.
    pub kinetic_temperature_k: Option<f64>,
}

impl ThermalSummary {
    /// Creates the summary from the sum of the kinetic energy (pN nm) over a number of records.
    pub(super) fn new(assembly: &Assembly, (sum_pn_nm, records): (f64, usize)) -> Option<Self> {
        let Thermal {
            temperature_k,
            seed,
        } = assembly.scene.thermal()?;
        let has_inertia = matches!(assembly.scene.task, Task::Dynamics(_));
        let degrees = (assembly.counts().dofs * records).max(1) as f64;
        Some(Self {
            temperature_k,
            seed,
            kinetic_temperature_k: has_inertia
                .then_some(2.0 * sum_pn_nm / (degrees * BOLTZMANN_PN_NM_PER_K)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::RodLaw;
    use crate::summary::tests;
    use crate::{DragModel, Scene, Summary, Trajectory};

    /// The second half of 5, 1 and 3 pN nm has a mean of 2 pN nm.
    #[test]
    fn the_temperature_is_that_of_the_second_half() {
        let cold = tests::clamped_start();
        let records = tests::trajectory(&cold).records;
        assert_eq!(ThermalSummary::new(&cold, (1.0, 3)), None);
        let text = cold.scene.to_ron();
        let mut scene = Scene::from_ron(&text).unwrap();
        let Task::Dynamics(dynamics) = &mut scene.task else {
            panic!("the fixture moves in time");
        };
        let thermal = Thermal {
            temperature_k: 300.0,
            seed: u64::MAX,
        };
        dynamics.thermal = Some(thermal);
        dynamics.drag = DragModel::rates_per_ns([1.0; 2]);
        // Rods under this law have the same bodies in heat.
        scene.filament.rod.law = RodLaw::Constant;
        let warm = Assembly::build(&scene).unwrap();
        let mut records = vec![records[0].clone(); 3];
        for (record, kinetic) in records.iter_mut().zip([5.0, 1.0, 3.0]) {
            record.row.kinetic_pn_nm = kinetic;
        }
        let summary = Summary::from_run(&warm, &Trajectory { records }, &tests::outcome());
        let summary = summary.unwrap().thermal.unwrap();
        assert_eq!((summary.temperature_k, summary.seed), (300.0, u64::MAX));
        let expected = 2.0 * 2.0 / (warm.counts().dofs as f64 * BOLTZMANN_PN_NM_PER_K);
        assert!((summary.kinetic_temperature_k.unwrap() / expected - 1.0).abs() < 1e-14);
    }
}
