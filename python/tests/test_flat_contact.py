"""Dry contact of two rough planes."""

from pathlib import Path

import pytest
import stribeck

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


def test_pressure_of_a_flat_contact_carries_the_load_of_its_scene() -> None:
    flat = stribeck.flat_contact(SCENES / "flat.toml")
    assert flat.status == "converged"
    assert flat.pressure.mean() == pytest.approx(100e6, rel=1e-9)
    assert flat.film.mean() == pytest.approx(flat.mean_gap, rel=1e-9)
    assert (flat.pressure > 0.0).mean() == pytest.approx(flat.area_share, rel=1e-12)
    with pytest.raises(stribeck.SceneError, match="flat"):
        stribeck.flat_contact(SCENES / "smooth.toml")
