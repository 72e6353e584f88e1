//! Involute flanks of a spur gear along the path of contact.
//!
//! At the distance `s` from the tangent point of the pinion along the line of action of length `T`, the flanks have the
//! radii `s` and `T - s` and the speeds `w_1 s` and `w_2 (T - s)` relative to the contact. The path goes from the tip of the
//! wheel to the tip of the pinion (ISO 21771).

use std::error::Error;
use std::f64::consts::{PI, TAU};

use stribeck::units::Dimension;

use super::{Machine, Options, length, number};
use crate::output;

/// Options of the gear alone.
pub(super) const OPTIONS: [&str; 9] = [
    "--module",
    "--teeth",
    "--pressure-angle",
    "--shift",
    "--centre-distance",
    "--face-width",
    "--torque",
    "--rotation",
    "--load-sharing",
];
/// Fewest teeth of a gear.
const FEWEST_TEETH: u32 = 5;
/// Rows along the path.
const ROWS: u32 = 60;

/// Load of a pair of teeth where two pairs are in mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Sharing {
    /// From a third at the ends of the path to two thirds.
    Trapezoid,
    /// Half.
    Half,
}

/// Geometry of the path of contact \[m\].
struct Path {
    /// Base radii of pinion and wheel.
    base: [f64; 2],
    /// Length of the line of action between the tangent points.
    line: f64,
    /// Beginning and end of the path.
    ends: [f64; 2],
    /// Base pitch.
    pitch: f64,
}

/// Error for `teeth` with a profile `shift` that their cutter undercuts, at a pressure `angle` \[rad\].
fn require_no_undercut(teeth: [u32; 2], shift: [f64; 2], angle: f64) -> Result<(), String> {
    for (z, x) in teeth.into_iter().zip(shift) {
        let least = 1.0 - 0.5 * f64::from(z) * angle.sin().powi(2);
        if z < FEWEST_TEETH {
            return Err(format!("--teeth {z}: a gear needs at least {FEWEST_TEETH} teeth"));
        }
        if !(x >= least && x.is_finite()) {
            let [z1, z2] = teeth;
            return Err(format!(
                "--teeth {z1} {z2}: the gear of {z} teeth with the profile shift coefficient {x} undercuts; --shift must be at least \
                 {:.4} for it",
                (1e4 * least).ceil() * 1e-4
            ));
        }
    }
    Ok(())
}

impl Path {
    /// That of the options.
    fn of(options: &Options) -> Result<Self, Box<dyn Error>> {
        let module = length("--module", &options.module)?;
        let Some([z1, z2]) = options.teeth.as_deref().and_then(|teeth| <[u32; 2]>::try_from(teeth).ok())
        else {
            return Err("--teeth is missing".into());
        };
        let angle = match &options.pressure_angle {
            Some(text) => output::quantity(Dimension::Angle, "--pressure-angle", text)?,
            None => 20_f64.to_radians(),
        };
        let angle = output::require(
            angle > 0.0 && angle < 0.7,
            "--pressure-angle",
            angle,
            "above 0 and below 0.7 rad (40 deg)",
        )?;
        let shift =
            options.shift.as_deref().and_then(|shift| <[f64; 2]>::try_from(shift).ok()).unwrap_or([0.0; 2]);
        require_no_undercut([z1, z2], shift, angle)?;
        let teeth = [f64::from(z1), f64::from(z2)];
        let sum = teeth[0] + teeth[1];
        let reference = 0.5 * module * sum;
        let centre = match &options.centre_distance {
            Some(_) => length("--centre-distance", &options.centre_distance)?,
            None => reference * angle.cos() / working_angle(angle, (shift[0] + shift[1]) / sum).cos(),
        };
        let cosine = reference * angle.cos() / centre;
        if cosine >= 1.0 {
            return Err(format!(
                "--centre-distance = {centre} m: must be more than the sum of the base radii, {:.6} m",
                centre * cosine
            )
            .into());
        }
        // The tips are cut so that the clearance is kept.
        let cut = (shift[0] + shift[1] - (centre - reference) / module).max(0.0);
        let tip = [0, 1].map(|k| module * (0.5 * teeth[k] + 1.0 + shift[k] - cut));
        let base = teeth.map(|z| 0.5 * module * z * angle.cos());
        let line = centre * (1.0 - cosine * cosine).sqrt();
        let reach = [0, 1].map(|k| (tip[k] * tip[k] - base[k] * base[k]).max(0.0).sqrt());
        let (ends, pitch) = ([line - reach[1], reach[0]], PI * module * angle.cos());
        if ends[0] <= 0.0 || ends[1] >= line {
            return Err(format!(
                "--teeth {z1} {z2}: the path of contact from {:.4e} to {:.4e} m reaches below a base circle (0 to {line:.4e} m): the \
                 gear undercuts; take more teeth, more shift or another centre distance",
                ends[0], ends[1]
            )
            .into());
        }
        let ratio = (ends[1] - ends[0]) / pitch;
        if ratio <= 0.0 {
            return Err(format!(
                "--centre-distance = {centre} m: the teeth do not reach each other; {:.6} m is without profile shift",
                reference
            )
            .into());
        }
        if ratio < 1.0 {
            return Err(format!(
                "--teeth {z1} {z2}: the contact ratio is {ratio:.3}, it must be at least 1; take more teeth, less --shift or a smaller \
                 --centre-distance"
            )
            .into());
        }
        Ok(Self { base, line, ends, pitch })
    }

