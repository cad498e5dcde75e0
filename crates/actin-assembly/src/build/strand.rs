//! Filament under construction: bodies and interactions, section by section.

use super::SceneParts;
use crate::built_axis::BuiltAxis;
use crate::lattice::{Lattice, ResolvedSection, resolve};
use crate::scene::{
    Clamp, End, Filament, Hinge, Hold, MAX_EXACT_INTEGER, RodLaw, SceneProblem, Section,
};
use crate::whole::to_count;
use crate::{BodyKind, FilamentSpan, FrameInfo, PointInfo, Resolution, SectionSpan};
use crate::{law, models, problem_at};
use actin_cosserat::{CrossSection, EndShear, RodLayout, StraightRod, Walls};
use actin_coupling::push_junction_frames;
use actin_ellipsoid::{EllipsoidModel, Monomers, Placement};
use actin_mechanics::{Frame, UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

/// Upper bound of the angle (rad) between neighbouring segments of filaments as built and at rest.
const LARGEST_ANGLE: f64 = FRAC_PI_2;

const DEFAULT_SEGMENT_NM: f64 = 10.0;

pub(super) enum Body {
    Monomers(Monomers),
    Rod(RodLayout),
}

/// Filament under construction. Errors name its keys as keys of `filament`.
pub(super) struct Strand<'a> {
    pub(super) index: usize,
    pub(super) filament: &'a Filament,
    /// Holds of start and end; `None` for a free end.
    holds: [Option<Hold>; 2],
    pub(super) hinges: [Option<Hinge>; 2],
    pub(super) hinge_frames: [Option<usize>; 2],
    /// Arc lengths of couples (nm).
    couples_nm: Vec<f64>,
    is_heated: bool,
    pub(super) first_section: usize,
    /// Position of arc length 0 and rotation from lab +z.
    pub(super) placement: Placement,
    pub(super) built: Option<BuiltAxis>,
    pub(super) resolved: Vec<ResolvedSection>,
    /// Number of segments of each section; 0 for monomers.
    pub(super) segments: Vec<usize>,
    pub(super) lattice: Lattice,
    /// Monomer model of each section; for a rod, the model of the monomers that it represents.
    pub(super) models: Vec<EllipsoidModel>,
    /// Law of each section; for monomers, the law of the rod that represents them.
    pub(super) laws: Vec<law::Law>,
    cross_section: CrossSection,
    pub(super) bodies: Vec<Body>,
    pub(super) junction_frames: Vec<Range<usize>>,
}

