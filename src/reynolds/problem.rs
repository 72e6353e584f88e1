//! The coupled contact problem.

use super::flow::{Cavitation, FaceMobility, Scheme, ShearThinning};
use super::squeeze::{EdgePressure, Squeeze};
use crate::elastic::DeformationModel;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::with_fields::with_fields;

/// Definition of solid contact in a lubricated contact.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::ContactDefinition;
/// use stribeck::sim::{Scene, solve_contact};
/// let scene = Scene::azam_2019(32);
/// assert_eq!(scene.solver.contact, ContactDefinition::Hard);
/// let solution = solve_contact(&scene)?;
/// // Solids hold the film at the cut-off.
/// assert!(solution.film.minimum_gap > 0.9 * scene.solver.film_cutoff);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ContactDefinition {
    /// Separate fluid and solid pressure: solids touch where the film is the cut-off, and hold it there.
    #[default]
    Hard,
    /// One pressure, as in Azam et al. (2019). Pressure flow is switched off at nodes whose film is below the
    /// cut-off. Films are entrained as they are, even if negative. Pressures are clipped at the limit, where the
    /// overlap becomes plastic depth. After the solve, pressure at nodes below the cut-off counts as solid
    /// pressure. Gaps may become negative, and the solution depends on the mesh. If the film is above the cut-off
    /// everywhere, the solution is that of `Hard`.
    #[cfg_attr(feature = "serde", serde(rename = "paper"))]
    UnifiedReynolds,
}

impl ContactDefinition {
    /// Default of the entrainment flux: limited, or first order as published.
    pub fn default_scheme(self) -> Scheme {
        match self {
            Self::Hard => Scheme::default(),
            Self::UnifiedReynolds => Scheme::FirstOrder,
        }
    }

    /// Default of the cavitation condition: mass-conserving, or that of Reynolds as published.
    pub fn default_cavitation(self) -> Cavitation {
        match self {
            Self::Hard => Cavitation::default(),
            Self::UnifiedReynolds => Cavitation::Reynolds,
        }
    }

    /// Default of the face mobility. Between rough surfaces contact edges are reconstructed within a cell; between smooth
    /// surfaces, whose inlets are resolved, the film is linear between nodes. As published it is the arithmetic mean.
    pub fn default_face_mobility(self, smooth: bool) -> FaceMobility {
        match self {
            Self::Hard if smooth => FaceMobility::Wedge,
            Self::Hard => FaceMobility::Inlet,
            Self::UnifiedReynolds => FaceMobility::Arithmetic,
        }
    }
}

