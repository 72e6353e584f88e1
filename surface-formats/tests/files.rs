//! Instrument files: real ones cut small, writers, damaged ones.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use common::{check, data, moments};
use surface_formats::{
    Error, LengthUnit, Options, Surface, read, read_bytes, write_npy, write_text, write_x3p,
};

#[test]
fn small_files_of_all_formats_read_as_by_other_programs() {
    let table = std::fs::read_to_string(data("expected.csv")).unwrap();
    let mut files = 0;
    for line in table.lines().skip(1) {
        let (name, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
        let surface = read(data(name)).unwrap();
        assert!(surface.warnings.is_empty(), "{name}: {:?}", surface.warnings);
        let [dx, dy] = surface.spacing.unwrap();
        let z = moments(&surface);
        let found = [
            surface.nx as f64,
            surface.ny as f64,
            dx * surface.nx as f64,
            dy * surface.ny as f64,
            surface.undefined() as f64,
            z.sa,
            z.sq,
            z.ssk,
            z.sku,
            z.lowest,
            z.highest,
            surface.heights[0],
            surface.heights[1],
            surface.heights[surface.nx],
        ];
        assert_eq!(numbers.len(), found.len());
        for (found, expected) in found.into_iter().zip(numbers) {
            assert!(
                (found - expected).abs() <= 1e-6 * expected.abs(),
                "{name}: {found}, expected {expected}"
            );
        }
        files += 1;
    }
    assert_eq!(files, 8);
}

/// Points, sizes, undefined counts, Sa and Sq of the whole files, which are too large for the repository, as
/// `SurfaceTopography` 1.27.1 reads them: `MEASURED_SURFACES=folder cargo test -- --ignored`.
#[test]
#[ignore = "needs the folder of the whole files in MEASURED_SURFACES"]
fn whole_files_read_as_by_another_program() {
    let folder = std::path::PathBuf::from(std::env::var_os("MEASURED_SURFACES").unwrap());
    let whole = [
        (
            "x3p-2.x3p",
            LengthUnit::Metre,
            [650, 650],
            [82.9767e-6, 204.4784e-6],
            0,
            6.195465568875e-8,
            7.728033273598e-8,
        ),
        (
            "sur-2.sur",
            LengthUnit::Millimetre,
            [563, 484],
            [1.961492123, 1.686256106],
            117,
            1.201170603e-5,
            1.751788124e-5,
        ),
        ("matrix-3.txt", LengthUnit::Metre, [256, 256], [10e-6, 10e-6], 0, 2.622809151e-8, 3.522291875e-8),
        ("sdf-1.sdf", LengthUnit::Micrometre, [7, 4], [7.0, 4.0], 0, 0.01158012755, 0.01360289729),
        (
            "plu-1.plu",
            LengthUnit::Micrometre,
            [768, 576],
            [1274.880066, 956.1600494],
            0,
            2.451827936,
            2.834390988,
        ),
        (
            "al3d-1.al3d",
            LengthUnit::Metre,
            [200, 296],
            [87.6054e-6, 129.655992e-6],
            0,
            6.394043751e-6,
            7.688265843e-6,
        ),
    ];
    for (name, unit, points, size, undefined, sa, sq) in whole {
        let surface = read(folder.join(name)).unwrap();
        let size = size.map(|length| length * unit.metres());
        check(
            name,
            &surface,
            points,
            Some(size),
            Some(unit),
            undefined,
            sa * unit.metres(),
            sq * unit.metres(),
        );
    }
}

// ---------------------------------------------------------------- writers

/// A surface with awkward numbers and two undefined points.
fn awkward() -> Surface {
    let mut heights: Vec<f64> = (0..35).map(|k| 1e-7 * (1.0 + f64::from(k)).ln() / 3.0).collect();
    heights[3] = -0.0;
    heights[4] = 5e-324;
    heights[5] = -f64::MAX;
    (heights[7], heights[34]) = (f64::NAN, f64::NAN);
    Surface::new(7, 5, heights).with_spacing(Some([1.276_565_098_373_46e-7, 1e-6 / 3.0]))
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| if value.is_nan() { 0 } else { value.to_bits() }).collect()
}

