//! `energies.csv`: energies and residuals of every record, by term and by part.

use crate::finite::ensure_finite_in;
use crate::names::ENERGIES;
use crate::{RunDirectoryError, clock};
use actin_sim::{Assembly, EnergyExchange, EnergyTotals, Part, Records, Row, Term};
use std::collections::HashMap;
use std::hash::Hash;
use std::io::{self, Write};

/// Distinct values of `of`, and for each term the index of its value.
fn places<T: Eq + Hash + Copy>(terms: &[Term], of: impl Fn(&Term) -> T) -> (Vec<T>, Vec<usize>) {
    let (mut values, mut known) = (Vec::new(), HashMap::new());
    let place = |value: T| {
        *known.entry(value).or_insert_with(|| {
            values.push(value);
            values.len() - 1
        })
    };
    let places = terms.iter().map(of).map(place).collect();
    (values, places)
}

#[derive(Debug)]
pub(crate) struct EnergyTable<'a> {
    terms: &'a [Term],
    header: Vec<String>,
    /// Column of the name and of the part of each term; columns of parts follow those of names.
    places: [Vec<usize>; 2],
    sums: usize,
    booked: Vec<fn(&EnergyExchange) -> f64>,
}

impl<'a> EnergyTable<'a> {
    pub(crate) fn new(assembly: &'a Assembly) -> Self {
        let terms = &assembly.terms;
        let (names, by_name) = places(terms, |term| term.name);
        let (parts, by_part) = places(terms, |term| term.part);
        let behind = by_part.into_iter().map(|place| names.len() + place);
        Self {
            terms,
            header: header(assembly, &names, &parts),
            sums: names.len() + parts.len(),
            places: [by_name, behind.collect()],
            booked: assembly
                .booked_columns()
                .into_iter()
                .map(|(_, of)| of)
                .collect(),
        }
    }

    fn row(&self, record: &Row) -> Vec<f64> {
        // Adding to -0.0 preserves the sign of a term of -0.0.
        let mut sums = vec![-0.0; self.sums];
        for places in &self.places {
            for (energy, &place) in record.energies_pn_nm.iter().zip(places) {
                sums[place] += energy;
            }
        }
        let mut row = row(self.terms, record, sums);
        row.extend(self.booked.iter().map(|of| of(&record.booked)));
        row
    }

    pub(crate) fn ensure_finite(&self, i: usize, record: &Row) -> Result<(), RunDirectoryError> {
        let mut columns = self.header.iter().zip(self.row(record));
        columns.try_for_each(|(name, value)| ensure_finite_in((ENERGIES, name), i, &[], [value]))
    }

    /// Writes the table of `records`. Numbers have enough digits for an exact round trip.
    pub(crate) fn write(&self, records: &dyn Records, out: &mut impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(&self.header)?;
        for record in records.rows() {
            let row = self.row(&record?);
            writer.write_record(row.iter().map(|value| format!("{value:?}")))?;
        }
        writer.flush()
    }
}

fn header(assembly: &Assembly, names: &[&str], parts: &[Part]) -> Vec<String> {
    let energies = ["total", "potential", "elastic", "kinetic"]
        .into_iter()
        .map(str::to_owned)
        .chain(names.iter().map(ToString::to_string))
        .chain(parts.iter().map(|part| assembly.name_of(*part)))
        .map(|name| format!("{name}_pn_nm"));
    let residuals = ["residual_force_pn", "residual_torque_pn_nm"].map(str::to_owned);
    // Energy supplied from outside; the total minus these columns is constant.
    let booked = assembly.booked_columns().into_iter();
    let booked = booked.map(|(name, _)| name.to_owned());
    std::iter::once(clock(assembly).to_owned())
        .chain(energies)
        .chain(residuals)
        .chain(booked)
        .collect()
}

