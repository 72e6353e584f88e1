//! Rolling bearings of the list: published inner geometry, or an estimate from the boundary dimensions.

use std::f64::consts::{PI, TAU};

/// Inner geometry of a bearing, lengths in mm.
pub(super) struct Bearing {
    pub(super) name: String,
    pub(super) elements: f64,
    /// Diameter of the rolling elements.
    pub(super) diameter: f64,
    /// Diameter of the pitch circle.
    pub(super) pitch: f64,
    pub(super) race: Race,
    pub(super) source: String,
}

/// Race of the inner ring.
#[derive(Clone, Copy)]
pub(super) enum Race {
    /// Radius of the groove over the diameter of the balls.
    Groove(f64),
    /// Effective length of the rollers.
    Roller(f64),
}

/// A bearing with published inner geometry, lengths in mm.
struct Published {
    name: &'static str,
    elements: f64,
    diameter: f64,
    pitch: f64,
    race: Race,
    source: &'static str,
}

/// Bearings with published inner geometry.
const PUBLISHED: [Published; 4] = [
    Published {
        name: "6203",
        elements: 8.0,
        diameter: 6.746,
        pitch: 28.5,
        race: Race::Groove(0.52),
        source: "8 balls of 6.746 mm on 28.50 mm: Case Western Reserve University, Bearing Data Center; groove radius 0.52 of the ball: usual",
    },
    Published {
        name: "6205",
        elements: 9.0,
        diameter: 7.94,
        pitch: 39.04,
        race: Race::Groove(0.52),
        source: "9 balls of 7.94 mm on 39.04 mm: Case Western Reserve University, Bearing Data Center; groove radius 0.52 of the ball: usual",
    },
    Published {
        name: "6209",
        elements: 9.0,
        diameter: 12.7,
        pitch: 64.9985,
        race: Race::Groove(6.6 / 12.7),
        source: "9 balls of 12.7 mm, races of 52.291 and 77.706 mm, groove radius 6.6 mm: Harris, Rolling bearing analysis (bearing 209)",
    },
    Published {
        name: "NU209",
        elements: 14.0,
        diameter: 10.0,
        pitch: 65.0115,
        race: Race::Roller(9.6),
        source: "14 rollers of 10 mm with 9.6 mm effective length, races of 54.991 and 75.032 mm: Harris, Rolling bearing analysis (bearing 209)",
    },
];

/// Bore diameters of the bore codes 00 to 12 \[mm\], ISO 15.
const BORES: [f64; 13] = [10.0, 12.0, 15.0, 17.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0];
/// Series and their outside diameters for these bores \[mm\], ISO 15.
const SERIES: [(&str, [f64; 13]); 4] = [
    ("60", [26.0, 28.0, 32.0, 35.0, 42.0, 47.0, 55.0, 62.0, 68.0, 75.0, 80.0, 90.0, 95.0]),
    ("62", [30.0, 32.0, 35.0, 40.0, 47.0, 52.0, 62.0, 72.0, 80.0, 85.0, 90.0, 100.0, 110.0]),
    ("63", [35.0, 37.0, 42.0, 47.0, 52.0, 62.0, 72.0, 80.0, 90.0, 100.0, 110.0, 120.0, 130.0]),
    ("NU2", [30.0, 32.0, 35.0, 40.0, 47.0, 52.0, 62.0, 72.0, 80.0, 85.0, 90.0, 100.0, 110.0]),
];
/// First bore code of cylindrical roller bearings.
const FIRST_ROLLER: usize = 3;
/// Diameter of balls over the difference of outside and bore diameter.
const BALL_SHARE: f64 = 0.3;
/// Angle of the bearing that balls fill when they are inserted \[rad\].
const FILLING: f64 = 187.0 * PI / 180.0;
/// Diameter of rollers over that difference, effective length over diameter, and share of the pitch circle that they take: those of NU209.
const ROLLER_SHARE: f64 = 0.25;
const ROLLER_LENGTH: f64 = 0.96;
const ROLLER_FILL: f64 = 14.0 * 10.0 / (PI * 65.0115);
/// Radius of grooves over the diameter of balls.
const USUAL_GROOVE: f64 = 0.52;

/// The bearing `given`: "6205", "6205-2RS", "NU 209".
pub(super) fn find(given: &str) -> Result<Bearing, String> {
    let name: String = given.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_uppercase();
    let published = PUBLISHED.iter().find(|bearing| is_named(&name, bearing.name));
    if let Some(&Published { name, elements, diameter, pitch, race, source }) = published {
        return Ok(Bearing {
            name: name.to_owned(),
            elements,
            diameter,
            pitch,
            race,
            source: source.to_owned(),
        });
    }
    estimates().find(|bearing| is_named(&name, &bearing.name)).ok_or_else(|| unknown(given, &name))
}

/// Whether `name` is the bearing `known`, of balls also with seals, shields or a clearance behind its number.
fn is_named(name: &str, known: &str) -> bool {
    let suffix = name.strip_prefix(known);
    let is_ball = !known.starts_with('N');
    suffix.is_some_and(|rest| {
        rest.is_empty()
            || is_ball && ["-", "/", "Z", "RS", "2", "C"].iter().any(|start| rest.starts_with(start))
    })
}

