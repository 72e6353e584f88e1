//! Text files of layouts that programs write: points, sizes, units, undefined points, Sa and Sq.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use common::check;
use surface_formats::{LengthUnit, Options, read_bytes};

/// Rows 1 2 3 4, 5 6 7 8 and 9 10 11 12: Sa 3, Sq the root of 143/12.
const WHOLE: (usize, f64, f64) = (0, 3.0, 3.452_052_529_534_663);
/// The same without 6.
const GAP: (usize, f64, f64) = (1, 39.0 / 12.1, 3.602_111_410_210_718_6);
/// Heights 1 and 2 by turns.
const STEPS: (usize, f64, f64) = (0, 0.5, 0.5);

/// Three rows of four heights with `separator` between them, the sixth of which is `sixth`.
fn rows(separator: &str, sixth: &str) -> String {
    let row = |first: usize| {
        let fields = (first..first + 4).map(|n| if n == 6 { sixth.to_owned() } else { n.to_string() });
        fields.collect::<Vec<_>>().join(separator) + "\n"
    };
    row(1) + &row(5) + &row(9)
}

/// Lines of x, y and height of the same points, x in steps of `dx`, y of `dy`.
fn points(separator: &str, dx: f64, dy: f64) -> Vec<String> {
    let line =
        |k: usize| format!("{}{separator}{}{separator}{}", dx * (k % 4) as f64, dy * (k / 4) as f64, k + 1);
    (0..12).map(line).collect()
}

struct Case {
    name: &'static str,
    content: String,
    points: [usize; 2],
    size: Option<[f64; 2]>,
    unit: Option<LengthUnit>,
    /// Undefined points, Sa and Sq in the unit.
    heights: (usize, f64, f64),
    /// Beginning of each warning.
    warnings: &'static [&'static str],
}

const NO_UNIT: &str = "the unit of the heights is not known";
const NO_LATERAL_UNIT: &str = "the unit of the lengths along x and y is not known";
const MAP: Option<[f64; 2]> = Some([2e-6, 1.5e-6]);

fn run(cases: Vec<Case>) {
    for case in cases {
        let Case { name, content, points, size, unit, heights: (undefined, sa, sq), warnings } = case;
        let surface = read_bytes(content.as_bytes(), name).unwrap();
        let metres = unit.map_or(1.0, LengthUnit::metres);
        check(name, &surface, points, size, unit, undefined, sa * metres, sq * metres);
        assert_eq!(surface.warnings.len(), warnings.len(), "{name}: {:?}", surface.warnings);
        for (found, expected) in surface.warnings.iter().zip(warnings) {
            assert!(found.starts_with(expected), "{name}: {found}");
        }
        // other ends of lines
        for end in ["\r\n", "\r"] {
            let other = read_bytes(content.replace('\n', end).as_bytes(), name).unwrap();
            assert_eq!(other.heights.len(), surface.heights.len(), "{name} with {end:?}");
            assert_eq!(other.undefined(), surface.undefined(), "{name} with {end:?}");
        }
    }
}

use LengthUnit::{Angstrom, Micrometre, Nanometre};

