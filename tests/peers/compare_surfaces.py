"""Parameters of one measured surface beside other programs.

    python3 tests/peers/compare_surfaces.py FILE [--write]

Makes a virtual environment in target/peers/surfaces, installs SurfaceTopography and surfalize from the Python package index,
lets them and the command stribeck surface read FILE, and prints a table; --write puts it into docs/surfaces.md. Nothing is
levelled or filtered first.
"""

import argparse
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
MARKS = ("<!-- peers -->", "<!-- /peers -->")
PACKAGES = {"SurfaceTopography": "SurfaceTopography==1.27.1", "surfalize": "surfalize==0.19.2"}
# key of the report, unit and what it is in SI
ROWS = [
    ("sa", "nm", 1e-9),
    ("sq", "nm", 1e-9),
    ("ssk", "", 1),
    ("sku", "", 1),
    ("sp", "nm", 1e-9),
    ("sv", "nm", 1e-9),
    ("sz", "nm", 1e-9),
    ("sdq", "", 1),
    ("sdr", "%", 0.01),
    ("sal", "um", 1e-6),
    ("str", "", 1),
    ("sk", "nm", 1e-9),
    ("spk", "nm", 1e-9),
    ("svk", "nm", 1e-9),
    ("smr1", "%", 0.01),
    ("smr2", "%", 0.01),
    ("vmp", "nm", 1e-9),
    ("vmc", "nm", 1e-9),
    ("vvc", "nm", 1e-9),
    ("vvv", "nm", 1e-9),
]


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, cwd=ROOT)
    if done.returncode:
        sys.exit(f"{command[0]}: {done.stderr.strip()[-500:]}")
    return done.stdout


def environment(folder):
    """The interpreter of an environment with both packages."""
    if not (folder / "installed").exists():
        run([sys.executable, "-m", "venv", folder])
        run([folder / "bin" / "pip", "install", *PACKAGES.values()])
        (folder / "installed").touch()
    return folder / "bin" / "python"


def cell(value, scale):
    return "-" if value is None else f"{value / scale:.6g}"


def difference(ours, theirs):
    if ours is None or theirs is None:
        return "-"
    return f"{theirs / ours - 1:+.1e}" if ours else "-"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "target" / "peers" / "surfaces")
    arguments = parser.parse_args()
    file, folder = arguments.file.resolve(), arguments.folder.resolve()
    folder.parent.mkdir(parents=True, exist_ok=True)
    report = ["cargo", "run", "--quiet", "--release", "-p", "stribeck-cli", "--", "surface"]
    ours = json.loads(run([*report, file, "--json"]))
    peers = json.loads(run([environment(folder), HERE / "peer_surfaces.py", file]))
    names = list(PACKAGES)
    head = ["parameter", "stribeck", *(title for name in names for title in (name, "difference"))]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for key, unit, scale in ROWS:
        cells = [key.capitalize() + (f" ({unit})" if unit else ""), cell(ours[key], scale)]
        for name in names:
            value = peers[name].get(key)
            cells += [cell(value, scale), difference(ours[key], value)]
        lines.append("| " + " | ".join(cells) + " |")
    undefined = f", {ours['undefined']} undefined" if ours["undefined"] else ""
    versions = ", ".join(f"{name} {peers[name]['version']}" for name in names)
    text = f"{file.name}, {ours['nx']} x {ours['ny']} points{undefined}; {versions}.\n\n" + "\n".join(lines) + "\n"
    print(text)
    if arguments.write:
        document = ROOT / "docs" / "surfaces.md"
        before, _, rest = document.read_text().partition(MARKS[0])
        _, _, after = rest.partition(MARKS[1])
        document.write_text(f"{before}{MARKS[0]}\n{text}{MARKS[1]}{after}")


if __name__ == "__main__":
    main()
