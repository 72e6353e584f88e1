//! Estimates of a contact by formula before it is solved: roughness, regime and film, lambda, load ratio,
//! friction and frictional heating.

use crate::analytic::{FilmMap, MixedLoadShare};
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::metrics::AreaCorrelation;
use crate::sim::contact::formula::{FilmFormula, formula_film};
use crate::sim::contact::friction_laws::mean_fluid_stress;
use crate::sim::contact::heating::{IsothermalFriction, film_rise};
use crate::sim::contact::numbers::RoughnessNumbers;
use crate::sim::contact::short_roughness::short_roughness;
use crate::sim::contact::warnings::{self, OperatingPoint, Warning};
use crate::sim::error::SimError;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::Roughness;

/// Autocorrelation at the end of the correlation length.
const CORRELATION: f64 = 0.1;
/// Range of factors on the inlet number that covers solutions on fine and coarse cells.
const INLET_SCATTER: [f64; 2] = [3.0, 0.4];
/// The first factor for ridges, whose solids separate at a quarter of the inlet number.
const RIDGE_SCATTER: f64 = 4.0;
/// Least pressure-viscosity coefficient times Hertz pressure at which oil in the inlets of asperities is
/// piezoviscous.
const LEAST_PIEZOVISCOUS: f64 = 3.0;
/// Smooth film over contact film below which smooth bodies touch too: the first for part of the load, the
/// second for most of it.
const THIN_FILM: f64 = 4.0;
const MIXED_FILM: f64 = 2.0;
const THINNEST_FILM: f64 = 0.6;

/// Estimates of a contact by formula before it is solved.
///
/// ```
/// use stribeck::analytic::FilmRegime;
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let expected = MixedLubricationSim::builder(Scene::azam_2019(64)).build()?.expectation()?;
/// let film = expected.film.ok_or("dry")?;
/// assert_eq!(film.map.regime, FilmRegime::PiezoviscousElastic);
/// let [least, most] = film.load_ratio_range.ok_or("no formula")?;
/// assert!(film.lambda < Some(0.1) && least < 0.1 && most > 0.4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Expectation {
    /// Roughness on the track.
    pub roughness: RoughnessNumbers,
    /// Smaller of the lengths along x and y at which the autocorrelation of both surfaces together falls to
    /// 10 % \[m\]; `None` for smooth bodies, textures and lengths above half of the patch.
    pub correlation_length: Option<f64>,
    /// Root mean square height of the random waves shorter than two cells that asperities do not flatten \[m\].
    pub short_roughness: f64,
    /// Flash temperature rise of the surfaces \[K\].
    pub flash_rise: f64,
    /// Film and friction; `None` for a dry contact.
    pub film: Option<ExpectedFilm>,
}

/// Film and friction of a lubricated contact by formula.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ExpectedFilm {
    /// Regime, and film of the smooth, flooded contact with an incompressible oil.
    pub map: FilmMap,
    /// Film in the middle \[m\]: [`FormulaFilm::central`](crate::sim::FormulaFilm::central), at most the supplied film, over the
    /// relative density of the oil at the Hertz pressure. Film formulas are for incompressible oils.
    pub central: f64,
    /// Formula of `central`.
    pub formula: FilmFormula,
    /// `central` over composite roughness; `None` for smooth bodies and textures.
    pub lambda: Option<f64>,
    /// Load ratio by the inlets of asperities ([`MixedLoadShare`]); zero for a full film between smooth bodies,
    /// `None` where no formula holds.
    pub load_ratio: Option<f64>,
    /// Inlet number of the asperities ([`MixedLoadShare::inlet_number`]); `None` for smooth bodies and where no formula holds.
    pub inlet_number: Option<f64>,
    /// Smallest and largest load ratio of solutions at this inlet number; `None` where no formula holds.
    pub load_ratio_range: Option<[f64; 2]>,
    /// Load ratio by the inlets of asperities at half and at twice the contact film; `None` where they do not decide.
    pub load_ratio_by_contact_film: Option<[f64; 2]>,
    /// Sum of the friction coefficients there.
    pub friction_by_contact_film: Option<[f64; 2]>,
    /// Friction coefficients of solids (at that load ratio or the smallest one) and of the isothermal fluid; NaN for sliding
    /// bodies whose undeformed gap equals the film outside of the Hertz contact only: the oil carries over more than that.
    pub friction: [f64; 2],
    /// Smallest and largest sum of both over `load_ratio_range`.
    pub friction_range: Option<[f64; 2]>,
    /// Mean temperature rise of the film by this friction \[K\]; NaN without it.
    pub film_rise: f64,
}

