//! Tubes with a stripe, and lines.

use super::{Canvas, Matrix3, Vector3};

/// How a tube looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Its colour.
    pub colour: [u8; 3],
    /// Share of white of the stripe along its first axis, on both sides; none at 0.
    pub stripe: f64,
    /// Share of light of the seams at its nodes.
    pub seam: f64,
}

/// The cosine from which on the stripe is seen.
const STRIPE: f64 = 0.94;
/// Width of a seam (nm).
const SEAM_NM: f64 = 0.2;

/// A straight piece: its ends, the normals of the planes that end it, two axes across it, and how these turn
/// towards the pieces before and behind.
struct Piece {
    ends: [Vector3; 2],
    cuts: [Vector3; 2],
    axes: [Vector3; 2],
    turns: [f64; 2],
}

impl Canvas {
    /// A tube of radius r (nm) through nodes, mitred where pieces meet. `frames` has the axes of each piece as
    /// columns; between the middles of pieces they turn evenly about the tube.
    pub fn tube(&mut self, nodes: &[Vector3], frames: &[Matrix3], r: f64, look: Look) {
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

    /// A round line of radius r (nm), of at least so many pixels; it counts `nearer` than it is (nm).
    pub fn line(
        &mut self,
        points: &[Vector3],
        (r, pixels): (f64, f64),
        colour: [u8; 3],
        nearer: f64,
    ) {
        let r = r.max(0.5 * pixels / self.camera.per_nm);
        let look = Look {
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

    /// The mantle of a piece, seen by the camera.
    fn piece(&mut self, piece: &Piece, r: f64, look: Look, nearer: f64) {
        let [p, q] = piece.ends;
        let along = q - p;
        let length = along.norm();
        let u = along / length;
        let across = 1.0 - u.z * u.z;
        if across < 1e-9 {
            return; // seen from its end: nothing of the mantle shows
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

    /// A disc about c across the unit vector n, both as seen.
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
    /// The colour at a share of the way, so far from the nearer end (nm), where the normal is n.
    fn colour(&self, (share, edge): (f64, f64), n: Vector3, look: Look) -> [f64; 3] {
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
