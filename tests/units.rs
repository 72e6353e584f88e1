//! Quantities with units, alone and in scene files.
#![expect(clippy::float_cmp, reason = "tests")]

use stribeck::InputError;
use stribeck::sim::{Scene, SimError};
use stribeck::units::Dimension::{self, *};

/// The scene of the documentation in SI units, and the same with units.
const SI: &str = include_str!("../examples/scenes/rough.toml");

#[test]
fn quantities_are_those_in_si_units_to_the_last_bit() {
    let table: [(Dimension, &str, f64); 54] = [
        (Length, "9.525 mm", 9.525e-3),
        (Length, "9.525mm", 9.525e-3),
        (Length, "-250 um", -250e-6),
        (Length, "10 \u{b5}m", 10e-6),
        (Length, "10 \u{3bc}m", 10e-6),
        (Length, "1.3e2 nm", 130e-9),
        (Length, "0.0254 m", 0.0254),
        (Length, "1 in", 25.4e-3),
        (Length, "2.5 cm", 2.5e-2),
        (Pressure, "1.15 GPa", 1.15e9),
        (Pressure, "100 MPa", 1e8),
        (Pressure, "6 N/mm^2", 6e6),
        (Pressure, "3 bar", 3e5),
        (Pressure, "7 kPa", 7e3),
        (InversePressure, "14.9 1/GPa", 14.9e-9),
        (InversePressure, "14.9 GPa^-1", 14.9e-9),
        (InversePressure, "14.9 GPa\u{207b}\u{b9}", 14.9e-9),
        (InversePressure, "0.0149 mm\u{b2}/N", 14.9e-9),
        (InversePressure, "1.494e-8 1/Pa", 1.494e-8),
        (PressurePerLength, "2 GPa/um", 2e15),
        (PressurePerLength, "2 GPa/mm", 2e12),
        (Force, "60 N", 60.0),
        (Force, "1.5 kN", 1500.0),
        (Force, "20 mN", 0.02),
        (ForcePerLength, "175 kN/m", 175e3),
        (ForcePerLength, "175 N/mm", 175e3),
        (Speed, "0.5 m/s", 0.5),
        (Speed, "20 mm/s", 0.02),
        (Speed, "36 km/h", 10.0),
        (Viscosity, "4 mPa s", 4e-3),
        (Viscosity, "4 mPa*s", 4e-3),
        (Viscosity, "4 mPa\u{b7}s", 4e-3),
        (Viscosity, "4 cP", 4e-3),
        (Time, "2 h", 7200.0),
        (Time, "1.5 min", 90.0),
        (Time, "20 ms", 20e-3),
        (Rate, "36 1/h", 0.01),
        (Temperature, "80 degC", 353.15),
        (Temperature, "80 \u{b0}C", 353.15),
        (Temperature, "353.15 K", 353.15),
        (Conductivity, "46 W/(m K)", 46.0),
        (Diffusivity, "12.7 mm^2/s", 12.7e-6),
        (HeatCapacity, "1.7 MJ/(m^3 K)", 1.7e6),
        (HeatCapacity, "1.7 MJ/(m3.K)", 1.7e6),
        (Viscosity, "4 mPa.s", 4e-3),
        (Viscosity, "4 mPa-s", 4e-3),
        (Viscosity, "0.004 N s/m2", 4e-3),
        (InversePressure, "14.9 GPa-1", 14.9e-9),
        (InversePressure, "0.0149 mm2/N", 14.9e-9),
        (InversePressure, "1e-8 m2/N", 1e-8),
        (Diffusivity, "1.27e-5 m2/s", 1.27e-5),
        (Rate, "0.5 s-1", 0.5),
        (Temperature, "80 \u{2103}", 353.15),
        (Volume, "3 A3", 3e-30),
    ];
    for (dimension, text, expected) in table {
        assert_eq!(dimension.parse("key", text).unwrap(), expected, "{text}");
    }
}

#[test]
fn every_unit_that_is_offered_is_taken() {
    let dimensions = [
        Length,
        Pressure,
        InversePressure,
        PressurePerLength,
        Force,
        ForcePerLength,
        Speed,
        Viscosity,
        Time,
        Rate,
        Rotation,
        Temperature,
        Conductivity,
        Diffusivity,
        HeatCapacity,
    ];
    for dimension in dimensions {
        let offered: Vec<&str> = dimension.unit_names().collect();
        assert!(!offered.is_empty());
        for unit in &offered {
            assert!(dimension.parse("key", &format!("1 {unit}")).unwrap() > 0.0, "{unit}");
        }
        // The first is the SI unit.
        assert_eq!(dimension.parse("key", &format!("3.7 {}", offered[0])).unwrap(), 3.7);
        let error = dimension.parse("key", "1 kg").unwrap_err().to_string();
        assert!(offered.iter().all(|unit| error.contains(unit)), "{error}");
    }
}

