//! Down to which wavelength a rod does what monomers do, about states with prestrain.
//!
//! A long filament between walls is pulled or turned, and then loaded by a wave: a force or couple at every monomer,
//! `f cos(k (s - s_0) + phase)` under a Gaussian whose standard deviation is a wavelength, so that the ends feel
//! nothing. How far it gives way, the work of the wave over `f^2`, follows from three equilibria, with the wave, without and
//! with the opposite one: what they store and what their loads have done differ by minus that work. Rods bear the same
//! loads at the same places.

use super::checks::statistics;
use super::rows;
use crate::Tell;
use crate::run::{clamp, run_to_end};
use actin_cosserat::Homogenised;
use actin_sim::ellipsoid::EllipsoidParameters;
use actin_sim::{
    Assembly, Couple, End, Equilibrium, Factor, Filament, Force, Load, Monomers, Output, Pace,
    RodLaw, RodModel, Scene, Section, Setting, Slides, Stage, Task,
};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

/// Rows of before a change of what is computed are not read.
const VERSION: u32 = 1;
/// Wavelengths (monomers).
const WAVELENGTHS: [f64; 8] = [2.0, 3.0, 4.0, 6.0, 10.0, 18.0, 32.0, 60.0];
/// The same where it has to be quick.
const FEW: [f64; 3] = [3.0, 10.0, 32.0];
/// Wavelengths from the middle to either wall, and the least length there (monomers).
const BEYOND: (f64, f64) = (4.5, 40.0);
/// Share of the largest load below which a monomer has none.
const LEAST: f64 = 1e-2;
/// Phases of the wave (deg); across the axis in each of two directions.
const PHASES_DEG: [f64; 2] = [45.0, 135.0];
/// Strain, twist (rad/nm) and slope that a wave is to make, about.
const SLIGHT: [f64; 3] = [2e-5, 2e-4, 5e-4];
/// Rigidities by which loads are chosen: stretch, shear (pN), bending, twist (pN nm^2).
const ABOUT: [f64; 4] = [3e4, 3e2, 3.5e4, 5e3];
/// Segments of rods: those of a scene that leaves them out, and so short that they do not matter (monomers).
const SEGMENTS: [f64; 2] = [10.0 / RISE_NM, 0.5];
/// Rise per monomer (nm).
const RISE_NM: f64 = 71.2 / 26.0;

/// What a filament is under before a wave comes.
#[derive(Clone, Copy, Debug)]
struct Prestrain {
    name: &'static str,
    tension_pn: f64,
    twist_per_nm: f64,
}

/// All under tension: what is not gives way to compression by bending aside at once, however slight a wave is.
const STATES: [Prestrain; 4] = [
    prestrain("pulled by 2 pN", 2.0, 0.0),
    prestrain("pulled by 10 pN", 10.0, 0.0),
    prestrain("10 pN, over-twisted by 0.02 rad/nm", 10.0, 0.02),
    prestrain("10 pN, under-twisted by 0.02 rad/nm", 10.0, -0.02),
];

const fn prestrain(name: &'static str, tension_pn: f64, twist_per_nm: f64) -> Prestrain {
    Prestrain {
        name,
        tension_pn,
        twist_per_nm,
    }
}

/// What a wave does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Along,
    About,
    Across,
}

impl Kind {
    const ALL: [Self; 3] = [Self::Along, Self::About, Self::Across];

    fn name(self) -> &'static str {
        match self {
            Self::Along => "force along",
            Self::About => "couple about",
            Self::Across => "force across",
        }
    }

    /// Load on a monomer (pN, pN nm) that makes about the slight strain at a wave number (1/nm).
    fn amplitude(self, k: f64) -> f64 {
        let [stretch, shear, bend, twist] = ABOUT;
        let [strain, turn, slope] = SLIGHT;
        let stress = match self {
            Self::Along => stretch * strain,
            Self::About => twist * turn,
            Self::Across => slope / (1.0 / shear + 1.0 / (bend * k * k)),
        };
        stress * k * RISE_NM
    }
}

/// A wave on a filament in a state.
#[derive(Clone, Copy, Debug)]
struct Wave {
    state: Prestrain,
    kind: Kind,
    /// Wavelength (monomers).
    monomers: f64,
    phase_deg: f64,
    /// Azimuth of a force across (deg).
    azimuth_deg: f64,
}

