//! The cell beside the tables of the paper, and beside what is known of filaments of monomers.

use super::filament::{FREE, NONE, mean, patterned, relax, twisted};
use crate::Tell;
use crate::published::{Entry, Table, entries};
use actin_sim::ellipsoid::constants::{MINIMUM_LENGTH, RISE};
use actin_sim::ellipsoid::{Cell, CellResponse, Control};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// Between the inner held monomers of the 30 of the measured filament (nm).
const LENGTH: f64 = 27.0 * RISE;
/// Tensions (pN).
const TENSIONS: [f64; 4] = [1.0, 5.0, 10.0, 40.0];
/// Curvatures of bending (rad/nm).
const CURVATURES: [f64; 4] = [1e-4, 1e-3, 5e-3, 1e-2];

/// A number, and its name.
type Named = (String, f64);

/// Prints and writes all: the mean filament, then patterns of drawn bonds with the default shortest bond and
/// with none.
pub(super) fn run(out: &Path, samplings: u64, tell: Tell<'_>) -> Result<(), String> {
    let mean = numbers(&mean()?)?;
    let of_patterns = |shortest: f64| -> Result<Vec<Vec<Named>>, String> {
        let seeds = (1..=samplings).into_par_iter();
        seeds
            .map(|seed| numbers(&patterned(seed, shortest)?))
            .collect()
    };
    let patterns = [of_patterns(MINIMUM_LENGTH)?, of_patterns(0.0)?];
    let mut markdown = format!(
        "| quantity | mean filament | one pattern of 64 drawn, {samplings} samplings | the same without \
         a shortest bond |\n| --- | ---: | ---: | ---: |\n"
    );
    let mut csv =
        String::from("quantity,mean_filament,patterns,sd,patterns_no_floor,sd_no_floor\n");
    for (k, (quantity, value)) in mean.iter().enumerate() {
        let _ = write!(markdown, "| {quantity} | {value:.5e} |");
        let _ = write!(csv, "{quantity},{value:e}");
        for all in &patterns {
            let values: Vec<f64> = all.iter().map(|of_one| of_one[k].1).collect();
            let (average, deviation) = statistics(&values);
            let _ = write!(markdown, " {average:.4e} +- {deviation:.1e} |");
            let _ = write!(csv, ",{average:e},{deviation:e}");
        }
        markdown.push('\n');
        csv.push('\n');
    }
    tell(format_args!("{markdown}"));
    let path = out.join("checks.csv");
    std::fs::write(&path, csv).map_err(|e| format!("{}: {e}", path.display()))
}

/// Mean and standard deviation.
pub(super) fn statistics(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    (mean, (square / (count - 1.0).max(1.0)).sqrt())
}

/// All numbers of one filament.
fn numbers(cell: &Cell) -> Result<Vec<Named>, String> {
    let mut all = twist(cell)?;
    all.extend(stretch(cell)?);
    all.extend(bending(cell)?);
    all.extend(tension(cell)?);
    Ok(all)
}

/// Tables 3 and 5 at the curvatures that they print, and at their angles over the length between inner held
/// monomers.
fn twist(cell: &Cell) -> Result<Vec<Named>, String> {
    let mut all = against_tables(cell, "as printed", |entry| entry.curvature)?;
    let over_length = |entry: &Entry| entry.phi_deg.to_radians().copysign(entry.curvature) / LENGTH;
    all.extend(against_tables(cell, "over 73.94 nm", over_length)?);
    Ok(all)
}

