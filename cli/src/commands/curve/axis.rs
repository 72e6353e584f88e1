//! The quantity that a curve is over, and its values.

use std::error::Error;

use stribeck::InputError;
use stribeck::sim::Conditions;
use stribeck::sim::scene::{Load, Scene};
use stribeck::units::Dimension;

use super::{Options, speeds};
use crate::output;

/// Lowest load over that of the scene, the highest.
const LEAST_LOAD: f64 = 0.1;
/// Temperatures of the viscosity index \[K\].
pub(super) const TEMPERATURES: [f64; 2] = [313.15, 373.15];
/// Slide-roll ratios of a traction curve.
const RATIOS: [f64; 2] = [0.0, 0.5];

/// The quantity that a curve is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
pub(crate) enum Axis {
    /// Entrainment speed: the Stribeck curve
    Speed,
    /// Slide-roll ratio: the traction curve
    SlideRollRatio,
    /// Load
    Load,
    /// Bulk temperature
    Temperature,
}

impl Axis {
    /// Ending of the names of files.
    pub(super) fn file_ending(self) -> &'static str {
        match self {
            Self::Speed => "curve",
            Self::SlideRollRatio => "curve_slide_roll_ratio",
            Self::Load => "curve_load",
            Self::Temperature => "curve_temperature",
        }
    }

    /// Title of the picture before the name of the scene.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Speed => "Stribeck curve of",
            Self::SlideRollRatio => "Traction curve of",
            Self::Load => "Curve over load of",
            Self::Temperature => "Curve over temperature of",
        }
    }

    /// Plural of its values.
    pub(super) fn values(self) -> &'static str {
        match self {
            Self::Speed => "speeds",
            Self::SlideRollRatio => "slide-roll ratios",
            Self::Load => "loads",
            Self::Temperature => "temperatures",
        }
    }

    /// Heading of its column in files, in SI units.
    pub(super) fn column(self, line: bool) -> &'static str {
        match (self, line) {
            (Self::Speed, _) => "motion_entrainment_speed_m_s",
            (Self::SlideRollRatio, _) => "motion_slide_roll_ratio",
            (Self::Load, false) => "load_N",
            (Self::Load, true) => "load_N_m",
            (Self::Temperature, _) => "bulk_temperature_K",
        }
    }

    /// Heading in the table on the terminal.
    pub(super) fn heading(self, line: bool) -> &'static str {
        match (self, line) {
            (Self::Speed, _) => "speed, m/s",
            (Self::SlideRollRatio, _) => "slide/roll",
            (Self::Load, false) => "load, N",
            (Self::Load, true) => "load, N/m",
            (Self::Temperature, _) => "T, degC",
        }
    }

    /// Label in the picture.
    pub(super) fn label(self, line: bool) -> &'static str {
        match (self, line) {
            (Self::Speed, _) => "entrainment speed (m/s)",
            (Self::SlideRollRatio, _) => "slide-roll ratio",
            (Self::Load, false) => "load (N)",
            (Self::Load, true) => "load (N/m)",
            (Self::Temperature, _) => "bulk temperature (\u{b0}C)",
        }
    }

    /// Label in the picture of a rigid bearing, one surface of which moves.
    pub(super) fn bearing_label(self, is_wide: bool) -> &'static str {
        if self == Self::Speed { "speed of the moving surface (m/s)" } else { self.label(is_wide) }
    }

    /// Whether values are spread over their logarithms.
    pub(super) fn is_logarithmic(self) -> bool {
        matches!(self, Self::Speed | Self::Load)
    }

    /// The value in the unit of the table and the picture.
    pub(super) fn shown(self, value: f64) -> f64 {
        if self == Self::Temperature { value - 273.15 } else { value }
    }

    /// A cell of the table on the terminal.
    pub(super) fn cell(self, value: f64) -> String {
        let shown = self.shown(value);
        if self.is_logarithmic() { format!("{:>11}", output::digits(shown)) } else { format!("{shown:11.4}") }
    }

    /// The value in messages.
    pub(super) fn words(self, value: f64, line: bool) -> String {
        match (self, line) {
            (Self::Speed, _) => format!("{} m/s", output::digits(value)),
            (Self::SlideRollRatio, _) => format!("a slide-roll ratio of {value:.4}"),
            (Self::Load, false) => format!("{} N", output::digits(value)),
            (Self::Load, true) => format!("{} N/m", output::digits(value)),
            (Self::Temperature, _) => format!("{:.2} degC", self.shown(value)),
        }
    }

    fn dimension(self, line: bool) -> Dimension {
        match (self, line) {
            (Self::Speed, _) => Dimension::Speed,
            (Self::SlideRollRatio, _) => Dimension::Ratio,
            (Self::Load, false) => Dimension::Force,
            (Self::Load, true) => Dimension::ForcePerLength,
            (Self::Temperature, _) => Dimension::Temperature,
        }
    }

    /// Sets the quantity of `scene` and `conditions` to `value`.
    pub(super) fn set(self, scene: &mut Scene, conditions: &mut Conditions, value: f64) {
        match self {
            Self::Speed => {
                conditions.motion.entrainment_speed = value;
                scene.motion.entrainment_speed = value;
                scene.schedule.entrainment_speed = None;
            }
            Self::SlideRollRatio => {
                conditions.motion.slide_roll_ratio = value;
                scene.motion.slide_roll_ratio = value;
                scene.schedule.slide_roll_ratio = None;
            }
            Self::Load => {
                conditions.load = value;
                (scene.load, scene.schedule.load) = (Load::force(value), None);
            }
            Self::Temperature => {
                conditions.bulk_temperature = value;
                (scene.thermal.bulk_temperature, scene.schedule.bulk_temperature) = (value, None);
            }
        }
    }

    /// The values of the options, between `usual` ones by default.
    pub(super) fn spread(
        self,
        options: &Options,
        line: bool,
        [low, high]: [f64; 2],
    ) -> Result<Vec<f64>, Box<dyn Error>> {
        let given = |option: &str, text: &Option<String>| {
            text.as_deref().map(|text| self.parse(line, option, text)).transpose()
        };
        let from = given("--from", &options.from)?.unwrap_or(low);
        let to = given("--to", &options.to)?.unwrap_or(high);
        if to <= from {
            let unit = self.dimension(line).unit_names().next().filter(|_| self != Self::SlideRollRatio);
            let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
            return Err(format!("--to = {to}{unit} must be above --from = {from}{unit}").into());
        }
        let last = f64::from(options.points - 1);
        let at = |k: u32| match f64::from(k) / last {
            share if self.is_logarithmic() => from * (to / from).powf(share),
            share => from + (to - from) * share,
        };
        Ok((0..options.points).map(at).collect())
    }

    /// The value of an option.
    fn parse(self, line: bool, option: &str, text: &str) -> Result<f64, InputError> {
        match self {
            Self::SlideRollRatio => output::ratio(option, text),
            _ => output::positive(self.dimension(line), option, text),
        }
    }
}

