//! Detection of states outside the data of fitted rod laws.

use super::Assembly;
use crate::rod::{Ranges, Rod};
use crate::scene::RodLaw;
use actin_cosserat::BendingElement;
use actin_mechanics::{State, Vector3};
use nalgebra::Vector6;
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt;

/// Deformation of a rod beyond the data of a fitted law.
///
/// In files, `value` and `range` of twist and curvature are `value_per_nm` and `range_per_nm`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct LawExtrapolation {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Index of the section in its filament.
    pub section: usize,
    /// `twist`, `curvature`, `shear`, or `stretch` relative to the length that the data refer to.
    pub quantity: String,
    /// Arc length of the largest value (nm, at rest).
    pub s_nm: f64,
    /// Largest value (rad/nm, or a strain).
    #[serde(alias = "value_per_nm")]
    pub value: f64,
    /// Limit of the data (rad/nm, or a strain); in compression the lower bound.
    #[serde(alias = "range_per_nm")]
    pub range: f64,
    /// Frequency of the excess in a heat bath; `None` without a bath.
    pub fluctuations: Option<Fluctuations>,
    /// Measured error for this value, if available.
    pub measured_error: Option<MeasuredError>,
}

impl fmt::Display for LawExtrapolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (quantity, value, range) = (&self.quantity, self.value, self.range);
        let place = format!("s = {:.1} nm{}", self.s_nm, of_filament(self.filament));
        let (unit, elements) = if self.is_strain() {
            ("", "segments")
        } else {
            (" rad/nm", "bending elements")
        };
        let error = self.error_text();
        // As many decimals as distinguish the two numbers.
        let [size, limit] = [value.abs(), range.abs()];
        let digits =
            (4..12).find(|&digits| format!("{size:.digits$}") != format!("{limit:.digits$}"));
        let digits = digits.unwrap_or(12);
        match self.fluctuations {
            None => write!(
                f,
                "{quantity} {value:.digits$}{unit} at {place} exceeds the data of the rod law ({range:.digits$}): results there are \
                 extrapolated; {error}"
            ),
            Some(often) => write!(
                f,
                "{quantity} fluctuates beyond the data of the rod law in {} of the records and {} of all {elements}: at most \
                 {value:.digits$}{unit} at {place}, where the data end at {range:.digits$}; {error}",
                percent(often.share_of_records),
                percent(often.share_of_elements)
            ),
        }
    }
}

pub(super) fn of_filament(filament: usize) -> String {
    match filament {
        0 => String::new(),
        filament => format!(" of filament {filament}"),
    }
}

pub(super) fn percent(share: f64) -> String {
    match 100.0 * share {
        percent if percent >= 10.0 => format!("{percent:.0} %"),
        percent if percent >= 1.0 => format!("{percent:.1} %"),
        percent => format!("{percent:.1e} %"),
    }
}

impl Serialize for LawExtrapolation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [value, range] = if self.is_strain() {
            ["value", "range"]
        } else {
            ["value_per_nm", "range_per_nm"]
        };
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("filament", &self.filament)?;
        map.serialize_entry("section", &self.section)?;
        map.serialize_entry("quantity", &self.quantity)?;
        map.serialize_entry("s_nm", &self.s_nm)?;
        map.serialize_entry(value, &self.value)?;
        map.serialize_entry(range, &self.range)?;
        if let Some(fluctuations) = &self.fluctuations {
            map.serialize_entry("fluctuations", fluctuations)?;
        }
        if let Some(error) = &self.measured_error {
            map.serialize_entry("measured_error", error)?;
        }
        map.end()
    }
}

/// Largest errors of cantilevers of 62 to 303 nm under transverse tip forces of 1 to 10 pN, in up to five
/// groups per quantity.
///
/// # Source
/// `cargo xtask load-cases --beyond --write`.
const MEASURED: &str = include_str!("extrapolation.csv");