#[test]
fn columns_become_maps_whatever_the_order_of_rows() {
    let mut turned = points(",", 0.5, 0.5);
    turned.sort_by_key(|line| line.split(',').next().unwrap().to_owned());
    let mut gap = points("\t", 0.5, 0.5);
    gap.remove(5);
    gap.reverse();
    let map = [4, 3];
    run(vec![
        Case {
            name: "titles",
            content: format!("x (um),y (um),z (um)\n{}\n", points(",", 0.5, 0.5).join("\n")),
            points: map,
            size: MAP,
            unit: Some(Micrometre),
            heights: WHOLE,
            warnings: &[],
        },
        Case {
            name: "y fastest",
            content: format!("X [um],Y [um],Z [nm]\n{}\n", turned.join("\n")),
            points: map,
            size: MAP,
            unit: Some(Nanometre),
            heights: WHOLE,
            warnings: &[],
        },
        Case {
            name: "gap, units below titles",
            content: format!("x\ty\tz\num\tum\tnm\n{}\n", gap.join("\n")),
            points: map,
            size: MAP,
            unit: Some(Nanometre),
            heights: GAP,
            warnings: &[],
        },
        Case {
            name: "comment",
            content: format!("# x[um] y[um] z[nm]\n{}\n", points(" ", 0.5, 0.5).join("\n")),
            points: map,
            size: MAP,
            unit: Some(Nanometre),
            heights: WHOLE,
            warnings: &[],
        },
        Case {
            name: "index",
            content: format!(
                "No.;x (um);y (um);z (um)\n{}\n",
                points(";", 0.5, 0.5)
                    .iter()
                    .enumerate()
                    .map(|(k, line)| format!("{k};{line}"))
                    .collect::<Vec<_>>()
                    .join("\n")
            ),
            points: map,
            size: MAP,
            unit: Some(Micrometre),
            heights: WHOLE,
            warnings: &[],
        },
        Case {
            name: "no titles",
            content: points(" ", 0.5, 0.5).join("\n"),
            points: map,
            size: Some([2.0, 1.5]),
            unit: None,
            heights: WHOLE,
            warnings: &["three columns", NO_UNIT, NO_LATERAL_UNIT],
        },
        Case {
            name: "units in the header",
            content: format!("Lateral units: um\nValue units: nm\n{}\n", points(" ", 0.5, 0.5).join("\n")),
            points: map,
            size: MAP,
            unit: Some(Nanometre),
            heights: WHOLE,
            warnings: &["three columns"],
        },
        Case {
            name: "decimal commas",
            content: format!(
                "X [um];Y [um];Z [nm]\n{}\n",
                points(";", 0.5, 0.5).join("\n").replace('.', ",")
            ),
            points: map,
            size: MAP,
            unit: Some(Nanometre),
            heights: WHOLE,
            warnings: &[],
        },
        // thirds of a micrometre with two digits
        Case {
            name: "rounded positions",
            content: format!(
                "x (um),y (um),z (um)\n{}\n",
                (0..12)
                    .map(|k| format!("{:.2},{:.2},{}", f64::from(k % 4) / 3.0, f64::from(k / 4) / 3.0, k + 1))
                    .collect::<Vec<_>>()
                    .join("\n")
            ),
            points: map,
            size: Some([4.0 / 3e6, 1.005e-6]),
            unit: Some(Micrometre),
            heights: WHOLE,
            warnings: &[],
        },
    ]);
}

#[test]
fn two_columns_become_profiles() {
    let profile = |separator: &str, dx: f64| {
        (0..8).map(|k| format!("{:.4}{separator}{}\n", dx * f64::from(k), k % 2 + 1)).collect::<String>()
    };
    let size = Some([8e-6, 1e-6]);
    run(vec![
        Case {
            name: "titles",
            content: format!("Distance (mm)\tHeight (um)\n{}", profile("\t", 1e-3)),
            points: [8, 1],
            size,
            unit: Some(Micrometre),
            heights: STEPS,
            warnings: &[],
        },
        Case {
            name: "two rows of titles",
            content: format!("x,z\num,nm\n{}", profile(",", 1.0)),
            points: [8, 1],
            size,
            unit: Some(Nanometre),
            heights: STEPS,
            warnings: &[],
        },
        Case {
            name: "Dektak",
            content: format!(
                "Scan Parameters\nStylus,Radius: 12.5 um\nScan Data\n\nLateral um,Raw Angstrom,\n{}",
                profile(",", 1.0).replace('\n', ",\n")
            ),
            points: [8, 1],
            size,
            unit: Some(Angstrom),
            heights: STEPS,
            warnings: &["keys of the header are not understood: \"Stylus\""],
        },
        Case {
            name: "valid",
            content: format!("X;Y;valid\n[mm];[um];[1/0]\n{}", profile(";", 1e-3).replace('\n', ";1\n")),
            points: [8, 1],
            size,
            unit: Some(Micrometre),
            heights: STEPS,
            warnings: &[],
        },
        Case {
            name: "no titles",
            content: profile(" ", 1.0),
            points: [8, 1],
            size: Some([8.0, 1.0]),
            unit: None,
            heights: STEPS,
            warnings: &["two columns", NO_UNIT, NO_LATERAL_UNIT],
        },
        Case {
            name: "heights alone",
            content: "# unit: nm\n1\n2\n1\n2\n".to_owned(),
            points: [4, 1],
            size: None,
            unit: Some(Nanometre),
            heights: STEPS,
            warnings: &[],
        },
    ]);
}

