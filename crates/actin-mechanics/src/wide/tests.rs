//! Comparison of the wide functions with their scalar references for each number of lanes.

use super::*;
use crate::Xorshift;
use crate::testing::architectures;
use crate::{UnitQuaternion, Vector3, rotation};
use nalgebra::Unit;
use std::f64::consts::PI;

const COUNTS: [usize; 9] = [0, 1, 2, 3, 4, 5, 8, 15, 33];

/// Angles (rad): zero, the smallest numbers, both sides of each switch, nearly pi.
const ANGLES: [f64; 16] = [
    0.0,
    5e-324,
    1e-310,
    1e-160,
    1e-12,
    1e-8,
    1e-3,
    0.019,
    0.021,
    0.3,
    0.99,
    1.01,
    1.046,
    1.048,
    2.0,
    PI - 1e-6,
];

struct Logs<'a>(&'a [UnitQuaternion]);

impl WithSimd for Logs<'_> {
    type Output = Vec<(Vector3, f64)>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let part = |k: usize| self.0.iter().map(|q| q.as_vector()[k]).collect::<Vec<_>>();
        // nalgebra stores the scalar part last.
        let (w, x, y, z) = (part(3), part(0), part(1), part(2));
        let mut out = [w.clone(), w.clone(), w.clone(), w.clone()];
        let q = Columns::<S, 4>::new([&w, &x, &y, &z]);
        let mut logs = ColumnsMut::<S, 4>::new(out.each_mut().map(Vec::as_mut_slice));
        for group in 0..q.groups() {
            let ([x, y, z], c) = log_with_coefficient(simd, q.get(simd, group));
            logs.set(simd, group, [x, y, z, c]);
        }
        let log = |i: usize| (Vector3::new(out[0][i], out[1][i], out[2][i]), out[3][i]);
        (0..w.len()).map(log).collect()
    }
}

struct Turns<'a>(&'a [f64]);

impl WithSimd for Turns<'_> {
    type Output = [Vec<f64>; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut out = [self.0.to_vec(), self.0.to_vec()];
        let squared = Columns::<S, 1>::new([self.0]);
        let mut results = ColumnsMut::<S, 2>::new(out.each_mut().map(Vec::as_mut_slice));
        for group in 0..squared.groups() {
            let [u] = squared.get(simd, group);
            let [result, _] = cosine_and_sinc(simd, [u, simd.splat_f64s(0.0)]);
            results.set(simd, group, result);
        }
        out
    }
}

struct Tangents<'a>(&'a [f64]);

impl WithSimd for Tangents<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut out = self.0.to_vec();
        let mut results = ColumnsMut::<S, 1>::new([&mut out]);
        for group in 0..results.groups() {
            let [x] = results.get(simd, group);
            results.set(simd, group, [tanh(simd, x)]);
        }
        out
    }
}

struct Clamped<'a>(&'a [f64], f64);

impl WithSimd for Clamped<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut out = self.0.to_vec();
        let mut results = ColumnsMut::<S, 1>::new([&mut out]);
        for group in 0..results.groups() {
            let [x] = results.get(simd, group);
            results.set(simd, group, [clamp(simd, x, self.1)]);
        }
        out
    }
}

struct ShiftDown(usize);

impl WithSimd for ShiftDown {
    type Output = (Vec<f64>, f64);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut numbers: Vec<f64> = (1..=self.0).map(|i| i as f64).collect();
        let mut other = numbers.clone();
        let mut columns = ColumnsMut::<S, 2>::new([&mut numbers, &mut other]);
        let mut shift = ShiftedDown::new(simd);
        let mut first = 0.0;
        for group in 0..columns.groups() {
            let shifted = shift.next(simd, columns.get(simd, group));
            if group == 0 {
                let zero = simd.splat_f64s(0.0);
                first = lane(simd, S::F64_LANES - 1, [shifted[0], zero, zero]).x;
            } else {
                columns.set(simd, group - 1, shifted);
            }
        }
        if let Some(last) = columns.groups().checked_sub(1) {
            let zero = simd.splat_f64s(0.0);
            let shifted = shift.next(simd, [zero; 2]);
            columns.set(simd, last, shifted);
        }
        assert!(numbers == other);
        (numbers, first)
    }
}

