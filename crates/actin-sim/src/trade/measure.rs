//! Compared quantities: numbers and vectors of records, defined for every resolution.

use crate::observe::{View, current_values, observed_columns};
use crate::scene::{
    End, FreeTranslation, Linker, Observable, Quantity, Resultant, Scene, SceneProblem, Setting,
};
use crate::shape::Ribbon;
use crate::shape::axis::Axis;
use crate::{Assembly, Record};
use actin_mechanics::Vector3;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// Chord length of curvature profiles (nm): one period of 13 monomers.
const CHORD_NM: f64 = 35.6;

/// Largest transverse part of an axial vector, as a fraction of its size.
const OFF_AXIS: f64 = 1e-9;

/// Size of a load (pN, pN nm), shift (nm) or turn (deg) up to which a direction counts as undetermined.
const WEAK: f64 = 0.01;

/// Smallest scale of an item as a fraction of the largest item of the same quantity.
const LEAST_SHARE: f64 = 0.1;

/// A quantity by which resolutions are compared.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// Displacement of every free end from its position as built (nm).
    Tip,
    /// Largest distance of each filament from its axis as built (nm).
    Height,
    /// Force of every clamp (pN).
    EndForce,
    /// Couple of every clamp about the clamped point (pN nm).
    EndCouple,
    /// Elastic energy of the filaments (pN nm), without linkers and loads.
    Energy,
    /// Curvature between chords of 35.6 nm (rad/nm): the profile, or the value at one arc length (nm).
    Curvature(Option<f64>),
    /// Force of every linker, or of one linker (pN).
    LinkerForce(Option<usize>),
    /// Columns of `observables.csv` with this prefix, without the arc lengths of extreme values.
    Observable(String),
}

impl From<Quantity> for Measure {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Tip => Self::Tip,
            Quantity::Height => Self::Height,
            Quantity::EndForce => Self::EndForce,
            Quantity::EndCouple => Self::EndCouple,
            Quantity::Energy => Self::Energy,
            Quantity::LinkerForce { linker } => Self::LinkerForce(Some(linker)),
            Quantity::Curvature { at_nm } => Self::Curvature(Some(at_nm)),
        }
    }
}

/// Quantities by their names on the command line.
const NAMES: [(&str, Measure); 7] = [
    ("tip", Measure::Tip),
    ("height", Measure::Height),
    ("end-force", Measure::EndForce),
    ("end-couple", Measure::EndCouple),
    ("energy", Measure::Energy),
    ("curvature", Measure::Curvature(None)),
    ("linker-force", Measure::LinkerForce(None)),
];

/// Parses a name of the command line. Any other name is the prefix of an observable.
impl FromStr for Measure {
    type Err = std::convert::Infallible;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let known = NAMES.into_iter().find(|(known, _)| *known == name);
        let observable = || Self::Observable(name.to_owned());
        Ok(known.map_or_else(observable, |(_, measure)| measure))
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Curvature(Some(at_nm)) => write!(f, "curvature at {at_nm} nm"),
            Self::LinkerForce(Some(linker)) => write!(f, "linker-force {linker}"),
            Self::Observable(name) => f.write_str(name),
            known => {
                let name = NAMES.iter().find(|(_, measure)| measure == known);
                f.write_str(name.map_or("", |(name, _)| name))
            }
        }
    }
}

/// One number or vector of every record.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Name in tables.
    pub name: String,
    /// Unit.
    pub unit: &'static str,
    /// Lower bound of the reference size in relative errors, in `unit`.
    pub scale: f64,
    /// Quantity that includes this item.
    pub measure: Measure,
    kind: Kind,
    /// Statistic over time; `None` without heat.
    moment: Option<Moment>,
}

/// Statistic of a quantity in heat, over the records after the first fifth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Moment {
    Mean,
    /// Root mean square distance from the mean.
    Fluctuation,
}

/// Fraction of the records of a motion in heat that is discarded at its beginning.
const BURN_IN: f64 = 0.2;

