//! Corrupted scenes: accepted and run, or refused with a position in the text.

use super::program::{self, Ending};
use super::spoil::{below, other_numbers, spoil};
use super::{Case, Tally, once};
use actin_sim::{Scene, Section};
use std::fs;
use std::path::Path;
use std::time::Duration;

const CHECKING: Duration = Duration::from_mins(1);

const RUNNING: Duration = Duration::from_secs(2);

/// Largest number of bodies of a scene that is run; above every scene of the repository, and below the memory limit.
const MOST_BODIES: f64 = 2e4;

const MOST_BONDS: f64 = 2e6;

pub(super) fn check(case: &mut Case<'_>) -> Result<Tally, String> {
    let text = spoilt(case);
    write(case.folder, &text)?;
    if is_large(&text) {
        return Ok(once("too large to be tried"));
    }
    let ending = program::finish(case.folder, &["check", "scene.ron"], CHECKING)?;
    match ending.code {
        Some(0) => check_written(&text).map(|()| once("accepted")),
        Some(2) => check_place(&ending, &text).map(|()| once("refused with their place")),
        _ => Err(format!("{ending:?}")),
    }
}

fn check_written(text: &[u8]) -> Result<(), String> {
    let read = |text: &str| Scene::from_ron(text).map_err(|e| e.to_string());
    let written = read(&String::from_utf8_lossy(text))?.to_ron();
    if read(&written)?.to_ron() == written {
        return Ok(());
    }
    Err(format!("another scene once written: {written}"))
}

pub(super) fn run(case: &mut Case<'_>) -> Result<Tally, String> {
    let which = below(&mut case.random, case.corpus.len());
    let text = other_numbers(&case.corpus[which], &mut case.random);
    write(case.folder, &text)?;
    if is_large(&text) {
        return Ok(once("too large to be tried"));
    }
    let arguments = ["run", "scene.ron", "--out", "out"];
    let ending = program::finish(case.folder, &arguments, RUNNING)?;
    let out = case.folder.join("out");
    match ending.code {
        Some(0) => check_results(&out).map(|()| once("run to their end")),
        Some(2) => check_place(&ending, &text).map(|()| once("refused with their place")),
        Some(3) => Ok(once("failed by name")),
        _ => Ok(once("interrupted")),
    }
}

fn spoilt(case: &mut Case<'_>) -> Vec<u8> {
    let which = below(&mut case.random, case.corpus.len());
    spoil(&case.corpus[which], case.corpus, &mut case.random)
}

fn write(folder: &Path, text: &[u8]) -> Result<(), String> {
    fs::write(folder.join("scene.ron"), text).map_err(|e| e.to_string())
}

/// Returns whether a scene has too many bodies or bonds to be run here.
fn is_large(text: &[u8]) -> bool {
    let Ok(scene) = Scene::from_ron(&String::from_utf8_lossy(text)) else {
        return false;
    };
    let mut bodies = 0.0;
    let mut bonds = 0.0;
    for filament in scene.filaments() {
        let monomers = &filament.monomers;
        for section in &filament.sections {
            let (from, to) = section.span_nm();
            match section {
                Section::Rod { segments, .. } => {
                    bodies += segments.map_or((to - from) / 10.0, |n| n as f64);
                }
                Section::Ellipsoids { .. } => {
                    let count = (to - from) / monomers.rise_nm;
                    bodies += count;
                    bonds += count * (monomers.lateral_bonds + monomers.longitudinal_bonds) as f64;
                }
            }
        }
    }
    // Invalid counts, and counts beyond all memory, are refused by the program immediately.
    let tried = |count: f64, most: f64| !(count > most && count < 1e15);
    !(tried(bodies, MOST_BODIES) && tried(bonds, MOST_BONDS))
}

fn check_place(ending: &Ending, text: &[u8]) -> Result<(), String> {
    let message = &ending.stderr;
    let place = message.split("scene.ron:").nth(1).unwrap_or_default();
    let mut numbers = place.split(':').map(|word| word.parse::<usize>().ok());
    let (Some(Some(line)), Some(Some(column))) = (numbers.next(), numbers.next()) else {
        return Err(format!("no place in: {message}"));
    };
    let text = String::from_utf8_lossy(text);
    let width = text
        .split('\n')
        .nth(line.wrapping_sub(1))
        .map(|line| line.chars().count());
    match width {
        Some(width) if (1..=width + 1).contains(&column) => Ok(()),
        // After the last line.
        None if line == text.lines().count() + 1 && column == 1 => Ok(()),
        _ => Err(format!("no such place: {message}")),
    }
}

fn check_results(out: &Path) -> Result<(), String> {
    let read = |name: &str| fs::read_to_string(out.join(name)).map_err(|e| format!("{name}: {e}"));
    let summary = read("summary.json")?;
    serde_json::from_str::<serde_json::Value>(&summary)
        .map_err(|e| format!("summary.json: {e}"))?;
    let energies = read("energies.csv")?;
    let numbers = energies.lines().skip(1).flat_map(|line| line.split(','));
    for number in numbers {
        let is_finite = number.parse::<f64>().is_ok_and(f64::is_finite);
        if !is_finite {
            return Err(format!("energies.csv holds {number}"));
        }
    }
    Ok(())
}
