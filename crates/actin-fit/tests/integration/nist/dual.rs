use std::ops::{Add, Div, Mul, Neg, Sub};

/// Maximum number of parameters.
const MOST: usize = 9;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual {
    pub(crate) value: f64,
    pub(crate) slopes: [f64; MOST],
}

pub(crate) fn variables(p: &[f64]) -> Vec<Dual> {
    let variable = |(j, &value): (usize, &f64)| {
        let mut slopes = [0.0; MOST];
        slopes[j] = 1.0;
        Dual { value, slopes }
    };
    p.iter().enumerate().map(variable).collect()
}

impl Dual {
    fn chain(self, value: f64, slope: f64) -> Self {
        Self {
            value,
            slopes: self.slopes.map(|s| slope * s),
        }
    }

    pub(crate) fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }

    fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.recip())
    }

    pub(crate) fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }

    pub(crate) fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    pub(crate) fn atan(self) -> Self {
        self.chain(self.value.atan(), (1.0 + self.value * self.value).recip())
    }

    pub(crate) fn squared(self) -> Self {
        self * self
    }

    pub(crate) fn power(self, exponent: Self) -> Self {
        let power = self.value.powf(exponent.value);
        (self.ln() * exponent).chain(power, power)
    }
}

impl From<f64> for Dual {
    fn from(value: f64) -> Self {
        let slopes = [0.0; MOST];
        Self { value, slopes }
    }
}

impl Neg for Dual {
    type Output = Self;

    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

/// Arithmetic between dual numbers and `f64`.
macro_rules! operation {
    ($trait:ident, $name:ident, |$a:ident, $b:ident| $value:expr, |$s:ident, $t:ident| $slope:expr) => {
        impl $trait for Dual {
            type Output = Dual;

            fn $name(self, other: Dual) -> Dual {
                let ($a, $b) = (self.value, other.value);
                let mut slopes = self.slopes;
                for (slope, $t) in slopes.iter_mut().zip(other.slopes) {
                    let $s = *slope;
                    *slope = $slope;
                }
                Dual {
                    value: $value,
                    slopes,
                }
            }
        }

        impl $trait<f64> for Dual {
            type Output = Dual;

            fn $name(self, other: f64) -> Dual {
                $trait::$name(self, Dual::from(other))
            }
        }

        impl $trait<Dual> for f64 {
            type Output = Dual;

            fn $name(self, other: Dual) -> Dual {
                $trait::$name(Dual::from(self), other)
            }
        }
    };
}

operation!(Add, add, |a, b| a + b, |s, t| s + t);
operation!(Sub, sub, |a, b| a - b, |s, t| s - t);
operation!(Mul, mul, |a, b| a * b, |s, t| s * b + t * a);
operation!(Div, div, |a, b| a / b, |s, t| (s - t * a / b) / b);
