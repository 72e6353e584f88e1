//! Values as text in a unit of their size.

/// A unit, its size in SI units, and the least value that is written in it, in SI units.
type Step = (&'static str, f64, f64);

/// Digits of a number.
const DIGITS: usize = 5;
/// Numbers that are 1 with [`DIGITS`] digits count as 1.
const ROUNDED: f64 = 0.99999;

const LENGTHS: [Step; 3] = [("mm", 1e-3, 1e-3), ("um", 1e-6, 1e-6), ("nm", 1e-9, 0.0)];
const AREAS: [Step; 2] = [("mm^2", 1e-6, 1e-6), ("um^2", 1e-12, 0.0)];
const PRESSURES: [Step; 3] = [("GPa", 1e9, 1e8), ("MPa", 1e6, 1e5), ("Pa", 1.0, 0.0)];
const FORCES: [Step; 5] =
    [("MN", 1e6, 1e6), ("kN", 1e3, 1e3), ("N", 1.0, 1.0), ("mN", 1e-3, 1e-3), ("uN", 1e-6, 0.0)];
const LINE_FORCES: [Step; 5] =
    [("MN/m", 1e6, 1e6), ("kN/m", 1e3, 1e3), ("N/m", 1.0, 1.0), ("mN/m", 1e-3, 1e-3), ("uN/m", 1e-6, 0.0)];
const POWERS: [Step; 5] =
    [("MW", 1e6, 1e6), ("kW", 1e3, 1e3), ("W", 1.0, 1.0), ("mW", 1e-3, 1e-3), ("uW", 1e-6, 0.0)];
const LINE_POWERS: [Step; 5] =
    [("MW/m", 1e6, 1e6), ("kW/m", 1e3, 1e3), ("W/m", 1.0, 1.0), ("mW/m", 1e-3, 1e-3), ("uW/m", 1e-6, 0.0)];

/// Units of quantities in the SI unit `unit`, the largest first.
fn steps(unit: &str) -> &'static [Step] {
    match unit {
        "m" => &LENGTHS,
        "m^2" => &AREAS,
        "m^3" => &[("mm^3", 1e-9, 0.0)],
        "m^2/m" => &[("mm^2/m", 1e-6, 0.0)],
        "m^3/m" => &[("mm^3/m", 1e-9, 0.0)],
        "m^2/s" => &[("mm^2/s", 1e-6, 0.0)],
        "m^3/s" => &[("mm^3/s", 1e-9, 0.0)],
        "Pa" => &PRESSURES,
        "N" => &FORCES,
        "N/m" => &LINE_FORCES,
        "W" => &POWERS,
        "W/m" => &LINE_POWERS,
        _ => &[],
    }
}

/// The unit for a value of this `size` in the SI unit `unit`, and its size in SI units.
pub(crate) fn unit_by_size(size: f64, unit: &'static str) -> (&'static str, f64) {
    let steps = steps(unit);
    let has_size = size > 0.0 && size.is_finite();
    let step = match has_size {
        true => steps.iter().find(|(_, _, least)| size >= ROUNDED * least),
        false => steps.iter().find(|(name, ..)| *name == unit).or(steps.last()),
    };
    step.map_or((unit, 1.0), |&(name, factor, _)| (name, factor))
}

/// The `value` in the SI unit `unit` (m, m^2, m^3, m^2/m, m^3/m, m^2/s, m^3/s, Pa, N, N/m, W or W/m) with five digits, in a unit of its
/// size: nm, um or mm; Pa, MPa or, from 0.1 GPa on, GPa; N, kN or MN. Values in other units keep them.
///
/// ```
/// use stribeck::units::by_size;
/// assert_eq!(by_size(1.15e9, "Pa"), "1.1500 GPa");
/// assert_eq!(by_size(54.07, "N"), "54.070 N");
/// assert_eq!(by_size(19.1234e-9, "m"), "19.123 nm");
/// assert_eq!(by_size(307e3, "N/m"), "307.00 kN/m");
/// ```
pub fn by_size(value: f64, unit: &'static str) -> String {
    let (name, factor) = unit_by_size(value.abs(), unit);
    let number = value / factor;
    let before = if number.abs() >= 1.0 { number.abs().log10() as usize } else { 0 };
    format!("{number:.*} {name}", (DIGITS - 1).saturating_sub(before))
}
