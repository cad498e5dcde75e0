use nalgebra::DMatrix;
use std::collections::VecDeque;

/// Relative size of a remainder that is due to rounding errors of differenced loads.
const NOISE: f64 = 1e-6;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    /// Symmetric operator (Lanczos): each new vector is orthogonalised against the last two.
    /// Rounding creates copies of converged eigenvalues, without changing them.
    Symmetric,
    Any,
}

/// Largest eigenvalue of the symmetric part of an operator on `n` coordinates, within the Krylov
/// space of dimension `vectors` of a fixed pseudorandom vector.
///
/// `apply` writes `A v` to its second argument. Returns 0 for `n = 0` and NaN if the operator
/// overflows.
///
/// # Errors
/// If `apply` fails.
///
/// # Source
/// C. C. Paige, J. Inst. Maths Applics 18 (1976) 341, for the error without orthogonalisation.
pub(crate) fn largest_eigenvalue<E>(
    n: usize,
    vectors: usize,
    operator: Operator,
    mut apply: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
) -> Result<f64, E> {
    let size = vectors.min(n);
    if size == 0 {
        return Ok(0.0);
    }
    let kept = match operator {
        Operator::Symmetric => 2,
        Operator::Any => size,
    };
    let mut projected = DMatrix::zeros(size, size);
    let mut basis = VecDeque::from([start_vector(n)]);
    let mut scale: f64 = 0.0;
    for j in 0..size {
        let mut next = vec![0.0; n];
        apply(&basis[basis.len() - 1], &mut next)?;
        if !norm(&next).is_finite() {
            // The symmetric part has no eigenvalues either.
            return Ok(f64::NAN);
        }
        scale = scale.max(norm(&next));
        let first = j + 1 - basis.len();
        orthogonalise(&basis, &mut next, |k, overlap| {
            projected[(first + k, j)] += overlap;
        });
        let remainder = norm(&next);
        if j + 1 == size || remainder <= NOISE * scale {
            // The space is invariant.
            projected = projected.resize(j + 1, j + 1, 0.0);
            break;
        }
        projected[(j + 1, j)] = remainder;
        divide(&mut next, remainder);
        if basis.len() == kept {
            basis.pop_front();
        }
        basis.push_back(next);
    }
    let symmetric = 0.5 * (&projected + projected.transpose());
    Ok(symmetric.symmetric_eigenvalues().max())
}

/// Orthogonalises `v` against `basis`, twice to reduce rounding errors, and reports the overlaps.
fn orthogonalise(basis: &VecDeque<Vec<f64>>, v: &mut [f64], mut report: impl FnMut(usize, f64)) {
    for _ in 0..2 {
        for (k, b) in basis.iter().enumerate() {
            let overlap: f64 = b.iter().zip(v.iter()).map(|(b, v)| b * v).sum();
            report(k, overlap);
            v.iter_mut().zip(b).for_each(|(v, b)| *v -= overlap * b);
        }
    }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn divide(v: &mut [f64], divisor: f64) {
    for c in v {
        *c /= divisor;
    }
}

/// Fixed pseudorandom unit vector, nearly uniform on the sphere.
///
/// Components are sums of four uniform numbers of the splitmix64 sequence (Steele, Lea and Flood
/// 2014).
fn start_vector(n: usize) -> Vec<f64> {
    let mut state = 0_u64;
    let mut uniform = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut v: Vec<f64> = (0..n)
        .map(|_| uniform() + uniform() + uniform() + uniform())
        .collect();
    let length = norm(&v);
    divide(&mut v, length);
    v
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    const BOTH: [Operator; 2] = [Operator::Symmetric, Operator::Any];

    fn largest(
        n: usize,
        vectors: usize,
        operator: Operator,
        a: impl Fn(usize, usize) -> f64,
    ) -> f64 {
        largest_eigenvalue(n, vectors, operator, |v, w| {
            for (i, w) in w.iter_mut().enumerate() {
                *w = v.iter().enumerate().map(|(j, v)| a(i, j) * v).sum();
            }
            Ok::<(), Infallible>(())
        })
        .unwrap_or_else(|never| match never {})
    }

    #[test]
    fn full_space_is_exact() {
        let diagonal = |i, j| if i == j { (i + 1) as f64 } else { 0.0 };
        for operator in BOTH {
            assert!((largest(12, 60, operator, diagonal) - 12.0).abs() < 1e-12);
        }
    }

    #[test]
    fn repeated_eigenvalues_close_the_space() {
        let diagonal = |i, j| match (i == j, i < 6) {
            (false, _) => 0.0,
            (true, true) => 1.0,
            (true, false) => 5.0,
        };
        for operator in BOTH {
            assert!((largest(12, 60, operator, diagonal) - 5.0).abs() < 1e-12);
        }
    }

    /// Lanczos and Arnoldi agree, also long after an isolated eigenvalue has converged. For a dense
    /// spectrum both have the same error.
    #[test]
    fn lanczos_and_arnoldi_agree() {
        let spread = |top: f64| {
            move |i: usize, j: usize| match (i == j, i) {
                (false, _) => 0.0,
                (true, 0) => top,
                (true, i) => (i as f64 / 400.0).sqrt(),
            }
        };
        let both = |top: f64| BOTH.map(|operator| largest(400, 60, operator, spread(top)));
        for top in [1.1, 30.0] {
            let [few, all] = both(top);
            // Rounding errors of sums of 400 terms.
            assert!((few / all - 1.0).abs() < 1e-12, "{top}: {few} and {all}");
        }
        let ([few, all], end) = (both(0.0), (399.0_f64 / 400.0).sqrt());
        // The smallest eigenvalues converge. The subsequent loss of orthogonality is small compared
        // with the truncation error.
        assert!((few - all).abs() < 1e-3 * (end - all), "{few} and {all}");
    }

    /// [[3, 4], [0, 3]] has the symmetric part [[3, 2], [2, 3]] with eigenvalues 1 and 5.
    #[test]
    fn unsymmetric_operators_use_the_symmetric_part() {
        let a = [[3.0, 4.0], [0.0, 3.0]];
        assert!((largest(2, 60, Operator::Any, |i, j| a[i][j]) - 5.0).abs() < 1e-12);
    }

    #[test]
    fn an_operator_that_overflows_has_none() {
        for operator in BOTH {
            assert!(largest(5, 60, operator, |_, _| 1e308).is_nan());
            assert!(largest(5, 60, operator, |_, _| f64::NAN).is_nan());
        }
    }

    #[test]
    fn nothing_and_zero_have_eigenvalue_zero() {
        for operator in BOTH {
            assert!(largest(0, 60, operator, |_, _| 1.0) == 0.0);
            assert!(largest(5, 60, operator, |_, _| 0.0) == 0.0);
        }
    }
}
