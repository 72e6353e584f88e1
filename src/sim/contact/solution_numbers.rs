//! Results of a solution, with the same names in JSON, terminal and Python.
//!
//! [`ContactSolution`] has two outputs: `Display` is a report in handy units (nm, GPa); `Serialize` (feature `serde`) is
//! the object in SI units that the command prints and Python returns. A new result needs a field of
//! [`ContactSolution`], a line here and one in the table of `docs/output.md`, which the tests compare.

use std::fmt;

use crate::report::Status;
use crate::sim::contact::solution::ContactSolution;
use crate::units::by_size;

/// Largest load ratio of a full film.
const FULL_FILM: f64 = 0.05;

impl fmt::Display for ContactSolution {
    /// A short report, one line per topic.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { report, grid, hertz, .. } = self;
        let (residuals, work) = (report.residual, report.work);
        writeln!(f, "{} by {} on {} x {} nodes", report.status, report.solver, grid.nx(), grid.ny())?;
        if report.status != Status::Converged {
            writeln!(
                f,
                "result     not a solution: the numbers are those of the best state; other cells, a larger solver.tolerance, or another seed of random \
                 roughness"
            )?;
        }
        writeln!(f, "residuals  {residuals}")?;
        writeln!(
            f,
            "work       {} iterations, {} inner, {:.0} convolutions",
            work.iterations, work.inner_iterations, work.convolutions
        )?;
        let moes = self
            .moes
            .map_or_else(|| "dry".to_owned(), |moes| format!("Moes M {:.1}, L {:.3}", moes.m, moes.l));
        writeln!(
            f,
            "Hertz      {}, {}; {moes}",
            by_size(hertz.pressure, "Pa"),
            if self.is_line() {
                format!("{}, half-width {}", by_size(hertz.force, "N/m"), by_size(hertz.half_width_x, "m"))
            } else {
                format!(
                    "{}, {} x {}",
                    by_size(hertz.force, "N"),
                    by_size(hertz.half_width_x, "m"),
                    by_size(hertz.half_width_y, "m")
                )
            }
        )?;
        self.write_film(f)?;
        self.write_roughness(f)?;
        writeln!(
            f,
            "friction   {}: {} of solid contact, {} of the fluid; power loss {}",
            coefficient(self.friction.coefficient),
            coefficient(self.friction.boundary),
            coefficient(self.friction.fluid),
            by_size(self.friction.power_loss, if self.is_line() { "W/m" } else { "W" })
        )?;
        self.write_flow(f)?;
        writeln!(f, "approach   {}", by_size(self.state.approach, "m"))?;
        self.write_errors(f)?;
        self.write_heat(f)?;
        self.write_starvation(f)?;
        self.write_stress(f)
    }
}

/// A friction coefficient, by powers of ten below a thousandth.
fn coefficient(value: f64) -> String {
    let rounded = value.abs() < 1e-9;
    if value.abs() >= 1e-3 || rounded { format!("{value:.4}") } else { format!("{value:.2e}") }
}

impl ContactSolution {
    /// Whether loads, areas and flows are per metre of a line contact.
    fn is_line(&self) -> bool {
        !self.grid.has_side_edges()
    }

    /// Film, pressure and solid contact.
    fn write_film(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { film, contact, .. } = self;
        // The gap of solids that touch is rounding.
        let length = |film: f64| if film.is_nan() { "unknown".to_owned() } else { by_size(film, "m") };
        if self.moes.is_some() {
            writeln!(
                f,
                "film       central {}, minimum {}, mean {}{}",
                length(film.central),
                length(film.minimum),
                length(film.mean_central),
                film.formula_ratio.map_or_else(String::new, |ratio| {
                    let which = if self.roughness.composite_rq > 0.0 { "mean" } else { "central" };
                    let limit = if contact.load_ratio > FULL_FILM {
                        " (the formula holds for full films)"
                    } else {
                        ""
                    };
                    let formula =
                        self.film_formula.map_or_else(String::new, |formula| format!(" of {formula}"));
                    format!("; {which} over formula{formula} {ratio:.3}{limit}")
                })
            )?;
        }
        writeln!(
            f,
            "pressure   maximum {}, central {}",
            by_size(self.pressure.max, "Pa"),
            by_size(self.pressure.central, "Pa")
        )?;
        writeln!(
            f,
            "contact    below {:.2} nm: {:.2} % of the Hertz area, {:.2} % of the load, {} plastic",
            contact.film_cutoff * 1e9,
            contact.area_ratio * 100.0,
            contact.load_ratio * 100.0,
            if self.is_line() {
                format!("{:.2} % of the area", 100.0 * contact.plastic_area / self.hertz.area)
            } else {
                format!("{:.1} um^2", contact.plastic_area * 1e12)
            }
        )
    }

