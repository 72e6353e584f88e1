"""Contacts over a cycle."""

import numpy as np
import pytest
import stribeck

ROLLER = {
    "form": {"kind": "cylinder", "radius": 10e-3},
    "elastic": {"equivalent_modulus": 230e9},
    "load": {"force": 1e5},
    "motion": {"entrainment_speed": 1.0, "slide_roll_ratio": 0.2},
    "lubricant": {"eta0": 0.02, "alpha": 18e-9, "roelands_z": 0.6, "inlet": "box_edge"},
    "grid": {"nx": 64, "x": [-0.4e-3, 0.4e-3]},
}


def test_contacts_of_a_constant_cycle_are_the_steady_one() -> None:
    table = {"time": [0.0, 1e-3, 2e-3], "load": [1e5, 1e5, 1e5], "steps": 10}
    solved = stribeck.cycle(stribeck.Scene(ROLLER).replace(cycle=table))
    steady = stribeck.solve(stribeck.Scene(ROLLER))
    assert len(solved) == 10 and solved.ended_early is None and not solved.quasi_static
    assert solved["film_central"] == pytest.approx(np.full(10, steady.film.central), rel=1e-5)
    assert np.isnan(solved["angle"]).all()
    assert solved.to_pandas()["pressure_max"].iloc[-1] == pytest.approx(steady.pressure.max, rel=1e-5)
    with pytest.raises(stribeck.UnknownNameError, match="film_central"):
        solved["film"]


def test_rows_that_do_not_fit_are_named() -> None:
    table = {"time": [0.0, 1e-3, 2e-3], "load": [1e5, -1.0, 1e5]}
    with pytest.raises(stribeck.InputError, match=r"cycle\.load\[1\] = -1"):
        stribeck.cycle(stribeck.Scene(ROLLER).replace(cycle=table))


def test_bodies_of_a_history_wear_from_cycle_to_cycle() -> None:
    table = {"time": [0.0, 1e-3, 2e-3], "load": [1e5, 1e5, 1e5], "steps": 8, "repeat": 200, "solved": 2}
    wear = {"exposure": "contact_clock", "pressure": "total"}
    solved = stribeck.cycle(stribeck.Scene(ROLLER).replace(cycle=table, wear=wear))
    assert solved.history["cycles"] == pytest.approx([100.0, 200.0])
    volumes = solved.history["wear_disc_volume"]
    assert volumes[0] > 0.0 and volumes[1] == pytest.approx(2.0 * volumes[0], rel=1e-4)
    assert solved["wear_disc_volume"][-1] == volumes[1]
