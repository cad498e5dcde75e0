//! Films of a run: numbered PNG pictures.
//!
//! The view and colours of the first picture agree with the page. The camera is fixed or rotates about the vertical
//! axis. Each picture shows the time and a scale bar.

use crate::pose::PLATE_NM;
use crate::{Attitude, Drawing, Palette, Run, bodies, outlines};
use actin_draw::png;
use actin_draw::scene3d::{Camera, Panel, Sheet};
use actin_sim::mechanics::Vector3;
use std::fs;
use std::io;
use std::num::NonZero;
use std::panic::resume_unwind;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Distance of the edges of the picture from points (nm).
const MARGIN_NM: f64 = 7.0;
/// Length of the arrow of the strongest force (pixels); others are shorter, down to a third.
const ARROW: f64 = 64.0;
/// Height of the axes above the scale bar (pixels).
const AXES: f64 = 18.0;
/// Smallest radius of bodies (pixels).
const LEAST: f64 = 1.2;

/// Settings of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Width and height of pictures (pixels).
    pub size: [usize; 2],
    /// Number of pictures; by default the number of loaded records.
    pub pictures: Option<usize>,
    /// Total rotation of the camera about the vertical axis of the picture (rad).
    pub turn: f64,
    /// Initial view direction.
    pub attitude: Attitude,
    /// Colours.
    pub palette: Palette,
}

impl Default for Film {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            pictures: None,
            turn: 0.0,
            attitude: Attitude::HORIZONTAL,
            palette: Palette::default(),
        }
    }
}

impl Film {
    /// Returns the number of pictures for a run.
    pub fn count(&self, run: &Run) -> usize {
        self.pictures.unwrap_or(run.states.len())
    }

    /// Writes the pictures `00001.png`, `00002.png`, ... to a folder. Calls `told` with the number of finished
    /// pictures.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, run: &Run, folder: &Path, told: &(dyn Fn(usize) + Sync)) -> io::Result<()> {
        fs::create_dir_all(folder)?;
        let (count, next, ready) = (self.count(run), AtomicUsize::new(0), AtomicUsize::new(0));
        let strongest = strongest(run);
        let camera = self.camera(run, strongest > 0.0);
        let work = || {
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                if k >= count {
                    return Ok(());
                }
                let angle = self.turn * k as f64 / count as f64;
                let camera = camera.turned(self.attitude.up.into(), angle);
                let record = evenly(k, count, run.states.len());
                let picture = png(&self.svg(run, record, camera, strongest), 1.0);
                let path = folder.join(format!("{:05}.png", k + 1));
                fs::write(path, picture.map_err(io::Error::other)?)?;
                told(ready.fetch_add(1, Ordering::Relaxed) + 1);
            }
        };
        let threads = thread::available_parallelism().map_or(1, NonZero::get);
        thread::scope(|scope| {
            let all: Vec<_> = (0..threads.min(count)).map(|_| scope.spawn(work)).collect();
            let ended = all.into_iter().map(thread::ScopedJoinHandle::join);
            ended
                .into_iter()
                .try_for_each(|one| one.unwrap_or_else(|panic| resume_unwind(panic)))
        })
    }

    fn place(&self) -> [f64; 4] {
        let [width, height] = self.size.map(|n| n as f64);
        [0.0, 0.0, width, height]
    }

    fn camera(&self, run: &Run, has_arrows: bool) -> Camera {
        let states = run.states.iter();
        let balls = states.flat_map(|state| {
            let places = state.points.position.iter();
            let corners = outlines::periodic_box(&run.assembly, state);
            let places = places.chain(corners).map(|place| (place, MARGIN_NM));
            places.chain(run.assembly.beads_in(state))
        });
        let walls = outlines::walls(&run.assembly).into_iter().flatten();
        let balls = balls.chain(walls.map(|place| (place, MARGIN_NM)));
        let margin = if has_arrows { 0.5 * ARROW } else { 0.0 };
        let margins = [margin, margin, margin, margin.max(AXES)];
        Camera::fitted(self.attitude, balls, Panel::area(self.place(), margins))
    }

    /// Returns the picture of a record; `strongest` is the largest force of all records (pN).
    fn svg(&self, run: &Run, record: usize, camera: Camera, strongest: f64) -> String {
        let per_nm = camera.per_nm();
        let drawing = Drawing {
            least_nm: LEAST / per_nm,
            ..Drawing::new(run.assembly_of(record), &run.states[record], self.palette)
        };
        let arrow = |force: Vector3| {
            let share = (force.norm() / strongest).max(1.0 / 3.0);
            force.normalize() * (share * ARROW / per_nm)
        };
        let [_, _, width, height] = self.place();
        let panel = Panel {
            title: run.clock(record).unwrap_or_default(),
            place: self.place(),
            camera,
            items: [
                drawing.outlines(1.0),
                drawing.monomers(1.0),
                drawing.rods(1.0),
                drawing.junction_bonds((0.9 * per_nm).max(2.0)),
                drawing.linkers((0.8 * per_nm).max(2.0), (1.3 * per_nm).max(2.5), false),
                drawing.beads(),
                drawing.clamps(PLATE_NM),
                drawing.forces(3.0, arrow),
            ]
            .concat(),
            labels: Vec::new(),
            bar_nm: nice_length(0.16 * width / per_nm),
        };
        let sheet = Sheet {
            prefix: "film",
            width,
            height,
            panels: vec![panel],
            legend: Vec::new(),
        };
        sheet.svg()
    }
}

/// Returns the index below `many` at place `k` of `count` evenly spaced ones.
fn evenly(k: usize, count: usize, many: usize) -> usize {
    if count < 2 {
        return many - 1;
    }
    (k * (many - 1) + (count - 1) / 2) / (count - 1)
}

impl Run {
    /// Formats the time or path parameter of a record, with equal decimals for all records. `None` for a single
    /// record.
    fn clock(&self, record: usize) -> Option<String> {
        let (first, last): (f64, f64) = (self.at.first()?.value(), self.at.last()?.value());
        let span = last - first;
        if span <= 0.0 {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 6"
        )]
        let decimals = (2.0 - span.log10().floor()).clamp(0.0, 6.0) as usize;
        let at = self.at[record];
        let value = at.value();
        Some(match at.time_ns() {
            Some(_) => format!("{value:.decimals$} ns"),
            None => format!("path {value:.decimals$}"),
        })
    }
}

/// Returns the largest force of all records (pN).
fn strongest(run: &Run) -> f64 {
    let records = run.states.iter().enumerate();
    let forces = records.flat_map(|(k, state)| bodies::forces(run.assembly_of(k), state));
    forces.map(|(_, force)| force.norm()).fold(0.0, f64::max)
}

/// Returns the largest of 1, 2, 5, 10, ... up to `most`.
fn nice_length(most: f64) -> f64 {
    let power = 10_f64.powf(most.log10().floor());
    let digit = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|digit| digit * power <= most);
    power * digit.unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::nice_length;

    #[test]
    fn bars_have_nice_lengths() {
        for (most, nice) in [
            (0.7, 0.5),
            (1.0, 1.0),
            (3.9, 2.0),
            (19.0, 10.0),
            (5000.0, 5000.0),
        ] {
            assert!((nice_length(most) / nice - 1.0_f64).abs() < 1e-12, "{most}");
        }
    }
}
