//! Checks beyond derived readers. Tables whose keys depend on `kind` are read flat: derived enums would accept
//! unknown keys for a unit variant and lose the key of an invalid value.

use std::path::PathBuf;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::{GridSpec, Schedule};
use crate::surface::Form;

/// A table that is read flat. Fields before the semicolon belong to every kind or law; the keys after it belong to
/// some kinds, each an `Option`. The keys are listed only here.
macro_rules! keyed {
    ($(#[$meta:meta])* $vis:vis struct $name:ident {
        $($common:ident: $common_type:ty),+ ;
        $($(#[$of_key:meta])* $key:ident: $type:ty),+ $(,)?
    }) => {
        $(#[$meta])*
        #[serde(deny_unknown_fields)]
        $vis struct $name {
            $($common: $common_type,)+
            $($(#[$of_key])* #[serde(skip_serializing_if = "Option::is_none")] $key: Option<$type>,)+
        }

        impl $name {
            /// Error for a key that is not in `known`, the keys of a table with the `tag`.
            fn reject_unknown_fields(&self, tag: &str, known: &[&str]) -> Result<(), String> {
                let given = [$((stringify!($key), self.$key.is_some())),+];
                $crate::sim::scene::tables::reject_unknown_fields(tag, &given, known)
            }
        }
    };
}
pub(super) use keyed;

keyed! {
    /// `[form]` as written.
    #[derive(Deserialize)]
    struct FormTable {
        kind: FormKind;
        /// Radius of a ball or a cylinder \[m\].
        radius: f64,
        /// Radius of an ellipsoid along its first axis \[m\].
        radius_x: f64,
        /// Radius of an ellipsoid along its second axis \[m\].
        radius_y: f64,
        /// Radii of both bodies in place of `radius` \[m\]; that of a concave body is negative.
        radii: Vec<f64>,
        /// The same in place of `radius_x`.
        radii_x: Vec<f64>,
        /// The same in place of `radius_y`.
        radii_y: Vec<f64>,
        /// Angle from x to the first axis \[rad\].
        angle: f64,
    }
}

/// Values of `kind` in `[form]`.
#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum FormKind {
    Sphere,
    Ellipsoid,
    Cylinder,
}

/// Reads `[form]`; a radius that does not belong to the kind is an error.
pub(super) fn form<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Form, D::Error> {
    let table = FormTable::deserialize(deserializer)?;
    match table.kind {
        FormKind::Sphere => {
            table.reject_unknown_fields("kind = \"sphere\"", &["radius", "radii"]).and_then(|()| {
                Ok(Form::Sphere { radius: radius("radius", table.radius, "radii", table.radii)? })
            })
        }
        FormKind::Cylinder => {
            table.reject_unknown_fields("kind = \"cylinder\"", &["radius", "radii"]).and_then(|()| {
                Ok(Form::Cylinder { radius: radius("radius", table.radius, "radii", table.radii)? })
            })
        }
        FormKind::Ellipsoid => table
            .reject_unknown_fields(
                "kind = \"ellipsoid\"",
                &["radius_x", "radius_y", "radii_x", "radii_y", "angle"],
            )
            .and_then(|()| {
                Ok(Form::Ellipsoid {
                    radius_x: radius("radius_x", table.radius_x, "radii_x", table.radii_x)?,
                    radius_y: radius("radius_y", table.radius_y, "radii_y", table.radii_y)?,
                    angle: table.angle.unwrap_or_default(),
                })
            }),
    }
    .map_err(D::Error::custom)
}

/// The radius of a section: as given, or of a flat against which the gap is that between both bodies,
/// `1/R = 1/R_1 + 1/R_2`.
fn radius(key: &str, given: Option<f64>, pair_key: &str, pair: Option<Vec<f64>>) -> Result<f64, String> {
    let Some(pair) = pair else { return required(key, given) };
    if given.is_some() {
        return Err(format!("`{pair_key}` replaces `{key}`; give only one"));
    }
    let [first, second] = *pair.as_slice() else {
        return Err(format!("`{pair_key}` has {} values, expected the radii of both bodies", pair.len()));
    };
    let curvature = 1.0 / first + 1.0 / second;
    if first == 0.0 || second == 0.0 || !(curvature > 0.0 && curvature.is_finite()) {
        return Err(format!(
            "`{pair_key}` = [{first:e}, {second:e}] m: 1/{first:e} + 1/{second:e} must be above 0; a concave body has a \
             negative radius that is larger than that of the body in it"
        ));
    }
    Ok(1.0 / curvature)
}

/// `[grid]` as written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GridTable {
    /// Cells along x.
    nx: Option<usize>,
    /// Whether the surfaces repeat across the flow.
    across: Option<Across>,
    /// Cells along y; omitted with `y` for a line contact.
    ny: Option<usize>,
    /// Outer edges along x \[m\].
    #[serde(default, deserialize_with = "edges")]
    x: Option<[f64; 2]>,
    /// Outer edges along y \[m\].
    #[serde(default, deserialize_with = "edges")]
    y: Option<[f64; 2]>,
    /// Target relative error, in place of all other keys.
    accuracy: Option<f64>,
    /// Whether the box of a history grows.
    #[serde(default)]
    grows: bool,
}

/// Values of `across` in `[grid]`.
#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum Across {
    Periodic,
}

/// Reads `[grid]`.
pub(super) fn grid<'de, D: Deserializer<'de>>(deserializer: D) -> Result<GridSpec, D::Error> {
    GridTable::deserialize(deserializer)?.into_spec().map_err(D::Error::custom)
}

impl GridTable {
    /// Cells, a row or a strip of cells, or an accuracy; a mixture is an error.
    fn into_spec(self) -> Result<GridSpec, String> {
        let Self { across, nx, ny, x, y, accuracy, grows } = self;
        if let Some(accuracy) = accuracy {
            let given = [
                ("across", across.is_some()),
                ("nx", nx.is_some()),
                ("ny", ny.is_some()),
                ("x", x.is_some()),
                ("y", y.is_some()),
                ("grows", grows),
            ];
            return match given.iter().find(|(_, present)| *present) {
                Some((key, _)) => Err(format!("`accuracy` replaces nx, ny, x and y; remove `{key}`")),
                None => Ok(GridSpec::Accuracy { accuracy }),
            };
        }
        let (nx, x) = (required("nx", nx)?, required("x", x)?);
        if let Some(Across::Periodic) = across {
            return match grows {
                true => Err("a strip does not grow; remove `grows` or `across`".to_owned()),
                false => Ok(GridSpec::Strip { nx, ny: required("ny", ny)?, x, y }),
            };
        }
        if ny.is_none() && y.is_none() && !grows {
            return Ok(GridSpec::Row { nx, x });
        }
        let (ny, y) = (required("ny", ny)?, required("y", y)?);
        Ok(if grows { GridSpec::Growing { nx, ny, x, y } } else { GridSpec::Cells { nx, ny, x, y } })
    }
}

keyed! {
    /// A table of `[schedule]` as written.
    #[derive(Deserialize)]
    pub(super) struct ScheduleTable {
        kind: ScheduleKind;
        /// The constant value.
        value: f64,
        /// Times of steps or ramps \[s\].
        times: Vec<f64>,
        /// Values at these times, or from them on.
        values: Vec<f64>,
        /// File with a column of times and one of values.
        path: PathBuf,
    }
}

/// Values of `kind` in a schedule.
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
        Ok(match table.kind {
            ScheduleKind::Constant => {
                table.reject_unknown_fields("kind = \"constant\"", &["value"])?;
                Self::Constant { value: required("value", table.value)? }
            }
            ScheduleKind::Steps => {
                table.reject_unknown_fields("kind = \"steps\"", &["times", "values"])?;
                Self::Steps {
                    times: required("times", table.times)?,
                    values: required("values", table.values)?,
                }
            }
            ScheduleKind::Ramps => {
                table.reject_unknown_fields("kind = \"ramps\"", &["times", "values"])?;
                Self::Ramps {
                    times: required("times", table.times)?,
                    values: required("values", table.values)?,
                }
            }
            ScheduleKind::Table => {
                table.reject_unknown_fields("kind = \"table\"", &["path"])?;
                Self::Table { path: required("path", table.path)? }
            }
        })
    }
}

