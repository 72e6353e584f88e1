//! Ensembles over the processes of an MPI program.

use std::path::Path;

use mpi::traits::{Communicator, Root};

use super::{Member, Outcome, check_names, run_member, share};
use crate::error::InputError;
use crate::sim::error::SimError;
use crate::sim::history::record::StepRecord;

/// [`run_in`](super::run_in) over all ranks of `world`, each on `threads` threads. Rank `r` of `n` runs the
/// members `r`, `r + n`, ... All ranks return the outcomes of all members in order, the same for any number
/// of ranks; errors are [`SimError::Remote`] on all ranks. Ranks need not share folders, but without shared
/// folders a resumed run needs the same number of ranks.
///
/// Every rank calls this with the same members. A rank that panics ends the program.
///
/// # Errors
/// Those of [`run_in`](super::run_in).
pub fn run_over_ranks(
    world: &impl Communicator,
    folder: impl AsRef<Path>,
    members: &[Member],
    threads: usize,
    every: u64,
) -> Result<Vec<Outcome>, SimError> {
    let folder = folder.as_ref();
    check_names(members)?;
    let (rank, size) = (world.rank(), world.size());
    let owner = |k: usize| i32::try_from(k % size.max(1) as usize).unwrap_or(0);
    let own: Vec<Member> =
        members.iter().enumerate().filter(|(k, _)| owner(*k) == rank).map(|(_, m)| m.clone()).collect();
    let mut done = share(&own, threads, |member| written(&run_member(folder, member, every))).into_iter();
    let mut outcomes = Vec::with_capacity(members.len());
    for k in 0..members.len() {
        let mut text = if owner(k) == rank { done.next().unwrap_or_default() } else { Vec::new() };
        let root = world.process_at_rank(owner(k));
        let mut length = text.len() as u64;
        root.broadcast_into(&mut length);
        text.resize(length as usize, 0);
        root.broadcast_into(&mut text[..]);
        outcomes.push(read(&text, owner(k))?);
    }
    Ok(outcomes)
}

/// A line with the failure, empty without one, and a line per record.
fn written(outcome: &Outcome) -> Vec<u8> {
    let failure =
        outcome.failure.as_ref().map_or_else(String::new, |error| error.to_string().replace('\n', " "));
    let mut text = failure.into_bytes();
    text.push(b'\n');
    for record in &outcome.records {
        // Writing to memory cannot fail.
        let _ = record.write_csv(&mut text);
    }
    text
}

fn read(text: &[u8], rank: i32) -> Result<Outcome, SimError> {
    let text = std::str::from_utf8(text).map_err(|error| {
        SimError::Input(InputError::Conflict {
            field: format!("outcome of rank {rank}"),
            reason: error.to_string(),
        })
    })?;
    let mut lines = text.lines();
    let reason = lines.next().unwrap_or_default().to_owned();
    let records = lines.map(StepRecord::from_csv).collect::<Result<_, _>>()?;
    let failure = (!reason.is_empty()).then_some(SimError::Remote { rank, reason });
    Ok(Outcome { records, failure })
}
