//! Input of the user: options, or answers to questions on the terminal.

use std::error::Error;
use std::io::{self, BufRead, Write};
use std::path::Path;

use stribeck::sim::scene::{Load, LubricantSpec, Roughness};
use stribeck::sim::{Scene, Warning};
use stribeck::surface::Form;
use stribeck::units::Dimension;

use super::Options;
use super::disc::{Disc, Finish, Measured};
use super::quantity::Quantity;
use crate::output;

/// A question, the option that answers it, its default and its dimension.
type Question = (&'static str, &'static str, &'static str, Dimension);

const RADIUS: Question = ("Radius of the ball", "--radius", "9.525 mm", Dimension::Length);
const LOAD: Question = ("Load", "--load", "20 N", Dimension::Force);
const ETA0: Question = ("Viscosity of the oil", "--eta0", "10 mPa s", Dimension::Viscosity);
const ALPHA: Question =
    ("Pressure-viscosity coefficient of the oil", "--alpha", "18 1/GPa", Dimension::InversePressure);
const SPEED: Question = ("Mean speed of the surfaces", "--speed", "0.5 m/s", Dimension::Speed);
/// Keys of the roughness, the question for it and its default.
const RQ: &str = "--roughness";
const LENGTH: &str = "--length";
const DISC: &str = "Disc: ground, honed, superfinished or polished, its root mean square height (0: smooth), or a file of heights";
const SMOOTH: &str = "0";

/// Values of a new scene.
pub(super) struct Answers {
    pub(super) radius: Quantity,
    pub(super) load: Quantity,
    pub(super) eta0: Quantity,
    pub(super) alpha: Quantity,
    pub(super) speed: Quantity,
    pub(super) slide_roll_ratio: f64,
    pub(super) disc: Disc,
}

/// The values of the options, and defaults for the rest; with `ask` the answers to questions, which offer those of
/// `before`.
pub(super) fn answers(
    options: &Options,
    ask: bool,
    before: Option<&Answers>,
) -> Result<Answers, Box<dyn Error>> {
    let quantity = |(question, key, default, dimension): Question,
                    option: &Option<String>,
                    last: fn(&Answers) -> &Quantity| {
        let take = |text: String| checked(key, dimension, &text).map(|value| Quantity { text, value });
        match option {
            Some(text) => take(text.clone()),
            None if ask => asked(question, before.map_or(default, |answers| &last(answers).text), take),
            None => take(default.to_owned()),
        }
    };
    let (o, ratio) = (options, |text: String| Ok(output::ratio("--slide-roll-ratio", &text)?));
    let radius = quantity(RADIUS, &o.radius, |answers| &answers.radius)?;
    let load = quantity(LOAD, &o.load, |answers| &answers.load)?;
    let eta0 = quantity(ETA0, &o.eta0, |answers| &answers.eta0)?;
    let alpha = quantity(ALPHA, &o.alpha, |answers| &answers.alpha)?;
    let speed = quantity(SPEED, &o.speed, |answers| &answers.speed)?;
    let last = before.map_or_else(|| "0.1".to_owned(), |answers| answers.slide_roll_ratio.to_string());
    let slide_roll_ratio = match o.slide_roll_ratio {
        Some(ratio) => ratio,
        None if ask => asked("Sliding speed over mean speed", &last, ratio)?,
        None => ratio(last)?,
    };
    let disc = match disc(options)? {
        Some(disc) => disc,
        None if ask => asked(DISC, SMOOTH, disc_of_answer)?,
        None => Disc::Smooth,
    };
    Ok(Answers { radius, load, eta0, alpha, speed, slide_roll_ratio, disc })
}

/// Viscosity and pressure-viscosity coefficient of the options, or the usual ones.
pub(super) fn oil(options: &Options) -> Result<[Quantity; 2], Box<dyn Error>> {
    let quantity = |(_, key, default, dimension): Question, option: &Option<String>| {
        let text = option.clone().unwrap_or_else(|| default.to_owned());
        checked(key, dimension, &text).map(|value| Quantity { text, value })
    };
    Ok([quantity(ETA0, &options.eta0)?, quantity(ALPHA, &options.alpha)?])
}

/// The disc that the options describe; `None` without such an option.
pub(super) fn disc(options: &Options) -> Result<Option<Disc>, Box<dyn Error>> {
    Ok(Some(match (&options.roughness, options.finish, &options.surface) {
        (Some(rq), ..) => {
            let rq = height(rq)?;
            match &options.length {
                _ if rq.value == 0.0 => Disc::Smooth,
                Some(length) => Disc::Random(rq, correlation_length(length)?),
                None => {
                    return Err(format!(
                        "{RQ} = {}: {LENGTH} is missing, the correlation length of the heights; or take a --finish",
                        rq.text
                    )
                    .into());
                }
            }
        }
        (None, Some(finish), _) => Disc::Finish(finish),
        (None, None, Some(file)) => Disc::Measured(Measured::read(file)?),
        (None, None, None) => return Ok(None),
    }))
}

/// The disc that an answer describes; of a height the correlation length is asked for.
fn disc_of_answer(text: String) -> Result<Disc, Box<dyn Error>> {
    if let Some(finish) = Finish::named(&text) {
        return Ok(Disc::Finish(finish));
    }
    if Path::new(&text).is_file() {
        return Ok(Disc::Measured(Measured::read(Path::new(&text))?));
    }
    let rq = height(&text)?;
    if rq.value == 0.0 {
        return Ok(Disc::Smooth);
    }
    let length = asked("Correlation length of the heights", "10 um", |text| correlation_length(&text))?;
    Ok(Disc::Random(rq, length))
}

/// A root mean square height, zero or more.
fn height(text: &str) -> Result<Quantity, Box<dyn Error>> {
    checked(RQ, Dimension::Length, text).map(|value| Quantity { text: text.to_owned(), value })
}

/// A correlation length.
fn correlation_length(text: &str) -> Result<Quantity, Box<dyn Error>> {
    let value = output::positive(Dimension::Length, LENGTH, text)?;
    Ok(Quantity { text: text.to_owned(), value })
}

/// The value in `text` of the option `key`, refused where it is rather that of another unit.
fn checked(key: &str, dimension: Dimension, text: &str) -> Result<f64, Box<dyn Error>> {
    let value = if key == RQ {
        let value = output::quantity(dimension, key, text)?;
        output::require(value >= 0.0, key, value, "finite and >= 0, such as \"50 nm\"")?
    } else {
        output::positive(dimension, key, text)?
    };
    match implausible(key, value) {
        None => Ok(value),
        Some(warning) => Err(format!("{key} = {text}: {}; {}", warning.message, warning.remedy).into()),
    }
}

/// The warning of a scene that has this value alone.
fn implausible(key: &str, value: f64) -> Option<Warning> {
    let mut scene = Scene::azam_2019(16);
    let oil = LubricantSpec::roelands(0.01, 0.68);
    let field = match key {
        "--radius" => {
            scene.form = Form::Sphere { radius: value };
            "form.radius"
        }
        "--load" => {
            scene.load = Load::force(value);
            "load.force"
        }
        "--eta0" => {
            scene.lubricant = Some(oil.with_eta0(value));
            "lubricant.eta0"
        }
        "--alpha" => {
            scene.lubricant = Some(oil.with_alpha(Some(value)));
            "lubricant.alpha"
        }
        "--speed" => {
            scene.motion.entrainment_speed = value;
            "motion.entrainment_speed"
        }
        _ => {
            scene.roughness.disc = Roughness::gaussian(value, 1e-4, 1);
            "roughness.disc.rq"
        }
    };
    let warnings = scene.warnings().into_iter();
    warnings
        .filter(|warning| warning.remedy.starts_with("did you mean"))
        .find(|warning| warning.field == field)
}

/// The answer to a question on the terminal, asked again until `take` takes it; an empty one is the default.
fn asked<T>(
    question: &str,
    default: &str,
    take: impl Fn(String) -> Result<T, Box<dyn Error>>,
) -> Result<T, Box<dyn Error>> {
    loop {
        write!(io::stderr(), "{question} [{default}]: ")?;
        let mut line = String::new();
        if io::stdin().lock().read_line(&mut line)? == 0 {
            return Err("the answers end before the last question".into());
        }
        let answer = line.trim();
        match take(if answer.is_empty() { default } else { answer }.to_owned()) {
            Ok(taken) => return Ok(taken),
            Err(error) => output::complain("error", &error.to_string()),
        }
    }
}
