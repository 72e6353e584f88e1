#!/usr/bin/env python3
"""Runs the same contact work in stribeck and in slippy, tamaas, ContactMechanics and aspher, one thread each, in one run.

    python3 tests/peers/compare.py [--folder target/peers] [--slippy-python python3.9] [--write]

Makes one virtual environment per package (they do not agree on a version of NumPy), installs it from the Python package
index, says what does not install, and prints a Markdown table. slippy needs Python below 3.11. `--write` puts the table
into docs/peers.md, between the two marks. Needs nothing but the standard
library itself.
"""

import argparse
import datetime
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PACKAGES = {
    "slippy": "peer_slippy.py",
    "tamaas": "peer_tamaas.py",
    "ContactMechanics": "peer_contact_mechanics.py",
    "aspher": "peer_aspher.py",
}
MARKS = ("<!-- peers -->", "<!-- /peers -->")
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "PYFFTW_NUM_THREADS")}
TIME_LIMIT = 300  # s for all the work of one package
TASKS = [
    ("convolution", (128, 256, 512, 1024), "largest displacement / nm", 1e9),
    ("hertz", (128, 256), "largest pressure / GPa", 1e-9),
    ("capped", (128, 256), "contact area / um^2", 1e12),
    ("dry", (128, 256, 512, 1024), "contact area / um^2", 1e12),
    ("film", (64, 128), "central film / um", 1e6),
]

DRY = """[form]
kind = "sphere"
radius = 9.525e-3
[elastic]
equivalent_modulus = 229.67e9
[load]
force = 54.0741
[grid]
nx = {n}
ny = {n}
x = [-0.25e-3, 0.25e-3]
y = [-0.25e-3, 0.25e-3]
[solver]
tolerance = {tolerance}
"""
ROUGH = """[roughness.disc]
kind = "gaussian"
rq = 130e-9
length_x = 10e-6
length_y = 10e-6
seed = 2
"""
CAPPED = """[plastic]
hardness = 6e9
"""
# Roller of 19.05 mm on a flat, both 200 GPa and 0.3; box of four Hertz radii (a^3 = 3 F R / (2 E')); density as slippy's.
FILM_MODULUS = 200e9 / (1 - 0.3**2)
FILM_RADIUS = (1.5 * 800.0 * 0.01905 / FILM_MODULUS) ** (1 / 3)
FILM = """[form]
kind = "sphere"
radius = 0.01905
[elastic]
equivalent_modulus = {modulus}
[load]
force = 800.0
[motion]
entrainment_speed = 4.0
[lubricant]
eta0 = 0.096
roelands_z = 0.68
roelands_p0 = 1.9607843137e8
density_a = {density_a}
density_b = {density_b}
[grid]
nx = {n}
ny = {n}
x = [-{half}, {half}]
y = [-{half}, {half}]
"""


def run(command, **keywords):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **keywords)


def solve(command, path, scene):
    """The JSON that a program of ours prints for a scene."""
    path.write_text(scene)
    ended = run(command)
    if not ended.stdout:
        return {"failed": ended.stderr.strip()}
    return json.loads(ended.stdout)


def ours(folder):
    """Builds the programs, runs the work and leaves the gaps for the others."""
    examples = ["peers_contact", "peers_convolution"]
    built = run(["cargo", "build", "--release", "-p", "stribeck", "-p", "stribeck-cli", "--bin=stribeck", *(f"--example={name}" for name in examples)], cwd=ROOT)
    if built.returncode:
        sys.exit(built.stderr)
    programs = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release"
    results = {}
    sizes = {task: sizes for task, sizes, _, _ in TASKS}
    for n in sizes["convolution"]:
        out = json.loads(run([programs / "examples" / "peers_convolution", n, 30 if n < 512 else 7]).stdout)
        results["convolution", n] = {"seconds": out["seconds"], "value": out["value"]}
    scenes = [
        ("hertz", "smooth", DRY, 1e-9),
        ("capped", "rough", DRY + ROUGH + CAPPED, 1e-9),
        ("dry", "elastic", DRY + ROUGH, 1e-8),
    ]
    for task, name, scene, tolerance in scenes:
        for n in sizes[task]:
            path, fields = folder / f"{name}_{n}.toml", folder / f"{name}_{n}.npz"
            out = solve([programs / "examples" / "peers_contact", path, fields], path, scene.format(n=n, tolerance=tolerance))
            if "failed" in out:
                results[task, n] = out
                continue
            value = out["largest_pressure"] if task == "hertz" else out["area"]
            results[task, n] = {"seconds": out["seconds"], "value": value, "note": f"{out['status']}, {out['steps']} steps"}
    for n in sizes["film"]:
        scene = FILM.format(n=n, modulus=FILM_MODULUS, half=2 * FILM_RADIUS, density_a=0.34 / 5.9e8, density_b=1 / 5.9e8)
        path = folder / f"film_{n}.toml"
        out = solve([programs / "stribeck", "solve", path, "--json"], path, scene)
        if "failed" in out:
            results["film", n] = out
            continue
        note = f"{out['status']} by {out['solver']}"
        results["film", n] = {"seconds": out["seconds"], "value": out["film"]["central"], "note": note}
    version = run(["cargo", "pkgid"], cwd=ROOT).stdout.strip().rsplit("#", 1)[-1].rsplit("@", 1)[-1]
    return version, results