#[test]
fn invalid_quantities_are_rejected_by_field_value_and_remedy() {
    for (text, part) in [
        ("9.5 kg", "`kg` is no unit of length; m, cm, mm, um, nm or in would do"),
        ("9.5 MM", "`MM` is no unit of length"),
        ("9.5", "the unit is missing"),
        ("", "must be a number, alone or with a unit of length"),
        ("big", "must be a number, alone or with a unit of length"),
        ("nan m", "must be a number, alone or with a unit of length"),
        ("inf m", "must be a number, alone or with a unit of length"),
        ("1e400 m", "beyond the range of numbers"),
        ("1e2147483647 km", "`km` is no unit"),
        ("1e2147483647 mm", "beyond the range of numbers"),
        ("1e-2147483648 nm", "beyond the range of numbers"),
        ("1 2 mm", "`2 mm` is no unit of length"),
        ("--1 mm", "must be a number, alone or with a unit of length"),
        ("1\u{b0}\u{1f600}", "is no unit of length"),
    ] {
        let error = Length.parse("form.radius", text).unwrap_err();
        assert!(matches!(error, InputError::Conflict { .. }));
        let message = error.to_string();
        assert!(message.starts_with(&format!("form.radius = \"{text}\": ")), "{message}");
        assert!(message.contains(part), "{part}: {message}");
    }
}

#[test]
fn a_decimal_comma_is_refused_with_the_number_meant() {
    for (text, number) in [("9,525 mm", "9.525 mm"), ("-0,25mm", "-0.25mm"), ("1,5e-3 m", "1.5e-3 m")] {
        let message = Length.parse("grid.x", text).unwrap_err().to_string();
        assert_eq!(message, format!("grid.x = \"{text}\": the decimal separator is a point: \"{number}\""));
    }
}

/// 4 cSt of an oil of 850 kg/m^3 are 4e-6 m^2/s times 850 kg/m^3 = 3.4e-3 Pa s.
#[test]
fn a_kinematic_viscosity_is_refused_with_the_dynamic_one() {
    for (text, dynamic) in
        [("4 cSt", "3.4"), ("0.04 St", "3.4"), ("4 mm2/s", "3.4"), ("1e-4 m\u{b2}/s", "85")]
    {
        let message = Viscosity.parse("lubricant.eta0", text).unwrap_err().to_string();
        assert!(message.starts_with(&format!("lubricant.eta0 = \"{text}\": ")), "{message}");
        assert!(message.contains("multiply by the density"), "{message}");
        assert!(message.ends_with(&format!("it is \"{dynamic} mPa s\"")), "{message}");
    }
}

