//! Files that leave something open: read with a warning, or refused by name.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use common::archive;
use surface_formats::{Error, LengthUnit, Options, Surface, read_bytes};

fn read(content: &str) -> Surface {
    read_bytes(content.as_bytes(), "a.csv").unwrap_or_else(|error| panic!("{content}: {error}"))
}

fn nanometres(surface: &Surface) -> Vec<i64> {
    surface.heights.iter().map(|z| (z * 1e9).round() as i64).collect()
}

fn refused(content: &str, expected: &str) {
    match read_bytes(content.as_bytes(), "a.csv") {
        Ok(surface) => panic!("{content} was read as {surface:?}"),
        Err(error) => {
            let error = error.to_string();
            assert!(error.starts_with("a.csv: ") && error.contains(expected), "{expected}: {error}");
        }
    }
}

/// Steps of a profile whose positions in micrometres are `spacing` apart and printed with `digits` decimals.
fn profile(points: usize, spacing: f64, digits: usize) -> String {
    let line = |k: usize| format!("{:.digits$},{}\n", spacing * k as f64, k % 3);
    "x (um),z (nm)\n".to_owned() + &(0..points).map(line).collect::<String>()
}

#[test]
fn rounded_positions_are_those_of_equidistant_points() {
    for (points, spacing, digits) in [
        (40, 0.15625, 1),
        (9600, 0.15625, 1),
        (40, 0.0025, 3),
        (40, 0.00125, 3),
        (3000, 0.00125, 3),
        (3000, 1.0101, 0),
        (3000, 2.3456, 0),
    ] {
        let surface = read(&profile(points, spacing, digits));
        let [dx, _] = surface.spacing.unwrap();
        assert_eq!((surface.nx, surface.undefined()), (points, 0), "{spacing} with {digits} digits");
        // both ends are half of a digit off at most
        let off = (dx * 1e6 - spacing).abs() * (points - 1) as f64;
        assert!(off <= 1.1 * 0.1_f64.powi(digits as i32), "{spacing} with {digits} digits: {dx:e}");
    }
    let map =
        |k: usize| format!("{:.1},{:.1},{}\n", 0.15625 * (k % 20) as f64, 0.15625 * (k / 20) as f64, k % 7);
    let map = read(&("x (um),y (um),z (um)\n".to_owned() + &(0..400).map(map).collect::<String>()));
    assert_eq!((map.nx, map.ny, map.undefined()), (20, 20, 0));
    assert!(map.warnings.iter().all(|doubt| doubt.contains("equidistant ones")) && map.warnings.len() == 2);
}

#[test]
fn missing_points_of_a_raster_are_undefined() {
    let points = |missing: &[usize], digits: usize| {
        let line = |k: usize| format!("{:.digits$},{}\n", k as f64, k % 3);
        let rest = (0..100).filter(|k| !missing.contains(k)).map(line);
        read(&("x (um),z (um)\n".to_owned() + &rest.collect::<String>()))
    };
    for missing in [&[52][..], &[2, 3], &[10, 11, 12, 13, 14, 15], &[20, 21, 50, 51, 52, 90]] {
        for digits in [0, 1, 3] {
            let surface = points(missing, digits);
            assert_eq!((surface.nx, surface.undefined()), (100, missing.len()), "{missing:?}");
        }
    }
    let few = read("x (mm),z (um)\n0.000,2\n0.001,1\n0.004,4\n0.005,4\n");
    assert_eq!((few.nx, few.undefined()), (6, 2));
    refused("x (um),z (um)\n0.0,1\n1.0,2\n2.1,1\n3.0,2\n4.0,1\n5.0,2\n6.0,2\n7.0,1\n", "(10 %)");
}

