//! What segments of rods do to a number: of one length, and graded.

use super::cases::Case;
use super::solved;
use actin_sim::adapt::finer;
use actin_sim::{RodLaw, Scene, Section};

/// Length of segments to begin with (nm).
const FIRST_NM: f64 = 20.0;
/// How often they are halved.
const ROUNDS: u32 = 3;
/// Segments of the rod that others are compared with, over those of the first.
const FINEST: usize = 32;

type Fallible<T> = Result<T, Box<dyn std::error::Error>>;

/// Rows of one case: how many segments leave how much, halved evenly and where it counts.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at least 1, and the conversion saturates"
)]
pub(super) fn rows(case: &Case) -> Fallible<Vec<String>> {
    let first = (case.length_nm() / FIRST_NM).round().max(1.0) as usize;
    let truth = value(case, &even(case, first * FINEST))?;
    let mut rows = Vec::new();
    for round in 0..=ROUNDS {
        let scene = even(case, first << round);
        rows.push(row(case, "one length", &scene, truth)?);
    }
    let mut scene = even(case, first);
    for _ in 0..ROUNDS {
        scene = finer(&scene, case.quantity)?;
        let sections = scene.filament.sections.len();
        let name = match sections {
            1 => "graded: one length".to_owned(),
            n => format!("graded: {n} stretches"),
        };
        rows.push(row(case, &name, &scene, truth)?);
    }
    Ok(rows)
}

fn row(case: &Case, name: &str, scene: &Scene, truth: f64) -> Fallible<String> {
    let own = value(case, scene)?;
    let halved = value(case, &with_segments(scene, |segments| 2 * segments))?;
    // Of an error of second order a quarter is left.
    let estimated = (halved - own) / 0.75;
    let percent = |part: f64| 100.0 * part / truth;
    Ok(format!(
        "| {} | {name} | {} | {:.3} | {:.3} |",
        case.name,
        counted(scene),
        percent(truth - own),
        percent(estimated),
    ))
}

fn value(case: &Case, scene: &Scene) -> Fallible<f64> {
    Ok(case.value(&solved(scene)?))
}

/// The filament as one rod of so many segments.
fn even(case: &Case, segments: usize) -> Scene {
    let mut scene = case.scene.clone();
    scene.filament.sections = vec![Section::rod(0.0, case.length_nm(), Some(segments))].into();
    scene.filament.rod.law = RodLaw::Homogenised;
    scene
}

fn with_segments(scene: &Scene, of: impl Fn(usize) -> usize) -> Scene {
    let mut scene = scene.clone();
    for section in scene.filament.sections.iter_mut() {
        if let Section::Rod { segments, .. } = section {
            *segments = segments.map(&of);
        }
    }
    scene
}

fn counted(scene: &Scene) -> usize {
    let sections = scene.filament.sections.iter();
    let of = |section: &Section| match section {
        Section::Rod { segments, .. } => segments.unwrap_or(0),
        Section::Ellipsoids { .. } => 0,
    };
    sections.map(of).sum()
}
