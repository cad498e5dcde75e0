//! Short filaments of monomers at an end of a filament or about a place inside, solved next to where it is, under the loads that it carries.

use super::defects::Look;
use super::ideal::mean_monomers;
use super::section_loads::linear;
use crate::scene::{
    Clamp, Couple, Equilibrium, Factor, Filament, Hold, Linker, LinkerSite, Load, Scene,
    SceneProblem, Section, Slides, Task,
};
use crate::{Assembly, End};
use actin_mechanics::{State, UnitQuaternion, Vector3};

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

/// Length of the spring by which a force acts on one (nm): it stays what it is wherever its site goes.
const SPRING_NM: f64 = 1e5;

/// Where a short filament is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Short {
    /// Its end that is held as it was built.
    pub held: End,
    /// Whether the other end is free; else it is turned as its cross-section, and slides.
    pub is_free: bool,
    /// Arc length in the filament that it begins at (nm).
    pub from_nm: f64,
    pub length_nm: f64,
    /// How far from its held end its loads are those of the filament (nm).
    pub compared_nm: f64,
}

/// What acts on a short filament at a place inside it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside {
    /// Where, in the short filament.
    pub site: LinkerSite,
    /// Force (pN, lab frame of the filament).
    pub force: Vector3,
    /// Couple (pN nm, lab frame of the filament).
    pub couple: Vector3,
}

impl Inside {
    /// Itself in a frame that is turned.
    fn turned(self, to_own: &UnitQuaternion) -> Self {
        Self {
            site: self.site,
            force: to_own * self.force,
            couple: to_own * self.couple,
        }
    }

    /// A force as a long soft spring exerts it at the site, whose place on the axis is `place`.
    fn spring(&self, place: Vector3) -> Linker {
        Linker {
            filament: 0,
            at_nm: self.site.at_nm,
            radius_nm: self.site.radius_nm,
            azimuth_deg: self.site.azimuth_deg,
            to: None,
            anchor_nm: Some((place + self.force.normalize() * SPRING_NM).into()),
            displaced_nm: None,
            stiffness_pn_per_nm: self.force.norm() / SPRING_NM,
            rest_length_nm: 0.0,
            kinetics: None,
        }
    }

    fn couple(&self) -> Load {
        Load::Couple(Couple {
            filament: 0,
            end: None,
            at_nm: Some(self.site.at_nm),
            couple_pn_nm: self.couple.into(),
            follows: false,
            factor: Factor::default(),
        })
    }
}

impl Short {
    /// 1 where it is held at its start, -1 at its end.
    pub(super) fn out(&self) -> f64 {
        if self.held == End::Start { 1.0 } else { -1.0 }
    }

    /// Arc lengths in the short filament of its held end, of where it is compared, and of its other end.
    pub(super) fn places(&self) -> [f64; 3] {
        let held = if self.held == End::Start {
            0.0
        } else {
            self.length_nm
        };
        let compared = held + self.out() * self.compared_nm;
        [held, compared, self.length_nm - held]
    }

    /// The end that is not held as it was built.
    pub(super) fn other(&self) -> End {
        if self.held == End::Start {
            End::End
        } else {
            End::Start
        }
    }
}

impl Look<'_> {
    /// The monomers of a short filament, rolled by an angle (deg), in equilibrium.
    ///
    /// The end that is not held bears the force of the filament where they are compared; where it is not free it is turned as its
    /// cross-section. Something may act inside.
    pub(super) fn short(
        &self,
        short: &Short,
        roll: f64,
        inside: Option<&Inside>,
    ) -> Result<(Assembly, State), SceneProblem> {
        let [held, compared, far] = short.places();
        let (origin, frame) = self.loads.cross_section(short.from_nm + held);
        let to_own = frame.inverse();
        let at = short.from_nm + compared;
        let (_, axes) = self.loads.cross_section(at);
        let force = to_own * (axes * linear(&self.loads.at(at))) * short.out();
        let place = |s_nm: f64| {
            let (place, axes) = self.loads.cross_section(short.from_nm + s_nm);
            let along = Vector3::z() * held;
            (to_own * (place - origin) + along, to_own * axes)
        };
        let mut scene = self.short_scene(short, roll, force);
        if let Some(inside) = inside.map(|inside| inside.turned(&to_own)) {
            if inside.force.norm() > 0.0 {
                scene
                    .linkers
                    .push(inside.spring(place(inside.site.at_nm).0));
            }
            if inside.couple.norm() > 0.0 {
                scene.loads.push(inside.couple());
            }
        }
        let assembly = Assembly::build(&scene)?;
        let mut state = assembly.system.state().clone();
        lay(&assembly, &mut state, far, place);
        solve(&assembly, &mut state)?;
        Ok((assembly, state))
    }

    /// Arc length of lattice index 0 of the filament (nm).
    pub(super) fn lattice_nm(&self) -> f64 {
        let is_held = self.assembly.clamp_at(0, End::Start).is_some();
        lattice_nm(is_held, self.assembly.monomers_of(0).rise_nm)
    }

    /// Its scene. The end that is not held bears `force`.
    fn short_scene(&self, short: &Short, roll: f64, force: Vector3) -> Scene {
        let whole = &self.assembly.scene.filament;
        let rise = whole.monomers.rise_nm;
        let mut monomers = mean_monomers(&whole.monomers);
        let own = lattice_nm(short.held == End::Start || !short.is_free, rise);
        let index = ((short.from_nm + own - self.lattice_nm()) / rise).round();
        monomers.azimuth_deg = (monomers.azimuth_deg + roll + index * monomers.turn_deg) % 360.0;
        let mut filament = Filament::new(vec![Section::Ellipsoids {
            from_nm: 0.0,
            to_nm: short.length_nm,
            altered: None,
        }]);
        filament.monomers = monomers;
        let mut clamps = vec![clamp(short.held, Slides::Nowhere)];
        if !short.is_free {
            clamps.push(clamp(short.other(), Slides::Freely));
        }
        Scene {
            title: String::new(),
            filament,
            further: Vec::new(),
            clamps,
            loads: vec![Load::EndForce {
                filament: 0,
                end: short.other(),
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
}

/// Arc length of lattice index 0 (nm): 0 where the start is held, half a rise before it else.
fn lattice_nm(is_held: bool, rise_nm: f64) -> f64 {
    if is_held { 0.0 } else { -0.5 * rise_nm }
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

fn solve(assembly: &Assembly, state: &mut State) -> Result<(), SceneProblem> {
    let mut newton = crate::run::solver(assembly, &TASK)?;
    let solved = newton.solve(state, assembly.system.interactions());
    solved.map(|_| ()).map_err(|failure| {
        let rule = format!(
            "the error is not known where monomers are solved by themselves: {}",
            failure.cause
        );
        SceneProblem::new("filament.sections", "", rule)
    })
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
