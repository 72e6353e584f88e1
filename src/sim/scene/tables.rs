//! What the derived readers are too lenient for. Tables whose keys depend on `kind` are read flat: derived
//! enums would take stray keys of a unit variant and lose the key of a value that does not fit.

use std::path::PathBuf;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::{GridSpec, Schedule};
use crate::surface::Form;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FormTable {
    kind: FormKind,
    radius: Option<f64>,
    radius_x: Option<f64>,
    radius_y: Option<f64>,
    angle: Option<f64>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum FormKind {
    Sphere,
    Ellipsoid,
    Cylinder,
}

pub(super) fn form<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Form, D::Error> {
    let table = FormTable::deserialize(deserializer)?;
    let given = [
        ("radius", table.radius.is_some()),
        ("radius_x", table.radius_x.is_some()),
        ("radius_y", table.radius_y.is_some()),
        ("angle", table.angle.is_some()),
    ];
    match table.kind {
        FormKind::Sphere => refuse_strays("kind = \"sphere\"", &given, &["radius"])
            .and_then(|()| Ok(Form::Sphere { radius: required("radius", table.radius)? })),
        FormKind::Cylinder => refuse_strays("kind = \"cylinder\"", &given, &["radius"])
            .and_then(|()| Ok(Form::Cylinder { radius: required("radius", table.radius)? })),
        FormKind::Ellipsoid => {
            refuse_strays("kind = \"ellipsoid\"", &given, &["radius_x", "radius_y", "angle"]).and_then(|()| {
                Ok(Form::Ellipsoid {
                    radius_x: required("radius_x", table.radius_x)?,
                    radius_y: required("radius_y", table.radius_y)?,
                    angle: table.angle.unwrap_or_default(),
                })
            })
        }
    }
    .map_err(D::Error::custom)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GridTable {
    nx: Option<usize>,
    ny: Option<usize>,
    #[serde(default, deserialize_with = "edges")]
    x: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "edges")]
    y: Option<[f64; 2]>,
    accuracy: Option<f64>,
}

pub(super) fn grid<'de, D: Deserializer<'de>>(deserializer: D) -> Result<GridSpec, D::Error> {
    GridTable::deserialize(deserializer)?.into_spec().map_err(D::Error::custom)
}

impl GridTable {
    fn into_spec(self) -> Result<GridSpec, String> {
        let Self { nx, ny, x, y, accuracy } = self;
        if let Some(accuracy) = accuracy {
            let given = [("nx", nx.is_some()), ("ny", ny.is_some()), ("x", x.is_some()), ("y", y.is_some())];
            return match given.iter().find(|(_, present)| *present) {
                Some((key, _)) => {
                    Err(format!("`accuracy` stands in place of nx, ny, x and y, not with `{key}`"))
                }
                None => Ok(GridSpec::Accuracy { accuracy }),
            };
        }
        let (nx, x) = (required("nx", nx)?, required("x", x)?);
        if ny.is_none() && y.is_none() {
            return Ok(GridSpec::Row { nx, x });
        }
        Ok(GridSpec::Cells { nx, ny: required("ny", ny)?, x, y: required("y", y)? })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ScheduleTable {
    kind: ScheduleKind,
    value: Option<f64>,
    times: Option<Vec<f64>>,
    values: Option<Vec<f64>>,
    path: Option<PathBuf>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum ScheduleKind {
    Constant,
    Steps,
    Ramps,
    Table,
}

impl TryFrom<ScheduleTable> for Schedule {
    type Error = String;

    fn try_from(table: ScheduleTable) -> Result<Self, String> {
        let given = [
            ("value", table.value.is_some()),
            ("times", table.times.is_some()),
            ("values", table.values.is_some()),
            ("path", table.path.is_some()),
        ];
        Ok(match table.kind {
            ScheduleKind::Constant => {
                refuse_strays("kind = \"constant\"", &given, &["value"])?;
                Self::Constant { value: required("value", table.value)? }
            }
            ScheduleKind::Steps => {
                refuse_strays("kind = \"steps\"", &given, &["times", "values"])?;
                Self::Steps {
                    times: required("times", table.times)?,
                    values: required("values", table.values)?,
                }
            }
            ScheduleKind::Ramps => {
                refuse_strays("kind = \"ramps\"", &given, &["times", "values"])?;
                Self::Ramps {
                    times: required("times", table.times)?,
                    values: required("values", table.values)?,
                }
            }
            ScheduleKind::Table => {
                refuse_strays("kind = \"table\"", &given, &["path"])?;
                Self::Table { path: required("path", table.path)? }
            }
        })
    }
}

/// Exactly two numbers: the parser would drop further ones in silence.
fn edges<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 2]>, D::Error> {
    let edges = Vec::<f64>::deserialize(deserializer)?;
    <[f64; 2]>::try_from(edges.as_slice())
        .map(Some)
        .map_err(|_| D::Error::invalid_length(edges.len(), &"the two outer edges"))
}

/// The key and whether the file has it.
pub(super) fn given<'a, T>(key: &'a str, value: &Option<T>) -> (&'a str, bool) {
    (key, value.is_some())
}

/// Error for a key of `given` that is none of `known`, those of a table with the `tag`.
pub(super) fn refuse_strays(tag: &str, given: &[(&str, bool)], known: &[&str]) -> Result<(), String> {
    match given.iter().find(|(key, present)| *present && !known.contains(key)) {
        None => Ok(()),
        Some((key, _)) => Err(match known {
            [] => format!("unknown field `{key}`, {tag} has no other fields"),
            _ => format!("unknown field `{key}`, {tag} has `{}`", known.join("`, `")),
        }),
    }
}

pub(super) fn required<T>(key: &str, value: Option<T>) -> Result<T, String> {
    value.ok_or_else(|| format!("missing field `{key}`"))
}

/// Seeds have 64 bits, integers of TOML 63: larger ones are written as text.
pub(super) mod seed {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Seed {
        Number(u64),
        Text(String),
    }

    pub(in super::super) fn serialize<S: Serializer>(seed: &u64, serializer: S) -> Result<S::Ok, S::Error> {
        match i64::try_from(*seed) {
            Ok(_) => serializer.serialize_u64(*seed),
            Err(_) => serializer.serialize_str(&seed.to_string()),
        }
    }

    pub(in super::super) fn serialize_optional<S: Serializer>(
        seed: &Option<u64>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match seed {
            Some(seed) => serialize(seed, serializer),
            None => serializer.serialize_none(),
        }
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
        match Seed::deserialize(deserializer) {
            Ok(Seed::Number(number)) => Ok(number),
            Ok(Seed::Text(text)) => text.parse().map_err(D::Error::custom),
            Err(_) => Err(D::Error::custom("invalid seed, expected a whole number from 0 to 2^64 - 1")),
        }
    }

    pub(in super::super) fn optional<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<u64>, D::Error> {
        deserialize(deserializer).map(Some)
    }
}