def peer(package, script, folder, python):
    """Installs one package and runs its worker; `(version, results)`, or why there are none."""
    home = folder / package
    if not (home / "installed").exists():
        shutil.rmtree(home, ignore_errors=True)
        made = run([python, "-m", "venv", home])
        if made.returncode:
            return f"no environment: {made.stderr.strip().splitlines()[-1]}", {}
        installed = run([home / "bin" / "pip", "install", package])
        if installed.returncode:
            reasons = [line for line in installed.stderr.splitlines() if "Error" in line or "error" in line]
            return f"does not install: {reasons[0].strip() if reasons else installed.stderr[-200:]}", {}
        (home / "installed").touch()
    worker, late = [home / "bin" / "python", HERE / script, folder], ""
    # slippy leaves files where it runs.
    place = folder / f"{package}_output"
    place.mkdir(exist_ok=True)
    output = place / "stdout"
    with output.open("w") as out:
        try:
            ended = subprocess.run(
                [str(part) for part in worker],
                env={**os.environ, **ONE_THREAD},
                cwd=place,
                stdout=out,
                stderr=subprocess.PIPE,
                text=True,
                check=False,
                timeout=TIME_LIMIT,
            )
            if ended.returncode:
                late = f" (worker failed: {ended.stderr.strip().splitlines()[-1]})"
        except subprocess.TimeoutExpired:
            late = f" (stopped after {TIME_LIMIT} s, what is missing did not end)"
    version, results = "unknown", {}
    for line in output.read_text().splitlines():
        if line.startswith("RESULT "):
            row = json.loads(line.removeprefix("RESULT "))
            if row["task"] == "version":
                version = row["note"]
            else:
                results[row.pop("task"), row.pop("n")] = row
    return version + late, results


def cell(row, scale):
    if row is None:
        return "-"
    if "failed" in row:
        return f"failed: {row['failed']}"
    note = f" ({row['note']})" if row.get("note") else ""
    return f"{row['seconds'] * 1e3:.3g} ms: {row['value'] * scale:.5g}{note}"


def table(codes):
    """Markdown of all results."""
    lines = ["| work, value given | nodes | " + " | ".join(codes) + " |", "|---" * (len(codes) + 2) + "|"]
    for task, sizes, value, scale in TASKS:
        for n in sizes:
            cells = [cell(results.get((task, n)), scale) for _, results in codes.values()]
            lines.append(f"| {task}: {value} | {n} x {n} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def machine():
    """Processor and date: what a time means nothing without."""
    name = platform.processor() or platform.machine()
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        models = [line.split(":", 1)[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")]
        name = models[0] if models else name
    return f"{name}, one thread, {datetime.date.today().isoformat()}; load of the machine at the end {os.getloadavg()[0]:.1f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "target" / "peers")
    parser.add_argument("--slippy-python", default=sys.executable)
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    codes = {"stribeck": ours(folder)}
    for package, script in PACKAGES.items():
        python = arguments.slippy_python if package == "slippy" else sys.executable
        codes[package] = peer(package, script, folder, python)
    versions = "; ".join(f"{name} {version}" for name, (version, _) in codes.items())
    text = f"Versions: {versions}.\nMachine: {machine()}.\n\n{table(codes)}\n"
    print(text)
    if arguments.write:
        document = ROOT / "docs" / "peers.md"
        before, _, rest = document.read_text().partition(MARKS[0])
        _, _, after = rest.partition(MARKS[1])
        document.write_text(f"{before}{MARKS[0]}\n{text}{MARKS[1]}{after}")


if __name__ == "__main__":
    main()
