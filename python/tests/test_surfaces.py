"""Surfaces: undefined points, files that leave something open, other packages, one path to generated surfaces."""

from __future__ import annotations

import pickle
import subprocess
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import stribeck
from stribeck import metrics
from stribeck.surface import Surface, dimples, generate, grooves, read

#: Rows 1 2 3 4, 5 6 7 8, 9 10 11 12 with 6 undefined [m]: Sa 39/12.1 um.
GAP = np.arange(1.0, 13.0).reshape(3, 4) * 1e-6
GAP[1, 1] = np.nan
SA = 39.0 / 12.1 * 1e-6


def gap() -> Surface:
    return Surface(GAP, "0.5 um")


def test_undefined_points_are_nan_from_file_to_report(tmp_path: Path) -> None:
    path = tmp_path / "gap.txt"
    path.write_text("# Width: 2 um\n# Height: 1.5 um\n# Value units: um\n1 2 3 4\n5 BAD 7 8\n9 10 11 12\n")
    surface = read(path)
    np.testing.assert_allclose(surface.heights, GAP, rtol=1e-14)
    assert surface.undefined == 1 and not surface.defined[1, 1] and surface.unit == "um" and surface.warnings == []
    for name in ("a.x3p", "a.txt", "a.npy"):
        surface.write(tmp_path / name)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", stribeck.StribeckWarning)
            np.testing.assert_array_equal(read(tmp_path / name).heights, surface.heights)
    assert np.isfinite(surface.fill_undefined().heights).all()


@pytest.mark.parametrize("kind", ["surface", "masked", "nan", "infinite"])
def test_metrics_leave_undefined_points_out_and_count_them(kind: str) -> None:
    heights = {
        "surface": gap(),
        "masked": np.ma.masked_invalid(GAP),
        "nan": GAP,
        "infinite": np.where(np.isnan(GAP), np.inf, GAP),
    }[kind]
    numbers = metrics.height_statistics(heights)
    assert numbers.undefined == 1 and numbers.sa == pytest.approx(SA)
    assert metrics.bearing(heights).undefined == 1
    spacing = {} if kind == "surface" else {"dx": 0.5e-6}
    hybrid = metrics.hybrid_parameters(heights, **spacing)
    # 1 um along x over .5 um, 4 um along y over .5 um
    assert hybrid.undefined == 1 and hybrid.sdq == pytest.approx(np.hypot(2.0, 8.0))
    assert metrics.spatial_parameters(heights, boundary="open", **spacing).undefined == 1


def test_spectra_of_surfaces_with_gaps_keep_their_variance() -> None:
    wave = 1e-7 * np.sin(2 * np.pi * np.arange(64) / 8) * np.ones((64, 1))
    holed = wave.copy()
    holed[20:24, 10:30] = np.nan
    whole, part = (metrics.radial_spectrum(heights, 1e-6)[1] for heights in (wave, holed))
    peak = int(whole.argmax())
    assert part[peak] == pytest.approx(whole[peak], rel=0.05)


def test_files_that_leave_something_open_say_so(tmp_path: Path) -> None:
    path = tmp_path / "plain.txt"
    path.write_text("1 2\n3 5\n")
    with pytest.warns(stribeck.StribeckWarning, match="unit of the heights is not known"):
        assert read(path).unit is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read(path, unit="nm").heights[1, 1] == pytest.approx(5e-9)
    path.write_text("# Channel: Z\n# unit: nm\n1 2\n3 5\n# Channel: Phase\n5 6\n7 9\n")
    with pytest.raises(stribeck.SurfaceError, match='1 "Z", 2 "Phase"') as caught:
        read(path)
    assert caught.value.field == "channel" and caught.value.value == str(path)
    assert read(path, channel=2).heights[0, 0] == pytest.approx(5e-9)
    with pytest.raises(stribeck.InputError):
        read(path, unit="volt")


