//! Films of a run: numbered PNG pictures, rendered in software.
//!
//! The view and colours of the first picture agree with the page. The camera is fixed or rotates about the vertical
//! axis. Each picture shows the time and a scale bar.

use crate::pose::{PLATE_NM, bodies};
use crate::{Attitude, BodyColours, Palette, Run};
use actin_draw::raster::{Camera, Canvas, Picture, TubeStyle};
use actin_draw::scene3d::Matrix3;
use actin_sim::Assembly;
use actin_sim::mechanics::{State, Vector3};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::num::NonZero;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Depth offset of parts that are visible through bodies (nm).
const THROUGH_NM: f64 = 8.0;
/// Scale below which monomers are connected by a line (pixels per nm).
const FAR: f64 = 0.8;
const MARGIN_NM: f64 = 7.0;
/// Height of the strip with scale bar and clock (pixels).
const FOOT: f64 = 44.0;
const LETTERS: f64 = 15.0;
/// Length of the arrow of the strongest force (pixels); others are shorter, down to a third.
const ARROW: f64 = 64.0;
const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [20; 3];

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
        let view = (self.camera(run), strongest(run));
        let work = || {
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                if k >= count {
                    return Ok(());
                }
                let path = folder.join(format!("{:05}.png", k + 1));
                let mut out = BufWriter::new(File::create(path)?);
                self.picture(run, (k, count), view).write_png(&mut out)?;
                out.flush()?;
                told(ready.fetch_add(1, Ordering::Relaxed) + 1);
            }
        };
        let threads = thread::available_parallelism().map_or(1, NonZero::get);
        thread::scope(|scope| {
            let all: Vec<_> = (0..threads.min(count)).map(|_| scope.spawn(work)).collect();
            let ended = all.into_iter().map(thread::ScopedJoinHandle::join);
            ended.into_iter().try_for_each(|one| one.unwrap_or(Ok(())))
        })
    }

    fn camera(&self, run: &Run) -> Camera {
        let [width, height] = self.size.map(|n| n as f64);
        let places: Vec<Vector3> = run
            .states
            .iter()
            .flat_map(|state| state.points.position.iter())
            .collect();
        let Attitude { towards, up } = self.attitude;
        Camera::fitted(
            [towards.into(), up.into()],
            &places,
            MARGIN_NM,
            [width, height, FOOT],
        )
    }

    fn picture(
        &self,
        run: &Run,
        (k, count): (usize, usize),
        (camera, strongest): (Camera, f64),
    ) -> Picture {
        let share = |most: usize| {
            if count < 2 {
                most
            } else {
                (k * most + (count - 1) / 2) / (count - 1)
            }
        };
        let record = share(run.states.len() - 1);
        let angle = self.turn * k as f64 / count as f64;
        let camera = camera.turned(self.attitude.up.into(), angle);
        let mut scene = Scene {
            canvas: Canvas::new(self.size, camera),
            assembly: run.assembly_of(record),
            state: &run.states[record],
            palette: self.palette,
            things: self.palette.body_colours(),
            strongest,
        };
        scene.paint();
        let mut picture = scene.canvas.finish(PAPER);
        self.write_clock(run, record, camera, &mut picture);
        picture
    }

    fn write_clock(&self, run: &Run, record: usize, camera: Camera, picture: &mut Picture) {
        let [width, height] = self.size.map(|n| n as f64);
        let foot = height - 16.0;
        let length = nice_length(0.16 * width / camera.per_nm());
        let bar = length * camera.per_nm();
        let corners = [
            [16.0, foot - 5.0],
            [16.0, foot],
            [16.0 + bar, foot],
            [16.0 + bar, foot - 5.0],
        ];
        picture.stroke(&corners, 2.0, INK);
        let text = if length >= 1000.0 {
            format!("{} µm", length / 1000.0)
        } else {
            format!("{length} nm")
        };
        picture.text([16.0, foot - 11.0], LETTERS, INK, &text);
        if let Some(clock) = run.clock(record) {
            picture.text(
                [width - 0.75 * LETTERS * clock.len() as f64 - 30.0, foot],
                LETTERS,
                INK,
                &clock,
            );
        }
    }
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

