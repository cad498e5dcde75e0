//! What a summary says of thermal motion.

use crate::Assembly;
use crate::scene::{BOLTZMANN_PN_NM_PER_K, Task, Thermal};
use serde::{Deserialize, Serialize};

/// The temperature that was asked for and the one that was met.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThermalSummary {
    /// Temperature of the bath (K).
    pub temperature_k: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// Temperature of the motion (K): `2 K / (n k_B)` with the kinetic energy `K` of the `n`
    /// degrees of freedom, the mean over the second half of a run's records (that of the last
    /// record in a summary computed alone). Of one record it scatters by `sqrt(2/n)`. None of overdamped motion.
    pub kinetic_temperature_k: Option<f64>,
}

impl ThermalSummary {
    /// That of records whose late half has this kinetic energy, if the scene of `assembly` has a
    /// temperature.
    pub(in crate::results) fn new(assembly: &Assembly, late: &LateKinetic) -> Option<Self> {
        let Thermal {
            temperature_k,
            seed,
        } = assembly.scene.thermal()?;
        let has_inertia = matches!(assembly.scene.task, Task::Dynamics(_));
        let degrees = (assembly.counts().dofs * late.records).max(1) as f64;
        Some(Self {
            temperature_k,
            seed,
            kinetic_temperature_k: has_inertia
                .then_some(2.0 * late.sum_pn_nm / (degrees * BOLTZMANN_PN_NM_PER_K)),
        })
    }
}

/// The kinetic energy of the second half of some records, which are shown one by one.
#[derive(Clone, Copy, Debug)]
pub(in crate::results) struct LateKinetic {
    /// Records that do not count yet.
    early: usize,
    /// Records that did.
    records: usize,
    sum_pn_nm: f64,
}

impl LateKinetic {
    /// That of so many records.
    pub(in crate::results) fn of(count: usize) -> Self {
        Self {
            early: count / 2,
            records: 0,
            sum_pn_nm: 0.0,
        }
    }

    /// Adds the kinetic energy (pN nm) of the next record.
    pub(in crate::results) fn add(&mut self, kinetic_pn_nm: f64) {
        match self.early {
            0 => {
                self.records += 1;
                self.sum_pn_nm += kinetic_pn_nm;
            }
            _ => self.early -= 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::results::fixture;

    /// Three records with 5, 1 and 3 pN nm: the later two count, which is 2 for each of the
    /// degrees of freedom. A scene without a temperature has none to report.
    #[test]
    fn the_temperature_is_that_of_the_second_half() {
        let cold = fixture::clamped_start();
        let records = fixture::trajectory(&cold).records;
        assert_eq!(ThermalSummary::new(&cold, &LateKinetic::of(3)), None);
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
        let warm = Assembly::build(&scene).unwrap();
        let mut records = vec![records[0].clone(); 3];
        for (record, kinetic) in records.iter_mut().zip([5.0, 1.0, 3.0]) {
            record.kinetic_pn_nm = kinetic;
        }
        let mut late = LateKinetic::of(3);
        for record in &records {
            late.add(record.kinetic_pn_nm);
        }
        let summary = ThermalSummary::new(&warm, &late).unwrap();
        assert_eq!((summary.temperature_k, summary.seed), (300.0, u64::MAX));
        let expected = 2.0 * 2.0 / (warm.counts().dofs as f64 * BOLTZMANN_PN_NM_PER_K);
        assert!((summary.kinetic_temperature_k.unwrap() / expected - 1.0).abs() < 1e-14);
    }
}
