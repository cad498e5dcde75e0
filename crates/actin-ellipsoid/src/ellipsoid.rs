//! Ellipsoid geometry and inertia.

use crate::EllipsoidParameterError;
use crate::stream::Stream;
use actin_mechanics::{Inertia, Vector3};

/// An ellipsoid about the origin with its principal axes along x, y and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    semi_axes: Vector3,
}

impl Ellipsoid {
    /// Ellipsoid with the given semi-axes (nm), without validation.
    pub fn new(semi_axes: [f64; 3]) -> Self {
        Self {
            semi_axes: semi_axes.into(),
        }
    }

    /// Semi-axes along x, y and z (nm).
    pub(crate) fn semi_axes(&self) -> [f64; 3] {
        self.semi_axes.into()
    }

    /// Inertia of the solid ellipsoid: `m (b^2 + c^2) / 5` about x, and cyclically.
    ///
    /// # Errors
    /// Three different semi-axes: the body must be a symmetric top.
    ///
    /// ```
    /// use actin_ellipsoid::Ellipsoid;
    /// let inertia = Ellipsoid::new([1.9, 2.7, 2.7]).inertia(1.0).unwrap();
    /// assert!((inertia.axial - 2.916).abs() < 1e-12);
    /// assert!((inertia.transverse - 2.18).abs() < 1e-12);
    /// ```
    pub fn inertia(&self, mass: f64) -> Result<Inertia, EllipsoidParameterError> {
        let square = self.semi_axes.component_mul(&self.semi_axes);
        let moments = (Vector3::from_element(square.sum()) - square) * (mass / 5.0);
        Inertia::from_moments(moments.into()).map_err(|reason| EllipsoidParameterError::NotATop {
            semi_axes: self.semi_axes(),
            reason,
        })
    }

    /// Outward normal at a point of the surface, not normalised.
    pub(crate) fn normal(&self, point: Vector3) -> Vector3 {
        point
            .component_div(&self.semi_axes)
            .component_div(&self.semi_axes)
    }

