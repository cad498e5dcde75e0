//! Writer of VTK `PolyData` files: points with data, vertices and lines.
//!
//! Data are stored as base64 of their length (64 bits) and their little-endian bytes. This
//! preserves all bits and takes half the space of decimal numbers.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::io::{self, Write};
use std::ops::Range;

#[derive(Debug)]
pub(super) enum Values {
    Float64(Vec<f64>),
    Int64(Vec<i64>),
    UInt8(Vec<u8>),
}

impl Values {
    fn type_name(&self) -> &'static str {
        match self {
            Self::Float64(_) => "Float64",
            Self::Int64(_) => "Int64",
            Self::UInt8(_) => "UInt8",
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Float64(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::Int64(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::UInt8(values) => values.clone(),
        }
    }
}

/// Named array with `components` values per point.
#[derive(Debug)]
pub(super) struct Array {
    pub name: &'static str,
    pub components: usize,
    /// Values, with the component index fastest.
    pub values: Values,
}

#[derive(Debug)]
pub(super) struct PolyData {
    /// Time in the unit of the caller.
    pub time: f64,
    pub texts: Vec<(&'static str, Vec<&'static str>)>,
    pub points: Vec<f64>,
    pub arrays: Vec<Array>,
    /// Indices of points that are vertices.
    pub vertices: Vec<usize>,
    /// Ranges of points that form lines.
    pub lines: Vec<Range<usize>>,
}

impl PolyData {
    /// Writes the file (VTK XML format 1.0).
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        writeln!(
            out,
            r#"<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
        )?;
        writeln!(out, "<PolyData>")?;
        self.write_field(out)?;
        writeln!(
            out,
            r#"<Piece NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfStrips="0" NumberOfPolys="0">"#,
            self.points.len() / 3,
            self.vertices.len(),
            self.lines.len()
        )?;
        self.write_points(out)?;
        self.write_cells(out)?;
        writeln!(out, "</Piece>\n</PolyData>\n</VTKFile>")
    }

    /// Writes the time under the name used by VTK readers, and texts as zero-terminated character
    /// codes.
    fn write_field(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "<FieldData>")?;
        writeln!(
            out,
            r#"<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="binary">{}</DataArray>"#,
            block(&self.time.to_le_bytes())
        )?;
        for (name, texts) in &self.texts {
            let count = texts.len();
            let of_text = |text: &&str| text.bytes().chain([0]).collect::<Vec<_>>();
            let bytes = texts.iter().flat_map(of_text).map(|byte| byte.to_string());
            let bytes = bytes.collect::<Vec<_>>().join(" ");
            writeln!(
                out,
                r#"<Array type="String" Name="{name}" NumberOfTuples="{count}" format="ascii">{bytes}</Array>"#
            )?;
        }
        writeln!(out, "</FieldData>")
    }

    fn write_points(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "<PointData>")?;
        for array in &self.arrays {
            write_array(out, array.name, array.components, &array.values)?;
        }
        writeln!(out, "</PointData>\n<Points>")?;
        // The copy is small compared with the encoded text.
        write_array(out, "Points", 3, &Values::Float64(self.points.clone()))?;
        writeln!(out, "</Points>")
    }

    fn write_cells(&self, out: &mut impl Write) -> io::Result<()> {
        let single = self.vertices.iter().map(|&i| i..i + 1);
        write_kind(out, "Verts", single)?;
        write_kind(out, "Lines", self.lines.iter().cloned())
    }
}

/// Writes cells of one kind: the points of all cells and the end offset of each cell.
fn write_kind(
    out: &mut impl Write,
    kind: &str,
    cells: impl Iterator<Item = Range<usize>> + Clone,
) -> io::Result<()> {
    let connectivity = cells.clone().flatten().map(to_i64).collect();
    let offsets = cells
        .scan(0, |end, cell| {
            *end += cell.len();
            Some(to_i64(*end))
        })
        .collect();
    writeln!(out, "<{kind}>")?;
    write_array(out, "connectivity", 1, &Values::Int64(connectivity))?;
    write_array(out, "offsets", 1, &Values::Int64(offsets))?;
    writeln!(out, "</{kind}>")
}

fn write_array(
    out: &mut impl Write,
    name: &str,
    components: usize,
    values: &Values,
) -> io::Result<()> {
    writeln!(
        out,
        r#"<DataArray type="{}" Name="{name}" NumberOfComponents="{components}" format="binary">{}</DataArray>"#,
        values.type_name(),
        block(&values.bytes())
    )
}

