//! Tests of pictures, parsed with vtkio.

use super::*;
use actin_sim::mechanics::Matrix3;
use vtkio::model::{Attribute, IOBuffer, PolyDataPiece, VertexNumbers};

fn drawn() -> (Assembly, State, Box<PolyDataPiece>) {
    let assembly = fixture::mixed();
    let state = fixture::state(&assembly);
    let mut bytes = Vec::new();
    let pictures = VtkPictures::new(&assembly);
    pictures.write(At::Time(0.1), &state, &mut bytes).unwrap();
    (assembly, state, fixture::parsed(&bytes))
}

fn data<'a>(piece: &'a PolyDataPiece, name: &str) -> &'a IOBuffer {
    let named = |attribute: &'a Attribute| match attribute {
        Attribute::DataArray(array) if array.name == name => Some(&array.data),
        _ => None,
    };
    piece.data.point.iter().find_map(named).unwrap()
}

fn floats(buffer: &IOBuffer) -> &[f64] {
    let IOBuffer::F64(values) = buffer else {
        panic!("not 64-bit floats");
    };
    values
}

#[test]
fn points_are_positions() {
    let (assembly, state, piece) = drawn();
    let points = floats(&piece.points);
    assert_eq!(points.len(), 3 * assembly.points.len());
    for (i, expected) in state.points.position.iter().enumerate() {
        assert_eq!(points[3 * i..3 * i + 3], *expected.as_slice());
    }
    let s_nm: Vec<f64> = assembly.points.iter().map(|p| p.s_nm).collect();
    assert_eq!(floats(data(&piece, "s_nm")), s_nm);
}

#[test]
fn monomers_are_vertices_and_rods_are_lines() {
    let (assembly, _, piece) = drawn();
    let indices = |range: std::ops::Range<usize>| range.map(|i| i as u64).collect::<Vec<_>>();
    let [monomers, rod] = assembly.sections.as_slice() else {
        panic!("two sections");
    };
    let Some(VertexNumbers::XML { connectivity, .. }) = &piece.verts else {
        panic!("no vertices");
    };
    assert_eq!(*connectivity, indices(monomers.points.clone()));
    let Some(VertexNumbers::XML {
        connectivity,
        offsets,
    }) = &piece.lines
    else {
        panic!("no lines");
    };
    assert_eq!(*connectivity, indices(rod.points.clone()));
    assert_eq!(*offsets, [rod.points.len() as u64]);
    let IOBuffer::I64(section) = data(&piece, "section") else {
        panic!("not integers");
    };
    assert!(monomers.points.clone().all(|i| section[i] == 0));
    assert!(rod.points.clone().all(|i| section[i] == 1));
}

/// A monomer has its own frame. In a rod of n segments, node i < n has frame i and the last node
/// has frame n - 1. The frame of a junction lies between both and belongs to no point.
#[test]
fn points_carry_the_frames_next_to_them() {
    let (assembly, state, piece) = drawn();
    let quaternions = floats(data(&piece, "orientation"));
    let at = |i: usize| &quaternions[4 * i..4 * i + 4];
    let expected = |f: usize| {
        let q = state.frames.orientation.get(f);
        [q.w, q.i, q.j, q.k]
    };
    let [monomers, rod] = assembly.sections.as_slice() else {
        panic!("two sections");
    };
    for (i, f) in monomers.points.clone().zip(monomers.frames.clone()) {
        assert_eq!(at(i), expected(f));
    }
    for (i, f) in rod.points.clone().zip(rod.frames.clone()) {
        assert_eq!(at(i), expected(f));
    }
    assert_eq!(at(rod.points.end - 1), expected(rod.frames.end - 1));
}

/// d1, d2 and d3 are the columns of the rotation from body to lab.
#[test]
fn axes_are_the_columns_of_the_orientation() {
    let (assembly, state, piece) = drawn();
    let frame = assembly.points[0].frame.unwrap();
    let q: Matrix3 = state
        .frames
        .orientation
        .get(frame)
        .to_rotation_matrix()
        .into();
    for (name, column) in [("d1", 0), ("d2", 1), ("d3", 2)] {
        let axis = Vector3::from_column_slice(&floats(data(&piece, name))[..3]);
        // Rotation by the quaternion and by the matrix differ in round-off.
        assert!((axis - q.column(column)).norm() < 1e-15, "{name}");
    }
}

#[test]
fn only_monomers_have_semi_axes() {
    let (assembly, _, piece) = drawn();
    let semi_axes = floats(data(&piece, "semi_axes_nm"));
    let IOBuffer::U8(kinds) = data(&piece, "kind") else {
        panic!("not bytes");
    };
    for (i, point) in assembly.points.iter().enumerate() {
        let (kind, expected) = match point.kind {
            BodyKind::Monomer => (0, assembly.scene.filament.monomers.semi_axes_nm),
            _ => (1, [0.0; 3]),
        };
        assert_eq!(semi_axes[3 * i..3 * i + 3], expected);
        assert_eq!(kinds[i], kind);
    }
}

/// No line joins two filaments, and monomers have the semi-axes of their own filament.
#[test]
fn filaments_are_separate() {
    let assembly = fixture::pair();
    let drawing = VtkPictures::new(&assembly);
    let first = assembly.filaments[0].points.end;
    for line in drawing.lines() {
        assert!(line.end <= first || line.start >= first);
    }
    assert_eq!(drawing.lines().len(), 2);
    let filaments = drawing.filaments();
    assert_eq!((filaments[first - 1], filaments[first]), (0, 1));
    // Sections are numbered within a filament, as in `energies.csv`.
    let sections = drawing.sections();
    for filament in 0..2 {
        for (k, span) in assembly.sections_of(filament).iter().enumerate() {
            let expected = poly_data::to_i64(k);
            assert!(span.points.clone().all(|i| sections[i] == expected));
        }
    }
    assert_eq!((sections[0], sections[first]), (0, 0));
    let semi_axes = drawing.semi_axes_nm();
    let expected = [0, 1].map(|f| assembly.monomers_of(f).semi_axes_nm);
    assert_eq!(semi_axes[..3], expected[0]);
    assert_eq!(semi_axes[3 * first..3 * first + 3], expected[1]);
}

/// Times have all digits, and the title is escaped.
#[test]
fn the_collection_lists_pictures_and_times() {
    let pictures = [(0.0, "vtk/0000.vtp"), (1.0 / 3.0, "vtk/0001.vtp")];
    let pictures = pictures.map(|(time, name)| Ok((time, name.to_owned())));
    let mut text = Vec::new();
    write_collection("a \"b\" <c>", pictures.into_iter(), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let sets: Vec<&str> = text.lines().filter(|l| l.starts_with("<DataSet")).collect();
    assert_eq!(
        sets,
        [
            r#"<DataSet timestep="0.0" group="" part="0" name="a &quot;b&quot; &lt;c&gt;" file="vtk/0000.vtp"/>"#,
            r#"<DataSet timestep="0.3333333333333333" group="" part="0" name="a &quot;b&quot; &lt;c&gt;" file="vtk/0001.vtp"/>"#,
        ]
    );
}
