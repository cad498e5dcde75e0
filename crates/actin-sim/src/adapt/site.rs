//! What monomers do about a place inside a rod at which a linker holds or a load acts, from a short filament that is
//! solved for it: the monomer there gives way and turns by itself, and those about it are not strained uniformly.

use super::adjoint::Adjoint;
use super::cells::strain_scale;
use super::defects::{BESIDE_NM, Contribution, Look, mean_motion, own_motion};
use super::ideal::{Ideal, PERIOD};
use super::runs::Run;
use super::sampling::Defect;
use super::section_loads::{SectionLoads, six};
use super::short::{Inside, Short};
use super::wall::no_cell;
use crate::assembly::{BodyKind, Part};
use crate::scene::{Couple, Force, LinkerSite, Load, Quantity, SceneProblem};
use crate::{Assembly, End, SectionSpan};
use actin_coupling::{LinkerEnd, Site};
use actin_ellipsoid::SixVector;
use actin_mechanics::{Loads, State, Vector3, rotation};

/// How far from the place monomers are compared, on either side (rises): the mean of 13 there.
const COMPARED_RISES: f64 = 16.0;
/// How far the short filament goes on either side (rises).
const SIDE_RISES: f64 = 30.0;
/// Cells on the way on either side.
const SAMPLES: u32 = 4;
/// Share of what the filament carries at a place below which what acts there is nothing.
const LEAST: f64 = 1e-3;
/// Share that is stored of the work of what acts on a site that gives way in proportion.
const STORED: f64 = 0.5;

/// What acts inside a filament.
#[derive(Clone, Copy, Debug)]
enum Acting {
    /// A linker, at its site or at its other one.
    Linker(usize, bool),
    /// A load at one place.
    Load(usize),
}

impl Acting {
    /// All that act at one place of filament 0, each with it.
    fn all(assembly: &Assembly) -> Vec<(Self, LinkerSite)> {
        let linkers = assembly.scene.linkers.iter().enumerate();
        let sites = linkers.flat_map(|(i, linker)| {
            let own = (Self::Linker(i, false), linker.site());
            let other = linker.to.map(|other| (Self::Linker(i, true), other));
            [own].into_iter().chain(other)
        });
        let loads = assembly.scene.loads.iter().enumerate();
        let places = loads.filter_map(|(i, load)| match load {
            Load::Force(Force { at_nm, .. }) | Load::Couple(Couple { at_nm, .. }) => {
                let site = LinkerSite {
                    filament: load.filament(),
                    at_nm: (*at_nm)?,
                    radius_nm: 0.0,
                    azimuth_deg: 0.0,
                };
                Some((Self::Load(i), site))
            }
            _ => None,
        });
        sites.chain(places).collect()
    }

    /// Force (pN) and its moment, with couples (pN nm), about the lab origin.
    fn wrench(self, assembly: &Assembly, state: &State) -> (Vector3, Vector3) {
        match self {
            Self::Linker(i, is_other) => {
                let linker = &assembly.linkers[i];
                let force = linker.force(state);
                if is_other {
                    (-force, linker.end_position(state).cross(&-force))
                } else {
                    (force, linker.site().position(state).cross(&force))
                }
            }
            Self::Load(i) => total(&loads_of(i, assembly, state), state),
        }
    }

    /// Arc lengths of the bodies that it acts on (nm).
    fn bodies(self, assembly: &Assembly, state: &State) -> Vec<f64> {
        let (points, frames): (Vec<usize>, Vec<usize>) = match self {
            Self::Linker(..) => {
                let Some(site) = self.site(assembly) else {
                    return Vec::new();
                };
                let shares = site.shares().iter().filter(|share| share.1 > 0.0);
                (shares.map(|share| share.0).collect(), vec![site.frame()])
            }
            Self::Load(i) => {
                let loads = loads_of(i, assembly, state);
                let points = 0..state.points.len();
                let frames = 0..state.frames.len();
                (
                    points
                        .filter(|&i| loads.force.get(i).norm() > 0.0)
                        .collect(),
                    frames
                        .filter(|&i| loads.torque.get(i).norm() > 0.0)
                        .collect(),
                )
            }
        };
        let points = points.into_iter().map(|i| assembly.points[i].s_nm);
        points
            .chain(frames.into_iter().map(|i| assembly.frames[i].s_nm))
            .collect()
    }

    /// The site of a linker.
    fn site(self, assembly: &Assembly) -> Option<&Site> {
        match self {
            Self::Linker(i, false) => Some(assembly.linkers[i].site()),
            Self::Linker(i, true) => match assembly.linkers[i].end() {
                LinkerEnd::Site(site) => Some(site),
                LinkerEnd::Anchor(_) => None,
            },
            Self::Load(_) => None,
        }
    }
}

