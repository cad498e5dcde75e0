//! Arrangements of filaments: copies, random networks and bundles.

use super::rules::show;
use super::{Filament, PeriodicBox, Repulsion, SceneProblem, Section};
use actin_coupling::repulsion::Wall;
use actin_mechanics::{Vector3, segments};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

const MOST_FILAMENTS: usize = 100_000;

/// Largest number of trials to place a filament.
const MOST_TRIALS: usize = 1000;

/// Largest difference between length and distance of the ends of straight filaments, relative to the length.
const STRAIGHT: f64 = 1e-9;

/// Number of sides of the polygon for the axis of a curved filament.
const PARTS: u32 = 100;

/// Placement of many filaments. The arranged filaments follow the listed ones, in the order of the arrangements.
///
/// The resolved scene lists each filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) enum Arrangement {
    /// Copies of a filament at equal displacements.
    Copies {
        /// The first copy.
        filament: Filament,
        /// Number of copies; from 1 to 100,000.
        count: usize,
        /// Displacement from one copy to the next (lab frame); finite, not zero.
        shift_nm: [f64; 3],
    },
    /// Filaments with uniformly distributed midpoints in a box and random rotations about their axes, within the walls
    /// of `repulsion`.
    Random {
        /// Filament to place. Its `at_nm` is ignored; its `direction` is used for parallel orientations.
        filament: Filament,
        /// Number of filaments; from 1 to 100,000.
        count: usize,
        /// Edges of the box along x, y and z; at least 0. Ends of filaments may lie outside the box.
        box_nm: [f64; 3],
        /// Centre of the box (lab frame); finite.
        #[serde(default)]
        centre_nm: [f64; 3],
        /// Distribution of directions.
        #[serde(default)]
        orientation: Orientation,
        /// Bounds of uniformly distributed lengths; positive, in ascending order. Requires a filament of one section.
        /// By default all filaments have the length of `filament`.
        #[serde(default)]
        lengths_nm: Option<[f64; 2]>,
        /// Smallest distance to the axes of all preceding filaments and periodic images; at least 0. By default the contact distance if
        /// filaments repel each other, otherwise 0.
        #[serde(default)]
        apart_nm: Option<f64>,
        /// Seed of places, directions and lengths.
        seed: u64,
    },
    /// Parallel filaments on a hexagonal lattice, filled from its centre outwards.
    Bundle {
        /// The central filament.
        filament: Filament,
        /// Number of filaments; from 1 to 100,000. 7, 19 and 37 are complete hexagons.
        count: usize,
        /// Distance between neighbouring axes; positive.
        spacing_nm: f64,
        /// Largest displacement along the axis; at least 0. Displacements are uniform between 0 and this value.
        #[serde(default)]
        stagger_nm: f64,
        /// True if the direction of each filament is reversed with probability one half.
        #[serde(default)]
        mixed_polarity: bool,
        /// Seed of displacements and polarities.
        #[serde(default)]
        seed: u64,
    },
}

/// Distribution of the directions of filaments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) enum Orientation {
    /// Uniform on the sphere.
    #[default]
    Isotropic,
    /// Uniform in the plane of x and y.
    Planar,
    /// The `direction` of the filament.
    Parallel,
    /// The `direction` of the filament or its opposite, with equal probability.
    Antiparallel,
}

impl Arrangement {
    /// Returns the filament to place.
    pub(crate) fn filament(&self) -> &Filament {
        match self {
            Self::Copies { filament, .. }
            | Self::Random { filament, .. }
            | Self::Bundle { filament, .. } => filament,
        }
    }

