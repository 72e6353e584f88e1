//! The numbers of a solution under the names that JSON, terminal and Python share.
//!
//! Two outlets of one [`ContactSolution`]: `Display`, the report for people in units at hand (nm, GPa), and,
//! with the feature `serde`, `Serialize`, the object in SI units that the command prints and Python returns.
//! A new number is a field of [`ContactSolution`], a line here and one in the table of `docs/output.md`,
//! which the tests compare.

use std::fmt;

use super::solution::ContactSolution;

impl fmt::Display for ContactSolution {
    /// A short report, one line a subject.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { report, grid, hertz, .. } = self;
        let (residuals, work) = (report.residuals, report.work);
        writeln!(f, "{} by {} on {} x {} nodes", report.status, report.solver, grid.nx(), grid.ny())?;
        writeln!(f, "residuals  {residuals}")?;
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
        self.write_roughness(f)?;
        writeln!(
            f,
            "friction   {:.4}: {:.4} of solid contact, {:.4} of the fluid",
            self.friction_coefficient, self.friction_boundary, self.friction_fluid
        )?;
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

    /// Composite roughness and the film over it.
    fn write_roughness(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.composite_rq == 0.0 {
            return writeln!(f, "roughness  none");
        }
        write!(f, "roughness  composite Rq {:.2} nm", self.composite_rq * 1e9)?;
        match self.lambda {
            Some(lambda) => writeln!(f, ", lambda {lambda:.3} (mean film over it)"),
            None => writeln!(f),
        }
    }

    /// What flows through the box, a metre of contact where it is a line.
    fn write_flow(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(flow) = self.flow else { return writeln!(f, "flow       none: dry") };
        let unit = if self.grid.ny() == 1 { "m^2/s" } else { "m^3/s" };
        let (inflow, outflow, imbalance) = (flow.inflow, flow.outflow, flow.imbalance);
        writeln!(f, "flow       in {inflow:.4e}, out {outflow:.4e} {unit}, imbalance {imbalance:.1e}")
    }

    /// Estimated errors of the mesh, the relative ones in per cent.
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

    /// Temperatures of the film and the surfaces; nothing where heat is not modelled.
    fn write_heat(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(heat) = &self.film_heat else { return Ok(()) };
        let [ball, disc] = heat.surface_rises;
        write!(
            f,
            "\nheat       film up to {:.2} K, ball up to {ball:.2} K and disc up to {disc:.2} K above the bulk; {} solves",
            heat.maximum, heat.solves
        )
    }

    /// Largest stresses below the surface and of the layer; nothing where they are not asked for.
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

