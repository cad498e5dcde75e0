//! What a wall does to monomers and not to a rod, from two short filaments that are solved for it.

use super::defects::{Contribution, Look, mean_motion, of_law};
use super::ideal::{Ideal, mean_monomers};
use super::section_loads::{SectionLoads, elastic_energy, linear, six};
use crate::advice::segments_of;
use crate::scene::{
    Clamp, Equilibrium, Filament, Hold, Load, Scene, SceneProblem, Section, Slides, Task,
};
use crate::{Assembly, End, SectionSpan};
use actin_ellipsoid::SixVector;
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};
use std::f64::consts::FRAC_PI_2;

/// Length of the short filaments (rises).
const LENGTH_RISES: f64 = 24.0;
/// Where they are compared (rises from the wall): the mean of 13 monomers there.
const COMPARED_RISES: f64 = 10.0;
/// Longest segments of the short rod (nm): what longer ones do is found by halving them.
const SEGMENT_NM: f64 = 2.5;
/// Cells on the way there.
const SAMPLES: u32 = 4;
/// A filament whose energy changes by less when it is rolled through a right angle is free to roll: pN nm, and share of
/// its elastic energy.
const FREE: (f64, f64) = (0.2, 0.01);

/// How far they are solved.
const TASK: Equilibrium = Equilibrium {
    force_pn: 1e-6,
    torque_pn_nm: 1e-6,
    iterations: 400,
    largest_step: 1.0,
    smallest_step: 1.0,
    leave_saddles: 0,
    accept_jumps: false,
    lowest_eigenvalue: false,
    states: 0,
    error_of: None,
};

/// One clamped end of a rod.
#[derive(Clone, Copy)]
struct Wall {
    end: End,
    /// Its arc length (nm).
    s_nm: f64,
    /// Arc length that the short filaments begin at (nm).
    from_nm: f64,
    length_nm: f64,
    /// How far from the wall they are compared (nm).
    compared_nm: f64,
    /// 1 at the start, -1 at the end.
    out: f64,
}

impl Wall {
    /// Arc length of the wall in the short filaments.
    fn own(&self) -> f64 {
        if self.end == End::Start {
            0.0
        } else {
            self.length_nm
        }
    }

    fn far(&self) -> End {
        if self.end == End::Start {
            End::End
        } else {
            End::Start
        }
    }
}

