//! A cam and a flat follower.
//!
//! With the lift `s(a)` over the cam angle `a`, base circle `r` and rate of rotation `w`: radius of curvature
//! `r + s + s''`, speeds relative to the contact `w (r + s + s'')` of the cam and `w s''` of the follower, force
//! `F + k s + m w^2 s''` of spring and mass.

use std::error::Error;
use std::f64::consts::TAU;
use std::fs;

use stribeck::text_table;
use stribeck::units::{Dimension, by_size};

use super::{Machine, Options, length, number};
use crate::{files, output};

/// Options of the cam alone.
pub(super) const OPTIONS: [&str; 6] =
    ["--base-circle", "--face-width", "--rotation", "--spring-rate", "--preload", "--mass"];
/// Relative difference of angle steps that counts as equal.
const EVEN: f64 = 1e-3;
/// Root mean square error of the radii of curvature by rounded lifts, over the least radius, above which it is said.
const ROUNDED: f64 = 0.02;
/// Largest lift over the radius of the base circle.
const LARGEST_LIFT: f64 = 10.0;

/// An angle and its lift.
#[derive(Clone, Copy)]
struct Entry {
    /// Number of the line in the file, counted from 1.
    line: usize,
    /// Angle \[deg\].
    angle: f64,
    /// Lift \[m\].
    lift: f64,
    /// Unit of the last digit of the lift \[m\].
    digit: f64,
}

/// Unit of the last digit of a number, 0.01 of "12.34" and 1e-5 of "1.234e-2".
fn last_digit(number: &str) -> f64 {
    let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    10_f64.powi(exponent.parse().unwrap_or(0) - decimals as i32)
}

/// The lines of `text`; an error in words. Angles are in degrees and lifts in metres unless a line of names has other units in
/// parentheses.
fn entries(text: &str) -> Result<Vec<Entry>, String> {
    let (mut entries, mut units) = (Vec::new(), [1.0; 2]);
    for text_table::Row { line, text, cells, .. } in text_table::rows(text) {
        let values: Vec<Option<f64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
        match *values.as_slice() {
            [Some(angle), Some(lift)] if f64::is_finite(angle) && f64::is_finite(lift) => {
                let digit = units[1] * cells.get(1).map_or(0.0, |cell| last_digit(cell));
                entries.push(Entry { line, angle: units[0] * angle, lift: units[1] * lift, digit });
            }
            // a line of names
            _ if entries.is_empty() && text.starts_with(|c: char| c.is_alphabetic() || c == '"') => {
                units = units_of(&cells).map_err(|reason| format!("line {line}: {reason}"))?;
            }
            _ => {
                return Err(format!(
                    "line {line} is not an angle in degrees and a lift in metres, as in `12.5, 1e-3`: `{text}`"
                ));
            }
        }
    }
    Ok(entries)
}

/// Units of the angles \[deg\] and the lifts \[m\] in a line of `names`, `angle (deg)` and `lift (mm)`.
fn units_of(names: &[&str]) -> Result<[f64; 2], String> {
    let mut units = [1.0; 2];
    let dimensions = [Dimension::Angle, Dimension::Length];
    for ((unit, dimension), name) in units.iter_mut().zip(dimensions).zip(names) {
        let Some((_, text)) = name.split_once('(') else { continue };
        let size = dimension.parse(name, &format!("1 {}", text.trim_end_matches(')')));
        *unit = size.map_err(|error| error.to_string())?;
        if dimension == Dimension::Angle {
            *unit = unit.to_degrees();
        }
    }
    Ok(units)
}

/// Entries at even angles of a turn. The last one may repeat the first after a turn and is left out then.
fn turn(options: &Options) -> Result<Vec<Entry>, Box<dyn Error>> {
    let path = options.cam.as_ref().ok_or("--cam is missing")?;
    let refused = |reason: String| -> Box<dyn Error> { format!("--cam {}: {reason}", path.display()).into() };
    let text = fs::read_to_string(path).map_err(|error| refused(files::io_words(&error)))?;
    let mut entries = entries(&text).map_err(refused)?;
    let count = entries.len();
    if count < 16 {
        return Err(refused(format!("has {count} lines, a lift needs at least 16")));
    }
    // The median: a missing line or one twice is named, not the first.
    let mut steps: Vec<f64> = entries.windows(2).map(|pair| pair[1].angle - pair[0].angle).collect();
    steps.sort_by(f64::total_cmp);
    let step = steps[steps.len() / 2];
    let is_uneven =
        |[before, entry]: &&[Entry; 2]| (entry.angle - before.angle - step).abs() > EVEN * step.abs();
    if let Some([before, entry]) = entries.array_windows().find(is_uneven) {
        return Err(refused(format!(
            "line {}: angle {} follows {}; the angles must have even steps, as those of {step} degrees",
            entry.line, entry.angle, before.angle
        )));
    }
    let (first, last) = (entries[0], entries[count - 1]);
    if step <= 0.0 {
        return Err(refused(format!(
            "line {}: angle {} follows {}; the angles must rise",
            entries[1].line, entries[1].angle, first.angle
        )));
    }
    let highest = entries.iter().map(|entry| entry.lift).fold(0.0, f64::max);
    if highest <= 0.0 {
        return Err(refused(
            "no lift is above 0; lifts are measured from the base circle outwards".to_owned(),
        ));
    }
    if (step * (count - 1) as f64 - 360.0).abs() < EVEN * step {
        if (last.lift - first.lift).abs() > EVEN * highest {
            return Err(refused(format!(
                "line {}: after a turn the lift is {} m, that of line {} is {} m; both must be equal",
                last.line, last.lift, first.line, first.lift
            )));
        }
        entries.pop();
    } else if (step * count as f64 - 360.0).abs() > EVEN * step * count as f64 {
        return Err(refused(format!(
            "the angles from {} (line {}) to {} (line {}) cover {:.3} degrees, not a turn of 360; angles are in degrees",
            first.angle,
            first.line,
            last.angle,
            last.line,
            step * count as f64
        )));
    }
    Ok(entries)
}

