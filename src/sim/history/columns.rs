//! The columns of a history: name, unit and accessor of each.
//!
//! A name is the path of a field of [`StepRecord`] (without `report`). Header and lines of `history.csv`, the
//! means of a history and their units are made from this list.

use crate::report::Status;
use crate::sim::history::record::StepRecord;
use crate::solver_id::SolverId;

/// Name in a line for any custom solver.
const OTHER: SolverId = SolverId::Custom("other");

/// One column.
pub(in crate::sim) struct Column {
    /// Its name, such as `film.mean_central`.
    pub(in crate::sim) name: &'static str,
    /// Its unit, empty for ratios and counts.
    pub(in crate::sim) unit: &'static str,
    /// Its value in a record.
    pub(in crate::sim) get: fn(&StepRecord) -> Cell,
    /// Parses a cell into a record; `None` if the cell holds no such value.
    pub(in crate::sim) set: fn(&mut StepRecord, &str) -> Option<()>,
}

impl Column {
    /// The heading in a file: name and unit.
    pub(in crate::sim) fn heading(&self) -> String {
        let unit = self.unit.replace('/', "_").replace('^', "").to_lowercase();
        let name = self.name.replace('.', "_");
        if unit.is_empty() { name } else { format!("{name}_{unit}") }
    }

    /// Table and key of a name that contains a dot.
    pub(in crate::sim) fn path(&self) -> Option<(&'static str, &'static str)> {
        self.name.split_once('.')
    }
}

/// The value of a cell.
pub(in crate::sim) enum Cell {
    /// Empty: not modelled.
    Empty,
    /// A number.
    Number(f64),
    /// A count.
    Count(u64),
    /// A word.
    Word(String),
}

/// A type that a cell can hold.
trait Value: Sized {
    /// As a cell.
    fn cell(&self) -> Cell;
    /// From the text of a cell.
    fn read(text: &str) -> Option<Self>;
}

