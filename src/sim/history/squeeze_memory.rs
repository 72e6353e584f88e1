//! Lubricant mass of the previous contacts, for the squeeze term of the next one.
//!
//! A cell holds the mass per area `theta rho/rho_0 h`, as a film thickness \[m\]. Its time derivative is the
//! squeeze term of the Reynolds equation, by second-order differences from the third contact on. From then on waves
//! that the flow carries keep their amplitude ([`CarriedWaves`]).

use crate::error::InputError;
use crate::reynolds::{CarriedWaves, ContactState, Scheme, Squeeze};
use crate::sim::contact::model::ContactModel;
use crate::sim::scene::Motion;

/// Largest ratio of successive steps for the second-order difference, which is unstable from a ratio of 2.4 on.
const LONGEST: f64 = 2.0;
/// Least film over the contact film of a cell that carries waves. Closer to solids the film is held by them.
const CLEAR_FILM: f64 = 3.0;

/// The last two contacts, newest first.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(in crate::sim) struct SqueezeMemory {
    /// `theta rho/rho_0 h` of every cell \[m\].
    masses: [Vec<f64>; 2],
    /// Films \[m\].
    films: [Vec<f64>; 2],
    /// Cells full of oil under pressure, without solid contact.
    is_full: [Vec<bool>; 2],
    /// Lengths of the steps after these contacts \[s\].
    steps: [f64; 2],
    /// Entrainment speed in the newest contact \[m/s\].
    speed: f64,
}

/// Reverses each row of `nx` values.
pub(in crate::sim) fn mirror_rows<T>(field: &mut [T], nx: usize) {
    field.chunks_mut(nx.max(1)).for_each(<[T]>::reverse);
}

/// The entrainment of the next contact.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct Entrainment {
    /// Speed along +x \[m/s\].
    pub(in crate::sim) speed: f64,
    /// Width of the cells along x \[m\].
    pub(in crate::sim) dx: f64,
    /// Cells along x.
    pub(in crate::sim) nx: usize,
    /// Discretization.
    pub(in crate::sim) scheme: Scheme,
}

impl Entrainment {
    /// That of a contact; `None` with spin, whose flow is not along x alone.
    pub(in crate::sim) fn of(contact: &ContactModel) -> Option<Self> {
        let Motion { entrainment_speed: speed, spin_radius, .. } = contact.motion;
        let (dx, nx) = (contact.grid.dx(), contact.grid.nx());
        spin_radius.is_none().then_some(Self { speed, dx, nx, scheme: contact.scheme })
    }
}

impl SqueezeMemory {
    /// Zero masses.
    pub(in crate::sim) fn new(nodes: usize) -> Self {
        let zeros = || [vec![0.0; nodes], vec![0.0; nodes]];
        let is_full = [vec![false; nodes], vec![false; nodes]];
        Self { masses: zeros(), films: zeros(), is_full, steps: [0.0; 2], speed: 0.0 }
    }

    /// The memory in a frame with the opposite direction of x, on rows of `nx` cells. The next contact carries no waves:
    /// their flow has turned.
    pub(in crate::sim) fn mirror(&mut self, nx: usize) {
        self.masses.iter_mut().chain(&mut self.films).for_each(|field| mirror_rows(field, nx));
        self.is_full.iter_mut().for_each(|field| mirror_rows(field, nx));
        self.speed = 0.0;
    }

    /// Makes the newest contact one that has lasted: the next one follows a steady contact.
    pub(in crate::sim) fn settle(&mut self) {
        let [newest, oldest] = &mut self.masses;
        oldest.clone_from(newest);
        let [newest, oldest] = &mut self.films;
        oldest.clone_from(newest);
        let [newest, oldest] = &mut self.is_full;
        oldest.clone_from(newest);
        self.steps[1] = self.steps[0];
    }

    /// Halves the time between the newest contact and the next one.
    pub(in crate::sim) fn halve_step(&mut self) {
        self.steps[0] *= 0.5;
    }

    /// Rejects fields that do not fit `grid`.
    #[cfg(feature = "serde")]
    pub(in crate::sim) fn validate(&self, grid: &crate::grid::Grid) -> Result<(), InputError> {
        for field in self.masses.iter().chain(&self.films) {
            grid.require_field("previous mass or film", field)?;
        }
        if self.is_full.iter().any(|is_full| is_full.len() != grid.len()) {
            let field = "full cells".to_owned();
            return Err(InputError::Conflict { field, reason: "have another number of nodes".to_owned() });
        }
        InputError::require_non_negative("last speed", self.speed)?;
        self.steps.iter().try_for_each(|step| InputError::require_non_negative("last step", *step))
    }

    /// Stores the contact `state` at the entrainment `speed` that lasted `time_step`; `contact_film` is the film of
    /// solid contact.
    pub(in crate::sim) fn keep(
        &mut self,
        state: &ContactState,
        (speed, contact_film): (f64, f64),
        time_step: f64,
    ) {
        self.masses.swap(0, 1);
        self.masses[0].copy_from_slice(&state.mass);
        self.films.swap(0, 1);
        self.films[0].copy_from_slice(&state.film);
        self.is_full.swap(0, 1);
        for (k, is_full) in self.is_full[0].iter_mut().enumerate() {
            *is_full = state.theta[k] >= 1.0
                && state.fluid_pressure[k] > 0.0
                && !state.in_contact[k]
                && state.film[k] > CLEAR_FILM * contact_film;
        }
        self.steps = [time_step, self.steps[0]];
        self.speed = speed;
    }

    /// The squeeze term of the contact after `contacts` others; `None` for the first. It is second-order in time,
    /// first-order in the second contact and after a step more than twice as long as the previous one. Waves along the
    /// `entrainment` are carried, unless it is `None`. The reference mass may be written to `combined`.
    pub(in crate::sim) fn squeeze<'a>(
        &'a self,
        contacts: u64,
        entrainment: Option<Entrainment>,
        combined: &'a mut [f64],
    ) -> Result<Option<Squeeze<'a>>, InputError> {
        let [newest, oldest] = &self.masses;
        let second_order = self.steps[0] <= LONGEST * self.steps[1];
        let time_step = match contacts {
            0 => return Ok(None),
            1 => return Ok(Some(Squeeze { previous_mass: newest, time_step: self.steps[0] })),
            _ if second_order => Squeeze::second_order([newest, oldest], self.steps, combined)?.time_step,
            _ => {
                combined.copy_from_slice(newest);
                self.steps[0]
            }
        };
        if let Some(entrainment) = entrainment {
            self.carry(entrainment, second_order, combined)?;
        }
        Ok(Some(Squeeze { previous_mass: combined, time_step }))
    }

    /// Corrects the mass `combined` for the waves that the entrainment carries.
    fn carry(
        &self,
        Entrainment { speed, dx, nx, scheme }: Entrainment,
        second_order: bool,
        combined: &mut [f64],
    ) -> Result<(), InputError> {
        let is_full: Vec<bool> =
            self.is_full[0].iter().zip(&self.is_full[1]).map(|(a, b)| *a && *b).collect();
        let [newest, oldest] = &self.masses;
        let [film, film_before] = &self.films;
        let waves = CarriedWaves {
            masses: [newest, oldest],
            films: [film, film_before],
            is_full: &is_full,
            cells: [speed * self.steps[0] / dx, self.speed * self.steps[1] / dx],
            nx,
            scheme,
            second_order,
        };
        waves.correct(combined)
    }
}