impl Look<'_> {
    /// What the wall at one end of the filament makes of the monomers that its rod stands for.
    ///
    /// Monomers and rod, 24 rises each, are clamped as the filament is; the far end is turned as its cross-section
    /// there and slides under the force where they are compared. What monomers at about ten rises are further than the rod, but for its law
    /// under the loads of the monomers, is the wall's.
    ///
    /// Where the filament is free to roll about its axis it settles where walls pull it least to either side: the
    /// mean over four azimuths of the monomers is taken.
    pub(super) fn wall(&self, end: End, rod: &SectionSpan) -> Result<Contribution, SceneProblem> {
        let rise = self.assembly.monomers_of(0).rise_nm;
        // Whole rises, and less than the filament: at its very end it carries nothing.
        let whole = (self.assembly.length_nm() / rise - 0.01).ceil() - 1.0;
        let rises = whole.min(LENGTH_RISES);
        let length_nm = rises * rise;
        let is_start = end == End::Start;
        let s_nm = if is_start { rod.from_nm } else { rod.to_nm };
        let wall = Wall {
            end,
            s_nm,
            from_nm: if is_start { s_nm } else { s_nm - length_nm },
            length_nm,
            compared_nm: (COMPARED_RISES * rise).min(0.5 * length_nm),
            out: if is_start { 1.0 } else { -1.0 },
        };
        let azimuths: u32 = if self.is_free_to_roll() { 4 } else { 1 };
        // Rods are the same however monomers are rolled.
        let rods = self.short_rod(wall, rod)?;
        let mut defect = SixVector::zeros();
        let mut ideal = None;
        for k in 0..azimuths {
            let roll = f64::from(k) * 360.0 / f64::from(azimuths);
            let (of_roll, along) = self.compare(wall, &rods, roll, ideal.as_ref())?;
            defect += of_roll / f64::from(azimuths);
            ideal = Some(along);
        }
        let to = s_nm + wall.out * wall.compared_nm;
        Ok(Contribution {
            span_nm: [s_nm.min(to), s_nm.max(to)],
            error: self.of_defect(&defect, to),
        })
    }

    /// The short rod at a wall.
    fn short_rod(&self, wall: Wall, rod: &SectionSpan) -> Result<(Assembly, State), SceneProblem> {
        let crate::Resolution::Rod { segment_nm } = rod.resolution else {
            unreachable!("asked of rods")
        };
        let length = wall.length_nm;
        let segments = segments_of(length, segment_nm.min(SEGMENT_NM));
        self.short(wall, Section::rod(0.0, length, Some(segments)), 0.0)
    }

    /// The defect of a wall against its short rod, its monomers rolled by an angle (deg), and what these do but for the wall,
    /// found from what they do where they are rolled by another.
    fn compare(
        &self,
        wall: Wall,
        (rods, in_rods): &(Assembly, State),
        roll: f64,
        near: Option<&Ideal>,
    ) -> Result<(SixVector, Ideal), SceneProblem> {
        let ellipsoids = Section::Ellipsoids {
            from_nm: 0.0,
            to_nm: wall.length_nm,
            altered: None,
        };
        let (monomers, in_monomers) = self.short(wall, ellipsoids, roll)?;
        let of_monomers = SectionLoads::of(&monomers, &in_monomers);
        let of_rods = SectionLoads::of(rods, in_rods);
        let (from, to) = (wall.own(), wall.own() + wall.out * wall.compared_nm);
        let at = |s_nm: f64| of_rods.cross_section(s_nm);
        let here = (&monomers, &in_monomers);
        let (turn, shift) = mean_motion(here, &monomers.sections_of(0)[0], to, at);
        let loads = |s_nm: f64| of_monomers.at(s_nm);
        let ideal = Ideal::along(self.mean, loads, ([from, to], SAMPLES), near);
        let ideal = ideal.ok_or_else(no_cell)?;
        let here = (rods, in_rods, &of_rods);
        let law = of_law(here, &rods.sections_of(0)[0], &ideal, [from, to]);
        let body = of_rods.cross_section(to).1.inverse();
        let defect = six(body * (turn - law.0), body * (shift - law.1)) * wall.out;
        Ok((defect, ideal))
    }

    /// A short filament at a wall, in equilibrium next to where the filament itself is.
    fn short(
        &self,
        wall: Wall,
        section: Section,
        roll: f64,
    ) -> Result<(Assembly, State), SceneProblem> {
        let (origin, frame) = self.loads.cross_section(wall.s_nm);
        let to_own = frame.inverse();
        let far = wall.length_nm - wall.own();
        let compared = wall.s_nm + wall.out * wall.compared_nm;
        let (_, axes) = self.loads.cross_section(compared);
        let force = to_own * (axes * linear(&self.loads.at(compared))) * wall.out;
        let scene = self.short_scene(wall, section, roll, force);
        let assembly = Assembly::build(&scene)?;
        let mut state = assembly.system.state().clone();
        let place = |s_nm: f64| {
            let (place, axes) = self.loads.cross_section(wall.from_nm + s_nm);
            let along = Vector3::z() * wall.own();
            (to_own * (place - origin) + along, to_own * axes)
        };
        lay(&assembly, &mut state, far, place);
        let mut newton = crate::run::solver(&assembly, &TASK)?;
        let solved = newton.solve(&mut state, assembly.system.interactions());
        solved.map_err(|failure| {
            let rule = format!("the error at a wall is not known: {}", failure.cause);
            SceneProblem::new("filament.sections", "", rule)
        })?;
        Ok((assembly, state))
    }

    /// Its scene. The far end bears `force`.
    fn short_scene(&self, wall: Wall, section: Section, roll: f64, force: Vector3) -> Scene {
        let whole = &self.assembly.scene.filament;
        let rise = whole.monomers.rise_nm;
        let mut monomers = mean_monomers(&whole.monomers);
        let held = self.assembly.clamp_at(0, End::Start).is_some();
        // Lattice index 0 is at arc length 0 where the start is held, half a rise before it else; here it is held.
        let origin = if held { 0.0 } else { -0.5 * rise };
        let index = ((wall.from_nm - origin) / rise).round();
        monomers.azimuth_deg = (monomers.azimuth_deg + roll + index * monomers.turn_deg) % 360.0;
        let mut filament = Filament::new(vec![section]);
        filament.monomers = monomers;
        filament.rod.clone_from(&whole.rod);
        filament.junction = whole.junction;
        Scene {
            title: String::new(),
            filament,
            further: Vec::new(),
            clamps: vec![
                clamp(wall.end, Slides::Nowhere),
                clamp(wall.far(), Slides::Freely),
            ],
            loads: vec![Load::EndForce {
                filament: 0,
                end: wall.far(),
                force_pn: force.into(),
            }],
            linkers: Vec::new(),
            repulsion: None,
            path: Vec::new(),
            observe: Vec::new(),
            burn_in_ns: None,
            output: crate::Output::default(),
            task: Task::Equilibrium(TASK),
        }
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

fn clamp(end: End, slides: Slides) -> Clamp {
    Clamp {
        filament: 0,
        end,
        hold: Hold::default(),
        hinge: None,
        slides,
    }
}

/// Places the bodies of a short filament on cross-sections; those at its far end as one body.
fn lay(
    assembly: &Assembly,
    state: &mut State,
    far: f64,
    place: impl Fn(f64) -> (Vector3, UnitQuaternion),
) {
    let sliding = assembly
        .clamps
        .iter()
        .find(|clamp| clamp.slides == Slides::Freely);
    let at_far = |held: &[usize], i: usize| held.contains(&i).then_some(far);
    for i in 0..assembly.points.len() {
        let s_nm = assembly.points[i].s_nm;
        let at = sliding
            .and_then(|clamp| at_far(&clamp.points, i))
            .unwrap_or(s_nm);
        let (there, axes) = place(at);
        let arm = assembly.rest.points.position.get(i) - Vector3::z() * at;
        state.points.position.set(i, there + axes * arm);
    }
    for i in 0..assembly.frames.len() {
        let s_nm = assembly.frames[i].s_nm;
        let at = sliding
            .and_then(|clamp| at_far(&clamp.frames, i))
            .unwrap_or(s_nm);
        let q = place(at).1 * assembly.rest.frames.orientation.get(i);
        state.frames.orientation.set(i, q);
    }
}

/// Cells without a minimum.
pub(super) fn no_cell() -> SceneProblem {
    let rule =
        "monomers under the loads of this equilibrium find no minimum: its error is not known";
    SceneProblem::new("filament.sections", "", rule)
}
