//! How far Table 3 depends on the length of the filament: small twist is resisted by the ends.

use super::ensemble::Kind;
use super::statistics::sample;
use crate::figures::Run;
use crate::measure::{Curve, Specimen, TwistPoint, twist};
use actin_draw::report::{Row, write_csv};
use actin_sim::Monomers;
use rayon::prelude::*;

/// Rises between the inner held monomers; 27 is the length of the tables, 28 the next to it.
const RISES: [u32; 5] = [14, 27, 28, 55, 109];
/// Curvatures (rad/nm) and the angles (deg) that the paper prints for them; the first is rest.
const CURVATURES: [(f64, f64); 4] = [(1e-4, 0.0), (0.0023, 10.0), (0.0185, 80.0), (0.0416, 180.0)];
/// Bond samplings of each length.
const SEEDS: u64 = 8;

/// Measures every length; rows for the secant rigidity, a table with the change of length too.
pub(super) fn rows(Run { out, progress, .. }: Run<'_>) -> Result<Vec<Row>, String> {
    let cases: Vec<(u32, u64)> = RISES
        .into_iter()
        .flat_map(|rises| (0..SEEDS).map(move |seed| (rises, seed)))
        .collect();
    progress.expect(cases.len());
    let curves: Vec<(u32, Curve<TwistPoint>)> = cases
        .into_par_iter()
        .map(|(rises, seed)| Ok((rises, measure(rises, seed)?)))
        .inspect(|_| progress.done())
        .collect::<Result<_, String>>()?;
    let mut rows = Vec::new();
    let mut lines = Vec::new();
    for rises in RISES {
        for (i, (curvature, phi)) in angles().into_iter().enumerate() {
            let points: Vec<&TwistPoint> = curves
                .iter()
                .filter(|(of, curve)| *of == rises && curve.unreached.is_empty())
                .map(|(_, curve)| &curve.points[i])
                .collect();
            let b3 = sample(points.iter().map(|p| p.rigidity_pn_nm2));
            let change = sample(points.iter().map(|p| p.relative_length_change));
            rows.push(row(rises, curvature, phi, (b3.mean, b3.sd, b3.count)));
            let numbers = [b3.mean, b3.sd, change.mean, change.sd].map(|x| format!("{x:.6e}"));
            let mut line = vec![rises.to_string(), curvature.to_string()];
            line.extend(numbers);
            lines.push(line);
        }
    }
    let header = [
        "rises",
        "kappa3_rad_per_nm",
        "b3_mean",
        "b3_sd",
        "dl_over_l_mean",
        "dl_over_l_sd",
    ];
    write_csv(out, "table3_lengths.csv", &header, lines)?;
    Ok(rows)
}

fn row(rises: u32, curvature: f64, phi: f64, (mean, sd, count): (f64, f64, usize)) -> Row {
    let direction = if curvature > 0.0 { "over" } else { "under" };
    let note = format!(
        "{rises} rises, {:.2} nm, at {curvature} rad/nm; mean of {count} samplings, sd {sd:.0}",
        length_nm(rises)
    );
    let at = if phi > 0.0 {
        phi.to_string()
    } else {
        "rest".to_owned()
    };
    let quantity = format!("b3/length-{rises}/{direction}/{at}");
    Row::measured("table3", quantity, "pN nm^2", mean, note)
}

fn length_nm(rises: u32) -> f64 {
    f64::from(rises) * Monomers::default().rise_nm
}

/// Curvatures in both directions, ascending, as a curve's points are.
fn angles() -> Vec<(f64, f64)> {
    let under = CURVATURES.iter().rev().map(|&(kappa, phi)| (-kappa, phi));
    under.chain(CURVATURES).collect()
}

fn measure(rises: u32, seed: u64) -> Result<Curve<TwistPoint>, String> {
    let length = length_nm(rises);
    let specimen = Specimen::ellipsoids(length, Kind::DEFAULT.monomers(seed));
    let turns: Vec<f64> = angles()
        .iter()
        .map(|(kappa, _)| (kappa * length).to_degrees())
        .collect();
    twist(&specimen, &turns).map_err(|error| format!("{rises} rises, seed {seed}: {error}"))
}