#[test]
fn a_scene_with_units_is_the_scene_without() {
    let mut text = SI.to_owned();
    for (from, to) in [
        ("radius = 9.525e-3", "radius = \"9.525 mm\""),
        ("equivalent_modulus = 229.67e9", "equivalent_modulus = '229.67 GPa'"),
        ("hertz_pressure = 1.15e9", "hertz_pressure = \"1.15 GPa\""),
        ("entrainment_speed = 0.1", "entrainment_speed = \"10 cm/s\""),
        ("eta0 = 0.004", "eta0 = \"4 mPa s\""),
        ("roelands_p0 = 1.96e8", "roelands_p0 = \"196 MPa\""),
        ("x = [-0.25e-3, 0.25e-3]", "x = [\"-250 um\", 0.25e-3]"),
        ("length_y = 10e-6", "length_y = \"\"\"\n10 um\n\"\"\""),
        ("rq = 130e-9", "rq = \"130 nm\""),
        ("hardness = 6e9", "hardness = \"6 GPa\""),
        ("slide_roll_ratio = 0.05", "slide_roll_ratio = \"5 %\""),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    assert_eq!(Scene::from_toml(&text).unwrap(), Scene::from_toml(SI).unwrap());
    // Lines of errors are those of the text that was given.
    let broken = format!("{text}\nsurprise = 1\n");
    let line = broken.lines().position(|line| line == "surprise = 1").unwrap() + 1;
    let message = Scene::from_toml(&broken).unwrap_err().to_string();
    assert!(message.contains(&format!("line {line}: ")) && message.contains("surprise"), "{message}");
}

#[test]
fn schedules_and_line_loads_have_units_too() {
    let line = include_str!("../examples/scenes/line.toml");
    let with = line.replace("force = 175e3", "force = \"175 N/mm\"");
    assert_eq!(Scene::from_toml(&with).unwrap(), Scene::from_toml(line).unwrap());
    let point_load = line.replace("force = 175e3", "force = \"175 N\"");
    let message = Scene::from_toml(&point_load).unwrap_err().to_string();
    assert!(message.contains("load.force = \"175 N\": `N` is no unit of force per length"), "{message}");
    let schedule = "\n[schedule.load]\nkind = \"steps\"\ntimes = [0.0, \"10 min\"]\nvalues = [\"20 N\", 40.0]\n\
                    [schedule.bulk_temperature]\nkind = \"constant\"\nvalue = \"80 degC\"\n";
    let scene = Scene::from_toml(&format!("{SI}{schedule}")).unwrap();
    let late = scene.conditions(600.0).unwrap();
    assert_eq!((late.load, late.bulk_temperature), (40.0, 353.15));
}

/// Every key of the documentation that has a unit is known to have one.
#[test]
fn every_documented_key_with_a_unit_takes_one() {
    // Temperature differences and values per kelvin.
    const NUMBERS: [&str; 6] = ["epsilon", "beta", "expansion", "expansivity", "a1", "c2"];
    let document = [
        include_str!("../docs/scene_contact.md"),
        include_str!("../docs/scene_bodies.md"),
        include_str!("../docs/scene_fluid.md"),
        include_str!("../docs/scene_laws.md"),
        include_str!("../docs/scene_history.md"),
        include_str!("../docs/cycles.md"),
    ]
    .concat();
    let mut section = String::new();
    let mut keys = 0;
    for line in document.lines() {
        if let Some(heading) = line.trim_start_matches('#').strip_prefix(" `[") {
            section = heading.split(']').next().unwrap().to_owned();
        }
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let (Some(names), Some(unit)) = (cells.get(1), cells.get(3)) else { continue };
        let physical = unit.starts_with(['m', 'N', 'P', '1', 's', 'K', 'W', 'J', 'r']) && *unit != "1";
        if !names.starts_with('`') || !physical {
            continue;
        }
        for name in names.split(", ").map(|name| name.trim_matches('`')) {
            if section.starts_with("lubricant.") && NUMBERS.contains(&name) {
                continue;
            }
            let key = match name.starts_with("schedule.") {
                true => format!("{name}.value"),
                false if name.contains('.') => name.to_owned(),
                false => format!("{section}.{name}"),
            };
            let quantity = if section == "grid" { "[\"1 kg\"]" } else { "\"1 kg\"" };
            let error = Scene::from_toml(&format!("{key} = {quantity}\n")).unwrap_err();
            assert!(matches!(error, SimError::Input(_)), "{key}: {error}");
            assert!(error.to_string().starts_with(&key), "{key}: {error}");
            keys += 1;
        }
    }
    assert!(keys > 40, "{keys} keys");
}

#[test]
fn messages_have_no_names_of_types() {
    for (from, to, words) in [
        ("seed = 1", "seed = 1.5", "whole number"),
        ("nx = 128", "nx = 1.5", "a whole number"),
        ("nx = 128", "nx = true", "a whole number"),
        ("radius = 9.525e-3", "radius = true", "a number"),
        ("slide_roll_ratio = 0.05", "slide_roll_ratio = true", "a number"),
        ("x = [-0.25e-3, 0.25e-3]", "x = 1.0", "a list"),
        ("hardness = 6e9", "hardness = [6e9]", "a number"),
        ("kind = \"gaussian\"", "kind = 3", "text"),
    ] {
        let text = SI.replacen(from, to, 1);
        assert_ne!(text, SI, "{from}");
        let message = Scene::from_toml(&text).unwrap_err().to_string();
        assert!(message.contains(words) && message.starts_with("line "), "{to}: {message}");
        for jargon in ["f64", "usize", "u64", "struct", "sequence", "boolean", "string", "invalid", "field"] {
            assert!(!message.contains(jargon), "{to}: {message}");
        }
    }
}

#[test]
fn messages_quote_no_more_than_a_line() {
    let long = "a".repeat(1_000_000);
    for (from, to) in [
        ("radius = 9.525e-3", format!("radius = \"{long}\"")),
        ("radius = 9.525e-3", format!("radius = \"3 {long}\"")),
        ("radius = 9.525e-3", format!("radius = 9.525e-3\n{long} = 3")),
        ("kind = \"gaussian\"", format!("kind = \"{long}\"")),
    ] {
        let text = SI.replacen(from, &to, 1);
        assert_ne!(text, SI, "{from}");
        let message = Scene::from_toml(&text).unwrap_err().to_string();
        assert!(message.contains("aaa...") && message.len() < 400, "{from}: {} characters", message.len());
    }
}