    /// Composite roughness and the film over it.
    fn write_roughness(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.roughness.composite_rq == 0.0 {
            return writeln!(f, "roughness  none");
        }
        write!(f, "roughness  composite Rq {:.2} nm", self.roughness.composite_rq * 1e9)?;
        match self.film.lambda {
            Some(lambda) => {
                write!(f, ", lambda {lambda:.3} (mean film over it)")?;
                match self.film.minimum_lambda {
                    Some(least) => writeln!(f, ", {least:.3} of the minimum film"),
                    None => writeln!(f),
                }
            }
            None => writeln!(f),
        }
    }

    /// Flow through the box, per metre for a line contact.
    fn write_flow(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(flow) = self.flow else {
            let reason =
                if self.model.is_some() { "not solved with model asperity_inlets" } else { "none: dry" };
            return writeln!(f, "flow       {reason}");
        };
        let unit = if self.is_line() { "m^2/s" } else { "m^3/s" };
        let [inflow, outflow] = [flow.inflow, flow.outflow].map(|flow| by_size(flow, unit));
        writeln!(f, "flow       in {inflow}, out {outflow}, imbalance {:.1e}", flow.imbalance)
    }

    /// Estimated errors of the mesh, relative ones in per cent.
    fn write_errors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(estimate) = self.error_estimate else { return write!(f, "errors     not estimated") };
        write!(
            f,
            "errors     central film {:.2} %, minimum film {:.2} %, maximum pressure {:.2} %, mean film {:.2} %, friction {:.2} %, \
             load ratio {:.4}, area ratio {:.4}",
            estimate.film_central * 100.0,
            estimate.film_minimum * 100.0,
            estimate.pressure_max * 100.0,
            estimate.film_mean_central * 100.0,
            estimate.friction_coefficient * 100.0,
            estimate.contact_load_ratio,
            estimate.contact_area_ratio
        )
    }

    /// Flash temperature; temperatures of film and surfaces, if modelled.
    fn write_heat(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(rise) = self.flash_rise {
            write!(f, "\nflash      surfaces up to {rise:.2} K above the bulk")?;
        }
        let Some(heat) = &self.thermal else { return Ok(()) };
        let (ball, disc) = (heat.surface_rise_ball, heat.surface_rise_disc);
        write!(
            f,
            "\nheat       film up to {:.2} K, ball up to {ball:.2} K and disc up to {disc:.2} K above the bulk; {} solves",
            heat.film_temperature_max, heat.solves
        )
    }

    /// Film over that of the flooded contact, if the supply of oil is limited.
    fn write_starvation(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(starvation) = self.starvation else { return Ok(()) };
        write!(
            f,
            "\nstarved    central film {:.3} of the flooded one of {}",
            starvation.film_ratio,
            by_size(starvation.flooded_film, "m")
        )?;
        match self.film.fluid_fraction {
            Some(fraction) => write!(f, "; oil fills {:.2} % of the gap in the contact", 100.0 * fraction),
            None => Ok(()),
        }
    }

    /// Largest stresses below the surface and of the layer, if requested.
    fn write_stress(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(stress) = self.stress else { return Ok(()) };
        let (mises, shear) = (stress.von_mises, stress.orthogonal_shear);
        write!(
            f,
            "\nstress     von Mises {} at {}, orthogonal shear {} at {}",
            by_size(mises.stress, "Pa"),
            by_size(mises.depth, "m"),
            by_size(shear.stress, "Pa"),
            by_size(shear.depth, "m")
        )?;
        let Some(layer) = stress.layer else { return Ok(()) };
        write!(
            f,
            "\nlayer      von Mises {} at {}, bond: shear {}, tension {}, surface: tension {}",
            by_size(layer.von_mises.stress, "Pa"),
            by_size(layer.von_mises.depth, "m"),
            by_size(layer.bond_shear.stress, "Pa"),
            by_size(layer.bond_tension.stress, "Pa"),
            by_size(layer.surface_tension.stress, "Pa")
        )
    }
}