fn row(terms: &[Term], record: &Row, sums: Vec<f64>) -> Vec<f64> {
    let totals = EnergyTotals::new(terms, &record.energies_pn_nm, record.kinetic_pn_nm);
    [
        record.at.value(),
        totals.total,
        totals.potential,
        totals.elastic,
        totals.kinetic,
    ]
    .into_iter()
    .chain(sums)
    .chain([record.residual_force_pn, record.residual_torque_pn_nm])
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture;

    fn table_of(assembly: &Assembly, records: &dyn Records) -> (Vec<String>, Vec<Vec<f64>>) {
        let mut bytes = Vec::new();
        EnergyTable::new(assembly)
            .write(records, &mut bytes)
            .unwrap();
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let header = reader
            .headers()
            .unwrap()
            .iter()
            .map(str::to_owned)
            .collect();
        let rows = reader
            .records()
            .map(|row| row.unwrap().iter().map(|v| v.parse().unwrap()).collect())
            .collect();
        (header, rows)
    }

    fn column<'a>(header: &[String], row: &'a [f64], name: &str) -> &'a f64 {
        &row[header.iter().position(|h| h == name).unwrap()]
    }

    #[test]
    fn columns_are_named_with_their_units() {
        let assembly = fixture::linked();
        let (header, _) = table_of(&assembly, &fixture::trajectory(&assembly));
        assert_eq!(
            header[..5],
            [
                "time_ns",
                "total_pn_nm",
                "potential_pn_nm",
                "elastic_pn_nm",
                "kinetic_pn_nm"
            ]
        );
        let last = header.len() - 2;
        assert_eq!(
            header[last..],
            ["residual_force_pn", "residual_torque_pn_nm"]
        );
        let names = ["bonds", "rod", "junction", "load", "linker"];
        let parts = [
            "section_0",
            "section_1",
            "junction_0_1",
            "load_0",
            "linker_0",
        ];
        for name in names.into_iter().chain(parts) {
            let name = format!("{name}_pn_nm");
            let count = header.iter().filter(|h| **h == name).count();
            assert_eq!(count, 1, "{name} in {header:?}");
        }
    }

    /// Parts of filament 0 have no index in their names.
    #[test]
    fn parts_of_further_filaments_have_an_index() {
        let assembly = fixture::pair();
        let (header, rows) = table_of(&assembly, &fixture::trajectory(&assembly));
        let parts = [
            "section_0",
            "junction_0_1",
            "section_1",
            "filament_1_section_0",
            "filament_1_junction_0_1",
            "filament_1_section_1",
            "linker_0",
        ];
        let values = parts.map(|name| *column(&header, &rows[0], &format!("{name}_pn_nm")));
        let elastic = *column(&header, &rows[0], "elastic_pn_nm");
        // Round-off of sums in different order.
        assert!((values.iter().sum::<f64>() / elastic - 1.0).abs() < 1e-13);
        assert!(values.iter().all(|v| *v > 0.0));
    }

    /// Energy errors of 1e-8 require all digits.
    #[test]
    fn numbers_survive_the_round_trip() {
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let (header, rows) = table_of(&assembly, &trajectory);
        assert_eq!(rows.len(), trajectory.records.len());
        for (row, record) in rows.iter().zip(&trajectory.records) {
            let load = assembly
                .terms
                .iter()
                .position(|t| t.name == "load")
                .unwrap();
            for (name, expected) in [
                ("time_ns", record.at.value()),
                ("kinetic_pn_nm", record.kinetic_pn_nm),
                ("load_pn_nm", record.energies_pn_nm[load]),
                ("load_0_pn_nm", record.energies_pn_nm[load]),
                ("residual_force_pn", record.residual_force_pn),
                ("residual_torque_pn_nm", record.residual_torque_pn_nm),
            ] {
                assert_eq!(
                    column(&header, row, name).to_bits(),
                    expected.to_bits(),
                    "{name}"
                );
            }
        }
    }

    #[test]
    fn sums_over_names_and_parts_equal_the_potential() {
        let assembly = fixture::clamped_start();
        let (header, rows) = table_of(&assembly, &fixture::trajectory(&assembly));
        let names = places(&assembly.terms, |term| term.name).0;
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let parts = places(&assembly.terms, |term| term.part).0;
        let parts: Vec<String> = parts.iter().map(|part| assembly.name_of(*part)).collect();
        for row in &rows {
            let of = |name: &str| *column(&header, row, &format!("{name}_pn_nm"));
            let sum = |names: &[String]| names.iter().map(|name| of(name)).sum::<f64>();
            let scale: f64 = parts.iter().map(|part| of(part).abs()).sum();
            // Round-off of sums in different order.
            let same = |a: f64, b: f64| (a - b).abs() <= 1e-14 * scale;
            assert!(same(sum(&names), of("potential")));
            assert!(same(sum(&parts), of("potential")));
            assert!(same(of("elastic") + of("load"), of("potential")));
            assert!(of("load") != 0.0 && of("kinetic") > 0.0);
            let total = of("potential") + of("kinetic");
            assert_eq!(of("total").to_bits(), total.to_bits());
        }
    }
}