    /// Number of filaments.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Copies { count, .. }
            | Self::Random { count, .. }
            | Self::Bundle { count, .. } => *count,
        }
    }

    /// Returns the filaments of arrangement `k` of a scene with the `preceding` filaments, repulsion and periodic
    /// box, whose numbers are within their ranges.
    ///
    /// # Errors
    /// If a number is out of its range, or a filament finds no place.
    pub(super) fn filaments(
        &self,
        k: usize,
        preceding: &[Filament],
        surroundings: (Option<&Repulsion>, Option<&PeriodicBox>),
    ) -> Result<Vec<Filament>, SceneProblem> {
        self.check(k)?;
        Ok(match self {
            Self::Copies {
                filament,
                count,
                shift_nm,
            } => copies(filament, *count, Vector3::from(*shift_nm)),
            Self::Random {
                count,
                seed,
                apart_nm,
                ..
            } => {
                let mut random = ChaCha8Rng::seed_from_u64(*seed);
                let free = FreeSpace::new(*apart_nm, surroundings);
                let mut axes: Vec<_> = preceding.iter().map(FilamentAxis::new).collect();
                let mut place = |_| self.place(&mut axes, &free, &mut random);
                let placed: Result<Vec<Filament>, Obstacle> = (0..*count).map(&mut place).collect();
                return placed.map_err(|obstacle| self.no_room(k, obstacle, free.apart));
            }
            Self::Bundle { filament, seed, .. } => {
                self.bundle(filament, ChaCha8Rng::seed_from_u64(*seed))
            }
        })
    }

    fn check(&self, k: usize) -> Result<(), SceneProblem> {
        let key = |name: &str| format!("arrangements[{k}].{name}");
        let count = self.count();
        if !(1..=MOST_FILAMENTS).contains(&count) {
            let rule = format!("must be from 1 to {MOST_FILAMENTS}");
            return Err(SceneProblem::new(key("count"), count, rule));
        }
        match self {
            Self::Random {
                lengths_nm: Some(lengths),
                filament,
                ..
            } => check_lengths(&key("lengths_nm"), *lengths, filament),
            _ => Ok(()),
        }
    }

    /// Returns a random filament in the free space between the given axes and adds its axis.
    ///
    /// # Errors
    /// After too many trials.
    fn place(
        &self,
        axes: &mut Vec<FilamentAxis>,
        free: &FreeSpace<'_>,
        random: &mut ChaCha8Rng,
    ) -> Result<Filament, Obstacle> {
        // The length does not depend on the trials, which short filaments pass more often.
        let built = self.of_random_length(self.filament().clone(), random);
        let mut obstacle = Obstacle::Walls;
        for _ in 0..MOST_TRIALS {
            let filament = self.random(built.clone(), random);
            let axis = FilamentAxis::new(&filament);
            if !free.is_within_walls(&axis) {
                continue;
            }
            if free.is_apart(&axis, axes) {
                axes.push(axis);
                return Ok(filament);
            }
            obstacle = Obstacle::Filaments;
        }
        Err(obstacle)
    }

    fn no_room(&self, k: usize, obstacle: Obstacle, apart: f64) -> SceneProblem {
        let count = self.count();
        let (key, value, reason) = match (obstacle, self) {
            (Obstacle::Walls, Self::Random { box_nm, .. }) => (
                "box_nm",
                show(box_nm),
                "within the walls of `repulsion`: change box_nm, centre_nm or orientation, or enlarge the walls",
            ),
            _ => (
                "apart_nm",
                show(apart),
                "at this distance: increase box_nm or reduce count or apart_nm",
            ),
        };
        let rule = format!(
            "found no room for {count} filaments in {MOST_TRIALS} trials per filament {reason}"
        );
        SceneProblem::new(format!("arrangements[{k}].{key}"), value, rule)
    }

    fn of_random_length(&self, mut filament: Filament, random: &mut ChaCha8Rng) -> Filament {
        if let Self::Random {
            lengths_nm: Some([low, high]),
            ..
        } = self
            && let Some(last) = filament.sections.last_mut()
        {
            last.end_at(low + (high - low) * unit(random));
        }
        filament
    }

    fn random(&self, mut filament: Filament, random: &mut ChaCha8Rng) -> Filament {
        let Self::Random {
            box_nm,
            centre_nm,
            orientation,
            ..
        } = self
        else {
            return filament;
        };
        filament.direction = orientation.draw(&filament, random).into();
        filament.roll_deg = 360.0 * unit(random);
        filament.at_nm = [0.0; 3];
        let midpoint = filament.place_at(0.5 * filament.length_nm());
        let place = Vector3::from_fn(|i, _| centre_nm[i] + box_nm[i] * (unit(random) - 0.5));
        filament.at_nm = (place - midpoint).into();
        filament
    }

    fn bundle(&self, filament: &Filament, mut random: ChaCha8Rng) -> Vec<Filament> {
        let Self::Bundle {
            count,
            spacing_nm,
            stagger_nm,
            mixed_polarity,
            ..
        } = self
        else {
            return Vec::new();
        };
        let (axis, turn) = (filament.axis(), filament.rotation());
        let length = filament.length_nm();
        let place = |lattice: [f64; 2]| {
            let mut one = filament.clone();
            let across = turn * Vector3::new(lattice[0], lattice[1], 0.0) * *spacing_nm;
            let along = axis * (*stagger_nm * unit(&mut random));
            let mut at = Vector3::from(filament.at_nm) + across + along;
            if *mixed_polarity && unit(&mut random) < 0.5 {
                one.direction = one.direction.map(|x| -x);
                at += axis * length;
            }
            one.at_nm = at.into();
            one
        };
        hexagonal(*count).into_iter().map(place).collect()
    }
}

