//! Stretch, bending and shear of ensembles: what Table 4 is made from.

use super::ensemble::{Kind, RISES};
use super::statistics::{Sample, sample};
use crate::figures::Run;
use crate::figures::progress::Progress;
use crate::measure::{
    CouplePoint, Curve, Evidence, ShearPoint, Specimen, StretchPoint, TipForcePoint,
    bend_by_couples, bend_by_tip_force, shear_by_force, stretch_by_force, stretch_by_shift,
};
use actin_draw::report::write_csv;
use actin_sim::{Monomers, RodLaw, RodModel};
use rayon::prelude::*;
use std::path::Path;

/// Axial forces (pN).
const FORCES_PN: [f64; 6] = [-10.0, -1.0, 1.0, 10.0, PULL_PN, 500.0];
/// The force at which S3 is compared (pN).
pub(super) const PULL_PN: f64 = 100.0;
/// Held strains.
const STRAINS: [f64; 2] = [-0.001, 0.003];
/// Curvatures (rad/nm); B1 is compared at the last.
pub(super) const CURVATURES: [f64; 4] = [1e-4, 1e-3, 3e-3, 1e-2];
/// Tip forces (pN).
const TIP_PN: [f64; 3] = [0.1, 0.5, 2.0];
/// Tip force (pN) and length (nm) of the cantilever that the paper describes.
pub(super) const CANTILEVER_PN: f64 = 2.0;
const CANTILEVER_NM: f64 = 160.0;
/// Transverse forces on the guided end (pN).
const SHEAR_PN: [f64; 3] = [0.01, 0.1, 1.0];
/// Azimuths of bending and shear (deg).
pub(super) const AZIMUTHS_DEG: [f64; 4] = [0.0, 45.0, 90.0, 135.0];
/// Rises between the inner held monomers of bent filaments: 150.62 nm.
const BENT_RISES: f64 = 55.0;

/// All that was measured.
pub(super) struct Measured {
    pub by_force: Vec<(f64, Sample)>,
    pub by_shift: Vec<(f64, Sample)>,
    pub by_couples: Vec<(f64, Sample)>,
    pub by_tip_force: Vec<(f64, Sample, Sample)>,
    /// Of the paper's cantilever: by the linear formula, and by the elastica.
    pub by_cantilever: [Sample; 2],
    /// Its length, that of the nearest whole number of monomers (nm).
    pub cantilever_nm: f64,
    pub by_shear: Vec<Sheared>,
    /// The smallest shear force on a rod with the rigidities of Table 4.
    pub rod_shear: f64,
    /// Largest relative difference of bending between azimuths of one sampling, at the last
    /// curvature.
    pub anisotropy: f64,
    /// Largest relative difference between the couples at the two ends.
    pub couple_mismatch: f64,
    pub stretch_samplings: usize,
    pub bend_samplings: usize,
    pub bend_length_nm: f64,
    pub states: usize,
    pub unstable: usize,
    pub unreached: usize,
    lines: Vec<Vec<String>>,
}

/// Shear at one force.
pub(super) struct Sheared {
    pub force_pn: f64,
    /// `F L / d`, bending included (pN).
    pub apparent: Sample,
    /// `F / gamma` without bending (pN).
    pub secant: Sample,
    /// `F / gamma^3` without bending (pN).
    pub cubic: Sample,
}

struct Stretched {
    by_force: Curve<StretchPoint>,
    by_shift: Curve<StretchPoint>,
}

struct Bent {
    seed: u64,
    azimuth: f64,
    couples: Curve<CouplePoint>,
    tip: Curve<TipForcePoint>,
    cantilever: Curve<TipForcePoint>,
    shear: Curve<ShearPoint>,
}

impl Measured {
    /// Measures 16 samplings in stretch, 8 in bending and shear; 4 and 2 if `quick`; one if nothing is
    /// drawn.
    pub(super) fn run(
        Run {
            quick, progress, ..
        }: Run<'_>,
        kind: Kind,
    ) -> Result<Self, String> {
        let (stretch_seeds, bend_seeds) = if quick { (4, 2) } else { (16, 8) };
        let seeds: Vec<u64> = kind.seeds(stretch_seeds).collect();
        let cases: Vec<(u64, f64)> = kind
            .seeds(bend_seeds)
            .flat_map(|seed| AZIMUTHS_DEG.map(|azimuth| (seed, azimuth)))
            .collect();
        progress.expect(seeds.len() + cases.len());
        let stretched: Vec<Stretched> = seeds
            .into_par_iter()
            .map(|seed| counted(progress, stretched(kind, seed)))
            .collect::<Result<_, _>>()?;
        let bent: Vec<Bent> = cases
            .into_par_iter()
            .map(|(seed, azimuth)| counted(progress, bent(kind, seed, azimuth)))
            .collect::<Result<_, _>>()?;
        let length = bent[0].couples.length_nm;
        let rod = Specimen::rod(length, None, RodModel::of_law(RodLaw::Constant));
        let rod = shear_by_force(&rod, &SHEAR_PN[..1], 0.0).map_err(|e| e.to_string())?;
        Ok(Self::collect(
            &stretched,
            &bent,
            rod.points[0].apparent_rigidity_pn,
        ))
    }

