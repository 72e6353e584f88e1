//! Keys of the scene and the values that they take.

use serde_json::json;
use stribeck::sim::Scene;
use toml::{Table, Value};

/// Most points of a sweep.
const MOST_POINTS: usize = 1_000_000;

/// A key of the scene by its path and its values as texts with units.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub(super) key: String,
    values: Values,
}

#[derive(Debug, Clone)]
enum Values {
    /// `1, 2, 4`.
    List(Vec<String>),
    /// `1..4:3`: both ends and the number of values.
    Range(String, String, usize),
}

/// A point: its inputs by key, in SI units, and its scene.
pub(super) struct Input {
    pub(super) values: Vec<(String, serde_json::Value)>,
    pub(super) scene: Scene,
}

impl Axis {
    /// The axis of `KEY=VALUE,VALUE` or `KEY=FROM..TO:COUNT`.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "--over {text}: must be KEY=VALUE,VALUE,... or KEY=FROM..TO:COUNT, such as \
                 motion.entrainment_speed=1mm/s..1m/s:20"
            )
        };
        let (key, values) = text.split_once('=').ok_or_else(wrong)?;
        if key.trim().is_empty() || values.trim().is_empty() {
            return Err(wrong());
        }
        let values = match values.split_once("..") {
            None => Values::List(values.split(',').map(|value| value.trim().to_owned()).collect()),
            Some((from, rest)) => {
                let (to, count) = rest.rsplit_once(':').ok_or_else(wrong)?;
                let count = count.trim().parse().ok().filter(|count| (2..=MOST_POINTS).contains(count));
                Values::Range(from.trim().to_owned(), to.trim().to_owned(), count.ok_or_else(wrong)?)
            }
        };
        Ok(Self { key: key.trim().to_owned(), values })
    }

    /// Whether the key is the seed of a random surface.
    pub(super) fn is_seed(&self) -> bool {
        is_seed(&self.key)
    }

    /// The values for the scene of `tables`: numbers of a range are evenly spread over their logarithms, evenly
    /// where an end is not positive and for seeds. Those of a whole number are rounded.
    fn resolved(&self, tables: &Table) -> Result<Vec<Value>, String> {
        match &self.values {
            Values::List(values) => Ok(values.iter().map(|value| plain(value)).collect()),
            Values::Range(from, to, count) => {
                let end = |text: &str| -> Result<Value, String> {
                    let number = si_value(&with(tables, &self.key, plain(text))?, &self.key);
                    number.filter(|value| number_of(value).is_some() || whole(value).is_some()).ok_or_else(
                        || format!("--over {}: {text} is not a number; a range needs numbers", self.key),
                    )
                };
                let (from, to) = (end(from)?, end(to)?);
                Ok(match (whole(&from), whole(&to)) {
                    (Some(from), Some(to)) if self.is_seed() => even_seeds(from, to, *count),
                    (Some(_), Some(_)) => {
                        spread(&from, &to, *count).map(|value| Value::Integer(value.round() as i64)).collect()
                    }
                    _ => spread(&from, &to, *count).map(Value::Float).collect(),
                })
            }
        }
    }
}

/// The points of all combinations, the last key fastest, or with `zip` of values side by side.
pub(super) fn points(scene: &Scene, axes: &[Axis], zip: bool) -> Result<Vec<Input>, String> {
    let tables = tables(scene)?;
    let values = axes.iter().map(|axis| axis.resolved(&tables)).collect::<Result<Vec<_>, _>>()?;
    let lengths: Vec<usize> = values.iter().map(Vec::len).collect();
    if zip && lengths.windows(2).any(|pair| pair[0] != pair[1]) {
        let lengths: Vec<String> = lengths.iter().map(usize::to_string).collect();
        return Err(format!("--zip: the keys have {} values, expected equal numbers", lengths.join(", ")));
    }
    let count = if zip {
        lengths.first().copied().unwrap_or(0)
    } else {
        lengths.iter().try_fold(1_usize, |count, n| count.checked_mul(*n)).unwrap_or(usize::MAX)
    };
    if count > MOST_POINTS {
        return Err(format!("--over: more than {MOST_POINTS} points"));
    }
    (0..count)
        .map(|k| {
            let mut rest = k;
            let mut changed = tables.clone();
            for (axis, values) in axes.iter().zip(&values).rev() {
                let place = if zip { k } else { rest % values.len() };
                rest /= values.len();
                if let Some(value) = values.get(place) {
                    set(&mut changed, &axis.key, value.clone());
                }
            }
            let scene = read(&changed)?;
            let full = self::tables(&scene)?;
            let input = |axis: &Axis| {
                let value = si_value(&full, &axis.key).unwrap_or_else(|| Value::String(String::new()));
                // a seed above the integers of TOML is a text there
                let seed = whole(&value).filter(|_| axis.is_seed()).and_then(|seed| u64::try_from(seed).ok());
                (axis.key.clone(), seed.map_or_else(|| json!(value), |seed| json!(seed)))
            };
            Ok(Input { values: axes.iter().map(input).collect(), scene })
        })
        .collect()
}

