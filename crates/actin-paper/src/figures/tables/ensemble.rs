//! Twisted filaments with many bond samplings for Tables 3 and 5.

use crate::figures::draft::Draft;
use crate::measure::{Specimen, Stability, TwistPoint, twist};
use crate::published::{Entry, Table, entries};
use crate::statistics::{SampleStatistics, sample};
use actin_sim::{Anchors, Monomers, ellipsoid_constants as monomer};
use std::sync::OnceLock;

/// Rises between the inner clamped monomers: 30 monomers, two clamped at each end, 73.94 nm.
pub(super) const RISES: f64 = 27.0;
/// Compared numbers of bonds per interface; the default is 64.
const BONDS: [usize; 6] = [12, 20, 40, 64, 80, 160];
/// Additional numbers of independent bonds, near those that may agree with both tables.
const BONDS_BETWEEN: [usize; 2] = [28, 32];
const SEEDS: u64 = 16;
const QUICK_SEEDS: u64 = 4;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind {
    pub anchors: Anchors,
    pub bonds: usize,
}

impl Kind {
    /// Quadrature bonds, the default of scenes.
    pub(super) const MEAN: Self = Self {
        anchors: Anchors::Cubature,
        bonds: monomer::POINTS_PER_INTERFACE,
    };
    /// 64 bonds, sampled for each interface.
    pub(super) const DEFAULT: Self = Self {
        anchors: Anchors::Independent,
        bonds: 64,
    };

    pub(super) const CORE: [Self; 2] = [Self::DEFAULT, Self::MEAN];

    pub(super) fn name(&self) -> String {
        match self.anchors {
            Anchors::Cubature => "mean-filament".to_owned(),
            Anchors::Independent => format!("independent-{}", self.bonds),
            Anchors::Identical => format!("identical-{}", self.bonds),
        }
    }

    /// Seeds of the samplings, at most `most`; one for quadrature bonds.
    pub(super) fn seeds(&self, most: u64) -> std::ops::Range<u64> {
        0..if self.anchors == Anchors::Cubature {
            1
        } else {
            most
        }
    }

    /// Filament with this number of rises between the inner clamped monomers.
    pub(super) fn specimen(&self, rises: f64, seed: u64) -> Specimen {
        let monomers = self.monomers(seed);
        Specimen::ellipsoids(rises * monomers.rise_nm, monomers)
    }

    pub(super) fn monomers(&self, seed: u64) -> Monomers {
        Monomers {
            seed,
            anchors: self.anchors,
            lateral_bonds: self.bonds,
            longitudinal_bonds: self.bonds,
            ..Monomers::default()
        }
    }
}

/// Kind and seed of a filament, and one of its points.
pub(super) type Sampled = (Kind, u64, TwistPoint);

#[derive(Clone, Debug)]
pub(super) struct Ensemble {
    points: Vec<Sampled>,
    /// Angles without an equilibrium.
    pub unreached: Vec<String>,
    pub seeds: u64,
}

/// Numbers of equilibria without certified stability or on another branch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StabilityCounts {
    pub states: usize,
    pub saddles: usize,
    pub neutral: usize,
    /// States whose path left a saddle or jumped between branches.
    pub off_the_branch: usize,
}

static CORE: OnceLock<Result<Ensemble, String>> = OnceLock::new();
static ENSEMBLE: OnceLock<Result<Ensemble, String>> = OnceLock::new();

