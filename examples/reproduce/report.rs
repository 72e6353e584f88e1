//! The page: statements over the seeds, the paper's two numbers under each reading, open choices and what they turn.

use std::f64::consts::PI;
use std::fmt::Write as _;

use crate::choices::{BASE, Choice, LONG_STEPS, NOT_FLIPPED};
use crate::history::{self, History};
use crate::options::Options;
use crate::plan::Run;
use crate::sensitivity::Table;
use crate::statements::{Pair, STATEMENTS};

/// The paper's wear of the disc without and with film \[nm\].
const PAPER_WEAR: [f64; 2] = [152.0, 132.0];
/// Area of the square around the Hertz circle over that of the circle.
const CIRCLE: f64 = 4.0 / PI;

/// All pairs of histories.
pub(crate) struct Results {
    /// One pair a seed, choices as they are.
    pub(crate) seeds: Vec<Pair>,
    /// Steps four times as long, on this grid and on the finer one.
    fine: Vec<(usize, Pair)>,
    pub(crate) choices: Vec<(&'static Choice, Pair)>,
}

impl Results {
    /// Reads what was run.
    ///
    /// # Errors
    /// A file that is missing or does not fit.
    pub(crate) fn gather(runs: &[Run], options: &Options) -> Result<Self, String> {
        let mut results = Self { seeds: Vec::new(), fine: Vec::new(), choices: Vec::new() };
        for run in runs.iter().filter(|run| run.film) {
            let pair = Pair {
                with: history::read(run, options)?,
                without: history::read(&Run { film: false, ..*run }, options)?,
            };
            if run.choice.name == LONG_STEPS.name {
                results.fine.push((run.grid, pair));
            } else if run.choice.name == BASE.name {
                results.seeds.push(pair);
            } else {
                results.choices.push((run.choice, pair));
            }
        }
        results.fine.sort_by_key(|(grid, _)| *grid);
        Ok(results)
    }

    /// The mean histories of the seeds.
    fn mean_pair(&self) -> Option<Pair> {
        let with: Vec<&History> = self.seeds.iter().map(|pair| &pair.with).collect();
        let without: Vec<&History> = self.seeds.iter().map(|pair| &pair.without).collect();
        Some(Pair { with: History::mean_of(&with)?, without: History::mean_of(&without)? })
    }

    fn mean(&self, value: impl Fn(&Pair) -> f64) -> f64 {
        self.seeds.iter().map(value).sum::<f64>() / self.seeds.len() as f64
    }