/// The tables of a scene, with paths as they are found from here.
fn tables(scene: &Scene) -> Result<Table, String> {
    let text = scene.to_toml().map_err(|error| error.to_string())?;
    text.parse().map_err(|error: toml::de::Error| error.to_string())
}

/// The scene of `tables`.
fn read(tables: &Table) -> Result<Scene, String> {
    let text = toml::to_string(tables).map_err(|error| error.to_string())?;
    Scene::from_toml(&text).map_err(|error| {
        let error = error.to_string();
        // the line is one of a text that nobody has written
        let without_line = error.strip_prefix("line ").and_then(|rest| rest.split_once(": "));
        format!("--over: {}", without_line.map_or(error.as_str(), |(_, rest)| rest))
    })
}

/// The tables of the scene in which the key of this path has the value.
fn with(tables: &Table, key: &str, value: Value) -> Result<Table, String> {
    let mut changed = tables.clone();
    set(&mut changed, key, value);
    self::tables(&read(&changed)?)
}

/// Sets the key of this path; a load is replaced as a whole.
fn set(tables: &mut Table, key: &str, value: Value) {
    let Some((first, rest)) = key.split_once('.') else {
        tables.insert(key.to_owned(), value);
        return;
    };
    let mut inner = match tables.remove(first) {
        Some(Value::Table(inner)) if first != "load" => inner,
        _ => Table::new(),
    };
    set(&mut inner, rest, value);
    tables.insert(first.to_owned(), Value::Table(inner));
}

/// The value of the key of this path.
fn si_value(tables: &Table, key: &str) -> Option<Value> {
    match key.split_once('.') {
        None => tables.get(key).cloned(),
        Some((first, rest)) => si_value(tables.get(first)?.as_table()?, rest),
    }
}

/// Whether the key of this path is the seed of a random surface.
fn is_seed(key: &str) -> bool {
    key.rsplit('.').next() == Some("seed")
}

/// `count` numbers between two values, evenly over their logarithms or, where one is not positive, evenly.
fn spread(from: &Value, to: &Value, count: usize) -> impl Iterator<Item = f64> {
    let (from, to) = (number_of(from).unwrap_or(f64::NAN), number_of(to).unwrap_or(f64::NAN));
    let last = (count - 1) as f64;
    let by_ratio = from > 0.0 && to > 0.0;
    (0..count).map(move |k| match k {
        0 => from,
        k if k + 1 == count => to,
        k if by_ratio => from * (to / from).powf(k as f64 / last),
        k => from + (to - from) * (k as f64 / last),
    })
}

/// `count` seeds evenly between two, rounded down.
fn even_seeds(from: i128, to: i128, count: usize) -> Vec<Value> {
    let last = count as i128 - 1;
    (0..=last).map(|k| plain(&(from + (to - from) * k / last).to_string())).collect()
}

/// A whole number; a seed above the integers of TOML is a text.
fn whole(value: &Value) -> Option<i128> {
    match value {
        Value::Integer(whole) => Some(i128::from(*whole)),
        Value::String(text) => text.parse().ok(),
        _ => None,
    }
}

fn number_of(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// A number, a truth value or a text, perhaps a number with a unit. Whole numbers above the integers of TOML stay texts.
fn plain(text: &str) -> Value {
    if text.parse::<u64>().is_ok_and(|whole| i64::try_from(whole).is_err()) {
        return Value::String(text.to_owned());
    }
    match (text.parse::<i64>(), text.parse::<f64>(), text.parse::<bool>()) {
        (Ok(whole), _, _) => Value::Integer(whole),
        (_, Ok(number), _) => Value::Float(number),
        (_, _, Ok(truth)) => Value::Boolean(truth),
        _ => Value::String(text.to_owned()),
    }
}
