//! Persistence length and twisting rigidity of free rods in a heat bath, compared with monomers
//! (`docs/measured/heat.md`).

use super::case::Group;
use super::filament::FilamentModel;
use super::row::Row;
use crate::measure::{
    ROOM_PN_NM, RotationCorrelations, SampleStatistics, far_lengths, turns_in_bath,
};
use actin_integrate::PEFRL;
use actin_sim::RodLaw;
use rayon::prelude::*;

/// Number of replicas with independent noise.
const REPLICAS: u64 = 192;
const QUICK_REPLICAS: u64 = 8;
/// Time step relative to the stability limit.
const SHARE: f64 = 0.5;
const LENGTH_NM: f64 = 110.0;

/// Persistence length (um) and twisting rigidity (pN nm^2) of the mean filament and of filaments
/// with sampled bonds, with standard errors, by the same protocol.
const MONOMERS: [(&str, [f64; 2], [f64; 2]); 2] = [
    ("persistence length", [11.49, 0.06], [11.17, 0.12]),
    ("C", [8.00e3, 0.07e3], [7.70e3, 0.09e3]),
];

/// Both rows of a law.
pub(super) fn rows(name: &str, law: &RodLaw, quick: bool) -> Vec<Row> {
    let replicas = if quick { QUICK_REPLICAS } else { REPLICAS };
    let replica = |k: u64| {
        let filament = FilamentModel::coarse(law).filament(LENGTH_NM);
        turns_in_bath(filament, (&PEFRL, SHARE), k)
    };
    let all = (0..replicas).into_par_iter().map(replica);
    let measured = all.collect::<Result<Vec<RotationCorrelations>, String>>();
    let measured = measured.map(|turns| measure(&turns));
    let row = |(i, (quantity, mean, drawn)): (usize, (&str, [f64; 2], [f64; 2]))| {
        let known = |[mean, error]: [f64; 2]| SampleStatistics {
            mean,
            error,
            ..SampleStatistics::from_values([mean])
        };
        let rod = measured.as_ref().map(|both| both[i]);
        let value = rod.ok().map(|(value, _)| value);
        let error = |of: f64| value.map(|value| value / of - 1.0);
        Row {
            mean: Some(known(mean)),
            drawn: Some(known(drawn)),
            rod: value,
            rod_of_drawn: value,
            error_mean: error(mean[0]),
            error_drawn: error(drawn[0]),
            note: match rod {
                Ok((_, error)) => {
                    format!("standard error of {quantity}: {error:.2}, {replicas} replicas")
                }
                Err(error) => format!("rod: {error}"),
            },
            ..Row::open(Group::Thermal, "110 nm, 298 K", quantity, name)
        }
    };
    MONOMERS.into_iter().enumerate().map(row).collect()
}

/// Persistence length (um) and twisting rigidity (pN nm^2) with their standard errors.
fn measure(turns: &[RotationCorrelations]) -> [(f64, f64); 2] {
    let apart_nm = LENGTH_NM / turns[0].cosine.len() as f64;
    let [length, twist] = far_lengths(turns, apart_nm);
    let scaled = |(value, error): (f64, f64), by: f64| (by * value, by * error);
    [scaled(length, 1e-3), scaled(twist, ROOM_PN_NM)]
}
