//! The numbers of a solution under the names that JSON, terminal and Python share.

use std::fmt;

use super::solution::ContactSolution;

impl fmt::Display for ContactSolution {
    /// A short report, one line a subject.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { report, grid, hertz, .. } = self;
        let (residuals, work) = (report.residuals, report.work);
        writeln!(f, "{} by {} on {} x {} nodes", report.status, report.solver, grid.nx(), grid.ny())?;
        writeln!(
            f,
            "residuals  mass {:.1e}, load {:.1e}, complementarity {:.1e}",
            residuals.mass, residuals.load, residuals.complementarity
        )?;
        writeln!(
            f,
            "work       {} iterations, {} inner, {:.0} convolutions",
            work.iterations, work.inner_iterations, work.convolutions
        )?;
        let moes = self.moes.map_or_else(|| "dry".to_owned(), |(m, l)| format!("Moes M {m:.1}, L {l:.3}"));
        writeln!(
            f,
            "Hertz      {:.4} GPa, {:.4} N, {:.2} x {:.2} um; {moes}",
            hertz.p_max * 1e-9,
            hertz.load,
            hertz.a_x * 1e6,
            hertz.a_y * 1e6
        )?;
        self.write_film(f)?;
        writeln!(f, "friction   {:.4}", self.friction_coefficient)?;
        self.write_flow(f)?;
        writeln!(f, "approach   {:.3} nm", self.state.approach * 1e9)?;
        self.write_errors(f)?;
        self.write_heat(f)?;
        self.write_stress(f)
    }
}

impl ContactSolution {
    /// Film, pressure and solid contact.
    fn write_film(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { film, contact, .. } = self;
        writeln!(
            f,
            "film       central {:.3} nm, minimum {:.3} nm, mean {:.3} nm",
            film.central * 1e9,
            film.minimum * 1e9,
            film.mean_central * 1e9
        )?;
        writeln!(
            f,
            "pressure   maximum {:.4} GPa, central {:.4} GPa",
            contact.max_pressure * 1e-9,
            contact.central_pressure * 1e-9
        )?;
        writeln!(
            f,
            "contact    below {:.2} nm: {:.2} % of the Hertz area, {:.2} % of the load, {:.1} um^2 plastic",
            contact.film_cutoff * 1e9,
            contact.area_ratio * 100.0,
            contact.load_ratio * 100.0,
            contact.plastic_area * 1e12
        )
    }

    fn write_flow(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(flow) = self.flow else { return writeln!(f, "flow       none: dry") };
        let unit = if self.grid.ny() == 1 { "m^2/s" } else { "m^3/s" };
        let (inflow, outflow, imbalance) = (flow.inflow, flow.outflow, flow.imbalance);
        writeln!(f, "flow       in {inflow:.4e}, out {outflow:.4e} {unit}, imbalance {imbalance:.1e}")
    }

    fn write_errors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(estimate) = self.error_estimate else { return write!(f, "errors     not estimated") };
        write!(
            f,
            "errors     central film {:.2} %, minimum film {:.2} %, maximum pressure {:.2} %, mean film {:.2} %, friction {:.2} %, \
             load ratio {:.4}, area ratio {:.4}",
            estimate.central_film * 100.0,
            estimate.minimum_film * 100.0,
            estimate.max_pressure * 100.0,
            estimate.mean_film * 100.0,
            estimate.friction_coefficient * 100.0,
            estimate.load_ratio,
            estimate.area_ratio
        )
    }

    fn write_heat(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(heat) = &self.film_heat else { return Ok(()) };
        let [ball, disc] = heat.surface_rises;
        write!(
            f,
            "\nheat       film up to {:.2} K, ball up to {ball:.2} K and disc up to {disc:.2} K above the bulk; {} solves",
            heat.maximum, heat.solves
        )
    }

    fn write_stress(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(stress) = self.stress else { return Ok(()) };
        let (mises, shear) = (stress.largest.von_mises, stress.largest.orthogonal_shear);
        write!(
            f,
            "\nstress     von Mises {:.4} GPa at {:.2} um, orthogonal shear {:.4} GPa at {:.2} um",
            mises.stress * 1e-9,
            mises.depth * 1e6,
            shear.stress * 1e-9,
            shear.depth * 1e6
        )?;
        let Some(layer) = stress.layer else { return Ok(()) };
        write!(
            f,
            "\nlayer      von Mises {:.4} GPa at {:.2} um, bond: shear {:.4} GPa, tension {:.4} GPa",
            layer.von_mises.stress * 1e-9,
            layer.von_mises.depth * 1e6,
            layer.bond_shear.stress * 1e-9,
            layer.bond_tension.stress * 1e-9
        )
    }
}