impl Value for f64 {
    fn cell(&self) -> Cell {
        Cell::Number(*self)
    }
    fn read(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

impl Value for Option<f64> {
    fn cell(&self) -> Cell {
        self.map_or(Cell::Empty, Cell::Number)
    }
    fn read(text: &str) -> Option<Self> {
        if text.is_empty() { Some(None) } else { text.parse().ok().map(Some) }
    }
}

impl Value for u64 {
    fn cell(&self) -> Cell {
        Cell::Count(*self)
    }
    fn read(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

impl Value for u32 {
    fn cell(&self) -> Cell {
        Cell::Count(u64::from(*self))
    }
    fn read(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

impl Value for SolverId {
    fn cell(&self) -> Cell {
        Cell::Word(self.to_string())
    }
    fn read(text: &str) -> Option<Self> {
        Some(text.parse().unwrap_or(OTHER))
    }
}

impl Value for Status {
    fn cell(&self) -> Cell {
        Cell::Word(self.to_string())
    }
    fn read(text: &str) -> Option<Self> {
        let all = [
            Self::Converged,
            Self::MaxIterations,
            Self::Stalled,
            Self::Diverged,
            Self::MeshTooCoarse,
            Self::Unverified,
        ];
        all.into_iter().find(|status| status.to_string() == text)
    }
}

/// A column of a field, `? table.key` of a table that may be missing, `report: key` of the report.
macro_rules! column {
    ($unit:literal, ? $table:ident.$key:ident) => {
        Column {
            name: concat!(stringify!($table), ".", stringify!($key)),
            unit: $unit,
            get: |record| record.$table.map_or(Cell::Empty, |table| table.$key.cell()),
            set: |record, text| {
                if !text.is_empty() {
                    record.$table.get_or_insert_default().$key = Value::read(text)?;
                }
                Some(())
            },
        }
    };
    ($unit:literal, report: $first:ident $(.$key:ident)?) => {
        Column {
            name: concat!(stringify!($first) $(, ".", stringify!($key))?),
            unit: $unit,
            get: |record| record.report.$first$(.$key)?.cell(),
            set: |record, text| {
                record.report.$first$(.$key)? = Value::read(text)?;
                Some(())
            },
        }
    };
    ($unit:literal, $first:ident $(.$key:ident)?) => {
        Column {
            name: concat!(stringify!($first) $(, ".", stringify!($key))?),
            unit: $unit,
            get: |record| record.$first$(.$key)?.cell(),
            set: |record, text| {
                record.$first$(.$key)? = Value::read(text)?;
                Some(())
            },
        }
    };
}

/// All columns, in the order of a line.
pub(in crate::sim) static COLUMNS: [Column; 83] = [
    column!("", step),
    column!("s", time),
    column!("s", time_step),
    column!("N", load),
    column!("m/s", motion.entrainment_speed),
    column!("", motion.slide_roll_ratio),
    column!("K", bulk_temperature),
    column!("m", roughness.ball_rq),
    column!("m", roughness.disc_rq),
    column!("m", roughness.composite_rq),
    column!("m", film.central),
    column!("m", film.minimum),
    column!("m", film.mean_central),
    column!("m", film.minimum_gap),
    column!("", film.lambda),
    column!("", film.minimum_lambda),
    column!("", film.formula_ratio),
    column!("", film.formula_lambda),
    column!("", film.fluid_fraction),
    column!("Pa", pressure.max),
    column!("Pa", pressure.central),
    column!("Pa", pressure.mean),
    column!("N", pressure.load_outside),
    column!("", contact.area_ratio),
    column!("", contact.load_ratio),
    column!("m^2", contact.area),
    column!("", contact.corrected_area_ratio),
    column!("m^2", contact.corrected_area),
    column!("m^2", contact.plastic_area),
    column!("m", contact.film_cutoff),
    column!("", friction.coefficient),
    column!("", friction.boundary),
    column!("", friction.fluid),
    column!("W", friction.power_loss),
    column!("m^3/s", ? flow.inflow),
    column!("m^3/s", ? flow.outflow),
    column!("", ? flow.imbalance),
    column!("K", ? thermal.film_temperature_max),
    column!("K", ? thermal.film_temperature_mean_central),
    column!("K", ? thermal.surface_rise_ball),
    column!("K", ? thermal.surface_rise_disc),
    column!("W", ? thermal.heat),
    column!("", ? thermal.imbalance),
    column!("", ? thermal.solves),
    column!("", ? thermal.change),
    column!("K", flash_rise),
    column!("m", wear.ball_mean),
    column!("m", wear.disc_mean),
    column!("m", wear.ball_max),
    column!("m", wear.disc_max),
    column!("m", wear.ball_in_contact),
    column!("m", wear.disc_in_contact),
    column!("m^3", wear.ball_volume),
    column!("m^3", wear.disc_volume),
    column!("m", wear.ball_scar_width),
    column!("m", wear.disc_scar_width),
    column!("m", wear.ball_scar_depth),
    column!("m", wear.disc_scar_depth),
    column!("m", tribofilm.ball_mean),
    column!("m", tribofilm.disc_mean),
    column!("m", tribofilm.ball_max),
    column!("m", tribofilm.disc_max),
    column!("m", tribofilm.ball_in_contact),
    column!("m", tribofilm.disc_in_contact),
    column!("m^3", plastic.volume),
    column!("", ? error_estimate.film_central),
    column!("", ? error_estimate.film_minimum),
    column!("", ? error_estimate.pressure_max),
    column!("", ? error_estimate.film_mean_central),
    column!("", ? error_estimate.contact_load_ratio),
    column!("", ? error_estimate.contact_area_ratio),
    column!("", ? error_estimate.friction_coefficient),
    column!("", ? error_estimate.film_by_box),
    column!("", attempts),
    column!("", report: solver),
    column!("", report: status),
    column!("", report: residual.mass),
    column!("", report: residual.load),
    column!("", report: residual.complementarity),
    column!("", report: energy_error),
    column!("", report: work.convolutions),
    column!("", report: work.iterations),
    column!("", report: work.inner_iterations),
];
