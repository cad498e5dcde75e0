//! `cargo xtask bench`: rates of fixed cases in a release build, with targets and rates of other programs.
//!
//! Cases use the public interface: a scene is assembled, and its system is stepped or solved. All but ensembles run
//! on one thread. Motions have no linkers, drag or observers.

mod cases;
mod ensemble;
mod equilibrium;
mod motion;
mod network;
mod peers;

use anyhow::{Error, Result};
use cases::{CASES, Case, Work};

#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Names of cases; all by default.
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Prints a JSON array of `case`, `rate`, `unit` instead of a table.
    #[arg(long)]
    json: bool,
    /// Runs the same cases in other installed programs, and prints ratios.
    #[arg(long, conflicts_with = "json")]
    peers: bool,
}

struct Timings {
    /// Best of the repeats, least affected by other load on the machine.
    best: f64,
    /// Median of the repeats.
    median: f64,
    note: String,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    case: &'static str,
    /// Best of the repeats, in `unit`.
    rate: f64,
    /// Elements per second, seconds, seconds per simulated ms, or speed-up over one thread.
    unit: &'static str,
}

pub(crate) fn run(options: &Options) -> Result<()> {
    let entries = measure(options).map_err(Error::msg)?;
    if options.json {
        let object = |entry: &Entry| {
            let Entry { case, rate, unit } = entry;
            serde_json::json!({ "case": case, "rate": rate, "unit": unit })
        };
        let all: Vec<serde_json::Value> = entries.iter().map(object).collect();
        println!("{}", serde_json::to_string_pretty(&all)?);
    }
    if options.peers {
        println!("");
        peers::compare(&entries);
    }
    Ok(())
}

fn measure(options: &Options) -> Result<Vec<Entry>, String> {
    if !options.json {
        println!(
            "{:>13}  {:30} {:>10} {:>10} {:>10}  unit",
            "ours / target", "case", "best", "median", "target"
        );
    }
    let mut entries = Vec::new();
    for case in chosen(&options.cases)? {
        let measured = match case.work {
            Work::Motion(motion) => motion::measure(&motion),
            Work::Equilibrium { length_nm } => equilibrium::measure(length_nm),
            Work::Ensemble(of) => ensemble::measure(of),
            Work::Network(network) => network::measure(network),
        }
        .map_err(|error| format!("{}: {error}", case.name))?;
        if !options.json {
            print_row(case, &measured);
        }
        entries.push(Entry {
            case: case.name,
            rate: measured.best,
            unit: case.unit(),
        });
    }
    Ok(entries)
}

fn print_row(case: &Case, measured: &Timings) {
    let ratio = case
        .target
        .map_or("-".to_owned(), |t| format!("{:.2}", measured.best / t));
    let scaled = |value: f64| match case.work {
        Work::Motion(_) => format!("{:.1}", 1e-6 * value),
        Work::Equilibrium { .. } => format!("{value:.4}"),
        Work::Ensemble(_) | Work::Network(_) => format!("{value:.2}"),
    };
    let million = match case.work {
        Work::Motion(_) => "1e6 ",
        Work::Equilibrium { .. } | Work::Ensemble(_) | Work::Network(_) => "",
    };
    println!(
        "{ratio:>13}  {:30} {:>10} {:>10} {:>10}  {million}{}; {}",
        case.name,
        scaled(measured.best),
        scaled(measured.median),
        case.target.map_or("-".to_owned(), scaled),
        case.unit(),
        measured.note
    );
}

fn chosen(names: &[String]) -> Result<Vec<&'static Case>, String> {
    for name in names {
        if !CASES.iter().any(|case| case.name == name) {
            let known: Vec<_> = CASES.iter().map(|case| case.name).collect();
            return Err(format!(
                "unknown case {name:?}; known cases: {}",
                known.join(", ")
            ));
        }
    }
    let wanted = |case: &&Case| names.is_empty() || names.iter().any(|name| case.name == name);
    Ok(CASES.iter().filter(wanted).collect())
}

/// Returns the median of at least one value.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_chosen_by_name_in_their_own_order() {
        let names = ["rod-pv-64", "rod-pv-16"].map(str::to_owned);
        let found: Vec<_> = chosen(&names).unwrap().iter().map(|c| c.name).collect();
        assert_eq!(found, ["rod-pv-16", "rod-pv-64"]);
        assert_eq!(chosen(&[]).unwrap().len(), CASES.len());
        assert!(chosen(&["rod-pv-17".to_owned()]).is_err());
    }

    #[test]
    fn ensembles_run() {
        for case in &CASES {
            if let Work::Ensemble(of) = case.work {
                let seconds = ensemble::seconds(of, 2, std::num::NonZeroUsize::MIN);
                assert!(seconds.is_ok_and(|s| s > 0.0), "{}", case.name);
            }
        }
    }

    #[test]
    fn scenes_match_their_names() {
        for (name, elements) in [
            ("rod-pv-16", 16),
            ("rod-pv-64x64", 4096),
            ("ellipsoid-pv-60", 1170),
            ("ellipsoid-pv-1000", 19_970),
            ("rod-fitted-pv-16", 16),
        ] {
            let case = CASES.iter().find(|case| case.name == name).unwrap();
            let Work::Motion(motion) = case.work else {
                panic!("{name} is a motion");
            };
            let systems = motion::assemble(&motion).unwrap();
            assert_eq!(motion::elements(&systems), elements, "{name}");
        }
    }
}
