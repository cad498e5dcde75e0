//! `actin trade`: error versus run time of models of a scene, as a table, a figure and the cheapest accurate scene.

use crate::failure::{Failure, ParsedScene};
use crate::progress;
use crate::{SceneArguments, signals};
use actin_sim::trade::{Measure, Options, Trade, TradeCallbacks, TradeError, trade as run};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Duration;

const FILES: [&str; 3] = ["trade.csv", "trade.svg", "best.ron"];

#[derive(Debug, clap::Args)]
pub(crate) struct TradeArguments {
    #[command(flatten)]
    source: SceneArguments,
    /// Compared quantities, separated by commas: tip, height, end-force, end-couple, energy, curvature, linker-force,
    /// or the prefix of a column of observables.csv. By default the observables of the scene and the tip displacements.
    /// Arc lengths of extreme values are not compared.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Largest accepted relative error.
    #[arg(long, default_value_t = 0.02)]
    error: f64,
    /// Longest wall-clock time of one run, in seconds.
    #[arg(long, value_name = "SECONDS", default_value = "60s", value_parser = budget)]
    budget: Duration,
    /// Fractions of the loads, separated by commas. Models within the error at full load run again at these
    /// fractions; 1 disables these runs.
    #[arg(
        long,
        value_name = "SHARE",
        value_delimiter = ',',
        default_value = "0.5"
    )]
    loads: Vec<f64>,
    /// Also compares models with finer meshes and other rod laws.
    #[arg(long)]
    all: bool,
    /// Folder of trade.csv, trade.svg and best.ron; by default `trades/` and the name of the scene.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replaces existing trade.csv, trade.svg and best.ron.
    #[arg(long)]
    overwrite: bool,
}

fn budget(text: &str) -> Result<Duration, String> {
    crate::seconds(text.strip_suffix('s').unwrap_or(text))
}

pub(crate) fn trade(arguments: &TradeArguments) -> Result<(), Failure> {
    let read = ParsedScene::new(&arguments.source)?;
    let out = folder(arguments)?;
    let interrupted = signals::interruption()?;
    let bar = progress::spinner();
    let watch = TradeCallbacks {
        report: &|what| bar.set_message(what.to_owned()),
        is_interrupted: &|| interrupted.load(Ordering::Relaxed),
    };
    let found = run(&read.scene, &arguments.options(), &watch);
    bar.finish_and_clear();
    let trade = found.map_err(|error| match error {
        TradeError::Refused(problem) => read.refuse(&problem),
        TradeError::ReferenceFails { .. } => Failure::Numerical(error.to_string()),
        TradeError::Interrupted => Failure::Interrupted(error.to_string()),
    })?;
    println!("{trade}");
    write(&trade, &out).map_err(Failure::Unwritten)?;
    println!("written: {} in {}", FILES.join(", "), out.display());
    if interrupted.load(Ordering::Relaxed) {
        let message = "the table contains the candidates before the interruption".to_owned();
        return Err(Failure::Interrupted(message));
    }
    Ok(())
}

impl TradeArguments {
    fn options(&self) -> Options {
        let is_other = |share: &f64| (share - 1.0).abs() > f64::EPSILON;
        Options {
            measures: self.quantity.iter().map(|name| measure(name)).collect(),
            error: self.error,
            budget: self.budget,
            load_shares: self.loads.iter().copied().filter(is_other).collect(),
            is_all: self.all,
        }
    }
}

fn measure(name: &str) -> Measure {
    match name.parse() {
        Ok(measure) => measure,
        Err(never) => match never {},
    }
}

fn folder(arguments: &TradeArguments) -> Result<PathBuf, Failure> {
    let name = arguments
        .source
        .scene
        .file_stem()
        .filter(|_| !arguments.source.is_standard_input());
    let by_default = || Path::new("trades").join(name.unwrap_or("stdin".as_ref()));
    let out = arguments.out.clone().unwrap_or_else(by_default);
    let earlier = FILES.into_iter().find(|file| out.join(file).exists());
    if let Some(earlier) = earlier.filter(|_| !arguments.overwrite) {
        return Err(Failure::Input(format!(
            "{} exists: --overwrite replaces it, --out names another folder",
            out.join(earlier).display()
        )));
    }
    fs::create_dir_all(&out)
        .map_err(|error| Failure::Unwritten(format!("{}: {error}", out.display())))?;
    Ok(out)
}

fn write(trade: &Trade, out: &Path) -> Result<(), String> {
    let path = |file: &str| out.join(file);
    let table = path("trade.csv");
    fs::write(&table, trade.to_csv()).map_err(|error| format!("{}: {error}", table.display()))?;
    actin_view::draw_trade(trade, &path("trade.svg"))?;
    let best = path("best.ron");
    fs::write(&best, trade.best_scene().to_ron())
        .map_err(|error| format!("{}: {error}", best.display()))
}
