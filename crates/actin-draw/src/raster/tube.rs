//! Tubes with a stripe, and lines.

use super::{Canvas, Matrix3, Vector3};

/// Appearance of a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeStyle {
    /// Colour.
    pub colour: [u8; 3],
    /// Fraction of white in the stripes along the first axis, on both sides; 0 for no stripe.
    pub stripe: f64,
    /// Fraction of white in the seams at nodes.
    pub seam: f64,
}

/// Smallest cosine at which the stripe is drawn.
const STRIPE: f64 = 0.94;
/// Width of a seam (nm).
const SEAM_NM: f64 = 0.2;

/// A straight piece of a tube: ends, normals of the end planes, two transverse axes, and their rotations towards
/// adjacent pieces.
struct Piece {
    ends: [Vector3; 2],
    cuts: [Vector3; 2],
    axes: [Vector3; 2],
    turns: [f64; 2],
}

impl Canvas {
    /// Draws a tube of radius r (nm) through nodes, mitred between pieces. The columns of `frames` are the axes of
    /// each piece, which are interpolated between the middles of pieces.
    pub fn tube(&mut self, nodes: &[Vector3], frames: &[Matrix3], r: f64, look: TubeStyle) {
        let nodes: Vec<Vector3> = nodes.iter().map(|&p| self.camera.see(p)).collect();
        let axes = |k: usize| [0, 1].map(|c| self.camera.turn(frames[k].column(c).into()));
        let axes: Vec<[Vector3; 2]> = (0..frames.len()).map(axes).collect();
        let along: Vec<Vector3> = nodes
            .windows(2)
            .map(|p| (p[1] - p[0]).normalize())
            .collect();
        let last = along.len().saturating_sub(1);
        let turn = |i: usize, j: usize| {
            let seen = axes[j][0];
            seen.dot(&axes[i][1]).atan2(seen.dot(&axes[i][0]))
        };
        for (i, u) in along.iter().enumerate() {
            let before = if i == 0 {
                *u
            } else {
                (along[i - 1] + u).normalize()
            };
            let behind = if i == last {
                *u
            } else {
                (u + along[i + 1]).normalize()
            };
            let piece = Piece {
                ends: [nodes[i], nodes[i + 1]],
                cuts: [before, behind],
                axes: axes[i],
                turns: [
                    if i == 0 { 0.0 } else { turn(i, i - 1) },
                    if i == last { 0.0 } else { turn(i, i + 1) },
                ],
            };
            self.piece(&piece, r, look, 0.0);
        }
        if let (Some(first), Some(end)) = (along.first(), along.last()) {
            self.disc(nodes[0], *first, r, look.colour);
            self.disc(nodes[nodes.len() - 1], *end, r, look.colour);
        }
    }

    /// Draws a round line of radius r (nm) and at least a width in pixels; `nearer` is a depth offset (nm).
    pub fn line(
        &mut self,
        points: &[Vector3],
        (r, pixels): (f64, f64),
        colour: [u8; 3],
        nearer: f64,
    ) {
        let r = r.max(0.5 * pixels / self.camera.per_nm);
        let look = TubeStyle {
            colour,
            stripe: 0.0,
            seam: 1.0,
        };
        for &point in points {
            self.ball(point, r, colour, nearer);
        }
        for pair in points.windows(2) {
            let ends = [self.camera.see(pair[0]), self.camera.see(pair[1])];
            let Some(u) = (ends[1] - ends[0]).try_normalize(1e-12) else {
                continue;
            };
            let piece = Piece {
                ends,
                cuts: [u, u],
                axes: [u, u],
                turns: [0.0; 2],
            };
            self.piece(&piece, r, look, nearer);
        }
    }

    fn piece(&mut self, piece: &Piece, r: f64, look: TubeStyle, nearer: f64) {
        let [p, q] = piece.ends;
        let along = q - p;
        let length = along.norm();
        let u = along / length;
        let across = 1.0 - u.z * u.z;
        if across < 1e-9 {
            return; // seen end-on: the lateral surface is not visible
        }
        let middle = p + 0.5 * along;
        let half = [0, 1].map(|k| 0.5 * along[k].abs() + 1.4 * r);
        let area = self.area([middle.x, middle.y], half);
        for row in area.rows {
            for column in area.columns.clone() {
                let [x, y] = self.place(column, row);
                let (x, y) = (x - p.x, y - p.y);
                let g = x * u.x + y * u.y;
                let root = g * g * u.z * u.z - across * (x * x + y * y - g * g - r * r);
                if root < 0.0 {
                    continue;
                }
                let z = (g * u.z + root.sqrt()) / across;
                let here = Vector3::new(x, y, z);
                let edge = here
                    .dot(&piece.cuts[0])
                    .min((along - here).dot(&piece.cuts[1]));
                if edge < 0.0 {
                    continue;
                }
                let s = g + z * u.z;
                let normal = (here - s * u) / r;
                let colour = piece.colour((s / length, edge), normal, look);
                self.paint((column, row), (p.z + z, nearer), normal, colour);
            }
        }
    }

    /// Draws a disc with centre c and unit normal n, in camera coordinates.
    fn disc(&mut self, c: Vector3, n: Vector3, r: f64, colour: [u8; 3]) {
        let n = if n.z < 0.0 { -n } else { n };
        if n.z < 1e-6 {
            return; // edge on
        }
        let area = self.area([c.x, c.y], [r, r]);
        for row in area.rows {
            for column in area.columns.clone() {
                let [x, y] = self.place(column, row);
                let (x, y) = (x - c.x, y - c.y);
                let z = -(x * n.x + y * n.y) / n.z;
                if x * x + y * y + z * z <= r * r {
                    self.paint((column, row), (c.z + z, 0.0), n, colour.map(f64::from));
                }
            }
        }
    }
}

impl Piece {
    /// Returns the colour at a fraction of the length, at a distance from the nearer end (nm), with normal n.
    fn colour(&self, (share, edge): (f64, f64), n: Vector3, look: TubeStyle) -> [f64; 3] {
        let colour = look.colour.map(f64::from);
        if look.stripe == 0.0 {
            return colour;
        }
        if edge < SEAM_NM {
            return colour.map(|v| v * look.seam);
        }
        let t = share - 0.5;
        let angle = if t < 0.0 {
            -t * self.turns[0]
        } else {
            t * self.turns[1]
        };
        let seen = n.dot(&self.axes[0]) * angle.cos() + n.dot(&self.axes[1]) * angle.sin();
        if seen.abs() > STRIPE {
            colour.map(|v| v + look.stripe * (255.0 - v))
        } else {
            colour
        }
    }
}