    /// Share of the load at the place `s`.
    fn share(&self, s: f64, sharing: Sharing) -> f64 {
        let [a, e] = self.ends;
        let [b, d] = [e - self.pitch, a + self.pitch];
        let outer = if s < b {
            (s - a) / (b - a)
        } else if s > d {
            (e - s) / (e - d)
        } else {
            return 1.0;
        };
        match sharing {
            Sharing::Trapezoid => (1.0 + outer) / 3.0,
            Sharing::Half => 0.5,
        }
    }
}

/// The working pressure angle of `inv a_w = inv a + 2 x tan a` with the shift `x` per tooth of both gears.
fn working_angle(angle: f64, shift: f64) -> f64 {
    let target = angle.tan() - angle + 2.0 * shift * angle.tan();
    // Newton's method; the derivative of tan a - a is tan^2 a.
    (0..50).fold(angle, |a, _| a - (a.tan() - a - target) / a.tan().powi(2))
}

/// The gear over one mesh of a pair of teeth.
pub(super) fn machine(options: &Options) -> Result<Machine, Box<dyn Error>> {
    let path = Path::of(options)?;
    let width = length("--face-width", &options.face_width)?;
    let torque = number("--torque", options.torque)?;
    let turns = number("--rotation", options.rotation)? / 60.0;
    let [w1, w2] = [TAU * turns, TAU * turns * path.base[0] / path.base[1]];
    let places: Vec<f64> = (0..=ROWS)
        .map(|k| path.ends[0] + (path.ends[1] - path.ends[0]) * f64::from(k) / f64::from(ROWS))
        .collect();
    let sharing = options.load_sharing.unwrap_or(Sharing::Trapezoid);
    let load = torque / (path.base[0] * width);
    let of = |value: &dyn Fn(f64) -> f64| places.iter().map(|s| value(*s)).collect::<Vec<f64>>();
    Ok(Machine {
        title: format!(
            "Flanks of a spur gear over one mesh, contact ratio {:.3}: load {load:.4e} N/m",
            (path.ends[1] - path.ends[0]) / path.pitch
        ),
        bodies: ["pinion", "wheel"],
        is_line: true,
        reverses: false,
        key: "once = true # a pair of teeth comes into mesh with a steady film".to_owned(),
        places: ("time", of(&|s| (s - path.ends[0]) / (w1 * path.base[0]))),
        loads: of(&|s| load * path.share(s, sharing)),
        speeds: [of(&|s| w1 * s), of(&|s| w2 * (path.line - s))],
        radii: of(&|s| s * (path.line - s) / path.line),
    })
}
