//! The options `--quick` and `--out` of examples and studies.

use std::path::PathBuf;

use lexopt::prelude::*;

pub(crate) struct Options {
    pub(crate) quick: bool,
    pub(crate) out: PathBuf,
}

/// `--quick` and `--out DIR`, by default the folder `out`; none where the usage is asked for.
pub(crate) fn options(out: &str) -> Result<Option<Options>, lexopt::Error> {
    let mut options = Options { quick: false, out: PathBuf::from(out) };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(options))
}
