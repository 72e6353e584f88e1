#!/usr/bin/env python3
"""The dry contact of a periodic cell in stribeck and in tamaas, from the same heights: area, mean gap, pressures, seconds.

    python3 tests/peers/flat_cell.py [--stribeck target/release/stribeck] [--cells 256]

Needs tamaas and NumPy, which install from the Python package index. Prints a Markdown table.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import numpy as np
import tamaas as tm

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SIZE = 100e-6  # m, of examples/scenes/flat.toml
CONTACT_MODULUS = 115e9  # Pa, half of E'
PRESSURES = (20e6, 100e6, 400e6, 1500e6)  # Pa


def ours(program, folder, cells, pressure):
    """Numbers and fields of stribeck, elastic."""
    text = (ROOT / "examples" / "scenes" / "flat.toml").read_text().split("[plastic]")[0]
    text = text.replace("= 256", f"= {cells}").replace('"100 MPa"', str(pressure))
    scene, fields = folder / "cell.toml", folder / "cell.npz"
    scene.write_text(f"{text}\n[solver]\ntolerance = 1e-8\n")
    command = [program, "solve", scene, "--json", "--fields", fields, "--force"]
    ended = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True)
    return json.loads(ended.stdout), np.load(fields)


def theirs(gap, pressure):
    """Traction, mean gap and seconds of tamaas."""
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [SIZE, SIZE], list(gap.shape))
    model.E, model.nu = CONTACT_MODULUS, 0.0
    solver = tm.PolonskyKeerRey(model, -gap, 1e-12)
    solver.max_iter = 5000
    start = time.perf_counter()
    solver.solve(pressure)
    seconds = time.perf_counter() - start
    deformed = gap + model.displacement
    return model.traction, float((deformed - deformed[model.traction > 0].mean()).mean()), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--stribeck", type=pathlib.Path, default=ROOT / "target" / "release" / "stribeck")
    parser.add_argument("--cells", type=int, default=256)
    arguments = parser.parse_args()
    tm.set_log_level(tm.LogLevel.error)
    print("| mean pressure / MPa | area, both | mean gap / nm, both | largest difference of pressures | seconds, both |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for pressure in PRESSURES:
            numbers, fields = ours(arguments.stribeck, pathlib.Path(folder), arguments.cells, pressure)
            traction, mean_gap, seconds = theirs(fields["gap"], pressure)
            area = np.count_nonzero(traction > 0) / traction.size
            difference = np.abs(fields["pressure"] - traction).max() / traction.max()
            gaps = f"{1e9 * numbers['mean_gap']:.5f}, {1e9 * mean_gap:.5f}"
            areas = f"{numbers['area_share']:.6f}, {area:.6f}"
            print(f"| {1e-6 * pressure:g} | {areas} | {gaps} | {difference:.1e} | {numbers['seconds']:.2f}, {seconds:.2f} |")


if __name__ == "__main__":
    main()
