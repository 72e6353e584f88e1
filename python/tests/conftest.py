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


# Programs that `cargo build --release --examples`, and with `-p stribeck-cli` and `-p studies --bins`, has built.
PROGRAMS = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release"


def run_program(program: Path, *arguments: str) -> str:
    """Standard output of a program."""
    if not program.with_suffix(".exe" if os.name == "nt" else "").exists():
        build = "--examples" if program.parent.name == "examples" else "-p stribeck-cli -p studies --bins"
        pytest.fail(f"{program} is missing: `cargo build --release {build}` builds it")
    return subprocess.run([program, *arguments], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def run_example(name: str, *arguments: str) -> str:
    """Standard output of an example of the crate."""
    return run_program(PROGRAMS / "examples" / name, *arguments)


def run_study(name: str, *arguments: str) -> str:
    """Standard output of a study."""
    return run_program(PROGRAMS / name, *arguments)


def run_command(*arguments: str) -> Any:
    """The JSON that a subcommand prints."""
    return json.loads(run_program(PROGRAMS / "stribeck", *arguments, "--json"))


@pytest.fixture
def rough() -> stribeck.Scene:
    """The rough lubricated contact on few cells."""
    return stribeck.Scene.azam_2019(32)


@pytest.fixture
def smooth() -> stribeck.Scene:
    """The same between smooth bodies, fast and elastic."""
    scene = stribeck.Scene.azam_2019(32)
    return scene.replace(roughness=None, plastic=None, wear=None, motion={"entrainment_speed": 5.0})
