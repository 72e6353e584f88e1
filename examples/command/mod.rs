//! What examples with options do around their work. Shared by them.

use std::error::Error;
use std::process::ExitCode;

/// Runs `work` as the options ask; prints the usage where they ask for none, and errors by the `name` of the
/// example.
pub(crate) fn run<O>(
    name: &str,
    usage: &str,
    options: Result<Option<O>, lexopt::Error>,
    work: impl FnOnce(&O) -> Result<(), Box<dyn Error>>,
) -> ExitCode {
    let outcome = match options {
        Ok(Some(options)) => work(&options),
        Ok(None) => {
            print!("{usage}");
            Ok(())
        }
        Err(error) => Err(format!("{error}\n{usage}").into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{name}: {error}");
            ExitCode::FAILURE
        }
    }
}