/// Largest relative error of the tip displacement over cantilevers that extrapolate their law up to
/// `up_to`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredError {
    /// Largest value of the quantity in the group (strain, or rad/nm).
    pub up_to: f64,
    /// Error against the mean of monomers over azimuths of the lattice.
    pub of_mean: f64,
    /// Error against monomers at one azimuth.
    pub of_one_azimuth: f64,
}

impl MeasuredError {
    /// Returns the error of the first group that reaches `value`, or `None` beyond all groups.
    fn at(quantity: &str, value: f64) -> Option<Self> {
        let reaches = |up_to: f64| up_to.signum() == value.signum() && up_to.abs() >= value.abs();
        let rows = MEASURED.lines().skip(1).filter_map(|line| {
            let (name, numbers) = line.split_once(',')?;
            let numbers: Vec<f64> = numbers.split(',').filter_map(|n| n.parse().ok()).collect();
            let [up_to, of_mean, of_one_azimuth] = numbers[..] else {
                return None;
            };
            (name == quantity && reaches(up_to)).then_some(Self {
                up_to,
                of_mean,
                of_one_azimuth,
            })
        });
        rows.min_by(|a, b| a.up_to.abs().total_cmp(&b.up_to.abs()))
    }
}

/// Frequency with which thermal fluctuations exceed a bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fluctuations {
    /// Share of the records with any excess.
    pub share_of_records: f64,
    /// Share of all bending elements (for shear and stretch: segments) in all records. It is
    /// independent of the length of the filament and of the duration of the run.
    pub share_of_elements: f64,
}

/// Values of a quantity and their arc lengths from the rod's start (nm).
type Values<'a> = Box<dyn Iterator<Item = (f64, f64)> + 'a>;

#[derive(Clone, Copy)]
struct Quantity {
    name: &'static str,
    /// Lower and upper bound.
    range: fn(&Ranges) -> Option<[f64; 2]>,
    of: for<'a> fn(&'a Rod, &'a State) -> Values<'a>,
}

const QUANTITIES: [Quantity; 4] = [
    Quantity {
        name: "twist",
        range: |ranges| ranges.twist.map(|bound| [-bound, bound]),
        of: |rod, state| Box::new(bends(rod, state).map(|(s, kappa)| (s, kappa.z))),
    },
    Quantity {
        name: "curvature",
        range: |ranges| ranges.curvature.map(|bound| [-bound, bound]),
        of: |rod, state| Box::new(bends(rod, state).map(|(s, kappa)| (s, kappa.xy().norm()))),
    },
    Quantity {
        name: "shear",
        range: |ranges| ranges.shear.map(|bound| [-bound, bound]),
        of: |rod, state| Box::new(strains(rod, state).map(|(s, strain)| (s, strain.xy().norm()))),
    },
    Quantity {
        name: "stretch",
        range: |ranges| ranges.stretch,
        of: |rod, state| Box::new(strains(rod, state).map(|(s, strain)| (s, strain.z))),
    },
];

impl Assembly {
    /// Returns the deformations of rods in `state` beyond the data of their laws, at most one entry
    /// per section and quantity.
    ///
    /// Beyond their data, laws of twist and length are continued linearly; bending laws and
    /// potentials by their formulas. Bending elements that join a rod to junction frames belong to
    /// the end of the rod.
    pub fn beyond_range(&self, state: &State) -> Vec<LawExtrapolation> {
        let mut found = Vec::new();
        for rod in &self.rods {
            for quantity in 0..QUANTITIES.len() {
                let worst = self.tally(rod, quantity, state).worst;
                found.extend(worst.map(|excess| self.report_extrapolation(excess, None)));
            }
        }
        found
    }

    fn report_extrapolation(
        &self,
        excess: Excess,
        fluctuations: Option<Fluctuations>,
    ) -> LawExtrapolation {
        let (filament, section) = self.place_of_section(excess.section);
        let quantity = QUANTITIES[excess.quantity].name;
        let is_measured = match self.rod_model_of(excess.section).law {
            RodLaw::Homogenised => self.scene.thermal().is_none(),
            RodLaw::HomogenisedAthermal => true,
            _ => false,
        };
        let measured = is_measured.then(|| MeasuredError::at(quantity, excess.value));
        LawExtrapolation {
            filament,
            section,
            quantity: quantity.to_owned(),
            s_nm: excess.s_nm,
            value: excess.value,
            range: excess.range,
            fluctuations,
            measured_error: measured.flatten(),
        }
    }

