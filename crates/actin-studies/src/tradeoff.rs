//! `cargo xtask tradeoff`: what accuracy costs in the scenes of `scenarios/trade`, as `actin trade` tells it.

use actin_sim::trade::{Candidate, Measure, Options as Asked, Trade, Watch, trade};
use actin_sim::{Assembly, Scene};
use anyhow::{Context, Error, Result};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// Where the scenes are.
const SCENES: &str = "scenarios/trade";
/// The page of the book, and the folder of its pictures.
const PAGE: &str = "docs/measured/trade.md";
const PICTURES: &str = "docs/measured/trade";
/// Wanted errors, the largest first.
const WANTED: [f64; 3] = [0.05, 0.02, 0.01];

/// What is traded, and where it goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Names of scenes in `scenarios/trade`; all by default.
    names: Vec<String>,
    /// Where tables and pictures are written.
    #[arg(long, default_value = "target/tradeoff")]
    out: PathBuf,
    /// Also `docs/measured/trade.md`.
    #[arg(long)]
    write: bool,
}

/// Trades, prints and writes.
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
core. Errors are against every monomer, of the worst quantity, at the loads of the scene and at half of them. \"Again\" is
the time of the choice over that of the cheapest that meets the same error when all are timed again; \"runs\" is the time of
the reference with all candidates over that of the reference.

| scene | reference | within 5 % | faster | within 2 % | faster | within 1 % | faster | again | runs |
|---|---|---|---|---|---|---|---|---|---|
";

/// Names and files of the scenes that are asked for, in order.
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

/// What a scene has: tips, or heights and what the ends bear where none is free; forces of linkers; the energy.
fn traded(scene: &Scene) -> Result<Trade> {
    let assembly = Assembly::build(scene).map_err(|problem| Error::msg(problem.to_string()))?;
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
    let asked = Asked {
        measures,
        error: WANTED[0],
        ..Asked::default()
    };
    Ok(trade(scene, &asked, &Watch::NOBODY)?)
}

/// The cheapest candidate within an error.
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

/// What a scene says of itself at its top.
fn comment(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//"));
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}
