//! What an end of a filament does to monomers and not to a rod, from a short filament that is solved for it: of an end that is
//! held at a wall, and of a free one that bears a force.

use super::defects::{Contribution, Look, mean_motion};
use super::ideal::{Ideal, PERIOD};
use super::runs::Run;
use super::sampling::Defect;
use super::section_loads::{SectionLoads, elastic_energy, six};
use super::short::Short;
use crate::scene::{Load, SceneProblem};
use crate::{End, SectionSpan};
use actin_ellipsoid::SixVector;
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};
use std::f64::consts::FRAC_PI_2;

/// Length of the short filaments (rises).
const LENGTH_RISES: f64 = 24.0;
/// Where they are compared (rises from the wall or tip): the mean of 13 monomers there. What a wall does fades out over
/// 5.5 nm, so that some per cent of its twist are missed; further away bent monomers differ from uniformly strained ones by more.
const COMPARED_RISES: f64 = 10.0;
/// Cells on the way there.
const SAMPLES: u32 = 6;
/// How far beside a tip its force is in the filament (nm).
const BESIDE_NM: f64 = 1e-3;
/// Azimuths that monomers are rolled to where they are free to roll.
const AZIMUTHS: u32 = 4;
/// A filament whose energy changes by less when it is rolled through a right angle is free to roll: pN nm, and share of
/// its elastic energy.
const FREE: (f64, f64) = (0.2, 0.01);

