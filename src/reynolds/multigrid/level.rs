//! One grid of the hierarchy: its equations and fields.
//!
//! With the net outflow `F` of a cell the equations of a level are `F(p, h) = source` where `p > 0` and
//! `F(p, h) >= source` where `p = 0`, with the film `h = gap - approach + K p` and the load as the sum of
//! `p dx dy`. On the finest grid `source` is zero and `gap` that of the problem. On coarser grids both
//! contain the FAS right-hand sides, for which the restricted solution of the finer grid solves the coarse
//! equations.
//!
//! All fields are row-major on the grid of the level. The pressure is zero on the outermost ring of nodes.

use crate::elastic::{DeformationModel, NEAR};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::flow::Discretisation;
use crate::reynolds::inner_nodes::interior;

/// Influence coefficients along x \[m/Pa\], of a pressure change at one node and of a dipole change that is
/// subtracted from the four neighbors.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Influence {
    /// `K` at offsets of 0 to `NEAR - 1` columns.
    pub(super) single: [f64; NEAR],
    /// `K` less a quarter of the `K` of each neighbor; decays faster with distance by two orders.
    pub(super) dipole: [f64; NEAR],
}

impl Influence {
    /// Coefficients of a body on its grid.
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

/// Equations and fields of one grid.
#[derive(Debug, Clone)]
pub(super) struct Level {
    pub(super) grid: Grid,
    /// Discretized flow at pressure and film.
    pub(super) fluid: Discretisation,
    /// Influence coefficients of the relaxation.
    pub(super) influence: Influence,
    /// Fluid pressure, never negative \[Pa\].
    pub(super) pressure: Vec<f64>,
    /// Pressure before the current sweep \[Pa\].
    pub(super) before: Vec<f64>,
    /// Restricted pressure of the finer grid \[Pa\].
    pub(super) start: Vec<f64>,
    /// Film thickness \[m\]; temporarily the displacement `K p`.
    pub(super) film: Vec<f64>,
    /// Gap of the FAS equations of this level \[m\].
    pub(super) gap: Vec<f64>,
    /// Right-hand side of the mass balance, in the units of `F`.
    pub(super) source: Vec<f64>,
    /// `source - F` where there is pressure; also the buffer of an interpolated correction.
    pub(super) residual: Vec<f64>,
    /// Source less entrainment and squeeze.
    pub(super) drive: Vec<f64>,
    /// `rho/rho_0 h` of the previous time; `None` for steady flow.
    pub(super) previous: Option<Vec<f64>>,
    /// Load to be carried on this level \[N\].
    pub(super) load: f64,
    /// Conductances (flow over pressure difference) of the faces to the east of each node.
    pub(super) east: Vec<f64>,
    /// Conductances of the faces to the north.
    pub(super) north: Vec<f64>,
    /// Whether a node is on the outermost ring.
    pub(super) is_boundary: Vec<bool>,
    /// Whether film and flow quantities belong to the pressure.
    pub(super) is_evaluated: bool,
}

impl Level {
    /// A level with zero pressure, gap and load.
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

    /// Sets the pressure of the outermost nodes to zero.
    pub(super) fn clear_boundary(&mut self) {
        for (p, is_boundary) in self.pressure.iter_mut().zip(&self.is_boundary) {
            if *is_boundary {
                *p = 0.0;
            }
        }
    }

    /// Updates flow quantities and conductances from pressure and film.
    pub(super) fn update_flow(&mut self, lubricant: &Lubricant) {
        self.fluid.update(lubricant, &self.pressure, &self.film, self.previous.as_deref());
        self.is_evaluated = true;
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        // Conductances of the faces, for the relaxation.
        for j in 0..ny - 1 {
            for k in j * nx..(j + 1) * nx - 1 {
                [self.east[k], self.north[k]] = self.fluid.conductances(k, &self.pressure);
            }
        }
    }

    /// `F_k` of the evaluated state.
    pub(super) fn balance(&self, k: usize) -> f64 {
        self.fluid.balance(k, self.previous.as_deref())
    }

    /// Residual of the evaluated mass balance in cells under pressure, zero elsewhere.
    pub(super) fn compute_residual(&mut self) {
        for k in interior(&self.grid) {
            self.residual[k] = if self.pressure[k] > 0.0 { self.source[k] - self.balance(k) } else { 0.0 };
        }
    }

    /// Source less transport of the evaluated state, to be balanced by pressure flow.
    pub(super) fn compute_drive(&mut self) {
        for k in interior(&self.grid) {
            let transport = self.fluid.transport(k, self.previous.as_deref());
            self.drive[k] = self.source[k] - transport;
        }
    }

    /// Load carried by the pressure \[N\].
    pub(super) fn carried_load(&self) -> f64 {
        self.pressure.iter().sum::<f64>() * self.grid.cell_area()
    }
}