    /// Merges [`beyond_range`](Self::beyond_range) over the records of a run. The result holds the
    /// largest value of each section and quantity. In a heat bath it holds the largest value of
    /// each quantity, with its frequency.
    pub fn beyond_range_over<'a>(
        &self,
        states: impl IntoIterator<Item = &'a State>,
    ) -> Vec<LawExtrapolation> {
        let mut watch = RangeWatch::new(self);
        states.into_iter().for_each(|state| watch.add(self, state));
        watch.end(self)
    }

    /// Counts the excesses of a quantity in a rod; empty if the quantity is unbounded.
    fn tally(&self, rod: &Rod, quantity: usize, state: &State) -> Tally {
        let Quantity { range, of, .. } = QUANTITIES[quantity];
        let Some([lowest, highest]) = range(&rod.ranges) else {
            return Tally::default();
        };
        let bound = |value: f64| if value < 0.0 { lowest } else { highest };
        let is_further = |value: f64, than: f64| {
            let is_even = lowest.to_bits() == (-highest).to_bits();
            let [of_value, of_other] = if is_even {
                [1.0; 2]
            } else {
                [value, than].map(|each| bound(each).abs())
            };
            value.abs() * of_other > than.abs() * of_value
        };
        let (mut elements, mut beyond, mut largest) = (0, 0, (0.0, 0.0));
        for (s, value) in of(rod, state) {
            elements += 1;
            beyond += usize::from(value < lowest || value > highest);
            if is_further(value, largest.1) {
                largest = (s, value);
            }
        }
        let worst = (beyond > 0).then(|| Excess {
            section: rod.section,
            quantity,
            s_nm: self.sections[rod.section].from_nm + largest.0,
            value: largest.1,
            range: bound(largest.1).abs(),
        });
        Tally {
            elements,
            beyond,
            worst,
        }
    }
}

impl LawExtrapolation {
    /// Describes the measured error.
    pub(crate) fn error_text(&self) -> String {
        let Some(error) = &self.measured_error else {
            return "the error was not measured there".to_owned();
        };
        format!(
            "in cantilevers with {} up to {:.4} the tip displacement is within {:.1} % of the mean of monomers over \
             azimuths, and within {:.1} % of monomers at one azimuth",
            self.quantity,
            error.up_to,
            100.0 * error.of_mean,
            100.0 * error.of_one_azimuth
        )
    }

    /// Returns `true` if the quantity is a dimensionless strain.
    pub fn is_strain(&self) -> bool {
        matches!(self.quantity.as_str(), "shear" | "stretch")
    }
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Excess {
    /// Index of the section among all filaments.
    section: usize,
    /// Index in [`QUANTITIES`].
    quantity: usize,
    s_nm: f64,
    value: f64,
    range: f64,
}

impl Excess {
    fn ratio(&self) -> f64 {
        self.value.abs() / self.range
    }
}

/// Curvature of every bending element of a rod with its arc length from the rod's start (nm).
/// Elements of walls and junctions are included, with their curvature deficit at rest added.
pub(super) fn curvatures<'a>(
    rod: &'a Rod,
    state: &'a State,
) -> impl Iterator<Item = (f64, Vector3)> + 'a {
    let layout = &rod.layout;
    let nodes = layout.element_positions().split_off(layout.segments());
    let chain = layout.bending_chain().zip(layout.voronoi_lengths());
    let own = chain.zip(nodes).map(|((a, &rest_distance), s)| {
        let element = BendingElement { rest_distance };
        (s, [a, a + 1], element, Vector3::zeros())
    });
    let ends = [0.0, layout.length()];
    let joined = rod.joined.iter().zip(ends);
    let joined = joined.flat_map(|(all, s)| {
        let each = all.iter();
        each.map(move |e| (s, e.frames, e.element, e.curvature_difference))
    });
    own.chain(joined)
        .map(|(s, frames, element, curvature_difference)| {
            let [first, second] = frames.map(|frame| state.frames.orientation.get(frame));
            (s, element.curvature(first, second) + curvature_difference)
        })
}

