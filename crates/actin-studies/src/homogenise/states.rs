//! Strains at which twisted and bent cells have several states, for bending along a helix or in a plane, and their
//! bending stiffness.
//!
//! A twisted cell under uniform strain bends along a helix. A cell that bends in a plane has another angle between
//! monomers and another number of monomers in a period.

use actin_draw::report::save;
use actin_paper::cells::{self, PERIOD, ZERO_LOAD, ZERO_STRAIN, relax};
use actin_sim::ellipsoid::{
    Cell, CellResponse, Control, EllipsoidModel, EllipsoidParameters, Hold,
};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

/// Numbers of turns and monomers in a period, for each twist.
const TURNS: [u8; 14] = [10, 9, 17, 8, 15, 7, 20, 13, 19, 11, 5, 9, 13, 4];
const MONOMERS: [u8; 14] = [21, 19, 36, 17, 32, 15, 43, 28, 41, 24, 11, 20, 29, 9];
const TENSIONS: [f64; 4] = [-20.0, 0.0, 10.0, 40.0];
/// Increment of curvature (rad/nm), number of increments, and number of further increments before bending is
/// reversed.
const STEP: f64 = 1e-3;
const STEPS: u32 = 30;
const MORE: u32 = 6;
/// Number of increments of the initial twist.
const TWISTED: u32 = 10;
/// Number of increments at which bending torques are compared.
const BENT: usize = 2;
/// Largest difference of torques about the axis in equal states (pN nm).
const SAME: f64 = 0.5;

pub(super) fn run(out: &Path) -> Result<(), String> {
    let helix = cells::mean()?;
    let model = EllipsoidModel::new(EllipsoidParameters::default()).map_err(|e| e.to_string())?;
    let closed = TURNS.into_iter().zip(MONOMERS);
    let all: Vec<_> = closed
        .flat_map(|closed| TENSIONS.map(|t| (closed, t)))
        .collect();
    let rows = all.par_iter().map(|((turns, monomers), tension)| {
        let turn = -TAU * f64::from(*turns) / f64::from(*monomers);
        let twist = (turn - model.parameters().turn) / model.parameters().rise;
        let plane = Cell::with_turn(&model, usize::from(*monomers), turn, Hold::Means);
        let plane = plane.map_err(|e| e.to_string())?;
        let bent = [
            BendingResponse::new(&helix, (twist, *tension))?,
            BendingResponse::new(&plane, (0.0, *tension))?,
        ];
        let stiffer = bent[1].couple / bent[0].couple - 1.0;
        let mut row = format!("| {twist:.4} | {tension} | {:+.1} % |", 100.0 * stiffer);
        for one in bent {
            let _ = write!(row, " {} |", one.several());
        }
        Ok(row + "\n")
    });
    let rows = rows.collect::<Result<Vec<String>, String>>()?;
    let mut table = format!(
        "| twist (rad/nm) | tension (pN) | couple at {} rad/nm, plane over helix | several states along a helix (curvatures, 1e-3 \
         rad/nm; couples about the axis apart, pN nm) | in a plane |\n| ---: | ---: | ---: | --- | --- |\n",
        STEP * BENT as f64
    );
    for row in &rows {
        table.push_str(row);
    }
    let _ = writeln!(
        table,
        "\nA helix of {PERIOD} monomers; without twist both are one."
    );
    println!("{table}");
    save(out, "states.md", &table)
}

struct BendingResponse {
    couple: f64,
    /// Difference of the torques about the axis between both directions (pN nm) at each increment, `None` for equal
    /// states.
    apart: Vec<Option<f64>>,
}

impl BendingResponse {
    fn new(cell: &Cell, (twist, tension): (f64, f64)) -> Result<Self, String> {
        let at = |bent: u32, twisted: u32, near: Option<&CellResponse>| {
            let bend = Control::Strain(STEP * f64::from(bent));
            let twist = Control::Strain(twist * f64::from(twisted) / f64::from(TWISTED));
            relax(
                cell,
                [
                    bend,
                    ZERO_STRAIN,
                    twist,
                    ZERO_LOAD,
                    ZERO_LOAD,
                    Control::Load(tension),
                ],
                near,
            )
        };
        let mut straight = at(0, 0, None)?;
        for twisted in 1..=TWISTED {
            straight = at(0, twisted, Some(&straight))?;
        }
        let mut there = vec![straight];
        for bent in 1..=STEPS + MORE {
            there.push(at(bent, TWISTED, there.last())?);
        }
        let mut back = vec![there[there.len() - 1].clone()];
        for bent in (0..STEPS + MORE).rev() {
            back.push(at(bent, TWISTED, back.last())?);
        }
        let both = there.iter().zip(back.iter().rev()).take(STEPS as usize + 1);
        let apart = both.map(|(a, b)| {
            let apart = (a.loads[2] - b.loads[2]).abs();
            Some(apart).filter(|apart| *apart > SAME)
        });
        Ok(Self {
            couple: there[BENT].loads[0],
            apart: apart.collect(),
        })
    }

    fn several(&self) -> String {
        let steps = 0..self.apart.len();
        let mut inside = steps.filter(|&step| self.apart[step].is_some());
        let Some(first) = inside.next() else {
            return "none".to_owned();
        };
        let last = inside.next_back().unwrap_or(first);
        let most = self.apart.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
        format!("{first} to {last}; {most:.0}")
    }
}