#[cfg(feature = "serde")]
mod named {
    //! Names of the numbers, all in SI units; `docs/output.md` says what they are.

    use serde::{Serialize, Serializer};

    use super::ContactSolution;
    use crate::elastic::Extreme;
    use crate::reynolds::{Cavitation, ContactDefinition, FaceMobility, Scheme};
    use crate::sim::Warning;

    #[derive(Serialize)]
    struct Numbers<'a> {
        status: String,
        solver: String,
        strategy: Option<String>,
        scheme: Option<Scheme>,
        face_mobility: Option<FaceMobility>,
        cavitation: Option<Cavitation>,
        contact_definition: Option<ContactDefinition>,
        residual: Residual,
        energy_error: Option<f64>,
        work: Work,
        hertz: Hertz,
        moes: Option<Moes>,
        film: Film,
        pressure: Pressure,
        contact: Contact,
        friction: Friction,
        roughness: Roughness,
        flow: Option<Flow>,
        approach: f64,
        stress: Option<Stress>,
        thermal: Option<Thermal>,
        error_estimate: Option<Errors>,
        grid: Cells,
        warnings: &'a [Warning],
        version: &'static str,
    }

    #[derive(Serialize)]
    struct Residual {
        mass: f64,
        load: f64,
        complementarity: f64,
    }

    #[derive(Serialize)]
    struct Work {
        convolutions: f64,
        iterations: u64,
        inner_iterations: u64,
    }

    #[derive(Serialize)]
    struct Hertz {
        radius: f64,
        half_width_x: f64,
        half_width_y: f64,
        pressure: f64,
        force: f64,
    }

    #[derive(Serialize)]
    struct Moes {
        m: f64,
        l: f64,
    }

    #[derive(Serialize)]
    struct Film {
        central: f64,
        minimum: f64,
        mean_central: f64,
        minimum_gap: f64,
        lambda: Option<f64>,
    }

    #[derive(Serialize)]
    struct Pressure {
        max: f64,
        central: f64,
    }

    #[derive(Serialize)]
    struct Contact {
        area_ratio: f64,
        load_ratio: f64,
        area: f64,
        corrected_area_ratio: f64,
        corrected_area: f64,
        plastic_area: f64,
        film_cutoff: f64,
    }

    #[derive(Serialize)]
    struct Friction {
        coefficient: f64,
        boundary: f64,
        fluid: f64,
    }

    #[derive(Serialize)]
    struct Roughness {
        composite_rq: f64,
    }

    #[derive(Serialize)]
    struct Flow {
        inflow: f64,
        outflow: f64,
        imbalance: f64,
    }

    #[derive(Serialize)]
    struct Stress {
        von_mises: Largest,
        orthogonal_shear: Largest,
        yield_ratio: Option<f64>,
        shakedown_ratio: Option<f64>,
        layer: Option<LayerStress>,
    }

    #[derive(Serialize)]
    struct LayerStress {
        von_mises: Largest,
        bond_shear: Largest,
        bond_tension: Largest,
    }

    #[derive(Serialize)]
    struct Thermal {
        film_temperature_max: f64,
        film_temperature_mean_central: f64,
        surface_rise_ball: f64,
        surface_rise_disc: f64,
        heat: f64,
        imbalance: f64,
        solves: usize,
        change: f64,
    }

    #[derive(Serialize)]
    struct Largest {
        stress: f64,
        depth: f64,
        x: f64,
        y: f64,
    }

    impl Largest {
        fn of(extreme: &Extreme) -> Self {
            let (x, y) = extreme.place;
            Self { stress: extreme.stress, depth: extreme.depth, x, y }
        }
    }

    #[derive(Serialize)]
    struct Errors {
        central_film: f64,
        minimum_film: f64,
        max_pressure: f64,
        mean_film: f64,
        load_ratio: f64,
        area_ratio: f64,
        friction_coefficient: f64,
    }

    #[derive(Serialize)]
    struct Cells {
        nx: usize,
        ny: usize,
        dx: f64,
        dy: f64,
    }

    impl Serialize for ContactSolution {
        /// The numbers of the solution in SI units under their names in `docs/output.md`, without the fields.
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            self.numbers().serialize(serializer)
        }
    }

    impl ContactSolution {
        fn numbers(&self) -> Numbers<'_> {
            let (report, contact) = (&self.report, &self.contact);
            Numbers {
                status: report.status.to_string(),
                solver: report.solver.to_string(),
                strategy: report.strategy.map(|strategy| strategy.to_string()),
                scheme: self.discretisation.map(|(scheme, ..)| scheme),
                face_mobility: self.discretisation.map(|(_, face_mobility, _)| face_mobility),
                cavitation: self.cavitation,
                contact_definition: self.discretisation.map(|(.., contact)| contact),
                residual: self.residual_numbers(),
                energy_error: report.energy_error,
                work: self.work_numbers(),
                hertz: self.hertz_numbers(),
                moes: self.moes.map(|(m, l)| Moes { m, l }),
                film: self.film_numbers(),
                pressure: Pressure { max: contact.max_pressure, central: contact.central_pressure },
                contact: self.contact_numbers(),
                friction: Friction {
                    coefficient: self.friction_coefficient,
                    boundary: self.friction_boundary,
                    fluid: self.friction_fluid,
                },
                roughness: Roughness { composite_rq: self.composite_rq },
                flow: self.flow.map(|flow| Flow {
                    inflow: flow.inflow,
                    outflow: flow.outflow,
                    imbalance: flow.imbalance,
                }),
                approach: self.state.approach,
                stress: self.stress.map(|stress| Stress {
                    von_mises: Largest::of(&stress.largest.von_mises),
                    orthogonal_shear: Largest::of(&stress.largest.orthogonal_shear),
                    yield_ratio: stress.yield_ratio,
                    shakedown_ratio: stress.shakedown_ratio,
                    layer: stress.layer.map(|layer| LayerStress {
                        von_mises: Largest::of(&layer.von_mises),
                        bond_shear: Largest::of(&layer.bond_shear),
                        bond_tension: Largest::of(&layer.bond_tension),
                    }),
                }),
                thermal: self.thermal_numbers(),
                error_estimate: self.error_numbers(),
                grid: Cells {
                    nx: self.grid.nx(),
                    ny: self.grid.ny(),
                    dx: self.grid.dx(),
                    dy: self.grid.dy(),
                },
                warnings: &self.warnings,
                version: env!("CARGO_PKG_VERSION"),
            }
        }

        fn residual_numbers(&self) -> Residual {
            let residuals = self.report.residuals;
            Residual {
                mass: residuals.mass,
                load: residuals.load,
                complementarity: residuals.complementarity,
            }
        }

        fn work_numbers(&self) -> Work {
            let work = self.report.work;
            Work {
                convolutions: work.convolutions,
                iterations: work.iterations,
                inner_iterations: work.inner_iterations,
            }
        }

        fn hertz_numbers(&self) -> Hertz {
            let hertz = &self.hertz;
            Hertz {
                radius: hertz.radius,
                half_width_x: hertz.a_x,
                half_width_y: hertz.a_y,
                pressure: hertz.p_max,
                force: hertz.load,
            }
        }

        fn film_numbers(&self) -> Film {
            let film = &self.film;
            Film {
                central: film.central,
                minimum: film.minimum,
                mean_central: film.mean_central,
                minimum_gap: film.minimum_gap,
                lambda: self.lambda,
            }
        }

        fn contact_numbers(&self) -> Contact {
            let contact = &self.contact;
            Contact {
                area_ratio: contact.area_ratio,
                load_ratio: contact.load_ratio,
                area: contact.area,
                corrected_area_ratio: contact.corrected_area_ratio,
                corrected_area: contact.corrected_area,
                plastic_area: contact.plastic_area,
                film_cutoff: contact.film_cutoff,
            }
        }

        fn thermal_numbers(&self) -> Option<Thermal> {
            let heat = self.film_heat.as_ref()?;
            let [surface_rise_ball, surface_rise_disc] = heat.surface_rises;
            Some(Thermal {
                film_temperature_max: heat.maximum,
                film_temperature_mean_central: heat.mean_central,
                surface_rise_ball,
                surface_rise_disc,
                heat: heat.balance.generated,
                imbalance: heat.balance.imbalance(),
                solves: heat.solves,
                change: heat.change,
            })
        }

        fn error_numbers(&self) -> Option<Errors> {
            self.error_estimate.map(|estimate| Errors {
                central_film: estimate.central_film,
                minimum_film: estimate.minimum_film,
                max_pressure: estimate.max_pressure,
                mean_film: estimate.mean_film,
                load_ratio: estimate.load_ratio,
                area_ratio: estimate.area_ratio,
                friction_coefficient: estimate.friction_coefficient,
            })
        }
    }
}