#[test]
fn labels_indices_and_coordinates_are_no_heights() {
    let matrix = rows(",", "6");
    let prefixed = |labels: [&str; 3]| {
        matrix.lines().zip(labels).map(|(line, label)| format!("{label},{line}\n")).collect::<String>()
    };
    run(vec![
        Case {
            name: "row labels",
            content: format!("# unit: nm\n{}", prefixed(["a", "b", "c"])),
            points: [4, 3],
            size: None,
            unit: Some(Nanometre),
            heights: WHOLE,
            warnings: &[],
        },
        Case {
            name: "corner with a unit",
            content: format!("um,0.0,0.5,1.0,1.5\n{}", prefixed(["0.0", "0.5", "1.0"])),
            points: [4, 3],
            size: MAP,
            unit: None,
            heights: WHOLE,
            warnings: &[NO_UNIT],
        },
        Case {
            name: "empty corner",
            content: format!("# unit: um\n,0.0,0.5,1.0,1.5\n{}", prefixed(["0.0", "0.5", "1.0"])),
            points: [4, 3],
            size: MAP,
            unit: Some(Micrometre),
            heights: WHOLE,
            warnings: &["the first row and the first column"],
        },
        Case {
            name: "no corner",
            content: format!("# unit: um\n0.0,0.5,1.0,1.5\n{}", prefixed(["0.0", "0.5", "1.0"])),
            points: [4, 3],
            size: MAP,
            unit: Some(Micrometre),
            heights: WHOLE,
            warnings: &[],
        },
        Case {
            name: "table of pandas",
            content: format!("# unit: nm\n,0,1,2,3\n{}", prefixed(["0", "1", "2"])),
            points: [4, 3],
            size: Some([4e-9, 3e-9]),
            unit: Some(Nanometre),
            heights: WHOLE,
            warnings: &["the first row and the first column"],
        },
        Case {
            name: "index column",
            content: "1 1.5 2.5\n2 1.5 2.5\n3 1.5 2.5\n4 1.5 2.5\n".to_owned(),
            points: [4, 4],
            size: None,
            unit: None,
            heights: (0, 0.0, 0.0),
            warnings: &[],
        }
        .into_matrix(),
        Case {
            name: "an undefined first point is none",
            content: format!("# unit: nm\n{}", rows(",", "6").replacen('1', "", 1)),
            points: [4, 3],
            size: None,
            unit: Some(Nanometre),
            heights: (1, 30.0 / 11.0, 10f64.sqrt()),
            warnings: &[],
        },
    ]);
}

impl Case {
    /// Four columns, of which the first counts.
    fn into_matrix(self) -> Self {
        let content = "0 1.5 2.5 1.5\n1 2.5 1.5 2.5\n2 1.5 2.5 1.5\n3 2.5 1.5 2.5\n".to_owned();
        let warnings = &["the first column counts the rows", NO_UNIT];
        Self { content, points: [3, 4], heights: (0, 0.5, 0.5), warnings, ..self }
    }
}