/// Reason why trials failed.
#[derive(Clone, Copy, Debug)]
enum Obstacle {
    Walls,
    Filaments,
}

/// Space for random filaments.
struct FreeSpace<'a> {
    periodic: Option<&'a PeriodicBox>,
    /// Smallest distance of axes (nm).
    apart: f64,
    walls: Vec<Wall>,
    /// Smallest distance of axes from walls (nm).
    radius: f64,
}

impl<'a> FreeSpace<'a> {
    fn new(
        apart_nm: Option<f64>,
        (repulsion, periodic): (Option<&Repulsion>, Option<&'a PeriodicBox>),
    ) -> Self {
        let walls = repulsion.and_then(|repulsion| repulsion.walls().ok());
        let walls = walls.into_iter().flatten();
        Self {
            periodic,
            apart: apart_nm
                .or(repulsion.map(Repulsion::contact_nm))
                .unwrap_or(0.0),
            walls: walls.map(|(_, wall)| wall).collect(),
            radius: repulsion.map_or(0.0, |repulsion| repulsion.radius_nm),
        }
    }

    fn is_within_walls(&self, axis: &FilamentAxis) -> bool {
        let is_beside = |wall: &Wall| axis.sides().all(|side| wall.nearest(side).1 >= self.radius);
        self.walls.iter().all(is_beside)
    }

    /// Returns whether an axis is at a distance from other axes and all images.
    fn is_apart(&self, axis: &FilamentAxis, others: &[FilamentAxis]) -> bool {
        let is_apart = |other: &FilamentAxis, shift: &Vector3| {
            axis.is_apart(&other.shifted(*shift), self.apart)
        };
        let own = self.shifts(axis, axis).into_iter();
        self.apart <= 0.0
            || own
                .filter(|shift| *shift != Vector3::zeros())
                .all(|shift| is_apart(axis, &shift))
                && others.iter().all(|other| {
                    let mut shifts = self.shifts(axis, other).into_iter();
                    shifts.all(|shift| is_apart(other, &shift))
                })
    }

    /// Returns the displacements (nm) of an axis and its images that may be too close to another axis.
    fn shifts(&self, axis: &FilamentAxis, other: &FilamentAxis) -> Vec<Vector3> {
        let reach = axis.radius + other.radius + self.apart;
        self.periodic.map_or_else(
            || vec![Vector3::zeros()],
            |periodic| periodic.shifts_within(other.centre - axis.centre, reach),
        )
    }
}

/// Axis of a filament as built: a polygon and a sphere around it.
struct FilamentAxis {
    corners: Vec<Vector3>,
    centre: Vector3,
    radius: f64,
}

impl FilamentAxis {
    fn new(filament: &Filament) -> Self {
        let length = filament.length_nm();
        let ends = filament.places_at(&[0.0, 0.5 * length, length]);
        let is_straight = (ends[0] - ends[2]).norm() > (1.0 - STRAIGHT) * length;
        let corners = if is_straight {
            vec![ends[0], ends[2]]
        } else {
            let places = (0..=PARTS).map(|i| length * f64::from(i) / f64::from(PARTS));
            filament.places_at(&places.collect::<Vec<_>>())
        };
        let distances = corners.iter().map(|corner| (corner - ends[1]).norm());
        Self {
            radius: distances.fold(0.0, f64::max),
            centre: ends[1],
            corners,
        }
    }

