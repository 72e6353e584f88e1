//! The tribofilm of a body.

use super::FilmGrowthLaw;
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// The tribofilm on the nodes of a body's own surface; it moves with the body.
///
/// States are node-major, `states[node * n_states + s]`. The film stores the states, not the law: every call
/// requires the same law.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::tribochem::{Ghanbarzadeh, Tribofilm};
/// let law = Ghanbarzadeh::azam_2019();
/// let mut film = Tribofilm::bare(&law, 4);
/// let contact = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1e8).with_sliding_speed(0.005).with_in_contact(true);
/// let open = contact.with_in_contact(false);
/// film.advance(&law, 600.0, |node| if node < 2 { contact } else { open })?;
/// assert!((film.thickness()[0] - 92.25e-9).abs() < 0.01e-9);
/// assert_eq!(film.thickness()[3], 0.0);
/// assert!((film.volume(1e-12) - 2.0 * 92.25e-21).abs() < 1e-22);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, PartialEq)]
pub struct Tribofilm {
    /// Number of states per node.
    n_states: usize,
    states: Vec<f64>,
    /// Thickness of the states \[m\].
    thickness: Vec<f64>,
    /// Growth summed over nodes and steps \[m\].
    gained: f64,
    /// Removal summed over nodes and steps \[m\].
    lost: f64,
}

impl Clone for Tribofilm {
    fn clone(&self) -> Self {
        Self {
            n_states: self.n_states,
            states: self.states.clone(),
            thickness: self.thickness.clone(),
            gained: self.gained,
            lost: self.lost,
        }
    }

    /// Copies into the existing buffers.
    fn clone_from(&mut self, source: &Self) {
        self.n_states = source.n_states;
        self.states.clone_from(&source.states);
        self.thickness.clone_from(&source.thickness);
        self.gained = source.gained;
        self.lost = source.lost;
    }
}

impl Tribofilm {
    /// A bare surface of `n_nodes` nodes under `law`.
    pub fn bare(law: &dyn FilmGrowthLaw, n_nodes: usize) -> Self {
        let n_states = law.n_states().max(1);
        Self {
            n_states,
            states: vec![0.0; n_states * n_nodes],
            thickness: vec![0.0; n_nodes],
            gained: 0.0,
            lost: 0.0,
        }
    }

    /// A film with the `thickness` \[m\] of each node, without further history.
    ///
    /// # Errors
    /// A thickness that is negative or not finite.
    pub fn from_thickness(law: &dyn FilmGrowthLaw, thickness: &[f64]) -> Result<Self, InputError> {
        InputError::require_finite("tribofilm.thickness", thickness)?;
        for &value in thickness {
            InputError::require_non_negative("tribofilm.thickness", value)?;
        }
        let mut film = Self::bare(law, thickness.len());
        for (states, &value) in film.states.chunks_exact_mut(film.n_states).zip(thickness) {
            law.start(value, states);
        }
        film.thickness.copy_from_slice(thickness);
        Ok(film)
    }

    /// A film with the given [`states`](Self::states) and the accumulated gain and loss `changes` \[m\], as
    /// returned by [`changes`](Self::changes).
    ///
    /// # Errors
    /// States that do not fit `law`, or a thickness that is not finite.
    pub(crate) fn from_states(
        law: &dyn FilmGrowthLaw,
        states: Vec<f64>,
        changes: [f64; 2],
    ) -> Result<Self, InputError> {
        let n_states = law.n_states().max(1);
        let n_nodes = states.len() / n_states;
        InputError::require_len("tribofilm.states", &states, n_states * n_nodes)?;
        let thickness: Vec<f64> = states.chunks_exact(n_states).map(|states| law.thickness(states)).collect();
        InputError::require_finite("tribofilm.thickness", &thickness)?;
        let [gained, lost] = changes;
        Ok(Self { n_states, states, thickness, gained, lost })
    }

    /// Mirrors the film in x, on rows of `nx` nodes.
    pub(crate) fn mirror(&mut self, nx: usize) {
        let n_states = self.n_states;
        self.thickness.chunks_mut(nx.max(1)).for_each(<[f64]>::reverse);
        for row in self.states.chunks_mut(nx.max(1) * n_states) {
            // Reverse the nodes, and the states of each node again.
            row.reverse();
            row.chunks_exact_mut(n_states).for_each(<[f64]>::reverse);
        }
    }