#[cfg(feature = "serde")]
mod named {
    //! Names of the results in SI units; `docs/output.md` defines them.

    use serde::{Serialize, Serializer};

    use crate::reynolds::{Cavitation, ContactDefinition, FaceMobility, FlowBalance, Scheme};
    use crate::sim::contact::error_estimate::ErrorEstimate;
    use crate::sim::contact::formula::FilmFormula;
    use crate::sim::contact::numbers::{
        ContactNumbers, FilmNumbers, FrictionNumbers, Moes, PressureNumbers, RoughnessNumbers,
        StarvationNumbers, StressNumbers, ThermalNumbers,
    };
    use crate::sim::contact::solution::ContactSolution;
    use crate::sim::contact::warnings::Warning;
    use crate::sim::scene::SolverModel;
    use crate::sim::scene::hertz::HertzContact;
    use crate::{Grid, SolveReport};

    /// Serialized form of a solution: its results, `null` if unknown.
    #[derive(Serialize)]
    struct Numbers<'a> {
        #[serde(flatten)]
        report: &'a SolveReport,
        model: Option<SolverModel>,
        scheme: Option<Scheme>,
        face_mobility: Option<FaceMobility>,
        cavitation: Option<Cavitation>,
        contact_definition: Option<ContactDefinition>,
        hertz: HertzContact,
        moes: Option<Moes>,
        film_formula: Option<FilmFormula>,
        film: FilmNumbers,
        pressure: PressureNumbers,
        contact: ContactNumbers,
        friction: FrictionNumbers,
        roughness: RoughnessNumbers,
        flow: Option<FlowBalance>,
        /// Approach of the undeformed bodies \[m\].
        approach: f64,
        stress: Option<StressNumbers>,
        thermal: Option<ThermalNumbers>,
        /// Largest flash temperature rise \[K\].
        flash_rise: Option<f64>,
        starvation: Option<StarvationNumbers>,
        error_estimate: Option<ErrorEstimate>,
        grid: Cells,
        warnings: &'a [Warning],
        /// Version of the crate.
        version: &'static str,
    }

    /// The grid.
    #[derive(Serialize)]
    struct Cells {
        /// Cells along entrainment.
        nx: usize,
        /// Cells across it.
        ny: usize,
        /// Length of a cell \[m\].
        dx: f64,
        /// Width of a cell \[m\]; one metre for a line contact.
        dy: f64,
    }

    impl Cells {
        fn of(grid: &Grid) -> Self {
            Self { nx: grid.nx(), ny: grid.ny(), dx: grid.dx(), dy: grid.dy() }
        }
    }

    impl Serialize for ContactSolution {
        /// The results of the solution in SI units with the names in `docs/output.md`, without fields.
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let numbers = Numbers {
                report: &self.report,
                model: self.model,
                scheme: self.scheme,
                face_mobility: self.face_mobility,
                cavitation: self.cavitation,
                contact_definition: self.contact_definition,
                hertz: self.hertz,
                moes: self.moes,
                film_formula: self.film_formula,
                film: self.film,
                pressure: self.pressure,
                contact: self.contact,
                friction: self.friction,
                roughness: self.roughness,
                flow: self.flow,
                approach: self.state.approach,
                stress: self.stress,
                thermal: self.thermal,
                flash_rise: self.flash_rise,
                starvation: self.starvation,
                error_estimate: self.error_estimate,
                grid: Cells::of(&self.grid),
                warnings: &self.warnings,
                version: env!("CARGO_PKG_VERSION"),
            };
            numbers.serialize(serializer)
        }
    }
}
