//! `cargo xtask costs`: what scenes cost beside what `actin check` estimates, and how it grows with
//! their size.
//!
//! Every scene goes the way of `actin run`: its text is read, built, estimated, run and written. Times
//! are those that one thread spends on a processor. An exponent is that of the time from one size of a
//! family to the next.

mod families;
mod measure;

use actin_paper::tradeoff;
use families::{FAMILIES, Family};
use measure::{Measured, measure};
use std::path::Path;
use std::process::Command;

/// What is measured.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Which: names of families, `trade`; all by default.
    names: Vec<String>,
    /// The largest size of a family.
    #[arg(long, default_value_t = 1_000_000)]
    largest: usize,
    /// Fewer settings of the scenes of `cargo xtask tradeoff`.
    #[arg(long)]
    quick: bool,
    /// Measures in this program, however it was compiled.
    #[arg(long)]
    here: bool,
}

/// The name under which the scenes of the trade are measured.
const TRADE: &str = "trade";

/// By how much an estimate may be off either way.
const FACTOR: f64 = 2.0;
/// Time that a user may notice (s).
const NOTICED_S: f64 = 0.05;

/// Measures and prints.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    if cfg!(debug_assertions) && !options.here {
        return run_optimised(options);
    }
    let known: Vec<&str> = FAMILIES.iter().map(|f| f.name).chain([TRADE]).collect();
    if let Some(name) = options.names.iter().find(|n| !known.contains(&n.as_str())) {
        return Err(format!("no family {name:?}: there is {}", known.join(", ")));
    }
    let is_wanted =
        |name: &str| options.names.is_empty() || options.names.iter().any(|n| n == name);
    let out = std::env::temp_dir().join(format!("costs-{}", std::process::id()));
    let mut tally = Tally::default();
    head();
    for family in FAMILIES.iter().filter(|family| is_wanted(family.name)) {
        grow(family, options.largest, &out, &mut tally)?;
    }
    if is_wanted(TRADE) {
        for (name, text) in tradeoff::scenes(options.quick) {
            match measure(&text, &out) {
                Ok(measured) => {
                    row(&name, &measured, [None; 2]);
                    tally.push(name, &measured);
                }
                // The trade counts settings without an equilibrium; here there is no time to compare.
                Err(error) => println!("{name:44} {error}"),
            }
        }
    }
    tally.print();
    Ok(())
}

/// Measures a family from size to size.
fn grow(family: &Family, largest: usize, out: &Path, tally: &mut Tally) -> Result<(), String> {
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
        );
        tally.push(name, &measured);
        before = Some((size as f64, times));
    }
    Ok(())
}

fn head() {
    println!(
        "{:44} {:>9} {:>5} {:>9} {:>5} {:>9} {:>6} {:>7} {:>15} {:>13}  parts: estimated, measured (s)",
        "scene", "check s", "exp", "run s", "exp", "estimate", "ratio", "records", "steps", "MB"
    );
}

fn row(name: &str, measured: &Measured, exponents: [Option<f64>; 2]) {
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
    println!(
        "{name:44} {check_s:9.4} {check:>5} {run_s:9.4} {run:>5} {estimate:9.4} {:6.2} {records:7} \
         {:>15} {:>13}  {:.1e} {:.1e} {:.1e}, {set_up:.1e} {solve:.1e} {results:.1e}",
        estimate / run_s,
        format!("{estimated_steps}/{steps}"),
        format!("{:.0}/{peak_mb:.0}", 1e-6 * cost.bytes),
        seconds.set_up,
        seconds.solve,
        seconds.results,
    );
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

    fn print(&mut self) {
        let is_near = |ratio: f64| (1.0 / FACTOR..=FACTOR).contains(&ratio);
        let near = self.ratios.iter().filter(|(_, ratio, _)| is_near(*ratio));
        let far = self.ratios.iter().filter(|(_, ratio, _)| !is_near(*ratio));
        let noticed = far.filter(|(.., seconds)| seconds.abs() > NOTICED_S);
        println!(
            "within a factor of {FACTOR}: {} of {}; of the others {} miss by more than {NOTICED_S} s",
            near.count(),
            self.ratios.len(),
            noticed.count()
        );
        self.ratios
            .sort_by(|a, b| b.1.ln().abs().total_cmp(&a.1.ln().abs()));
        for (name, ratio, seconds) in &self.ratios {
            if !is_near(*ratio) {
                println!("  {ratio:.2} of the time of {name}: {seconds:+.3} s");
            }
        }
    }
}

/// Does the same in a program that is compiled as a user's is.
fn run_optimised(options: &Options) -> Result<(), String> {
    let mut command = Command::new("cargo");
    command.args(["run", "--quiet", "--release", "--package", "xtask", "--"]);
    command.arg("costs").args(&options.names);
    command.args(["--largest", &options.largest.to_string()]);
    if options.quick {
        command.arg("--quick");
    }
    let status = command
        .current_dir(crate::check::workspace_root())
        .status()
        .map_err(|error| format!("cargo did not start: {error}"))?;
    status
        .success()
        .then_some(())
        .ok_or_else(|| "the optimised program failed".to_owned())
}
