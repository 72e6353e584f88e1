"""Films that are given, beside the literature."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import stribeck


def pocket(x: float, y: float) -> float:
    """The pocket of finite width of Bertocchi et al. (2013) in a slight wedge [m]."""
    inside = 4e-3 < x < 10e-3 and abs(y) < 3.5e-3
    return 1.1e-6 - 0.1e-6 * x / 20e-3 + (0.4e-6 if inside else 0.0)


def test_compressible_oil_has_the_published_peak_of_a_pocket() -> None:
    grid = stribeck.Grid.box(100, 50, (0.0, "20 mm"), ("-5 mm", "5 mm"))
    keys = {"speeds": (1.0, 0.0), "eta0": 0.01, "alpha": 1.2e-8}
    stiff = stribeck.given_film(pocket, grid, **keys).require_converged()
    soft = stribeck.given_film(pocket, grid, **keys, density_a="0.6 1/GPa", density_b=1.7e-9).require_converged()
    # 8.50 MPa, read from a figure
    assert soft.pressure.max() == pytest.approx(8.50e6, rel=0.04)
    assert soft.power_loss == pytest.approx(-soft.force.lower, rel=1e-12)
    assert stiff.pressure.max() / soft.pressure.max() == pytest.approx(1.048, abs=0.01)
    for name in ("density_a", "density_b"):
        with pytest.raises(stribeck.InputError, match=name):
            stribeck.given_film(pocket, grid, **keys, **{name: -1e-9})


def test_rigid_bearing_of_a_scene_is_in_equilibrium_with_its_load() -> None:
    scenes = Path(__file__).resolve().parents[2] / "examples" / "scenes"
    journal = stribeck.rigid_bearing(scenes / "journal.toml")
    assert journal.status == "converged"
    assert journal.load == pytest.approx(2000.0, rel=1e-5)
    assert journal.force is not None
    assert np.hypot(*journal.force) == pytest.approx(journal.load, rel=1e-12)
    assert journal.power_loss == pytest.approx(journal.friction_moving * np.pi * 50.0 * 0.05, rel=1e-9)
    with pytest.raises(stribeck.SceneError, match="given_film"):
        stribeck.rigid_bearing(scenes / "smooth.toml")
    oil = stribeck.Scene(scenes / "traction.toml").oil()
    assert oil is not None
    # alpha to the power 0.5 in a hard contact, to 2/3 in a light one
    assert 0.45 < oil.film_uncertainty / oil.alpha_uncertainty < 0.72


def test_film_around_a_ring_does_not_depend_on_where_it_begins() -> None:
    grid = stribeck.Grid.box(40, 12, (0.0, "8 mm"), (0.0, "4 mm"))

    def load(start: float) -> float:
        def film(x: float, y: float) -> float:
            return 5e-6 + 2e-6 * np.cos(2.0 * np.pi * (x - start) / 8e-3)

        keys = {"speeds": (1.0, 0.0), "eta0": 0.01, "cavitation_pressure": "-1 bar"}
        return stribeck.given_film(film, grid, **keys, periodic=True).require_converged().load

    assert load(0.8e-3 * 3) == pytest.approx(load(0.0), rel=1e-7)
    with pytest.raises(stribeck.InputError, match="runs dry"):
        stribeck.given_film(lambda x, y: 1e-5, grid, speeds=(1.0, 0.0), eta0=0.01, closed_sides=True, periodic=True)


def test_unequal_edge_pressures_drive_the_flow_of_a_slot() -> None:
    grid = stribeck.Grid.box(24, 18, (0.0, "20 mm"), (0.0, "10 mm"))
    keys = {"speeds": (0.0, 0.0), "eta0": 0.01, "closed_sides": True}
    slot = stribeck.given_film(lambda x, y: 2e-5, grid, **keys, edge_pressures=("3 bar", "1 bar", 0.0, 0.0)).require_converged()
    # h^3 b (p_1 - p_2)/(12 eta L)
    exact = 2e-5**3 * 0.01 * 2e5 / (12 * 0.01 * 0.02)
    assert slot.edge_flows[1] == pytest.approx(exact, rel=1e-8)
    assert slot.edge_flows[0] == pytest.approx(-exact, rel=1e-8)
    assert slot.cavitated_shear == 0.0
    with pytest.raises(stribeck.InputError, match=r"edge_pressures"):
        stribeck.given_film(lambda x, y: 2e-5, grid, **keys, edge_pressures=(0.0, -1.0, 0.0, 0.0))
