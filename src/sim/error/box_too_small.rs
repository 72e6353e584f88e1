//! Boxes that cut solid contact, wear or a tribofilm.

use std::fmt;

use thiserror::Error;

/// Quantity that reaches the edge of the box.
///
/// # Examples
///
/// ```
/// use stribeck::sim::EdgeQuantity;
/// assert_eq!(EdgeQuantity::DiscWear.to_string(), "wear of the disc");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum EdgeQuantity {
    /// Solid contact.
    Solids,
    /// Worn depth of the ball.
    BallWear,
    /// Worn depth of the disc.
    DiscWear,
    /// Tribofilm on the ball.
    BallTribofilm,
    /// Tribofilm on the disc.
    DiscTribofilm,
}

impl fmt::Display for EdgeQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Solids => f.write_str("solid contact"),
            Self::BallWear => f.write_str("wear of the ball"),
            Self::DiscWear => f.write_str("wear of the disc"),
            Self::BallTribofilm => f.write_str("tribofilm of the ball"),
            Self::DiscTribofilm => f.write_str("tribofilm of the disc"),
        }
    }
}

/// The box cuts solid contact, wear or a tribofilm: one of them is in the two outermost rows of cells.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::GridSpec;
/// use stribeck::sim::{EdgeQuantity, Scene, SimError, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.grid = GridSpec::Cells { nx: 32, ny: 16, x: [-0.25e-3, 0.25e-3], y: [-0.125e-3, 0.125e-3] };
/// let Err(SimError::BoxTooSmall(edge)) = solve_contact(&scene) else { panic!("the contact is 0.3 mm wide") };
/// assert_eq!((edge.quantity, edge.field), (EdgeQuantity::Solids, "grid.y"));
/// scene.grid = GridSpec::Cells { nx: 32, ny: edge.cells, x: [-0.25e-3, 0.25e-3], y: edge.edges };
/// assert!(solve_contact(&scene).is_ok());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{}", self.message())]
#[non_exhaustive]
pub struct BoxTooSmall {
    /// Quantity that reaches the edge.
    pub quantity: EdgeQuantity,
    /// Share of the load on solids in the two rows, worn depth or thickness there \[m\].
    pub value: f64,
    /// Position of its maximum \[m\].
    pub x: f64,
    /// Position of its maximum \[m\].
    pub y: f64,
    /// Key of the box that is too small.
    pub field: &'static str,
    /// Edges of a wider box \[m\].
    pub edges: [f64; 2],
    /// Number of cells of the same size between them.
    pub cells: usize,
}

impl BoxTooSmall {
    /// Message with quantity, value, position and remedy.
    fn message(&self) -> String {
        let Self { quantity, value, x, y, field, edges: [low, high], cells } = self;
        let value = match quantity {
            EdgeQuantity::Solids => format!("{:.2} % of the load is on solids", 100.0 * value),
            _ => format!("it is {value:.2e} m"),
        };
        let count = if *field == "grid.x" { "grid.nx" } else { "grid.ny" };
        format!(
            "{quantity} reaches the edge of the box: in its outermost rows, at x = {x:.3e} m, y = {y:.3e} m, {value}; \
             take {field} = [{low:.4e}, {high:.4e}] with {count} = {cells}, or allow it (solver.edge_contact); a history goes on in a wider box with grid.grows = true"
        )
    }
}
