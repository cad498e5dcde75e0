"""Least-squares fits of functions and linear models."""

import actin_filaments as af
import numpy as np
import pytest

X = np.linspace(0.0, 3.0, 20)


def decay(x, p):
    return p[0] * np.exp(-p[1] * x)


def test_a_decay_is_found_with_its_errors():
    noise = np.random.default_rng(1).normal(0.0, 0.01, 20)
    found = af.fit(decay, X, decay(X, (2.0, 1.5)) + noise, [1.0, 1.0], deviations=0.01)
    assert np.all(np.abs(found.parameters - (2.0, 1.5)) < 4 * found.errors)
    assert found.statuses == ["Determined", "Determined"] and found.degrees_of_freedom == 18
    assert 6.0 < found.chi_squared < 40.0
    assert found.covariance[0, 0] == pytest.approx(found.errors[0] ** 2)
    assert "p[1]" in found._repr_html_()


def test_a_given_jacobian_agrees_with_differences():
    def jacobian(x, p):
        return np.stack([np.exp(-p[1] * x), -x * decay(x, p)], axis=1)

    y = decay(X, (2.0, 1.5)) + 0.01 * np.cos(40 * X)
    own = af.fit(decay, X, y, [1.0, 1.0], jacobian=jacobian)
    differences = af.fit(decay, X, y, [1.0, 1.0])
    assert differences.parameters == pytest.approx(own.parameters, rel=1e-8)
    assert differences.errors == pytest.approx(own.errors, rel=1e-6)


def test_bounds_hold_and_starts_are_drawn():
    found = af.fit(decay, X, decay(X, (2.0, 1.5)), bounds=[(0.0, 1.0), (0.1, 5.0)])
    assert found.parameters[0] == 1.0 and found.statuses[0] == "AtUpperBound" and found.starts == 8


def test_exceptions_of_a_function_are_raised():
    with pytest.raises(ZeroDivisionError):
        af.fit(lambda x, p: 1 / 0, X, X, [1.0])
    with pytest.raises(ValueError, match="must return shape"):
        af.fit(lambda x, p: x[:3], X, X, [1.0])
    with pytest.raises(ValueError, match="points are needed"):
        af.fit(decay, X[:1], X[:1], [1.0, 1.0])
    with pytest.raises(ValueError, match="a start, or bounds"):
        af.fit(decay, X, X)


def test_columns():
    design = np.stack([np.ones(20), X], axis=1)
    found = af.fit_linear(design, 3.0 - 2.0 * X)
    assert found.parameters == pytest.approx((3.0, -2.0), abs=1e-12)
    with pytest.raises(ValueError, match="determine 1 of 2"):
        af.fit_linear(np.ones((20, 2)), X)
