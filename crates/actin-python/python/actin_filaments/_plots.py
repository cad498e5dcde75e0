"""Plots of runs with Matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from actin_filaments._optional import required

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from actin_filaments.results import Run

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
"""Colours of Okabe and Ito, which the colour-blind can distinguish."""
STYLES = ("-", "--", ":", "-.")

FIELDS = {
    "curvature": ("curvature_rad_per_nm", "curvature (rad/nm)"),
    "twist": ("twist_rad_per_nm", "excess twist (rad/nm)"),
    "energy": ("energy_per_length_pn", "elastic energy per length (pN)"),
    "tension": ("tension_pn", "tension (pN)"),
    "shear": ("shear_pn", "shear force (pN)"),
    "moment": ("moment_pn_nm", "bending moment (pN nm)"),
    "torque": ("torque_pn_nm", "torque (pN nm)"),
}


def new_axes(name: str, **options: Any) -> Any:
    """Creates axes for the method `name`."""
    pyplot = required("matplotlib.pyplot", name)
    return pyplot.subplots(layout="constrained", **options)[1]


def lines(ax: Axes, x: Any, columns: dict[str, Any]) -> None:
    """Draws named columns with a legend; the style of lines changes when the colours repeat."""
    marker = "o" if len(x) == 1 else None
    for number, (name, values) in enumerate(columns.items()):
        style = STYLES[number // len(COLOURS) % len(STYLES)]
        ax.plot(x, values, style, color=COLOURS[number % len(COLOURS)], marker=marker, label=name)
    if columns:
        ax.legend(fontsize="small")


def of_run(run: Run, ax: Axes | None) -> Axes:
    """Draws energies, and observables in panels below, one for each unit."""
    panels: dict[str, dict[str, Any]] = {"energy (pN nm)": {**run.energies_pn_nm, "kinetic": run.kinetic_pn_nm}}
    if run.scene.task == "Equilibrium":
        del panels["energy (pN nm)"]["kinetic"]
    for name, values in run.observables.items():
        unit = next((text for end, text in UNITS.items() if name.endswith(end)), "")
        panels.setdefault(unit or "value", {})[name] = values
    if ax is not None:
        panels = dict(list(panels.items())[:1])
        all_axes = [ax]
    else:
        size = (7.0, 3.0 * len(panels))
        all_axes = list(np.ravel(new_axes("Run.plot", nrows=len(panels), sharex=True, figsize=size)))
    for each, (label, columns) in zip(all_axes, panels.items()):
        lines(each, run._arrays["at"], columns)
        each.set_ylabel(label)
    all_axes[-1].set_xlabel("path (stages)" if run.scene.task == "Equilibrium" else "time (ns)")
    return all_axes[0]


UNITS = {"_pn_nm": "couple or energy (pN nm)", "_rad_per_nm": "strain (rad/nm)", "_pn": "force (pN)", "_nm": "length (nm)"}
"""Labels by the end of a name."""


def of_profile(run: Run, field: str, record: int, ax: Axes | None) -> Axes:
    """Draws a field along each filament."""
    if field not in FIELDS:
        raise ValueError(f"field = {field!r} is not one of {', '.join(FIELDS)}")
    column, label = FIELDS[field]
    profile = run.profile(record)
    if ax is None:
        ax = new_axes("Run.plot_profile", figsize=(7.0, 3.5))
    for number in np.unique(profile["filament"])[:20]:
        own = profile["filament"] == number
        color = COLOURS[len(ax.get_lines()) % len(COLOURS)]
        ax.plot(profile["s_nm"][own], profile[column][own], color=color, label=f"filament {number:.0f}")
    if profile["filament"][-1] > 0:
        ax.legend(fontsize="small")
    ax.set(xlabel="arc length (nm)", ylabel=label)
    return ax