/// The conditions at the start of the schedule of a lubricated contact.
pub(super) fn start(options: &Options, scene: &Scene) -> Result<Conditions, Box<dyn Error>> {
    let in_scene = |error: InputError| output::in_scene(&options.scene, &error);
    if !scene.is_lubricated() {
        return Err(in_scene(InputError::Conflict {
            field: "lubricant".to_owned(),
            reason: "a Stribeck curve needs an oil, this contact is dry".to_owned(),
        })
        .into());
    }
    let conditions = scene.conditions(0.0).map_err(in_scene)?;
    // The speed of the scene is checked even where other speeds are given.
    let (field, speed) = ("motion.entrainment_speed", conditions.motion.entrainment_speed);
    output::require(speed >= 0.0, field, speed, "finite and >= 0: the oil flows along +x")
        .map_err(in_scene)?;
    if options.over == Axis::Temperature && !follows_temperature(scene)? {
        return Err(in_scene(InputError::Conflict {
            field: "--over temperature".to_owned(),
            reason: "the viscosity of this oil is the same at all temperatures; give lubricant.grade or kinematic, or \
                     lubricant.temperature and roelands_s0"
                .to_owned(),
        })
        .into());
    }
    Ok(conditions)
}

/// Whether the viscosity depends on temperature.
fn follows_temperature(scene: &Scene) -> Result<bool, InputError> {
    let mut viscosities = [0.0; 2];
    for (viscosity, temperature) in viscosities.iter_mut().zip(TEMPERATURES) {
        let mut scene = scene.clone();
        (scene.thermal.bulk_temperature, scene.schedule.bulk_temperature) = (temperature, None);
        *viscosity = scene.oil_numbers()?.map_or(0.0, |oil| oil.eta0);
    }
    Ok(viscosities[0] > viscosities[1])
}

/// The values of the curve, about the `own` conditions of the scene, in SI units.
pub(super) fn values(options: &Options, scene: &Scene, own: &Conditions) -> Result<Vec<f64>, Box<dyn Error>> {
    let (axis, line) = (options.over, scene.form.is_line());
    let usual = match axis {
        Axis::Speed => {
            let own = own.motion.entrainment_speed;
            if options.from.is_some() && options.to.is_some() {
                return axis.spread(options, line, [own; 2]);
            }
            output::require(own > 0.0, "motion.entrainment_speed", own, "finite and > 0")
                .map_err(|error| output::in_scene(&options.scene, &error))?;
            speeds::usual(scene, own).map_err(|error| output::in_scene(&options.scene, &error))?
        }
        Axis::SlideRollRatio => RATIOS,
        Axis::Load => [LEAST_LOAD * own.load, own.load],
        Axis::Temperature => TEMPERATURES,
    };
    axis.spread(options, line, usual)
}