    /// Accumulated gain and loss of thickness, summed over nodes \[m\].
    pub(crate) fn changes(&self) -> [f64; 2] {
        [self.gained, self.lost]
    }

    /// Advances every node by `time_step` \[s\] under the conditions `point(node)`, with nodes of the body's
    /// own surface. Allocates nothing.
    ///
    /// # Errors
    /// A time step that is negative or not finite, or a law with another number of states: the film is
    /// unchanged. A law that produced a state or thickness that is not finite: the film contains it, and the
    /// error names its position.
    pub fn advance(
        &mut self,
        law: &dyn FilmGrowthLaw,
        time_step: f64,
        mut point: impl FnMut(usize) -> SurfaceState,
    ) -> Result<(), InputError> {
        InputError::require_non_negative("time_step", time_step)?;
        self.require_law(law)?;
        let nodes = self.states.chunks_exact_mut(self.n_states).enumerate();
        nodes.for_each(|(node, states)| law.advance(&point(node), time_step, states));
        self.account(law)
    }

    /// Advances all nodes under the conditions `at`, one per node; the law may process the nodes together.
    ///
    /// # Errors
    /// The errors of [`advance`](Self::advance), and a number of conditions that differs from the number of
    /// nodes: the film is unchanged.
    pub fn advance_all(
        &mut self,
        law: &dyn FilmGrowthLaw,
        time_step: f64,
        at: &[SurfaceState],
    ) -> Result<(), InputError> {
        InputError::require_non_negative("time_step", time_step)?;
        self.require_law(law)?;
        InputError::require_len("at", at, self.thickness.len())?;
        law.advance_all(at, time_step, &mut self.states);
        self.account(law)
    }

    /// Updates thicknesses from the states, and accumulated gain and loss.
    fn account(&mut self, law: &dyn FilmGrowthLaw) -> Result<(), InputError> {
        for (states, thickness) in self.states.chunks_exact(self.n_states).zip(&mut self.thickness) {
            let change = law.thickness(states) - *thickness;
            *thickness = law.thickness(states);
            self.gained += change.max(0.0);
            self.lost += (-change).max(0.0);
        }
        // A thickness can mask a NaN state, as the larger of NaN and zero is zero.
        InputError::require_finite("tribofilm.states", &self.states)?;
        InputError::require_finite("tribofilm.thickness", &self.thickness)
    }

    fn require_law(&self, law: &dyn FilmGrowthLaw) -> Result<(), InputError> {
        if law.n_states().max(1) == self.n_states {
            return Ok(());
        }
        Err(InputError::Shape {
            field: "tribofilm.states of a node".to_owned(),
            expected: law.n_states().max(1),
            found: self.n_states,
        })
    }

    /// Thickness of every node \[m\].
    pub fn thickness(&self) -> &[f64] {
        &self.thickness
    }

    /// States of every node, node-major.
    pub fn states(&self) -> &[f64] {
        &self.states
    }

    /// Number of states per node.
    pub fn n_states(&self) -> usize {
        self.n_states
    }

    /// Volume of the film \[m^3\] on cells of `cell_area` \[m^2\].
    pub fn volume(&self, cell_area: f64) -> f64 {
        self.thickness.iter().sum::<f64>() * cell_area
    }

    /// Volume \[m^3\] gained by nodes, summed over nodes and steps, net of the removal at the node within
    /// each step. `gained - lost` is the change of [`volume`](Self::volume) since the start.
    pub fn gained_volume(&self, cell_area: f64) -> f64 {
        self.gained * cell_area
    }

    /// Volume \[m^3\] lost by nodes, summed over nodes and steps; see [`gained_volume`](Self::gained_volume).
    pub fn lost_volume(&self, cell_area: f64) -> f64 {
        self.lost * cell_area
    }

    /// Total volume \[m^3\] grown, including the initial film, for a law with separate growth and removal.
    /// The removed volume is the difference to [`volume`](Self::volume). `None` for a law of the net
    /// thickness alone.
    pub fn grown_volume(&self, law: &dyn FilmGrowthLaw, cell_area: f64) -> Option<f64> {
        let grown = self.states.chunks_exact(self.n_states).map(|states| law.grown(states));
        grown.sum::<Option<f64>>().map(|thickness| thickness * cell_area)
    }
}
