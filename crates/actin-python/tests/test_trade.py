"""Trades: table, best scene, picture, errors, interrupts."""

import csv
import os
import signal
import sys
import threading
import time

import actin_filaments as af
import numpy as np
import pytest


@pytest.fixture(scope="module")
def cantilever():
    return af.Scene(
        filament={"sections": [{"Rod": {"from_nm": 0.0, "to_nm": 81.0}}], "rod": {"law": "Fitted"}},
        clamps=[{"end": "Start"}],
        loads=[{"EndForce": {"end": "End", "force_pn": (-2.0, 0.0, 0.0)}}],
        task={"Equilibrium": {}},
    )


@pytest.fixture(scope="module")
def trade(cantilever):
    return af.trade(cantilever, quantities=["tip", "energy"], error=0.05)


def test_the_table_has_one_row_for_each_candidate(trade):
    table = trade.table
    assert len(trade) >= 8 and all(column.shape == (len(trade),) for column in table.values())
    assert {"candidate", "wall_s", "tip error", "energy error", "error", "failure"} <= set(table)
    assert trade.units == {"tip": "nm", "energy": "pN nm"}
    ran = table["failure"] == ""
    largest = np.maximum(table["tip error"], table["energy error"])
    assert np.array_equal(table["error"][ran], largest[ran])
    assert table["monomers"].dtype == int and 0 < table["monomers"].max() < trade.reference["monomers"]
    assert list(csv.DictReader(trade.to_csv().splitlines()))[0]["candidate"] == table["candidate"][0]
    assert table["candidate"][0] in str(trade) and "tip" in str(trade)


def test_an_error_is_that_of_the_candidate_run_alone(trade):
    exact = af.run(trade.reference["scene"]).summary["tip_displacement_nm"]
    ran = np.flatnonzero(trade.table["failure"] == "")
    coarse = ran[np.argmax(trade.table["tip error"][ran])]
    alone = af.run(trade.scenes[coarse]).summary["tip_displacement_nm"]
    error = np.linalg.norm(np.subtract(alone, exact)) / np.linalg.norm(exact)
    assert error > 1e-4
    # Both runs repeat the equilibria of the trade, which are solved to 1e-8 of the loads.
    assert trade.table["tip error"][coarse] == pytest.approx(error, rel=1e-3)


def test_the_best_scene_meets_the_error(trade):
    assert repr(trade).endswith(f"cheapest within 5 %: {trade.best_name})")
    best = np.flatnonzero(trade.table["is_best"])
    if best.size:
        assert trade.table["error_at_all_loads"][best[0]] <= trade.wanted_error
        assert trade.best == trade.scenes[best[0]] and trade.best_name == trade.table["candidate"][best[0]]
    else:
        assert trade.best == trade.reference["scene"] and trade.best_name == trade.reference["name"]
    assert af.run(trade.best).status == "converged"
    assert trade.best_name in trade._repr_html_()


def test_the_plot_labels_every_candidate(trade):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = trade.plot()
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels[-1] == "wanted: 5 %" and len(labels) == len(ax.texts) + 1 > 5
    assert trade.plot(ax) is ax


def test_the_plot_requires_matplotlib(trade, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match="pip install matplotlib"):
        trade.plot()


def test_mistakes_of_arguments_and_scenes_are_named(cantilever):
    with pytest.raises(af.SceneError, match="no tipp to compare") as caught:
        af.trade(cantilever, quantities=["tipp"])
    assert (caught.value.key, caught.value.line) == ("quantity", None)
    with pytest.raises(af.SceneError, match="below 1"):
        af.trade(cantilever, error=2.0)
    with pytest.raises(af.SceneError, match="must be positive"):
        af.trade(cantilever, loads=[-0.5])
    with pytest.raises(ValueError):
        af.trade(cantilever, budget_s=-1.0)
    with pytest.raises(TypeError):
        af.trade(cantilever, quantities="tip")


def test_an_unsettled_reference_is_warned_about(cantilever):
    motion = cantilever.set("task", {"Dynamics": {"duration_ns": 0.2, "record_every_ns": 0.1}})
    with pytest.warns(af.RunWarning, match=r"third of the wanted error: .*tip.*\[unknown-error\]") as caught:
        found = af.trade(motion, error=1e-12, loads=[])
    assert caught[0].filename == __file__
    assert not found.reference["is_settled"] and found.reference["own_errors"]["tip"] > 0.0
    assert found.warnings[0]["code"] == "unknown-error" and found.best == found.reference["scene"]


def test_progress_names_each_run_and_may_end_the_trade(cantilever, capsys):
    af.trade(cantilever, progress=True)
    shown = capsys.readouterr().err
    assert "every monomer" in shown and shown.endswith("\r")
    names = []

    def stop(name):
        names.append(name)
        if len(names) == 6:
            raise KeyboardInterrupt

    with pytest.raises(af.Interrupted, match="trade was interrupted") as caught:
        af.trade(cantilever, progress=stop)
    assert names[0] == "every monomer" and len(names) == 6
    assert list(caught.value.trade.table["candidate"][:2]) == names[4:6] and caught.value.run is None

    def refuse(name):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        af.trade(cantilever, progress=refuse)


def test_ctrl_c_ends_a_trade(cantilever):
    long = cantilever.set("task", {"Dynamics": {"duration_ns": 1e5, "record_every_ns": 1.0}})
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    started = time.monotonic()
    with pytest.raises(af.Interrupted) as caught:
        af.trade(long)
    assert time.monotonic() - started < 5.0 and caught.value.trade is None
