//! Binary files whose content is changed at a place: markers, profiles, several surfaces, damage.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use common::{archive, data};
use surface_formats::{Error, LengthUnit, Options, read, read_bytes};

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
    assert_eq!(expected.unit, Some(LengthUnit::Micrometre));
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
        (sur(&[(120, &nan)]), "dx = NaN m"),
        (sur(&[(124, &[0; 4])]), "dy = 0 m"),
        (sur(&[(128, &infinite)]), "height (0, 0)"),
        (sur(&[(212, b"volt")]), "height: \"volt\""),
        (patched("compressed.sur", &[(512, &[0; 4])]), "0 compressed streams"),
        (patched("compressed.sur", &[(524, &[0xff; 8])]), "compressed stream 0"),
        (patched("compressed.sur", &[(516 + 4, &[10, 0, 0, 0])]), "compressed stream 0: "),
        (patched("compressed.sur", &[(108, &[23]), (116, &[0x9e, 0x01])]), "more than 1656 bytes"),
        (replaced("ascii.sdf", "NumPoints = 7", "NumPoints = 8"), "28 heights, the header says 8 x 4"),
        (replaced("ascii.sdf", "NumPoints = 7", "NumPoints = 6"), "more than the 6 x 4 heights"),
        (replaced("ascii.sdf", "NumPoints", "Num_oints"), "the header lacks NumPoints"),
        (replaced("ascii.sdf", "0.98865", "0.9x865"), "height (3, 0) = 0.9x865 is not a number"),
        (replaced("ascii.sdf", "DataType = 7", "DataType = 9"), "DataType = 9"),
        (replaced("ascii.sdf", "Compression = 0", "Compression = 1"), "Compression = 1"),
        (replaced("ascii.sdf", "Zscale = 1.0E-6", "Zscale = 1.0E+x"), "Zscale = 1.0E+x"),
        (b"aISO-1.0 nothing".to_vec(), "not closed by *"),
        (patched("binary.sdf", &[])[..1000].to_vec(), "the data of 24 x 18 points"),
        (patched("binary.sdf", &[(42, &[0; 2])]), "at least 1"),
        (patched("binary.sdf", &[(46 + 16, &f64::NAN.to_le_bytes())]), "Zscale = NaN"),
        (
            patched("binary.sdf", &[(46 + 16, &0.0_f64.to_le_bytes())]),
            "Zscale = 0: it must be finite and not zero",
        ),
        (replaced("ascii.sdf", "Zscale = 1.0E-6", "Zscale = 0.0E-6"), "Zscale = 0"),
        (patched("cut.al3d", &[])[..1000].to_vec(), "tag"),
        (patched("cut.al3d", &[])[..2000].to_vec(), "the depth image of 23 x 18 points"),
        (replaced("cut.al3d", "Cols\0", "Colx\0"), "tag Cols is missing"),
        (replaced("cut.al3d", "4.38027e-07", "4,38027e-07"), "4,38027e-07 is not a number"),
        (patched("cut.plu", &[])[..1500].to_vec(), "the data of 24 x 18 points needs 1728 bytes"),
        (patched("cut.plu", &[(428, &[1])]), "type 1 instead of 3"),
        (patched("cut.plu", &[(489, &[0])]), "no layer"),
        (patched("cut.plu", &[(500, &huge)]), "at most 2^26"),
        (patched("cut.plu", &[(404, &nan)]), "dx = NaN m"),
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
    for at in [14, 18, 86, 98, 290, 334, 336] {
        swapped[at..at + 2].reverse();
    }
    for at in [100, 104, 108, 112, 116, 120, 124, 128, 474] {
        swapped[at..at + 4].reverse();
    }
    let start = plain.len() - 24 * 18 * 4;
    swapped[start..].chunks_exact_mut(4).for_each(<[u8]>::reverse);
    let found = read_bytes(&swapped, "motorola.sur").unwrap();
    let bits = |heights: &[f64]| heights.iter().map(|z| z.to_bits()).collect::<Vec<_>>();
    let expected = read_bytes(&plain, "cut.sur").unwrap();
    assert_eq!((bits(&found.heights), found.spacing), (bits(&expected.heights), expected.spacing));
    assert!(found.undefined() > 0);
}

