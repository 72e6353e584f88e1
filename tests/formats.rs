//! Files of measured surfaces: real ones, what writers write, and damaged ones.

use std::path::{Path, PathBuf};

use approx::assert_relative_eq;
use stribeck::metrics::height_statistics;
use stribeck::surface::{
    Heights, LengthUnit, SurfaceError, read, read_bytes, write_npy, write_text, write_x3p,
};

/// The folder with the small files (`tests/data/surfaces/README.md`).
fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/surfaces").join(name)
}

/// Heights of the defined points.
fn defined(surface: &Heights) -> Vec<f64> {
    let flags = (0..surface.heights().len()).map(|k| surface.defined().is_none_or(|mask| mask[k]));
    surface.heights().iter().zip(flags).filter(|(_, flag)| *flag).map(|(z, _)| *z).collect()
}

/// What another program reads from a file, lengths in its unit.
struct Expected {
    name: &'static str,
    unit: LengthUnit,
    shape: [usize; 2],
    size: [f64; 2],
    undefined: usize,
    /// Sa, Sq, Ssk, Sku, minimum, maximum.
    statistics: [f64; 6],
    /// Points (0, 0), (1, 0) and (0, 1).
    corner: [f64; 3],
}

fn check(folder: &Path, expected: &Expected) {
    let surface = read(folder.join(expected.name)).unwrap();
    let metres = expected.unit.metres();
    assert_eq!([surface.nx(), surface.ny()], expected.shape, "{}", expected.name);
    assert_eq!(surface.undefined(), expected.undefined, "{}", expected.name);
    assert_eq!(surface.unit(), Some(expected.unit), "{}", expected.name);
    let sizes = [surface.dx().unwrap() * surface.nx() as f64, surface.dy().unwrap() * surface.ny() as f64];
    for (found, expected) in sizes.iter().zip(expected.size) {
        assert_relative_eq!(*found, expected * metres, max_relative = 1e-6);
    }
    let heights = defined(&surface);
    let s = height_statistics(&heights).unwrap();
    let found =
        [s.sa / metres, s.sq / metres, s.ssk, s.sku, (s.mean - s.sv) / metres, (s.mean + s.sp) / metres];
    for (found, expected) in found.iter().zip(expected.statistics) {
        assert_relative_eq!(*found, expected, max_relative = 1e-6);
    }
    for (k, expected) in [0, 1, surface.nx()].into_iter().zip(expected.corner) {
        assert_relative_eq!(surface.heights()[k] / metres, expected, max_relative = 1e-6);
    }
}

/// Values that `SurfaceTopography` 1.27.1 reads, unlevelled.
const WHOLE: [Expected; 6] = [
    Expected {
        name: "x3p-2.x3p",
        unit: LengthUnit::Metre,
        shape: [650, 650],
        size: [82.9767e-6, 204.4784e-6],
        undefined: 0,
        statistics: [
            6.195465568875e-8,
            7.728033273598e-8,
            -0.346788601,
            2.941933735,
            -3.144206866e-7,
            2.399155134e-7,
        ],
        corner: [6.579781341e-8, 7.419121341e-8, 6.233641341e-8],
    },
    Expected {
        name: "sur-2.sur",
        unit: LengthUnit::Millimetre,
        shape: [563, 484],
        size: [1.961492123, 1.686256106],
        undefined: 117,
        statistics: [1.201170603e-5, 1.751788124e-5, -14.66906542, 745.908017, 0.0089120001, 0.0103880001],
        corner: [0.0101477001, 0.0101473001, 0.0101470010],
    },
    Expected {
        name: "matrix-3.txt",
        unit: LengthUnit::Metre,
        shape: [256, 256],
        size: [10e-6, 10e-6],
        undefined: 0,
        statistics: [2.622809151e-8, 3.522291875e-8, -0.399788439, 5.661688105, -1.6861e-7, 2.4022e-7],
        corner: [1.8823e-8, 1.8497e-8, 2.0445e-8],
    },
    Expected {
        name: "sdf-1.sdf",
        unit: LengthUnit::Micrometre,
        shape: [7, 4],
        size: [7.0, 4.0],
        undefined: 0,
        statistics: [0.01158012755, 0.01360289729, -0.643046063, 2.577273075, 0.94907, 1.0],
        corner: [1.0, 0.99874, 0.99874],
    },
    Expected {
        name: "plu-1.plu",
        unit: LengthUnit::Micrometre,
        shape: [768, 576],
        size: [1274.880066, 956.1600494],
        undefined: 0,
        statistics: [2.451827936, 2.834390988, -0.001080147642, 1.808433614, -111.2304688, -101.2148438],
        corner: [-111.2265625, -111.2148438, -111.2265625],
    },
    Expected {
        name: "al3d-1.al3d",
        unit: LengthUnit::Metre,
        shape: [200, 296],
        size: [87.6054e-6, 129.655992e-6],
        undefined: 0,
        statistics: [
            6.394043751e-6,
            7.688265843e-6,
            -0.03311280979,
            2.249766475,
            0.07632320374,
            0.07635815442,
        ],
        corner: [0.07635815442, 0.07635813206, 0.07635810226],
    },
];

