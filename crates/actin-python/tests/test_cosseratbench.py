"""The cosseratbench adapter: four scenarios without contact, compared with references of the benchmark."""

import numpy as np
import pytest

pytest.importorskip("cosseratbench")

from cosseratbench import registry  # noqa: E402
from cosseratbench.experiment import run  # noqa: E402


def result(name, **options):
    experiment = registry.load_experiment(name)
    solver = registry.load_solver("actin")
    return run(experiment, solver, values={}, options={}, **options)


# Wrong units, boundary conditions, inertia or damping cause much larger errors.
@pytest.mark.parametrize(
    ("name", "metric", "bound"),
    [("cantilever", "tip_deflection_error", 0.01), ("catenary", "shape_error", 0.01), ("pendulum", "period_error", 0.01)],
)
def test_errors_are_small(name, metric, bound):
    found = result(name, n_elements=20)
    assert found.outcome == "completed", found.failure
    assert found.metrics[metric] < bound
    assert np.isfinite(found.wall_time)


def test_contact_is_not_claimed():
    assert result("capstan").outcome == "unsupported"
