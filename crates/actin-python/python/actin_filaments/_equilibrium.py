"""Equilibria of scenes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from actin_filaments._actin import Progress, Scene, run
from actin_filaments.results import Equilibrium


def equilibrium(
    scene: Scene,
    *,
    progress: Callable[[Progress], object] | bool | None = None,
    **settings: Any,
) -> Equilibrium:
    """Finds the equilibrium of a scene, along its path if it has one, and certifies its stability.

    `settings` are keys of the task `Equilibrium` (`force_pn`, `lowest_eigenvalue`, `states`, ...), which override those
    of the scene. The task of a motion is replaced by an equilibrium.

    Raises `SceneError`, and `RunFailed` if no stable equilibrium is found.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene must be a Scene, not {type(scene).__name__}: Scene.from_file reads a file")
    if scene.task != "Equilibrium":
        scene = scene.set("task", {"Equilibrium": {}})
    for key, value in settings.items():
        scene = scene.set(f"task.{key}", value)
    return Equilibrium(run(scene, progress=progress))