    fn is_apart(&self, other: &Self, distance: f64) -> bool {
        let least = (self.centre - other.centre).norm() - self.radius - other.radius;
        least >= distance
            || self.sides().all(|a| {
                let mut others = other.sides();
                others.all(|b| segments::nearest_points(a, b).squared >= distance * distance)
            })
    }

    fn shifted(&self, shift: Vector3) -> Self {
        Self {
            corners: self.corners.iter().map(|corner| corner + shift).collect(),
            centre: self.centre + shift,
            radius: self.radius,
        }
    }

    fn sides(&self) -> impl Iterator<Item = [Vector3; 2]> {
        self.corners.windows(2).map(|pair| [pair[0], pair[1]])
    }
}

fn copies(filament: &Filament, count: usize, shift: Vector3) -> Vec<Filament> {
    let copy = |i: usize| {
        let at = Vector3::from(filament.at_nm) + shift * i as f64;
        Filament {
            at_nm: at.into(),
            ..filament.clone()
        }
    };
    (0..count).map(copy).collect()
}

fn check_lengths(key: &str, lengths: [f64; 2], filament: &Filament) -> Result<(), SceneProblem> {
    if lengths[0] > lengths[1] {
        let rule = "must be in ascending order";
        return Err(SceneProblem::new(key, show(lengths), rule));
    }
    if filament.sections.len() != 1 {
        let rule = "requires a filament of one section";
        return Err(SceneProblem::new(key, show(lengths), rule));
    }
    Ok(())
}

impl Orientation {
    fn draw(self, filament: &Filament, random: &mut ChaCha8Rng) -> Vector3 {
        match self {
            Self::Isotropic => {
                let (z, azimuth) = (2.0 * unit(random) - 1.0, TAU * unit(random));
                let across = (1.0 - z * z).sqrt();
                Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
            }
            Self::Planar => {
                let azimuth = TAU * unit(random);
                Vector3::new(azimuth.cos(), azimuth.sin(), 0.0)
            }
            Self::Parallel => filament.axis(),
            Self::Antiparallel => filament.axis() * if unit(random) < 0.5 { -1.0 } else { 1.0 },
        }
    }
}

fn unit(random: &mut impl Rng) -> f64 {
    random.random()
}

/// Returns the points of a unit hexagonal lattice closest to the origin, sorted by distance and azimuth.
fn hexagonal(count: usize) -> Vec<[f64; 2]> {
    let holds = |rings: i32| 1 + 3 * i64::from(rings) * i64::from(rings + 1);
    let mut rings = 0;
    while usize::try_from(holds(rings)).is_ok_and(|held| held < count) {
        rings += 1;
    }
    let rows = -rings..=rings;
    let places = rows.flat_map(|i| (-rings..=rings).map(move |j| (i, j)));
    let places = places.filter(|(i, j)| (i + j).abs() <= rings);
    let mut places: Vec<(i32, f64, [f64; 2])> = places
        .map(|(i, j)| {
            let place = [
                f64::from(i) + 0.5 * f64::from(j),
                0.75_f64.sqrt() * f64::from(j),
            ];
            let azimuth = place[1].atan2(place[0]).rem_euclid(TAU);
            (i * i + i * j + j * j, azimuth, place)
        })
        .collect();
    places.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    places.truncate(count);
    places.into_iter().map(|(.., place)| place).collect()
}

impl Section {
    fn end_at(&mut self, s_nm: f64) {
        let (Self::Ellipsoids { to_nm, .. } | Self::Rod { to_nm, .. }) = self;
        *to_nm = s_nm;
    }
}