def test_topographies_of_surface_topography_are_taken_and_given_back(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        topographies = pytest.importorskip("SurfaceTopography")
        # arrays are (nx, ny) there
        masked = np.ma.masked_invalid(GAP.T * 1e6)
        surface = Surface(topographies.Topography(masked, (2.0, 1.5), unit="µm"))
        np.testing.assert_allclose(surface.heights, GAP, rtol=1e-14)
        assert (surface.dx, surface.dy) == pytest.approx((0.5e-6, 0.5e-6)) and surface.undefined == 1
        back = surface.to_surface_topography()
        assert back.nb_grid_pts == (4, 3) and back.physical_sizes == pytest.approx((2e-6, 1.5e-6))
        np.testing.assert_array_equal(np.ma.getmaskarray(back.heights()), np.isnan(GAP.T))
        np.testing.assert_array_equal(Surface(back).heights, surface.heights)
        line = Surface(topographies.UniformLineScan(np.array([1.0, 2.0, 4.0]), 3.0, unit="um"))
        assert line.shape == (1, 3) and line.heights[0, 2] == pytest.approx(4e-6) and line.dx == pytest.approx(1e-6)
        # a format without a reader of its own
        foreign = tmp_path / "a.nc"
        topographies.Topography(np.nan_to_num(GAP.T * 1e6), (2.0, 1.5), unit="µm").to_netcdf(foreign)
        found = read(foreign)
    assert found.shape == (3, 4) and found.heights[2, 3] == pytest.approx(12e-6)


class Channel:
    """A channel as SurfaceTopography describes it."""

    def __init__(self, name: str, unit: Any, kind: str = "HEIGHT", sizes: tuple[float, float] | None = (2.0, 1.5)) -> None:
        self.name, self.unit, self.physical_sizes, self.nb_grid_pts = name, unit, sizes, (4, 3)
        self.data_kind = SimpleNamespace(name=kind)


class Reader:
    """A reader of SurfaceTopography whose file has these channels."""

    def __init__(self, *channels: Channel) -> None:
        self.channels = list(channels)

    def format(self) -> str:
        return "wsxm"

    def topography(self, channel_index: int, physical_sizes: tuple[float, float] | None = None) -> Any:
        channel = self.channels[channel_index]
        sizes = channel.physical_sizes if physical_sizes is None else physical_sizes
        module = pytest.importorskip("SurfaceTopography")
        return module.Topography(np.nan_to_num(GAP.T * 1e6), sizes, unit=channel.unit)


def test_formats_with_a_header_of_text_are_read_by_channel_and_unit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        module = pytest.importorskip("SurfaceTopography")
    path = tmp_path / "a.stp"
    path.write_bytes(b"WSxM file copyright UAM\r\n" + 5000 * b" " + bytes(16))

    def holds(*channels: Channel) -> None:
        monkeypatch.setattr(module, "open_topography", lambda place: Reader(*channels))

    holds(Channel("Topography", "um"))
    surface = read(path)
    assert surface.shape == (3, 4) and surface.dx == pytest.approx(0.5e-6) and surface.unit == "um" and surface.warnings == []
    with pytest.raises(stribeck.SurfaceError, match="one surface alone"):
        read(path, channel=2)
    holds(Channel("ZSensor", "nm"), Channel("Phase", ("nm", None)), Channel("AmplitudeError", "nm"), Channel("Bias", "nm", "VOLTAGE"))
    for number, name in ((2, "Phase"), (3, "AmplitudeError"), (4, "Bias")):
        with pytest.raises(stribeck.SurfaceError, match=f"channel {number} '{name}' holds no heights; heights are in channel 1 'ZSensor'"):
            read(path, channel=number)
    holds(Channel("no name", None))
    with pytest.warns(stribeck.StribeckWarning) as said:
        assert read(path).heights[0, 1] == pytest.approx(2.0)
    assert [text.split(" is not known")[0] for text in (str(warning.message).split(": ", 1)[1] for warning in said)] == [
        "the unit of the heights",
        "the unit of the lengths along x and y",
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("error", stribeck.StribeckWarning)
        named = read(path, unit="um")
        assert named.heights[0, 1] == pytest.approx(2e-6) and named.dx == pytest.approx(0.5e-6) and named.unit == "um"
        holds(Channel("z", "nm", sizes=None))
        sizeless = read(path)
        assert sizeless.dx is None and sizeless.with_spacing("1 um").dx == 1e-6
    holds()
    with pytest.raises(stribeck.SurfaceError, match=r"a\.stp: no surface"):
        read(path)


def test_units_of_other_packages_are_theirs_or_warned_of() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        module = pytest.importorskip("SurfaceTopography")
    plain = np.nan_to_num(GAP.T * 1e6)
    for unit, metres, name in (("pm", 1e-12, "pm"), ("A", 1e-10, "Angstrom"), ("\u00c5", 1e-10, "Angstrom"), ("km", 1e3, "km"), ("mm", 1e-3, "mm")):
        surface = Surface(module.Topography(plain, (2.0, 1.5), unit=unit))
        assert surface.dx == pytest.approx(0.5 * metres) and surface.unit == name and surface.warnings == []
    without = module.Topography(plain, (2.0, 1.5))
    with pytest.warns(stribeck.StribeckWarning, match="the unit of the heights is not known"):
        assert len(Surface(without).warnings) == 2
    with pytest.warns(stribeck.StribeckWarning, match="the unit of the heights is not known"):
        metrics.height_statistics(without)
    with warnings.catch_warnings():
        warnings.simplefilter("error", stribeck.StribeckWarning)
        named = Surface(without, unit="um")
        assert (named.dx, named.heights[0, 1], named.unit) == pytest.approx((0.5e-6, 2e-6, "um"))
        copy = pickle.loads(pickle.dumps(named))
        assert copy.unit == "um" and np.array_equal(copy.heights, named.heights)
    repeated = Surface(module.Topography(plain, (2.0, 1.5), unit="um", periodic=True))
    assert repeated.is_periodic and repeated.to_surface_topography().is_periodic
    assert not named.is_periodic and not named.to_surface_topography().is_periodic
    for unit in ("V", "volt"):
        with pytest.raises(stribeck.InputError, match="must be a unit of length"):
            Surface(without, unit=unit)
    with pytest.raises(stribeck.InputError, match="in metres"):
        Surface(GAP, "1 um", unit="um")


def test_arrays_in_files_of_others_have_rows_along_x(tmp_path: Path) -> None:
    pytest.importorskip("SurfaceTopography")
    scipy_io, h5py = pytest.importorskip("scipy.io"), pytest.importorskip("h5py")
    heights = np.arange(35.0).reshape(5, 7)
    np.savez(tmp_path / "a.npz", heights=heights)
    scipy_io.savemat(tmp_path / "a.mat", {"heights": heights})
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("heights", data=heights)
    for name in ("a.npz", "a.mat", "a.h5"):
        with pytest.warns(stribeck.StribeckWarning) as caught:
            surface = stribeck.surface.read(tmp_path / name)
        np.testing.assert_array_equal(surface.heights, heights, name)
        assert any("rows are taken along x" in str(warning.message) for warning in caught), name


def test_a_format_without_a_reader_is_named(tmp_path: Path) -> None:
    path = tmp_path / "scan.vk4"
    path.write_bytes(b"VK4_\0\0\0")
    program = (
        "import stribeck._exchange as e; e.find_spec = lambda *a: None\n"
        f"import stribeck\ntry: stribeck.surface.read({str(path)!r})\nexcept stribeck.SurfaceError as e: print(e.field, e)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("path ") and "Keyence vk4" in done.stdout and "stribeck[formats]" in done.stdout


def test_data_arrays_are_taken_and_given_back() -> None:
    xarray = pytest.importorskip("xarray")
    micrometre = {"units": "um"}
    coords = {"x": ("x", [0.0, 0.5, 1.0, 1.5], micrometre), "y": ("y", [1.0, 0.5, 0.0], micrometre)}
    array = xarray.DataArray(GAP[::-1].T * 1e6, coords=coords, dims=("x", "y"), attrs=micrometre)
    surface = Surface(array)
    np.testing.assert_allclose(surface.heights, GAP, rtol=1e-14)
    assert (surface.dx, surface.dy) == pytest.approx((0.5e-6, 0.5e-6))
    back = surface.to_xarray()
    assert back.dims == ("y", "x") and back.attrs["units"] == "m" and back.coords["x"].values[1] == pytest.approx(0.5e-6)
    np.testing.assert_array_equal(Surface(back).heights, surface.heights)
    with pytest.raises(stribeck.InputError, match="off a raster"):
        Surface(array.assign_coords(x=[0.0, 0.5, 1.2, 1.5]))
    np.testing.assert_array_equal(np.ma.getmaskarray(surface.to_masked()), np.isnan(GAP))
    bare = xarray.DataArray(GAP, dims=("y", "x"), coords={"x": np.arange(4.0), "y": np.arange(3.0)})
    with pytest.warns(stribeck.StribeckWarning, match="is not known"):
        assert len(Surface(bare).warnings) == 2
    assert Surface(bare, unit="um").dx == pytest.approx(1e-6)
    assert Surface(bare.assign_attrs(unit="nm"), "1 um").unit == "nm"
    with pytest.raises(stribeck.InputError, match=r"a Dataset \(h\)"):
        Surface(xarray.Dataset({"h": bare}))


#: Keys of each kind of roughness of a scene.
KINDS = {
    "gaussian": {"rq": 2e-8, "length_x": 6e-5, "length_y": 9e-5, "seed": 1},
    "exponential": {"rq": 2e-8, "length_x": 6e-5, "length_y": 6e-5, "seed": 2, "skewness": -1.0, "kurtosis": 5.0},
    "self_affine": {"rq": 2e-8, "hurst": 0.8, "roll_off": 2e-4, "shortest": 4e-5, "seed": 3},
    "random_phase": {"rq": 2e-8, "hurst": 0.7, "roll_off": 2e-4, "synthesis": "random_phase", "seed": 2**63 + 5},
    "ensemble": {"rq": 2e-8, "length_x": 6e-5, "length_y": 6e-5, "height": "ensemble", "boundary": "open", "seed": 4},
    "dimples": {"radius": 6e-5, "depth": 1e-6, "pitch": 2.5e-4, "layout": "random", "seed": 5},
    "grooves": {"width": 6e-5, "depth": 1e-6, "pitch": 1.25e-4, "direction": "along_y"},
}


@pytest.mark.parametrize("name", KINDS)
def test_a_generated_surface_is_that_of_the_scene_to_the_last_bit(rough: stribeck.Scene, name: str) -> None:
    keys = dict(KINDS[name])
    kind = {"random_phase": "self_affine", "ensemble": "gaussian"}.get(name, name)
    table = {"kind": kind, **keys}
    if keys.get("seed", 0) >= 2**63:
        table["seed"] = str(keys["seed"])
    disc = stribeck.Simulation(rough.replace(roughness={"disc": table})).bodies[1].initial
    if kind == "dimples":
        found = dimples(rough.grid, radius=keys["radius"], depth=keys["depth"], pitch=keys["pitch"], seed=keys["seed"])
    elif kind == "grooves":
        found = grooves(rough.grid, width=keys["width"], depth=keys["depth"], pitch=keys["pitch"], direction="y")
    else:
        found = generate(rough.grid, keys.pop("rq"), kind=kind, **keys)
    np.testing.assert_array_equal(found, disc)


def test_exact_rq_has_an_effect(rough: stribeck.Scene) -> None:
    options = {"kind": "self_affine", "hurst": 0.8, "roll_off": 2e-4, "seed": 3}
    exact = generate(rough.grid, 2e-8, exact_rq=True, **options)
    free = generate(rough.grid, 2e-8, exact_rq=False, **options)
    with pytest.raises(stribeck.InputError, match="exact_rq = True"):
        generate(rough.grid, 2e-8, exact_rq=True, height="ensemble", **options)
    assert exact.std() == pytest.approx(2e-8) and abs(free.std() / 2e-8 - 1.0) > 1e-3


def test_a_profile_is_drawn_with_its_spectrum() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    wave = 1e-7 * np.sin(2 * np.pi * np.arange(9600) / 96)
    figure = Surface(wave[np.newaxis], 1e-6).plot().figure
    assert figure.axes[0].get_aspect() == "auto"
    spectrum = next(axes for axes in figure.axes if axes.get_xlabel() == "wavenumber, 1/m")
    wavenumber, density = spectrum.lines[0].get_data()
    # the mean square is the integral over pi
    assert np.sum(density) * wavenumber[0] / np.pi == pytest.approx(0.5e-14, rel=1e-3)
    assert wavenumber[np.argmax(density)] == pytest.approx(2 * np.pi / 96e-6)
    plt.close(figure)


def test_a_surface_is_drawn() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    figure = Surface(np.where(np.arange(256).reshape(16, 16) % 37 == 3, np.nan, np.random.default_rng(1).normal(size=(16, 16)) * 1e-7), 1e-6).plot().figure
    labels = {axes.get_xlabel() for axes in figure.axes}
    assert {"x, um", "height, um", "material ratio", "wavenumber, 1/m"} <= labels
    bearing = next(axes for axes in figure.axes if axes.get_xlabel() == "material ratio")
    assert len(bearing.lines) == 4 and bearing.get_legend() is not None
    image = figure.axes[0].images[0]
    assert image.cmap.get_bad()[0] == pytest.approx(0.67) and np.ma.getmaskarray(image.get_array()).sum() == 7
    plt.close(figure)


def test_a_surface_is_drawn_into_given_axes_and_returns_its_artists() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    from stribeck import plot

    measured = Surface(np.random.default_rng(1).normal(size=(16, 16)) * 1e-7, 1e-6)
    figure, axes = plt.subplots(1, 5)
    drawn = plot.surface(measured, ax=axes)
    assert drawn.figure is figure
    assert [artist.axes for artist in (drawn.map, drawn.profile[0], drawn.heights[0], drawn.bearing[0], drawn.spectrum[0])] == list(axes)
    assert len(drawn.bearing) == 4 and not Surface(np.eye(3), 1e-6).plot().spectrum
    for wrong in (axes[0], axes[:4], 3):
        with pytest.raises(stribeck.InputError, match="ax = "):
            plot.surface(measured, ax=wrong)
    with pytest.raises(stribeck.InputError, match="measured"):
        plot.surface(np.eye(16))
    plt.close("all")
