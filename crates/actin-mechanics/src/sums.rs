//! Sums of vectors with factors.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::Vectors;
use crate::wide::{self, Simd, WithSimd};

/// `sum += h terms`.
pub(crate) fn add_product(sum: &mut Vectors, terms: &Vectors, h: f64) {
    wide::dispatch(AddProduct { sum, terms, h });
}

/// `sum += h factors terms`, with a factor for each vector.
pub(crate) fn add_scaled(sum: &mut Vectors, terms: &Vectors, factors: &[f64], h: f64) {
    wide::dispatch(AddScaled {
        sum,
        terms,
        factors,
        h,
    });
}

/// Kernel of [`add_product`], vectorised by the compiler.
struct AddProduct<'a> {
    sum: &'a mut Vectors,
    terms: &'a Vectors,
    h: f64,
}

impl WithSimd for AddProduct<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (x, v) = (self.sum, self.terms);
        for (x, v) in [(&mut x.x, &v.x), (&mut x.y, &v.y), (&mut x.z, &v.z)] {
            for (x, v) in x.iter_mut().zip(v) {
                *x += self.h * v;
            }
        }
    }
}

struct AddScaled<'a> {
    sum: &'a mut Vectors,
    terms: &'a Vectors,
    factors: &'a [f64],
    h: f64,
}

impl WithSimd for AddScaled<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (x, f) = (self.sum, self.terms);
        for (x, f) in [(&mut x.x, &f.x), (&mut x.y, &f.y), (&mut x.z, &f.z)] {
            for ((x, f), m) in x.iter_mut().zip(f).zip(self.factors) {
                *x += self.h * m * f;
            }
        }
    }
}
