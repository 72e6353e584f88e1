//! The report of `check` for people.

use stribeck::analytic::MixedLoadShare;
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{Expectation, ExpectedFilm};
use stribeck::units::by_size;

use super::cycle::Rows;
use super::parts;
use super::{Expected, OilTemperature};
use crate::output;

/// Largest share of the load on solids in a full film.
const FULL_FILM: f64 = 0.05;
/// Share of the friction from which on its range is given.
const SPREAD: f64 = 0.2;
/// Least share in boundary lubrication.
const BOUNDARY: f64 = 0.8;

impl Expected {
    /// At most 28 lines in the units of engineers, with `rows` of a cycle some twelve more.
    pub(super) fn to_text(&self, rows: Option<&Rows>) -> String {
        let mut lines = match rows {
            Some(rows) => rows.lines(),
            None => self.contact_lines(),
        };
        lines.extend(self.oil_lines());
        lines.extend(self.mesh_lines());
        let of_cycle = rows.map(|rows| ("cycle", rows.refusal()));
        let commands = [("solve", self.refusals.solve.as_ref()), ("run", self.refusals.run.as_ref())];
        for (command, refusal) in commands.into_iter().chain(of_cycle) {
            lines.push(match refusal {
                None => format!("{command:<10} yes"),
                Some(error) => format!("{command:<10} no: {error}"),
            });
        }
        lines.extend(parts::lines(&self.parts));
        lines.join("\n")
    }

    /// Regime, film, load, friction and the contact of the smooth bodies.
    pub(super) fn contact_lines(&self) -> Vec<String> {
        let hertz = &self.hertz;
        let mut lines = self.film_lines();
        let half_width = 1e6 * hertz.half_width_x;
        let size = if self.sim.scene().form.is_line() {
            format!("{}, half-width {half_width:.1} um", by_size(hertz.force, "N/m"))
        } else {
            format!(
                "{}, half-widths {half_width:.1} x {:.1} um",
                by_size(hertz.force, "N"),
                1e6 * hertz.half_width_y
            )
        };
        lines.push(format!("Hertz      {}, {size}", by_size(hertz.pressure, "Pa")));
        lines
    }

    /// Regime, film, load and friction.
    fn film_lines(&self) -> Vec<String> {
        let Expectation { roughness, correlation_length, flash_rise, film, .. } = &self.expectation;
        let length = correlation_length
            .map_or_else(String::new, |length| format!(", correlation length {:.1} um", 1e6 * length));
        let rough = if roughness.composite_rq == 0.0 {
            "roughness  smooth".to_owned()
        } else {
            let [ball, disc] = roughness.rq().map(|rq| 1e9 * rq);
            format!("roughness  Rq of ball {ball:.1} nm and disc {disc:.1} nm{length}")
        };
        let (Some(film), Some(formula)) = (film, self.formula) else {
            let load = "load       solids carry all of it".to_owned();
            return vec![
                "regime     dry".to_owned(),
                load,
                rough,
                format!("heat       flash of about {flash_rise:.1} K"),
            ];
        };
        let (map, moes) = (&film.map, formula.moes);
        let lambda = film.lambda.map_or_else(String::new, |lambda| format!(", {lambda:.3} of Rq (lambda)"));
        let supplied = self.sim.scene().lubricant.and_then(|oil| oil.supplied_film);
        let supplied =
            supplied.map_or_else(String::new, |film| format!(", {} at most is supplied", by_size(film, "m")));
        let mut lines = vec![
            format!(
                "regime     {} (g_V {:.3e}, g_E {:.3e}; Moes M {:.2}, L {:.3})",
                map.regime, map.viscosity_parameter, map.elasticity_parameter, moes.m, moes.l
            ),
            format!(
                "film       {} in the middle by the formula of {} over the relative density of the oil, smooth and \
                 flooded{supplied}{lambda}",
                by_size(film.central, "m"),
                film.formula
            ),
            format!("load       {}", load_words(film)),
            rough,
        ];
        lines.extend(self.contact_film_line(film));
        lines.extend(friction_line(film));
        lines
    }

    /// The contact film, and load on solids and friction at half and at twice of it.
    fn contact_film_line(&self, film: &ExpectedFilm) -> Option<String> {
        let shares = film.load_ratio_by_contact_film?.map(|share| format!("{:.0} %", 100.0 * share));
        let [half, twice] = match film.friction_by_contact_film {
            Some(friction) if friction[1] > 0.0 => {
                [0, 1].map(|k| format!("{} of the load and friction {:.4}", shares[k], friction[k]))
            }
            _ => shares.map(|share| format!("{share} of the load")),
        };
        let cutoff = 1e9 * self.sim.scene().solver.film_cutoff;
        Some(format!(
            "touch      at films of {cutoff:.2} nm; at half of it solids have {half}, at twice {twice}"
        ))
    }