    fn collect(stretched: &[Stretched], bent: &[Bent], rod_shear: f64) -> Self {
        let evidence: Vec<Evidence> = stretched
            .iter()
            .flat_map(|s| s.by_force.points.iter().chain(&s.by_shift.points))
            .map(|p| p.evidence)
            .chain(bent.iter().flat_map(Bent::evidence))
            .collect();
        let missing = |s: &Stretched| s.by_force.unreached.len() + s.by_shift.unreached.len();
        let last = CURVATURES.len() - 1;
        let by_couples = over(bent, &CURVATURES, |b| &b.couples, |p| p.rigidity_pn_nm2);
        Self {
            by_force: over(stretched, &FORCES_PN, |s| &s.by_force, |p| p.rigidity_pn),
            by_shift: over(stretched, &STRAINS, |s| &s.by_shift, |p| p.rigidity_pn),
            by_shear: sheared(bent, by_couples[0].1.mean),
            by_couples,
            by_tip_force: tip_forces(bent),
            by_cantilever: cantilevers(bent),
            cantilever_nm: bent[0].cantilever.length_nm,
            rod_shear,
            anisotropy: anisotropy(bent, last),
            couple_mismatch: bent.iter().map(Bent::mismatch).fold(0.0, f64::max),
            stretch_samplings: stretched.len(),
            bend_samplings: bent.len() / AZIMUTHS_DEG.len(),
            bend_length_nm: bent[0].couples.length_nm,
            states: evidence.len(),
            unstable: evidence.iter().filter(|e| !e.is_stable()).count(),
            unreached: stretched.iter().map(missing).sum::<usize>()
                + bent.iter().map(Bent::unreached).sum::<usize>(),
            lines: stretched
                .iter()
                .enumerate()
                .flat_map(|(seed, s)| stretch_lines(seed, s))
                .chain(bent.iter().flat_map(Bent::lines))
                .collect(),
        }
    }

    /// Writes every measured state into the file `name`.
    pub(super) fn write(&self, out: &Path, name: &str) -> Result<(), String> {
        let header = [
            "protocol",
            "seed",
            "azimuth_deg",
            "prescribed",
            "secant",
            "residual_pn",
            "negative_eigenvalues",
            "unresolved_eigenvalues",
            "saddles_left",
            "jumps",
        ];
        write_csv(out, name, &header, self.lines.clone())
    }
}

/// What came out of a run, which is done.
fn counted<T>(progress: &Progress, outcome: T) -> T {
    progress.done();
    outcome
}

fn stretched(kind: Kind, seed: u64) -> Result<Stretched, String> {
    let monomers = kind.monomers(seed);
    let specimen = Specimen::ellipsoids(RISES * monomers.rise_nm, monomers);
    Ok(Stretched {
        by_force: stretch_by_force(&specimen, &FORCES_PN).map_err(|e| e.to_string())?,
        by_shift: stretch_by_shift(&specimen, &STRAINS).map_err(|e| e.to_string())?,
    })
}

fn bent(kind: Kind, seed: u64, azimuth: f64) -> Result<Bent, String> {
    let monomers: Monomers = kind.monomers(seed);
    let specimen = Specimen::ellipsoids(BENT_RISES * monomers.rise_nm, monomers);
    let cantilever = Specimen::ellipsoids(CANTILEVER_NM, kind.monomers(seed));
    let fail = |error: crate::measure::MeasureError| error.to_string();
    Ok(Bent {
        seed,
        azimuth,
        couples: bend_by_couples(&specimen, &CURVATURES, azimuth).map_err(fail)?,
        tip: bend_by_tip_force(&specimen, &TIP_PN, azimuth).map_err(fail)?,
        cantilever: bend_by_tip_force(&cantilever, &[CANTILEVER_PN], azimuth).map_err(fail)?,
        shear: shear_by_force(&specimen, &SHEAR_PN, azimuth).map_err(fail)?,
    })
}

impl Bent {
    fn evidence(&self) -> Vec<Evidence> {
        let couples = self.couples.points.iter().map(|p| p.evidence);
        let tip = self.tip.points.iter().chain(&self.cantilever.points);
        let tip = tip.map(|p| p.evidence);
        let shear = self.shear.points.iter().map(|p| p.evidence);
        couples.chain(tip).chain(shear).collect()
    }

    fn unreached(&self) -> usize {
        let tips = self.tip.unreached.len() + self.cantilever.unreached.len();
        self.couples.unreached.len() + tips + self.shear.unreached.len()
    }

    fn mismatch(&self) -> f64 {
        let of = |p: &CouplePoint| (p.couple_pn_nm + p.near_couple_pn_nm) / p.couple_pn_nm;
        self.couples
            .points
            .iter()
            .map(|p| of(p).abs())
            .fold(0.0, f64::max)
    }