/// Says where lifts have too few digits for the `least` radius of curvature \[m\]. Roundings of three lifts, each of the standard deviation
/// `d/sqrt(12)` of the last digit d, make the standard deviation `d/(sqrt(2) step^2)` of the second derivative.
fn warn_of_rounding(entries: &[Entry], step: f64, least: f64) {
    let digit = entries.iter().map(|entry| entry.digit).fold(f64::INFINITY, f64::min);
    let error = digit / (2.0_f64.sqrt() * step * step);
    if error > ROUNDED * least && least > 0.0 {
        let needed = digit * ROUNDED * least / error;
        output::complain(
            "warning",
            &format!(
                "--cam: lifts are rounded to {}, by which radii of curvature are off by {} at the least radius of {}; lifts with digits to {}, or at wider steps",
                by_size(digit, "m"),
                by_size(error, "m"),
                by_size(least, "m"),
                by_size(needed, "m")
            ),
        );
    }
}

/// The cam over a turn.
pub(super) fn machine(options: &Options) -> Result<Machine, Box<dyn Error>> {
    let entries = turn(options)?;
    let lift: Vec<f64> = entries.iter().map(|entry| entry.lift).collect();
    let base = length("--base-circle", &options.base_circle)?;
    let width = length("--face-width", &options.face_width)?;
    if let Some(Entry { line, lift, .. }) = entries.iter().find(|entry| entry.lift > LARGEST_LIFT * base) {
        return Err(format!(
            "--cam: line {line}: the lift of {lift} m is more than {LARGEST_LIFT} times the base circle of {base} m; lifts are in metres"
        )
        .into());
    }
    let rate = TAU * number("--rotation", options.rotation)? / 60.0;
    let [spring, mass] = [number("--spring-rate", options.spring_rate)?, number("--mass", options.mass)?];
    let preload = options.preload.as_ref().ok_or("--preload is missing")?;
    let preload = output::positive(Dimension::Force, "--preload", preload)?;
    let count = lift.len();
    let step = TAU / count as f64;
    let second: Vec<f64> = (0..count)
        .map(|k| (lift[(k + 1) % count] - 2.0 * lift[k] + lift[(k + count - 1) % count]) / (step * step))
        .collect();
    let first = entries[0].angle.to_radians();
    let angles: Vec<f64> = (0..count).map(|k| first + step * k as f64).collect();
    let radii: Vec<f64> = (0..count).map(|k| base + lift[k] + second[k]).collect();
    warn_of_rounding(&entries, step, radii.iter().copied().fold(f64::INFINITY, f64::min));
    let loads: Vec<f64> =
        (0..count).map(|k| (preload + spring * lift[k] + mass * rate * rate * second[k]) / width).collect();
    let place = |k: usize| format!("{:.2} degrees (line {})", angles[k].to_degrees(), entries[k].line);
    if let Some(k) = radii.iter().position(|radius| *radius <= 0.0) {
        return Err(format!(
            "--base-circle: at {} the radius of curvature of the cam is {:.4e} m, it must be above 0; a larger base circle, or a smoother \
             lift",
            place(k),
            radii[k]
        )
        .into());
    }
    if let Some(k) = loads.iter().position(|load| *load <= 0.0) {
        return Err(format!(
            "--preload: at {} the force is {:.4e} N, the follower leaves the cam; more preload or spring rate, less mass or \
             rotation",
            place(k),
            loads[k] * width
        )
        .into());
    }
    let speeds = [radii.iter().map(|r| rate * r).collect(), second.iter().map(|s| rate * s).collect()];
    let [cam, follower]: &[Vec<f64>; 2] = &speeds;
    let reverses = cam.iter().zip(follower).any(|(a, b)| a + b < 0.0);
    Ok(Machine {
        title: format!("Cam and flat follower over a turn, {count} angles"),
        bodies: ["cam", "follower"],
        is_line: true,
        reverses,
        key: format!("period = {:e} # s, of a turn", TAU / rate),
        places: ("angle", angles),
        loads,
        speeds,
        radii,
    })
}
