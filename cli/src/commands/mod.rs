//! The subcommands, one a file.

pub(crate) mod benchmark;
pub(crate) mod check;
pub(crate) mod completion;
mod contact_pictures;
pub(crate) mod curve;
pub(crate) mod cycle;
pub(crate) mod explain;
pub(crate) mod init;
pub(crate) mod man;
pub(crate) mod run;
pub(crate) mod solve;
mod strip_sample;
pub(crate) mod surface;
pub(crate) mod sweep;
