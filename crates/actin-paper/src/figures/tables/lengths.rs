//! Dependence of Table 3 on the length of the filament, due to the clamped ends.

use super::ensemble::Kind;
use crate::figures::draft::Draft;
use crate::measure::{Curve, TwistPoint, twist};
use crate::statistics::sample;
use actin_sim::Monomers;

/// Rises between the inner clamped monomers. The tables use 27.
const RISES: [u32; 5] = [14, 27, 28, 55, 109];
/// Twists (rad/nm) and the corresponding printed angles (deg). The first is close to rest.
const CURVATURES: [(f64, f64); 4] = [(1e-4, 0.0), (0.0023, 10.0), (0.0185, 80.0), (0.0416, 180.0)];
const SEEDS: u64 = 8;

const HEADER: [&str; 6] = [
    "rises",
    "kappa3_rad_per_nm",
    "b3_mean",
    "b3_sd",
    "dl_over_l_mean",
    "dl_over_l_sd",
];

/// Adds rows of the secant rigidity, and writes a table that also contains the change of length.
pub(super) fn rows(draft: &mut Draft<'_>) -> Result<(), String> {
    let cases = RISES
        .into_iter()
        .flat_map(|rises| (0..SEEDS).map(move |seed| (rises, seed)));
    let cases: Vec<(u32, u64)> = cases.collect();
    let curves = draft.solve(&cases, |&(rises, seed)| Ok((rises, measure(rises, seed)?)))?;
    let mut lines = Vec::new();
    for rises in RISES {
        for (i, (curvature, phi)) in angles().into_iter().enumerate() {
            let whole = curves
                .iter()
                .filter(|(of, c)| *of == rises && c.unreached.is_empty());
            let points: Vec<&TwistPoint> = whole.map(|(_, curve)| &curve.points[i]).collect();
            let b3 = sample(points.iter().map(|p| p.rigidity_pn_nm2));
            let change = sample(points.iter().map(|p| p.relative_length_change));
            let note = format!(
                "{rises} rises, {:.2} nm, at {curvature} rad/nm; mean of {} samplings, sd {:.0}",
                length_nm(rises),
                b3.count,
                b3.sd()
            );
            let direction = if curvature > 0.0 { "over" } else { "under" };
            let at = if phi > 0.0 {
                phi.to_string()
            } else {
                "rest".into()
            };
            let quantity = format!("b3/length-{rises}/{direction}/{at}");
            draft.row(quantity, "pN nm^2", b3.mean, note);
            let numbers = [curvature, b3.mean, b3.sd(), change.mean, change.sd()];
            lines.push((vec![rises.to_string()], vec![numbers]));
        }
    }
    draft.curves("table3_lengths.csv", &HEADER, lines)
}

fn length_nm(rises: u32) -> f64 {
    f64::from(rises) * Monomers::default().rise_nm
}

/// Twists in both directions in ascending order.
fn angles() -> Vec<(f64, f64)> {
    let under = CURVATURES.iter().rev().map(|&(kappa, phi)| (-kappa, phi));
    under.chain(CURVATURES).collect()
}

fn measure(rises: u32, seed: u64) -> Result<Curve<TwistPoint>, String> {
    let specimen = Kind::DEFAULT.specimen(f64::from(rises), seed);
    let turn = |(kappa, _): (f64, f64)| (kappa * length_nm(rises)).to_degrees();
    let turns: Vec<f64> = angles().into_iter().map(turn).collect();
    twist(&specimen, &turns).map_err(|error| format!("{rises} rises, seed {seed}: {error}"))
}