#[test]
fn headers_of_several_programs_give_sizes_and_units() {
    let gwyddion = |keys: [&str; 4]| {
        format!(
            "# {} Z\n# {} 2.0 \u{b5}m\n# {} 1.5 \u{3bc}m\n# {} nm\n{}",
            keys[0],
            keys[1],
            keys[2],
            keys[3],
            rows("\t", "6")
        )
    };
    let tabs = rows("\t", "6");
    let case = |name, content, unit, heights| Case {
        name,
        content,
        points: [4, 3],
        size: MAP,
        unit: Some(unit),
        heights,
        warnings: &[],
    };
    run(vec![
        case("Gwyddion", gwyddion(["Channel:", "Width:", "Height:", "Value units:"]), Nanometre, WHOLE),
        case(
            "Gwyddion, French",
            gwyddion(["Canal :", "Largeur :", "Hauteur :", "Unit\u{e9}s :"]),
            Nanometre,
            WHOLE,
        ),
        case(
            "Gwyddion, Russian",
            gwyddion([
                "\u{41a}\u{430}\u{43d}\u{430}\u{43b}:",
                "\u{428}\u{438}\u{440}\u{438}\u{43d}\u{430}:",
                "\u{412}\u{44b}\u{441}\u{43e}\u{442}\u{430}:",
                "\u{415}\u{434}\u{438}\u{43d}\u{438}\u{446}\u{44b} \u{438}\u{437}\u{43c}\u{435}\u{440}\u{435}\u{43d}\u{438}\u{44f}:",
            ]),
            Nanometre,
            WHOLE,
        ),
        case(
            "Gwyddion, Japanese",
            gwyddion([
                "\u{30c1}\u{30e3}\u{30cd}\u{30eb}\u{ff1a}",
                "\u{5e45}:",
                "\u{9ad8}\u{3055}\u{ff1a}",
                "\u{5024}\u{306e}\u{5358}\u{4f4d}:",
            ]),
            Nanometre,
            WHOLE,
        ),
        Case {
            warnings: &["keys of the header are not understood: \"Breedte\", \"Hoogte\""],
            size: None,
            ..case(
                "unknown language",
                gwyddion(["Channel:", "Breedte:", "Hoogte:", "Value units:"]),
                Nanometre,
                WHOLE,
            )
        },
        case(
            "SPIP",
            format!(
                "# File Format = ASCII\n# x-pixels = 4\n# y-pixels = 3\n# x-length = 2000\n# y-length = 1500\n# z-unit = um\n# Start of Data:\n{tabs}"
            ),
            Micrometre,
            WHOLE,
        ),
        case(
            "SPIP with Bit2nm",
            format!(
                "# File Format = ASCII\n# x-pixels = 4\n# y-pixels = 3\n# x-length = 2000\n# y-length = 1500\n# Bit2nm = 2\n{tabs}"
            ),
            Nanometre,
            (0, 6.0, 2.0 * WHOLE.2),
        ),
        case(
            "SPIP with units",
            format!(
                "x-pixels = 4\ny-pixels = 3\nx-length = 2\ny-length = 1.5\nx-unit = um\ny-unit = um\nz-unit = nm\n{tabs}"
            ),
            Nanometre,
            WHOLE,
        ),
        case(
            "Nova",
            format!(
                "File Format = ASCII\nCreated by Nova\nNX = 4\nNY = 3\nScale X = 0.5\nScale Y = 0.5\nScale Data = 2\nDataScaleNeeded = Yes\nUnit X = um\nUnit Data = nm\nStart of Data :\n{tabs}"
            ),
            Nanometre,
            (0, 6.0, 2.0 * WHOLE.2),
        ),
        case(
            "Nova, scaled",
            format!(
                "NX = 4\nNY = 3\nScale X = 0.5\nScale Y = 0.5\nScale Data = 2\nDataScaleNeeded = No\nUnit X = um\nUnit Data = nm\n{tabs}"
            ),
            Nanometre,
            WHOLE,
        ),
        case(
            "Keyence",
            format!(
                "\"Measurement data name\",\"a\"\n\"XY Calibration\",\"500.0\",\"nm\"\n\"Output image data\",\"Height\"\n\"Horizontal\",\"4\"\n\"Vertical\",\"3\"\n\"Unit\",\"um\"\n\"Reference data name\",\"\"\n\n\"Height\"\n{}",
                rows(",", "6")
            ),
            Micrometre,
            WHOLE,
        ),
        case(
            "Nanoscope",
            format!(
                "\\*File list\n\\Samps/line: 4\n\\Lines: 3\n\\Scan Size: 2000 1500 nm\n\\*File list end\nHeight_Sensor(nm)\n{}",
                rows("\n", "6")
            ),
            Nanometre,
            WHOLE,
        ),
        case(
            "two keys a line",
            format!(
                "h=3 w=4\npixel size=5e-7 m\ndata unit=rad\nheight conversion factor (-> m)=1e-9\n{tabs}"
            ),
            Nanometre,
            WHOLE,
        ),
        case(
            "sizes with a space",
            format!("dx [um] = 0.5\ndy (um) = 0.5\nHeights [nm]\n{}", rows(";", "6")),
            Nanometre,
            WHOLE,
        ),
        case(
            "one unit for all",
            format!("# unit: um\n# dx: 0.5\n# dy: 0.5\n{}", rows(" ", "6")),
            Micrometre,
            WHOLE,
        ),
        case(
            "words",
            format!("# Width: 2 micrometers\n# Height: 1.5 microns\n# Value units: nanometers\n{tabs}"),
            Nanometre,
            WHOLE,
        ),
        Case { size: None, ..case("a unit alone", format!("[nm]\n{}", rows(",", "6")), Nanometre, WHOLE) },
        Case {
            size: None,
            ..case("exported image units", format!("\\Exported image units: nm\n{tabs}"), Nanometre, WHOLE)
        },
        Case {
            size: Some([8.0, 6.0]),
            unit: None,
            warnings: &[NO_UNIT, NO_LATERAL_UNIT],
            ..case(
                "ESRI",
                format!(
                    "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 2.0\nNODATA_value -9999\n{}",
                    rows(" ", "-9999")
                ),
                Nanometre,
                GAP,
            )
        },
    ]);
}

