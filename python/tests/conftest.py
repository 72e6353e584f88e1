"""What the tests share."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from pathlib import Path
from typing import Any

import pytest

import stribeck

# A shell without jobs starts what runs in the background with Ctrl-C ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "examples" / "scenes"


def run_example(name: str, *arguments: str) -> str:
    """What an example of the crate prints."""
    command = ["cargo", "run", "--quiet", "--release", "--example", name, "--", *arguments]
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True, env=os.environ).stdout


def run_json(name: str, *arguments: str) -> Any:
    """The JSON that an example of the crate prints."""
    return json.loads(run_example(name, *arguments, "--json"))


@pytest.fixture
def rough() -> stribeck.Scene:
    """The rough lubricated contact on few cells."""
    return stribeck.Scene.azam_2019(32)


@pytest.fixture
def smooth() -> stribeck.Scene:
    """The same between smooth bodies, fast and elastic."""
    scene = stribeck.Scene.azam_2019(32)
    return scene.replace(roughness=None, plastic=None, wear=None, motion={"entrainment_speed": 5.0})
