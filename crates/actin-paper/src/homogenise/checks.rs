//! The cell beside the tables of the paper, and beside what is known of filaments of monomers.

use super::filament::{FREE, NONE, mean, patterned, relax, twisted};
use crate::Tell;
use crate::figures::paper::{Table, entries};
use actin_sim::ellipsoid::{Cell, CellResponse, Control};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// Tensions (pN).
const TENSIONS: [f64; 4] = [1.0, 5.0, 10.0, 40.0];
/// Curvatures of bending (rad/nm).
const CURVATURES: [f64; 4] = [1e-4, 1e-3, 5e-3, 1e-2];

/// A number of the mean filament and of filaments of one pattern each.
struct Line {
    quantity: String,
    mean: f64,
    patterns: Vec<f64>,
}

/// Prints and writes all.
pub(super) fn run(out: &Path, samplings: u64, tell: Tell<'_>) -> Result<(), String> {
    let cell = mean()?;
    let mean = numbers(&cell)?;
    let patterns: Vec<Vec<(String, f64)>> = (1..=samplings)
        .into_par_iter()
        .map(|seed| numbers(&patterned(seed)?))
        .collect::<Result<_, _>>()?;
    let line = |(k, (quantity, value)): (usize, (String, f64))| Line {
        quantity,
        mean: value,
        patterns: patterns.iter().map(|of_one| of_one[k].1).collect(),
    };
    let lines: Vec<Line> = mean.into_iter().enumerate().map(line).collect();
    let mut markdown = format!(
        "| quantity | mean filament | one pattern of 64 ({samplings}) | sd |\n| --- | ---: | ---: | ---: |\n"
    );
    let mut csv = String::from("quantity,mean_filament,mean_of_patterns,sd_of_patterns\n");
    for line in &lines {
        let (average, deviation) = statistics(&line.patterns);
        let Line { quantity, mean, .. } = line;
        let _ = writeln!(
            markdown,
            "| {quantity} | {mean:.5e} | {average:.5e} | {deviation:.1e} |"
        );
        let _ = writeln!(csv, "{quantity},{mean:e},{average:e},{deviation:e}");
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
fn numbers(cell: &Cell) -> Result<Vec<(String, f64)>, String> {
    let mut all = twist(cell)?;
    all.extend(stretch(cell)?);
    all.extend(bending(cell)?);
    all.extend(tension(cell)?);
    Ok(all)
}

/// Tables 3 and 5: rows from 40 and from 10 to 200 deg.
fn twist(cell: &Cell) -> Result<Vec<(String, f64)>, String> {
    let rigidities = entries(Table::Rigidity)?;
    let lengths = entries(Table::LengthChange)?;
    let mut all = Vec::new();
    let mut sums = [(0.0, 0.0); 2];
    for (rigidity, length) in rigidities.iter().zip(&lengths) {
        if !rigidity.is_reliable() {
            continue;
        }
        let response = twisted(cell, rigidity.curvature)?;
        let b3 = response.loads[2] / rigidity.curvature;
        let change = response.strain[5];
        if rigidity.phi_deg >= 40.0 {
            sums[0].0 += (b3 / rigidity.value - 1.0).powi(2);
            sums[0].1 += 1.0;
        }
        sums[1].0 += (change - length.value).powi(2);
        sums[1].1 += 1.0;
        let angle = rigidity.phi_deg.copysign(rigidity.curvature);
        if [40.0, 80.0, 120.0, 180.0].contains(&rigidity.phi_deg) {
            all.push((format!("B3 at {angle:+.0} deg (pN nm^2)"), b3));
            all.push((format!("dL/L at {angle:+.0} deg"), change));
        }
    }
    let [b3, change] = sums.map(|(sum, count): (f64, f64)| (sum / count).sqrt());
    all.push(("B3 rms against Table 3".to_owned(), b3));
    all.push(("dL/L rms against Table 5".to_owned(), change));
    Ok(all)
}

/// Stretch without turning, both ways; the length held at rest while it is sheared.
fn stretch(cell: &Cell) -> Result<Vec<(String, f64)>, String> {
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
fn bending(cell: &Cell) -> Result<Vec<(String, f64)>, String> {
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
fn tension(cell: &Cell) -> Result<Vec<(String, f64)>, String> {
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