    fn lines(&self) -> Vec<Vec<String>> {
        let (seed, azimuth) = (self.seed.to_string(), self.azimuth.to_string());
        let line = |protocol: &str, at: f64, secant: f64, evidence: &Evidence| {
            line(protocol, [&seed, &azimuth], [at, secant], evidence)
        };
        let mut lines = Vec::new();
        for p in &self.couples.points {
            let secant = p.rigidity_pn_nm2;
            lines.push(line("couples", p.curvature_rad_per_nm, secant, &p.evidence));
        }
        for p in &self.tip.points {
            let secant = p.elastica_rigidity_pn_nm2;
            lines.push(line("tip force, elastica", p.force_pn, secant, &p.evidence));
        }
        for p in &self.cantilever.points {
            let secant = p.linear_rigidity_pn_nm2;
            lines.push(line("cantilever, linear", p.force_pn, secant, &p.evidence));
        }
        for p in &self.shear.points {
            lines.push(line(
                "shear",
                p.force_pn,
                p.apparent_rigidity_pn,
                &p.evidence,
            ));
        }
        lines
    }
}

fn stretch_lines(seed: usize, stretched: &Stretched) -> Vec<Vec<String>> {
    let seed = seed.to_string();
    let by_force = stretched.by_force.points.iter();
    let by_force = by_force.map(|p| ("stretch by force", p.force_pn, p));
    let by_shift = stretched.by_shift.points.iter();
    let by_shift = by_shift.map(|p| ("stretch by shift", p.strain, p));
    by_force
        .chain(by_shift)
        .map(|(protocol, at, p)| line(protocol, [&seed, ""], [at, p.rigidity_pn], &p.evidence))
        .collect()
}

fn line(protocol: &str, names: [&str; 2], numbers: [f64; 2], evidence: &Evidence) -> Vec<String> {
    let certificate = &evidence.certificate;
    let mut line = vec![protocol.to_owned()];
    line.extend(names.map(str::to_owned));
    line.extend(numbers.map(|x| format!("{x:.6e}")));
    line.push(format!("{:.1e}", evidence.residual_force_pn));
    line.extend(
        [
            certificate.negative,
            certificate.unresolved,
            evidence.saddles_left,
            evidence.jumps,
        ]
        .map(|n| n.to_string()),
    );
    line
}

/// Samples over filaments, one for each prescribed value, in ascending order.
fn over<S, P>(
    filaments: &[S],
    values: &[f64],
    curve: impl Fn(&S) -> &Curve<P>,
    read: impl Fn(&P) -> f64,
) -> Vec<(f64, Sample)> {
    let complete = |s: &&S| curve(s).points.len() == values.len();
    let at = |i: usize| {
        let chosen = filaments.iter().filter(complete);
        sample(chosen.map(|s| read(&curve(s).points[i])))
    };
    values
        .iter()
        .enumerate()
        .map(|(i, &value)| (value, at(i)))
        .collect()
}

fn tip_forces(bent: &[Bent]) -> Vec<(f64, Sample, Sample)> {
    let linear = over(bent, &TIP_PN, |b| &b.tip, |p| p.linear_rigidity_pn_nm2);
    let elastica = over(bent, &TIP_PN, |b| &b.tip, |p| p.elastica_rigidity_pn_nm2);
    let pairs = linear.into_iter().zip(elastica);
    pairs.map(|((force, l), (_, e))| (force, l, e)).collect()
}

/// The paper's cantilever, by the linear formula and by the elastica.
fn cantilevers(bent: &[Bent]) -> [Sample; 2] {
    let reads: [fn(&TipForcePoint) -> f64; 2] =
        [|p| p.linear_rigidity_pn_nm2, |p| p.elastica_rigidity_pn_nm2];
    reads.map(|read| {
        sample(
            bent.iter()
                .flat_map(|b| b.cantilever.points.iter().map(read)),
        )
    })
}

/// Shear with the bending of a guided beam of rigidity `bending` (pN nm^2) taken off.
fn sheared(bent: &[Bent], bending: f64) -> Vec<Sheared> {
    let length = bent[0].shear.length_nm;
    let samples = |read: &dyn Fn(&ShearPoint) -> f64| over(bent, &SHEAR_PN, |b| &b.shear, read);
    let apparent = samples(&|p| p.apparent_rigidity_pn);
    let secant = samples(&|p| p.rigidity_pn(length, bending));
    let cubic = samples(&|p| p.rigidity_pn(length, bending).powi(3) / p.force_pn.powi(2));
    let all = apparent.into_iter().zip(secant).zip(cubic);
    all.map(
        |(((force_pn, apparent), (_, secant)), (_, cubic))| Sheared {
            force_pn,
            apparent,
            secant,
            cubic,
        },
    )
    .collect()
}

/// Largest difference between two azimuths of a sampling over its mean.
fn anisotropy(bent: &[Bent], curvature: usize) -> f64 {
    bent.chunks(AZIMUTHS_DEG.len())
        .map(|azimuths| {
            let points = azimuths
                .iter()
                .filter_map(|b| b.couples.points.get(curvature));
            let sample = sample(points.map(|p| p.rigidity_pn_nm2));
            (sample.high - sample.low) / sample.mean
        })
        .fold(0.0, f64::max)
}
