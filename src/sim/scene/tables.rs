//! Checks beyond derived readers: radii of two bodies, the kinds of grids, edges, seeds.

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::GridSpec;
use crate::surface::Form;

/// `[form]` as written: of each radius its value, or the radii of both bodies.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
enum FormTable {
    Sphere {
        radius: Option<f64>,
        radii: Option<Vec<f64>>,
    },
    Cylinder {
        radius: Option<f64>,
        radii: Option<Vec<f64>>,
    },
    Ellipsoid {
        radius_x: Option<f64>,
        radii_x: Option<Vec<f64>>,
        radius_y: Option<f64>,
        radii_y: Option<Vec<f64>>,
        #[serde(default)]
        angle: f64,
    },
}

/// Reads `[form]`.
pub(super) fn form<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Form, D::Error> {
    FormTable::deserialize(deserializer)?.into_form().map_err(D::Error::custom)
}

impl FormTable {
    fn into_form(self) -> Result<Form, String> {
        let form = match self {
            Self::Sphere { radius, radii } => {
                let radii = section("radius", radius, "radii", radii)?;
                if radii[1].is_infinite() {
                    return Ok(Form::Sphere { radius: radii[0] });
                }
                Form::Bodies { x: radii, y: radii, angle: 0.0 }
            }
            Self::Cylinder { radius, radii } => {
                let radii = section("radius", radius, "radii", radii)?;
                if radii[1].is_infinite() {
                    return Ok(Form::Cylinder { radius: radii[0] });
                }
                Form::Bodies { x: radii, y: [f64::INFINITY; 2], angle: 0.0 }
            }
            Self::Ellipsoid { radius_x, radii_x, radius_y, radii_y, angle } => {
                let x = section("radius_x", radius_x, "radii_x", radii_x)?;
                let y = section("radius_y", radius_y, "radii_y", radii_y)?;
                if [x, y].iter().all(|[_, disc]| disc.is_infinite()) {
                    return Ok(Form::Ellipsoid { radius_x: x[0], radius_y: y[0], angle });
                }
                Form::Bodies { x, y, angle }
            }
        };
        let is_pair = matches!(form, Form::Bodies { x: [_, disc], y: [_, across], .. } if disc.is_finite() || across.is_finite());
        Ok(if is_pair { form } else { form.reduced() })
    }
}

/// Radii of both bodies of a section: as given, or those of a body of the radius on a flat.
fn section(
    key: &str,
    given: Option<f64>,
    pair_key: &str,
    pair: Option<Vec<f64>>,
) -> Result<[f64; 2], String> {
    let Some(pair) = pair else { return Ok([required(key, given)?, f64::INFINITY]) };
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
    Ok([first, second])
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
        if accuracy.is_some() && across.is_some() {
            let reason = "the mesh of a strip is not chosen by `accuracy`: give nx, ny and x in its place; solver.accuracy checks the errors";
            return Err(reason.to_owned());
        }
        if let Some(accuracy) = accuracy {
            let given = [
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
}