impl<'a> Strand<'a> {
    /// Creates filament `index` of a scene with the holds of its ends and the arc lengths of
    /// couples (nm). `first_section` is the number of sections of earlier filaments.
    pub(super) fn new(
        (index, filament): (usize, &'a Filament),
        (clamps, couples_nm): ([Option<&Clamp>; 2], Vec<f64>),
        first_section: usize,
        bath_k: Option<f64>,
    ) -> Result<Self, SceneProblem> {
        let monomers = &filament.monomers;
        let density = monomers.mass_ag / monomers.rise_nm;
        let area = actin_cosserat::constants::CROSS_SECTION_AREA;
        let holds = clamps.map(|clamp| clamp.map(|c| c.hold));
        let is_held = holds.map(|hold| hold.is_some());
        let resolved = resolve(filament, is_held)?;
        let segments = segments(filament, &resolved)?;
        let laws = laws(filament, (&resolved, &segments), bath_k)?;
        Ok(Self {
            index,
            filament,
            holds,
            hinges: clamps.map(|clamp| clamp.and_then(|c| c.hinge)),
            hinge_frames: [None; 2],
            couples_nm,
            is_heated: bath_k.is_some(),
            first_section,
            placement: Placement {
                rotation: filament.rotation(),
                translation: filament.at_nm.into(),
            },
            built: None,
            resolved,
            segments,
            lattice: Lattice::new(filament, is_held),
            models: (filament.sections.iter())
                .map(|section| models::ellipsoids(&section.monomers(monomers), index))
                .collect::<Result<_, _>>()?,
            laws,
            cross_section: CrossSection::new(density, area).map_err(|error| {
                let rule = format!("the mass per length that follows must be {}", error.rule);
                SceneProblem::new("filament.monomers.mass_ag", error.value, rule)
            })?,
            bodies: Vec::new(),
            junction_frames: Vec::new(),
        })
    }

    /// Position of the axis at arc length `s_nm` as built (nm, lab frame).
    pub(super) fn axis_at(&self, s_nm: f64) -> Vector3 {
        self.place(Vector3::z() * s_nm)
    }

    /// Maps a position relative to the straight filament along +z to this filament (nm, lab frame).
    pub(super) fn place(&self, of_straight: Vector3) -> Vector3 {
        let own = self.built.as_ref().map_or(of_straight, |built| {
            let (place, frame) = built.at(of_straight.z);
            place + frame * Vector3::new(of_straight.x, of_straight.y, 0.0)
        });
        self.placement.translation + self.placement.rotation * own
    }

    pub(super) fn end_nm(&self, end: End) -> f64 {
        let section = &self.resolved[self.filament.end_index(end)];
        match end {
            End::Start => section.from_nm,
            End::End => section.to_nm,
        }
    }

    pub(super) fn frame_at(&self, s_nm: f64) -> UnitQuaternion {
        let rotation = self.placement.rotation;
        let built = self.built.as_ref();
        built.map_or(rotation, |built| rotation * built.at(s_nm).1)
    }

    pub(super) fn tangent_at(&self, s_nm: f64) -> Vector3 {
        match self.built {
            None => self.filament.axis(),
            Some(_) => self.frame_at(s_nm) * Vector3::z(),
        }
    }

    pub(super) fn push_bodies(
        &mut self,
        stock: &mut SceneParts,
    ) -> Result<FilamentSpan, SceneProblem> {
        let first = (stock.points.len(), stock.frames.len());
        while self.bodies.len() < self.filament.sections.len() {
            self.push_section(self.bodies.len(), stock)?;
        }
        Ok(FilamentSpan {
            sections: self.first_section..stock.sections.len(),
            points: first.0..stock.points.len(),
            frames: first.1..stock.frames.len(),
            terms: 0..0,
            origin_nm: self.placement.translation,
            rotation: self.placement.rotation,
            shape: None,
        })
    }

    /// Pushes the junction to the section before and the bodies of section `i`. A rod includes all
    /// rods that follow it.
    fn push_section(&mut self, i: usize, stock: &mut SceneParts) -> Result<(), SceneProblem> {
        if i > 0 && self.is_junction(i - 1) {
            self.push_junction_frames(i - 1, stock)?;
        } else if i > 0 {
            self.junction_frames.push(0..0);
        }
        match self.resolved[i].monomers {
            Some((first, last)) => self.push_monomers(i, (first, last), stock),
            None => self.push_rods(i, stock),
        }
    }

    fn push_monomers(
        &mut self,
        i: usize,
        (first, last): (i64, i64),
        stock: &mut SceneParts,
    ) -> Result<(), SceneProblem> {
        let placement = Placement {
            translation: self.axis_at(self.lattice.origin_nm),
            ..self.placement
        };
        let count = usize::try_from(last - first + 1).expect("resolve leaves at least two");
        // The rest twist is added to the helix of the filament by `bend`.
        let model = self.models[i].with_turn(self.filament.monomers.turn_deg.to_radians());
        let built = model.build(&mut stock.state, &placement, first, count);
        let monomers = built
            .map_err(|error| SceneProblem::new("filament.sections", last, error.to_string()))?;
        for k in 0..count {
            let s_nm = self.lattice.s_nm(monomers.index(k));
            let kind = BodyKind::Monomer;
            let frame = Some(monomers.frame(k));
            stock.points.push(PointInfo { kind, s_nm, frame });
            stock.frames.push(FrameInfo { kind, s_nm });
        }
        let (from, to) = (monomers.first_point, monomers.first_point + count);
        let resolution = Resolution::Ellipsoids {
            first_index: first,
            bonds: 0,
        };
        let frames = monomers.first_frame..monomers.first_frame + count;
        let is_held = self.holds.map(|hold| hold.is_some());
        let tips = [
            if is_held[0] {
                from + 1..from + 2
            } else {
                from..from + 2
            },
            if is_held[1] {
                to - 2..to - 1
            } else {
                to - 2..to
            },
        ];
        let bodies = (from..to, frames);
        self.push_span(i, resolution, bodies, tips, stock);
        self.bodies.push(Body::Monomers(monomers));
        Ok(())
    }

    /// Pushes section `first` and all rods that follow it, which share nodes and cross-sections.
    fn push_rods(&mut self, first: usize, stock: &mut SceneParts) -> Result<(), SceneProblem> {
        let rods = self.resolved[first..].iter();
        let past = first + rods.take_while(|r| r.monomers.is_none()).count();
        let segments = self.segments[first..past].to_vec();
        let length = |i: usize| self.resolved[i].length_nm() / self.segments[i] as f64;
        for i in first..past {
            let angle = self.laws[i].material.rest_curvature().norm() * length(i);
            check_angle(i, self.segments[i], angle)?;
        }
        let spacing: Vec<f64> = (first..past).map(length).collect();
        let rod = self.straight_rod([first, past], &segments, &spacing);
        let from_nm = self.resolved[first].from_nm;
        self.push_hinge_frame(first, End::Start, (from_nm, spacing[0]), stock);
        let layouts = rod
            .push_in_parts(&segments, &mut stock.state)
            .map_err(|error| {
                let key = format!("filament.sections[{first}].segments");
                SceneProblem::new(key, segments[0], error.to_string())
            })?;
        for ((i, layout), &length) in (first..past).zip(layouts).zip(&spacing) {
            self.describe_rod(i, &layout, length, stock);
            let to_nm = self.resolved[i].to_nm;
            self.push_hinge_frame(i, End::End, (to_nm, length), stock);
            self.bodies.push(Body::Rod(layout));
        }
        self.junction_frames.extend((first + 1..past).map(|_| 0..0));
        Ok(())
    }

    fn straight_rod(
        &self,
        [first, past]: [usize; 2],
        segments: &[usize],
        spacing: &[f64],
    ) -> StraightRod {
        let lengths = spacing.iter().zip(segments);
        let lengths = lengths.map(|(&length, &count)| std::iter::repeat_n(length, count));
        let is_at = |i, end| i == self.filament.end_index(end);
        let wall = |i, end| {
            let hold = self.holds[end as usize];
            is_at(i, end) && (hold == Some(Hold::Wall) || self.hinges[end as usize].is_some())
        };
        // A couple at the end acts through the half segment of this frame. In heat this half bends and twists. Without
        // the frame it would follow the adjacent joint, which would be 1.5 times too stiff under laws of the mean curvature.
        let fluctuates = |i: usize| {
            let section = &self.filament.sections[i];
            self.is_heated && section.rod_model(&self.filament.rod).law != RodLaw::Constant
        };
        let free_wall = |i, end, length: f64| {
            let turns = matches!(self.holds[end as usize], None | Some(Hold::Pin));
            let outer = |s_nm: &f64| (s_nm - self.end_nm(end)).abs() < 0.5 * length;
            is_at(i, end) && turns && (fluctuates(i) || self.couples_nm.iter().any(outer))
        };
        StraightRod {
            start: self.axis_at(self.resolved[first].from_nm),
            orientation: self.placement.rotation,
            segment_lengths: lengths.flatten().collect(),
            cross_section: self.cross_section,
            rotary_inertia: self.filament.rod.rotary_inertia,
            walls: Walls {
                start: wall(first, End::Start),
                end: wall(past - 1, End::End),
            },
            free_walls: Walls {
                start: free_wall(first, End::Start, spacing[0]),
                end: free_wall(past - 1, End::End, spacing[spacing.len() - 1]),
            },
        }
    }

    /// First and last section of the run of rods that contains section `i`; `[i, i]` for monomers.
    pub(super) fn run_of(&self, i: usize) -> [usize; 2] {
        let before = (0..i).rev().take_while(|&k| self.is_joint(k)).count();
        let behind = (i..self.resolved.len()).take_while(|&k| self.is_joint(k));
        [i - before, i + behind.count()]
    }

    /// Distances from the ends of rod `i` to the ends of rods `first` to `last` (nm).
    pub(super) fn beyond_nm(&self, i: usize, [first, last]: [usize; 2]) -> [f64; 2] {
        let all = &self.resolved;
        [
            all[i].from_nm - all[first].from_nm,
            all[last].to_nm - all[i].to_nm,
        ]
    }

    /// End conditions of shear for rods `first` to `last`. A junction prevents shear like a wall;
    /// the rod compensates for this.
    pub(super) fn end_shear(&self, run: [usize; 2]) -> [EndShear; 2] {
        [End::Start, End::End].map(|end| {
            let i = run[end as usize];
            // A pinned end rotates freely.
            let is_held = self.holds[end as usize].is_some_and(|hold| hold != Hold::Pin);
            if i == self.filament.end_index(end) {
                if is_held {
                    EndShear::Blocked
                } else {
                    EndShear::Loose
                }
            } else if self.is_junction(if end == End::Start { i - 1 } else { i }) {
                EndShear::Loose
            } else {
                EndShear::Even
            }
        })
    }

    /// Pushes the held frame of a hinge if section `i` has one at an end, at arc length `s_nm`.
    /// `length` of the adjacent segment sets its size.
    fn push_hinge_frame(
        &mut self,
        i: usize,
        end: End,
        (s_nm, length): (f64, f64),
        stock: &mut SceneParts,
    ) {
        if i != self.filament.end_index(end) || self.hinges[end as usize].is_none() {
            return;
        }
        let frame = stock.state.frames.push(Frame {
            orientation: self.placement.rotation,
            inertia: self.cross_section.segment_inertia(length),
        });
        stock.state.frames.hold(frame);
        let kind = BodyKind::Wall;
        stock.frames.push(FrameInfo { kind, s_nm });
        self.hinge_frames[end as usize] = Some(frame);
    }

    fn describe_rod(&self, i: usize, layout: &RodLayout, length: f64, stock: &mut SceneParts) {
        let ResolvedSection { from_nm, to_nm, .. } = self.resolved[i];
        let node = |k: usize| from_nm + k as f64 * length;
        // The node and cross-section shared with a preceding rod already exist.
        let goes_on = [i.checked_sub(1), Some(i)].map(|k| k.is_some_and(|k| self.is_joint(k)));
        for k in usize::from(goes_on[0])..layout.points().len() {
            stock.points.push(PointInfo {
                kind: BodyKind::Node,
                s_nm: node(k),
                frame: None,
            });
        }
        let kinds = [BodyKind::Wall, BodyKind::Joint];
        let wall = |s_nm, is_joint: bool| FrameInfo {
            kind: kinds[usize::from(is_joint)],
            s_nm,
        };
        let walls = [End::Start, End::End].map(|end| layout.wall(end).is_some());
        let is_new = walls[0] && !goes_on[0];
        stock.frames.extend(is_new.then(|| wall(from_nm, false)));
        stock
            .frames
            .extend((0..layout.segments()).map(|k| FrameInfo {
                kind: BodyKind::Segment,
                s_nm: node(k) + 0.5 * length,
            }));
        (stock.frames).extend(walls[1].then(|| wall(to_nm, goes_on[1])));
        let Range { start, end } = layout.points();
        let resolution = Resolution::Rod { segment_nm: length };
        let bodies = (layout.points(), layout.frames());
        let tips = [start..start + 1, end - 1..end];
        self.push_span(i, resolution, bodies, tips, stock);
    }

    fn push_span(
        &self,
        i: usize,
        resolution: Resolution,
        (points, frames): (Range<usize>, Range<usize>),
        tips: [Range<usize>; 2],
        stock: &mut SceneParts,
    ) {
        stock.sections.push(SectionSpan {
            resolution,
            from_nm: self.resolved[i].from_nm,
            to_nm: self.resolved[i].to_nm,
            points,
            frames,
            tips,
        });
    }

    /// Returns `true` if section `i` and the next have different resolutions. Neighbouring monomers
    /// are bonded.
    pub(super) fn is_junction(&self, i: usize) -> bool {
        let sections = self.resolved.get(i).zip(self.resolved.get(i + 1));
        sections.is_some_and(|(a, b)| a.monomers.is_some() != b.monomers.is_some())
    }

    fn is_joint(&self, i: usize) -> bool {
        let is_rod = |r: &ResolvedSection| r.monomers.is_none();
        let rods = self.resolved[i..].iter().take(2).filter(|r| is_rod(r));
        rods.count() == 2
    }

    /// Monomers of section `i` and the monomers of the next section to which they are bonded.
    pub(super) fn bonded_run(&self, i: usize, own: &Monomers) -> Monomers {
        let goes_on = i + 1 < self.resolved.len() && !self.is_junction(i);
        Monomers {
            // Range of the longitudinal interface.
            count: own.count + if goes_on { 2 } else { 0 },
            ..*own
        }
    }

    /// Turn per monomer (rad) of section `i` and of the next section.
    pub(super) fn turns(&self, i: usize) -> [f64; 2] {
        [i, i + 1].map(|k| {
            let model = self.models.get(k).unwrap_or(&self.models[i]);
            model.parameters().turn
        })
    }

    pub(super) fn attached(&self) -> usize {
        self.filament.junction.attached_monomers
    }

    fn push_junction_frames(
        &mut self,
        i: usize,
        stock: &mut SceneParts,
    ) -> Result<(), SceneProblem> {
        let rise = self.lattice.rise_nm;
        let boundary = self.resolved[i].to_nm;
        let monomers_first = self.resolved[i].monomers.is_some();
        // Monomers lie half a rise from the boundary and then one rise apart.
        let mut distances: Vec<f64> = (0..self.attached())
            .map(|k| (k as f64 + 0.5) * rise)
            .collect();
        if monomers_first {
            distances.reverse();
        }
        let orientation = self.placement.rotation;
        let frames = push_junction_frames(
            &mut stock.state,
            orientation,
            &distances,
            &self.cross_section,
        )
        .map_err(problem_at("filament.junction"))?;
        let side = if monomers_first { -0.5 } else { 0.5 };
        stock
            .frames
            .extend(distances.iter().map(|distance| FrameInfo {
                kind: BodyKind::Junction,
                s_nm: boundary + side * distance,
            }));
        self.junction_frames.push(frames);
        Ok(())
    }
}

/// Number of segments of each section; 0 for monomers.
fn segments(filament: &Filament, resolved: &[ResolvedSection]) -> Result<Vec<usize>, SceneProblem> {
    let sections = filament.sections.iter().zip(resolved).enumerate();
    let counts = sections.map(|(i, (section, place))| match section {
        Section::Rod { segments, .. } => segments_of_rod(i, *segments, place),
        Section::Ellipsoids { .. } => Ok(0),
    });
    counts.collect()
}

/// Number of segments of rod section `i`, as `written` in the scene or by default.
fn segments_of_rod(
    i: usize,
    written: Option<usize>,
    place: &ResolvedSection,
) -> Result<usize, SceneProblem> {
    let (key, value, count) = if let Some(segments) = written {
        ("segments", segments.to_string(), segments as f64)
    } else {
        let count = (place.length_nm() / DEFAULT_SEGMENT_NM).round().max(1.0);
        ("to_nm", format!("{:?}", place.to_nm), count)
    };
    if count <= MAX_EXACT_INTEGER {
        return Ok(to_count(count));
    }
    Err(SceneProblem::new(
        format!("filament.sections[{i}].{key}"),
        value,
        format!("{count:.2e} segments in this section are more than can be counted"),
    ))
}

/// Law of each section. `heated` contains the numbers of segments in a heat bath.
fn laws(
    filament: &Filament,
    (resolved, segments): (&[ResolvedSection], &[usize]),
    bath_k: Option<f64>,
) -> Result<Vec<law::Law>, SceneProblem> {
    let sections = filament.sections.iter().zip(resolved).enumerate();
    let laws = sections.map(|(i, (section, place))| {
        let bath_k = bath_k.filter(|_| segments[i] > 0);
        let heated = bath_k.map(|temperature_k| law::HeatedSegments {
            segment_nm: place.length_nm() / segments[i] as f64,
            temperature_k,
        });
        law::Law::of_section((i, section), filament, heated)
    });
    laws.collect()
}

pub(super) fn check_angle(i: usize, segments: usize, angle: f64) -> Result<(), SceneProblem> {
    if angle < LARGEST_ANGLE {
        return Ok(());
    }
    let rule = format!(
        "the angle between neighbouring segments would be {:.0} deg: use more segments, for less than {:.0} deg",
        angle.to_degrees(),
        LARGEST_ANGLE.to_degrees()
    );
    let key = format!("filament.sections[{i}].segments");
    Err(SceneProblem::new(key, segments, rule))
}