/// What a load of the scene exerts on all bodies.
fn loads_of(load: usize, assembly: &Assembly, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    let all = assembly.system.interactions().iter().zip(&assembly.terms);
    let own = all.filter(|(_, term)| matches!(term.part, Part::Load(k) if k == load));
    own.for_each(|(interaction, _)| interaction.add_loads(state, &mut loads));
    loads
}

/// Force and moment about the lab origin of loads on bodies.
fn total(loads: &Loads, state: &State) -> (Vector3, Vector3) {
    let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
    for i in 0..state.points.len() {
        let own = loads.force.get(i);
        force += own;
        moment += state.points.position.get(i).cross(&own);
    }
    for i in 0..state.frames.len() {
        moment += state.frames.orientation.get(i) * loads.torque.get(i);
    }
    (force, moment)
}

impl Look<'_> {
    /// What monomers would do about the places inside rods at which something acts: of a curvature, where that is not within
    /// what they do.
    pub(super) fn sites(
        &self,
        runs: &[Run],
        quantity: Quantity,
    ) -> Result<Vec<Contribution>, SceneProblem> {
        let reach_nm = 2.0 * PERIOD as f64 * self.rise();
        let is_seen = |s_nm: f64| match quantity {
            Quantity::Curvature { at_nm } => (s_nm - at_nm).abs() >= reach_nm,
            _ => true,
        };
        let mut all = Vec::new();
        for (acting, site) in Acting::all(self.assembly) {
            let s_nm = site.at_nm;
            if is_seen(s_nm) && self.is_in_rod(runs, s_nm) && self.is_felt(acting, s_nm) {
                all.push(self.site(acting, site)?);
            }
        }
        Ok(all)
    }

    /// Whether a place is in a rod, and not beside a wall, which holds the monomers there.
    fn is_in_rod(&self, runs: &[Run], s_nm: f64) -> bool {
        // A boundary belongs to the section before it.
        let begins = |rod: &SectionSpan| rod.from_nm < s_nm || rod.from_nm <= 0.0;
        let mut rods = runs.iter().filter(|run| run.rod.is_some());
        let ends = [(End::Start, 0.0), (End::End, self.assembly.length_nm())];
        let mut walls = ends
            .iter()
            .filter(|(end, _)| self.assembly.clamp_at(0, *end).is_some());
        rods.any(|run| begins(&run.span) && s_nm <= run.span.to_nm)
            && walls.all(|(_, wall)| (s_nm - wall).abs() > self.rise())
    }

    /// Whether what acts at a place is more than next to nothing beside what the filament carries there, or wanted.
    fn is_felt(&self, acting: Acting, s_nm: f64) -> bool {
        if matches!(acting, Acting::Linker(linker, _) if self.adjoint.is_force_of(linker)) {
            return true;
        }
        let load = wrench_about(self.loads, s_nm, acting.wrench(self.assembly, self.state));
        strain_scale(&load) > LEAST * strain_scale(&self.loads.at(s_nm))
    }

    fn site(&self, acting: Acting, site: LinkerSite) -> Result<Contribution, SceneProblem> {
        let short = self.short_about(site.at_nm);
        let inside = self.inside(acting, site, &short);
        let [before, behind] = compared(&short, &inside, self.rise());
        let (at_site, across) = self.of_site(&short, &inside, [before, behind])?;
        let (weight, load) = self.adjoint.of_acting(acting, self.assembly, site.at_nm);
        // Its weight is by what acts, which does its work on it.
        let stored = across[6] + STORED * at_site.dot(&load);
        // What the filament carries behind all bodies that the site follows.
        let last = acting.bodies(self.assembly, self.state);
        let last = last.into_iter().fold(site.at_nm, f64::max) + BESIDE_NM;
        let through = self
            .adjoint
            .of_both(|loads, _| loads.through(last, site.at_nm));
        let length_nm = self.assembly.length_nm();
        let motion = SixVector::from(across.fixed_rows::<6>(0));
        let by_motion = motion.dot(&self.adjoint.slope(through)) + at_site.dot(&weight);
        Ok(Contribution {
            span_nm: [before, behind].map(|s_nm| (short.from_nm + s_nm).clamp(0.0, length_nm)),
            error: by_motion + self.adjoint.of_stored(stored),
        })
    }

    fn rise(&self) -> f64 {
        self.assembly.monomers_of(0).rise_nm
    }

    /// The short filament about a place, on the lattice of the whole one. It may be longer than that.
    fn short_about(&self, s_nm: f64) -> Short {
        let rise = self.rise();
        let of_whole = self.lattice_nm();
        let nearest = ((s_nm - of_whole) / rise).round();
        Short {
            held: End::Start,
            is_free: false,
            from_nm: of_whole + (nearest - SIDE_RISES) * rise,
            length_nm: 2.0 * SIDE_RISES * rise,
            compared_nm: (SIDE_RISES + COMPARED_RISES) * rise,
        }
    }

    /// What acts there, as it acts on the short filament.
    fn inside(&self, acting: Acting, site: LinkerSite, short: &Short) -> Inside {
        let (force, moment) = acting.wrench(self.assembly, self.state);
        let is_couple = force.norm() <= 0.0;
        Inside {
            site: LinkerSite {
                filament: 0,
                at_nm: site.at_nm - short.from_nm,
                ..site
            },
            force,
            couple: if is_couple { moment } else { Vector3::zeros() },
        }
    }

    /// How the site moves beyond the cross-section of an endless filament of monomers, and how all behind it does, with what it
    /// stores (axes of that cross-section, and about it).
    fn of_site(
        &self,
        short: &Short,
        inside: &Inside,
        [before, behind]: [f64; 2],
    ) -> Result<(SixVector, Defect), SceneProblem> {
        let s_nm = inside.site.at_nm;
        let beyond = 0.5 * PERIOD as f64 * self.rise();
        let (monomers, state) = self.short(short, 0.0, Some(inside))?;
        let loads = SectionLoads::of(&monomers, &state);
        let ideal = |span: [f64; 2]| {
            Ideal::along(self.cells, |s| loads.at(s), (span, SAMPLES)).ok_or_else(no_cell)
        };
        let (left, right) = (
            ideal([before - beyond, s_nm])?,
            ideal([s_nm, behind + beyond])?,
        );
        let (here, section) = ((&monomers, &state), &monomers.sections_of(0)[0]);
        let base = loads.cross_section(before);
        let at = |s: f64| left.carry(base, [before, s]);
        let (turn, shift) = mean_motion(here, section, before, at);
        let base = (base.0 + shift, rotation::exp(turn) * base.1);
        let place = left.carry(base, [before, s_nm]);
        let nearest = nearest_monomer(&monomers, s_nm);
        let (turn, moved, arm) = own_motion(here, nearest, (s_nm, place));
        let body = place.1.inverse();
        let at_site = six(body * turn, body * (moved - turn.cross(&arm)));
        let at = |s: f64| right.carry(place, [s_nm, s]);
        let (turn, shift) = mean_motion(here, section, behind, at);
        let shift = shift + turn.cross(&(place.0 - at(behind).0));
        let across = six(body * turn, body * shift);
        let beside = monomers.points[nearest].s_nm.max(s_nm) + BESIDE_NM;
        let stored = right.stored(&across, &loads.through(beside, s_nm));
        Ok((at_site, across.push(stored)))
    }
}

