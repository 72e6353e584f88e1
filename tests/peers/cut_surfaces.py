"""Cuts small files out of whole instrument files and reads them with an independent program.

    python -m venv venv
    venv/bin/pip install SurfaceTopography==1.27.1 surfalize==0.19.2
    venv/bin/python tests/peers/cut_surfaces.py FOLDER

FOLDER holds the whole files; `tests/data/surfaces` receives the small ones and `expected.csv`, what SurfaceTopography
(compressed sur: surfalize) reads from them: points, sizes, statistics of the defined heights and the first points, in
metres.
"""

import csv
import pathlib
import shutil
import struct
import sys
import zipfile

import numpy as np
import surfalize
from SurfaceTopography import open_topography
from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

NX, NY = 24, 18
whole = pathlib.Path(sys.argv[1])
out = pathlib.Path(__file__).parent.parent / "data" / "surfaces"
out.mkdir(parents=True, exist_ok=True)


def cut_sur():
    """A window around undefined points, with the header and the comments of the whole file."""
    content = bytearray((whole / "sur-2.sur").read_bytes())
    nx, ny = struct.unpack_from("<ii", content, 108)
    comment, private = struct.unpack_from("<HH", content, 334)
    start = 512 + comment + private
    field = np.frombuffer(content, "<i4", nx * ny, start).reshape(ny, nx)
    marker = struct.unpack_from("<i", content, 100)[0] - 2
    j, i = np.argwhere(field == marker)[0]
    j, i = min(max(j - NY // 2, 0), ny - NY), min(max(i - NX // 2, 0), nx - NX)
    window = field[j : j + NY, i : i + NX]
    header = content[:512]
    struct.pack_into("<iiI", header, 108, NX, NY, NX * NY)
    struct.pack_into("<HH", header, 334, 0, 0)
    (out / "cut.sur").write_bytes(bytes(header) + window.tobytes())


def cut_al3d():
    """The first points of the depth image; an odd count of columns, so that rows are padded."""
    content = (whole / "al3d-1.al3d").read_bytes()
    columns, start = 200, 1261
    image = np.frombuffer(content, "<f4", columns * 296, start).reshape(296, columns)
    head = bytearray(content[:start])
    for name, value in [("Cols", 23), ("Rows", NY), ("TextureImageOffset", 0)]:
        at = head.index(b"\r\n" + name.encode() + b"\0") + 2 + 20
        head[at : at + 30] = str(value).encode().ljust(30, b"\0")
    window = np.zeros((NY, 24), "<f4")
    window[:, :23] = image[:NY, :23]
    window[3, 5] = np.float32(3e15)
    (out / "cut.al3d").write_bytes(bytes(head) + window.tobytes())


def cut_plu():
    content = (whole / "plu-1.plu").read_bytes()
    image = np.frombuffer(content, "<f4", 768 * 576, 508).reshape(576, 768)
    head = bytearray(content[:508])
    for at in (388, 500):
        struct.pack_into("<II", head, at, NY, NX)
    head[500 - 12 + 4] = 0  # no images
    window = image[:NY, :NX].copy()
    window[2, 4] = 1000001
    (out / "cut.plu").write_bytes(bytes(head) + window.tobytes() + struct.pack("<ff", window.min(), -100.0))


def cut_x3p():
    with zipfile.ZipFile(whole / "x3p-2.x3p") as archive:
        xml = archive.read("main.xml").decode()
        field = np.frombuffer(archive.read("bindata/data.bin"), "<f8").reshape(650, 650)
    xml = xml.replace("<SizeX>650", f"<SizeX>{NX}").replace("<SizeY>650", f"<SizeY>{NY}")
    valid = np.ones(NX * NY, bool)
    valid[[5, 100]] = False
    link = "<ValidPointsLink>bindata/valid.bin</ValidPointsLink></DataLink>"
    xml = xml.replace("</DataLink>", link)
    with zipfile.ZipFile(out / "cut.x3p", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", xml)
        archive.writestr("bindata/data.bin", field[:NY, :NX].tobytes())
        archive.writestr("bindata/valid.bin", np.packbits(valid, bitorder="little").tobytes())


def cut_text():
    lines = (whole / "matrix-3.txt").read_text().splitlines()
    head, rows = lines[:4], lines[4 : 4 + NY]
    (out / "cut.txt").write_text("\n".join(head + ["\t".join(row.split()[:NX]) for row in rows]) + "\n")


def write_others():
    """The binary and compressed forms, written by surfalize from the same window."""
    surface = surfalize.Surface.load(out / "cut.sur")
    surface.save(out / "binary.sdf")
    surface.save(out / "compressed.sur", compressed=True)


def moments(heights, unit):
    z = heights - heights.mean()
    sq = np.sqrt(np.mean(z**2))
    return [
        np.abs(z).mean() * unit,
        sq * unit,
        np.mean(z**3) / sq**3,
        np.mean(z**4) / sq**4,
        heights.min() * unit,
        heights.max() * unit,
    ]


def row_of(name):
    if name == "compressed.sur":
        surface = surfalize.Surface.load(out / name)
        heights, unit = np.ma.masked_invalid(surface.data.T), 1e-6
        size = [surface.step_x * heights.shape[0] * unit, surface.step_y * heights.shape[1] * unit]
    else:
        topography = open_topography(out / name).topography()
        unit = get_unit_conversion_factor(topography.unit, "m")
        heights = np.ma.masked_invalid(np.ma.asarray(topography.heights(), dtype=float))
        if name == "binary.sdf":
            # SurfaceTopography does not know the marker of undefined floating point numbers
            heights = np.ma.masked_less(heights, -1e300)
        size = [s * unit for s in topography.physical_sizes]
    nx, ny = heights.shape
    corner = [float(heights[i, j]) * unit for i, j in [(0, 0), (1, 0), (0, 1)]]
    undefined = int(np.ma.getmaskarray(heights).sum())
    return [name, nx, ny, *size, undefined, *moments(heights.compressed(), unit), *corner]


for cut in (cut_sur, cut_al3d, cut_plu, cut_x3p, cut_text, write_others):
    cut()
shutil.copyfile(whole / "sdf-1.sdf", out / "ascii.sdf")
names = ["cut.sur", "compressed.sur", "ascii.sdf", "binary.sdf", "cut.al3d", "cut.plu", "cut.x3p", "cut.txt"]
with open(out / "expected.csv", "w", newline="") as file:
    table = csv.writer(file, lineterminator="\n")
    keys = "sa sq ssk sku min max h00 h10 h01".split()
    table.writerow(["file", "nx", "ny", "size_x", "size_y", "undefined", *keys])
    for name in names:
        table.writerow([f"{v:.12g}" if isinstance(v, float) else v for v in row_of(name)])
