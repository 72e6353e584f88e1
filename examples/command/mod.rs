//! Help, errors and exit codes of examples and studies.

use std::error::Error;
use std::process::ExitCode;

use stribeck::NotConverged;
use stribeck::sim::SimError;

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
            exit_code(error.as_ref())
        }
    }
}

/// 1 where a contact did not converge, 2 for bad input and files.
fn exit_code(error: &(dyn Error + 'static)) -> ExitCode {
    let history = matches!(error.downcast_ref(), Some(SimError::NotConverged { .. }));
    ExitCode::from(if history || error.is::<NotConverged>() { 1 } else { 2 })
}