impl Wave {
    /// Monomers from the start to the middle.
    fn half(&self) -> u32 {
        let (wavelengths, least) = BEYOND;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "some hundred"
        )]
        let half = (wavelengths * self.monomers).max(least).ceil() as u32;
        half
    }

    fn length_nm(&self) -> f64 {
        2.0 * f64::from(self.half()) * RISE_NM
    }

    fn wave_number(&self) -> f64 {
        TAU / (self.monomers * RISE_NM)
    }

    /// Loads at all monomers, `sign` times the wave.
    fn at_monomers(&self, sign: f64) -> Vec<(f64, f64)> {
        let half = self.half();
        let amplitude = sign * self.kind.amplitude(self.wave_number());
        let places = (1..2 * half).map(|i| {
            let from_middle = f64::from(i) - f64::from(half);
            let waves = from_middle / self.monomers;
            let load = (TAU * waves + self.phase_deg.to_radians()).cos();
            let share = (-0.5 * waves * waves).exp();
            (f64::from(i) * RISE_NM, amplitude * load * share)
        });
        places
            .filter(|(_, load)| load.abs() > LEAST * amplitude.abs())
            .collect()
    }

    fn load(&self, (s_nm, size): (f64, f64)) -> Load {
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        let force = |force_pn| {
            Load::Force(Force {
                filament: 0,
                end: None,
                at_nm: Some(s_nm),
                force_pn,
                follows: false,
                factor: Factor::Constant,
            })
        };
        match self.kind {
            Kind::Along => force([0.0, 0.0, size]),
            Kind::Across => force([size * cos, size * sin, 0.0]),
            Kind::About => Load::Couple(Couple {
                filament: 0,
                end: None,
                at_nm: Some(s_nm),
                couple_pn_nm: [0.0, 0.0, size],
                follows: false,
                factor: Factor::Constant,
            }),
        }
    }

    /// The filament under `sign` times the wave.
    fn scene(&self, filament: Filament, sign: f64) -> Scene {
        let state = self.state;
        let pull = Load::EndForce {
            filament: 0,
            end: End::End,
            force_pn: [0.0, 0.0, state.tension_pn],
        };
        let waves = self.at_monomers(sign).into_iter().map(|at| self.load(at));
        let turn_deg = (state.twist_per_nm * self.length_nm()).to_degrees();
        let turned = Stage {
            set: vec![Setting::Turn {
                filament: 0,
                end: End::End,
                turn_deg: [0.0, 0.0, turn_deg],
            }],
            duration_ns: None,
            pace: Pace::Smooth,
        };
        Scene {
            title: "Wave".to_owned(),
            filament,
            further: Vec::new(),
            clamps: vec![
                clamp(End::Start, Slides::Nowhere),
                clamp(End::End, Slides::AlongAxis),
            ],
            loads: std::iter::once(pull).chain(waves).collect(),
            linkers: Vec::new(),
            repulsion: None,
            path: (turn_deg != 0.0).then_some(turned).into_iter().collect(),
            observe: Vec::new(),
            burn_in_ns: None,
            output: Output::default(),
            task: Task::Equilibrium(Equilibrium {
                force_pn: 1e-9,
                torque_pn_nm: 1e-9,
                iterations: 1000,
                largest_step: if state.twist_per_nm == 0.0 { 1.0 } else { 0.5 },
                ..Equilibrium::default()
            }),
        }
    }

    /// How far a filament gives way: work over the square of the loads (nm/pN, or rad/(pN nm)).
    fn compliance(&self, filament: &Filament) -> Result<f64, String> {
        let potential = |sign: f64| {
            let scene = self.scene(filament.clone(), sign);
            let solved = Assembly::build(&scene)
                .map_err(|e| e.to_string())
                .and_then(|mut assembly| run_to_end(&mut assembly).map_err(|e| e.to_string()));
            let (trajectory, _) = solved.map_err(|e| format!("{self:?}: {e}"))?;
            let last = trajectory.records.last().ok_or("no record")?;
            Ok::<f64, String>(last.potential_pn_nm())
        };
        let work = 2.0 * potential(0.0)? - potential(1.0)? - potential(-1.0)?;
        let loads = self.at_monomers(1.0).into_iter();
        Ok(work / loads.map(|(_, load)| load * load).sum::<f64>())
    }

    /// That of the mean filament, then errors of rods of each length of segments.
    fn compare(&self) -> Result<Vec<f64>, String> {
        let monomers = Section::Ellipsoids {
            from_nm: 0.0,
            to_nm: self.length_nm(),
            altered: None,
        };
        let monomers = Filament {
            monomers: Monomers::default(),
            ..Filament::new(vec![monomers])
        };
        let true_one = self.compliance(&monomers)?;
        let mut found = vec![true_one];
        for segment in SEGMENTS {
            let rod = Filament {
                rod: RodModel::of_law(RodLaw::Homogenised),
                ..Filament::new(vec![self.rod(segment)])
            };
            found.push(self.compliance(&rod)? / true_one - 1.0);
        }
        Ok(found)
    }

    fn rod(&self, segment: f64) -> Section {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "some thousand at most"
        )]
        let segments = (2.0 * f64::from(self.half()) / segment).round() as usize;
        Section::rod(0.0, self.length_nm(), Some(segments))
    }
}