    /// Viscosity and pressure-viscosity coefficient at the temperature of the contact, with their sources.
    fn oil_lines(&self) -> Vec<String> {
        let Some(oil) = &self.oil else { return Vec::new() };
        let scatter = if oil.alpha_uncertainty > 0.0 {
            format!(
                ", +- {:.0} %, which is +- {:.0} % of the film",
                100.0 * oil.alpha_uncertainty,
                100.0 * oil.film_uncertainty
            )
        } else {
            String::new()
        };
        let celsius = oil.temperature - 273.15;
        let at = match self.temperature {
            OilTemperature::Without => ", at any temperature".to_owned(),
            OilTemperature::Stated => format!(" at {celsius:.2} degC"),
            OilTemperature::Default => {
                format!(" at {celsius:.2} degC, the default without thermal.bulk_temperature")
            }
        };
        let mut lines = vec![
            format!("oil        {:.4} mPa s{at}: {}", 1e3 * oil.eta0, oil.eta0_source),
            format!("           alpha {:.2} 1/GPa: {}{scatter}", 1e9 * oil.alpha, oil.alpha_source),
        ];
        lines.extend(output::kappa(oil));
        lines
    }

    fn mesh_lines(&self) -> Vec<String> {
        let (grid, [inlet, outlet]) = (self.sim.grid(), self.room());
        if self.picks_grid {
            return vec!["mesh       picked by the solve for the accuracy that is asked for".to_owned()];
        }
        let mut lines = vec![format!(
            "mesh       {} x {} cells, {:.1} in a Hertz half-width; box from -{inlet:.2} to {outlet:.2} half-widths; about {:.0} MB",
            grid.nx(),
            grid.ny(),
            self.cells(),
            1e-6 * self.memory
        )];
        let scene = self.sim.scene();
        let has_errors = !matches!(scene.grid, GridSpec::Strip { .. }) && scene.cycle.is_none();
        if !self.has_estimate && has_errors {
            lines.push(
                "           `estimate = true` in [solver] estimates its error; `accuracy = 0.01` in place of the cells picks a mesh"
                    .to_owned(),
            );
        }
        lines
    }
}

/// Friction of solids and fluid; `None` without friction.
fn friction_line(film: &ExpectedFilm) -> Option<String> {
    let [boundary, fluid] = film.friction;
    let (all, rise) = (boundary + fluid, film.film_rise);
    if all.is_nan() {
        let text = "friction   not estimated: the oil carries over more than the Hertz contact; `stribeck solve` finds it";
        return Some(text.to_owned());
    }
    if all <= 0.0 {
        return None;
    }
    let range = film
        .friction_range
        .filter(|[least, most]| most - least > SPREAD * all)
        .map(|[least, most]| format!("{least:.4} to {most:.4} by the share of solids"));
    let of = match (film.load_ratio_range, range, film.load_ratio) {
        (None, ..) => format!("of the isothermal fluid alone about {fluid:.4}"),
        (Some(_), Some(range), None) => range,
        (Some(_), range, _) => {
            let range = range.map_or_else(String::new, |range| format!(", {range}"));
            format!("about {all:.4}{range}: solids {boundary:.4}, isothermal fluid {fluid:.4}")
        }
    };
    Some(format!("friction   {of}; it would warm the film by {rise:.1} K"))
}

/// Shares of the load on the film and on solids.
fn load_words(film: &ExpectedFilm) -> String {
    let per_cent = |share: f64| format!("{:.0} %", 100.0 * share);
    let Some([least, most]) = film.load_ratio_range else {
        return "not estimated: the formula is for random roughness in piezoviscous contacts; `stribeck solve` finds it"
            .to_owned();
    };
    let about = film.load_ratio.map_or_else(String::new, |share| format!("about {}, ", per_cent(share)));
    if most == 0.0 {
        "full film: the oil carries all of it".to_owned()
    } else if most < FULL_FILM {
        let reason = film.inlet_number.map_or_else(String::new, |number| {
            format!(
                ", by the inlets of the asperities and not by lambda (inlet number {number:.1}; half of the load at {})",
                MixedLoadShare::HALF
            )
        });
        format!("full film: the oil carries it, solids less than {}{reason}", per_cent(FULL_FILM))
    } else if least > BOUNDARY {
        format!("boundary lubrication: solids carry {about}at least {}", per_cent(BOUNDARY))
    } else {
        format!("mixed lubrication: solids carry {about}{} to {}", per_cent(least), per_cent(most))
    }
}