/// All bearings by their boundary dimensions.
fn estimates() -> impl Iterator<Item = Bearing> {
    SERIES.iter().flat_map(|(series, outsides)| {
        let first = if series.starts_with('N') { FIRST_ROLLER } else { 0 };
        let sizes = BORES.into_iter().zip(outsides.iter().copied()).enumerate().skip(first);
        sizes.map(move |(code, size)| estimate(format!("{series}{code:02}"), size))
    })
}

/// Inner geometry from `(bore, outside)` diameters.
fn estimate(name: String, (bore, outside): (f64, f64)) -> Bearing {
    let pitch = 0.5 * (bore + outside);
    let section = outside - bore;
    let is_roller = name.starts_with('N');
    let diameter = tenths(section * if is_roller { ROLLER_SHARE } else { BALL_SHARE });
    let (elements, race, rule) = if is_roller {
        let race = Race::Roller(tenths(ROLLER_LENGTH * diameter));
        ((ROLLER_FILL * PI * pitch / diameter).round(), race, "rollers with the proportions of NU209")
    } else {
        let step = 2.0 * (diameter / pitch).asin();
        let race = Race::Groove(USUAL_GROOVE);
        (
            (1.0 + FILLING.min(TAU) / step).round(),
            race,
            "balls of .3 of the difference, as many as fill 187 degrees, groove radius .52 of the ball",
        )
    };
    let source = format!(
        "ESTIMATE from the boundary dimensions of ISO 15, {bore} and {outside} mm: pitch circle {pitch} mm, {elements} elements of {diameter} mm\n\
         # ({rule}). Beside published bearings balls are off by up to 6 %, their number by one"
    );
    Bearing { name, elements, diameter, pitch, race, source }
}

/// Rounded to a tenth of a millimetre.
fn tenths(length: f64) -> f64 {
    (10.0 * length).round() / 10.0
}

/// The error for a bearing that is not in the list, with those of the nearest bore.
fn unknown(given: &str, name: &str) -> String {
    let list = "--bearing knows deep-groove ball bearings 6000 to 6012, 6200 to 6212 and 6300 to 6312, and cylindrical roller bearings NU203 to \
                NU212";
    let remedy = "write the radii of another bearing into a scene of one of these";
    let Some((bore, near)) = nearest_bore(name) else {
        return format!("--bearing {given:?}: {list}; {remedy}");
    };
    format!("--bearing {given:?}: {list}; nearest to its bore of {bore} mm: {}; {remedy}", near.join(", "))
}

/// The bore by the number in the `name` \[mm\] (ISO 15: its last two digits, times five from 04 on; the last digit alone of three) and the listed
/// bearings of the nearest bore.
fn nearest_bore(name: &str) -> Option<(f64, Vec<String>)> {
    let digits: String =
        name.chars().skip_while(|c| !c.is_ascii_digit()).take_while(char::is_ascii_digit).collect();
    let number: usize = digits.parse().ok()?;
    let bore = match (digits.len(), number % 100) {
        (3, _) => (number % 10) as f64,
        (4 | 5, code) => BORES.get(code).copied().unwrap_or(5.0 * code as f64),
        _ => return None,
    };
    let distance = |other: &f64| (other - bore).abs();
    let (code, _) = BORES.iter().enumerate().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
    let ending = format!("{code:02}");
    let near = estimates().map(|bearing| bearing.name).filter(|known| known.ends_with(&ending)).collect();
    Some((bore, near))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Estimates of the bearings whose geometry is published.
    #[test]
    fn estimates_are_near_published_bearings() {
        for bearing in &PUBLISHED {
            let near = estimates().find(|estimate| estimate.name == bearing.name).unwrap();
            assert!(
                (near.diameter / bearing.diameter - 1.0).abs() < 0.06,
                "{}: {}",
                bearing.name,
                near.diameter
            );
            assert!((near.pitch / bearing.pitch - 1.0).abs() < 0.02, "{}: {}", bearing.name, near.pitch);
            assert!((near.elements - bearing.elements).abs() <= 1.0, "{}: {}", bearing.name, near.elements);
        }
    }

    #[test]
    fn names_have_suffixes_and_unknown_ones_the_nearest() {
        assert_eq!(find("6205-2RS").map(|bearing| bearing.elements).ok(), Some(9.0));
        assert_eq!(find("6305 ZZ").map(|bearing| bearing.elements).ok(), Some(7.0));
        assert_eq!(find("nu 205").map(|bearing| bearing.name).ok().as_deref(), Some("NU205"));
        for (name, nearest) in
            [("7208", "6208"), ("22208", "6208"), ("NU2208", "NU208"), ("62055", "62"), ("abc", "60")]
        {
            let error = find(name).err().unwrap();
            assert!(error.contains(&format!("nearest: {nearest}")) || error.contains(nearest), "{error}");
        }
    }
}