#[test]
fn values_that_are_not_finite_are_undefined_in_every_format() {
    let undefined = |name: &str, bytes: Vec<u8>| {
        let plain = read(data(name)).unwrap();
        let found = read_bytes(&bytes, name).unwrap();
        assert_eq!(found.undefined(), plain.undefined() + 1, "{name}");
    };
    for value in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 3e15] {
        undefined("cut.al3d", patched("cut.al3d", &[(1261 + 4, &value.to_le_bytes())]));
    }
    for value in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        undefined("cut.plu", patched("cut.plu", &[(508 + 8, &value.to_le_bytes())]));
    }
    undefined("ascii.sdf", replaced("ascii.sdf", "0.98865", "    NaN"));
    undefined("ascii.sdf", replaced("ascii.sdf", "0.98865", "    BAD"));
    undefined("binary.sdf", patched("binary.sdf", &[(81, &f64::NAN.to_le_bytes())]));
}

/// A description of `nx` x `ny` heights as 32 bit floats, a micrometre apart, in `layers`.
fn x3p_description(nx: usize, ny: usize, layers: usize) -> String {
    let axis = |name: &str| format!("<{name}><AxisType>I</AxisType><Increment>1e-6</Increment></{name}>");
    format!(
        "<r><Record1><FeatureType>SUR</FeatureType><Axes>{}{}<CZ><AxisType>A</AxisType><DataType>F</DataType></CZ>\
         </Axes></Record1><Record3><MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>{layers}</SizeZ>\
         </MatrixDimension><DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></r>",
        axis("CX"),
        axis("CY")
    )
}

/// `values` as 32 bit floats.
fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

#[test]
fn x3p_archives_zipped_with_their_folder_read() {
    let (xml, points) =
        (x3p_description(3, 2, 1), floats(&[1e-6, 2e-6, f32::INFINITY, 4e-6, f32::NAN, 6e-6]));
    let parts = |folder: &str| {
        let names = ["main.xml", "bindata/data.bin"].map(|name| format!("{folder}{name}"));
        archive(&[(&names[0], xml.as_bytes()), (&names[1], &points)])
    };
    let plain = read_bytes(&parts(""), "a.x3p").unwrap();
    assert_eq!((plain.nx, plain.ny, plain.undefined()), (3, 2, 2));
    assert_eq!(plain.spacing, Some([1e-6, 1e-6]));
    let nested = read_bytes(&parts("scan/"), "a.x3p").unwrap();
    assert_eq!((nested.heights[5], nested.undefined()), (plain.heights[5], 2));
}