/// A contact problem: find pressure, film and approach such that
///
/// - fluid pressure `p_f >= 0` with `F(p_f, h) >= 0`, one of them zero; `F` is the net outflow of a cell,
///   `F = u d(rho h)/dx + d(rho h)/dt - div(rho h^3 / (12 eta) grad p_f)`;
/// - solid pressure `p_s >= 0` with `h >= h_cut`, one of them an equality;
/// - total pressure `p = p_f + p_s <= pressure_limit` with plastic depth `d >= 0`, one of them an equality;
/// - film `h = gap - approach + K p + d`;
/// - load balance: the integral of `p` is `load` minus the load outside of an [`EdgePressure`].
///
/// Without lubricant `p_f = 0` and `h_cut = 0`: dry contact. The fluid pressure of a state is zero on the outermost
/// nodes; solids may touch there.
///
/// On a grid with one row this is a line contact: the two ends of the row are its outermost nodes, there is no flow
/// along y, and loads are those of the length `dy`. On a [strip](Grid::strip) the two ends of each row are outermost
/// nodes, no fluid flows across the first and the last row, and loads are those of its width.
///
/// # Examples
///
/// A smooth steel ball in oil, compared with a film formula:
///
/// ```
/// use stribeck::analytic::{FilmConditions, HertzPoint};
/// use stribeck::elastic::HalfSpace;
/// use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
/// use stribeck::reynolds::{Auto, ContactSolver, ContactState, LubricatedContact, StoppingRule};
/// use stribeck::Grid;
/// let (radius, modulus) = (9.525e-3, 230e9);
/// let hertz = HertzPoint::from_max_pressure(radius, radius, modulus, 0.5e9)?;
/// let grid = Grid::centred(64, 64, 5.0 * hertz.half_width_x / 64.0, 5.0 * hertz.half_width_x / 64.0)?;
/// let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / (2.0 * radius)).collect();
/// let oil = Lubricant::new(Roelands::new(0.04, 0.6, 1.96e8)?, DowsonHigginson::new(0.6e-9, 1.7e-9)?);
/// let mut body = HalfSpace::new(grid, modulus)?;
/// let mut problem = LubricatedContact::new(&gap, &mut body, hertz.force, (hertz.half_width_x, hertz.half_width_y), hertz.pressure)
///     .with_lubricant(Some(&oil))
///     .with_entrainment_speed(1.0)
///     .with_reference_film(200e-9);
/// let mut state = ContactState::new(&grid);
/// let report = Auto::new().solve(&mut problem, &mut state, &StoppingRule::default())?;
/// report.require_converged()?;
/// let carried = state.pressure.iter().sum::<f64>() * grid.cell_area();
/// assert!((carried / hertz.force - 1.0).abs() < 1e-5);
/// assert!(!state.in_contact.contains(&true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub struct LubricatedContact<'a> {
    /// Undeformed gap per node \[m\]: form minus the heights of both surfaces.
    pub gap: &'a [f64],
    /// Elastic response; it also fixes the grid.
    pub deformation: &'a mut dyn DeformationModel,
    /// The lubricant; `None` for a dry contact.
    pub lubricant: Option<&'a Lubricant>,
    /// Mean speed of the two surfaces along +x \[m/s\].
    pub entrainment_speed: f64,
    /// Radius of spin `R` \[m\]: the mean motion of the surfaces is a rotation about the point (0, `R`),
    /// `u = U (1 - y/R)` along x and `v = U x/R` along y with the entrainment speed `U`. `None` for motion along x
    /// only.
    pub spin_radius: Option<f64>,
    /// Squeeze term; `None` for a quasi-static solve.
    pub squeeze: Option<Squeeze<'a>>,
    /// Normal load \[N\].
    pub load: f64,
    /// Largest pressure per node \[Pa\] (hardness); `None` for an elastic contact.
    pub pressure_limit: Option<&'a [f64]>,
    /// Film thickness at which solids touch in a lubricated contact, `h_cut` \[m\].
    pub film_cutoff: f64,
    /// Definition of solid contact.
    pub contact: ContactDefinition,
    /// Discretization of the wedge term.
    pub scheme: Scheme,
    /// Law of the pressure flow through faces.
    pub face_mobility: FaceMobility,
    /// Cavitation condition.
    pub cavitation: Cavitation,
    /// Film thickness at ambient density supplied at the inlet edge \[m\]; `None` for a flooded inlet. It limits the
    /// flow of full gaps through the first faces. Needs mass-conserving cavitation.
    pub supplied_film: Option<f64>,
    /// Fluid pressure at the edge of the box; `None` for ambient pressure.
    pub edge_pressure: Option<EdgePressure<'a>>,
    /// Shear thinning of the pressure flow; `None` for a Newtonian fluid.
    pub shear_thinning: Option<ShearThinning>,
    /// Half-widths `(a_x, a_y)` of the contact \[m\], usually those of Hertz, for the scale of residuals and for starts;
    /// the second one of a strip is half of its width.
    pub reference_half_widths: (f64, f64),
    /// Pressure \[Pa\] for starts, usually the Hertz pressure.
    pub reference_pressure: f64,
    /// Film thickness \[m\] for starts, usually the Hamrock-Dowson central film of the smooth contact; zero if
    /// unknown.
    pub reference_film: f64,
}

with_fields!(<'a> LubricatedContact<'a> {
    with_lubricant lubricant: Option<&'a Lubricant>,
    with_entrainment_speed entrainment_speed: f64,
    with_spin_radius spin_radius: Option<f64>,
    with_squeeze squeeze: Option<Squeeze<'a>>,
    with_load load: f64,
    with_pressure_limit pressure_limit: Option<&'a [f64]>,
    with_film_cutoff film_cutoff: f64,
    with_contact contact: ContactDefinition,
    with_scheme scheme: Scheme,
    with_face_mobility face_mobility: FaceMobility,
    with_cavitation cavitation: Cavitation,
    with_supplied_film supplied_film: Option<f64>,
    with_edge_pressure edge_pressure: Option<EdgePressure<'a>>,
    with_shear_thinning shear_thinning: Option<ShearThinning>,
    with_reference_film reference_film: f64,
});