/// Load on solids over the load.
#[derive(Default)]
struct LoadShare {
    /// `None` if only the range is known.
    share: Option<f64>,
    range: [f64; 2],
    inlet_number: Option<f64>,
    /// At half and at twice the contact film, where the inlets of asperities decide.
    by_contact_film: Option<[f64; 2]>,
}

impl MixedLubricationSim {
    /// Estimates the contact by formula under the present conditions.
    ///
    /// # Errors
    /// Conditions outside the range of the formulas.
    pub fn expectation(&self) -> Result<Expectation, SimError> {
        let grid = self.contact.grid;
        let roughness = RoughnessNumbers::of(self.roughness());
        let correlation_length = self.correlation_length();
        let heights = self.bodies.each_ref().map(|body| body.surface());
        let short_roughness = short_roughness(&self.scene, &grid, heights, &self.contact.hertz);
        let Some(lubricant) = &self.contact.lubricant else {
            let flash_rise = self.flash_estimate();
            return Ok(Expectation {
                roughness,
                correlation_length,
                short_roughness,
                flash_rise,
                film: None,
            });
        };
        let (flash_rise, film) = self.expected_film(lubricant, &roughness, correlation_length)?;
        Ok(Expectation { roughness, correlation_length, short_roughness, flash_rise, film: Some(film) })
    }

    /// Warnings about physics that the scene leaves out and this estimate needs. A solve returns its own.
    ///
    /// # Errors
    /// As of [`expectation`](Self::expectation).
    pub fn expected_warnings(&self) -> Result<Vec<Warning>, SimError> {
        let Expectation { roughness, film, .. } = self.expectation()?;
        let Some(film) = film else { return Ok(Vec::new()) };
        let most = film.load_ratio_range.map_or(0.0, |[_, most]| most);
        let point = OperatingPoint {
            hertz: &self.contact.hertz,
            conditions: self.conditions(),
            viscosity: self.contact.lubricant.as_ref().map(Lubricant::viscosity),
            composite_rq: roughness.composite_rq,
            largest_pressure: None,
            friction: film.friction,
            film: film.central,
            load_ratio: most,
            yield_ratio: None,
        };
        Ok(warnings::left_out(&self.scene, &point))
    }

    /// Whether a body has dimples or grooves.
    fn is_textured(&self) -> bool {
        let rough = &self.scene.roughness;
        [&rough.ball, &rough.disc].into_iter().any(|body| matches!(body, Roughness::Texture(_)))
    }

    /// The smaller correlation length of both surfaces together.
    fn correlation_length(&self) -> Option<f64> {
        if self.is_textured() {
            return None;
        }
        let [ball, disc] = self.bodies.each_ref().map(|body| body.surface());
        let heights: Vec<f64> = ball.iter().zip(disc).map(|(ball, disc)| ball + disc).collect();
        let grid = self.contact.grid;
        let correlation = AreaCorrelation::new(&grid, &heights, None, Boundary::Periodic).ok()?;
        let along = |step: fn(isize) -> (isize, isize), reach: usize, spacing: f64| {
            let at = |lag: usize| correlation.at(step(lag as isize).0, step(lag as isize).1);
            (1..=reach).find_map(|lag| {
                let (before, after) = (at(lag - 1)?, at(lag)?);
                let share = (before - CORRELATION) / (before - after);
                (after <= CORRELATION).then_some((lag as f64 - 1.0 + share) * spacing)
            })
        };
        let (nx, ny) = correlation.reach();
        let lengths = [along(|lag| (lag, 0), nx, grid.dx()), along(|lag| (0, lag), ny, grid.dy())];
        lengths.into_iter().flatten().min_by(f64::total_cmp)
    }

