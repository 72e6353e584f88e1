//! Meanings of the keys of text headers.

/// Meaning of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Key {
    /// Number of points along an axis.
    Count(usize),
    /// Numbers of points along both axes.
    Counts,
    /// Length of the surface along an axis.
    Size(usize),
    /// The same in nanometres where no unit is given.
    SizeInNanometres(usize),
    /// Lengths along both axes.
    Sizes,
    /// Distance of the points along an axis.
    Spacing(usize),
    /// Distance along both.
    Spacings,
    /// Unit of lengths along an axis.
    LateralUnit(usize),
    /// Unit of lengths along both.
    LateralUnits,
    /// Unit of the heights.
    HeightUnit,
    /// Unit of all that has none of its own.
    Unit,
    /// Nanometres per stored number.
    Nanometres,
    /// Heights in their unit per stored number.
    Factor,
    /// The same, if [`Key::FactorNeeded`] says so.
    ScaleData,
    FactorNeeded,
    /// Stored number of undefined points.
    NoData,
    /// Number of undefined points, which a second matrix marks.
    VoidPixels,
    /// Name of the surface.
    Name,
    /// Nothing that heights depend on.
    Nothing,
}

/// The keys of each meaning in small letters, with blanks for hyphens and underscores. Gwyddion writes its keys in the
/// language of its user.
const KEYS: [(Key, &[&str]); 23] = [
    (
        Key::Count(0),
        &["x pixels", "nx", "w", "ncols", "horizontal", "columns", "samps/line", "points per line"],
    ),
    (Key::Count(1), &["y pixels", "ny", "h", "nrows", "vertical", "rows", "lines", "number of lines"]),
    (Key::Counts, &["image size"]),
    (Key::SizeInNanometres(0), &["x length"]),
    (Key::SizeInNanometres(1), &["y length"]),
    (
        Key::Size(0),
        &[
            "width",
            "x size",
            "size x",
            "x range",
            "breite",
            "largeur",
            "larghezza",
            "anchura",
            "largura",
            "\u{161}\u{ed}\u{159}ka",
            "\u{448}\u{438}\u{440}\u{438}\u{43d}\u{430}",
            "\u{5e45}",
            "\u{d3ed}",
            "\u{5bbd}\u{5ea6}",
        ],
    ),
    (
        Key::Size(1),
        &[
            "height",
            "y size",
            "size y",
            "y range",
            "h\u{f6}he",
            "hauteur",
            "altezza",
            "altura",
            "v\u{fd}\u{161}ka",
            "\u{432}\u{44b}\u{441}\u{43e}\u{442}\u{430}",
            "\u{9ad8}\u{3055}",
            "\u{b192}\u{c774}",
            "\u{9ad8}\u{5ea6}",
        ],
    ),
    (Key::Sizes, &["scan size"]),
    (
        Key::Spacing(0),
        &[
            "spacing x",
            "x spacing",
            "scale x",
            "x scale",
            "step x",
            "x step",
            "pixel size x",
            "x pixel size",
            "pixelsizex",
            "dx",
        ],
    ),
    (
        Key::Spacing(1),
        &[
            "spacing y",
            "y spacing",
            "scale y",
            "y scale",
            "step y",
            "y step",
            "pixel size y",
            "y pixel size",
            "pixelsizey",
            "dy",
        ],
    ),
    (
        Key::Spacings,
        &["pixel size", "spacing", "step", "cellsize", "cell size", "xy calibration", "resolution"],
    ),
    (Key::LateralUnit(0), &["x unit", "unit x"]),
    (Key::LateralUnit(1), &["y unit", "unit y"]),
    (Key::LateralUnits, &["lateral unit", "lateral units", "xy unit", "xy units"]),
    (
        Key::HeightUnit,
        &[
            "value units",
            "value unit",
            "z unit",
            "z units",
            "unit z",
            "unit data",
            "data unit",
            "height unit",
            "height units",
            "exported image units",
            "image units",
            "vertical units",
            "einheiten",
            "werteinheit",
            "werteinheiten",
            "unit\u{e9}s",
            "unit\u{e0} valore",
            "unidades de valor",
            "jednotky hodnot",
            "\u{435}\u{434}\u{438}\u{43d}\u{438}\u{446}\u{44b} \u{438}\u{437}\u{43c}\u{435}\u{440}\u{435}\u{43d}\u{438}\u{44f}",
            "\u{5024}\u{306e}\u{5358}\u{4f4d}",
            "\u{ac12} \u{b2e8}\u{c704}",
        ],
    ),
    (Key::Unit, &["unit", "units"]),
    (Key::Nanometres, &["bit2nm"]),
    (Key::ScaleData, &["scale data"]),
    (Key::FactorNeeded, &["datascaleneeded", "data scale needed"]),
    (Key::NoData, &["nodata value", "nodata", "no data value", "void pixel value"]),
    (Key::VoidPixels, &["voidpixels"]),
    (
        Key::Name,
        &[
            "channel",
            "kanal",
            "canal",
            "canale",
            "kan\u{e1}l",
            "\u{43a}\u{430}\u{43d}\u{430}\u{43b}",
            "\u{30c1}\u{30e3}\u{30cd}\u{30eb}",
            "\u{30c1}\u{30e3}\u{30f3}\u{30cd}\u{30eb}",
            "\u{cc44}\u{b110}",
            "title",
            "scan name",
            "name",
        ],
    ),
    (
        Key::Nothing,
        &[
            "file format",
            "start of data",
            "date",
            "time",
            "comment",
            "comments",
            "operator",
            "instrument",
            "xllcorner",
            "yllcorner",
            "xllcenter",
            "yllcenter",
            "measurement data name",
            "reference data name",
            "data name",
            "output image data",
            "measurement date and time",
            "measurement date",
            "objective lens",
            "minimum value",
            "maximum value",
            "model",
            "model name",
            "measurement data",
            "measurement data type",
            "original file",
            "file name",
            "x offset",
            "y offset",
            "bias x",
            "bias y",
            "scanspeed",
            "forward",
            "meta data",
            "scan parameters",
            "scan data",
            "file list",
            "file list end",
        ],
    ),
];

/// The meaning of `key` in small letters, with blanks for hyphens and underscores; `None` where it is not known.
pub(super) fn meaning(key: &str) -> Option<Key> {
    if key.starts_with("created by") {
        return Some(Key::Nothing);
    }
    let listed = KEYS.iter().find(|(_, keys)| keys.contains(&key)).map(|(meaning, _)| *meaning);
    listed.or_else(|| key.starts_with("height conversion factor").then_some(Key::Factor))
}