/// Curvatures relative to the curvature at rest.
pub(super) fn bends<'a>(
    rod: &'a Rod,
    state: &'a State,
) -> impl Iterator<Item = (f64, Vector3)> + 'a {
    let rest = rod.material.rest_curvature();
    curvatures(rod, state).map(move |(s, kappa)| (s, kappa - rest))
}

/// Strain of every segment of a rod under a potential, with the arc length of its middle (nm). The
/// third component is that of the range of the law.
fn strains<'a>(rod: &'a Rod, state: &'a State) -> impl Iterator<Item = (f64, Vector3)> + 'a {
    let potential = rod.twist_watch.as_ref().zip(rod.material.potential());
    potential.into_iter().flat_map(move |(watch, law)| {
        let middles = rod.layout.element_positions();
        let rest = rod.material.rest_curvature();
        (0..rod.layout.segments()).map(move |k| {
            let (sigma, kappa) = watch.strains(rod, k, state);
            let [k1, k2, k3] = (kappa - rest).into();
            let strain = Vector6::new(k1, k2, k3, sigma.x, sigma.y, sigma.z);
            let stretch = law.stretch_in_range(&strain);
            (middles[k], Vector3::new(sigma.x, sigma.y, stretch))
        })
    })
}

/// Record of strains of rods outside the data of their laws, over the states of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RangeWatch(RangeRecord);

