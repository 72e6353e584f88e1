//! Given data beside the bodies: previous masses of the squeeze term, pressures at the edge of the box.

use crate::error::InputError;

///
/// # Examples
///
/// ```
/// use stribeck::reynolds::Squeeze;
/// let mass = [100e-9; 4];
/// let squeeze = Squeeze { previous_mass: &mass, time_step: 1e-4 };
/// // A film that decreases by a nanometre loses 10 um/s.
/// let rate = (99e-9 - squeeze.previous_mass[0]) / squeeze.time_step;
/// assert!((rate + 1e-5).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Squeeze<'a> {
    /// `rho/rho_0 * h` at the previous time per node \[m\], from its solve.
    pub previous_mass: &'a [f64],
    /// Time between the two \[s\].
    pub time_step: f64,
}

impl<'a> Squeeze<'a> {
    /// Second-order backward difference from the masses of the `last` two times, newest first. `time_steps` \[s\] are
    /// the time since the newest, and from the oldest to the newest. With `r` their ratio it is
    /// `((1 + 2 r)/(1 + r) m - (1 + r) m_1 + r^2/(1 + r) m_2) / dt`; for equal steps
    /// `(3 m - 4 m_1 + m_2) / (2 dt)`. It is evaluated as a first-order difference over a shorter step from a
    /// combination of `m_1` and `m_2`, which is written to `combined`. A first-order difference would damp a wave that
    /// travels through a contact even at twenty steps per period. The scheme is unstable if each step is more than 2.4
    /// times the previous one. In a cell that empties so fast that the combination is negative, it is `m_1`.
    ///
    /// # Errors
    /// Slices of different lengths, a time step that is not positive.
    ///
    /// ```
    /// use stribeck::reynolds::Squeeze;
    /// // A mass quadratic in time: 1, 4, then 9.
    /// let mut combined = [0.0];
    /// let squeeze = Squeeze::second_order([&[4.0], &[1.0]], [1.0, 1.0], &mut combined)?;
    /// let rate = (9.0 - squeeze.previous_mass[0]) / squeeze.time_step;
    /// assert!((rate - 6.0_f64).abs() < 1e-12);
    /// // The same at the times 1, 2, then 4.
    /// let squeeze = Squeeze::second_order([&[4.0], &[1.0]], [2.0, 1.0], &mut combined)?;
    /// let rate = (16.0 - squeeze.previous_mass[0]) / squeeze.time_step;
    /// assert!((rate - 8.0_f64).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn second_order(
        last: [&[f64]; 2],
        time_steps: [f64; 2],
        combined: &'a mut [f64],
    ) -> Result<Self, InputError> {
        InputError::require_len("last.0", last[0], combined.len())?;
        InputError::require_len("last.1", last[1], combined.len())?;
        InputError::require_positive("time_steps.0", time_steps[0])?;
        InputError::require_positive("time_steps.1", time_steps[1])?;
        let ratio = time_steps[0] / time_steps[1];
        let share = 1.0 / (1.0 + 2.0 * ratio);
        let time_step = share * (1.0 + ratio) * time_steps[0];
        for (out, (newest, oldest)) in combined.iter_mut().zip(last[0].iter().zip(last[1])) {
            let mass = newest + share * ratio * ratio * (newest - oldest);
            *out = if mass < 0.0 { *newest } else { mass };
        }
        Ok(Self { previous_mass: combined, time_step })
    }
}

/// Fluid pressure at the edge of the box, for a contact whose pressure extends outside.
///
/// The pressures hold at the outermost nodes and belong to the fluid outside, which carries `load_outside`. If that is
/// unknown, [`NewtonKrylov`](super::NewtonKrylov) keeps the approach of its initial state, and the load of the contact
/// is a result. Without edge pressures, the pressure is ambient half a cell outside the outermost nodes.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::EdgePressure;
/// let field = [0.0; 64];
/// let edge = EdgePressure { field: &field, load_outside: Some(0.2) };
/// assert!(edge.field.iter().all(|pressure| *pressure >= 0.0) && edge.load_outside < Some(1.0));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct EdgePressure<'a> {
    /// Pressure on the grid, of which only the outermost nodes are used \[Pa\].
    pub field: &'a [f64],
    /// Load carried outside, including the outermost nodes \[N\]; `None` if the approach is prescribed.
    pub load_outside: Option<f64>,
}