fn block(bytes: &[u8]) -> String {
    let mut run = Vec::with_capacity(8 + bytes.len());
    run.extend((bytes.len() as u64).to_le_bytes());
    run.extend(bytes);
    STANDARD.encode(&run)
}

pub(super) fn to_i64(index: usize) -> i64 {
    i64::try_from(index).expect("an index into memory is below 2^63")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::fixture::parsed;
    use std::fmt::Debug;
    use vtkio::model::{Attribute, IOBuffer, PolyDataPiece, VertexNumbers};

    fn picture() -> PolyData {
        PolyData {
            time: 0.3,
            texts: vec![("kind_names", vec!["a", "bc"])],
            points: (0..15).map(|i| 1.0 / f64::from(i + 1)).collect(),
            arrays: vec![
                Array {
                    name: "kind",
                    components: 1,
                    values: Values::UInt8(vec![0, 0, 1, 1, 255]),
                },
                Array {
                    name: "section",
                    components: 1,
                    values: Values::Int64(vec![0, 0, 1, 1, -1]),
                },
                Array {
                    name: "pair",
                    components: 2,
                    values: Values::Float64(vec![
                        0.1, -0.0, 5e-324, 1e300, 1e-300, -2.5, 7.0, 8.0, 9.0, 10.0,
                    ]),
                },
            ],
            vertices: vec![0, 1],
            lines: std::iter::once(2..5).collect(),
        }
    }

    fn parse(picture: &PolyData) -> Box<PolyDataPiece> {
        let mut bytes = Vec::new();
        picture.write(&mut bytes).unwrap();
        parsed(&bytes)
    }

    fn floats(values: &[f64]) -> IOBuffer {
        IOBuffer::F64(values.to_vec())
    }

    fn assert_same(found: &impl Debug, expected: &impl Debug) {
        // Unlike `==`, `Debug` output distinguishes -0.0 from 0.0.
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
    }

    /// vtkio is independent of the writer. Values are compared bit for bit.
    #[test]
    fn vtkio_reads_back_what_was_written() {
        let picture = picture();
        let piece = parse(&picture);
        assert_same(&piece.points, &floats(&picture.points));
        let arrays: Vec<_> = piece
            .data
            .point
            .iter()
            .map(|attribute| match attribute {
                Attribute::DataArray(array) => (array.name.as_str(), &array.data),
                Attribute::Field { .. } => panic!("a field among the point data"),
            })
            .collect();
        let Values::Float64(pair) = &picture.arrays[2].values else {
            panic!();
        };
        let expected = [
            ("kind", &IOBuffer::U8(vec![0, 0, 1, 1, 255])),
            ("section", &IOBuffer::I64(vec![0, 0, 1, 1, -1])),
            ("pair", &floats(pair)),
        ];
        assert_same(&arrays, &expected);
    }

    /// `vtkStringArray` reads character codes in decimal.
    #[test]
    fn texts_are_written_as_characters() {
        let mut bytes = Vec::new();
        picture().write(&mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let expected = r#"<Array type="String" Name="kind_names" NumberOfTuples="2" format="ascii">97 0 98 99 0</Array>"#;
        assert!(text.contains(expected), "{text}");
    }

    /// Offsets are ends of cells: the first vertex ends at 1.
    #[test]
    fn vtkio_finds_vertices_and_lines() {
        let piece = parse(&picture());
        let cells = |connectivity: &[u64], offsets: &[u64]| {
            Some(VertexNumbers::XML {
                connectivity: connectivity.to_vec(),
                offsets: offsets.to_vec(),
            })
        };
        assert_eq!(piece.verts, cells(&[0, 1], &[1, 2]));
        assert_eq!(piece.lines, cells(&[2, 3, 4], &[3]));
    }

    #[test]
    fn a_picture_without_lines_is_read() {
        let picture = PolyData {
            lines: Vec::new(),
            ..picture()
        };
        let piece = parse(&picture);
        assert_same(&piece.points, &floats(&picture.points));
        let lines = piece.lines.map_or(0, |lines| match lines {
            VertexNumbers::XML { connectivity, .. } => connectivity.len(),
            VertexNumbers::Legacy { num_cells, .. } => num_cells as usize,
        });
        assert_eq!(lines, 0);
    }
}
