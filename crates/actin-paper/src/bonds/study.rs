//! Tables 3 to 5 against the shortest bond, and against the number of weighted bonds.

use super::Effort;
use super::page::Listing;
use super::tables::{GATES, Measured};
use super::variant::Variant;
use indicatif::{ProgressBar, ProgressStyle};

/// Shortest bonds (nm) and numbers of drawn bonds of the grid.
const SHORTEST: [f64; 5] = [0.0, 0.15, 0.20, 0.25, 0.30];
const BONDS: [usize; 3] = [28, 32, 64];
/// The shortest bond that is compared further, and the rise and radii with which it is (nm).
const CHOSEN: f64 = 0.20;
const RISE: f64 = 2.76;
const RADII: [f64; 2] = [1.75, 1.85];
/// Numbers of weighted bonds.
const POINTS: [usize; 4] = [8, 12, 16, 24];
/// Drawn bonds of the limit of many, and their samplings.
const MANY: usize = 1024;
const MANY_SAMPLINGS: u64 = 2;

/// The grid of shortest bond and number of bonds, and its middle at another rise and other radii.
fn variants() -> Vec<Variant> {
    let grid = SHORTEST.into_iter().flat_map(|shortest| {
        let drawn = BONDS.map(|bonds| Variant::drawn(bonds, shortest));
        drawn.into_iter().chain([Variant::weighted(12, shortest)])
    });
    let corners = [(64, 0.0), (28, 0.0), (64, CHOSEN), (28, CHOSEN)];
    let risen = corners.map(|(bonds, shortest)| Variant::drawn(bonds, shortest).rising(RISE));
    let radii = RADII.into_iter().flat_map(|radius| {
        [0.0, CHOSEN].map(|shortest| Variant::drawn(64, shortest).at_radius(radius))
    });
    let mean = || Variant::weighted(12, CHOSEN);
    let mean = RADII
        .map(|radius| mean().at_radius(radius))
        .into_iter()
        .chain([mean().rising(RISE)]);
    grid.chain(risen).chain(radii).chain(mean).collect()
}

/// Tables 3 to 5 of drawn bonds.
pub(super) fn shortest(effort: Effort) -> Result<Listing, String> {
    let mut rows = Vec::new();
    let variants = variants();
    let bar = bar(variants
        .iter()
        .map(|v| v.seeds(effort.samplings).len())
        .sum());
    for variant in &variants {
        let measured = Measured::of(variant, effort.samplings, &|| bar.inc(1))?;
        let m = &variant.monomers;
        let mut row = vec![
            format!("{:.2}", m.min_bond_nm),
            variant.bonds(),
            format!("{:.4}", m.rise_nm),
            format!("{:.2}", m.radius_nm),
        ];
        row.extend(compared(&measured));
        row.extend([10.0, -10.0, 180.0, -180.0].map(|phi| format!("{:.0}", measured.b3_at(phi))));
        row.push(measured.doubtful.to_string());
        rows.push(row);
    }
    bar.finish_and_clear();
    let mut header = vec!["shortest (nm)", "bonds", "rise (nm)", "radius (nm)"];
    header.extend(COMPARED);
    header.extend(["B3(+10)", "B3(-10)", "B3(+180)", "B3(-180)", "doubtful"]);
    Ok(Listing { header, rows })
}

/// Tables 3 to 5 of weighted bonds, against many and fewer drawn ones.
pub(super) fn weighted(effort: Effort) -> Result<Listing, String> {
    let points = POINTS.map(|points| (Variant::weighted(points, CHOSEN), 1));
    let drawn = [
        (
            Variant::drawn(MANY, CHOSEN),
            MANY_SAMPLINGS.min(effort.samplings),
        ),
        (Variant::drawn(64, CHOSEN), effort.samplings),
        (Variant::patterned(64, CHOSEN), effort.samplings),
    ];
    let all: Vec<(Variant, u64)> = points.into_iter().chain(drawn).collect();
    let bar = bar(all.iter().map(|(v, s)| v.seeds(*s).len()).sum());
    let measured: Vec<Measured> = all
        .iter()
        .map(|(variant, samplings)| Measured::of(variant, *samplings, &|| bar.inc(1)))
        .collect::<Result<_, _>>()?;
    bar.finish_and_clear();
    let many = &measured[POINTS.len()];
    let mut header = vec!["bonds"];
    header.extend(COMPARED);
    header.extend([
        "B3 from many",
        "S3 from many",
        "B(1e-3) from many",
        "B(1e-2) from many",
        "shear from many",
        "cost (s)",
    ]);
    let rows = all.iter().zip(&measured).map(|((variant, _), measured)| {
        let mut row = vec![variant.bonds()];
        row.extend(compared(measured));
        row.extend(from_many(measured, many));
        row.push(format!("{:.2}", measured.seconds));
        row
    });
    let rows = rows.collect();
    Ok(Listing { header, rows })
}

/// Columns of the four differences to the paper, and how many are within their bounds.
const COMPARED: [&str; 6] = [
    "B3 rms",
    "dL/L rms",
    "S3",
    "B1",
    "gates met",
    "dL/L rms to 180 deg",
];

fn compared(measured: &Measured) -> Vec<String> {
    let differences = measured.differences();
    let met = differences
        .iter()
        .zip(GATES)
        .filter(|(difference, gate)| difference.abs() <= *gate);
    let [b3, change, s3, b1] = differences;
    vec![
        format!("{:.1} %", 100.0 * b3),
        format!("{:.2}e-3", 1e3 * change),
        format!("{:+.1} %", 100.0 * s3),
        format!("{:+.1} %", 100.0 * b1),
        format!("{} of 4", met.count()),
        format!("{:.2}e-3", 1e3 * measured.change_to(180.0)),
    ]
}

/// Differences to very many drawn bonds, in percent: the largest of B3 between 40 and 200 deg.
fn from_many(measured: &Measured, many: &Measured) -> Vec<String> {
    let percent = |ours: f64, theirs: f64| 100.0 * (ours / theirs - 1.0);
    let b3 = measured.b3.iter().zip(&many.b3);
    let b3 = b3
        .filter(|((entry, ..), _)| (40.0..=200.0).contains(&entry.phi_deg))
        .map(|((_, ours, _), (_, theirs, _))| percent(*ours, *theirs))
        .fold(
            0.0,
            |worst: f64, x| if x.abs() > worst.abs() { x } else { worst },
        );
    let rest = [
        (measured.s3, many.s3),
        (measured.b1[0], many.b1[0]),
        (measured.b1[1], many.b1[1]),
        (measured.shear, many.shear),
    ];
    let rest = rest.map(|(ours, theirs)| percent(ours, theirs));
    let all = std::iter::once(b3).chain(rest);
    all.map(|x| format!("{x:+.1} %")).collect()
}

/// A line that counts runs.
pub(super) fn bar(runs: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:32} {pos}/{len} runs, {elapsed}")
        .expect("the template is well formed");
    ProgressBar::new(runs as u64).with_style(style)
}