/// A force and its moment about the lab origin as couple and force about a cross-section, in its axes.
fn wrench_about(loads: &SectionLoads, s_nm: f64, (force, moment): (Vector3, Vector3)) -> SixVector {
    let (place, axes) = loads.cross_section(s_nm);
    let body = axes.inverse();
    six(body * (moment - place.cross(&force)), body * force)
}

/// Where monomers are compared.
fn compared(short: &Short, inside: &Inside, rise: f64) -> [f64; 2] {
    [inside.site.at_nm - COMPARED_RISES * rise, short.compared_nm]
}

/// The monomer that is nearest to an arc length (nm); of two equally near the lower one.
fn nearest_monomer(assembly: &Assembly, s_nm: f64) -> usize {
    let points = assembly.sections_of(0)[0].points.clone();
    let monomers = points.filter(|&i| assembly.points[i].kind == BodyKind::Monomer);
    let far = |i: &usize| (assembly.points[*i].s_nm - s_nm).abs();
    let nearest = monomers.min_by(|a, b| far(a).total_cmp(&far(b)));
    nearest.expect("a short filament has monomers")
}

impl Adjoint {
    /// What a motion (body axes) of a site beyond its cross-section makes of the number, and what acts on it (couple and force about
    /// the cross-section, body axes).
    fn of_acting(&self, acting: Acting, assembly: &Assembly, s_nm: f64) -> (SixVector, SixVector) {
        let both =
            self.of_both(|loads, state| wrench_about(loads, s_nm, acting.wrench(assembly, state)));
        let [ahead, behind] = both;
        let load = 0.5 * (ahead + behind);
        let by_end = match acting {
            Acting::Linker(i, is_other) => self
                .by_end_of(i)
                .zip(acting.site(assembly))
                .map(|(slope, site)| (if is_other { slope } else { -slope }, site)),
            Acting::Load(_) => None,
        };
        let Some((slope, site)) = by_end else {
            return (self.slope(both), load);
        };
        // At the state itself, which is between the two.
        let own = self.of_both(|loads, state| {
            let moment = site.position(state).cross(&slope);
            wrench_about(loads, s_nm, (slope, moment))
        });
        (self.slope(both) + 0.5 * (own[0] + own[1]), load)
    }
}