/// The whole files, which are too large for the repository:
/// `MEASURED_SURFACES=folder cargo test -- --ignored`.
#[test]
#[ignore = "needs the folder of the whole files in MEASURED_SURFACES"]
fn whole_files_are_read_as_by_another_program() {
    let folder = PathBuf::from(std::env::var_os("MEASURED_SURFACES").unwrap());
    for expected in &WHOLE {
        check(&folder, expected);
    }
}

// ---------------------------------------------------------------- small real files

#[test]
fn small_files_of_all_formats_are_read_as_by_other_programs() {
    let table = std::fs::read_to_string(data("expected.csv")).unwrap();
    let mut files = 0;
    for line in table.lines().skip(1) {
        let (name, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
        let surface = read(data(name)).unwrap();
        let s = height_statistics(&defined(&surface)).unwrap();
        let found = [
            surface.nx() as f64,
            surface.ny() as f64,
            surface.dx().unwrap() * surface.nx() as f64,
            surface.dy().unwrap() * surface.ny() as f64,
            surface.undefined() as f64,
            s.sa,
            s.sq,
            s.ssk,
            s.sku,
            s.mean - s.sv,
            s.mean + s.sp,
            surface.heights()[0],
            surface.heights()[1],
            surface.heights()[surface.nx()],
        ];
        assert_eq!(numbers.len(), found.len());
        for (found, expected) in found.iter().zip(numbers) {
            assert_relative_eq!(*found, expected, max_relative = 1e-6);
        }
        files += 1;
    }
    assert_eq!(files, 8);
}

// ---------------------------------------------------------------- writers

/// A surface with awkward numbers and two undefined points.
fn awkward() -> Heights {
    let mut heights: Vec<f64> = (0..35).map(|k| 1e-7 * (1.0 + f64::from(k)).ln() / 3.0).collect();
    heights[3] = -0.0;
    heights[4] = 5e-324;
    heights[5] = -f64::MAX;
    let mut mask = vec![true; 35];
    (mask[7], mask[34]) = (false, false);
    Heights::new(7, 5, Some([1.276_565_098_373_46e-7, 1e-6 / 3.0]), heights, Some(mask)).unwrap()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn writers_give_back_every_bit() {
    let folder = tempfile::tempdir().unwrap();
    let surface = awkward();
    let (x3p, text) = (folder.path().join("a"), folder.path().join("b"));
    write_x3p(&x3p, &surface).unwrap();
    write_text(&text, &surface).unwrap();
    for path in [x3p, text] {
        let back = read(&path).unwrap();
        assert_eq!(bits(back.heights()), bits(surface.heights()));
        assert_eq!((back.dx(), back.dy()), (surface.dx(), surface.dy()));
        assert_eq!(back.defined(), surface.defined());
        assert_eq!(back.unit(), Some(LengthUnit::Metre));
    }
    let without = Heights::new(7, 5, None, surface.heights().to_vec(), None).unwrap();
    let path = folder.path().join("c");
    write_npy(&path, 7, 5, without.heights()).unwrap();
    assert_eq!(bits(read(&path).unwrap().heights()), bits(without.heights()));
    write_text(&path, &without).unwrap();
    let back = read(&path).unwrap();
    assert_eq!((bits(back.heights()), back.dx()), (bits(without.heights()), None));
    assert!(matches!(write_x3p(&path, &without), Err(SurfaceError::NoSpacing)));
    let nowhere = folder.path().join("missing/a");
    assert!(matches!(write_x3p(&nowhere, &surface), Err(SurfaceError::Io { .. })));
    assert!(matches!(write_text(&nowhere, &surface), Err(SurfaceError::Io { .. })));
}

// ---------------------------------------------------------------- text

fn text(content: &str) -> Result<Heights, SurfaceError> {
    read_bytes(content.as_bytes(), "heights.txt")
}

#[test]
fn headers_of_several_programs_give_sizes_and_units() {
    let cases = [
        "# Channel: Z\n# Width: 3.0 µm\n# Height: 4 µm\n# Value units: nm\n1 2 3\n4 5 6\n",
        "# File Format = ASCII\nx-pixels = 3\ny-pixels = 2\nx-length = 3000\ny-length = 4000\nx-unit = nm\ny-unit = nm\nz-unit = nm\n1\t2\t3\n4\t5\t6\n",
        "x-pixels = 3\ny-pixels = 2\nx-length = 3000\ny-length = 4000\nx-unit = nm\ny-unit = nm\nBit2nm = 1.0\n1 2\n3 4\n5 6\n",
        "\u{feff}# Width = 3e-6\n# Height = 4e-6\n# Value units = nm\r\n1,2,3,\r\n4,5,6,\r\n",
        "Spacing X: 1 um\nSpacing Y: 2 um\nz unit: mm\n1e-6;0,000002;3e-6\n4e-6;5e-6;6e-6\n",
        "scale x = 1\nscale y = 2\nunit x = um\nheight conversion factor (-> m) = 1e-9\n1,0\t2,0\t3,0\n4,0\t5,0\t6,0",
        "# Width: 3 um\n# Height: 4 um\n# Value units: nm\n1 2 3\n4 5 6\n\n# Channel: second\n7 8\n",
        "# Width: 3,0 um\n# Height: 4,0 um\n# Value units: nm\n1,0\t2,0\t3,0\n4,0\t5,0\t6,0\n",
        "# unit: um\n# dx: 1\n# dy: 2\n1e-3,2e-3,3e-3\n4e-3,5e-3,6e-3\n",
        "# units = nm\n# x-pixel-size = 1 um\n# y-pixel-size = 2 [um]\n1,2,3\n4,5,6\n",
        "# Heights [nm]\n# dx [um]: 1\n# dy (um) = 2\n1;2;3\n4;5;6\n",
        "# z unit: nm\n# xy unit: um\n# x step: 1\n# y step: 2\n1 2 3\n4 5 6\n",
    ];
    for case in cases {
        let surface = text(case).unwrap();
        assert_eq!((surface.nx(), surface.ny(), surface.undefined()), (3, 2, 0), "{case}");
        assert_relative_eq!(surface.dx().unwrap(), 1e-6, max_relative = 1e-14);
        assert_relative_eq!(surface.dy().unwrap(), 2e-6, max_relative = 1e-14);
        for (k, z) in surface.heights().iter().enumerate() {
            assert_relative_eq!(*z, (k + 1) as f64 * 1e-9, max_relative = 1e-14);
        }
        // as some programs of Windows write text
        for (mark, order) in
            [([0xff, 0xfe], u16::to_le_bytes as fn(u16) -> [u8; 2]), ([0xfe, 0xff], u16::to_be_bytes)]
        {
            let units = case.trim_start_matches('\u{feff}').encode_utf16().flat_map(order);
            let wide: Vec<u8> = mark.into_iter().chain(units).collect();
            assert_eq!(read_bytes(&wide, "wide.txt").unwrap(), surface, "{case}");
        }
    }
    // Latin-1 micro sign
    let latin = b"# Width: 3 \xb5m\n# Height: 4 \xb5m\n1 2 3\n4 5 6\n";
    assert_eq!(read_bytes(latin, "latin").unwrap().dx(), Some(1e-6));
    let plain = text("1 2\nbad 4\n5,").unwrap_err().to_string();
    assert!(plain.contains("line 3"), "{plain}");
    let plain = text("1,2\nBAD,4\n,6\n").unwrap();
    assert_eq!((plain.dx(), plain.unit(), plain.undefined()), (None, None, 2));
    assert_eq!(plain.defined().unwrap(), [true, true, false, true, false, true]);
}

#[test]
fn empty_fields_at_the_end_of_a_line_are_undefined() {
    for content in ["1;2;3\n4;5;\n;8;9\n", "1,2,3\n4,5,\n,8,9\n", "1;2;3;\n4;5;;\n;8;9;\n"] {
        let surface = text(content).unwrap();
        assert_eq!((surface.nx(), surface.ny(), surface.undefined()), (3, 3, 2), "{content}");
        let mask = surface.defined().unwrap();
        assert!(!mask[5] && !mask[6]);
    }
    let error = text("1;2;3\n4;\n").unwrap_err().to_string();
    assert!(error.contains("line 2: 1 heights, 3 in the first row"), "{error}");
}

#[test]
fn damaged_texts_are_refused_by_line_and_field() {
    let cases = [
        ("1 2 3\n4 5\n", "line 2: 2 heights, 3 in the first row"),
        ("1 2\n3 x\n", "line 2, field 2: x is not a number"),
        ("1 nope\n", "line 1, field 2: nope"),
        ("1 2\n3 nan\n", "height (1, 1) = NaN"),
        ("1 inf\n3 4\n", "height (1, 0) = inf"),
        ("x-pixels = 3\ny-pixels = 2\n1 2 3\n", "3 heights, the header says 3 x 2"),
        ("x-pixels = 4\n1 2 3\n", "3 heights along x, the header says 4"),
        ("x-pixels = many\n1 2 3\n", "x pixels = many is not a count"),
        ("# Width: wide\n1 2\n", "width = wide is not a length"),
        ("# Width: 0 m\n# Height: 1 m\n1 2\n", "grid.dx"),
        ("# Width: 3 m\n1 2\n", "one axis only"),
        ("# Width: 3 V\n# Height: 3 V\n1 2\n", "lateral unit \"V\""),
        ("# Value units: V\n1 2\n", "height unit \"V\""),
        ("# Width: 3 m\n", "no heights after the header"),
        ("hello\nworld\n", "neither"),
        ("\n\n", "neither"),
        ("x-pixels = 99999999999\ny-pixels = 99999999999\n1 2\n", "2 heights, the header says 99999999999"),
    ];
    for (content, expected) in cases {
        let error = text(content).unwrap_err().to_string();
        assert!(error.contains(expected) && error.contains("heights.txt"), "{expected}: {error}");
    }
}

// ---------------------------------------------------------------- damaged binary files

fn patched(name: &str, patches: &[(usize, &[u8])]) -> Vec<u8> {
    let mut bytes = std::fs::read(data(name)).unwrap();
    for (at, patch) in patches {
        bytes[*at..at + patch.len()].copy_from_slice(patch);
    }
    bytes
}

/// `text` with `from` replaced, of the same length.
fn replaced(name: &str, from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let mut bytes = std::fs::read(data(name)).unwrap();
    let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    bytes
}

#[test]
fn heights_of_ascii_sdf_files_may_be_separated_in_other_ways() {
    let text = std::fs::read_to_string(data("ascii.sdf")).unwrap();
    let (head, heights) = text.split_once("*\n").unwrap();
    let read = |heights: &str, head: &str| read_bytes(format!("{head}*\n{heights}").as_bytes(), "other.sdf");
    let expected = read(heights, head).unwrap();
    assert_eq!(expected.unit(), Some(LengthUnit::Micrometre));
    for separator in [",", ", ", ";", "\t", "\r\n", ",\n"] {
        let (matrix, trailer) = heights.split_once('*').unwrap();
        let other = format!("{}*{trailer}", matrix.replace(' ', separator));
        assert_eq!(read(&other, head).unwrap(), expected, "{separator:?}");
    }
    assert_eq!(read(heights, &head.replace("Compression = 0\n", "")).unwrap(), expected);
    let error = read(&heights.replace('.', ","), head).unwrap_err().to_string();
    assert!(error.contains("more than the 7 x 4 heights"), "{error}");
}

#[test]
fn damaged_files_are_refused_by_name_and_place() {
    let sur = |patches: &[(usize, &[u8])]| patched("cut.sur", patches);
    let huge = i32::MAX.to_le_bytes();
    let nan = f32::NAN.to_le_bytes();
    let infinite = f32::INFINITY.to_le_bytes();
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (sur(&[])[..500].to_vec(), "the header needs 512 bytes"),
        (sur(&[])[..2000].to_vec(), "the data of 24 x 18 points needs 1728 bytes"),
        (sur(&[(12, &[1])]), "byte order"),
        (sur(&[(18, &[12])]), "an object of type 12"),
        (sur(&[(98, &[8])]), "8 bits per point"),
        (sur(&[(108, &huge), (112, &huge)]), "at most 2^26"),
        (sur(&[(108, &[0xff; 4])]), "-1 points per line"),
        (sur(&[(116, &[1, 0, 0, 0])]), "counts 1 points in 24 x 18"),
        (sur(&[(120, &nan)]), "grid.dx"),
        (sur(&[(124, &[0; 4])]), "grid.dy"),
        (sur(&[(128, &infinite)]), "height (0, 0)"),
        (sur(&[(212, b"volt")]), "height unit \"volt\""),
        (patched("compressed.sur", &[(512, &[0; 4])]), "0 compressed streams"),
        (patched("compressed.sur", &[(524, &[0xff; 8])]), "compressed stream 0"),
        (patched("compressed.sur", &[(516 + 4, &[10, 0, 0, 0])]), "compressed stream 0: "),
        (patched("compressed.sur", &[(108, &[23]), (116, &[0x9e, 0x01])]), "more than 1656 bytes"),
        (replaced("ascii.sdf", "NumPoints = 7", "NumPoints = 8"), "28 heights, the header says 8 x 4"),
        (replaced("ascii.sdf", "NumPoints = 7", "NumPoints = 6"), "more than the 6 x 4 heights"),
        (replaced("ascii.sdf", "NumPoints", "Num_oints"), "the header lacks NumPoints"),
        (replaced("ascii.sdf", "0.98865", "0.9x865"), "height (3, 0) = 0.9x865 is not a number"),
        (replaced("ascii.sdf", "0.98865", "    NaN"), "height (3, 0) = NaN is not finite"),
        (replaced("ascii.sdf", "DataType = 7", "DataType = 9"), "DataType = 9"),
        (replaced("ascii.sdf", "Compression = 0", "Compression = 1"), "Compression = 1"),
        (replaced("ascii.sdf", "Zscale = 1.0E-6", "Zscale = 1.0E+x"), "Zscale = 1.0E+x"),
        (b"aISO-1.0 nothing".to_vec(), "not closed by *"),
        (patched("binary.sdf", &[])[..1000].to_vec(), "the data of 24 x 18 points"),
        (patched("binary.sdf", &[(42, &[0; 2])]), "at least 1"),
        (patched("binary.sdf", &[(46 + 16, &f64::NAN.to_le_bytes())]), "Zscale = NaN"),
        (patched("binary.sdf", &[(81, &f64::NAN.to_le_bytes())]), "height (0, 0) = NaN"),
        (patched("cut.al3d", &[])[..1000].to_vec(), "tag"),
        (patched("cut.al3d", &[])[..2000].to_vec(), "the depth image of 23 x 18 points"),
        (replaced("cut.al3d", "Cols\0", "Colx\0"), "tag Cols is missing"),
        (replaced("cut.al3d", "4.38027e-07", "4,38027e-07"), "4,38027e-07 is not a number"),
        (patched("cut.al3d", &[(1261 + 4, &f32::NEG_INFINITY.to_le_bytes())]), "height (1, 0) = -inf"),
        (patched("cut.plu", &[])[..1500].to_vec(), "the data of 24 x 18 points needs 1728 bytes"),
        (patched("cut.plu", &[(428, &[1])]), "type 1 instead of 3"),
        (patched("cut.plu", &[(489, &[0])]), "no layer"),
        (patched("cut.plu", &[(500, &huge)]), "at most 2^26"),
        (patched("cut.plu", &[(508 + 8, &nan)]), "height (2, 0) = NaN"),
        (patched("cut.plu", &[(404, &nan)]), "grid.dx"),
        (vec![0; 4096], "neither"),
    ];
    for (bytes, expected) in cases {
        let error = read_bytes(&bytes, "damaged.bin").unwrap_err().to_string();
        assert!(error.contains(expected) && error.contains("damaged.bin"), "{expected}: {error}");
    }
}

#[test]
fn digital_surf_files_of_motorola_processors_are_read() {
    let plain = std::fs::read(data("cut.sur")).unwrap();
    let mut swapped = plain.clone();
    swapped[13] = 1;
    for at in [18, 86, 98, 290, 334, 336] {
        swapped[at..at + 2].reverse();
    }
    for at in [100, 104, 108, 112, 116, 120, 124, 128, 474] {
        swapped[at..at + 4].reverse();
    }
    let start = plain.len() - 24 * 18 * 4;
    swapped[start..].chunks_exact_mut(4).for_each(<[u8]>::reverse);
    let found = read_bytes(&swapped, "motorola.sur").unwrap();
    assert_eq!(found, read_bytes(&plain, "cut.sur").unwrap());
    assert!(found.undefined() > 0);
}

#[test]
fn depths_beyond_all_heights_are_undefined() {
    let plain = read(data("cut.al3d")).unwrap();
    for depth in [f32::INFINITY, f32::NAN, 3e15] {
        let found =
            read_bytes(&patched("cut.al3d", &[(1261 + 4, &depth.to_le_bytes())]), "depth.al3d").unwrap();
        assert_eq!(
            (found.undefined(), found.defined().unwrap()[1]),
            (plain.undefined() + 1, false),
            "{depth}"
        );
    }
}

#[test]
fn digital_surf_heights_may_be_upside_down() {
    let plain = read(data("cut.sur")).unwrap();
    for (inversion, source) in [(1_u8, [0, 1, 24]), (2, [23, 22, 47]), (3, [17 * 24, 17 * 24 + 1, 16 * 24])] {
        let turned = read_bytes(&patched("cut.sur", &[(290, &[inversion])]), "turned.sur").unwrap();
        assert_eq!(turned.undefined(), plain.undefined());
        for (k, from) in [0, 1, 24].into_iter().zip(source) {
            assert_relative_eq!(turned.heights()[k], -plain.heights()[from], max_relative = 1e-15);
        }
    }
}
