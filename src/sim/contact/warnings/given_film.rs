//! Warnings about films between rigid surfaces.

use super::quantity::{GAS_VISCOSITY, GIVEN_FILM, PRESSURE_VISCOSITY};
use super::{Warning, short};
use crate::lubricant::Lubricant;
use crate::report::Status;
use crate::reynolds::{GivenFilm, GivenFilmSolution};

/// Largest pressure \[Pa\] of surfaces treated as rigid.
const LARGEST_PRESSURE: f64 = 1e9;

/// Largest factor `exp(alpha p)` of the viscosity of a film between rigid surfaces.
pub(super) const LARGEST_RISE: f64 = 1.1;

/// Remedy for a piezoviscous oil between rigid surfaces.
pub(super) const ISOVISCOUS: &str = "an isoviscous film: lubricant.alpha = 0 beside a grade, else lubricant.viscosity with law = \"barus\" and alpha = 0";

/// Warnings about implausible values of a film between rigid surfaces and of its `solution`: viscosity `eta0` and
/// pressure-viscosity coefficient `alpha` at ambient pressure, also where the viscosity rises notably with pressure, thinnest and thickest `film`, `pressure.max`, and `film_over_rq` of rough surfaces
/// below the range of the flow factors.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm};
/// use stribeck::sim::given_film_warnings;
/// let grid = Grid::from_edges(20, 1, [0.0, 1e-2], [0.0, 1.0])?;
/// let film = FilmThickness::from_function(grid, |x, _| 2.0 - 100.0 * x)?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let problem = GivenFilm::new(&film, &oil, [1.0, 0.0]);
/// let warnings = given_film_warnings(&problem, &problem.solve()?);
/// assert!(warnings[0].to_string().starts_with("film = 1025.0 mm: "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn given_film_warnings(problem: &GivenFilm<'_>, solution: &GivenFilmSolution) -> Vec<Warning> {
    film_warnings(problem, solution, true)
}

/// The warnings of [`given_film_warnings`]; those about rigid surfaces only of `is_rigid` ones.
pub(in crate::sim) fn film_warnings(
    problem: &GivenFilm<'_>,
    solution: &GivenFilmSolution,
    is_rigid: bool,
) -> Vec<Warning> {
    let nodes = problem.film.nodes();
    let thinnest = nodes.iter().copied().fold(f64::INFINITY, f64::min);
    let thickest = nodes.iter().copied().fold(0.0, f64::max);
    let film = [thinnest, thickest].into_iter().find_map(|film| GIVEN_FILM.check("film", film));
    let oil = problem.lubricant;
    // Pressures of an unsolved film are no result.
    let known = if solution.report.status == Status::Converged { &solution.pressure[..] } else { &[] };
    let largest = known.iter().copied().fold(0.0, f64::max);
    let piezoviscous = if is_rigid { piezoviscous(oil, largest) } else { None };
    let checks = [
        piezoviscous,
        GAS_VISCOSITY.check("eta0", oil.viscosity().viscosity(0.0)),
        PRESSURE_VISCOSITY.check("alpha", oil.pressure_viscosity_coefficient()),
        film,
        (largest > LARGEST_PRESSURE).then(|| {
            let message = format!("rigid surfaces deform above {} Pa", short(LARGEST_PRESSURE));
            Warning::new("pressure.max", largest, message, "solve a contact of elastic bodies".to_owned())
        }),
    ];
    let warnings = checks.into_iter().flatten();
    warnings.chain(too_close(problem, solution)).collect()
}

/// Warning about an oil whose viscosity rises notably with pressure, up to the `largest` pressure \[Pa\] between rigid surfaces.
fn piezoviscous(oil: &Lubricant, largest: f64) -> Option<Warning> {
    let alpha = oil.pressure_viscosity_coefficient();
    ((alpha * largest).exp() > LARGEST_RISE).then(|| {
        let law = oil.viscosity();
        let ratio = law.viscosity(largest) / law.viscosity(0.0);
        let message = format!(
            "the viscosity at the largest pressure is {ratio:.3} times that at ambient pressure; rigid surfaces with a piezoviscous oil \
             overestimate pressure and film"
        );
        Warning::new("alpha", alpha, message, ISOVISCOUS.to_owned())
    })
}

/// Warning about a film thinner than those for which the flow factors hold.
fn too_close(problem: &GivenFilm<'_>, solution: &GivenFilmSolution) -> Option<Warning> {
    let (rough, contact) = (problem.roughness?, solution.contact.as_ref()?);
    let (least, lowest) = (contact.least_separation, rough.flow.least_separation());
    (least < lowest).then(|| {
        let message = format!(
            "flow factors hold from {} Rq on for the Peklenik number {}; asperities touch more widely there than the mean contact assumes",
            short(lowest),
            short(rough.flow.gamma())
        );
        let remedy = "a thicker film: a lower load, a higher speed or a thicker oil".to_owned();
        Warning::new("film_over_rq", least, message, remedy)
    })
}
