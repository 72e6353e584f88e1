//! Flow balance of the box.

/// Flow through the edges of the box at ambient density \[m^3/s\]. A line contact is one metre wide: the same
/// value is the flow per width in m^2/s.
///
/// Flows are those by entrainment and by pressure through the faces of the outermost nodes. With mass-conserving
/// cavitation and without squeeze, the imbalance is at most the [mass residual](crate::Residuals::mass), which
/// sums the balances of all cells. With Reynolds' condition it includes the mass that cavitated cells create,
/// which no residual counts.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let solution = solve_contact(&Scene::azam_2019(32))?;
/// let flow = solution.flow.ok_or("a dry contact")?;
/// assert!(flow.inflow > 0.0 && flow.imbalance <= solution.report.residual.mass + 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct FlowBalance {
    /// Inflow \[m^3/s\].
    pub inflow: f64,
    /// Outflow \[m^3/s\].
    pub outflow: f64,
    /// `|outflow - inflow + stored| / inflow`; `stored` is the growth rate of the mass in the gap, zero without
    /// squeeze. Relative to the outflow if the inflow is zero; zero without flow.
    pub imbalance: f64,
}

impl FlowBalance {
    /// The balance of these flows and the growth rate of the mass in the gap.
    pub(in crate::reynolds) fn new(inflow: f64, outflow: f64, stored: f64) -> Self {
        let residual = (outflow - inflow + stored).abs();
        let scale = if inflow > 0.0 { inflow } else { outflow };
        Self { inflow, outflow, imbalance: if residual == 0.0 { 0.0 } else { residual / scale } }
    }
}

/// Flows in a film at ambient density per width \[m^2/s\], one value per node, positive along the axes;
/// see [`Evaluation::film_flows`](crate::reynolds::Evaluation::film_flows).
///
/// The pressure flow includes shear thinning and the viscosity of warm films. The entrained flow through a node is
/// `through` minus the mean of `east` at its two faces along x. The heat of a film needs both, which nearly cancel
/// in an inlet.
///
/// ```
/// use stribeck::reynolds::FilmFlows;
/// let mut flows = FilmFlows::default();
/// flows.resize(64);
/// assert_eq!(flows.through, [0.0; 64]);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FilmFlows {
    /// Pressure flow through the face between the node and the next one along x; zero at the edge of the box.
    pub east: Vec<f64>,
    /// Pressure flow through the face between the node and the next one along y; zero at the edge of the box. On a
    /// [strip](crate::Grid::strip) the first row is next to the last one.
    pub north: Vec<f64>,
    /// Total flow along x through the cell of the node: the mean over its two faces along x.
    pub through: Vec<f64>,
    /// Whether the pressure of the outermost nodes is prescribed; otherwise it is ambient half a cell outside.
    pub has_edge_pressure: bool,
}

impl FilmFlows {
    /// Resizes to fields of zeros for `n` nodes without reallocation if possible.
    pub fn resize(&mut self, n: usize) {
        for field in [&mut self.east, &mut self.north, &mut self.through] {
            field.clear();
            field.resize(n, 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::FlowBalance;

    #[test]
    fn stored_mass_enters_the_imbalance() {
        let imbalance = |inflow, outflow, stored| FlowBalance::new(inflow, outflow, stored).imbalance;
        assert!((imbalance(2.0, 3.0, 0.0) - 0.5).abs() < 1e-15);
        assert!(imbalance(2.0, 3.0, -1.0) < 1e-15, "film squeezed out");
        assert!((imbalance(0.0, 2.0, -1.0) - 0.5).abs() < 1e-15, "no inflow");
        assert!(imbalance(0.0, 0.0, 0.0) < 1e-15);
    }
}