    /// The object that stands for a solution: a field a name, `null` where there is nothing to tell.
    #[derive(Serialize)]
    struct Numbers<'a> {
        /// How the solve ended, in the words of [`Status`](crate::Status).
        status: String,
        /// Solver whose state was kept; two of them with a plus where the second finished the work.
        solver: String,
        /// The way that led to the state; none from solvers that know one alone.
        strategy: Option<String>,
        /// Discretisation of entrainment; none for a dry contact, as are the next three.
        scheme: Option<Scheme>,
        /// Law of the mobility of faces.
        face_mobility: Option<FaceMobility>,
        /// What becomes of the fluid where pressure would fall below zero.
        cavitation: Option<Cavitation>,
        /// What solids do where they touch.
        contact_definition: Option<ContactDefinition>,
        /// How far the state is from solving the discrete equations.
        residual: Residual,
        /// What the energy of a dry contact lies above its minimum at most, over the elastic energy.
        energy_error: Option<f64>,
        /// What the solve took.
        work: Work,
        /// The smooth dry elastic contact under the same load.
        hertz: Hertz,
        /// Dimensionless load and lubricant; none for a dry contact.
        moes: Option<Moes>,
        /// Film thicknesses \[m\].
        film: Film,
        /// Total pressures \[Pa\].
        pressure: Pressure,
        /// What solids share of area and load.
        contact: Contact,
        /// The coefficient and its parts.
        friction: Friction,
        /// Heights on the track.
        roughness: Roughness,
        /// What flows through the box; none for a dry contact.
        flow: Option<Flow>,
        /// Approach of the undeformed bodies \[m\].
        approach: f64,
        /// Largest stresses below the surface, where they are asked for.
        stress: Option<Stress>,
        /// Heat of the film, where it is asked for.
        thermal: Option<Thermal>,
        /// Errors of the mesh, where they are asked for and can be told.
        error_estimate: Option<Errors>,
        /// Cells and their size.
        grid: Cells,
        /// What is unlikely to be meant or to hold, empty as a rule.
        warnings: &'a [Warning],
        /// Version of the crate.
        version: &'static str,
    }

    /// Residuals of the discrete equations, all without a unit.
    #[derive(Serialize)]
    struct Residual {
        /// Imbalance of mass over what the mean film carries or what flows in, whichever is less.
        mass: f64,
        /// Error of the load balance over the load.
        load: f64,
        /// Violation of the inequalities.
        complementarity: f64,
    }

    /// What a solve took.
    #[derive(Serialize)]
    struct Work {
        /// Elastic convolutions in equivalents of this grid.
        convolutions: f64,
        /// Outer iterations.
        iterations: u64,
        /// Inner iterations: Krylov or conjugate-gradient steps.
        inner_iterations: u64,
    }

    /// The Hertz contact.
    #[derive(Serialize)]
    struct Hertz {
        /// `sqrt(a_x a_y)` of a point, half the width of a line \[m\].
        radius: f64,
        /// Semi-axis along x \[m\].
        half_width_x: f64,
        /// Semi-axis along y \[m\]; half a metre of a line.
        half_width_y: f64,
        /// Largest pressure \[Pa\].
        pressure: f64,
        /// Load \[N\].
        force: f64,
    }

    /// Moes' parameters.
    #[derive(Serialize)]
    struct Moes {
        /// Load parameter M.
        m: f64,
        /// Lubricant parameter L.
        l: f64,
    }

    /// Films \[m\].
    #[derive(Serialize)]
    struct Film {
        /// At `x = y = 0`, interpolated between nodes.
        central: f64,
        /// Smallest of the nodes that carry pressure.
        minimum: f64,
        /// Mean within two thirds of the Hertz radii.
        mean_central: f64,
        /// Smallest of all nodes.
        minimum_gap: f64,
        /// Mean film over composite Rq; none between smooth surfaces.
        lambda: Option<f64>,
    }

    /// Total pressures \[Pa\].
    #[derive(Serialize)]
    struct Pressure {
        /// Largest.
        max: f64,
        /// At `x = y = 0`.
        central: f64,
    }

    /// Solid contact.
    #[derive(Serialize)]
    struct Contact {
        /// Its area within the Hertz contact over the area of that.
        area_ratio: f64,
        /// Share of the load that it carries.
        load_ratio: f64,
        /// Its area \[m^2\].
        area: f64,
        /// Area ratio with the edges of the contacts corrected.
        corrected_area_ratio: f64,
        /// Area with the edges of the contacts corrected \[m^2\].
        corrected_area: f64,
        /// Area of the nodes at the pressure limit \[m^2\].
        plastic_area: f64,
        /// Film at which solids touch \[m\]; zero in a dry contact.
        film_cutoff: f64,
    }

    /// Friction over load.
    #[derive(Serialize)]
    struct Friction {
        /// The sum of both parts.
        coefficient: f64,
        /// Part of solid contact.
        boundary: f64,
        /// Part of shear of the fluid.
        fluid: f64,
    }

    /// Roughness of both surfaces together.
    #[derive(Serialize)]
    struct Roughness {
        /// `sqrt(Rq_ball^2 + Rq_disc^2)` on the track \[m\].
        composite_rq: f64,
    }

    /// Balance of the box at ambient density \[m^3/s\]; of a line \[m^2/s\].
    #[derive(Serialize)]
    struct Flow {
        /// What flows in.
        inflow: f64,
        /// What flows out.
        outflow: f64,
        /// `|outflow - inflow| / inflow`.
        imbalance: f64,
    }

    /// Largest stresses below the surface, of the substrate where there is a layer.
    #[derive(Serialize)]
    struct Stress {
        /// Stress of von Mises.
        von_mises: Largest,
        /// Magnitude of the shear stress along x on planes parallel to the surface.
        orthogonal_shear: Largest,
        /// Stress of von Mises over the yield strength, where that is given.
        yield_ratio: Option<f64>,
        /// Orthogonal shear over the yield stress in shear, `yield_strength / sqrt 3`.
        shakedown_ratio: Option<f64>,
        /// Those of the layer, where there is one.
        layer: Option<LayerStress>,
    }

    /// Largest stresses of a layer and its bond.
    #[derive(Serialize)]
    struct LayerStress {
        /// Stress of von Mises within the layer.
        von_mises: Largest,
        /// Shear stress at the bond.
        bond_shear: Largest,
        /// Tension at the bond; zero where there is none.
        bond_tension: Largest,
    }

    /// Heat of the film.
    #[derive(Serialize)]
    struct Thermal {
        /// Largest mean temperature across the film \[K\].
        film_temperature_max: f64,
        /// Its mean within two thirds of the Hertz radii \[K\].
        film_temperature_mean_central: f64,
        /// Largest rise of the ball's surface above the bulk \[K\].
        surface_rise_ball: f64,
        /// Largest rise of the disc's surface above the bulk \[K\].
        surface_rise_disc: f64,
        /// Heat that is made \[W\].
        heat: f64,
        /// Heat that comes from nowhere over what comes and goes.
        imbalance: f64,
        /// Solves of the contact until film and heat agreed.
        solves: usize,
        /// Largest difference of `ln eta` between what the last of them had and what its heat makes.
        change: f64,
    }

    /// A largest stress and where it is.
    #[derive(Serialize)]
    struct Largest {
        /// The stress \[Pa\].
        stress: f64,
        /// Depth below the surface \[m\].
        depth: f64,
        /// Position along entrainment \[m\].
        x: f64,
        /// Position across it \[m\].
        y: f64,
    }

    impl Largest {
        /// The numbers of `extreme`.
        fn of(extreme: &Extreme) -> Self {
            let (x, y) = extreme.place;
            Self { stress: extreme.stress, depth: extreme.depth, x, y }
        }
    }

    /// Estimated errors of the mesh: relative ones, but for the two ratios.
    #[derive(Serialize)]
    struct Errors {
        /// Of the central film.
        central_film: f64,
        /// Of the minimum film.
        minimum_film: f64,
        /// Of the largest pressure.
        max_pressure: f64,
        /// Of the mean film.
        mean_film: f64,
        /// Of the load ratio, absolute.
        load_ratio: f64,
        /// Of the area ratio, absolute.
        area_ratio: f64,
        /// Of the friction coefficient.
        friction_coefficient: f64,
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
        /// Width of a cell \[m\]; a metre of a line.
        dy: f64,
    }

    impl Serialize for ContactSolution {
        /// The numbers of the solution in SI units under their names in `docs/output.md`, without the fields.
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            self.numbers().serialize(serializer)
        }
    }

    impl ContactSolution {
        /// All numbers under their names.
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

        /// Residuals of the report.
        fn residual_numbers(&self) -> Residual {
            let residuals = self.report.residuals;
            Residual {
                mass: residuals.mass,
                load: residuals.load,
                complementarity: residuals.complementarity,
            }
        }

        /// Work of the report.
        fn work_numbers(&self) -> Work {
            let work = self.report.work;
            Work {
                convolutions: work.convolutions,
                iterations: work.iterations,
                inner_iterations: work.inner_iterations,
            }
        }

        /// The Hertz contact.
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

        /// Films of the metrics, and lambda.
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

        /// Solid contact of the metrics.
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

        /// Heat of the film, where it is modelled.
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

        /// The estimate of errors, where there is one.
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
