"""What SurfaceTopography and surfalize say of a file: run by compare_surfaces.py, one JSON object on standard output, SI."""

import json
import math
import sys
import warnings
from importlib.metadata import version

import surfalize
from SurfaceTopography import open_topography
from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

warnings.simplefilter("ignore")
# surfalize gives micrometres and per cent
LENGTHS = "Sa Sq Sp Sv Sz Sal Sk Spk Svk Vmp Vmc Vvc Vvv".split()
SHARES = "Sdr Smr1 Smr2".split()
NUMBERS = "Ssk Sku Sdq Str".split()


def of_surfalize(path):
    surface = surfalize.Surface.load(path)
    result = {"version": version("surfalize")}
    for names, scale in ((LENGTHS, 1e-6), (SHARES, 0.01), (NUMBERS, 1)):
        for name in names:
            value = float(getattr(surface, name)()) * scale
            result[name.lower()] = value if math.isfinite(value) else None
    return result


def of_surface_topography(path):
    topography = open_topography(path).topography()
    unit = get_unit_conversion_factor(topography.unit, "m")
    return {
        "version": version("SurfaceTopography"),
        "sq": float(topography.rms_height_from_area()) * unit,
        "sdq": float(topography.rms_gradient()),
    }


path = sys.argv[1]
print(json.dumps({"surfalize": of_surfalize(path), "SurfaceTopography": of_surface_topography(path)}))