struct OneLane(Vector3);

impl WithSimd for OneLane {
    type Output = Vec<Vec<Vector3>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let lanes = 0..S::F64_LANES;
        let held = |i: usize| {
            let all = in_lane(simd, i, self.0);
            lanes.clone().map(|j| lane(simd, j, all)).collect()
        };
        lanes.clone().map(held).collect()
    }
}

struct Shift(usize);

impl WithSimd for Shift {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut numbers: Vec<f64> = (1..=self.0).map(|i| i as f64).collect();
        let (mut y, mut z) = (numbers.clone(), numbers.clone());
        let mut columns = ColumnsMut::<S, 3>::new([&mut numbers, &mut y, &mut z]);
        let mut shift = ShiftedUp::new(simd);
        for group in 0..columns.groups() {
            let shifted = shift.next(simd, columns.get(simd, group));
            columns.set(simd, group, shifted);
        }
        assert!(numbers == y && numbers == z);
        numbers
    }
}

fn rotations() -> Vec<UnitQuaternion> {
    let mut noise = Xorshift::new(3);
    let mut all = Vec::new();
    for _ in 0..20 {
        for angle in ANGLES {
            let q = rotation::exp(noise.vector().normalize() * angle);
            all.extend([q, Unit::new_unchecked(-q.into_inner())]);
        }
    }
    all
}

/// Tolerance 3e-15 for rounding; the reference is accurate to 1e-14.
fn assert_logs_agree(q: &[UnitQuaternion]) {
    for arch in architectures() {
        for (q, (theta, c)) in q.iter().zip(arch.dispatch(Logs(q))) {
            let expected = rotation::log(*q);
            let error = (theta - expected).norm();
            assert!(error <= 3e-15 * expected.norm(), "{expected}: {error:e}");
            let expected = rotation::inverse_jacobian_coefficient(expected.norm_squared());
            assert!((c / expected - 1.0).abs() < 1e-14, "{c} for {expected}");
        }
    }
}

#[test]
fn logarithms_are_those_of_the_reference() {
    let all = rotations();
    let small = |q: &&UnitQuaternion| q.w.abs() > 0.87;
    assert_logs_agree(&all);
    assert_logs_agree(&all.iter().filter(small).copied().collect::<Vec<_>>());
    for count in COUNTS {
        assert_logs_agree(&all[..count]);
    }
}

#[test]
fn cosine_and_sinc_are_those_of_the_standard_library() {
    let mut small: Vec<f64> = (0..=1000).map(|i| 0.25 * f64::from(i) / 1000.0).collect();
    small.extend([5e-324, 1e-310, 1e-200, 1e-20]);
    let large: Vec<f64> = (1..100).map(|i| 0.3 * f64::from(i * i)).collect();
    for squared in [&small, &large] {
        for arch in architectures() {
            let [cosine, sinc] = arch.dispatch(Turns(squared));
            for (i, u) in squared.iter().enumerate() {
                let angle = u.sqrt();
                // Unit in the last place 2.2e-16; the square root of the reference adds another.
                assert!((cosine[i] - angle.cos()).abs() < 3e-16, "{angle}");
                let expected = if angle > 0.0 {
                    angle.sin() / angle
                } else {
                    1.0
                };
                assert!((sinc[i] - expected).abs() < 3e-16, "{angle}");
            }
        }
    }
}