/// Samplings of the default kind, and the mean filament. Computed once per process.
pub(super) fn core(draft: &Draft<'_>) -> Result<&'static Ensemble, String> {
    CORE.get_or_init(|| Ensemble::run(draft, Kind::CORE.into()))
        .as_ref()
        .map_err(Clone::clone)
}

/// Samplings of all kinds, without `--quick`. Computed once per process.
pub(super) fn ensemble(draft: &Draft<'_>) -> Result<&'static Ensemble, String> {
    if draft.quick {
        return core(draft);
    }
    ENSEMBLE
        .get_or_init(|| {
            let mut all = core(draft)?.clone();
            let others = Ensemble::run(draft, other_kinds())?;
            all.points.extend(others.points);
            all.unreached.extend(others.unreached);
            Ok(all)
        })
        .as_ref()
        .map_err(Clone::clone)
}

impl Ensemble {
    fn run(draft: &Draft<'_>, kinds: Vec<Kind>) -> Result<Self, String> {
        let entries = entries(Table::Rigidity);
        let turns: Vec<f64> = entries.iter().map(turn_deg).collect();
        let seeds = if draft.quick { QUICK_SEEDS } else { SEEDS };
        let kinds = kinds.into_iter();
        let cases = kinds.flat_map(|kind| kind.seeds(seeds).map(move |seed| (kind, seed)));
        let cases: Vec<(Kind, u64)> = cases.collect();
        let curves = draft.solve(&cases, |&(kind, seed)| {
            let curve = twist(&kind.specimen(RISES, seed), &turns);
            curve.map_err(|e| format!("{}, seed {seed}: {e}", kind.name()))
        })?;
        let (mut points, mut unreached) = (Vec::new(), Vec::new());
        for ((kind, seed), curve) in cases.into_iter().zip(curves) {
            points.extend(curve.points.into_iter().map(|point| (kind, seed, point)));
            for missing in curve.unreached {
                let (kind, turn, reason) = (kind.name(), missing.value, missing.reason);
                unreached.push(format!("{kind} seed {seed} at {turn:.1} deg: {reason}"));
            }
        }
        Ok(Self {
            points,
            unreached,
            seeds,
        })
    }

    pub(super) fn kinds(&self) -> Vec<Kind> {
        let mut kinds: Vec<Kind> = self.points.iter().map(|point| point.0).collect();
        kinds.dedup();
        kinds
    }

    /// Points of one kind at the twist of an entry, by seed.
    pub(super) fn points(&self, kind: Kind, entry: &Entry) -> impl Iterator<Item = &Sampled> {
        let turn = turn_deg(entry);
        // Neighbouring angles are ten degrees apart.
        let is_here = move |point: &TwistPoint| (point.turn_deg - turn).abs() < 1e-6;
        let all = self.points.iter();
        all.filter(move |(of, _, point)| *of == kind && is_here(point))
    }

    /// Value of a table at an entry for one seed; `None` if it was not reached.
    pub(super) fn value(&self, kind: Kind, seed: u64, entry: &Entry, table: Table) -> Option<f64> {
        let found = self.points(kind, entry).find(|point| point.1 == seed);
        found.map(|(.., point)| value(point, table))
    }

    pub(super) fn sample(&self, kind: Kind, entry: &Entry, table: Table) -> SampleStatistics {
        let points = self.points(kind, entry);
        sample(points.map(|(.., point)| value(point, table)))
    }

    pub(super) fn doubts(&self, kind: Kind, entries: &[Entry]) -> StabilityCounts {
        let mut doubts = StabilityCounts::default();
        for entry in entries {
            for (.., point) in self.points(kind, entry) {
                doubts.add(point);
            }
        }
        doubts
    }
}

impl StabilityCounts {
    fn add(&mut self, point: &TwistPoint) {
        self.states += 1;
        match point.evidence.stability() {
            Stability::Stable => {}
            Stability::Neutral { .. } => self.neutral += 1,
            Stability::Saddle { .. } => self.saddles += 1,
        }
        let left = point.evidence.saddles_left + point.evidence.jumps;
        self.off_the_branch += usize::from(left > 0);
    }

    pub(super) fn describe(&self) -> String {
        format!(
            "{} of {} states are saddles, {} neutral; {} paths left a saddle or jumped",
            self.saddles, self.states, self.neutral, self.off_the_branch
        )
    }
}

pub(super) fn value(point: &TwistPoint, table: Table) -> f64 {
    match table {
        Table::Rigidity => point.rigidity_pn_nm2,
        Table::LengthChange => point.relative_length_change,
    }
}

/// Turn of our filament at the twist of an entry (deg).
pub(super) fn turn_deg(entry: &Entry) -> f64 {
    (entry.curvature * RISES * Monomers::default().rise_nm).to_degrees()
}

fn other_kinds() -> Vec<Kind> {
    let kind = |anchors, bonds| Kind { anchors, bonds };
    [Anchors::Independent, Anchors::Identical]
        .into_iter()
        .flat_map(|anchors| BONDS.map(|bonds| kind(anchors, bonds)))
        .chain(BONDS_BETWEEN.map(|bonds| kind(Anchors::Independent, bonds)))
        .filter(|kind| !Kind::CORE.contains(kind))
        .collect()
}