    /// Flash temperature rise \[K\], film and friction.
    fn expected_film(
        &self,
        lubricant: &Lubricant,
        roughness: &RoughnessNumbers,
        correlation_length: Option<f64>,
    ) -> Result<(f64, ExpectedFilm), SimError> {
        let (scene, hertz, conditions) = (&self.scene, &self.hertz(), self.conditions());
        let motion = conditions.motion;
        let (speed, sliding, law) = (motion.entrainment_speed, motion.sliding_speed(), lubricant.viscosity());
        let no_film =
            || InputError::Conflict { field: "lubricant".to_owned(), reason: "no film formula".to_owned() };
        let formulas = formula_film(scene, hertz, speed, Some(law), None)?.ok_or_else(no_film)?;
        let central = formulas.compressed(scene, hertz, Some(lubricant.density()));
        let rough = roughness.composite_rq > 0.0 && !self.is_textured();
        let lambda = rough.then_some(central / roughness.composite_rq).filter(|lambda| lambda.is_finite());
        let share = self.load_share(central, lubricant, roughness, correlation_length)?;
        let contact = (hertz.pressure, scene.form.is_line());
        let rheology = scene.friction.rheology()?;
        // Where the gap of the undeformed bodies equals the film.
        let inlet = (2.0 * scene.form.radii().0 * central).sqrt();
        let is_estimated = inlet <= hertz.half_width_x || sliding <= 0.0;
        let stress = if is_estimated {
            mean_fluid_stress(&|pressure| law.viscosity(pressure), &rheology, contact, central, sliding)
        } else {
            f64::NAN
        };
        let mean = hertz.force / hertz.area;
        let solids = share.as_ref().map_or(0.0, |load| load.share.unwrap_or(load.range[0]));
        let coefficient =
            if sliding > 0.0 { self.laws.friction.coefficient(mean, sliding, [0.0; 2]) } else { 0.0 };
        let friction = [solids * coefficient, (1.0 - solids) * stress / mean];
        let [boundary, fluid] = if is_estimated { friction } else { [0.0; 2] };
        let heated = IsothermalFriction { boundary, fluid, film: central };
        let rises = film_rise(scene, hertz, &conditions, law, heated)?;
        let load_ratio = share.as_ref().and_then(|load| load.share);
        let inlet_number = share.as_ref().and_then(|load| load.inlet_number);
        let load_ratio_range = share.as_ref().map(|load| load.range);
        let load_ratio_by_contact_film = share.and_then(|load| load.by_contact_film);
        let all = |shares: Option<[f64; 2]>| {
            let sums =
                shares.map(|shares| shares.map(|share| share * coefficient + (1.0 - share) * stress / mean));
            sums.filter(|_| is_estimated)
        };
        let friction_range = all(load_ratio_range).map(|ends| [ends[0].min(ends[1]), ends[0].max(ends[1])]);
        let film = ExpectedFilm {
            map: formulas.map,
            central,
            formula: formulas.formula,
            lambda,
            load_ratio,
            inlet_number,
            load_ratio_range,
            load_ratio_by_contact_film,
            friction_by_contact_film: all(load_ratio_by_contact_film),
            friction,
            friction_range,
            film_rise: if is_estimated { rises.film } else { f64::NAN },
        };
        Ok((rises.surfaces, film))
    }

    /// Expected load ratio and its range; `None` where no formula holds.
    fn load_share(
        &self,
        central: f64,
        lubricant: &Lubricant,
        roughness: &RoughnessNumbers,
        correlation_length: Option<f64>,
    ) -> Result<Option<LoadShare>, InputError> {
        let contact_film = self.contact.film_cutoff;
        let (smooth, smooth_range) = match central / contact_film {
            ratio if ratio >= THIN_FILM => (Some(0.0), [0.0, 0.0]),
            ratio if ratio >= MIXED_FILM => (None, [0.0, 0.1]),
            ratio if ratio >= THINNEST_FILM => (None, [0.0, 1.0]),
            _ => (None, [0.5, 1.0]),
        };
        if roughness.composite_rq == 0.0 {
            return Ok(Some(LoadShare { share: smooth, range: smooth_range, ..LoadShare::default() }));
        }
        let law = lubricant.viscosity();
        let alpha = law.log_slope(0.0);
        let is_piezoviscous = alpha * self.contact.hertz.pressure > LEAST_PIEZOVISCOUS;
        let Some(length) = correlation_length.filter(|_| is_piezoviscous) else { return Ok(None) };
        let inlets = MixedLoadShare {
            entrainment_speed: self.conditions().motion.entrainment_speed,
            eta0: law.viscosity(0.0),
            alpha,
            correlation_length: length,
            contact_film,
            composite_rq: roughness.composite_rq,
        };
        let [above, below] = INLET_SCATTER;
        let is_ridged = self.scene.form.is_line() && !self.scene.is_strip();
        let above = if is_ridged { RIDGE_SCATTER } else { above };
        let at = |factor: f64| MixedLoadShare { correlation_length: factor * length, ..inlets }.load_ratio();
        let (share, least, most) = (at(1.0)?, at(above)?, at(below)?);
        let [_, most_smooth] = smooth_range;
        let inlet_number = Some(inlets.inlet_number()?);
        Ok(Some(if most_smooth > most {
            LoadShare { range: [least, most_smooth], inlet_number, ..LoadShare::default() }
        } else {
            let at_film =
                |factor: f64| MixedLoadShare { contact_film: factor * contact_film, ..inlets }.load_ratio();
            let by_contact_film = Some([at_film(0.5)?, at_film(2.0)?]);
            LoadShare { share: Some(share), range: [least, most], inlet_number, by_contact_film }
        }))
    }
}
