//! Rendering of solids to pixels.

use super::{Camera, Matrix3, Vector3};

/// Supersampling factor along each side.
pub(super) const FINER: usize = 2;

const LIGHT: [f64; 3] = [-0.45, 0.6, 0.75];

/// A pixel: colour, depth (nm towards the viewer), and whether it casts shade.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) colour: [f32; 3],
    pub(super) depth: f32,
    pub(super) is_body: bool,
}

impl Cell {
    pub(super) const EMPTY: Self = Self {
        colour: [0.0; 3],
        depth: f32::NEG_INFINITY,
        is_body: false,
    };

    pub(super) fn is_empty(&self) -> bool {
        self.depth == f32::NEG_INFINITY
    }
}

/// A picture under construction.
#[derive(Clone, Debug)]
pub struct Canvas {
    pub(super) size: [usize; 2],
    pub(super) camera: Camera,
    pub(super) cells: Vec<Cell>,
    light: Vector3,
    half: Vector3,
}

pub(super) struct Area {
    pub(super) columns: std::ops::Range<usize>,
    pub(super) rows: std::ops::Range<usize>,
}

impl Canvas {
    /// Creates an empty picture with a width and height in pixels.
    pub fn new([width, height]: [usize; 2], camera: Camera) -> Self {
        let size = [FINER * width, FINER * height];
        let light = Vector3::from(LIGHT).normalize();
        Self {
            size,
            camera,
            cells: vec![Cell::EMPTY; size[0] * size[1]],
            light,
            half: (light + Vector3::z()).normalize(),
        }
    }

    /// Returns pixels of the finished picture per nm.
    pub fn per_nm(&self) -> f64 {
        self.camera.per_nm
    }

    /// Returns the direction towards the viewer (lab frame).
    pub fn towards_viewer(&self) -> Vector3 {
        self.camera.rows[2]
    }

    pub(super) fn scale(&self) -> f64 {
        FINER as f64 * self.camera.per_nm
    }

    /// Returns the cells of a box centred at (x, y) in camera coordinates, with half widths `half` (nm).
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "casts to integers saturate, and are clamped to the picture"
    )]
    pub(super) fn area(&self, [x, y]: [f64; 2], half: [f64; 2]) -> Area {
        let [width, height] = self.size;
        let scale = self.scale();
        let range = |middle: f64, half: f64, most: usize| {
            let from = (middle - scale * half).floor().max(0.0) as usize;
            let to = ((middle + scale * half).ceil().max(0.0) as usize).min(most);
            from.min(to)..to
        };
        Area {
            columns: range(0.5 * width as f64 + scale * x, half[0], width),
            rows: range(0.5 * height as f64 - scale * y, half[1], height),
        }
    }

    pub(super) fn place(&self, column: usize, row: usize) -> [f64; 2] {
        let [width, height] = self.size;
        let scale = self.scale();
        [
            (column as f64 + 0.5 - 0.5 * width as f64) / scale,
            (0.5 * height as f64 - row as f64 - 0.5) / scale,
        ]
    }

    /// Colours a cell at depth z with normal n, unless it is hidden.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "colours and depths of pictures"
    )]
    pub(super) fn paint(
        &mut self,
        (column, row): (usize, usize),
        (z, nearer): (f64, f64),
        n: Vector3,
        colour: [f64; 3],
    ) {
        let depth = (z + nearer) as f32;
        let at = row * self.size[0] + column;
        if depth <= self.cells[at].depth {
            return;
        }
        let lit = n.dot(&self.light).max(0.0);
        let shine = 0.16 * 255.0 * n.dot(&self.half).max(0.0).powi(40);
        let up = 0.5 + 0.5 * n.y;
        let sky = [(0.50, 0.60), (0.47, 0.61), (0.45, 0.64)].map(|(a, b)| a + up * (b - a));
        let colour = [0, 1, 2].map(|k| (colour[k] * (sky[k] + 0.52 * lit) + shine) as f32);
        self.cells[at] = Cell {
            colour,
            depth,
            is_body: nearer == 0.0,
        };
    }

    /// Draws an ellipsoid. The columns of `semi_axes` are its orthogonal semi-axes (nm, lab frame); `nearer` is a
    /// depth offset (nm).
    pub fn ellipsoid(&mut self, centre: Vector3, semi_axes: Matrix3, colour: [u8; 3], nearer: f64) {
        let axes = [0, 1, 2].map(|k| self.camera.turn(semi_axes.column(k).into()));
        // The ellipsoid is the set of points p with p^T M p = 1.
        let m: Matrix3 = axes
            .iter()
            .map(|a| a * a.transpose() / a.norm_squared().powi(2))
            .sum();
        let c = self.camera.see(centre);
        let half = [0, 1].map(|k| axes.iter().map(|a| a[k] * a[k]).sum::<f64>().sqrt());
        let area = self.area([c.x, c.y], half);
        let colour = colour.map(f64::from);
        for row in area.rows {
            for column in area.columns.clone() {
                let [x, y] = self.place(column, row);
                let (x, y) = (x - c.x, y - c.y);
                let b = m[(0, 2)] * x + m[(1, 2)] * y;
                let rest = m[(0, 0)] * x * x + 2.0 * m[(0, 1)] * x * y + m[(1, 1)] * y * y - 1.0;
                let root = b * b - m[(2, 2)] * rest;
                if root < 0.0 {
                    continue;
                }
                let z = (root.sqrt() - b) / m[(2, 2)];
                let normal = (m * Vector3::new(x, y, z)).normalize();
                self.paint((column, row), (c.z + z, nearer), normal, colour);
            }
        }
    }

    /// Draws a sphere of radius r (nm).
    pub fn ball(&mut self, centre: Vector3, r: f64, colour: [u8; 3], nearer: f64) {
        self.ellipsoid(centre, Matrix3::identity() * r, colour, nearer);
    }
}
