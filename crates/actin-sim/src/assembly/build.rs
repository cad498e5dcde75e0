//! Building the bodies and interactions of a scene, section by section. What holds the ends is in
//! `build/holds.rs`, what links the filament to its surroundings in `build/linkers.rs`.

mod holds;
mod linkers;
mod spans;

use super::lattice::{Lattice, Resolved, resolve};
use super::{Assembly, Clamped, Drive, FrameInfo, Part, PointInfo, Resolution, SectionSpan, Term};
use super::{BodyKind, law, models};
use crate::scene::{End, Hold, Load, MOST_BODIES, Problem, Scene, Section};
use actin_cosserat::{CrossSection, JoinedElement, RodLayout, StraightRod, Walls};
use actin_coupling::{AttachedMonomer, Junction, JunctionSide, Linker, push_junction_frames};
use actin_ellipsoid::{EllipsoidModel, Monomers, Placement};
use actin_mechanics::{Interaction, PointLoad, State, System, UnitQuaternion, Vector3};
use std::ops::Range;

/// Length of a rod's segments where the scene does not say how many there are (nm).
const DEFAULT_SEGMENT_NM: f64 = 10.0;

impl Assembly {
    /// Builds the scene: bodies in filament order, interactions, held ends and loads.
    ///
    /// # Errors
    /// What only shows when the filament is built: a section without room for its bodies, an
    /// interface that finds no bonds, more bodies than a run could hold.
    pub fn build(scene: &Scene) -> Result<Self, Problem> {
        let resolved = resolve(scene)?;
        let mut builder = Builder::new(scene, resolved)?;
        for i in 0..scene.filament.sections.len() {
            builder.push_section(i)?;
        }
        builder.push_interactions()?;
        builder.hold_ends()?;
        builder.push_loads();
        builder.push_linkers()?;
        Ok(builder.finish())
    }
}

/// What a section has become.
enum Body {
    Monomers(Monomers),
    Rod(RodLayout),
}

/// A filament under construction.
struct Builder<'a> {
    scene: &'a Scene,
    resolved: Vec<Resolved>,
    lattice: Lattice,
    model: EllipsoidModel,
    law: law::Law,
    cross_section: CrossSection,
    state: State,
    bodies: Vec<Body>,
    /// Frames of the junction between section i and the next.
    junction_frames: Vec<Range<usize>>,
    points: Vec<PointInfo>,
    frames: Vec<FrameInfo>,
    sections: Vec<SectionSpan>,
    interactions: Vec<Box<dyn Interaction>>,
    terms: Vec<Term>,
    clamps: Vec<Clamped>,
    linkers: Vec<Linker>,
}

impl<'a> Builder<'a> {
    fn new(scene: &'a Scene, resolved: Vec<Resolved>) -> Result<Self, Problem> {
        let filament = &scene.filament;
        let monomers = &filament.monomers;
        let density = monomers.mass_ag / monomers.rise_nm;
        let area = actin_cosserat::constants::CROSS_SECTION_AREA;
        Ok(Self {
            lattice: Lattice::of(scene),
            model: models::ellipsoids(monomers)?,
            law: law::Law::new(&filament.rod)?,
            cross_section: CrossSection::new(density, area).map_err(|error| {
                let key = format!("filament.rod.{}", error.key);
                Problem::new(key, error.value, format!("must be {}", error.rule))
            })?,
            scene,
            resolved,
            state: State::default(),
            bodies: Vec::new(),
            junction_frames: Vec::new(),
            points: Vec::new(),
            frames: Vec::new(),
            sections: Vec::new(),
            interactions: Vec::new(),
            terms: Vec::new(),
            clamps: Vec::new(),
            linkers: Vec::new(),
        })
    }

    /// Pushes the junction to the section before, then the bodies of section `i`.
    fn push_section(&mut self, i: usize) -> Result<(), Problem> {
        if i > 0 {
            self.push_junction_frames(i - 1)?;
        }
        match self.resolved[i].monomers {
            Some((first, last)) => {
                self.push_monomers(i, first, last);
                Ok(())
            }
            None => self.push_rod(i),
        }
    }

    fn push_monomers(&mut self, i: usize, first: i64, last: i64) {
        let placement = Placement {
            rotation: UnitQuaternion::identity(),
            translation: Vector3::z() * self.lattice.origin_nm,
        };
        let count = usize::try_from(last - first + 1).expect("resolve leaves at least two");
        let monomers = self.model.build(&mut self.state, &placement, first, count);
        for k in 0..count {
            let s_nm = self.lattice.s_nm(monomers.index(k));
            let kind = BodyKind::Monomer;
            let frame = Some(monomers.frame(k));
            self.points.push(PointInfo { kind, s_nm, frame });
            self.frames.push(FrameInfo { kind, s_nm });
        }
        let (from, to) = (monomers.first_point, monomers.first_point + count);
        let resolution = Resolution::Ellipsoids {
            first_index: first,
            bonds: 0,
        };
        let frames = monomers.first_frame..monomers.first_frame + count;
        let tips = |end, held: usize, free: [usize; 2]| {
            if self.scene.is_clamped(end) {
                vec![held]
            } else {
                free.to_vec()
            }
        };
        let first_tip = tips(End::Start, from + 1, [from, from + 1]);
        let last_tip = tips(End::End, to - 2, [to - 2, to - 1]);
        self.push_span(i, resolution, (from..to, frames), (first_tip, last_tip));
        self.bodies.push(Body::Monomers(monomers));
    }

