//! Journal bearings at a given eccentricity and under a given load.

use super::bearing::{JournalBearing, JournalSolution};
use super::elastic_equilibrium;
use super::load_search::find_load;
use crate::error::InputError;
use crate::numerics::FalsePosition;
use crate::reynolds::ReynoldsError;
use crate::reynolds::given_film::MeanRoughness;

/// Largest eccentricity of an equilibrium of smooth surfaces.
const MOST_ECCENTRIC: f64 = 0.99;
/// Relative error of the load of an equilibrium.
const LOAD_TOLERANCE: f64 = 1e-6;
/// Change of the attitude angle \[rad\] below which grooves keep their position to the line of centers.
const ATTITUDE_TOLERANCE: f64 = 1e-3;
/// Part of the way to either end within which the eccentricity moves with the angle of the feeds.
const NEAR: f64 = 0.03;
/// First attitude angle \[rad\], that of moderate loads.
const FIRST_ATTITUDE: f64 = 0.8;
/// Share of the change of the attitude angle that a step takes.
const DAMPING: f64 = 0.8;
/// Most positions of the grooves at one eccentricity.
const MOST_POSITIONS: usize = 20;

impl JournalBearing<'_> {
    /// Solves at an `eccentricity` of the axes over the clearance, 0 to below 1.
    ///
    /// # Errors
    /// A value out of range, a grid that exceeds the memory.
    pub fn solve(&self, eccentricity: f64) -> Result<JournalSolution, ReynoldsError> {
        self.solve_unless(eccentricity, &|| false)
    }

    /// The eccentricity at which the film carries `load` \[N\], by false position (Illinois).
    ///
    /// # Errors
    /// A value out of range, a load that needs an eccentricity above 0.99 (for rough surfaces also a film below half the root mean square
    /// height), a grid that exceeds the memory.
    pub fn equilibrium(&self, load: f64) -> Result<JournalSolution, ReynoldsError> {
        self.equilibrium_unless(load, &|| false)
    }

    /// Like [`equilibrium`](Self::equilibrium), but ends with an error soon after `interrupted` returns true.
    ///
    /// # Errors
    /// Those of [`equilibrium`](Self::equilibrium), and [`ReynoldsError::Interrupted`].
    pub fn equilibrium_unless(
        &self,
        load: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        InputError::require_positive("load", load)?;
        self.with_settled_load(|attitude, last| {
            let near = last.filter(|_| self.bore.is_none()).map(|last| last.eccentricity);
            match near
                .map(|near| self.equilibrium_near(load, attitude, near, interrupted))
                .transpose()?
                .flatten()
            {
                Some(solution) => Ok(solution),
                None => self.equilibrium_at(load, attitude, interrupted),
            }
        })
    }

    /// The equilibrium under `load` with grooves at the `attitude` angle.
    fn equilibrium_at(
        &self,
        load: f64,
        attitude: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        if let Some(bore) = self.bore {
            return elastic_equilibrium::equilibrium(self, bore, [load, attitude], interrupted);
        }
        let most = self.most_eccentric();
        let solution = self.solve_at(most, attitude, interrupted)?;
        if solution.load < load {
            let remedy = "a smaller load, a thicker oil, a higher speed or a smaller clearance";
            return Err(self.overload([load, solution.load, most], remedy).into());
        }
        // The load is zero at the eccentricity zero and grows with it, steeply near one: where false position is slow,
        // halving brackets the root.
        let bracket = FalsePosition::new([0.0, -load], [most, solution.load - load], None);
        find_load(bracket, [load, LOAD_TOLERANCE], solution, |eccentricity| {
            self.solve_at(eccentricity, attitude, interrupted)
        })
    }

    /// Error for a `load` above the load `carried` at the largest eccentricity `most`; `remedy` is that of a film without feeds under the load.
    pub(super) fn overload(&self, [load, carried, most]: [f64; 3], remedy: &str) -> InputError {
        let remedy = self.bush().feeds_under_load().map_or_else(
            || remedy.to_owned(),
            |feeds| {
                format!(
                    "the loaded half of the film is drained by {feeds} from the load: put feeds opposite the load (180 deg), or take a smaller load"
                )
            },
        );
        InputError::Conflict {
            field: format!("load = {load} N"),
            reason: format!("the film carries {carried:.6} N at an eccentricity of {most:.2}; {remedy}"),
        }
    }

    /// The equilibrium close to the eccentricity `near`; `None` if it is not there.
    fn equilibrium_near(
        &self,
        load: f64,
        attitude: f64,
        near: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<Option<JournalSolution>, ReynoldsError> {
        let here = self.solve_at(near, attitude, interrupted)?;
        let excess = here.load - load;
        let beyond = if excess > 0.0 { near - NEAR * near } else { near + NEAR * (1.0 - near) };
        let other = self.solve_at(beyond, attitude, interrupted)?;
        if excess * (other.load - load) > 0.0 {
            return Ok(None);
        }
        let mut ends = [[near, excess], [beyond, other.load - load]];
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let bracket = FalsePosition::new(ends[0], ends[1], None);
        let solve = |eccentricity| self.solve_at(eccentricity, attitude, interrupted);
        find_load(bracket, [load, LOAD_TOLERANCE], here, solve).map(Some)
    }

    /// Largest eccentricity of an equilibrium.
    fn most_eccentric(&self) -> f64 {
        let thinnest = |rough: MeanRoughness| {
            1.0 - MeanRoughness::LEAST_SEPARATION * rough.composite_rq() / self.clearance
        };
        self.roughness.map_or(MOST_ECCENTRIC, |rough| thinnest(rough).max(MOST_ECCENTRIC))
    }

    /// Solves unless `interrupted`; grooves have a fixed angle to the load, whose direction is found by iteration.
    pub(crate) fn solve_unless(
        &self,
        eccentricity: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        self.with_settled_load(|attitude, _| self.solve_at(eccentricity, attitude, interrupted))
    }

    /// The solution of `solve` at the attitude angle that it has itself: feeds have fixed angles to the load. `solve` takes the angle and the
    /// last solution.
    fn with_settled_load(
        &self,
        solve: impl Fn(f64, Option<&JournalSolution>) -> Result<JournalSolution, ReynoldsError>,
    ) -> Result<JournalSolution, ReynoldsError> {
        let (mut attitude, mut last) = (FIRST_ATTITUDE, None);
        for position in 0..MOST_POSITIONS {
            let solution = solve(attitude, last.as_ref())?;
            let change = solution.attitude - attitude;
            if !self.is_fed() || solution.eccentricity == 0.0 || change.abs() < ATTITUDE_TOLERANCE {
                return Ok(solution);
            }
            // The first angle is a guess.
            attitude += if position == 0 { change } else { DAMPING * change };
            last = Some(solution);
        }
        Err(InputError::Conflict {
            field: "supply_pressure".to_owned(),
            reason: "the direction of the load does not settle; a lower supply pressure or another angle"
                .to_owned(),
        }
        .into())
    }

    /// Solves with feeds at the `attitude` angle of the load.
    fn solve_at(
        &self,
        eccentricity: f64,
        attitude: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        let requirement = "at least 0 and below 1: the distance of the axes over the radial clearance";
        InputError::require((0.0..1.0).contains(&eccentricity), "eccentricity", eccentricity, requirement)?;
        match self.bore {
            None => self.film_at([eccentricity, attitude], &[], interrupted),
            Some(bore) => elastic_equilibrium::solve(self, bore, [eccentricity, attitude], interrupted),
        }
    }
}
