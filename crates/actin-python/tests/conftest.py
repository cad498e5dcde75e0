"""Shared scenes."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import actin_filaments as af
import pytest

KEYS: dict[str, Any] = {
    "filament": {
        "sections": [
            {"Ellipsoids": {"from_nm": 0.0, "to_nm": 40.0}},
            {"Rod": {"from_nm": 40.0, "to_nm": 160.0, "segments": 8}},
        ],
        "rod": {"law": "Fitted"},
    },
    "clamps": [{"end": "Start"}],
    "loads": [{"EndForce": {"end": "End", "force_pn": [-2.0, 0.0, 0.0]}}],
    "task": {"Equilibrium": {}},
}

TEXT = """Scene(
    filament: Filament(
        sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 40.0),
            Rod(from_nm: 40.0, to_nm: 160.0, segments: 8),
        ],
        rod: RodModel(law: Fitted),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(),
)
"""


@pytest.fixture
def root() -> Path:
    return Path(__file__).parents[3]


@pytest.fixture
def keys() -> dict[str, Any]:
    return copy.deepcopy(KEYS)


@pytest.fixture
def text() -> str:
    return TEXT


@pytest.fixture
def scene() -> af.Scene:
    return af.Scene(**KEYS)


@pytest.fixture
def motion(scene: af.Scene) -> af.Scene:
    return scene.set("task", {"Dynamics": {"duration_ns": 1.0, "record_every_ns": 0.1}})


@pytest.fixture
def long_motion(scene: af.Scene) -> af.Scene:
    """A motion that takes minutes."""
    return scene.set("task", {"Dynamics": {"duration_ns": 1e5, "record_every_ns": 1.0}})
