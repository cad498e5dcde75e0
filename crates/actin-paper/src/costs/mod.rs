//! What scenes cost beside what `actin check` estimates, and how it grows with
//! their size.
//!
//! Every scene goes the way of `actin run`: its text is read, built, estimated, run and written. Times
//! are those that one thread spends on a processor. An exponent is that of the time from one size of a
//! family to the next.

mod families;
mod measure;

use crate::{Tell, tradeoff};
use families::{FAMILIES, Family};
use measure::{Measured, measure};
use std::path::Path;

/// What is measured.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which: names of families, `trade`; all by default.
    pub names: Vec<String>,
    /// The largest size of a family.
    pub largest: usize,
    /// Fewer settings of the scenes of the trade study.
    pub quick: bool,
}

/// The name under which the scenes of the trade are measured.
const TRADE: &str = "trade";

/// By how much an estimate may be off either way.
const FACTOR: f64 = 2.0;
/// Time that a user may notice (s).
const NOTICED_S: f64 = 0.05;

/// Measures and tells, in the profile in which this crate was compiled.
///
/// # Errors
/// A family that is not known, one of its scenes that cannot be run, and a file that cannot be written.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<(), String> {
    let known: Vec<&str> = FAMILIES.iter().map(|f| f.name).chain([TRADE]).collect();
    if let Some(name) = options.names.iter().find(|n| !known.contains(&n.as_str())) {
        return Err(format!("no family {name:?}: there is {}", known.join(", ")));
    }
    let is_wanted =
        |name: &str| options.names.is_empty() || options.names.iter().any(|n| n == name);
    let out = std::env::temp_dir().join(format!("costs-{}", std::process::id()));
    let mut tally = Tally::default();
    head(tell);
    for family in FAMILIES.iter().filter(|family| is_wanted(family.name)) {
        grow(family, options.largest, &out, &mut tally, tell)?;
    }
    if is_wanted(TRADE) {
        for (name, text) in tradeoff::scenes(options.quick) {
            match measure(&text, &out) {
                Ok(measured) => {
                    row(&name, &measured, [None; 2], tell);
                    tally.push(name, &measured);
                }
                // The trade counts settings without an equilibrium; here there is no time to compare.
                Err(error) => tell(format_args!("{name:44} {error}")),
            }
        }
    }
    tally.print(tell);
    Ok(())
}

/// Measures a family from size to size.
fn grow(
    family: &Family,
    largest: usize,
    out: &Path,
    tally: &mut Tally,
    tell: Tell<'_>,
) -> Result<(), String> {
    let mut before: Option<(f64, [f64; 2])> = None;
    for &size in family.sizes.iter().filter(|size| **size <= largest) {
        let name = format!("{} {size} {}", family.name, family.counted);
        let measured = measure(&family.text(size), out).map_err(|e| format!("{name}: {e}"))?;
        let times = [measured.check_s, measured.run_s];
        let exponents = before.map(|(smaller, faster)| {
            [0, 1].map(|k| (times[k] / faster[k]).ln() / (size as f64 / smaller).ln())
        });
        row(
            &name,
            &measured,
            exponents.map_or([None; 2], |e| e.map(Some)),
            tell,
        );
        tally.push(name, &measured);
        before = Some((size as f64, times));
    }
    Ok(())
}

fn head(tell: Tell<'_>) {
    tell(format_args!(
        "{:44} {:>9} {:>5} {:>9} {:>5} {:>9} {:>6} {:>7} {:>15} {:>13}  parts: estimated, measured (s)",
        "scene", "check s", "exp", "run s", "exp", "estimate", "ratio", "records", "steps", "MB"
    ));
}

fn row(name: &str, measured: &Measured, exponents: [Option<f64>; 2], tell: Tell<'_>) {
    let [check, run] = exponents.map(|e| e.map_or_else(String::new, |e| format!("{e:.2}")));
    let Measured {
        cost,
        check_s,
        run_s,
        parts_s: [set_up, solve, results],
        steps,
        records,
        peak_mb,
    } = measured;
    let (estimate, seconds) = (cost.seconds.total(), cost.seconds);
    let estimated_steps = match cost.equilibria {
        0 => "-".to_owned(),
        _ => cost.evaluations.to_string(),
    };
    tell(format_args!(
        "{name:44} {check_s:9.4} {check:>5} {run_s:9.4} {run:>5} {estimate:9.4} {:6.2} {records:7} \
         {:>15} {:>13}  {:.1e} {:.1e} {:.1e}, {set_up:.1e} {solve:.1e} {results:.1e}",
        estimate / run_s,
        format!("{estimated_steps}/{steps}"),
        format!("{:.0}/{peak_mb:.0}", 1e-6 * cost.bytes),
        seconds.set_up,
        seconds.solve,
        seconds.results,
    ));
}

/// How near the estimates are.
#[derive(Default)]
struct Tally {
    /// Name, estimate over time, and by how many seconds it misses.
    ratios: Vec<(String, f64, f64)>,
}

impl Tally {
    fn push(&mut self, name: String, measured: &Measured) {
        let estimate = measured.cost.seconds.total();
        let ratio = estimate / measured.run_s;
        self.ratios.push((name, ratio, estimate - measured.run_s));
    }

    fn print(&mut self, tell: Tell<'_>) {
        let is_near = |ratio: f64| (1.0 / FACTOR..=FACTOR).contains(&ratio);
        let near = self.ratios.iter().filter(|(_, ratio, _)| is_near(*ratio));
        let far = self.ratios.iter().filter(|(_, ratio, _)| !is_near(*ratio));
        let noticed = far.filter(|(.., seconds)| seconds.abs() > NOTICED_S);
        tell(format_args!(
            "within a factor of {FACTOR}: {} of {}; of the others {} miss by more than {NOTICED_S} s",
            near.count(),
            self.ratios.len(),
            noticed.count()
        ));
        self.ratios
            .sort_by(|a, b| b.1.ln().abs().total_cmp(&a.1.ln().abs()));
        for (name, ratio, seconds) in &self.ratios {
            if !is_near(*ratio) {
                tell(format_args!(
                    "  {ratio:.2} of the time of {name}: {seconds:+.3} s"
                ));
            }
        }
    }
}