#[test]
fn lanes_do_not_leak() {
    let mut q = rotations();
    q.truncate(13);
    let whole = Arch::new().dispatch(Logs(&q));
    q[6] = Unit::new_unchecked(nalgebra::Quaternion::new(f64::NAN, 0.0, 0.0, 0.0) + *q[6]);
    let broken = Arch::new().dispatch(Logs(&q));
    for (i, (a, b)) in whole.iter().zip(&broken).enumerate() {
        if i != 6 {
            assert!((a.0 - b.0).norm() <= 3e-15 * a.0.norm(), "body {i}");
        }
    }
    let turns = Arch::new().dispatch(Turns(&[0.1, f64::NAN, 0.2]));
    assert!(
        turns
            .iter()
            .all(|t| t[0] < 1.0 && t[1].is_nan() && t[2] < 1.0)
    );
}

#[test]
fn numbers_are_shifted_up() {
    for arch in architectures() {
        for count in COUNTS {
            let expected: Vec<f64> = (0..count).map(|i| i as f64).collect();
            assert_eq!(arch.dispatch(Shift(count)), expected);
        }
    }
}

#[test]
fn numbers_are_shifted_down() {
    for arch in architectures() {
        for count in COUNTS {
            let expected: Vec<f64> = (2..=count).map(|i| i as f64).chain([0.0]).collect();
            let (numbers, first) = arch.dispatch(ShiftDown(count));
            assert_eq!(numbers, expected[..count]);
            assert_eq!(first > 0.5, count > 0);
        }
    }
}

#[test]
fn a_vector_is_in_one_lane_only() {
    let v = Vector3::new(1.0, -2.0, 3.0);
    for arch in architectures() {
        let held = arch.dispatch(OneLane(v));
        for (i, lanes) in held.iter().enumerate() {
            for (j, found) in lanes.iter().enumerate() {
                assert_eq!(*found, if i == j { v } else { Vector3::zeros() });
            }
        }
    }
}

#[test]
fn hyperbolic_tangents_are_those_of_the_standard_library() {
    let mut all: Vec<f64> = (0..=2000).map(|i| 0.0113 * f64::from(i)).collect();
    all.extend([
        5e-324,
        1e-310,
        1e-200,
        1e-20,
        1e-8,
        19.9,
        20.1,
        1e3,
        1e300,
        f64::INFINITY,
    ]);
    all.extend(all.clone().iter().map(|x| -x));
    for arch in architectures() {
        for (x, found) in all.iter().zip(arch.dispatch(Tangents(&all))) {
            let expected = x.tanh();
            // Seven roundings; denormal numbers lose one bit in halving.
            let error = (found - expected).abs();
            assert!(error <= 1e-15 * expected.abs() + 1e-322, "{x:e}: {error:e}");
            assert_eq!(found > 0.0, expected > 0.0 && found != 0.0, "{x:e}");
        }
    }
}

#[test]
fn the_tangent_of_nan_is_nan() {
    let x = [0.5, f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for arch in architectures() {
        let found = arch.dispatch(Tangents(&x));
        assert!(found[1].is_nan() && found[2].is_nan(), "{found:?}");
        for i in [0, 3, 4] {
            assert!((found[i] - x[i].tanh()).abs() < 1e-15, "{found:?}");
        }
    }
}

#[test]
fn numbers_are_clamped_as_by_the_standard_library() {
    let mut x = vec![0.0, -0.0, 5e-324, 0.3, 0.7, 0.7 + 1e-16, 2.0, f64::MAX];
    x.push(f64::INFINITY);
    x.extend(x.clone().iter().map(|x| -x));
    x.extend([f64::NAN, -f64::NAN, 0.5]);
    for arch in architectures() {
        for bound in [0.7, 5e-324, f64::MAX] {
            for (x, found) in x.iter().zip(arch.dispatch(Clamped(&x, bound))) {
                let expected = x.clamp(-bound, bound);
                let both_none = found.is_nan() && expected.is_nan();
                let same = found.to_bits() == expected.to_bits();
                assert!(same || both_none, "{x} to {bound}: {found}");
            }
        }
    }
}