#[test]
fn a_unit_in_a_title_makes_a_column_whatever_the_word() {
    let rows = "0,1\n1,2\n2,4\n3,1\n";
    for (x, z) in [
        ("x in um", "z in nm"),
        ("Weg [\u{b5}m]", "H\u{f6}he [nm]"),
        ("foo (um)", "baz (nm)"),
        ("Posizione (um)", "Altezza (nm)"),
        ("\u{8ddd}\u{96e2} (um)", "\u{9ad8}\u{3055} (nm)"),
        ("\u{4f4d}\u{7f6e}(um)", "\u{9ad8}\u{5ea6}(nm)"),
        (
            "\u{414}\u{43b}\u{438}\u{43d}\u{430} (\u{43c}\u{43a}\u{43c})",
            "\u{412}\u{44b}\u{441}\u{43e}\u{442}\u{430} (\u{43d}\u{43c})",
        ),
        ("X_POS_UM", "HEIGHT_NM"),
    ] {
        let surface = read(&format!("{x},{z}\n{rows}"));
        assert_eq!((surface.nx, surface.ny, surface.unit), (4, 1, Some(LengthUnit::Nanometre)), "{x}");
        assert_eq!((surface.spacing.unwrap()[0], surface.heights[2]), (1e-6, 4e-9), "{x}");
    }
    let indexed = read("index,x in um,y in um\n0,0.0,1\n1,0.5,2\n2,1.0,4\n");
    assert_eq!((indexed.nx, indexed.spacing.unwrap()[0], indexed.heights[2]), (3, 0.5e-6, 4e-6));
    let encoder = read(
        "Counter\tAltitude (um)\tEncoder1 (um)\tRow number\n7\t0.25\t-1.0\t1\n8\t2.25\t-0.5\t1\n9\t4.25\t0.0\t1\n",
    );
    assert_eq!((encoder.nx, encoder.ny, encoder.heights[1]), (3, 1, 2.25e-6));
    assert_eq!(encoder.warnings, ["columns \"Encoder1\", \"Altitude\" are read as positions and heights"]);
    let units = read("um,nm\n0.0,1\n0.5,2\n1.0,4\n");
    assert_eq!((units.nx, units.spacing.unwrap()[0], nanometres(&units)), (3, 0.5e-6, vec![1, 2, 4]));
    assert_eq!(nanometres(&read("Height Sensor (nm)\n1\n2\n4\n")), [1, 2, 4]);
    let map = read("foo (um),bar (um),baz (nm)\n0,0,1\n1,0,2\n0,1,4\n1,1,8\n");
    assert_eq!((map.nx, map.ny, map.heights[3]), (2, 2, 8e-9));
    let left = read("x (um),z (um),intensity\n0,1,200\n1,2,201\n2,1,202\n");
    assert_eq!(left.warnings, ["columns \"intensity\" are left out"]);
    let dektak = "Resolution,0.156 um/sample\nLateral um,Raw Micrometer,\n0.0,1,,\n0.5,2,,\n1.0,1,,\n";
    assert_eq!((read(dektak).nx, read(dektak).heights[1]), (3, 2e-6));
}

#[test]
fn several_height_columns_are_chosen_by_number() {
    let second =
        |content: &str| Options::new().with_channel(2).read_bytes(content.as_bytes(), "a.csv").unwrap();
    for (titles, names) in [
        ("x (um),raw (um),filtered (um)", "1 \"raw\", 2 \"filtered\""),
        ("x (um),height (um),waviness (um)", "1 \"height\", 2 \"waviness\""),
    ] {
        let content = format!("{titles}\n0,1,1.5\n1,2,2.5\n2,4,4.5\n");
        refused(&content, names);
        assert_eq!(nanometres(&second(&content)), [1500, 2500, 4500]);
    }
    let pairs = "x1 (um),z1 (nm),x2 (um),z2 (nm)\n0,1,0,10\n1,2,2,20\n2,4,4,40\n";
    refused(pairs, "1 \"z1\", 2 \"z2\"");
    assert_eq!((nanometres(&second(pairs))[2], second(pairs).spacing.unwrap()[0]), (40, 2e-6));
}

#[test]
fn titles_that_are_not_understood_are_refused_by_name() {
    refused("foo,bar,baz\n0,0,1\n1,0,2\n0,1,4\n1,1,8\n", "columns \"foo\", \"bar\", \"baz\"");
    refused(",a,b,c\n0,1.5,2.5,3.5\n1,4.5,5.5,6.5\n", "columns \"\", \"a\", \"b\", \"c\"");
    refused("a (um),b (um),c (um),d (um)\n0,1,2,3\n1,2,3,5\n", "\"a\", \"b\", \"c\", \"d\"");
    refused("name,Sa,Sq\ns1,1.0,1.2\ns2,2.0,2.2\n", "\"name\", \"Sa\", \"Sq\"");
    refused("Sa (nm),Sq (nm)\n10,12\n11,13\n12,15\n", "roughness parameters instead of heights");
    refused("2020-01-01,1,2\n2020-01-02,3,4\n", "neither x3p");
    // a remedy of the message
    let matrix = read("x-pixels = 3\nfoo,bar,baz\n0,0,1\n1,0,2\n");
    assert_eq!((matrix.nx, matrix.ny), (3, 2));
    // sentences are no titles
    assert_eq!(read("# Created on Monday\n# unit: nm\n1 2 3\n4 5 7\n").nx, 3);
}