impl Look<'_> {
    /// What the ends of the filament make of the monomers that its rods stand for.
    ///
    /// At a wall monomers, 24 rises, are clamped as the filament is, under its force where they are compared. By how much
    /// those about ten rises are further than an endless filament would be is the wall's. At a tip it is the tip that is further,
    /// and its force acts beside the axis, on two monomers.
    ///
    /// Where the filament is free to roll about its axis the mean over four azimuths is taken. Which it rolls to is not known: what
    /// walls store is least where it does, but what bent monomers do otherwise than uniformly strained ones is left out.
    pub(super) fn ends(&self, runs: &[Run]) -> Result<Vec<Contribution>, SceneProblem> {
        let ends = [(End::Start, runs.first()), (End::End, runs.last())];
        let rods = ends.map(|(end, run)| (end, run.filter(|run| run.rod.is_some())));
        let rods = rods
            .iter()
            .filter_map(|(end, run)| Some((*end, &run.as_ref()?.span)));
        let (mut walls, mut tips) = (Vec::new(), Vec::new());
        for (end, rod) in rods {
            if self.assembly.clamp_at(0, end).is_some() {
                walls.push(self.wall(end, rod));
            } else if self.bears_force(end) {
                tips.push(self.tip(end, rod));
            }
        }
        let mut all = Vec::new();
        for wall in walls {
            let defect = self.of_wall(&wall)?;
            let [held, compared, _] = wall.places().map(|place| wall.from_nm + place);
            all.push(self.contribution([held, compared], compared, &defect));
        }
        for tip in tips {
            let [_, compared, far] = tip.places();
            let (defect, arms) = self.of_tip(&tip)?;
            let [from, to] = [compared, far].map(|place| tip.from_nm + place);
            // All that a tip bears is on this side of it.
            let at = to - tip.out() * BESIDE_NM;
            let mut part = self.contribution([from, to], at, &defect);
            part.error += self.by_arm((tip.other(), at), arms);
            all.push(part);
        }
        Ok(all)
    }

    /// What it makes of the number that the force on a tip acts beside the axis: by an arm in body axes, and in lab axes at
    /// rest.
    fn by_arm(&self, (end, at): (End, f64), [arm, at_rest]: [Vector3; 2]) -> f64 {
        let motion = six(Vector3::zeros(), arm);
        // It stores nothing by itself.
        let stored = -motion.dot(&self.loads.at(at));
        self.adjoint.change(at, &motion, stored) - self.adjoint.at_rest(end, at_rest)
    }

    fn contribution(&self, [a, b]: [f64; 2], at: f64, defect: &Defect) -> Contribution {
        let motion = SixVector::from(defect.fixed_rows::<6>(0));
        Contribution {
            span_nm: [a.min(b), a.max(b)],
            error: self.adjoint.change(at, &motion, defect[6]),
        }
    }

    /// The short filament at a wall.
    fn wall(&self, end: End, rod: &SectionSpan) -> Short {
        let rise = self.assembly.monomers_of(0).rise_nm;
        // Whole rises, and less than the filament: at its very end it carries nothing.
        let whole = (self.assembly.length_nm() / rise - 0.01).ceil() - 1.0;
        let length_nm = whole.min(LENGTH_RISES) * rise;
        let from_nm = if end == End::Start {
            rod.from_nm
        } else {
            rod.to_nm - length_nm
        };
        Short {
            held: end,
            is_free: false,
            from_nm,
            length_nm,
            compared_nm: (COMPARED_RISES * rise).min(0.5 * length_nm),
        }
    }

    /// What a wall does: motion of monomers where they are compared (body axes), and what they store.
    fn of_wall(&self, wall: &Short) -> Result<Defect, SceneProblem> {
        let [held, compared, _] = wall.places();
        let load = |s_nm: f64| self.loads.at(wall.from_nm + s_nm);
        // As far as monomers are compared.
        let rise = self.assembly.monomers_of(0).rise_nm;
        let last = compared + wall.out() * 0.5 * PERIOD as f64 * rise;
        let ideal = Ideal::along(self.cells, load, ([held, last], SAMPLES)).ok_or_else(no_cell)?;
        let azimuths: u32 = if self.is_free_to_roll() { AZIMUTHS } else { 1 };
        let mut sum = Defect::zeros();
        for k in 0..azimuths {
            let roll = f64::from(k) * 360.0 / f64::from(azimuths);
            let (monomers, state) = self.short(wall, roll, None)?;
            let loads = SectionLoads::of(&monomers, &state);
            let ideal = ideal.under(|s_nm| loads.at(s_nm));
            let base = (Vector3::z() * held, UnitQuaternion::identity());
            let at = |s_nm: f64| ideal.carry(base, [held, s_nm]);
            let here = (&monomers, &state);
            let (turn, shift) = mean_motion(here, &monomers.sections_of(0)[0], compared, at);
            let body = at(compared).1.inverse();
            let defect = six(body * turn, body * shift) * wall.out();
            sum += defect.push(ideal.stored(&defect, &loads.at(compared)));
        }
        Ok(sum / f64::from(azimuths))
    }

    /// Whether the scene has a force on an end.
    fn bears_force(&self, wanted: End) -> bool {
        let mut loads = self.assembly.scene.loads.iter();
        loads.any(|load| match load {
            Load::EndForce { end, .. } => *end == wanted,
            Load::Force(force) => force.end == Some(wanted),
            _ => false,
        })
    }

    /// The short filament at a tip.
    fn tip(&self, end: End, rod: &SectionSpan) -> Short {
        let rise = self.assembly.monomers_of(0).rise_nm;
        let whole = (self.assembly.length_nm() / rise).floor();
        // Tips are midway between two monomers.
        let length_nm = (whole.min(LENGTH_RISES) - 0.5) * rise;
        let (held, from_nm) = match end {
            End::Start => (End::End, rod.from_nm),
            End::End => (End::Start, rod.to_nm - length_nm),
        };
        let compared_nm = length_nm - (COMPARED_RISES * rise).min(0.5 * length_nm);
        Short {
            held,
            is_free: true,
            from_nm,
            length_nm,
            compared_nm,
        }
    }

    /// The load of the filament at a place of the short one at a tip; at its end that just beside it.
    fn load_at(&self, tip: &Short, s_nm: f64) -> SixVector {
        let [.., far] = tip.places();
        let inside = ((far - s_nm) * tip.out()).max(BESIDE_NM);
        self.loads.at(tip.from_nm + far - tip.out() * inside)
    }

    /// What a tip does under its force: by how much further it is than an endless filament would be, with what it stores; and
    /// how far its monomers are beside the axis, in body axes and in lab axes at rest.
    fn of_tip(&self, tip: &Short) -> Result<(Defect, [Vector3; 2]), SceneProblem> {
        let [_, compared, far] = tip.places();
        let load = |s_nm: f64| self.load_at(tip, s_nm);
        let ideal =
            Ideal::along(self.cells, load, ([compared, far], SAMPLES)).ok_or_else(no_cell)?;
        let (monomers, state) = self.short(tip, 0.0, None)?;
        let base = SectionLoads::of(&monomers, &state).cross_section(compared);
        let at = |s_nm: f64| ideal.carry(base, [compared, s_nm]);
        let section = &monomers.sections_of(0)[0];
        let (turn, shift) = mean_motion((&monomers, &state), section, compared, at);
        let base = (base.0 + shift, rotation::exp(turn) * base.1);
        let at = |s_nm: f64| ideal.carry(base, [compared, s_nm]);
        let (mut arm, mut moved) = (Vector3::zeros(), Vector3::zeros());
        let points = monomers.tip_points(tip.other());
        for &i in points {
            let s_nm = monomers.points[i].s_nm;
            let own = monomers.rest.points.position.get(i) - Vector3::z() * s_nm;
            let (place, axes) = at(s_nm);
            arm += own;
            moved += state.points.position.get(i) - (place + axes * own);
        }
        let each = tip.out() / points.len() as f64;
        let shift = at(far).1.inverse() * moved * each;
        let defect = six(Vector3::zeros(), shift);
        let stored = ideal.stored(&defect, &load(far));
        let arms = [arm, self.assembly.filaments[0].rotation * arm];
        Ok((defect.push(stored), arms.map(|arm| arm * each)))
    }

    /// Whether all free bodies may be rolled about the axis, each turned back about its own, for nothing.
    pub(super) fn is_free_to_roll(&self) -> bool {
        let span = &self.assembly.filaments[0];
        let about = rotation::exp(span.axis() * FRAC_PI_2);
        let back = rotation::exp(Vector3::z() * -FRAC_PI_2);
        let mut rolled = self.state.clone();
        for i in (0..rolled.points.len()).filter(|&i| self.state.points.is_free(i)) {
            let arm = self.state.points.position.get(i) - span.origin_nm;
            rolled.points.position.set(i, span.origin_nm + about * arm);
        }
        for i in (0..rolled.frames.len()).filter(|&i| self.state.frames.is_free(i)) {
            let q = about * self.state.frames.orientation.get(i) * back;
            rolled.frames.orientation.set(i, q);
        }
        let energy = |state: &State| -> f64 {
            let all = self.assembly.system.interactions().iter();
            all.map(|interaction| interaction.energy(state)).sum()
        };
        let (most, share) = FREE;
        let limit = most.min(share * elastic_energy(self.assembly, self.state));
        (energy(&rolled) - energy(self.state)).abs() < limit
    }
}

/// Cells without a minimum.
pub(super) fn no_cell() -> SceneProblem {
    let rule =
        "monomers under the loads of this equilibrium find no minimum: its error is not known";
    SceneProblem::new("filament.sections", "", rule)
}
