//! One filament turned in its middle: its scene, and what its two halves store.

use crate::run::{run_to_end, scenario};
use actin_sim::shape::{ProfilePoint, Ribbon, profile};
use actin_sim::{Assembly, Hold, Monomers, Part, RodLaw, Scene, Slides};
use actin_view::Pose;

/// What resolves the filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resolved {
    /// 19 segments, held so.
    Rod(Hold),
    /// The same with the energy of the supplement, which couples stretch and twist.
    Coupled(Hold),
    /// 67 monomers with so many drawn bonds per interface.
    Ellipsoids(usize),
    /// 67 monomers with weighted bonds, which stand for all: the mean filament.
    Mean,
}

/// Which ends slide along the axis. The linker then still holds the middle along the axis: with one
/// end held, the half towards it stays in tension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sliding {
    Neither,
    FarEnd,
    BothEnds,
}

/// One filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Case {
    pub resolved: Resolved,
    /// Seed of the bonds.
    pub seed: u64,
    /// Whether the linker turns the middle the other way.
    pub reversed: bool,
    pub sliding: Sliding,
}

/// What came out of it.
#[derive(Clone, Debug)]
pub(super) struct Halves {
    pub case: Case,
    /// Elastic energy of the over-twisted and of the under-twisted half (pN nm).
    pub over_pn_nm: f64,
    pub under_pn_nm: f64,
    /// Turn of the middle about the axis, along the pull (deg).
    pub turn_deg: f64,
    /// Pull of the linker (pN).
    pub pull_pn: f64,
    /// Tension at the first end that is held along the axis (pN); zero if both slide.
    pub tension_pn: f64,
    /// Eigenvalues of the stiffness that are not positive beyond doubt.
    pub doubtful: usize,
    /// Residual force (pN) and torque (pN nm).
    pub residual: (f64, f64),
    /// Arc length from the middle (nm), towards the over-twisted half, and energy per length (pN).
    pub profile: Vec<(f64, f64)>,
    pub pose: Pose,
}

impl Halves {
    /// Elastic energy of the filament (pN nm).
    pub(super) fn energy_pn_nm(&self) -> f64 {
        self.over_pn_nm + self.under_pn_nm
    }

    /// Energy of the over-twisted half over that of the under-twisted one.
    pub(super) fn ratio(&self) -> f64 {
        self.over_pn_nm / self.under_pn_nm
    }
}

impl Case {
    pub(super) fn is_rod(&self) -> bool {
        matches!(self.resolved, Resolved::Rod(_) | Resolved::Coupled(_))
    }

    /// Whether its bonds are drawn at random.
    pub(super) fn is_sampled(&self) -> bool {
        matches!(self.resolved, Resolved::Ellipsoids(_))
    }

    /// Name of the kind in quantities.
    pub(super) fn kind(&self) -> String {
        let slides = match self.sliding {
            Sliding::Neither => "",
            Sliding::FarEnd => "far-end-slides/",
            Sliding::BothEnds => "both-ends-slide/",
        };
        match self.resolved {
            Resolved::Rod(Hold::Wall) => format!("{slides}wall/rod"),
            Resolved::Rod(_) => format!("{slides}rod"),
            Resolved::Coupled(Hold::Wall) => format!("{slides}coupling-energy/wall/rod"),
            Resolved::Coupled(_) => format!("{slides}coupling-energy/rod"),
            Resolved::Mean => format!("{slides}mean-filament/ellipsoid"),
            Resolved::Ellipsoids(32) => format!("{slides}bonds-32/ellipsoid"),
            Resolved::Ellipsoids(_) => format!("{slides}ellipsoid"),
        }
    }

    fn scene(&self) -> Result<Scene, String> {
        let file = if self.is_rod() {
            "rod.ron"
        } else {
            "ellipsoids.ron"
        };
        let mut scene = scenario(&format!("figure-7/{file}"))?;
        self.apply(&mut scene);
        Ok(scene)
    }