/// Reads exactly two numbers; the parser would silently drop further ones.
fn edges<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 2]>, D::Error> {
    let edges = Vec::<f64>::deserialize(deserializer)?;
    <[f64; 2]>::try_from(edges.as_slice()).map(Some).map_err(|_| {
        let count = edges.len();
        D::Error::custom(format!(
            "a list of {count}, expected the two outer edges [low, high] with a decimal point"
        ))
    })
}

/// Error for a key of `given` that is not in `known`, the keys of a table with the `tag`.
pub(super) fn reject_unknown_fields(tag: &str, given: &[(&str, bool)], known: &[&str]) -> Result<(), String> {
    match given.iter().find(|(key, present)| *present && !known.contains(key)) {
        None => Ok(()),
        Some((key, _)) => Err(match known {
            [] => format!("unknown key `{key}`, {tag} has no other keys"),
            _ => format!("unknown key `{key}`, {tag} has `{}`", known.join("`, `")),
        }),
    }
}

/// The value, or the error that names the missing `key`.
pub(super) fn required<T>(key: &str, value: Option<T>) -> Result<T, String> {
    value.ok_or_else(|| format!("missing field `{key}`"))
}

/// Seeds have 64 bits, TOML integers 63: larger seeds are written as text.
pub(super) mod seed {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    /// Requirement on a seed, for messages.
    const A_SEED: &str = "a seed is a whole number from 0 to 2^64 - 1";

    /// A seed as written, or an invalid number.
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Seed {
        Number(u64),
        Text(String),
        Negative(i64),
        Real(f64),
    }

    /// Writes a seed, as text if it exceeds the integers of TOML.
    pub(in crate::sim) fn serialize<S: Serializer>(seed: &u64, serializer: S) -> Result<S::Ok, S::Error> {
        match i64::try_from(*seed) {
            Ok(_) => serializer.serialize_u64(*seed),
            Err(_) => serializer.serialize_str(&seed.to_string()),
        }
    }

    /// Writes an optional seed.
    pub(in crate::sim) fn serialize_optional<S: Serializer>(
        seed: &Option<u64>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match seed {
            Some(seed) => serialize(seed, serializer),
            None => serializer.serialize_none(),
        }
    }

    /// Reads a seed from a number or text.
    pub(in crate::sim) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
        match Seed::deserialize(deserializer) {
            Ok(Seed::Number(number)) => Ok(number),
            Ok(Seed::Text(text)) => {
                text.parse().map_err(|_| D::Error::custom(format!("text \"{text}\", {A_SEED}")))
            }
            Ok(Seed::Negative(number)) => Err(D::Error::custom(format!("`{number}`, {A_SEED}"))),
            Ok(Seed::Real(number)) => Err(D::Error::custom(format!("`{number}`, {A_SEED}"))),
            Err(_) => Err(D::Error::custom(A_SEED)),
        }
    }

    /// Reads an optional seed.
    pub(in crate::sim) fn optional<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<u64>, D::Error> {
        deserialize(deserializer).map(Some)
    }
}
