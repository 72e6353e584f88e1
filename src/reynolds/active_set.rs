//! The active set: which of the complementary equations holds at a node.
//!
//! Two complementarity pairs hold at each node, with the net outflow `F`, the fluid pressure `p_f`, the solid
//! pressure `p - p_f`, the film `h` and the contact film `h_c`:
//!
//! | pair | one side | other side |
//! |---|---|---|
//! | fluid | `F = 0` (active) | `p_f = 0`, `F >= 0` of a full cell (cavitated) |
//! | solid | `h = h_c`, `p >= p_f` (contact) | `p = p_f`, `h >= h_c` (open) |
//!
//! A pressure limit adds a third state to each: the pressure is the limit and a plastic depth opens the film
//! as far as the equation requires. [`Sample::classify`] finds the active set of a state of unknown origin; in
//! steps of Newton's method the elimination of each node's own equations finds it.

/// Fluid state of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fluid {
    /// On the outermost ring: no fluid pressure, the balance does not hold.
    Boundary,
    /// No fluid pressure; outflow at film fraction one exceeds the inflow.
    Cavitated,
    /// The mass balance holds.
    Active,
    /// The fluid is at the pressure limit; the plastic depth satisfies the mass balance.
    AtLimit,
}

/// Solid state of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Solid {
    /// The film is thicker than the contact film; no solid pressure.
    Open,
    /// The film is the contact film.
    Contact,
    /// Contact at the pressure limit: the plastic depth holds the film at the contact film.
    Yielded,
}

/// State of a node in the active set: the equation of each pair that holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NodeState {
    /// Fluid state: which condition is an equality.
    pub(super) fluid: Fluid,
    /// Solid state: which condition is an equality.
    pub(super) solid: Solid,
}

impl NodeState {
    /// A node of the outermost ring before its solid state is known.
    pub(super) const BOUNDARY: Self = Self { fluid: Fluid::Boundary, solid: Solid::Open };

    /// Whether the fluid pressure of the node is an unknown.
    pub(super) fn has_fluid_pressure(self) -> bool {
        self.fluid == Fluid::Active
    }

    /// Whether the node is open and its fluid pressure an unknown.
    pub(super) fn is_open_fluid(self) -> bool {
        self.fluid == Fluid::Active && self.solid == Solid::Open
    }

    /// Whether the mass balance is imposed at the node.
    pub(super) fn has_balance(self) -> bool {
        matches!(self.fluid, Fluid::Active | Fluid::AtLimit)
    }

    /// Pressure and film of the node per unknown of its mass balance, in their own units.
    pub(super) fn dof_map(self) -> [f32; 2] {
        match (self.fluid, self.solid) {
            (Fluid::Active, Solid::Open) => [1.0, 1.0],
            (Fluid::Active, _) => [1.0, 0.0],
            (Fluid::AtLimit, _) => [0.0, 1.0],
            _ => [0.0, 0.0],
        }
    }

    /// Whether solids touch at the node.
    pub(super) fn is_contact(self) -> bool {
        self.solid != Solid::Open
    }
}

/// The quantities that determine the state of a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Total pressure \[Pa\].
    pub(super) pressure: f64,
    /// Fluid pressure \[Pa\].
    pub(super) fluid_pressure: f64,
    /// Film without the plastic depth of this solve \[m\].
    pub(super) elastic_film: f64,
    /// Contact film \[m\].
    pub(super) contact_film: f64,
    /// Pressure limit of the node \[Pa\].
    pub(super) limit: f64,
    /// Pressure change by one relaxation of the mass balance, `-F / diagonal` \[Pa\].
    pub(super) fluid_push: f64,
    /// Influence coefficient of the node on itself \[m/Pa\].
    pub(super) own_influence: f64,
    /// Whether there is a lubricant.
    pub(super) lubricated: bool,
}

impl Sample {
    /// The primal-dual rule: the sign of a multiplier plus its scaled constraint decides. A solution is then a fixed
    /// point, and nodes do not alternate as they do if pressure and residual are tested in sequence.
    pub(super) fn classify(&self, previous: NodeState) -> NodeState {
        if previous.fluid == Fluid::AtLimit && self.fluid_pressure >= self.limit {
            return previous;
        }
        let fluid = if previous.fluid == Fluid::Boundary {
            Fluid::Boundary
        } else if self.lubricated && self.fluid_pressure + self.fluid_push >= 0.0 {
            Fluid::Active
        } else {
            Fluid::Cavitated
        };
        let closing = self.contact_film - self.elastic_film;
        let solid = if (self.pressure - self.fluid_pressure) * self.own_influence + closing <= 0.0 {
            Solid::Open
        } else if self.pressure + closing / self.own_influence >= self.limit {
            Solid::Yielded
        } else {
            Solid::Contact
        };
        NodeState { fluid, solid }
    }
}
