//! The fewest monomers with which a filament meets a wanted error, by trying.

use super::cases::Case;
use super::{sections, solved};
use actin_sim::RodLaw;

/// Length of the cells that are rod or monomers (nm): 13 monomers, as those of a choice.
const CELL_NM: f64 = 13.0 * 71.2 / 26.0;
/// Filaments of so many cells are tried in every resolution, longer ones with one stretch of monomers at their start.
const MOST_CELLS: usize = 8;
/// Stretches at the start of longer filaments are this share of the length longer each.
const STEP: f64 = 0.04;

/// A resolution that meets an error.
pub(super) struct Found {
    pub(super) monomers: usize,
    pub(super) stretches: Vec<[f64; 2]>,
}

/// The first resolution, from few monomers to many, that is at most `error` off; none where only all monomers are. Unlike a
/// choice it knows the truth, and takes errors that cancel.
pub(super) fn fewest(
    case: &Case,
    error: f64,
    truth: f64,
) -> Result<Option<Found>, Box<dyn std::error::Error>> {
    for stretches in resolutions(case.length_nm()) {
        let mut scene = case.scene.clone();
        scene.filament.sections = sections(case.length_nm(), &stretches).into();
        scene.filament.rod.law = RodLaw::Homogenised;
        let assembly = solved(&scene)?;
        if (case.value(&assembly) / truth - 1.0).abs() <= error {
            let monomers = assembly.counts().monomers;
            return Ok(Some(Found {
                monomers,
                stretches,
            }));
        }
    }
    Ok(None)
}

/// Stretches of monomers, fewest first; all monomers are none of them.
fn resolutions(length: f64) -> Vec<Vec<[f64; 2]>> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "some hundred at most, and at least one"
    )]
    let cells = (length / CELL_NM).round().max(1.0) as usize;
    if cells > MOST_CELLS {
        let shares = (0..25).map(|k| STEP * f64::from(k));
        let from_start = |share: f64| {
            if share > 0.0 {
                vec![[0.0, share * length]]
            } else {
                vec![]
            }
        };
        return shares.map(from_start).collect();
    }
    let mut masks: Vec<u32> = (0..(1 << cells) - 1).collect();
    masks.sort_by_key(|mask| (mask.count_ones(), *mask));
    let edge = |k: usize| {
        if k == cells {
            length
        } else {
            k as f64 * length / cells as f64
        }
    };
    let of_mask = |mask: u32| {
        let mut stretches: Vec<[f64; 2]> = Vec::new();
        for k in (0..cells).filter(|k| mask & (1 << k) != 0) {
            match stretches.last_mut() {
                Some(last) if last[1] >= edge(k) => last[1] = edge(k + 1),
                _ => stretches.push([edge(k), edge(k + 1)]),
            }
        }
        stretches
    };
    masks.into_iter().map(of_mask).collect()
}