#[test]
fn exports_of_wyko_and_zygo_read() {
    let wyko = format!(
        "Wyko ASCII Data File Format 0\t1\t1\nX Size\t3\nY Size\t4\nBlock Name\tType\tLength\tValue\nPixel_size\t7\t4\t0.0005\nWavelength\t7\t4\t600\nMult\t7\t4\t2\nRAW_DATA\t3\t48\t\n{}",
        rows("\t", "Bad")
    );
    let pixels: String = (0..12)
        .map(|k| {
            format!(
                "{} {} {}\n",
                k % 4,
                k / 4,
                if k == 5 { "No Data".to_owned() } else { (k + 1).to_string() }
            )
        })
        .collect();
    let zygo = format!(
        "Zygo XYZ Data File - Format 1\n{}0 0.5 6.3e-7 0 1 1 5e-7 0\n{}#\n{pixels}#\n",
        "0\n".repeat(6),
        "0\n".repeat(6)
    );
    let case = |name, content, unit, heights| Case {
        name,
        content,
        points: [4, 3],
        size: MAP,
        unit: Some(unit),
        heights,
        warnings: &[],
    };
    run(vec![
        case("Wyko", wyko, Nanometre, (1, 300.0 * GAP.1, 300.0 * GAP.2)),
        case("Zygo", zygo, Micrometre, GAP),
    ]);
}

#[test]
fn every_marker_of_undefined_points_is_one() {
    let markers = [
        "BAD",
        "Bad",
        "nan",
        "NaN",
        "-nan(ind)",
        "inf",
        "-inf",
        "1.#QNAN",
        "---",
        "***",
        "NA",
        "N/A",
        "No Data",
        "null",
        "",
    ];
    for marker in markers {
        for separator in [",", ";", "\t"] {
            let surface = read_bytes(rows(separator, marker).as_bytes(), "a.csv").unwrap();
            check(marker, &surface, [4, 3], None, None, GAP.0, GAP.1, GAP.2);
        }
        if !marker.is_empty() {
            let surface = read_bytes(rows(" ", marker).as_bytes(), "a.txt").unwrap();
            check(marker, &surface, [4, 3], None, None, GAP.0, GAP.1, GAP.2);
        }
    }
}

