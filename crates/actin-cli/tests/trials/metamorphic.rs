//! Changes of a scene that must not change its result (metamorphic tests).
//!
//! Equilibria are solved to 1e-8 pN. Positions of these short filaments are then accurate to about 1e-7 nm, and
//! energies, which are stationary, to round-off. [`NEAR`] is ten times larger.

use super::kills::same_files;
use super::program;
use super::scenes::{Draft, force};
use super::spoil::{below, between};
use super::{Case, Tally, once};
use actin_mechanics::Vector3;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Tolerance of positions (nm) and energies (pN nm) of equilibria.
const NEAR: f64 = 1e-6;

const PATIENCE: Duration = Duration::from_mins(2);

struct Answer {
    /// Elastic energy of filament 0 (pN nm).
    energy: f64,
    /// Displacement of the tip of filament 0 (nm, lab frame).
    tip: Vector3,
}

/// Draws a relation and a scene, and compares the runs.
pub(super) fn compare(case: &mut Case<'_>) -> Result<Tally, String> {
    type Relation = fn(&mut Case<'_>) -> Result<Tally, String>;
    const RELATIONS: [Relation; 8] = [
        moved,
        accompanied,
        listed,
        halved,
        staged,
        turned_round,
        recorded,
        written,
    ];
    RELATIONS[below(&mut case.random, RELATIONS.len())](case)
}

fn moved(case: &mut Case<'_>) -> Result<Tally, String> {
    let random = &mut case.random;
    let draft = Draft::random(random);
    let mut other = draft.clone();
    other.at = Vector3::from_fn(|_, _| between(random, -200.0, 200.0));
    other.direction = Vector3::from_fn(|_, _| between(random, -1.0, 1.0));
    other.roll = between(random, -180.0, 180.0);
    let turn = other.turn();
    other.forces = draft.forces.iter().map(|force| turn * force).collect();
    let one = answer(case, "one", &draft.text())?;
    let mut two = answer(case, "two", &other.text())?;
    two.tip = turn.inverse() * two.tip;
    agree(&one, &two, NEAR).map(|()| once("moved"))
}

fn accompanied(case: &mut Case<'_>) -> Result<Tally, String> {
    let draft = Draft::random(&mut case.random);
    let mut friend = Draft::random(&mut case.random);
    friend.at = Vector3::new(100.0, 0.0, 0.0);
    let one = answer(case, "one", &draft.text())?;
    let both = draft.text().replace(
        "],\n    clamps: [",
        &format!(
            ", {}],\n    clamps: [Clamp(filament: 1, end: Start), ",
            friend.filament_text()
        ),
    );
    let two = answer(case, "two", &both)?;
    agree(&one, &two, NEAR).map(|()| once("accompanied"))
}

fn listed(case: &mut Case<'_>) -> Result<Tally, String> {
    let mut draft = Draft::random(&mut case.random);
    draft.forces.push(force(&mut case.random));
    let mut other = draft.clone();
    other.forces.reverse();
    other.forces.push(Vector3::zeros());
    both(case, &draft, &other).map(|()| once("listed otherwise"))
}

fn halved(case: &mut Case<'_>) -> Result<Tally, String> {
    let draft = Draft::random(&mut case.random);
    let mut other = draft.clone();
    other.forces = vec![0.5 * draft.forces[0]; 2];
    both(case, &draft, &other).map(|()| once("halved"))
}

/// A load applied at once and along a path of stages, on a rod. Monomers with quadrature bonds have several stable
/// states with energies a thousandth apart, and the path selects one of them.
fn staged(case: &mut Case<'_>) -> Result<Tally, String> {
    let draft = Draft::rod(&mut case.random);
    let mut other = draft.clone();
    let middle = between(&mut case.random, 0.2, 1.5);
    other.rest = format!(
        "path: [Stage(set: [LoadFactor(load: 0, factor: {middle:?})]),
            Stage(set: [LoadFactor(load: 0, factor: 1.0)])],"
    );
    both(case, &draft, &other).map(|()| once("staged"))
}

/// A rod clamped at its other end, rotated by 180 degrees about lab x.
fn turned_round(case: &mut Case<'_>) -> Result<Tally, String> {
    let draft = Draft::rod(&mut case.random);
    let mut other = draft.clone();
    let round = |v: &Vector3| Vector3::new(v.x, -v.y, -v.z);
    other.ends = ["End", "Start"];
    other.forces = draft.forces.iter().map(round).collect();
    let one = answer(case, "one", &draft.text())?;
    // The tip is the end of arc length, which is clamped here.
    let two = answer(case, "two", &other.text())?;
    near("energy", one.energy, two.energy, NEAR).map(|()| once("turned round"))
}

/// A motion recorded half as often. Drag over a whole step equals drag over two half steps except for round-off.
fn recorded(case: &mut Case<'_>) -> Result<Tally, String> {
    let draft = Draft::random(&mut case.random);
    let one = answer(case, "one", &draft.clone().moving(0.01).text())?;
    let two = answer(case, "two", &draft.moving(0.02).text())?;
    agree(&one, &two, 1e-9).map(|()| once("recorded otherwise"))
}

fn written(case: &mut Case<'_>) -> Result<Tally, String> {
    let draft = Draft::random(&mut case.random);
    let draft = match below(&mut case.random, 2) {
        0 => draft,
        _ => draft.moving(0.05),
    };
    answer(case, "one", &draft.text())?;
    let one = case.folder.join("one/out");
    let again = fs::read_to_string(one.join("scene.ron")).map_err(|e| e.to_string())?;
    answer(case, "two", &again)?;
    same_files(&one, &case.folder.join("two/out")).map(|()| once("written and run again"))
}

fn both(case: &Case<'_>, one: &Draft, two: &Draft) -> Result<(), String> {
    let one = answer(case, "one", &one.text())?;
    let two = answer(case, "two", &two.text())?;
    agree(&one, &two, NEAR)
}

fn answer(case: &Case<'_>, name: &str, text: &str) -> Result<Answer, String> {
    let folder: PathBuf = case.folder.join(name);
    fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
    fs::write(folder.join("scene.ron"), text).map_err(|e| e.to_string())?;
    let ending = program::finish(&folder, &["run", "scene.ron", "--out", "out"], PATIENCE)?;
    if ending.code != Some(0) {
        return Err(format!("{name}: {ending:?}"));
    }
    read(&folder.join("out/summary.json"))
        .ok_or_else(|| format!("{name}: summary.json lacks a key"))
}

fn read(path: &Path) -> Option<Answer> {
    let summary: Value = serde_json::from_str(&fs::read_to_string(path).ok()?).ok()?;
    let filament = summary.get("filaments")?.get(0)?;
    let tip = filament.get("tip_displacement_nm")?;
    let component = |i: usize| tip.get(i)?.as_f64();
    Some(Answer {
        energy: filament.get("elastic_pn_nm")?.as_f64()?,
        tip: Vector3::new(component(0)?, component(1)?, component(2)?),
    })
}

fn agree(one: &Answer, two: &Answer, tolerance: f64) -> Result<(), String> {
    near("energy", one.energy, two.energy, tolerance)?;
    near(
        "tip",
        0.0,
        (one.tip - two.tip).norm() / one.tip.norm().max(1.0),
        tolerance,
    )
}

fn near(what: &str, one: f64, two: f64, tolerance: f64) -> Result<(), String> {
    if (one - two).abs() <= tolerance * one.abs().max(1.0) {
        return Ok(());
    }
    Err(format!("{what}: {one:e} against {two:e}"))
}