    fn push_rod(&mut self, i: usize) -> Result<(), Problem> {
        let Resolved { from_nm, to_nm, .. } = self.resolved[i];
        let segments = self.segments(i)?;
        let length = (to_nm - from_nm) / segments as f64;
        let wall = |end| {
            let at_this_end = i == self.scene.filament.end_index(end);
            at_this_end && self.scene.hold(end) == Some(Hold::Wall)
        };
        let rod = StraightRod {
            start: Vector3::z() * from_nm,
            orientation: UnitQuaternion::identity(),
            segment_lengths: vec![length; segments],
            cross_section: self.cross_section,
            walls: Walls {
                start: wall(End::Start),
                end: wall(End::End),
            },
        };
        let layout = rod.push(&mut self.state).map_err(|error| {
            let key = format!("filament.sections[{i}].segments");
            Problem::new(key, segments, error.to_string())
        })?;
        self.describe_rod(i, &layout, length);
        self.bodies.push(Body::Rod(layout));
        Ok(())
    }

    /// Number of segments of rod section `i`: as written, or as near to the default length as fits.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to lie between 1 and the most bodies"
    )]
    fn segments(&self, i: usize) -> Result<usize, Problem> {
        let Resolved { from_nm, to_nm, .. } = self.resolved[i];
        let written = match self.scene.filament.sections[i] {
            Section::Rod { segments, .. } => segments,
            Section::Ellipsoids { .. } => None,
        };
        let (key, value, count) = if let Some(segments) = written {
            ("segments", segments.to_string(), segments as f64)
        } else {
            let count = ((to_nm - from_nm) / DEFAULT_SEGMENT_NM).round().max(1.0);
            ("to_nm", format!("{to_nm:?}"), count)
        };
        if count <= MOST_BODIES {
            return Ok(count as usize);
        }
        Err(Problem::new(
            format!("filament.sections[{i}].{key}"),
            value,
            format!(
                "{count:.2e} segments are in this section, at most {MOST_BODIES:e} are allowed"
            ),
        ))
    }

    fn describe_rod(&mut self, i: usize, layout: &RodLayout, length: f64) {
        let Resolved { from_nm, to_nm, .. } = self.resolved[i];
        let node = |k: usize| from_nm + k as f64 * length;
        for k in 0..layout.points().len() {
            self.points.push(PointInfo {
                kind: BodyKind::Node,
                s_nm: node(k),
                frame: None,
            });
        }
        let wall = |s_nm| FrameInfo {
            kind: BodyKind::Wall,
            s_nm,
        };
        let walls = [actin_cosserat::RodEnd::Start, actin_cosserat::RodEnd::End]
            .map(|end| layout.wall(end).is_some());
        self.frames.extend(walls[0].then(|| wall(from_nm)));
        self.frames
            .extend((0..layout.segments()).map(|k| FrameInfo {
                kind: BodyKind::Segment,
                s_nm: node(k) + 0.5 * length,
            }));
        self.frames.extend(walls[1].then(|| wall(to_nm)));
        let Range { start, end } = layout.points();
        let resolution = Resolution::Rod { segment_nm: length };
        let bodies = (layout.points(), layout.frames());
        self.push_span(i, resolution, bodies, (vec![start], vec![end - 1]));
    }

    fn push_span(
        &mut self,
        i: usize,
        resolution: Resolution,
        (points, frames): (Range<usize>, Range<usize>),
        (first_tip, last_tip): (Vec<usize>, Vec<usize>),
    ) {
        self.sections.push(SectionSpan {
            resolution,
            from_nm: self.resolved[i].from_nm,
            to_nm: self.resolved[i].to_nm,
            points,
            frames,
            first_tip,
            last_tip,
        });
    }

    /// Number of monomers of section `i` that a junction attaches to.
    fn attached(&self) -> usize {
        self.scene.filament.junction.attached_monomers
    }

    /// Pushes the frames of the junction between section `i` and the next, in filament order.
    fn push_junction_frames(&mut self, i: usize) -> Result<(), Problem> {
        let rise = self.lattice.rise_nm;
        let boundary = self.resolved[i].to_nm;
        let monomers_first = self.resolved[i].monomers.is_some();
        // The monomers stand half a rise from the boundary, then each a rise further.
        let mut distances: Vec<f64> = (0..self.attached())
            .map(|k| (k as f64 + 0.5) * rise)
            .collect();
        if monomers_first {
            distances.reverse();
        }
        let orientation = UnitQuaternion::identity();
        let frames = push_junction_frames(
            &mut self.state,
            orientation,
            &distances,
            &self.cross_section,
        )
        .map_err(|error| junction_problem(&error))?;
        let side = if monomers_first { -0.5 } else { 0.5 };
        self.frames
            .extend(distances.iter().map(|distance| FrameInfo {
                kind: BodyKind::Junction,
                s_nm: boundary + side * distance,
            }));
        self.junction_frames.push(frames);
        Ok(())
    }

    /// Pushes the interactions of all sections and junctions, in filament order.
    fn push_interactions(&mut self) -> Result<(), Problem> {
        let junctions: Vec<Junction> = (1..self.bodies.len())
            .map(|i| self.junction(i - 1))
            .collect::<Result<_, _>>()?;
        let joined =
            |junction: Option<&Junction>| junction.map_or_else(Vec::new, Junction::joined_elements);
        for i in 0..self.bodies.len() {
            let before = i.checked_sub(1).map(|k| &junctions[k]);
            let around = [joined(before), joined(junctions.get(i))];
            if let Some(junction) = before {
                self.push_term(Box::new(junction.clone()), Part::Junction(i - 1));
            }
            let interaction = self.interaction_of(i, &around)?;
            self.push_term(interaction, Part::Section(i));
        }
        Ok(())
    }

    /// The interaction of section `i`, whose start and end the elements `around` join to others.
    fn interaction_of(
        &mut self,
        i: usize,
        around: &[Vec<JoinedElement>; 2],
    ) -> Result<Box<dyn Interaction>, Problem> {
        Ok(match &self.bodies[i] {
            Body::Monomers(monomers) => {
                let bonds = self
                    .model
                    .bonds(monomers)
                    .map_err(|e| models::unbonded(&e, &self.scene.filament.monomers))?;
                if let Resolution::Ellipsoids { bonds: count, .. } =
                    &mut self.sections[i].resolution
                {
                    *count = bonds.number_of_bonds();
                }
                Box::new(bonds)
            }
            Body::Rod(layout) => self.law.interaction(layout, around),
        })
    }

    /// The junction between section `i` and the next.
    fn junction(&self, i: usize) -> Result<Junction, Problem> {
        let n = self.attached();
        let attach = |monomers: &Monomers, from: usize| -> Vec<AttachedMonomer> {
            (from..from + n)
                .map(|k| AttachedMonomer {
                    point: monomers.point(k),
                    frame: monomers.frame(k),
                })
                .collect()
        };
        let (side, attached, layout) = match (&self.bodies[i], &self.bodies[i + 1]) {
            (Body::Monomers(m), Body::Rod(layout)) => {
                (JunctionSide::MonomersFirst, attach(m, m.count - n), layout)
            }
            (Body::Rod(layout), Body::Monomers(m)) => {
                (JunctionSide::RodFirst, attach(m, 0), layout)
            }
            _ => unreachable!("validation refuses neighbouring sections of one kind"),
        };
        let weight = self.scene.filament.junction.weight.into();
        let frames = self.junction_frames[i].clone();
        Junction::new(
            &self.state,
            (side, weight),
            &attached,
            frames,
            layout,
            self.law.material,
        )
        .map_err(|error| junction_problem(&error))
    }

    fn push_term(&mut self, interaction: Box<dyn Interaction>, part: Part) {
        let name = interaction.term();
        self.terms.push(Term { name, part });
        self.interactions.push(interaction);
    }

    fn push_loads(&mut self) {
        for (i, load) in self.scene.loads.iter().enumerate() {
            let Load::EndForce { end, force_pn } = load;
            let section = self.scene.filament.end_index(*end);
            let points = self.sections[section].tip_points(*end);
            let share = 1.0 / points.len() as f64;
            let shares = points.iter().map(|&point| (point, share)).collect();
            let control = self.state.controls.len();
            self.state.controls.push(1.0);
            let load = PointLoad::new(&self.state, shares, (*force_pn).into(), control);
            self.push_term(Box::new(load), Part::Load(i));
        }
    }

    fn finish(mut self) -> Assembly {
        let mut scene = self.scene.clone();
        for (section, span) in scene.filament.sections.iter_mut().zip(&self.sections) {
            if let Section::Rod { segments, .. } = section {
                *segments = Some(span.frames.len());
            }
        }
        let spans = self.spans();
        let rods = self
            .bodies
            .iter()
            .enumerate()
            .filter_map(|(section, body)| match body {
                Body::Monomers(_) => None,
                Body::Rod(layout) => Some((section, layout.clone())),
            });
        let rods = rods.collect();
        let drive = Drive::new(&scene, &self.clamps, &self.state);
        drive.place(&mut self.state, 0.0);
        Assembly {
            drive,
            scene,
            rest: self.state.clone(),
            system: System::new(self.state, self.interactions),
            terms: self.terms,
            points: self.points,
            frames: self.frames,
            sections: self.sections,
            twist_range: self.law.twist_range(),
            bend_range: self.law.material.bend().range(),
            rods,
            clamps: self.clamps,
            linkers: self.linkers,
            spans,
        }
    }
}

fn junction_problem(error: &actin_coupling::JunctionError) -> Problem {
    Problem::new("filament.junction", "", error.to_string())
}
