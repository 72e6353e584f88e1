//! Numbers of the rows: references, computed values, deviations and their bounds; CSV and Markdown.

use std::error::Error;
use std::fmt::Write as _;

use crate::chart::Figure;

/// A result whose error may cross threads.
pub(crate) type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// How much of a row is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effort {
    Full,
    /// Few cases on the same meshes, within seconds.
    Short,
}

impl Effort {
    pub(crate) fn is_full(self) -> bool {
        self == Self::Full
    }
}

/// A computed value beside its reference.
#[derive(Debug)]
pub(crate) struct Number {
    pub(crate) group: &'static str,
    pub(crate) case: String,
    pub(crate) unit: &'static str,
    /// One value, or the ends of an interval.
    pub(crate) reference: [f64; 2],
    pub(crate) computed: f64,
    /// Deviations are relative.
    pub(crate) relative: bool,
    /// Largest deviation of a passing run.
    pub(crate) bound: f64,
}

impl Number {
    /// A value whose deviation is relative.
    pub(crate) fn relative(
        group: &'static str,
        case: impl Into<String>,
        unit: &'static str,
        reference: f64,
        computed: f64,
        bound: f64,
    ) -> Self {
        Self { group, case: case.into(), unit, reference: [reference; 2], computed, relative: true, bound }
    }

    /// A value whose deviation is a difference.
    pub(crate) fn absolute(
        group: &'static str,
        case: impl Into<String>,
        unit: &'static str,
        reference: f64,
        computed: f64,
        bound: f64,
    ) -> Self {
        Self { relative: false, ..Self::relative(group, case, unit, reference, computed, bound) }
    }

    /// A value that has to lie in an interval; its deviation is its distance from it.
    pub(crate) fn between(
        group: &'static str,
        case: impl Into<String>,
        reference: [f64; 2],
        computed: f64,
    ) -> Self {
        Self { reference, ..Self::absolute(group, case, "", 0.0, computed, 0.0) }
    }

    pub(crate) fn deviation(&self) -> f64 {
        let [low, high] = self.reference;
        let difference = self.computed - self.computed.clamp(low, high);
        if self.relative { difference / low.abs() } else { difference }
    }

    pub(crate) fn holds(&self) -> bool {
        self.deviation().abs() <= self.bound
    }

    fn is_interval(&self) -> bool {
        self.reference[0] < self.reference[1]
    }

    fn deviation_text(&self) -> String {
        match self.deviation() {
            deviation if self.is_interval() && deviation == 0.0 => "within".to_owned(),
            deviation if self.relative => percent(deviation),
            deviation => signed(deviation),
        }
    }

    fn reference_text(&self) -> String {
        let [low, high] = self.reference.map(significant);
        if low == high { low } else { format!("{low} to {high}") }
    }
}

/// One comparison.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    /// The compared quantity.
    pub(crate) quantity: &'static str,
    /// Kind of the reference and its source.
    pub(crate) reference: &'static str,
    pub(crate) range: &'static str,
    pub(crate) numbers: Vec<Number>,
    /// Markdown after the table of the numbers.
    pub(crate) extra: String,
    pub(crate) figures: Vec<(&'static str, Figure)>,
}

/// Rows with more numbers are summarized by group on the page; the CSV file has all of them.
const MOST_LINES: usize = 24;

impl Row {
    /// Numbers outside of their bounds, one a line.
    pub(crate) fn failures(&self) -> String {
        let failed = self.numbers.iter().filter(|number| !number.holds());
        failed.fold(String::new(), |mut text, number| {
            let _ = writeln!(
                text,
                "{} {} {}: {} beside {}, deviation {}, bound {}",
                self.name,
                number.group,
                number.case,
                significant(number.computed),
                number.reference_text(),
                number.deviation_text(),
                number.bound
            );
            text
        })
    }