#[test]
fn counts_that_contradict_the_rows_are_refused() {
    let file = |nx: usize, ny: usize, rows: &str| {
        format!("# x-pixels = {nx}\n# y-pixels = {ny}\n# z-unit = nm\n{rows}")
    };
    let rows = "1 2 3\n4 5 6\n";
    refused(&file(2, 3, rows), "2 rows of 3 heights contradict the 2 x 3 points");
    refused(&file(4, 6, &rows.repeat(4)), "8 rows of 3 heights");
    // rows may be wrapped
    for (nx, ny) in [(3, 2), (6, 1)] {
        let surface = read(&file(nx, ny, rows));
        assert_eq!((surface.nx, surface.ny), (nx, ny));
    }
    assert_eq!(nanometres(&read(&file(3, 2, "1\n2\n3\n4\n5\n6\n"))), [1, 2, 3, 4, 5, 6]);
    assert_eq!(nanometres(&read(&file(3, 2, "1 2\n3\n4 5\n6\n"))), [1, 2, 3, 4, 5, 6]);
    let column =
        |first: &str| first.to_owned() + &(0..12).map(|k| format!("{}.5\n", k % 5)).collect::<String>();
    refused(&column("10.00000\n12\n"), "the first numbers, 10 and 12, count the others");
    refused(&column("12\n"), "the first number, 12, counts the others");
    refused(&column("4\n3\n"), "the first numbers, 4 and 3, count the others");
    assert_eq!(read(&column("")).nx, 12);
}

#[test]
fn empty_lines_divide_surfaces() {
    let two = "# Width: 2 um\n# Height: 2 um\n# Value units: nm\n1 2\n3 4\n\n5 6\n7 9\n";
    refused(two, "2 \"lines 7 to 8\"");
    let second = Options::new().with_channel(2).read_bytes(two.as_bytes(), "a.txt").unwrap();
    assert_eq!((second.ny, nanometres(&second)[3], second.spacing), (2, 9, Some([1e-6; 2])));
    refused("# unit: nm\n1 2 3\n4 5 6\n\n\n7 8 9\n1 2 3\n", "an empty line before line 6 divides the rows");
    // single rows, lists of positions and counted points
    assert_eq!(read("1 2 3 4\n\n5 6 7 9\n\n1 2 3 4\n").ny, 3);
    assert_eq!(read("x (um) y (um) z (um)\n0 0 1\n1 0 2\n\n0 1 3\n1 1 5\n").ny, 2);
    assert_eq!(read("ncols 6\nnrows 2\n1 2 3\n4 5 6\n\n7 8 9\n1 2 4\n").ny, 2);
}

#[test]
fn units_that_contradict_each_other_are_refused() {
    refused("# unit: nm\nx (um),z (um)\n0,1\n1,2\n2,4\n", "unit = nm contradicts the unit um of the title");
    refused("# unit: m\nx (um),z (nm)\n0,1\n1,2\n2,4\n", "unit = m contradicts the unit nm of the title");
    refused("# z-unit: um\n# unit: nm\n1 2\n3 4\n", "unit = nm contradicts z unit = um");
    refused("# lateral unit: mm\nx (um),z (nm)\n0,1\n1,2\n2,4\n", "contradicts the unit um of the title");
    refused(
        "# x-length = 2\n# y-length = 2\n# z-unit = um\n# Bit2nm = 2\n1 2\n3 4\n",
        "bit2nm = 2 contradicts",
    );
    refused("unit: px\n1 2\n3 4\n", "unit: \"px\" is no unit of length");
    // positions take the unit of all
    let profile = read("# unit: um\nx,z (nm)\n0,1\n1,2\n2,4\n");
    assert_eq!((profile.spacing.unwrap()[0], profile.heights[1]), (1e-6, 2e-9));
    let nova =
        "NX = 2\nNY = 2\nScale X = 0.5\nScale Y = 250\nUnit X = um\nUnit Y = nm\nUnit Data = nm\n1 2\n3 4\n";
    assert_eq!(read(nova).spacing, Some([0.5e-6, 250.0 * 1e-9]));
    let spip = "# File Format = ASCII\n# x-pixels = 2\n# y-pixels = 2\n# x-length = 2\n# y-length = 2\n# x-unit = um\n# z-unit = nm\n1 2\n3 4\n";
    assert_eq!(read(spip).spacing, Some([1e-6; 2]));
    assert_eq!(read(spip).warnings, ["y length has no unit and is read in that of x unit, um"]);
}