/// One row: a state, a kind and a wavelength, over phases and azimuths.
struct Row {
    waves: Vec<Wave>,
}

impl Row {
    fn new(state: Prestrain, kind: Kind, monomers: f64) -> Self {
        let azimuths_deg: &[f64] = match kind {
            Kind::Across => &[0.0, 90.0],
            Kind::Along | Kind::About => &[0.0],
        };
        let wave = |phase_deg: f64, azimuth_deg: f64| Wave {
            state,
            kind,
            monomers,
            phase_deg,
            azimuth_deg,
        };
        let waves = PHASES_DEG.iter().flat_map(|&phase| {
            let of_phase = azimuths_deg.iter();
            of_phase.map(move |&azimuth| wave(phase, azimuth))
        });
        Self {
            waves: waves.collect(),
        }
    }

    /// For each wave how far monomers give way, and the errors of rods; read where a file has them.
    fn found(&self, folder: &Path) -> Result<Vec<Vec<f64>>, String> {
        let first = &self.waves[0];
        let name = format!(
            "{} {} {}.csv",
            first.state.name,
            first.kind.name(),
            first.monomers
        );
        let path = folder.join(name.replace(['/', ' ', ','], "-"));
        let (parameters, law) = (EllipsoidParameters::default(), Homogenised::mean_filament());
        let key = format!(
            "version {VERSION}, {parameters:?}, {law:?}, {:?}, {SEGMENTS:?} {SLIGHT:?} {ABOUT:?} {BEYOND:?} {LEAST:?}",
            self.waves
        );
        if let Some(rows) = rows::read_numbers(&path, &key) {
            return Ok(rows);
        }
        let found = self.waves.iter().map(Wave::compare);
        let found = found.collect::<Result<Vec<_>, _>>()?;
        let header = ["monomers", "error_10_nm", "error_1.4_nm"].map(str::to_owned);
        rows::write_numbers(&path, &key, &header, found.iter().cloned())?;
        Ok(found)
    }

    fn cells(&self, folder: &Path) -> Result<String, String> {
        let found = self.found(folder)?;
        let first = &self.waves[0];
        let (mean, deviation) = statistics(&found.iter().map(|one| one[0]).collect::<Vec<_>>());
        let mut row = format!(
            "| {} | {} | {} | {:.0} nm | {mean:.3e} ± {:.1} % |",
            first.state.name,
            first.kind.name(),
            first.monomers,
            first.monomers * RISE_NM,
            100.0 * deviation / mean,
        );
        for k in 0..SEGMENTS.len() {
            let errors: Vec<f64> = found.iter().map(|one| one[k + 1]).collect();
            let _ = write!(row, " {:+.1} % |", 100.0 * statistics(&errors).0);
        }
        Ok(row + "\n")
    }
}

/// Prints and writes the table. Rows that are there, computed with the same parameters and law, are kept.
pub(super) fn run(out: &Path, quick: bool, tell: Tell<'_>) -> Result<(), String> {
    let wavelengths: &[f64] = if quick { &FEW } else { &WAVELENGTHS };
    let rows: Vec<Row> = STATES
        .into_iter()
        .flat_map(|state| Kind::ALL.map(|kind| (state, kind)))
        .flat_map(|(state, kind)| wavelengths.iter().map(move |&n| Row::new(state, kind, n)))
        .collect();
    let mut table = String::from(
        "| state | wave | monomers | wavelength | monomers give way (nm/pN, rad/(pN nm)) | rod of 10 nm segments | of 1.4 nm |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: |\n",
    );
    let folder = out.join("waves");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let rows = rows.par_iter().map(|row| {
        let cells = row.cells(&folder);
        let (Ok(told) | Err(told)) = &cells;
        tell(format_args!("{}", told.trim_end()));
        cells
    });
    let rows: Vec<Result<String, String>> = rows.collect();
    table.extend(rows.iter().flatten().map(String::as_str));
    let path = out.join("waves.md");
    std::fs::write(&path, &table).map_err(|e| format!("{}: {e}", path.display()))?;
    // What was found is kept where a wave has no equilibrium.
    rows.into_iter().find_map(Result::err).map_or(Ok(()), Err)
}
