//! `energies.csv`: energies and residuals of every record, by term and by part.

use crate::clock;
use crate::names::ENERGIES;
use crate::table::{self, Cell};
use actin_sim::{Assembly, EnergyTotals, Records, StoredRecord, Term};
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

/// Writes the table of `records`.
pub(crate) fn write(
    assembly: &Assembly,
    records: &dyn Records,
    out: &mut impl Write,
) -> io::Result<()> {
    let terms = &assembly.terms;
    let (names, by_name) = places(terms, |term| term.name);
    let (parts, by_part) = places(terms, |term| term.part);
    // Energy supplied from outside; the total minus these columns is constant.
    let (supplied, of_supplied): (Vec<_>, Vec<_>) = assembly.booked_columns().into_iter().unzip();
    let row = |record: io::Result<StoredRecord<'_>>| -> io::Result<_> {
        let row = record?.row;
        let energies = &row.energies_pn_nm;
        let totals = EnergyTotals::new(terms, energies, row.kinetic_pn_nm);
        let mut numbers = vec![
            row.at.value(),
            totals.total,
            totals.potential,
            totals.elastic,
            totals.kinetic,
        ];
        numbers.extend(sums(energies, &by_name, names.len()));
        numbers.extend(sums(energies, &by_part, parts.len()));
        numbers.extend([row.residual_force_pn, row.residual_torque_pn_nm]);
        numbers.extend(of_supplied.iter().map(|of| of(&row.booked)));
        Ok(numbers.into_iter().map(Cell::Number))
    };
    let energies = ["total", "potential", "elastic", "kinetic"].map(str::to_owned);
    let energies = energies
        .into_iter()
        .chain(names.iter().map(ToString::to_string))
        .chain(parts.iter().map(|part| assembly.name_of(*part)));
    let mut columns = vec![clock(assembly).to_owned()];
    columns.extend(energies.map(|name| format!("{name}_pn_nm")));
    columns.extend(["residual_force_pn", "residual_torque_pn_nm"].map(str::to_owned));
    columns.extend(supplied.into_iter().map(str::to_owned));
    table::write(ENERGIES, &columns, records.iter().map(row), out)
}

/// Sums of the energies that have the same place.
fn sums(energies: &[f64], places: &[usize], count: usize) -> Vec<f64> {
    // Adding to -0.0 preserves the sign of a term of -0.0.
    let mut sums = vec![-0.0; count];
    for (energy, &place) in energies.iter().zip(places) {
        sums[place] += energy;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture;

    fn table_of(assembly: &Assembly, records: &dyn Records) -> (Vec<String>, Vec<Vec<f64>>) {
        let mut bytes = Vec::new();
        write(assembly, records, &mut bytes).unwrap();
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
