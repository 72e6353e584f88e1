"""``python -m stribeck`` is the command."""

import json
import subprocess
import sys
from pathlib import Path

SCENES = Path(__file__).parents[2] / "examples" / "scenes"


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "stribeck", *arguments], capture_output=True, text=True, check=False)


def test_command_prints_json_and_ends_with_its_status() -> None:
    solved = command("solve", str(SCENES / "line.toml"), "--json")
    assert solved.returncode == 0, solved.stderr
    assert json.loads(solved.stdout)["status"] == "converged"
    refused = command("solve", "absent.toml")
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr.startswith("error: absent.toml")


def test_command_alone_and_with_version_ends_with_zero() -> None:
    for arguments in ([], ["--version"], ["solve", "--help"]):
        printed = command(*arguments)
        assert printed.returncode == 0
        assert "stribeck" in printed.stdout