/// Some rows of Tables 3 and 5, and the differences from 40 and from 10 to 200 deg.
fn against_tables(
    cell: &Cell,
    curvatures: &str,
    curvature: impl Fn(&Entry) -> f64,
) -> Result<Vec<Named>, String> {
    let lengths = entries(Table::LengthChange)?;
    let mut all = Vec::new();
    let (mut b3_shares, mut changes) = (Vec::new(), Vec::new());
    for (rigidity, length) in entries(Table::Rigidity)?.iter().zip(&lengths) {
        if !rigidity.is_reliable() {
            continue;
        }
        let response = twisted(cell, curvature(rigidity))?;
        let (b3, change) = (response.loads[2] / curvature(rigidity), response.strain[5]);
        changes.push(change - length.value);
        if rigidity.phi_deg >= 40.0 {
            b3_shares.push(b3 / rigidity.value - 1.0);
        }
        let angle = rigidity.phi_deg.copysign(rigidity.curvature);
        if [40.0, 80.0, 120.0, 180.0].contains(&rigidity.phi_deg) {
            all.push((format!("B3 at {angle:+.0} deg {curvatures} (pN nm^2)"), b3));
            all.push((format!("dL/L at {angle:+.0} deg {curvatures}"), change));
        }
    }
    let rms = |x: &[f64]| (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt();
    all.push((
        format!("B3 rms against Table 3, twists {curvatures}"),
        rms(&b3_shares),
    ));
    all.push((
        format!("dL/L rms against Table 5, twists {curvatures}"),
        rms(&changes),
    ));
    Ok(all)
}

/// Stretch without turning, both ways; the length held at rest while it is sheared.
fn stretch(cell: &Cell) -> Result<Vec<Named>, String> {
    let mut all = Vec::new();
    for strain in [1e-3, 5e-3, -1e-3, -3e-3] {
        let stretched = [FREE, FREE, NONE, FREE, FREE, Control::Strain(strain)];
        let force = relax(cell, stretched, None)?.loads[5];
        all.push((format!("S3 at strain {strain} (pN)"), force / strain));
    }
    let sheared = |shear: f64| [FREE, FREE, NONE, Control::Strain(shear), FREE, NONE];
    let shear: f64 = 0.01;
    let loads = relax(cell, sheared(shear), None)?.loads;
    all.push((
        "shear force / gamma^3 at rest length (pN)".to_owned(),
        loads[3] / shear.powi(3),
    ));
    all.push((
        "tension / gamma^2 at rest length (pN)".to_owned(),
        loads[5] / shear.powi(2),
    ));
    Ok(all)
}

/// Bending by couples.
fn bending(cell: &Cell) -> Result<Vec<Named>, String> {
    let mut all = Vec::new();
    let mut bent: Option<CellResponse> = None;
    for curvature in CURVATURES {
        let controls = [Control::Strain(curvature), FREE, FREE, FREE, FREE, FREE];
        let response = relax(cell, controls, bent.as_ref())?;
        let name = format!("B at {curvature} /nm (pN nm^2)");
        all.push((name, response.loads[0] / curvature));
        bent = Some(response);
    }
    Ok(all)
}

/// Small bending and shear of the pulled filament, free to turn and not. Entries of the tangent are means
/// over both axes, which one pattern makes different.
fn tension(cell: &Cell) -> Result<Vec<Named>, String> {
    let mut all = Vec::new();
    for (turn, name) in [(FREE, "free"), (NONE, "blocked")] {
        let mut pulled: Option<CellResponse> = None;
        for tension in TENSIONS {
            let controls = [FREE, FREE, turn, FREE, FREE, Control::Load(tension)];
            let response = relax(cell, controls, pulled.as_ref())?;
            let t = &response.tangent;
            let case = format!("at {tension} pN, turn {name}");
            let shear = 0.5 * (t[(3, 3)] + t[(4, 4)]);
            all.push((format!("B {case} (pN nm^2)"), 0.5 * (t[(0, 0)] + t[(1, 1)])));
            all.push((format!("S {case} (pN)"), shear));
            all.push((format!("S/T {case}"), shear / tension));
            all.push((
                format!("bend-shear coupling {case} (pN nm)"),
                0.5 * (t[(0, 3)] + t[(1, 4)]),
            ));
            all.push((format!("kappa_3 {case} (rad/nm)"), response.strain[2]));
            pulled = Some(response);
        }
    }
    Ok(all)
}
