//! Cases as TOML files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::case::{Case, History};
use super::limits::{Limits, Quantity};
use crate::sim::{Scene, SimError};
use crate::text_file;

/// The whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseFile {
    case: Vec<CaseTable>,
}

/// A table `[[case]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseTable {
    name: String,
    scene: PathBuf,
    #[serde(default)]
    tags: Vec<String>,
    #[serde(default)]
    parameters: BTreeMap<String, f64>,
    history: Option<HistoryTable>,
    reference: Option<ReferenceTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HistoryTable {
    contacts: u32,
    time_step: f64,
    #[serde(default)]
    is_transient: bool,
}

/// Limits with their uncertainties.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceTable {
    scene: String,
    central_film: Option<[f64; 2]>,
    minimum_film: Option<[f64; 2]>,
    mean_film: Option<[f64; 2]>,
    area_ratio: Option<[f64; 2]>,
    load_ratio: Option<[f64; 2]>,
    friction: Option<[f64; 2]>,
}

impl ReferenceTable {
    fn limits(self) -> Limits {
        let values = [
            self.central_film,
            self.minimum_film,
            self.mean_film,
            self.area_ratio,
            self.load_ratio,
            self.friction,
        ];
        let known =
            Quantity::ALL.into_iter().zip(values).filter_map(|(quantity, value)| Some((quantity, value?)));
        known.fold(Limits::of_fingerprint(self.scene), |limits, (quantity, [value, uncertainty])| {
            limits.with(quantity, value, uncertainty)
        })
    }
}

/// The cases of the file at `path`.
pub(super) fn load(path: &Path) -> Result<Vec<Case>, SimError> {
    let text = text_file::read(path).map_err(|source| SimError::Io { path: path.to_owned(), source })?;
    let file: CaseFile = toml::from_str(&text).map_err(|error| {
        let line =
            error.span().map_or(1, |span| 1 + text[..span.start.min(text.len())].matches('\n').count());
        let message = error.message().lines().collect::<Vec<_>>().join(" ");
        SimError::Scene { reason: format!("{}: line {line}: {message}", path.display()) }
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    file.case.into_iter().map(|table| case(table, folder)).collect()
}

fn case(table: CaseTable, folder: &Path) -> Result<Case, SimError> {
    let CaseTable { name, scene, tags, parameters, history, reference } = table;
    let path = folder.join(&scene);
    let scene = Scene::load(&path).map_err(|error| {
        let reason = match &error {
            SimError::Io { .. } => format!("case `{name}`: {error}"),
            _ => format!("case `{name}`: {}: {error}", path.display()),
        };
        SimError::Scene { reason }
    })?;
    let history = history.map(|table| {
        let HistoryTable { contacts, time_step, is_transient } = table;
        History { is_transient, ..History::new(contacts, time_step) }
    });
    Ok(Case::new(name, scene)
        .with_tags(tags)
        .with_parameters(parameters.into_iter().collect())
        .with_history(history)
        .with_reference(reference.map(ReferenceTable::limits)))
}
