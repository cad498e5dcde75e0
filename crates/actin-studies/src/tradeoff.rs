//! `cargo xtask tradeoff`: errors and run times of `actin trade` for the scenes of `scenarios/trade`.

use actin_sim::Scene;
use actin_sim::trade::{Candidate, Measure, Options as TradeOptions, Trade, TradeCallbacks, trade};
use anyhow::{Context, Error, Result};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

const SCENES: &str = "scenarios/trade";
/// Page of the book, and folder of its figures.
const PAGE: &str = "docs/measured/trade.md";
const PICTURES: &str = "docs/measured/trade";
const WANTED: [f64; 3] = [0.05, 0.02, 0.01];

#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Names of scenes in `scenarios/trade`; all by default.
    names: Vec<String>,
    /// Output folder of tables and figures.
    #[arg(long, default_value = "target/tradeoff")]
    out: PathBuf,
    /// Also writes `docs/measured/trade.md` and its figures.
    #[arg(long)]
    write: bool,
}

pub(crate) fn run(options: &Options) -> Result<()> {
    fs::create_dir_all(&options.out)?;
    let mut summary = String::new();
    let mut tables = String::new();
    for (name, path) in scenes(&options.names)? {
        let text = fs::read_to_string(&path)?;
        let scene = Scene::from_ron(&text).with_context(|| name.clone())?;
        let [first, second] = [traded(&scene)?, traded(&scene)?];
        println!("== {name}\n{first}\n");
        summary += &row(&name, &first, &second);
        writeln!(tables, "\n## {name}\n\n{}\n", comment(&text))?;
        writeln!(
            tables,
            "![error against time](trade/{name}.svg)\n\n```text\n{first}\n```"
        )?;
        fs::write(options.out.join(format!("{name}.csv")), first.to_csv())?;
        let folder = if options.write {
            Path::new(PICTURES)
        } else {
            &options.out
        };
        fs::create_dir_all(folder)?;
        let picture = folder.join(format!("{name}.svg"));
        actin_view::draw_trade(&first, &picture).map_err(Error::msg)?;
    }
    let page = format!("{HEAD}{summary}{tables}");
    let out = if options.write {
        PathBuf::from(PAGE)
    } else {
        options.out.join("trade.md")
    };
    fs::write(&out, page).with_context(|| out.display().to_string())
}

const HEAD: &str = "# What accuracy costs, scene by scene

Written by `cargo xtask tradeoff --write`, which runs `actin trade --error 0.05` twice on each scene of `scenarios/trade`, on one
core. Each error is the largest of all quantities, at the loads of the scene and at half of them, against every monomer.
\"Again\" is the time of the chosen candidate over the time of the fastest one within the same error, both from the second
trade; the largest ratio counts. \"Runs\" is the time of the reference and all candidates over the time of the reference.

| scene | reference | within 5 % | faster | within 2 % | faster | within 1 % | faster | again | runs |
|---|---|---|---|---|---|---|---|---|---|
";

fn scenes(names: &[String]) -> Result<Vec<(String, PathBuf)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(SCENES).context(SCENES)? {
        let path = entry?.path();
        let name = path.file_stem().and_then(|stem| stem.to_str());
        let Some(name) = name.filter(|_| path.extension().is_some_and(|ext| ext == "ron")) else {
            continue;
        };
        if names.is_empty() || names.iter().any(|asked| asked == name) {
            found.push((name.to_owned(), path));
        }
    }
    found.sort();
    Ok(found)
}

/// Runs the trade of a scene. It compares tips (or heights and reactions without a free end), linker forces and energy.
fn traded(scene: &Scene) -> Result<Trade> {
    let assembly = actin_sim::build(scene).map_err(|problem| Error::msg(problem.to_string()))?;
    let has_tip = assembly.clamps.len() < 2 * assembly.filaments.len();
    let mut measures = if has_tip {
        vec![Measure::Tip]
    } else {
        vec![Measure::Height, Measure::EndForce, Measure::EndCouple]
    };
    if !scene.linkers.is_empty() {
        measures.push(Measure::LinkerForce(None));
    }
    measures.push(Measure::Energy);
    let options = TradeOptions {
        measures,
        error: WANTED[0],
        ..TradeOptions::default()
    };
    Ok(trade(scene, &options, &TradeCallbacks::NONE)?)
}

fn best(trade: &Trade, error: f64) -> Option<(usize, &Candidate)> {
    let all = trade.candidates.iter().enumerate();
    let good = all.filter(|(_, c)| c.failure.is_none() && c.worst_error() <= error);
    let least = good.min_by(|(_, a), (_, b)| a.wall_s.total_cmp(&b.wall_s));
    least.filter(|(_, candidate)| candidate.wall_s < trade.reference.wall_s)
}

fn row(name: &str, first: &Trade, second: &Trade) -> String {
    let mut again: f64 = 1.0;
    let cells = WANTED.map(|wanted| match best(first, wanted) {
        None => "the reference | 1".to_owned(),
        Some((i, candidate)) => {
            if let Some((_, cheapest)) = best(second, wanted) {
                again = again.max(second.candidates[i].wall_s / cheapest.wall_s);
            }
            let error = 100.0 * candidate.worst_error();
            let faster = first.usual_s() / candidate.wall_s;
            format!("{} ({error:.2} %) | {faster:.1}", candidate.name)
        }
    });
    format!(
        "| {name} | {:.4} s | {} | {again:.2} | {:.1} |\n",
        first.reference.wall_s,
        cells.join(" | "),
        first.runs_of_reference[0]
    )
}

fn comment(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//"));
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}