impl<'a> LubricatedContact<'a> {
    /// A dry elastic contact; set the rest with the `with_` methods. `reference_half_widths` \[m\] and
    /// `reference_pressure` \[Pa\] are usually those of Hertz, `load` is in N.
    pub fn new(
        gap: &'a [f64],
        deformation: &'a mut dyn DeformationModel,
        load: f64,
        reference_half_widths: (f64, f64),
        reference_pressure: f64,
    ) -> Self {
        Self {
            gap,
            deformation,
            lubricant: None,
            entrainment_speed: 0.0,
            spin_radius: None,
            squeeze: None,
            load,
            pressure_limit: None,
            film_cutoff: LubricatedContact::FILM_CUTOFF,
            contact: ContactDefinition::default(),
            scheme: Scheme::default(),
            face_mobility: FaceMobility::default(),
            cavitation: Cavitation::default(),
            supplied_film: None,
            edge_pressure: None,
            shear_thinning: None,
            reference_half_widths,
            reference_pressure,
            reference_film: 0.0,
        }
    }
}

impl LubricatedContact<'_> {
    /// Default film thickness of solid contact \[m\].
    pub const FILM_CUTOFF: f64 = 1e-9;

    /// The grid of the problem.
    pub fn grid(&self) -> Grid {
        self.deformation.grid()
    }

    /// Contact film thickness: the cut-off of a lubricated contact, zero for a dry one \[m\].
    pub fn contact_film(&self) -> f64 {
        if self.lubricant.is_some() { self.film_cutoff } else { 0.0 }
    }

    /// The load carried by the pressures in the box \[N\]; `None` if the approach is prescribed.
    pub fn box_load(&self) -> Option<f64> {
        let outside = self.edge_pressure.map_or(Some(0.0), |edge| edge.load_outside);
        outside.map(|outside| self.load - outside)
    }

    /// Fluid pressure of the outermost node `k` \[Pa\].
    pub(super) fn edge_pressure_at(&self, k: usize) -> f64 {
        self.edge_pressure.map_or(0.0, |edge| edge.field[k])
    }

    /// Squared distances of the point `(x, y)` of `grid` from the center along both axes, in half-widths of the
    /// reference; across a strip the second one is zero.
    pub(super) fn reference_distances(&self, grid: &Grid, (x, y): (f64, f64)) -> [f64; 2] {
        let (a, b) = self.reference_half_widths;
        [(x / a).powi(2), if grid.is_strip() { 0.0 } else { (y / b).powi(2) }]
    }

    /// Pressure limit of node `k` \[Pa\]; infinite without a limit.
    pub(super) fn limit_at(&self, k: usize) -> f64 {
        self.pressure_limit.map_or(f64::INFINITY, |limit| limit[k])
    }

    /// Whether fluid and solids have pressures of their own. A dry contact has solid pressure only.
    pub(super) fn is_hard(&self) -> bool {
        self.contact == ContactDefinition::Hard || self.lubricant.is_none()
    }

    /// The same contact, for solvers that modify it; the original does not change.
    pub(super) fn copied(&mut self) -> LubricatedContact<'_> {
        LubricatedContact { deformation: &mut *self.deformation, ..*self }
    }
}

/// Indices of the outermost nodes; for a line contact the two ends of its rows.
pub(crate) fn outermost(grid: &Grid) -> impl Iterator<Item = usize> + use<> {
    let (nx, ny) = (grid.nx(), grid.ny());
    let has_sides = grid.has_side_edges();
    let at_side = move |j: usize| has_sides && (j == 0 || j + 1 == ny);
    (0..ny).flat_map(move |j| {
        let step = if at_side(j) { 1 } else { nx.max(2) - 1 };
        (0..nx).step_by(step).map(move |i| j * nx + i)
    })
}
