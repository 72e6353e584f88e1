//! What flows into the box and out of it.

/// Flow through the edges of the box at ambient density \[m^3/s\]; of a line contact, one metre wide, the
/// same number is \[m^2/s\] a metre of contact.
///
/// Flows are those through the faces of the outermost nodes, by entrainment and by pressure. Where cavitation
/// conserves mass and nothing is squeezed the imbalance is at most the [mass
/// residual](crate::Residuals::mass): the balances of all cells add up to it. With Reynolds' condition it is
/// what cavitated cells make out of nothing, and no residual counts it.
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
    /// What enters \[m^3/s\].
    pub inflow: f64,
    /// What leaves \[m^3/s\].
    pub outflow: f64,
    /// `|outflow - inflow + stored| / inflow`; `stored` is the rate at which the mass in the gaps grows, zero
    /// without a squeeze term. Over the outflow where nothing enters, zero where nothing flows.
    pub imbalance: f64,
}

impl FlowBalance {
    /// From flows and growth of the mass in the gaps.
    pub(in crate::reynolds) fn new(inflow: f64, outflow: f64, stored: f64) -> Self {
        let residual = (outflow - inflow + stored).abs();
        let scale = if inflow > 0.0 { inflow } else { outflow };
        Self { inflow, outflow, imbalance: if residual == 0.0 { 0.0 } else { residual / scale } }
    }
}

/// Flows in a film at ambient density, a metre of width \[m^2/s\], one value a node, positive along the axes;
/// see [`Evaluation::film_flows`](crate::reynolds::Evaluation::film_flows).
///
/// Flow by pressure is that of the face law with shear thinning and the viscosity of warm films; what is
/// entrained through a node is `through` less the mean of `east` at its two faces along x. Heat of a film
/// needs both: in an inlet they nearly cancel.
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
    /// By pressure through the face between the node and the next one along x; zero at the edge of the box.
    pub east: Vec<f64>,
    /// By pressure through the face between the node and the next one along y; zero at the edge of the box.
    pub north: Vec<f64>,
    /// All that flows along x through the cell of the node: mean over its two faces along x.
    pub through: Vec<f64>,
    /// Whether the pressure at the outermost nodes is given; else it is ambient half a cell beyond them.
    pub has_edge_pressure: bool,
}

impl FilmFlows {
    /// Fields of zeros for `n` nodes; those that fit are emptied alone.
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
    fn what_is_stored_balances() {
        let imbalance = |inflow, outflow, stored| FlowBalance::new(inflow, outflow, stored).imbalance;
        assert!((imbalance(2.0, 3.0, 0.0) - 0.5).abs() < 1e-15);
        assert!(imbalance(2.0, 3.0, -1.0) < 1e-15, "a film that is squeezed out");
        assert!((imbalance(0.0, 2.0, -1.0) - 0.5).abs() < 1e-15, "nothing enters");
        assert!(imbalance(0.0, 0.0, 0.0) < 1e-15);
    }
}