#[test]
fn numbers_that_look_like_positions_are_said() {
    refused(
        &(0..16).map(|k| format!("{} {} {} 200\n", k % 4, k / 4, k * k % 7)).collect::<String>(),
        "4 columns without titles, the first two of which are positions",
    );
    let has_doubt =
        |content: &str| read(content).warnings.iter().any(|doubt| doubt.contains("as coordinates do"));
    assert!(has_doubt("0 0 0.5 1\n0 1 5 2\n0.5 4 4 1\n1 7 2 3\n"));
    assert!(has_doubt("0.0 7 1 2\n0.1 3 5 1\n0.2 4 1 1\n0.3 6 1 9\n"));
    assert!(!has_doubt("1 2 3 4\n5 6 7 8\n9 10 11 12\n"));
    assert!(!has_doubt("1 2 3 4\n5 --- 7 8\n9 10 11 12\n"));
    assert!(!has_doubt("3 1 4 1\n5 9 2 6\n5 3 5 8\n9 7 9 3\n"));
}

#[test]
fn marks_of_thousands_are_read_or_said() {
    let thousands = "commas are read as decimal marks, not as marks of thousands";
    assert_eq!(read("\"1,250\",\"2,500\"\n\"3,000\",\"1,000\"\n").warnings[0], thousands);
    assert!(!read("\"0,250\",\"2,500\"\n\"3,000\",\"1,000\"\n").warnings.iter().any(|w| w == thousands));
    assert_eq!(read("1'250.5;2'250.5\n3'000.0;1'000.0\n").heights, [1250.5, 2250.5, 3000.0, 1000.0]);
    assert_eq!(
        read("1\u{a0}250,5;2\u{202f}250,5\n3\u{a0}000,0;1\u{a0}000,0\n").heights[..2],
        [1250.5, 2250.5]
    );
    assert_eq!(read("100\u{a0}200\n300\u{a0}400\n").heights, [100.0, 200.0, 300.0, 400.0]);
    let nan = "ncols 2\nnrows 2\nNODATA_value nan\nunit: um\n1 nan\n3 4\n";
    assert_eq!((read(nan).undefined(), read(nan).warnings.len()), (1, 0));
}

#[test]
fn a_file_of_one_surface_has_no_second_one() {
    for content in ["# unit: nm\n1 2\n3 5\n", "x (um),z (nm)\n0,1\n1,2\n2,1\n"] {
        for channel in [0, 2] {
            let options = Options::new().with_channel(channel);
            let error = options.read_bytes(content.as_bytes(), "a.csv").unwrap_err();
            assert_eq!(error.to_string(), "a.csv: one surface alone; its number is channel = 1");
        }
        assert!(Options::new().with_channel(1).read_bytes(content.as_bytes(), "a.csv").is_ok());
    }
    refused("name: a\nlist:\n  - 1\n  - 2\n  - 3\n", "two columns, the first of which holds no number");
    refused("5\n", "a single height is no surface");
}