struct Scene<'a> {
    canvas: Canvas,
    assembly: &'a Assembly,
    state: &'a State,
    palette: Palette,
    things: &'a BodyColours,
    /// Largest force of all records (pN).
    strongest: f64,
}

impl Scene<'_> {
    fn paint(&mut self) {
        for section in 0..self.assembly.sections.len() {
            if self.assembly.sections[section].is_ellipsoids() {
                self.monomers(section);
            } else {
                self.rod(section);
            }
        }
        let (assembly, state) = (self.assembly, self.state);
        for bond in assembly.junction_bonds() {
            let ends = bodies::ends_of(&bond, state);
            self.canvas
                .line(&ends, (0.45, 2.0), self.things.junction, THROUGH_NM);
        }
        for i in 0..assembly.linkers.len() {
            let (ends, holds) = assembly.linker_ends(i, state);
            if holds {
                self.canvas
                    .line(&ends, (0.4, 2.0), self.things.linker, THROUGH_NM);
            }
            if assembly.linked_to(i).is_none() {
                self.canvas
                    .ball(ends[1], 1.3, self.things.anchor, THROUGH_NM);
            }
        }
        for [a, b, c, d] in bodies::plates(assembly, state, PLATE_NM) {
            self.canvas
                .line(&[a, b, c, d, a], (0.5, 1.6), self.things.clamp, 0.0);
        }
        for (at, force) in bodies::forces(assembly, state) {
            self.arrow(at, force);
        }
    }

    fn monomers(&mut self, section: usize) {
        let span = &self.assembly.sections[section];
        let filament = self.assembly.filament_of_section(section);
        let lengths = Vector3::from(self.assembly.monomers_of(filament).semi_axes_nm);
        let colour = self.palette.ramp().at(0.0);
        let both = [colour, colour.lighter(0.28)];
        for (k, (point, frame)) in span.points.clone().zip(span.frames.clone()).enumerate() {
            let axes = self.axes(frame) * Matrix3::from_diagonal(&lengths);
            let centre = self.state.points.position.get(point);
            self.canvas.ellipsoid(centre, axes, both[k % 2].0, 0.0);
        }
        if self.canvas.per_nm() < FAR {
            let place = |i: usize| self.state.points.position.get(i);
            let pairs = span.points.clone().zip(span.points.clone().skip(1));
            let line: Vec<Vector3> = pairs.map(|(a, b)| 0.5 * (place(a) + place(b))).collect();
            self.canvas.line(&line, (1.5, 2.6), colour.0, 0.0);
        }
    }

    fn rod(&mut self, section: usize) {
        let span = &self.assembly.sections[section];
        let nodes = span
            .points
            .clone()
            .map(|i| self.state.points.position.get(i));
        let frames = span.frames.clone().map(|i| self.axes(i));
        let (nodes, frames): (Vec<_>, Vec<_>) = (nodes.collect(), frames.collect());
        let look = TubeStyle {
            colour: self.palette.ramp().at(1.0).lighter(0.12).0,
            stripe: 0.7,
            seam: 0.55,
        };
        let least = 1.2 / self.canvas.per_nm();
        self.canvas
            .tube(&nodes, &frames, bodies::rod_radius_nm().max(least), look);
    }

    fn axes(&self, frame: usize) -> Matrix3 {
        let turn = self.state.frames.orientation.get(frame);
        turn.to_rotation_matrix().into_inner()
    }

    fn arrow(&mut self, at: Vector3, force: Vector3) {
        let per_nm = self.canvas.per_nm();
        let along = force.normalize();
        let share = (force.norm() / self.strongest).max(1.0 / 3.0);
        let tip = at + along * (share * ARROW / per_nm);
        let aside = self.canvas.towards_viewer().cross(&along);
        let aside = aside.try_normalize(1e-6).unwrap_or_default();
        let head = |side: f64| tip - (along * 11.0 - aside * (side * 6.0)) / per_nm;
        let width = (0.0, 3.0);
        self.canvas
            .line(&[at, tip], width, self.things.force, 4.0 * THROUGH_NM);
        let head = [head(1.0), tip, head(-1.0)];
        self.canvas
            .line(&head, width, self.things.force, 4.0 * THROUGH_NM);
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