#[test]
fn increments_of_absolute_heights_and_unknown_keys_are_said() {
    let xml = x3p_description(3, 2, 1)
        .replace("<DataType>F", "<DataType>F</DataType><Increment>1e-6</Increment><X>F");
    let xml = xml.replace("<X>F</DataType>", "");
    let points = floats(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let file = archive(&[("main.xml", xml.as_bytes()), ("bindata/data.bin", &points)]);
    let surface = read_bytes(&file, "a.x3p").unwrap();
    assert!(
        surface.warnings[0].contains("no increment is foreseen; they are multiplied"),
        "{:?}",
        surface.warnings
    );
    assert!((surface.heights[5] / 6e-6 - 1.0).abs() < 1e-15);
    let text = std::fs::read_to_string(data("ascii.sdf")).unwrap();
    assert!(read_bytes(text.as_bytes(), "a.sdf").unwrap().warnings.is_empty());
    let more = read_bytes(text.replacen("NumPoints", "Gain = 2\nNumPoints", 1).as_bytes(), "a.sdf").unwrap();
    assert_eq!(more.warnings, ["keys of the header are not understood: \"Gain\""]);
}

#[test]
fn x3p_archives_of_several_surfaces_are_read_by_number() {
    let (xml, first, second) = (x3p_description(2, 1, 1), floats(&[1.0, 2.0]), floats(&[3.0, 4.0]));
    let file = archive(&[
        ("a/main.xml", xml.as_bytes()),
        ("a/bindata/data.bin", &first),
        ("b/main.xml", xml.as_bytes()),
        ("b/bindata/data.bin", &second),
    ]);
    let Err(Error::Several { names, .. }) = read_bytes(&file, "a.x3p") else { panic!("two surfaces") };
    assert_eq!(names, ["a/", "b/"]);
    assert_eq!(Options::new().with_channel(2).read_bytes(&file, "a.x3p").unwrap().heights, [3.0, 4.0]);
    let layers = x3p_description(2, 1, 2);
    let file =
        archive(&[("main.xml", layers.as_bytes()), ("bindata/data.bin", &floats(&[1.0, 2.0, 3.0, 4.0]))]);
    let error = read_bytes(&file, "a.x3p").unwrap_err().to_string();
    assert!(error.contains("2 surfaces (1 \"layer 1\", 2 \"layer 2\")"), "{error}");
    assert_eq!(Options::new().with_channel(2).read_bytes(&file, "a.x3p").unwrap().heights, [3.0, 4.0]);
}

#[test]
fn digital_surf_files_of_several_objects_are_read_by_number() {
    for name in ["cut.sur", "compressed.sur"] {
        let one = read(data(name)).unwrap();
        let mut first = patched(name, &[(14, &[2]), (20, b"first\0")]);
        first.extend(patched(name, &[(20, b"second\0"), (128, &(2e-4_f32).to_le_bytes())]));
        let error = read_bytes(&first, "a.sur").unwrap_err().to_string();
        assert!(error.contains("1 \"first\", 2 \"second\""), "{error}");
        let chosen = |number| Options::new().with_channel(number).read_bytes(&first, "a.sur").unwrap();
        let (a, b) = (chosen(1), chosen(2));
        assert_eq!(
            (a.heights[0].to_bits(), a.undefined()),
            (one.heights[0].to_bits(), one.undefined()),
            "{name}"
        );
        assert!((b.heights[0] - a.heights[0]).abs() > 0.0, "{name}");
    }
}

#[test]
fn profiles_need_no_distance_across() {
    let text = |magic: &str| {
        format!(
            "{magic}\nNumPoints = 4\nNumProfiles = 1\nXscale = 2.5E-07\nYscale = 0\nZscale = 1E-06\nDataType = 7\n*\n-0.2\n0.2\n-0.2\n0.2\n*\n"
        )
    };
    for magic in ["aBCR-1.0", "aNPL-V1.0", "aISO-1.0"] {
        let profile = read_bytes(text(magic).as_bytes(), "a.sdf").unwrap();
        assert_eq!((profile.nx, profile.ny, profile.spacing), (4, 1, Some([2.5e-7; 2])), "{magic}");
        assert_eq!((profile.unit, profile.heights[1]), (Some(LengthUnit::Micrometre), 0.2e-6), "{magic}");
    }
    let points = 24_u32 * 18;
    // one row of a plain file without the unit across
    let row = patched(
        "cut.sur",
        &[(108, &points.to_le_bytes()), (112, &[1, 0, 0, 0]), (196, &[0; 16]), (244, &[0; 16])],
    );
    let profile = read_bytes(&row, "a.pro").unwrap();
    assert_eq!((profile.nx, profile.ny), (points as usize, 1));
    assert_eq!(profile.spacing.map(|[dx, dy]| dx.to_bits() == dy.to_bits()), Some(true));
    let map = patched("cut.sur", &[(196, &[0; 16]), (244, &[0; 16])]);
    assert!(read_bytes(&map, "a.sur").unwrap_err().to_string().contains("y: \"\" is no unit of length"));
}

#[test]
fn profiles_of_the_smd_format_read() {
    let text = |axis: &str, heights: &str| {
        format!(
            "1 2\r\nSG 0.0e+000 PRF\r\nCX {axis}\r\nCZ M 4.0e+000 UM 1.0e-001 L\r\nEOR\r\nEOR\r\n{heights}\r\nEOR\r\n"
        )
    };
    let profile =
        read_bytes(text("I 4.0e+000 MM 2.5e-004 D", "-2\r\n2\r\n-2\r\n2").as_bytes(), "a.prf").unwrap();
    assert_eq!((profile.nx, profile.ny, profile.spacing), (4, 1, Some([2.5e-7; 2])));
    assert_eq!(profile.unit, Some(LengthUnit::Micrometre));
    assert!(profile.heights.iter().all(|z| (z.abs() - 0.2e-6).abs() < 1e-21));
    for (axis, heights, expected) in [
        ("I 4.0e+000 MM 2.5e-004 D", "-2\n2", "2 heights, the axes say 4 x 1"),
        ("I 4.0e+000 MM 2.5e-004 D", "-2\n2\n1\nx", "line 10: \"x\" is not a number"),
        ("A 4.0e+000 MM 2.5e-004 D", "1\n2\n3\n4", "not of type I"),
        ("I 4.0e+000 V 2.5e-004 D", "1\n2\n3\n4", "CX: \"v\" is no unit of length"),
        ("I 4.0e+000 MM 0 D", "1\n2\n3\n4", "dx = 0 m"),
    ] {
        let error = read_bytes(text(axis, heights).as_bytes(), "a.prf").unwrap_err().to_string();
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn layers_of_a_sensofar_file_are_read_by_number() {
    let mut file = patched("cut.plu", &[(489, &[2])]);
    let layer = file[500..500 + 8 + 24 * 18 * 4].to_vec();
    file.truncate(500 + layer.len());
    file.extend(&layer);
    let at = 500 + layer.len() + 8;
    file[at..at + 4].copy_from_slice(&7f32.to_le_bytes());
    let error = read_bytes(&file, "a.plu").unwrap_err().to_string();
    assert!(error.contains("1 \"layer 1\", 2 \"layer 2\""), "{error}");
    let second = Options::new().with_channel(2).read_bytes(&file, "a.plu").unwrap();
    assert!((second.heights[0] - 7e-6).abs() < 1e-12);
}

#[test]
fn digital_surf_heights_may_be_upside_down() {
    let plain = read(data("cut.sur")).unwrap();
    for (inversion, source) in [(1_u8, [0, 1, 24]), (2, [23, 22, 47]), (3, [17 * 24, 17 * 24 + 1, 16 * 24])] {
        let turned = read_bytes(&patched("cut.sur", &[(290, &[inversion])]), "turned.sur").unwrap();
        assert_eq!(turned.undefined(), plain.undefined());
        for (k, from) in [0, 1, 24].into_iter().zip(source) {
            let (a, b) = (turned.heights[k], -plain.heights[from]);
            assert!((a - b).abs() <= 1e-15 * b.abs(), "{a}, expected {b}");
        }
    }
}

/// A file of ISO 5436-2 whose records end with ETX, with fields between `blank`.
fn smd(x: &str, y: &str, heights: &str, blank: &str) -> Vec<u8> {
    let text = format!(
        "ISO 5436-2 - 2000\r\nprofile 1\r\nPRF 1 p\r\n{x}\r\n{y}CZ A 4 um 2.0E+000 D\r\n\x03\r\nDATE 1\r\n\x03\r\n{heights}\r\n\x03\r\n4711\r\n\x03\r\n"
    );
    text.replace(' ', blank).into_bytes()
}

#[test]
fn records_that_end_with_a_control_character_read() {
    let x = "CX I 4 mm 1.0E+000 D 5.0E-004";
    for blank in [" ", "\0"] {
        let profile = read_bytes(&smd(x, "", "-1.5\r\n0.5\r\n1\r\n2", blank), "a.smd").unwrap();
        assert_eq!((profile.nx, profile.ny, profile.unit), (4, 1, Some(LengthUnit::Micrometre)));
        assert!((profile.spacing.unwrap()[0] - 0.5e-6).abs() < 1e-20, "factor times increment, in mm");
        let nanometres: Vec<i64> = profile.heights.iter().map(|z| (z * 1e9).round() as i64).collect();
        assert_eq!(nanometres, [-3000, 1000, 2000, 4000]);
    }
    let short = read_bytes(&smd("CX I 3 mm 1.0 D 1.0", "", "1\r\n2\r\n3", " "), "a.smd").unwrap();
    assert_eq!(short.warnings, ["the axis CZ counts 4 heights, the file holds 3"]);
    let map = smd("CX I 2 mm 1.0 D 5.0E-004", "CY I 2 um 2.0 D 3.0\r\n", "1\r\n2\r\n3\r\n4", " ");
    let map = read_bytes(&map, "a.smd").unwrap();
    assert_eq!((map.nx, map.ny), (2, 2));
    assert!((map.spacing.unwrap()[1] - 6e-6).abs() < 1e-18);
    for (x, heights, expected) in [
        (x, "1\r\n2\r\n3", "3 heights, the axes say 4 x 1"),
        (x, "1\r\n2\r\nx\r\n4", "line 11: \"x\" is not a number"),
        ("CX A 4 mm 1.0 D", "1\r\n2\r\n3\r\n4", "axis CX is not of type I"),
        ("CX I 4 mm 1.0 D -1", "1\r\n2\r\n3\r\n4", "dx = -0.001 m"),
    ] {
        let error = read_bytes(&smd(x, "", heights, " "), "a.smd").unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}