#[test]
fn content_that_holds_no_heights_is_not_called_a_format() {
    for (bytes, expected) in [
        (&b"\x89PNG\r\n\x1a\n\0"[..], "PNG picture holds no heights"),
        (b"\xff\xd8\xff\xe0", "JPEG picture holds no heights"),
        (b"\x1f\x8b\x08\0", "gzip archive; unpack it"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0W\0o\0r\0k\0b\0o\0o\0k\0", "Excel workbook"),
    ] {
        let error = read_bytes(bytes, "a.bin").unwrap_err();
        assert!(
            matches!(&error, Error::Unsupported { .. }) && error.to_string().contains(expected),
            "{error}"
        );
    }
    let workbook = archive(&[("[Content_Types].xml", b""), ("xl/workbook.xml", b"<sheet name=\"Sheet1\"/>")]);
    let error = read_bytes(&workbook, "a.xlsx").unwrap_err();
    assert!(matches!(error, Error::Unsupported { .. }), "{error}");
    let mut igor = vec![0; 400];
    igor[..4].copy_from_slice(&[5, 0, 0xfb, 0xff]);
    let utf_16: Vec<u8> = "fileformat = bcrf_unicode".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, expected) in [
        (&igor[..], "Igor ibw"),
        (b"\x02\0\0\0\x01\0\0\0\0\0\0\0", "Nanofocus nms"),
        (&utf_16, "Image Metrology bcr"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0\0", "Digital Surf mnt"),
    ] {
        let Err(Error::Foreign { format, .. }) = read_bytes(bytes, "a.bin") else { panic!("{expected}") };
        assert_eq!(format, expected);
    }
}

#[test]
fn meshes_of_triangles_are_refused() {
    let points = "v 0 0 1\nv 1 0 2\nv 0 1 3\nv 1 1 4\n";
    for content in [format!("{points}f 1 2 3\n"), format!("# made by hand\nmtllib a.mtl\n{points}")] {
        refused(&content, "a mesh of triangles");
    }
    let ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nend_header\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n";
    refused(ply, "write x, y and heights of its points as columns");
}

#[test]
fn matrix_behind_the_heights_marks_undefined_points_of_spip() {
    let head = "# File Format = ASCII\n# x-pixels = 3\n# y-pixels = 2\n# x-length = 30\n# y-length = 20\n# voidpixels = 2\n\
                # z-unit = nm\n# Start of Data:\n1\t2\t3\n4\t5\t6\n";
    let surface = read(&format!("{head}1\t0\t1\n1\t1\t0\n"));
    let found: Vec<Option<f64>> =
        surface.heights.iter().map(|z| (!z.is_nan()).then(|| (z * 1e9).round())).collect();
    assert_eq!(found, [Some(1.0), None, Some(3.0), Some(4.0), Some(5.0), None]);
    assert!(surface.warnings.is_empty(), "{:?}", surface.warnings);
    refused(&format!("{head}1\t0\t1\n1\t1\t7\n"), "7 in the matrix of voidpixels");
    let without = read(head);
    assert!(without.warnings.iter().any(|doubt| doubt.contains("voidpixels")), "{:?}", without.warnings);
}

#[test]
fn profile_of_spip_has_the_units_of_its_axes() {
    let line = |k: usize| format!("{}\t{}\n", 100 * k, k % 3);
    let head = "# File Format = ASCII\n# points = 30\n# X-Axis: nm; Y-Axis: nm\n# Start of Data:\n";
    let surface = read(&(head.to_owned() + &(0..30).map(line).collect::<String>()));
    assert_eq!((surface.nx, surface.ny, surface.unit), (30, 1, Some(LengthUnit::Nanometre)));
    assert!((surface.spacing.unwrap()[0] * 1e9 - 100.0).abs() < 1e-9);
    assert_eq!(nanometres(&surface)[..4], [0, 1, 2, 0]);
}

#[test]
fn unit_in_words_or_in_german_is_that_of_the_heights() {
    for head in ["# heights in nm", "Werteinheiten: nm", "# Werteinheit: nm"] {
        let surface = read(&format!("{head}\n1 2 3 4\n5 6 7 8\n"));
        assert_eq!(
            (nanometres(&surface)[7], surface.warnings.len()),
            (8, 0),
            "{head}: {:?}",
            surface.warnings
        );
    }
}

#[test]
fn parts_of_an_inch_are_units() {
    let surface = read("x (mil),z (uin)\n0,1\n2,3\n4,2\n6,1\n");
    assert_eq!(surface.unit, Some(LengthUnit::Microinch));
    assert!(
        (surface.spacing.unwrap()[0] - 50.8e-6).abs() < 1e-15 && (surface.heights[1] - 76.2e-9).abs() < 1e-18
    );
}

#[test]
fn size_along_one_axis_names_the_line_that_gives_the_other() {
    refused("unit: um\ndx: 0.5 um\n1 2 3 4\n5 6 7 8\n", "a line \"dy = 0.5 um\" gives the other");
    refused("unit: um\nheight: 5 um\n1 2 3 4\n5 6 7 8\n", "a line \"dx = 0.5 um\" gives the other");
}

#[test]
fn known_exports_have_no_unknown_keys() {
    let keyence = "\"Measurement Data\",\"VK-X3000\"\n\"Model name\",\"VK-X3100\"\n\"Measurement data type\",\"Surface data\"\n\
                   \"XY Calibration\",\"138.450\",\"nm\"\n\"Unit\",\"um\"\n\n\"Height\"\n\"1.5\",\"2.5\",\"3.5\",\"4.5\"\n\"5.5\",\"6.5\",\"7.5\",\"9.5\"\n";
    let spip = "# File Format = ASCII\n# Created by SPIP 6.7 2024\n# Original file: x.spm\n# x-pixels = 4\n# y-pixels = 1\n\
                # x-length = 4\n# y-length = 1\n# x-offset = 0\n# y-offset = 0\n# scanspeed = 1\n# forward = 1\n# z-unit = nm\n\
                # Start of Data:\n1\t2\t4\t3\n";
    for content in [keyence, spip] {
        let surface = read(content);
        assert!(surface.warnings.is_empty() && surface.spacing.is_some(), "{:?}", surface.warnings);
    }
}
