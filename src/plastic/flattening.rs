//! Irreversible flattening: the share of each body in the overlap, and the accumulated depth.

use crate::error::InputError;

/// Relative difference below which limits count as equal.
const TIE: f64 = 1e-9;

/// Splits the `overlap` \[m\] of a yielded node between two bodies with pressure limits `limits` \[Pa\]: the
/// softer body takes all of it, or each half at equal limits (to 1e-9). An overlap that is negative or NaN
/// counts as zero.
///
/// ```
/// use stribeck::plastic::split_depth;
/// assert_eq!(split_depth(3e-9, [2e9, 6e9]), [3e-9, 0.0]);
/// assert_eq!(split_depth(3e-9, [6e9, 2e9]), [0.0, 3e-9]);
/// assert_eq!(split_depth(3e-9, [6e9, 6e9]), [1.5e-9, 1.5e-9]);
/// assert_eq!(split_depth(3e-9, [2e9, f64::INFINITY]), [3e-9, 0.0]);
/// ```
pub fn split_depth(overlap: f64, limits: [f64; 2]) -> [f64; 2] {
    let depth = overlap.max(0.0);
    let margin = TIE * limits[0].abs().min(limits[1].abs());
    if limits[0] + margin < limits[1] {
        [depth, 0.0]
    } else if limits[1] + margin < limits[0] {
        [0.0, depth]
    } else {
        [0.5 * depth, 0.5 * depth]
    }
}

/// [`split_depth`] for whole fields: overwrites `out` \[m\], one field for each body, from `overlap` \[m\]
/// and `limits` \[Pa\].
///
/// # Errors
/// Slices of different length.
///
/// ```
/// use stribeck::plastic::split_depth_into;
/// let (mut ball, mut disc) = ([0.0; 2], [0.0; 2]);
/// split_depth_into(&[0.0, 4e-9], [&[6e9; 2], &[6e9, 2e9]], [&mut ball, &mut disc])?;
/// assert_eq!((ball, disc), ([0.0; 2], [0.0, 4e-9]));
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn split_depth_into(
    overlap: &[f64],
    limits: [&[f64]; 2],
    out: [&mut [f64]; 2],
) -> Result<(), InputError> {
    let [first, second] = out;
    InputError::require_len("limits[0]", limits[0], overlap.len())?;
    InputError::require_len("limits[1]", limits[1], overlap.len())?;
    InputError::require_len("out[0]", first, overlap.len())?;
    InputError::require_len("out[1]", second, overlap.len())?;
    let limits = limits[0].iter().zip(limits[1]);
    let out = first.iter_mut().zip(second.iter_mut());
    for ((&overlap, (&a, &b)), (first, second)) in overlap.iter().zip(limits).zip(out) {
        [*first, *second] = split_depth(overlap, [a, b]);
    }
    Ok(())
}

/// The depth \[m\] by which a body has been flattened, at the nodes of its own surface. It never decreases.
/// Flattening truncates asperities: the displaced volume is recorded, but not redistributed.
///
/// ```
/// use stribeck::plastic::PlasticDepth;
/// let mut depth = PlasticDepth::new(3);
/// depth.add(&[0.0, 2e-9, 1e-9])?;
/// depth.add(&[0.0, 1e-9, 0.0])?;
/// assert!((depth.values()[1] - 3e-9).abs() < 1e-24);
/// assert!((depth.displaced_volume(1e-12) - 4e-21).abs() < 1e-33);
/// assert!(depth.add(&[-1e-9, 0.0, 0.0]).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, PartialEq)]
pub struct PlasticDepth {
    /// Depth of each node \[m\].
    values: Vec<f64>,
}

impl Clone for PlasticDepth {
    fn clone(&self) -> Self {
        Self { values: self.values.clone() }
    }

    /// Copies into the existing buffers.
    fn clone_from(&mut self, source: &Self) {
        self.values.clone_from(&source.values);
    }
}

impl PlasticDepth {
    /// A body of `n_nodes` nodes without plastic depth.
    pub fn new(n_nodes: usize) -> Self {
        Self { values: vec![0.0; n_nodes] }
    }

    /// A body with the plastic depth `values` \[m\].
    ///
    /// # Errors
    /// A depth that is negative or not finite.
    pub fn from_values(values: Vec<f64>) -> Result<Self, InputError> {
        for &value in &values {
            InputError::require_non_negative("plastic.depth", value)?;
        }
        Ok(Self { values })
    }

    /// Plastic depth of every node \[m\].
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Adds `increments` \[m\], one for each node.
    ///
    /// # Errors
    /// A number of values that differs from the number of nodes, an increment that is negative or not finite.
    /// The depth is then unchanged.
    pub fn add(&mut self, increments: &[f64]) -> Result<(), InputError> {
        InputError::require_len("plastic.increments", increments, self.values.len())?;
        InputError::require_finite("plastic.increments", increments)?;
        for &increment in increments {
            InputError::require_non_negative("plastic.increments", increment)?;
        }
        for (value, increment) in self.values.iter_mut().zip(increments) {
            *value += increment;
        }
        Ok(())
    }

    /// Displaced volume \[m^3\] on cells of `cell_area` \[m^2\].
    pub fn displaced_volume(&self, cell_area: f64) -> f64 {
        self.values.iter().sum::<f64>() * cell_area
    }
}