    fn groups(&self) -> Vec<(&'static str, Vec<&Number>)> {
        let mut groups: Vec<(&'static str, Vec<&Number>)> = Vec::new();
        for number in &self.numbers {
            match groups.iter_mut().find(|(name, _)| *name == number.group) {
                Some((_, members)) => members.push(number),
                None => groups.push((number.group, vec![number])),
            }
        }
        groups
    }

    /// The anchor of its heading on the page.
    pub(crate) fn anchor(&self) -> String {
        self.name.replace('_', "-")
    }

    /// The line of the table of all rows.
    pub(crate) fn trust_line(&self) -> String {
        let groups = self.groups();
        let parts: Vec<String> =
            groups.iter().map(|(name, members)| format!("{name} {}", span(members))).collect();
        format!(
            "| [{}](#{}) | {} | {} | {} |",
            self.quantity,
            self.anchor(),
            self.reference,
            self.range,
            parts.join("; ")
        )
    }

    /// The table of the row on the page.
    pub(crate) fn table(&self) -> String {
        let table =
            if self.numbers.len() > MOST_LINES { self.table_of_groups() } else { self.table_of_numbers() };
        table + &self.extra
    }

    fn table_of_numbers(&self) -> String {
        let mut text =
            String::from("| quantity | case | reference | computed | deviation |\n|---|---|---|---|---|\n");
        for number in &self.numbers {
            let unit = if number.unit.is_empty() { String::new() } else { format!(" {}", number.unit) };
            let _ = writeln!(
                text,
                "| {} | {} | {}{unit} | {}{unit} | {} |",
                number.group,
                number.case,
                number.reference_text(),
                significant(number.computed),
                number.deviation_text()
            );
        }
        text
    }

    fn table_of_groups(&self) -> String {
        let mut text = String::from("| quantity | values | deviation |\n|---|---|---|\n");
        for (name, members) in self.groups() {
            let _ = writeln!(text, "| {name} | {} | {} |", members.len(), span(&members));
        }
        text
    }

    /// Lines of the CSV file.
    pub(crate) fn csv(&self) -> String {
        let mut text = String::new();
        for number in &self.numbers {
            let [low, high] = number.reference;
            let _ = writeln!(
                text,
                "{},\"{}\",{},{},{low},{high},{:.6e},{:.3e},{},{}",
                self.name,
                number.group,
                number.case,
                number.unit,
                number.computed,
                number.deviation(),
                if number.relative { "relative" } else { "absolute" },
                number.bound
            );
        }
        text
    }
}

pub(crate) const CSV_HEADER: &str =
    "row,quantity,case,unit,reference_low,reference_high,computed,deviation,kind,bound";

/// Smallest and largest deviation of a group.
fn span(members: &[&Number]) -> String {
    let deviation = |number: &&&Number| number.deviation();
    let order = |a: &&&Number, b: &&&Number| deviation(a).total_cmp(&deviation(b));
    let ends = [members.iter().min_by(order), members.iter().max_by(order)];
    let [low, high] = ends.map(|end| end.map_or_else(String::new, |number| number.deviation_text()));
    if low == high { low } else { format!("{low} to {high}") }
}

fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if share != 0.0 && value.abs() < 0.005 {
        return format!("{value:+.0e} %");
    }
    let decimals = if value.abs() < 0.995 { 2 } else { 1 };
    format!("{} %", signed_with(value, decimals))
}

fn signed(value: f64) -> String {
    if value != 0.0 && value.abs() < 5e-4 { format!("{value:+.0e}") } else { signed_with(value, 3) }
}

/// With a sign; zero after rounding has none.
fn signed_with(value: f64, decimals: usize) -> String {
    let text = format!("{value:+.decimals$}");
    if text[1..].chars().all(|c| matches!(c, '0' | '.')) { text[1..].to_owned() } else { text }
}

/// Four significant digits.
fn significant(value: f64) -> String {
    let magnitude = value.abs().log10().floor();
    if value == 0.0 || !(-4.0..7.0).contains(&magnitude) {
        return if value == 0.0 { "0".to_owned() } else { format!("{value:.3e}") };
    }
    let decimals = (3.0 - magnitude).max(0.0) as usize;
    format!("{value:.decimals$}")
}
