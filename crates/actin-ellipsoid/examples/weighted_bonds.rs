//! Prints the quadrature bonds of an interface and their certificate in the format of
//! `src/cubature/table.rs`.
//!
//! `cargo run -p actin-ellipsoid --example weighted_bonds [POINTS] [SHORTEST_NM]`

use actin_ellipsoid::{Cubature, EllipsoidParameters, InterfaceKind};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut parameters = EllipsoidParameters::default();
    let points = arguments.next().map_or(Ok(12), |text| text.parse())?;
    let shortest: Option<f64> = arguments.next().map(|text| text.parse()).transpose()?;
    for interface in [&mut parameters.lateral, &mut parameters.longitudinal] {
        interface.bonds = points;
        interface.minimum_length = shortest.unwrap_or(interface.minimum_length);
    }
    for kind in InterfaceKind::ALL {
        print(kind, &*Cubature::for_interface(&parameters, kind)?);
    }
    Ok(())
}

fn print(kind: InterfaceKind, found: &Cubature) {
    let name = kind.to_string().to_uppercase();
    let certificate = found.certificate;
    let list = |numbers: &[f64]| {
        let numbers: Vec<String> = numbers.iter().map(|x| grouped(*x)).collect();
        format!("[{}]", numbers.join(", "))
    };
    println!("static {name}: Known = Known {{\n    certificate: MomentCheck {{");
    println!("        residual: {:.3e},", certificate.residual);
    println!("        weights: {},", list(&certificate.weights));
    println!("        lengths: {},", list(&certificate.lengths));
    println!(
        "        drawn_lengths: {},",
        list(&certificate.drawn_lengths)
    );
    println!(
        "        outside: {},\n    }},\n    points: &[",
        certificate.outside
    );
    for point in &found.points {
        let [x, y] = point.place;
        println!(
            "        {},",
            list(&[x, y, point.height, point.length, point.weight])
        );
    }
    println!("    ],\n}};\n");
}

/// Twelve decimals in groups of three.
fn grouped(x: f64) -> String {
    let text = format!("{x:.12}");
    let (whole, decimals) = text.split_once('.').unwrap_or((&text, ""));
    let groups = decimals.as_bytes().chunks(3).map(String::from_utf8_lossy);
    format!("{whole}.{}", groups.collect::<Vec<_>>().join("_"))
}