#[derive(Clone, Debug, Serialize, Deserialize)]
enum RangeRecord {
    Worst(Worst),
    InBath(Box<InBath>),
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Worst {
    list: Vec<Excess>,
    /// Index in `list` by section (among all filaments) and quantity.
    places: BTreeMap<(usize, usize), usize>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct InBath {
    states: u32,
    /// Counts of elements and of states with an excess, in the order of [`QUANTITIES`].
    tallies: [(Tally, u32); QUANTITIES.len()],
}

impl RangeWatch {
    /// Creates an empty record.
    pub fn new(assembly: &Assembly) -> Self {
        Self(match assembly.scene.thermal() {
            None => RangeRecord::Worst(Worst::default()),
            Some(_) => RangeRecord::InBath(Box::new(InBath {
                states: 0,
                tallies: QUANTITIES.map(|_| (Tally::default(), 0)),
            })),
        })
    }

    /// Adds a state.
    pub fn add(&mut self, assembly: &Assembly, state: &State) {
        match &mut self.0 {
            RangeRecord::Worst(worst) => worst.add(assembly, state),
            RangeRecord::InBath(all) => all.add(assembly, state),
        }
    }

    /// Returns the extrapolations: the largest ones, or their fluctuations in a heat bath.
    pub fn end(self, assembly: &Assembly) -> Vec<LawExtrapolation> {
        match self.0 {
            RangeRecord::Worst(worst) => {
                let list = worst.list.into_iter();
                list.map(|excess| assembly.report_extrapolation(excess, None))
                    .collect()
            }
            RangeRecord::InBath(all) => all.end(assembly),
        }
    }
}

impl Worst {
    fn add(&mut self, assembly: &Assembly, state: &State) {
        let all = assembly
            .rods
            .iter()
            .flat_map(|rod| (0..QUANTITIES.len()).map(move |q| (rod, q)));
        for (rod, quantity) in all {
            let Some(excess) = assembly.tally(rod, quantity, state).worst else {
                continue;
            };
            let key = (excess.section, quantity);
            let place = *self.places.entry(key).or_insert(self.list.len());
            match self.list.get_mut(place) {
                Some(known) if known.ratio() >= excess.ratio() => {}
                Some(known) => *known = excess,
                None => self.list.push(excess),
            }
        }
    }
}

impl InBath {
    fn add(&mut self, assembly: &Assembly, state: &State) {
        self.states += 1;
        for (quantity, (all, states_beyond)) in self.tallies.iter_mut().enumerate() {
            let before = all.beyond;
            for rod in &assembly.rods {
                all.add(assembly.tally(rod, quantity, state));
            }
            *states_beyond += u32::from(all.beyond > before);
        }
    }

    fn end(self, assembly: &Assembly) -> Vec<LawExtrapolation> {
        let found = self.tallies.into_iter().filter_map(|(all, states_beyond)| {
            let fluctuations = Some(Fluctuations {
                share_of_records: f64::from(states_beyond) / f64::from(self.states),
                share_of_elements: all.beyond as f64 / all.elements as f64,
            });
            all.worst
                .map(|worst| assembly.report_extrapolation(worst, fluctuations))
        });
        found.collect()
    }
}

#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Tally {
    elements: usize,
    beyond: usize,
    worst: Option<Excess>,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.elements += other.elements;
        self.beyond += other.beyond;
        let ratio = |worst: &Option<Excess>| worst.as_ref().map_or(0.0, Excess::ratio);
        if ratio(&other.worst) > ratio(&self.worst) {
            self.worst = other.worst;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::{BodyKind, FrameInfo};
    use actin_mechanics::UnitQuaternion;

    /// A rotation of a junction frame by 0.4 rad twists its 5.7 nm element; the rod itself is
    /// straight.
    #[test]
    fn elements_of_junctions_count() {
        let text = "Scene(
            filament: Filament(
                sections: [Ellipsoids(from_nm: 0.0, to_nm: 22.0), Rod(from_nm: 22.0, to_nm: 52.0)],
                rod: RodModel(law: Fitted),
            ),
            task: Dynamics(duration_ns: 1.0),
        )";
        let assembly = Assembly::build(&Scene::from_ron(text).unwrap()).unwrap();
        let mut state = assembly.rest.clone();
        assert_eq!(assembly.beyond_range(&state), []);
        let of_junction = |frame: &FrameInfo| frame.kind == BodyKind::Junction;
        let frame = assembly.frames.iter().rposition(of_junction).unwrap();
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.4);
        let q = state.frames.orientation.get(frame);
        state.frames.orientation.set(frame, q * turn);
        let found = assembly.beyond_range(&state);
        assert_eq!(found.len(), 1);
        let (beyond, section) = (&found[0], &assembly.sections[1]);
        assert_eq!((beyond.section, beyond.quantity.as_str()), (1, "twist"));
        let near = LawExtrapolation {
            value: -0.00204,
            range: 0.002,
            ..beyond.clone()
        };
        let text = near.to_string();
        assert!(text.contains("-0.00204 rad/nm") && text.contains("(0.00200)"));
        assert!((beyond.s_nm - section.from_nm).abs() < 1e-12);
        let segment = 2.0 * (assembly.frames[section.frames.start].s_nm - section.from_nm);
        let distance = 0.5 * segment + 0.25 * 2.7385;
        assert!((beyond.value + 0.4 / distance).abs() < 1e-3 * 0.4 / distance);
    }

    #[test]
    fn errors_are_given_as_far_as_they_were_measured() {
        for (quantity, near, far) in [("shear", 0.0201, 0.025), ("curvature", 0.0101, 0.02)] {
            let [near, far] = [near, far].map(|value| MeasuredError::at(quantity, value).unwrap());
            assert!(near.up_to.abs() < far.up_to.abs());
            for error in [near, far] {
                assert!(0.0 < error.of_mean && error.of_mean <= error.of_one_azimuth);
                assert!(error.of_one_azimuth < 0.2, "{error:?}");
            }
            assert!(near.of_mean <= far.of_mean);
        }
        for (quantity, value) in [("shear", 0.05), ("stretch", 0.01), ("twist", 0.06)] {
            assert_eq!(MeasuredError::at(quantity, value), None);
        }
    }
}