#[test]
fn numbers_are_read_as_people_write_them() {
    let heights = |content: &str| read_bytes(content.as_bytes(), "a.txt").unwrap().heights;
    assert_eq!(heights("0\t1\t2\n0,5\t1,5\t2,5\n"), [0.0, 1.0, 2.0, 0.5, 1.5, 2.5]);
    assert_eq!(heights("1,5 2,5\n3,5 4,5\n"), [1.5, 2.5, 3.5, 4.5]);
    assert_eq!(
        heights("\"1,250.5\";\"750.25\"\n\"1,500.0\";\"2,500.0\"\n"),
        [1250.5, 750.25, 1500.0, 2500.0]
    );
    assert_eq!(heights("1.250,5;750,25\n1.500,0;2.500,0\n"), [1250.5, 750.25, 1500.0, 2500.0]);
    assert_eq!(heights("\"1,5\",\"2,5\"\n\"3,5\",\"4,5\"\n"), [1.5, 2.5, 3.5, 4.5]);
    assert_eq!(heights("1.0D-6 2.0d-6\n3.0D-6 4.0D-6\n"), [1e-6, 2e-6, 3e-6, 4e-6]);
    assert_eq!(heights("+1.0 -2.0\n+3.0 +4.0\n"), [1.0, -2.0, 3.0, 4.0]);
    let column = read_bytes(b"1,25\n0,75\n1,50\n", "a.txt").unwrap();
    assert_eq!((column.nx, column.ny, column.heights), (3, 1, vec![1.25, 0.75, 1.5]));
    assert!(column.warnings[0].starts_with("commas are read as decimal marks"), "{:?}", column.warnings);
    let wide: Vec<u8> =
        [0xff, 0xfe].into_iter().chain("1,2\n3,4\n".encode_utf16().flat_map(u16::to_le_bytes)).collect();
    assert_eq!(read_bytes(&wide, "a.csv").unwrap().heights, [1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn one_of_several_blocks_is_chosen_by_its_number() {
    let file =
        b"# Channel: first\n# Value units: nm\n1 2\n3 5\n\n# Channel: second\n# Value units: um\n7 8\n9 1\n";
    let error = read_bytes(file, "a.txt").unwrap_err().to_string();
    assert!(error.contains("2 surfaces (1 \"first\", 2 \"second\")"), "{error}");
    let second = Options::new().with_channel(2).read_bytes(file, "a.txt").unwrap();
    assert_eq!((second.unit, second.heights[0]), (Some(Micrometre), 7e-6));
    assert!(Options::new().with_channel(3).read_bytes(file, "a.txt").is_err());
    let columns = b"x (um),left height (nm),right height (nm)\n0,1,2\n1,2,3\n2,1,5\n";
    let error = read_bytes(columns, "a.csv").unwrap_err().to_string();
    assert!(error.contains("1 \"left height\", 2 \"right height\""), "{error}");
    let right = Options::new().with_channel(2).read_bytes(columns, "a.csv").unwrap();
    assert_eq!(right.heights.iter().map(|z| (z * 1e9).round()).collect::<Vec<_>>(), [2.0, 3.0, 5.0]);
}

#[test]
fn texts_that_are_not_understood_are_refused_by_line_and_field() {
    let spread = |dx: f64| {
        format!(
            "x (um),y (um),z (um)\n{}\n",
            points(",", 0.5, 0.5).join("\n").replace("1,0.5,", &format!("{},0.5,", 1.0 + dx))
        )
    };
    let cases = [
        ("1 2 3\n4 5\n".to_owned(), "line 2: 2 numbers, 3 in the first row"),
        ("1 2\n3 x\n".to_owned(), "line 2, field 2: \"x\" is not a number"),
        ("1 nope\n".to_owned(), "line 1, field 2: \"nope\""),
        ("1 2\n3 1e999\n".to_owned(), "line 2, field 2: \"1e999\""),
        ("1.5;2,5\n3;4\n".to_owned(), "line 1: \"1.5\" and line 1: \"2,5\" have different decimal marks"),
        ("x-pixels = 3\ny-pixels = 2\n1 2 3\n".to_owned(), "3 heights, the header says 3 x 2"),
        ("x-pixels = 4\n1 2 3\n".to_owned(), "3 heights along x, the header says 4"),
        ("x-pixels = many\n1 2 3\n".to_owned(), "x pixels = many is not a count"),
        (
            "x-pixels = 99999999999\ny-pixels = 99999999999\n1 2\n".to_owned(),
            "2 heights, the header says 99999999999",
        ),
        ("# Width: wide\n1 2\n".to_owned(), "width = wide is not a length"),
        ("# Width: 0 m\n# Height: 1 m\n1 2\n".to_owned(), "width = 0 m: it must be finite and > 0"),
        ("XY Calibration,-500,nm\nUnit,um\n1,2\n3,4\n".to_owned(), "xy calibration = -500"),
        ("# Width: 3 m\n1 2\n3 4\n".to_owned(), "one axis only"),
        ("# Width: 3 V\n# Height: 3 V\n1 2\n".to_owned(), "width: \"V\" is no unit of length"),
        ("# Value units: V\n1 2\n".to_owned(), "height: \"V\" is no unit of length"),
        ("# Value units: mm\n# z-unit: um\n1 2\n".to_owned(), "z unit = um contradicts value units = mm"),
        (
            "# Width: 2 um\n# Height: 1 um\n# Value units: nm\nunit: um\n1 2\n".to_owned(),
            "unit = um contradicts value units = nm",
        ),
        (
            "\"Image size\",\"2\",\"3\"\n\"Unit\",\"um\"\n1,2\n3,4\n".to_owned(),
            "4 heights, the header says 2 x 3",
        ),
        ("# unit: mm\n# units: um\n1 2\n".to_owned(), "units = um contradicts unit = mm"),
        (
            "# x-unit: mm\n# y-unit: mm\n# x-length: 3 um\n# y-length: 3 um\n1 2\n".to_owned(),
            "x length = 3 um contradicts x unit = mm",
        ),
        (
            "# z-unit: nm\nx (um),y (um),z (um)\n0,0,1\n1,0,2\n0,1,3\n1,1,5\n".to_owned(),
            "z unit = nm contradicts the unit um of the title",
        ),
        (
            "# Width: 20 um\n# Height: 8 um\n# dx: 4 um\n# dy: 4 um\n1 2\n3 4\n".to_owned(),
            "width = 2.000000e-5 m contradicts dx = 4.000000e-6 m",
        ),
        ("# Width: 3 m\n".to_owned(), "no heights after the header"),
        ("hello\nworld\n".to_owned(), "neither"),
        ("\n\n".to_owned(), "neither"),
        (spread(0.05), "x positions are off a raster of spacing 5.0000e-1 by up to 5.0000e-2 (10 %)"),
        (spread(0.25), "x positions are off a raster of spacing 5.0000e-1 by up to 2.5000e-1 (50 %)"),
        ("x (um),z (um)\n0,1\n1,2\n2.3,1\n3,2\n4,1\n".to_owned(), "(30 %)"),
        (
            "x,y,z\n0,0,1\n1,0,2\n0,1,3\n1,0,4\n".to_owned(),
            "row 4: the point (1, 0) of the raster is given twice",
        ),
        ("x (um),current (pA)\n0,1\n1,2\n2,1\n".to_owned(), "none of which is called z or height"),
        ("Wyko ASCII Data File Format 0\t1\t1\nX Size\t3\n".to_owned(), "no block RAW_DATA"),
    ];
    for (content, expected) in cases {
        let error = read_bytes(content.as_bytes(), "heights.txt").unwrap_err().to_string();
        assert!(error.contains(expected) && error.starts_with("heights.txt"), "{expected}: {error}");
    }
}
