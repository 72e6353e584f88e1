"""The page of the documentation: what it shows runs, each block after the one before."""

from __future__ import annotations

import doctest
import pkgutil
import re
from importlib import import_module
from pathlib import Path

import pytest
from conftest import ROOT

import stribeck


def test_the_page_runs_as_it_is_pasted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    import matplotlib

    matplotlib.use("Agg")
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "python.md").read_text(), re.DOTALL)
    assert len(blocks) == 12
    monkeypatch.chdir(tmp_path)
    # The files that the page speaks of.
    scene = stribeck.Scene.azam_2019(32)
    Path("scene.toml").write_text(scene.to_toml())
    heights = stribeck.surface.generate(scene.grid, 20e-9, length=60e-6)
    stribeck.surface.Surface(heights, scene.grid.dx, scene.grid.dy).write("disc.x3p")
    # As of a module of its own, which the laws in it are named by.
    names: dict[str, object] = {"__name__": "page"}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)
    assert capsys.readouterr().out.count("load.force -3.0") == 1


def test_readme_goes_from_scene_to_stribeck_curve(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("pandas")
    (block,) = re.findall(r"```python\n(.*?)```", (ROOT / "python" / "README.md").read_text(), re.DOTALL)
    assert len(block.splitlines()) <= 10
    exec(compile(block, "python/README.md", "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 7 and "friction.coefficient" in lines[0]


def test_examples_of_docstrings_hold() -> None:
    names = [module.name for module in pkgutil.iter_modules(stribeck.__path__, "stribeck.") if module.name != "stribeck.__main__"]
    results = [doctest.testmod(module) for module in (stribeck, *map(import_module, names))]
    assert sum(result.failed for result in results) == 0 and sum(result.attempted for result in results) >= 10
