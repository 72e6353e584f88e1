//! One grid of the hierarchy: its equations and fields.
//!
//! With the net outflow `F` of a cell, the equations of a level are `F(p, h) = source` where `p > 0`, at least
//! `source` where `p = 0`, with the film `h = gap - approach + K p` and the load as the sum of `p dx dy`. On
//! the finest grid `source` is zero and `gap` that of the problem; on coarser ones both hold what makes the
//! solution of the finer grid a solution here (full approximation scheme), so that pressures, not their
//! corrections, are what every grid solves for.
//!
//! All fields are row-major on the grid of the level. The outermost ring of nodes has no pressure.

use crate::elastic::{DeformationModel, NEAR};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::flow::Discretisation;
use crate::reynolds::problem::interior;

/// The first influence coefficients along x \[m/Pa\], of a pressure change at one node and of one that the
/// four neighbours take back.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Influence {
    /// `K` at 0 to `NEAR - 1` columns from the node.
    pub(super) single: [f64; NEAR],
    /// The same less a quarter of each of the neighbours' `K`: falls by two orders faster with the distance.
    pub(super) dipole: [f64; NEAR],
}

impl Influence {
    /// The coefficients of a body on its grid.
    pub(super) fn new(body: &dyn DeformationModel) -> Self {
        let at = |di, dj| body.influence(di, dj);
        Self {
            single: std::array::from_fn(|m| at(m, 0)),
            dipole: std::array::from_fn(|m| {
                at(m, 0) - 0.25 * (at(m + 1, 0) + at(m.abs_diff(1), 0) + 2.0 * at(m, 1))
            }),
        }
    }
}

/// Equations `F(p, h) = source` (or `>=` where `p = 0`), `h = gap - approach + K p`, integral of `p` =
/// `load`.
#[derive(Debug, Clone)]
pub(super) struct Level {
    pub(super) grid: Grid,
    /// Nodes of the fluid at pressure and film, and the schemes of its faces.
    pub(super) fluid: Discretisation,
    /// Influence coefficients that sweeps work with.
    pub(super) influence: Influence,
    /// Fluid pressure, never negative \[Pa\].
    pub(super) pressure: Vec<f64>,
    /// Pressure before the sweep under way.
    pub(super) before: Vec<f64>,
    /// Pressure that came from the finer grid.
    pub(super) start: Vec<f64>,
    /// Film thickness \[m\]; for a moment the displacement `K p`.
    pub(super) film: Vec<f64>,
    /// Gap that the equations of this level have \[m\].
    pub(super) gap: Vec<f64>,
    /// Right-hand side of the mass balance, in the units of `F`.
    pub(super) source: Vec<f64>,
    /// `source - F` where there is pressure, and room for an interpolated correction.
    pub(super) residual: Vec<f64>,
    /// Source less entrainment and squeeze.
    pub(super) drive: Vec<f64>,
    /// `rho/rho_0 h` of the previous time, where there is one.
    pub(super) previous: Option<Vec<f64>>,
    /// Load that the pressure has to carry on this level \[N\].
    pub(super) load: f64,
    /// Flow over pressure difference of the faces to the east of each node.
    pub(super) east: Vec<f64>,
    /// Of the faces to the north.
    pub(super) north: Vec<f64>,
    /// Whether a node is on the outermost ring.
    pub(super) is_boundary: Vec<bool>,
    /// Whether film and flow quantities are those of the pressure.
    pub(super) is_evaluated: bool,
}

impl Level {
    /// A level without pressure, gap and load.
    pub(super) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let mut is_boundary = vec![true; grid.len()];
        for k in interior(&grid) {
            is_boundary[k] = false;
        }
        Self {
            grid,
            fluid: Discretisation::new(grid),
            influence: Influence::default(),
            pressure: zeros(),
            before: zeros(),
            start: zeros(),
            film: zeros(),
            gap: zeros(),
            source: zeros(),
            residual: zeros(),
            drive: zeros(),
            previous: None,
            load: 0.0,
            east: zeros(),
            north: zeros(),
            is_boundary,
            is_evaluated: false,
        }
    }

    /// No pressure on the outermost nodes.
    pub(super) fn clear_boundary(&mut self) {
        for (p, is_boundary) in self.pressure.iter_mut().zip(&self.is_boundary) {
            if *is_boundary {
                *p = 0.0;
            }
        }
    }

    /// Flow quantities of pressure and film as they are.
    pub(super) fn take_film(&mut self, lubricant: &Lubricant) {
        self.fluid.update(lubricant, &self.pressure, &self.film, self.previous.as_deref());
        self.is_evaluated = true;
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        for j in 0..ny - 1 {
            for k in j * nx..(j + 1) * nx - 1 {
                [self.east[k], self.north[k]] = self.fluid.conductances(k, &self.pressure);
            }
        }
    }

    /// `F_k` as evaluated.
    pub(super) fn balance(&self, k: usize) -> f64 {
        self.fluid.balance(k, self.previous.as_deref())
    }

    /// What is residual of the source in cells that hold fluid under pressure, zero elsewhere; as evaluated.
    pub(super) fn find_residual(&mut self) {
        for k in interior(&self.grid) {
            self.residual[k] = if self.pressure[k] > 0.0 { self.source[k] - self.balance(k) } else { 0.0 };
        }
    }

    /// What pressure flow has to balance; as evaluated.
    pub(super) fn find_drive(&mut self) {
        for k in interior(&self.grid) {
            let transport = self.fluid.transport(k, self.previous.as_deref());
            self.drive[k] = self.source[k] - transport;
        }
    }

    /// The load that the pressure carries \[N\].
    pub(super) fn carried(&self) -> f64 {
        self.pressure.iter().sum::<f64>() * self.grid.cell_area()
    }
}