    fn apply(&self, scene: &mut Scene) {
        if let Resolved::Rod(hold) | Resolved::Coupled(hold) = self.resolved {
            scene.clamps.iter_mut().for_each(|clamp| clamp.hold = hold);
        }
        match self.resolved {
            Resolved::Rod(_) => {}
            Resolved::Coupled(_) => scene.filament.rod.law = RodLaw::CouplingEnergy,
            Resolved::Mean => scene.filament.monomers = Monomers::default(),
            Resolved::Ellipsoids(bonds) => {
                let monomers = &mut scene.filament.monomers;
                monomers.seed = self.seed;
                monomers.lateral_bonds = bonds;
                monomers.longitudinal_bonds = bonds;
            }
        }
        let sliding = match self.sliding {
            Sliding::Neither => 0,
            Sliding::FarEnd => 1,
            Sliding::BothEnds => 2,
        };
        for clamp in scene.clamps.iter_mut().rev().take(sliding) {
            clamp.slides = Slides::AlongAxis;
        }
        if self.reversed {
            let linkers = scene.linkers.iter_mut();
            let anchors = linkers.filter_map(|linker| linker.displaced_nm.as_mut());
            anchors.flatten().for_each(|v| *v = -*v);
        }
    }

    /// Finds the equilibrium and measures both halves.
    pub(super) fn run(&self) -> Result<Halves, String> {
        let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", self.kind());
        let mut assembly = Assembly::build(&self.scene()?).map_err(|e| fail(&e))?;
        let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| fail(&e))?;
        let last = trajectory
            .records
            .last()
            .ok_or_else(|| fail(&"no record"))?;
        let certificate = report.equilibrium.ok_or_else(|| fail(&"no certificate"))?;
        let counts = certificate.certificate;
        let measured = self.measure(&mut assembly);
        Ok(Halves {
            doubtful: counts.negative + counts.unresolved,
            residual: (last.residual_force_pn, last.residual_torque_pn_nm),
            ..measured
        })
    }

    fn measure(&self, assembly: &mut Assembly) -> Halves {
        let loads = assembly.system.loads().clone();
        let state = assembly.system.state();
        let clamp = assembly.clamps.iter().find(|c| c.slides == Slides::Nowhere);
        let tension = clamp.map_or(0.0, |c| -c.reaction(state, &loads).force_pn.z);
        let linker = assembly.terms.iter().zip(assembly.system.energies());
        let energy = linker.filter(|(term, _)| matches!(term.part, Part::Linker(_)));
        let energy: f64 = energy.map(|(_, e)| e).sum();
        let stiffness = assembly.scene.linkers[0].stiffness_pn_per_nm;
        let turn_deg = turn_of_middle(assembly).to_degrees();
        let sign = turn_deg.signum();
        let ([first, second], profile) = halves(assembly, sign);
        let (over, under) = if sign > 0.0 {
            (first, second)
        } else {
            (second, first)
        };
        Halves {
            case: *self,
            over_pn_nm: over,
            under_pn_nm: under,
            turn_deg: turn_deg.abs(),
            pull_pn: (2.0 * stiffness * energy).sqrt(),
            tension_pn: tension,
            doubtful: 0,
            residual: (0.0, 0.0),
            profile,
            pose: Pose::of(assembly, assembly.system.state()),
        }
    }
}

/// How far the body in the middle has been turned about lab z (rad).
fn turn_of_middle(assembly: &Assembly) -> f64 {
    let middle = 0.5 * assembly.length_nm();
    let distance = |i: usize| (assembly.frames[i].s_nm - middle).abs();
    let frames = 0..assembly.frames.len();
    let nearest = frames.min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    let i = nearest.unwrap_or_default();
    let now = assembly.system.state().frames.orientation.get(i);
    let turn = now * assembly.rest.frames.orientation.get(i).inverse();
    2.0 * turn.k.atan2(turn.w)
}

/// Elastic energies of the first and the second half (pN nm), and energy per length about the
/// middle, with the over-twisted half (the first if `sign` is positive) on the positive side.
fn halves(assembly: &Assembly, sign: f64) -> ([f64; 2], Vec<(f64, f64)>) {
    let state = assembly.system.state();
    let points: Vec<ProfilePoint> = profile(assembly, state);
    let ribbon = Ribbon::new(assembly, state);
    let (first, last) = (points[0].s_nm, points[points.len() - 1].s_nm);
    let mut cells = vec![first];
    cells.extend(&ribbon.frame_s_nm);
    cells.push(last);
    let middle = 0.5 * assembly.length_nm();
    let mut energies = [0.0; 2];
    for (point, cell) in points.iter().zip(cells.windows(2)) {
        let half = usize::from(0.5 * (cell[0] + cell[1]) > middle);
        energies[half] += point.energy_per_length_pn * (cell[1] - cell[0]);
    }
    let mut along: Vec<(f64, f64)> = points
        .iter()
        .map(|p| (sign * (middle - p.s_nm), p.energy_per_length_pn))
        .collect();
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    (energies, along)
}
