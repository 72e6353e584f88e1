//! Do the estimated errors of contacts hold?
//!
//! ```text
//! cargo run --release -p studies --bin error_estimate -- smooth  # `grid.accuracy` of smooth full films, three minutes
//! cargo run --release -p studies --bin error_estimate -- rough   # `solver.estimate` of rough contacts, a quarter of an hour
//! ```
//!
//! Prints one row per contact, true error and estimate of each number in per cent, and how many estimates
//! hold.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
mod rough;
mod smooth;

use std::process::ExitCode;

use lexopt::prelude::*;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::{Error as ValueError, StringDeserializer};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin error_estimate -- smooth [--accuracy A] [--finest NODES]
       cargo run --release -p studies --bin error_estimate -- rough [--first N] [--scenes N] [--cells N] [--finer N] [--waves N]
                                                             [--face-mobility NAME] [--cavitation NAME]

smooth: Moes parameters M and L; films and maximum pressure against finer meshes and larger boxes
  --accuracy A          `grid.accuracy` (default 0.02)
  --finest NODES        larger meshes are left out (default 300000)

rough: random mixed contacts; ratios, mean film and friction against a finer mesh
  --first N             number of the first contact (default 1)
  --scenes N            how many (default 20)
  --cells N             cells along each side (default 64)
  --finer N             cells of the reference over these (default 4)
  --waves N             cells along each side on which the surfaces are generated, whose shortest waves are two of them (default
                        half of the cells)
  --face-mobility NAME  as in a scene file (default: that of scenes)
  --cavitation NAME     as in a scene file (default: that of scenes)
";

enum Study {
    Smooth { accuracy: f64, finest: usize },
    Rough(rough::Options),
}

fn main() -> ExitCode {
    command::run("error_estimate", USAGE, options(), |study| match study {
        Study::Smooth { accuracy, finest } => smooth::run(*accuracy, *finest),
        Study::Rough(options) => rough::run(options),
    })
}

fn options() -> Result<Option<Study>, lexopt::Error> {
    let mut parser = lexopt::Parser::from_env();
    let (mut kind, mut accuracy, mut finest) = (None, 0.02, 300_000);
    let mut rough = rough::Options::default();
    while let Some(argument) = parser.next()? {
        match argument {
            Value(name) if kind.is_none() => kind = Some(name.string()?),
            Long("accuracy") => accuracy = parser.value()?.parse()?,
            Long("finest") => finest = parser.value()?.parse()?,
            Long("first") => rough.first = parser.value()?.parse()?,
            Long("scenes") => rough.scenes = parser.value()?.parse()?,
            Long("cells") => rough.cells = parser.value()?.parse()?,
            Long("finer") => rough.finer = parser.value()?.parse()?,
            Long("waves") => rough.waves = Some(parser.value()?.parse()?),
            Long("face-mobility") => rough.face_mobility = Some(parser.value()?.parse_with(named)?),
            Long("cavitation") => rough.cavitation = Some(parser.value()?.parse_with(named)?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    match kind.as_deref() {
        Some("smooth") => Ok(Some(Study::Smooth { accuracy, finest })),
        Some("rough") => Ok(Some(Study::Rough(rough))),
        _ => Err("say `smooth` or `rough`".into()),
    }
}

/// A choice by its name in scene files.
fn named<T: for<'de> Deserialize<'de>>(name: &str) -> Result<T, ValueError> {
    let name: StringDeserializer<ValueError> = name.to_owned().into_deserializer();
    T::deserialize(name)
}
