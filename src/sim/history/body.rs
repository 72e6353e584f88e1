//! One body: its surface on its own nodes, and the balance of its height changes.
//!
//! Wear, plastic depth and tribofilm are stored separately on the nodes of the body, which move through the
//! contact. The surface follows from them. A body has no other state.

use crate::error::InputError;
use crate::metrics;
use crate::plastic::PlasticDepth;
use crate::sim::error::SimError;
use crate::sim::history::squeeze_memory::mirror_rows;
use crate::tribochem::{FilmGrowthLaw, Tribofilm};
use crate::wear::{SurfaceLedger, Volumes, WearDepth};

/// The surface of one body on its own periodic patch.
///
/// At any time `surface = initial - wear - plastic + film`, node by node.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16).with_tribofilm()).build()?;
/// sim.step(60.0)?;
/// let disc = &sim.bodies()[1];
/// for k in 0..16 * 16 {
///     let lost = disc.wear()[k] + disc.plastic_depth()[k];
///     let surface = disc.initial()[k] - lost + disc.tribofilm()[k];
///     assert!((disc.surface()[k] - surface).abs() < 1e-20);
/// }
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug)]
pub struct Body {
    /// Initial heights \[m\].
    initial: Vec<f64>,
    /// Worn depth; never decreases.
    pub(in crate::sim) wear: WearDepth,
    /// Plastic depth; never decreases.
    pub(in crate::sim) plastic: PlasticDepth,
    /// The tribofilm with the state of its law; `None` without a law.
    pub(in crate::sim) film: Option<Tribofilm>,
    /// Zero thickness, for bodies without a tribofilm.
    pub(in crate::sim) no_film: Vec<f64>,
    /// Present heights, updated by `rebuild` \[m\].
    pub(in crate::sim) surface: Vec<f64>,
    /// Volume worn off since the start of the history \[m^3\].
    pub(in crate::sim) worn_volume: f64,
}

impl Clone for Body {
    fn clone(&self) -> Self {
        Self {
            initial: self.initial.clone(),
            wear: self.wear.clone(),
            plastic: self.plastic.clone(),
            film: self.film.clone(),
            no_film: self.no_film.clone(),
            surface: self.surface.clone(),
            worn_volume: self.worn_volume,
        }
    }

    /// Copies into the existing buffers.
    fn clone_from(&mut self, source: &Self) {
        self.initial.clone_from(&source.initial);
        self.wear.clone_from(&source.wear);
        self.plastic.clone_from(&source.plastic);
        self.film.clone_from(&source.film);
        self.no_film.clone_from(&source.no_film);
        self.surface.clone_from(&source.surface);
        self.worn_volume = source.worn_volume;
    }
}

impl Body {
    /// A body without wear, plastic depth and tribofilm. The film will grow by `law`.
    pub(in crate::sim) fn new(initial: Vec<f64>, law: Option<&dyn FilmGrowthLaw>) -> Self {
        let n = initial.len();
        Self {
            wear: WearDepth::new(n),
            plastic: PlasticDepth::new(n),
            film: law.map(|law| Tribofilm::bare(law, n)),
            no_film: vec![0.0; n],
            surface: initial.clone(),
            initial,
            worn_volume: 0.0,
        }
    }

    /// Initial heights \[m\].
    pub fn initial(&self) -> &[f64] {
        &self.initial
    }

    /// Present heights \[m\].
    pub fn surface(&self) -> &[f64] {
        &self.surface
    }

    /// Worn depth \[m\].
    pub fn wear(&self) -> &[f64] {
        self.wear.values()
    }

    /// Volume worn off the whole body since the start of the history \[m^3\]; for a line contact per metre of its
    /// width, for a strip that of one period. It is the time integral of the wear rate over the contact. With Archard's law and one coefficient
    /// it is `K F s/H` (`F` load of the wear pressure, `s` sliding distance), for any box, moving bodies or not.
    /// The patch holds a part of it, see [`Exposure`](crate::sim::scene::Exposure).
    pub fn worn_volume(&self) -> f64 {
        self.worn_volume
    }

    /// Plastic depth \[m\].
    pub fn plastic_depth(&self) -> &[f64] {
        self.plastic.values()
    }

    /// Thickness of the tribofilm \[m\]; zero without one.
    pub fn tribofilm(&self) -> &[f64] {
        self.film.as_ref().map_or(&self.no_film, Tribofilm::thickness)
    }

    /// The height balance of the surface.
    ///
    /// # Errors
    /// Never for a body of a simulation: its fields have one length.
    pub fn ledger(&self) -> Result<SurfaceLedger<'_>, InputError> {
        SurfaceLedger::new(&self.initial, self.wear(), self.plastic_depth(), self.tribofilm())
    }

    /// Volumes worn, flattened and grown on the patch \[m^3\], on cells of `cell_area` \[m^2\].
    ///
    /// # Errors
    /// See [`Body::ledger`].
    pub fn volumes(&self, cell_area: f64) -> Result<Volumes, InputError> {
        Ok(self.ledger()?.volumes(cell_area))
    }

    /// Mirrors the body in x, on rows of `nx` nodes.
    pub(in crate::sim) fn mirror(&mut self, nx: usize) -> Result<(), InputError> {
        let [mut depths, mut worn] = [self.plastic.values(), self.wear.values()].map(<[f64]>::to_vec);
        for field in [&mut self.initial, &mut self.surface, &mut depths, &mut worn] {
            mirror_rows(field, nx);
        }
        self.plastic = PlasticDepth::from_values(depths)?;
        self.wear = WearDepth::from_values(worn)?;
        if let Some(film) = &mut self.film {
            film.mirror(nx);
        }
        Ok(())
    }

    /// Recomputes the surface from its height balance. Heights that are not finite are an error.
    pub(in crate::sim) fn rebuild(&mut self) -> Result<(), SimError> {
        let ledger = SurfaceLedger::new(
            &self.initial,
            self.wear.values(),
            self.plastic.values(),
            self.film.as_ref().map_or(&self.no_film, Tribofilm::thickness),
        )?;
        ledger.surface_into(&mut self.surface)?;
        let sq = metrics::height_statistics(&self.surface)?.sq;
        Ok(InputError::require(sq.is_finite(), "sq of a body after the step", sq, "finite: wear less")?)
    }
}