    /// Parameters `lambda` of the intersections `origin + lambda direction` with the surface, in
    /// ascending order. Returns `None` if the line misses, and equal values if it is tangent.
    ///
    /// With origin and direction divided by the semi-axes, `u` and `v`, they are the roots of
    /// `|v|^2 lambda^2 + 2 u.v lambda + |u|^2 - 1 = 0`, computed without cancellation.
    ///
    /// ```
    /// use actin_ellipsoid::Ellipsoid;
    /// use actin_mechanics::Vector3;
    /// let roots = Ellipsoid::new([1.0, 1.0, 2.0])
    ///     .line_intersections(Vector3::new(0.0, 0.0, -5.0), Vector3::z());
    /// assert_eq!(roots, Some([3.0, 7.0]));
    /// ```
    pub fn line_intersections(&self, origin: Vector3, direction: Vector3) -> Option<[f64; 2]> {
        let u = origin.component_div(&self.semi_axes);
        let v = direction.component_div(&self.semi_axes);
        let (a, b, c) = (v.norm_squared(), u.dot(&v), u.norm_squared() - 1.0);
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return None;
        }
        let q = -(b + discriminant.sqrt().copysign(b));
        if q == 0.0 {
            // b = c = 0: the line is tangent at its origin.
            return Some([0.0; 2]);
        }
        let (first, second) = (q / a, c / q);
        Some([first.min(second), first.max(second)])
    }

    /// Random point, uniform on the surface.
    ///
    /// A direction `q`, uniform on the sphere, is scaled to `(a q_x, b q_y, c q_z)`, which
    /// stretches the area by `a b c |q / (a, b, c)|`, and accepted with probability
    /// `min(a, b, c) |q / (a, b, c)| <= 1`.
    ///
    /// # Source
    /// arXiv 2203.01284, Appendix A, whose `c` is the smallest semi-axis.
    pub(crate) fn sample(&self, stream: &mut Stream) -> Vector3 {
        let smallest = self.semi_axes.min();
        loop {
            let q = stream.direction();
            let probability = smallest * q.component_div(&self.semi_axes).norm();
            if stream.uniform() < probability {
                return q.component_mul(&self.semi_axes);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Xorshift;
    use std::f64::consts::FRAC_PI_2;

    /// Bins: slices of equal height of the unit sphere, divided by azimuth, in one octant.
    const SLICES: usize = 6;
    const SECTORS: usize = 5;

    fn bin(ellipsoid: &Ellipsoid, point: Vector3) -> usize {
        let q = point.component_div(&ellipsoid.semi_axes).abs();
        let part = |x: f64, n: usize| (1..n).filter(|k| x * n as f64 >= *k as f64).count();
        part(q.z, SLICES) * SECTORS + part(q.y.atan2(q.x) / FRAC_PI_2, SECTORS)
    }

    /// Midpoint rule with the area element `a b c |q / (a, b, c)|`; relative accuracy 1e-4.
    fn shares(ellipsoid: &Ellipsoid) -> Vec<f64> {
        const STEPS: usize = 40;
        let mut areas = vec![0.0; SLICES * SECTORS];
        for i in 0..SLICES * STEPS {
            for j in 0..SECTORS * STEPS {
                let z = (i as f64 + 0.5) / (SLICES * STEPS) as f64;
                let azimuth = (j as f64 + 0.5) / (SECTORS * STEPS) as f64 * FRAC_PI_2;
                let r = (1.0 - z * z).sqrt();
                let q = Vector3::new(r * azimuth.cos(), r * azimuth.sin(), z);
                areas[i / STEPS * SECTORS + j / STEPS] +=
                    q.component_div(&ellipsoid.semi_axes).norm();
            }
        }
        let total: f64 = areas.iter().sum();
        areas.iter().map(|a| a / total).collect()
    }

    fn chi_square(ellipsoid: &Ellipsoid, draw: impl Fn(&mut Stream) -> Vector3) -> f64 {
        const POINTS: usize = 100_000;
        let mut stream = Stream::new(11, 0, 0);
        let mut counts = vec![0.0; SLICES * SECTORS];
        for _ in 0..POINTS {
            counts[bin(ellipsoid, draw(&mut stream))] += 1.0;
        }
        let expected = shares(ellipsoid).into_iter().map(|s| s * POINTS as f64);
        counts
            .iter()
            .zip(expected)
            .map(|(n, e)| (n - e).powi(2) / e)
            .sum()
    }

    /// Mean plus five standard deviations.
    fn bound() -> f64 {
        let freedoms = (SLICES * SECTORS - 1) as f64;
        freedoms + 5.0 * (2.0 * freedoms).sqrt()
    }

    /// Scaling by the third semi-axis instead of the smallest would truncate probabilities at 1.
    #[test]
    fn samples_are_uniform_on_the_surface() {
        for semi_axes in [
            [1.9, 2.7, 2.7],
            [2.7, 2.7, 1.9],
            [1.0, 3.0, 2.0],
            [3.0, 1.0, 2.0],
            [2.0, 2.0, 2.0],
        ] {
            let ellipsoid = Ellipsoid::new(semi_axes);
            let chi_square = chi_square(&ellipsoid, |stream| ellipsoid.sample(stream));
            assert!(chi_square < bound(), "{semi_axes:?}: {chi_square}");
        }
    }

    #[test]
    fn scaled_directions_are_not_uniform() {
        let ellipsoid = Ellipsoid::new([1.9, 2.7, 2.7]);
        let scaled = |stream: &mut Stream| stream.direction().component_mul(&ellipsoid.semi_axes);
        assert!(chi_square(&ellipsoid, scaled) > 10.0 * bound());
    }

    #[test]
    fn sphere_keeps_every_direction() {
        let sphere = Ellipsoid::new([2.0; 3]);
        let (mut points, mut directions) = (Stream::new(3, 0, 0), Stream::new(3, 0, 0));
        for _ in 0..1000 {
            let direction = directions.direction();
            directions.uniform();
            assert!((sphere.sample(&mut points) - 2.0 * direction).norm() < 1e-15);
        }
    }

    #[test]
    fn samples_lie_on_the_surface() {
        let ellipsoid = Ellipsoid::new([1.9, 2.7, 2.7]);
        let mut stream = Stream::new(5, 0, 0);
        for _ in 0..1000 {
            let point = ellipsoid.sample(&mut stream);
            assert!((ellipsoid.normal(point).dot(&point) - 1.0).abs() < 1e-14);
        }
    }

    /// Distant origins would lose the nearer root to cancellation.
    #[test]
    fn lines_meet_the_surface_twice() {
        let ellipsoid = Ellipsoid::new([1.9, 2.7, 2.7]);
        let mut noise = Xorshift::new(2);
        for distance in [0.0, 3.0, 100.0] {
            for _ in 0..100 {
                let direction = noise.vector().normalize();
                let origin = noise.vector() - distance * direction;
                let [near, far] = ellipsoid.line_intersections(origin, direction).unwrap();
                assert!(near < far);
                for lambda in [near, far] {
                    let point = origin + lambda * direction;
                    let level = ellipsoid.normal(point).dot(&point);
                    // The rounding error at 100 nm is 1e-14 nm.
                    assert!((level - 1.0).abs() < 1e-13 * (1.0 + distance), "{level}");
                }
            }
        }
    }

    #[test]
    fn lines_that_miss_or_touch() {
        let sphere = Ellipsoid::new([2.0; 3]);
        let at = |x: f64| sphere.line_intersections(Vector3::new(x, 0.0, 0.0), Vector3::z());
        assert_eq!(at(2.1), None);
        assert_eq!(at(2.0), Some([0.0, 0.0]));
        assert_eq!(at(0.0), Some([-2.0, 2.0]));
    }
}