    /// Sample standard deviation; none for one seed.
    fn spread(&self, value: impl Fn(&Pair) -> f64) -> Option<f64> {
        let (n, mean) = (self.seeds.len(), self.mean(&value));
        let sum: f64 = self.seeds.iter().map(|pair| (value(pair) - mean).powi(2)).sum();
        (n > 1).then(|| (sum / (n - 1) as f64).sqrt())
    }
}

/// The page as Markdown. Writing to a string cannot fail.
pub(crate) fn page(results: &Results, table: Option<&Table>, options: &Options) -> String {
    let mut page = String::new();
    introduction(&mut page, results, options);
    quantities(&mut page, results);
    statements(&mut page, results, table);
    wear_readings(&mut page, results, table);
    if let Some(table) = table {
        choices(&mut page, table);
    }
    for number in 1..=8 {
        let _ = write!(page, "\n![Figure {number}](figures/reproduction{number}.svg)\n");
    }
    page
}

fn introduction(page: &mut String, results: &Results, options: &Options) {
    let (seeds, grid, steps, step) = (results.seeds.len(), options.grid, options.steps, options.time_step);
    let command = options.command();
    let _ = write!(
        page,
        "# The paper's experiment\n\n\
         Written by `{command}`: Azam, Ghanbarzadeh, Neville, Morina, Wilson (2019), Tribology International 135, 161-169. \
         {seeds} seeds of roughness and motion, {grid} x {grid} nodes, {steps} steps of {step} s, residuals of 1e-3, \
         contact below 1 nm, roughness moved along the track each step. What the paper leaves open is chosen as in \
         `Scene::azam_2019`; nothing was tuned.\n\n"
    );
    if steps as f64 * step < 7200.0 {
        let _ = write!(
            page,
            "**A trial of {:.0} s, not the paper's two hours: the numbers below are no reproduction.**\n\n",
            steps as f64 * step
        );
    }
    let all = results.seeds.iter().flat_map(|pair| [&pair.with, &pair.without]);
    let (mut taken, mut moved, mut early) = (0, 0, 0);
    for history in all {
        taken += history.steps();
        moved += history.column("attempts").iter().filter(|attempts| **attempts > 1.0).count();
        early += usize::from(history.failure.is_some());
    }
    let _ = write!(
        page,
        "{moved} of {taken} steps needed another position of the roughness because the solver did not converge at the \
         first; {early} of {} histories ended early. Positions passed over make the rest a selection.\n\n",
        2 * seeds
    );
}

fn quantities(page: &mut String, results: &Results) {
    let mut finer = String::new();
    for (grid, _) in &results.fine {
        let _ = write!(finer, " {grid} x {grid}, with | {grid} x {grid}, without |");
    }
    let rule = "---|---|".repeat(results.fine.len());
    let note = if results.fine.is_empty() {
        ""
    } else {
        " The last columns are those of the first seed with a quarter of the steps of four times the time, on this grid and on one twice as fine."
    };
    let _ = write!(
        page,
        "## Start and end\n\nMean of the seeds and their standard deviation; scattered quantities are means over the first \
         or last steps of a history.{note}\n\n\
         | quantity | start | end, with | end, without |{finer}\n|---|---|---|---|{rule}\n"
    );
    for (name, column, unit, decimals) in [
        ("Rq ball, nm", "rq_ball_m", 1e9, 1),
        ("Rq disc, nm", "rq_disc_m", 1e9, 1),
        ("Rq composite, nm", "rq_composite_m", 1e9, 1),
        ("h_avg, nm", "h_avg_m", 1e9, 1),
        ("lambda", "lambda", 1.0, 3),
        ("lambda_OLD", "lambda_old", 1.0, 4),
        ("area ratio", "area_ratio", 1.0, 3),
        ("load ratio", "load_ratio", 1.0, 3),
        ("largest pressure, GPa", "max_pressure_pa", 1e-9, 2),
        ("wear of the ball's track, nm", "track_wear_ball_m", 1e9, 2),
        ("wear of the disc's track, nm", "track_wear_disc_m", 1e9, 2),
        ("film on the disc's track, nm", "track_film_disc_m", 1e9, 1),
        ("friction coefficient", "friction_coefficient", 1.0, 4),
        ("largest flash temperature, K", "flash_rise_k", 1.0, 2),
    ] {
        let cell = |value: &dyn Fn(&Pair) -> f64| {
            let mean = unit * results.mean(value);
            let spread =
                results.spread(value).map_or_else(String::new, |s| format!(" +- {:.decimals$}", unit * s));
            format!("{mean:.decimals$}{spread}")
        };
        let start = cell(&|pair| pair.with.first(column));
        let (with, without) = (cell(&|pair| pair.with.end(column)), cell(&|pair| pair.without.end(column)));
        let _ = write!(page, "| {name} | {start} | {with} | {without} |");
        for (_, fine) in &results.fine {
            let ends = [&fine.with, &fine.without].map(|history| unit * history.end(column));
            let _ = write!(page, " {:.decimals$} | {:.decimals$} |", ends[0], ends[1]);
        }
        page.push('\n');
    }
}

fn statements(page: &mut String, results: &Results, table: Option<&Table>) {
    let seeds = results.seeds.len();
    let _ = write!(
        page,
        "\n## What the paper says\n\nAsked of the mean history of the seeds and of each seed. The last column names the open \
         choices that turn the first seed's answer when flipped alone.\n\n\
         | statement | mean | seeds that agree | turned by |\n|---|---|---|---|\n"
    );
    let mean = results.mean_pair();
    for statement in &STATEMENTS {
        let agree = results.seeds.iter().filter(|pair| (statement.holds)(pair)).count();
        let verdict = match &mean {
            Some(mean) if (statement.holds)(mean) => "agrees",
            _ => "**disagrees**",
        };
        let turned = match table {
            None => "not run".to_owned(),
            Some(table) => {
                let turn =
                    table.rows.iter().filter(|row| row.turns.iter().any(|turn| turn == statement.text));
                let names: Vec<String> = turn.map(|row| format!("`{}`", row.name)).collect();
                if names.is_empty() { "none found".to_owned() } else { names.join(", ") }
            }
        };
        let _ = writeln!(page, "| {} | {verdict} | {agree} of {seeds} | {turned} |", statement.text);
    }
}

/// The paper's 152 and 132 nm do not say which area or pressure.
fn wear_readings(page: &mut String, results: &Results, table: Option<&Table>) {
    let _ = write!(
        page,
        "\n## The paper's two numbers\n\nWear of the disc after two hours: {} nm without, {} nm with film, ratio {:.3}. The \
         paper does not say over which area it averages, nor which pressure wears. Seen from the contact \
         nearly all wear falls inside the Hertz circle: the mean over it is taken as that over the width of the track, whose square has \
         4/pi times the area of the circle, times this.\n\n\
         | reading | without, nm | with, nm | ratio |\n|---|---|---|---|\n",
        PAPER_WEAR[0],
        PAPER_WEAR[1],
        PAPER_WEAR[1] / PAPER_WEAR[0]
    );
    let mut row = |reading: &str, without: f64, with: f64| {
        let ratio = with / without;
        let _ = writeln!(page, "| {reading} | {:.1} | {:.1} | {ratio:.3} |", 1e9 * without, 1e9 * with);
    };
    let mean = |column: &'static str| {
        [results.mean(|pair| pair.without.last(column)), results.mean(|pair| pair.with.last(column))]
    };
    let [without, with] = mean("track_wear_disc_m");
    row("all pressure, mean over the width of the track", without, with);
    row("all pressure, mean over the Hertz circle", CIRCLE * without, CIRCLE * with);
    let [without, with] = mean("max_wear_disc_m");
    row("all pressure, deepest node", without, with);
    let flips = table.map_or(&[][..], |table| &table.rows);
    // Histories of different lengths cannot be compared.
    for flip in flips.iter().filter(|flip| flip.is_whole()) {
        let [ratio, without, ..] = flip.numbers[..] else { continue };
        let reading = format!("first seed, flipped: {} (`{}`), Hertz circle", flip.flip, flip.name);
        row(&reading, CIRCLE * without, CIRCLE * without * ratio);
    }
}