#[test]
fn written_files_read_back_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let surface = awkward();
    let path = |name: &str| folder.path().join(name);
    write_x3p(path("a"), &surface).unwrap();
    write_text(path("b"), &surface).unwrap();
    write_npy(path("c"), &surface).unwrap();
    for (name, has_spacing) in [("a", true), ("b", true), ("c", false)] {
        let back = read(path(name)).unwrap();
        assert_eq!(bits(&back.heights), bits(&surface.heights), "{name}");
        assert_eq!(back.undefined(), 2, "{name}");
        assert_eq!(back.spacing, surface.spacing.filter(|_| has_spacing), "{name}");
        assert_eq!(back.unit, has_spacing.then_some(LengthUnit::Metre), "{name}");
    }
    let without = awkward().with_spacing(None);
    assert!(matches!(write_x3p(path("d"), &without), Err(Error::NoSpacing)));
    write_text(path("d"), &without).unwrap();
    assert_eq!(read(path("d")).unwrap().spacing, None);
    for written in [
        write_x3p(path("no/a"), &surface),
        write_text(path("no/a"), &surface),
        write_npy(path("no/a"), &surface),
    ] {
        assert!(matches!(written, Err(Error::Io { .. })));
    }
}

// ---------------------------------------------------------------- numpy

/// An npy file with `descr`, `shape` and data.
fn npy(descr: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    let mut file = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    file.extend(format!("{header:<117}\n").as_bytes());
    file.extend(data);
    file
}

#[test]
fn nan_and_infinite_values_of_npy_files_are_undefined() {
    let values = [1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5.0, 6.0];
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let surface = read_bytes(&npy("<f8", "(2, 3)", &data), "a.npy").unwrap();
    assert_eq!((surface.nx, surface.ny, surface.undefined()), (3, 2, 3));
    assert!(surface.warnings[0].contains("the unit of the heights is not known"));
    let options = Options::new().with_unit(LengthUnit::Nanometre);
    let named = options.read_bytes(&npy("<f8", "(2, 3)", &data), "a.npy").unwrap();
    assert_eq!((named.heights[0], named.warnings.len()), (1e-9, 0));
}

#[test]
fn arrays_that_are_no_heights_are_refused_with_the_reason() {
    for (descr, shape, expected) in [
        ("|b1", "(3, 4)", "array of type '|b1', heights are integers or floats"),
        ("<f8", "(1, 3, 4)", "array of shape (1, 3, 4) instead of (ny, nx)"),
        ("<c16", "(3, 4)", "array of type '<c16'"),
    ] {
        let error = read_bytes(&npy(descr, shape, &[0; 12]), "a.npy").unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}

// ---------------------------------------------------------------- formats without a reader

#[test]
fn formats_without_a_reader_are_named() {
    let cases: [(&[u8], &str); 6] = [
        (b"VK4_\0\0", "Keyence vk4"),
        (b"\x88\x1b\x03\x6f\0", "Zygo MetroPro dat"),
        (b"VCA DATA\x01", "Bruker Dektak opdx"),
        (b"\x01\x00Directory\0", "Wyko opd"),
        (b"GWYP\0", "Gwyddion gwy"),
        (b"\\*File list\r\n\\Version: 1\r\n\x1a\0\0", "Nanoscope spm"),
    ];
    for (bytes, expected) in cases {
        let Err(Error::Foreign { format, .. }) = read_bytes(bytes, "a.bin") else { panic!("{expected}") };
        assert_eq!(format, expected);
    }
    let folder =
        |names: &[&str]| common::archive(&names.iter().map(|name| (*name, &b""[..])).collect::<Vec<_>>());
    let error = read_bytes(&folder(&["index.xml", "LAYER_0.raw"]), "a.plux").unwrap_err().to_string();
    assert!(error.contains("Sensofar plux"), "{error}");
    let sheets = b"<sheet name=\"Certificate\"/><sheet name=\"DATA\"/>";
    let error =
        read_bytes(&common::archive(&[("xl/workbook.xml", sheets)]), "a.xlsx").unwrap_err().to_string();
    assert!(error.contains("Mitutoyo xlsx"), "{error}");
    let error = read_bytes(&folder(&["a.npy"]), "a.npz").unwrap_err().to_string();
    assert!(error.contains("NumPy archive npz"), "{error}");
}
