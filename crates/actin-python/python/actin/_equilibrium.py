"""`equilibrium`: a scene to its state at rest."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from actin._actin import Progress, Scene, run
from actin.results import Equilibrium


def equilibrium(
    scene: Scene,
    *,
    progress: Callable[[Progress], object] | bool | None = None,
    **settings: Any,
) -> Equilibrium:
    """The equilibrium of a scene, along its path if it has one, with what its stiffness says of it.

    `settings` are keys of the task `Equilibrium` (`force_pn`, `lowest_eigenvalue`, `states`, ...), which replace those
    of the scene. A scene that asks for a motion is solved for its equilibrium instead.

    Raises `SceneError`, and `RunFailed` where no equilibrium is found or only a saddle.
    """
    if scene.task != "Equilibrium":
        scene = scene.set("task", {"Equilibrium": {}})
    for key, value in settings.items():
        scene = scene.set(f"task.{key}", value)
    return Equilibrium(run(scene, progress=progress))