impl Moment {
    fn of(self, values: &[Vec<f64>]) -> Vec<f64> {
        let count = values.len() as f64;
        let size = values.first().map_or(0, Vec::len);
        let mean: Vec<f64> = (0..size)
            .map(|j| values.iter().map(|value| value[j]).sum::<f64>() / count)
            .collect();
        match self {
            Self::Mean => mean,
            Self::Fluctuation => {
                let pairs = values.iter().flat_map(|value| value.iter().zip(&mean));
                let squares: f64 = pairs.map(|(x, mean)| (x - mean).powi(2)).sum();
                vec![(squares / count).sqrt()]
            }
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Tip(usize, End),
    /// Numbers of an observable at these indices.
    Observed(Observable, Range<usize>),
    Energy,
    Curvature(usize, Vec<f64>),
    /// Observed quantities of the scene in these columns.
    Columns(Range<usize>),
}

impl Item {
    fn new(name: String, unit: &'static str, kind: Kind) -> Self {
        let measure = Measure::Tip;
        let scale = match unit {
            "nm" | "pN" => 0.01,
            "pN nm" => 0.1,
            "rad/nm" => 1e-5,
            _ => 1e-6,
        };
        Self {
            name,
            unit,
            scale,
            measure,
            kind,
            moment: None,
        }
    }

    /// Returns true for profiles, whose size is the maximum norm instead of the Euclidean norm.
    fn is_profile(&self) -> bool {
        matches!(self.kind, Kind::Curvature(..))
    }

    /// Returns the Euclidean norm of a value, or the maximum norm of a profile.
    pub(super) fn size(&self, value: &[f64]) -> f64 {
        let sizes = value.iter().map(|x| x.abs());
        if self.is_profile() {
            sizes.fold(0.0, f64::max)
        } else {
            sizes.map(|x| x * x).sum::<f64>().sqrt()
        }
    }

    /// Returns the root mean square size over records, at least the scale.
    pub(super) fn mean_size(&self, values: &[Vec<f64>]) -> f64 {
        let squares: f64 = values.iter().map(|value| self.size(value).powi(2)).sum();
        (squares / values.len() as f64).sqrt().max(self.scale)
    }

    /// Returns the relative error of a candidate: the root mean square size of the difference over records, divided by the
    /// root mean square size of the reference or, if larger, by the scale. `None` if the numbers of records differ.
    pub(crate) fn error(&self, reference: &[Vec<f64>], candidate: &[Vec<f64>]) -> Option<f64> {
        if reference.len() != candidate.len() || reference.is_empty() {
            return None;
        }
        let square = |value: &[f64]| self.size(value).powi(2);
        let differences = reference.iter().zip(candidate).map(|(one, other)| {
            let difference: Vec<f64> = one.iter().zip(other).map(|(a, b)| b - a).collect();
            if one.len() == other.len() {
                square(&difference)
            } else {
                f64::NAN
            }
        });
        let difference = (differences.sum::<f64>() / reference.len() as f64).sqrt();
        let error = difference / self.mean_size(reference);
        error.is_finite().then_some(error)
    }
}

pub(super) type Values = Vec<Vec<Vec<f64>>>;

/// Evaluates the compared items of one scene in any resolution.
#[derive(Clone, Debug)]
pub(super) struct Measurer {
    pub items: Vec<Item>,
    /// Symmetry axis of the scene; the azimuth about this axis is undetermined.
    free_about: Option<Vector3>,
}

impl Measurer {
    /// Relative errors of all items; `None` for items without a value.
    pub(super) fn errors(&self, reference: &Values, values: &Values) -> Vec<Option<f64>> {
        let pairs = reference.iter().zip(values);
        let items = self.items.iter().zip(pairs);
        items.map(|(item, (a, b))| item.error(a, b)).collect()
    }

    /// Finds the items of `measures`, or of the default quantities if empty, in the assembled reference.
    ///
    /// # Errors
    /// A quantity without an item in the scene.
    pub(super) fn new(assembly: &Assembly, measures: &[Measure]) -> Result<Self, SceneProblem> {
        let by_default = by_default(assembly);
        let measures = if measures.is_empty() {
            &by_default
        } else {
            measures
        };
        let mut items: Vec<Item> = Vec::new();
        for measure in measures {
            let found = items_of(assembly, measure);
            if found.is_empty() {
                let rule = format!("the scene has no {measure} to compare resolutions by");
                return Err(SceneProblem::new("quantity", measure.to_string(), rule));
            }
            for mut item in found {
                item.measure = measure.clone();
                if !items.iter().any(|known| known.name == item.name) {
                    items.push(item);
                }
            }
        }
        if assembly.scene.thermal().is_some() {
            items = items.iter().flat_map(moments).collect();
        }
        Ok(Self {
            items,
            free_about: free_axis(&assembly.scene),
        })
    }

    /// Raises the scale of each item to a tenth of the largest item of the same quantity. Tips with small displacements then
    /// do not dominate the error.
    pub(super) fn set_scales(&mut self, reference: &Values) {
        let sizes: Vec<f64> = self
            .items
            .iter()
            .zip(reference)
            .map(|(item, values)| item.mean_size(values))
            .collect();
        let kinds: Vec<(Measure, Option<Moment>)> = self
            .items
            .iter()
            .map(|item| (item.measure.clone(), item.moment))
            .collect();
        for (item, kind) in self.items.iter_mut().zip(&kinds) {
            let alike = kinds.iter().zip(&sizes).filter(|(other, _)| *other == kind);
            let largest = alike.map(|(_, size)| *size).fold(0.0, f64::max);
            item.scale = item.scale.max(LEAST_SHARE * largest);
        }
    }

    pub(super) fn leaves_out_azimuth(&self) -> bool {
        self.free_about.is_some()
    }

    pub(super) fn values(&self, assembly: &Assembly, records: &[Record]) -> Values {
        let views: Vec<View<'_>> = records
            .iter()
            .map(|record| view(assembly, record))
            .collect();
        let of_item = |item: &Item| {
            let all = views.iter().zip(records);
            let values: Vec<Vec<f64>> = all
                .map(|(view, record)| self.value(item, view, record))
                .collect();
            let begin = (BURN_IN * values.len() as f64).ceil();
            let settled = values
                .iter()
                .enumerate()
                .filter(|(i, _)| *i as f64 >= begin);
            match item.moment {
                None => values,
                Some(moment) => {
                    let settled: Vec<Vec<f64>> = settled.map(|(_, value)| value.clone()).collect();
                    vec![moment.of(&settled)]
                }
            }
        };
        self.items.iter().map(of_item).collect()
    }

    pub(super) fn value(&self, item: &Item, view: &View<'_>, record: &Record) -> Vec<f64> {
        let assembly = view.assembly;
        match &item.kind {
            Kind::Tip(filament, end) => {
                let place = |state| assembly.tip_of(*filament, state, *end);
                self.vector(place(view.state) - place(&assembly.rest))
            }
            Kind::Energy => {
                let terms = assembly.filaments.iter().flat_map(|f| f.terms.clone());
                vec![terms.map(|term| record.energies_pn_nm[term]).sum()]
            }
            Kind::Curvature(filament, places) => turns(view.ribbon(*filament), places),
            Kind::Observed(one, columns) => {
                self.components(&current_values(*one, view)[columns.clone()])
            }
            Kind::Columns(columns) => self.components(&record.observed[columns.clone()]),
        }
    }

    /// Returns three numbers as a vector, and other numbers unchanged.
    fn components(&self, numbers: &[f64]) -> Vec<f64> {
        match numbers {
            [x, y, z] => self.vector(Vector3::new(*x, *y, *z)),
            numbers => numbers.to_vec(),
        }
    }

    /// Returns the components of a vector or, with a symmetry axis, its axial part and the size of its transverse part.
    fn vector(&self, vector: Vector3) -> Vec<f64> {
        match self.free_about {
            None => vector.as_slice().to_vec(),
            Some(axis) => {
                let along = vector.dot(&axis);
                vec![along, (vector - along * axis).norm()]
            }
        }
    }
}

pub(super) fn view<'a>(assembly: &'a Assembly, record: &'a Record) -> View<'a> {
    let energies = (record.energies_pn_nm.as_slice(), record.kinetic_pn_nm);
    View::new(assembly, (record.at, &record.state), energies)
}

fn moments(item: &Item) -> [Item; 2] {
    let of = |name: &str, moment| Item {
        name: format!("{} {name}", item.name),
        moment: Some(moment),
        ..item.clone()
    };
    [of("mean", Moment::Mean), of("rms", Moment::Fluctuation)]
}

/// Returns the default quantities: the observables of the scene and the tip displacements, or the heights if no tip
/// is free.
fn by_default(assembly: &Assembly) -> Vec<Measure> {
    let mut measures: Vec<Measure> = observed_columns(assembly)
        .iter()
        .filter(|column| !is_place(column))
        .map(|column| Measure::Observable(column_stem(column).to_owned()))
        .collect();
    measures.dedup();
    let has_tip = !items_of(assembly, &Measure::Tip).is_empty();
    measures.push(if has_tip {
        Measure::Tip
    } else {
        Measure::Height
    });
    measures
}

fn items_of(assembly: &Assembly, measure: &Measure) -> Vec<Item> {
    let filaments = || 0..assembly.filaments.len();
    let of = |what: &str, filament| name_of(assembly, what, filament);
    match measure {
        Measure::Tip => {
            let starts = filaments().map(|f| (f, End::Start, "start"));
            let ends = filaments().map(|f| (f, End::End, "tip"));
            let free = starts.chain(ends);
            let free = free.filter(|(f, end, _)| {
                let clamp = assembly.clamp_at(*f, *end);
                clamp.is_none_or(|clamp| clamp.slides != FreeTranslation::Nowhere)
            });
            free.map(|(f, end, name)| Item::new(of(name, f), "nm", Kind::Tip(f, end)))
                .collect()
        }
        Measure::Height => filaments()
            .map(|filament| {
                // The largest distance is the third number of the contour.
                let kind = Kind::Observed(Observable::Contour { filament }, 2..3);
                Item::new(of("height", filament), "nm", kind)
            })
            .collect(),
        Measure::EndForce => of_clamps(assembly, "force", "pN", 0..3),
        Measure::EndCouple => of_clamps(assembly, "couple", "pN nm", 3..6),
        Measure::Energy => vec![Item::new("energy".to_owned(), "pN nm", Kind::Energy)],
        Measure::Curvature(at_nm) => filaments()
            .filter(|f| at_nm.is_none() || *f == 0)
            .map(|f| (f, chords(assembly.length_of(f), *at_nm)))
            .filter(|(_, places)| places.len() >= 3)
            .map(|(f, places)| Item::new(of("curvature", f), "rad/nm", Kind::Curvature(f, places)))
            .collect(),
        Measure::LinkerForce(one) => (0..assembly.linkers.len())
            .filter(|linker| one.is_none_or(|one| one == *linker))
            .map(|linker| {
                let kind = Kind::Observed(Observable::Linker { linker }, 0..3);
                Item::new(format!("linker {linker}"), "pN", kind)
            })
            .collect(),
        Measure::Observable(name) => columns(&observed_columns(assembly), name),
    }
}

fn name_of(assembly: &Assembly, what: &str, filament: usize) -> String {
    match assembly.filaments.len() {
        1 => what.to_owned(),
        _ => format!("{what}[{filament}]"),
    }
}

fn of_clamps(
    assembly: &Assembly,
    what: &str,
    unit: &'static str,
    numbers: Range<usize>,
) -> Vec<Item> {
    let named = assembly.clamps.iter().map(|clamp| {
        let (filament, end) = (clamp.filament, clamp.end);
        let name = name_of(assembly, &format!("{end} {what}"), filament);
        let reaction = Observable::EndReaction { filament, end };
        Item::new(name, unit, Kind::Observed(reaction, numbers.clone()))
    });
    named.collect()
}

/// Returns the columns of observables with a prefix; the three components of a vector form one item.
fn columns(all: &[String], name: &str) -> Vec<Item> {
    let mut items: Vec<Item> = Vec::new();
    for (i, column) in all.iter().enumerate() {
        if !column.starts_with(name) || is_place(column) {
            continue;
        }
        let stem = column_stem(column);
        match items.last_mut() {
            Some(Item {
                name,
                kind: Kind::Columns(range),
                ..
            }) if name == stem && range.end == i && stem != column => range.end += 1,
            _ => {
                let unit = ["rad_per_nm", "pn_nm", "pn", "nm"]
                    .into_iter()
                    .zip(["rad/nm", "pN nm", "pN", "nm"])
                    .find(|(suffix, _)| column.ends_with(&format!("_{suffix}")));
                let kind = Kind::Columns(i..i + 1);
                items.push(Item::new(
                    stem.to_owned(),
                    unit.map_or("", |(_, unit)| unit),
                    kind,
                ));
            }
        }
    }
    items
}

/// Returns true for arc lengths of extreme values, which may jump between equal extremes.
fn is_place(column: &str) -> bool {
    column.ends_with("_at_nm")
}

/// Returns the name of a column without the component of a vector and its unit.
fn column_stem(column: &str) -> &str {
    let axes = ["_x", "_y", "_z"];
    let place = axes.iter().find_map(|axis| {
        let at = column.find(axis)?;
        let rest = &column[at + 2..];
        (rest.is_empty() || rest.starts_with('_')).then_some(at)
    });
    place.map_or(column, |at| &column[..at])
}

/// Returns the arc lengths of chord ends (nm) along a filament, or of the two chords next to `at_nm`.
fn chords(length_nm: f64, at_nm: Option<f64>) -> Vec<f64> {
    if let Some(at_nm) = at_nm {
        let last = (length_nm - 2.0 * CHORD_NM).max(0.0);
        let from = (at_nm - CHORD_NM).clamp(0.0, last);
        return (0..3).map(|k| from + f64::from(k) * CHORD_NM).collect();
    }
    let ends = (0..).map(|k| f64::from(k) * CHORD_NM);
    ends.take_while(|s| *s <= length_nm + 1e-9).collect()
}

/// Returns the angle between neighbouring chords divided by the chord length (rad/nm), at each inner point.
fn turns(ribbon: &Ribbon, places: &[f64]) -> Vec<f64> {
    let axis = Axis::from_ribbon(ribbon);
    let points: Vec<Vector3> = places.iter().map(|s| axis.at(*s).0).collect();
    let chords: Vec<Vector3> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let pairs = chords.windows(2);
    pairs
        .map(|pair| pair[0].angle(&pair[1]) / CHORD_NM)
        .collect()
}

/// Returns the symmetry axis of the scene, up to the helix of the monomers.
///
/// A scene has such an axis if it is a single straight filament with loads along and about its axis. All other forces
/// must be weak.
fn free_axis(scene: &Scene) -> Option<Vector3> {
    let filament = &scene.filament;
    let is_alone = scene.other_filaments.is_empty() && filament.shape.is_none();
    if !is_alone || scene.repulsion.is_some() {
        return None;
    }
    let axis = filament.axis();
    let lies_along = |v: &Vector3| v.cross(&axis).norm() <= OFF_AXIS * v.norm();
    let loads = scene.loads.iter().map(|load| match load.resultant(scene) {
        Resultant::Force(v) | Resultant::Couple(v) => v,
    });
    let settings = scene.path.iter().flat_map(|stage| &stage.set);
    let moves = settings.filter_map(|setting| match *setting {
        Setting::LoadFactor { .. } | Setting::Shear { .. } => None,
        Setting::Shift { shift_nm: v, .. }
        | Setting::Turn { turn_deg: v, .. }
        | Setting::Anchor { shift_nm: v, .. } => Some(v.into()),
    });
    let strong: Vec<Vector3> = loads.chain(moves).filter(|v| v.norm() > WEAK).collect();
    let reach = 0.5 * filament.length_nm();
    let is_weak = |linker: &Linker| {
        let pulled = Vector3::from(linker.displaced_nm.unwrap_or_default()).norm();
        linker.to.is_none() && linker.stiffness_pn_per_nm * (pulled + reach) <= WEAK
    };
    let is_free =
        !strong.is_empty() && strong.iter().all(lies_along) && scene.linkers.iter().all(is_weak);
    is_free.then_some(axis)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_extremes_are_not_compared() {
        let text = "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
            observe: [InternalLoad(), InternalLoad(at_nm: 50.0)],
            task: Equilibrium(),
        )";
        let assembly = Assembly::build(&Scene::from_ron(text).unwrap()).unwrap();
        for measures in [
            vec![],
            vec![Measure::Observable("internal_load".to_owned())],
        ] {
            let items = Measurer::new(&assembly, &measures).unwrap().items;
            let extremes = items.iter().filter(|item| item.name.contains("est_"));
            assert_eq!(extremes.count(), 5, "{items:?}");
            assert!(items.iter().all(|item| !item.name.ends_with("_at_nm")));
        }
        let place = Measure::Observable("internal_load[0]_largest_moment_at_nm".to_owned());
        assert!(Measurer::new(&assembly, &[place]).is_err());
    }
}