fn choices(page: &mut String, table: &Table) {
    let _ = write!(
        page,
        "\n## Open choices\n\nEach flipped alone, first seed, with half the steps of twice the time, by `{}`; the first row is the scene as it is. Compare \
         with the spread over the seeds above. Where a pair has different numbers of steps, one ended early because its contact was \
         not solved at any position tried: no wear ratio.\n\n\
         | flip | wear ratio | wear without, nm | film, nm | lambda with / without | area with / without | load with / without \
         | steps |\n|---|---|---|---|---|---|---|---|\n",
        table.command
    );
    for row in &table.rows {
        let &[
            ratio,
            wear,
            film,
            lambda,
            lambda_without,
            area,
            area_without,
            load,
            load_without,
            steps,
            steps_without,
        ] = row.numbers.as_slice()
        else {
            continue;
        };
        let ratio = if row.is_whole() { format!("{ratio:.3}") } else { "-".to_owned() };
        let _ = writeln!(
            page,
            "| {} (`{}`) | {ratio} | {:.3} | {:.1} | {lambda:.3} / {lambda_without:.3} | {area:.3} / {area_without:.3} | \
             {load:.3} / {load_without:.3} | {steps} / {steps_without} |",
            row.flip,
            row.name,
            1e9 * wear,
            1e9 * film
        );
    }
    let _ = write!(page, "\n{NOT_FLIPPED}");
}
