//! Stresses in a bonded layer and below it.
//!
//! A transform decomposes the loads into Fourier modes. At each depth [`Layer::correction`](super::Layer)
//! gives the contribution of the bond to every mode, and an inverse transform sums the modes of each of the
//! six components. The closed forms of `subsurface_stress` give the half-space, so that only the smooth
//! correction is truncated at short waves. `mean` corrects the zero mode for the images of the periodic sum.

use std::f64::consts::PI;

use num_complex::Complex64;
use rustfft::FftDirection;

use super::Layer;
use super::fourier_modes::{Body, LayerCorrection};
use crate::elastic::subsurface::extremes::{largest, orthogonal, over, require_increasing};
use crate::elastic::{Extreme, StressExtremes, StressField, subsurface_stress};
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Fft2, RealFft2, fast_length, map_lines};

/// Stresses \[Pa\] in a [`Layer`] that is bonded to a half-space, and in that substrate, under a pressure and
/// a traction along +x on the surface, both constant in each cell of a grid.
///
/// They are the stresses of a half-space ([`subsurface_stress`]) with Poisson's ratio of layer or substrate
/// plus the correction of the bond, mode by mode. The correction vanishes for a layer of the substrate's
/// material. Loads at the surface and the continuity of `zz`, `xz` and `yz` across the bond are exact. The
/// correction is periodic over twice the length of the grid (a row: eight times; a strip: eight times, and its own
/// period across); the contribution of the
/// images below the middle of a load is subtracted. Waves shorter than two cells are omitted from it; they
/// decay as `exp(-pi h/dx)` up to the bond of a layer of thickness `h`. A grid of one row is in plane strain.
///
/// Cost of a depth: that of [`subsurface_stress`] and six transforms of twice the grid.
///
/// Source: Burmister, D. M. (1945), Journal of Applied Physics 16, 89-94.
///
/// ```
/// use stribeck::elastic::{Layer, LayeredStress};
/// use stribeck::Grid;
/// let grid = Grid::centred(65, 65, 1.0 / 30.0, 1.0 / 30.0)?;
/// let pressure: Vec<f64> = grid.nodes().map(|(x, y)| 1e9 * (1.0 - x * x - y * y).max(0.0).sqrt()).collect();
/// // A layer twice as stiff as its substrate is in tension at its bottom.
/// let layer = Layer::new(0.5, [420e9, 0.3], [210e9, 0.3])?;
/// let stress = LayeredStress::new(&grid, layer, &pressure, None)?;
/// let (over, under) = (stress.in_layer(0.5)?, stress.in_substrate(0.5)?);
/// let centre = 32 * 65 + 32;
/// assert!(over.xx[centre] > under.xx[centre]);
/// assert!((over.zz[centre] - under.zz[centre]).abs() < 1.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct LayeredStress {
    /// Grid of the loads and of the stresses.
    grid: Grid,
    /// The layer with its substrate.
    layer: Layer,
    /// Pressure on the surface \[Pa\].
    pressure: Vec<f64>,
    /// Traction along +x on the surface \[Pa\].
    traction: Option<Vec<f64>>,
    /// Padded numbers of cells.
    padded: [usize; 2],
    /// Amplitudes of pressure and traction, columns of modes along y.
    loads: Vec<[Complex64; 2]>,
}

/// The larger principal stress in planes of constant depth \[Pa\].
fn in_plane(field: &StressField) -> impl Iterator<Item = f64> {
    let normal = field.xx.iter().zip(&field.yy);
    normal.zip(&field.xy).map(|((xx, yy), xy)| 0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(*xy))
}

/// The largest stresses in a layer and at its bond.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LayerStressExtremes {
    /// Largest von Mises stress in the layer.
    pub von_mises: Extreme,
    /// Largest shear stress at the bond, `sqrt(xz^2 + yz^2)`, the required bond strength in shear.
    pub bond_shear: Extreme,
    /// Largest tension `zz` at the bond, zero without tension.
    pub bond_tension: Extreme,
    /// Largest tension in the plane of the surface, its larger principal stress; zero without tension.
    pub surface_tension: Extreme,
}

/// The largest stresses in a layer and in the substrate below it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LayeredStressExtremes {
    /// Extremes of the layer.
    pub layer: LayerStressExtremes,
    /// Extremes of the substrate.
    pub substrate: StressExtremes,
}

impl LayeredStress {
    /// Stresses under `pressure` and `traction` \[Pa\] on the cells of `grid`; `None` for no traction.
    ///
    /// # Errors
    /// Slices that do not fit the grid.
    pub fn new(
        grid: &Grid,
        layer: Layer,
        pressure: &[f64],
        traction: Option<&[f64]>,
    ) -> Result<Self, InputError> {
        InputError::require_len("pressure", pressure, grid.len())?;
        if let Some(traction) = traction {
            InputError::require_len("traction", traction, grid.len())?;
        }
        let padded = if grid.has_side_edges() {
            [fast_length(2 * grid.nx() - 1), fast_length(2 * grid.ny() - 1)]
        } else {
            [fast_length(LINE_PERIOD * grid.nx()), grid.ny()]
        };
        Ok(Self {
            grid: *grid,
            layer,
            pressure: pressure.to_vec(),
            traction: traction.map(<[f64]>::to_vec),
            padded,
            loads: amplitudes(grid, padded, pressure, traction),
        })
    }

    /// Stresses at `depth` \[m\] in the layer, from its surface to its bond.
    ///
    /// # Errors
    /// A depth that is not between zero and the thickness.
    pub fn in_layer(&self, depth: f64) -> Result<StressField, InputError> {
        let inside = (0.0..=self.layer.thickness()).contains(&depth);
        InputError::require(inside, "depth", depth, "from zero to the thickness of the layer")?;
        self.at(depth, Body::Layer)
    }

    /// Stresses at `depth` \[m\] below the surface in the substrate, from the bond on.
    ///
    /// # Errors
    /// A depth that is not finite or less than the thickness.
    pub fn in_substrate(&self, depth: f64) -> Result<StressField, InputError> {
        let below = depth >= self.layer.thickness() && depth.is_finite();
        InputError::require(below, "depth", depth, "finite and at least the thickness of the layer")?;
        self.at(depth, Body::Substrate)
    }

    /// The largest stresses over the nodes at increasing `depths` \[m\], and on both sides of the bond.
    ///
    /// # Errors
    /// No depths, depths that do not increase or are not finite and at least zero.
    pub fn extremes(&self, depths: &[f64]) -> Result<LayeredStressExtremes, InputError> {
        require_increasing(depths)?;
        let (grid, bond) = (&self.grid, self.layer.thickness());
        let within: Vec<f64> = depths.iter().copied().filter(|depth| *depth < bond).chain([bond]).collect();
        let below: Vec<f64> =
            [bond].into_iter().chain(depths.iter().copied().filter(|z| *z > bond)).collect();
        let mut in_layer = Vec::new();
        for &depth in &within {
            in_layer.push(largest(self.in_layer(depth)?.von_mises()));
        }
        let (mut mises, mut shear) = (Vec::new(), Vec::new());
        let mut at_bond = [(0, 0.0); 2];
        for &depth in &below {
            let field = self.in_substrate(depth)?;
            mises.push(largest(field.von_mises()));
            shear.push(largest(orthogonal(&field)));
            if mises.len() == 1 {
                let pairs = field.xz.iter().zip(&field.yz);
                at_bond = [largest(pairs.map(|(xz, yz)| xz.hypot(*yz))), largest(field.zz.iter().copied())];
            }
        }
        let surface = largest(in_plane(&self.in_layer(0.0)?));
        let [bond_shear, bond_tension] = at_bond.map(|value| over(grid, &[bond], &[value]));
        Ok(LayeredStressExtremes {
            layer: LayerStressExtremes {
                von_mises: over(grid, &within, &in_layer),
                bond_shear,
                bond_tension,
                surface_tension: over(grid, &[0.0], &[surface]),
            },
            substrate: StressExtremes {
                von_mises: over(grid, &below, &mises),
                orthogonal_shear: over(grid, &below, &shear),
            },
        })
    }

    /// Stresses at `depth` \[m\] of `body`: half-space plus correction of the bond.
    fn at(&self, depth: f64, body: Body) -> Result<StressField, InputError> {
        let poisson = self.layer.poissons[if body == Body::Layer { 0 } else { 1 }];
        let traction = self.traction.as_deref();
        let mut stress = subsurface_stress(&self.grid, poisson, depth, &self.pressure, traction)?;
        let [nx, ny] = self.padded;
        let mut modes = vec![[Complex64::default(); 6]; self.loads.len()];
        // amplitudes of the correction, mode by mode
        let response = |mode: &FourierMode, loads: &[Complex64; 2]| {
            mode.stresses(&self.layer.correction(mode.number, depth, body), loads, poisson)
        };
        map_lines(&mut modes, ny, |i, column| {
            for (j, (stresses, loads)) in column.iter_mut().zip(&self.loads[i * ny..]).enumerate() {
                if let Some(mode) = FourierMode::new(&self.grid, self.padded, [i, j]) {
                    *stresses = response(&mode, loads);
                }
            }
        });
        // the zero mode, without periodic images
        let [under_pressure, under_traction] = mean(&self.grid, self.padded, response);
        let [pressure, traction] = self.loads[0];
        modes[0] = std::array::from_fn(|c| pressure * under_pressure[c] + traction * under_traction[c]);
        // one inverse transform for each component
        let transform = RealFft2::new(nx, ny);
        for (component, out) in stress.components().into_iter().enumerate() {
            let correction = transform.synthesise([self.grid.nx(), self.grid.ny()], |i, column| {
                for (value, mode) in column.iter_mut().zip(&modes[i * ny..]) {
                    *value = mode[component];
                }
                true
            });
            out.iter_mut().zip(correction).for_each(|(sum, part)| *sum += part);
        }
        Ok(stress)
    }
}

/// Fourier amplitudes of pressure and traction, `nx/2 + 1` columns of `ny`.
fn amplitudes(
    grid: &Grid,
    [nx, ny]: [usize; 2],
    pressure: &[f64],
    traction: Option<&[f64]>,
) -> Vec<[Complex64; 2]> {
    let mut both = vec![Complex64::default(); nx * ny];
    for (k, p) in pressure.iter().enumerate() {
        let traction = traction.map_or(0.0, |traction| traction[k]);
        both[k / grid.nx() * nx + k % grid.nx()] = Complex64::new(*p, traction);
    }
    Fft2::new(nx, ny).process(&mut both, FftDirection::Forward);
    // Transform of a uniform cell in place of a point.
    let share = |k: usize, n: usize| {
        let half = PI * k.min(n - k) as f64 / n as f64;
        if half == 0.0 { 1.0 } else { half.sin() / half }
    };
    let mut loads = Vec::with_capacity((nx / 2 + 1) * ny);
    for i in 0..=nx / 2 {
        for j in 0..ny {
            let (own, mirrored) = (both[j * nx + i], both[(ny - j) % ny * nx + (nx - i) % nx].conj());
            let factor = 0.5 * share(i, nx) * share(j, ny) / (nx * ny) as f64;
            loads.push([factor * (own + mirrored), Complex64::new(0.0, -factor) * (own - mirrored)]);
        }
    }
    loads
}

/// Period of a row or a strip in lengths of the grid: stresses of line loads decay as the square of the distance, those
/// of point loads as the cube.
const LINE_PERIOD: usize = 8;
/// Refinement of the fine lattice of modes relative to the lattice of the period.
const REFINEMENT: usize = 8;
/// Width of the Gaussian window of long waves, in modes of the period.
const WINDOW: f64 = 4.0;
/// Modes of the period along each axis over which the window is summed.
const WINDOW_END: usize = 22;

/// Mean stresses under a unit mean pressure and a unit mean traction, such that the stresses below a load
/// contain no contribution of periodic images. The sum over the modes of the period then equals that over a
/// lattice so fine that the images are far away. A smooth window selects the long waves, which alone reach
/// the images.
fn mean(
    grid: &Grid,
    [nx, ny]: [usize; 2],
    response: impl Fn(&FourierMode, &[Complex64; 2]) -> [Complex64; 6],
) -> [[f64; 6]; 2] {
    let steps = [2.0 * PI / (nx as f64 * grid.dx()), 2.0 * PI / (ny as f64 * grid.dy())];
    let (one, none) = (Complex64::ONE, Complex64::ZERO);
    let mut sums = [[0.0; 6]; 2];
    // Adds the mode at `x`, `y` (in modes of the period) with its mirror images.
    let mut add = |x: f64, y: f64, weight: f64| {
        let mirrors = if x == 0.0 { 1.0 } else { 2.0 } * if y == 0.0 { 1.0 } else { 2.0 };
        let factor = weight * mirrors * (-(x * x + y * y) / (WINDOW * WINDOW)).exp();
        let mode = FourierMode::of(x * steps[0], y * steps[1]);
        let [pressed, sheared] = [[one, none], [none, one]].map(|load| response(&mode, &load));
        // All other components are odd and cancel.
        for (sum, stress, c) in [(0, pressed, 0), (0, pressed, 1), (0, pressed, 2), (1, sheared, 4)] {
            sums[sum][c] += factor * stress[c].re;
        }
    };
    let middle = |k: usize| (k as f64 + 0.5) / REFINEMENT as f64;
    let has_side_edges = grid.has_side_edges();
    let rows = if has_side_edges { WINDOW_END } else { 1 };
    for (i, j) in (0..rows).flat_map(|j| (0..WINDOW_END).map(move |i| (i, j))).skip(1) {
        add(i as f64, j as f64, -1.0);
    }
    for i in 0..WINDOW_END * REFINEMENT {
        if !has_side_edges {
            add(middle(i), 0.0, 1.0 / REFINEMENT as f64);
            continue;
        }
        for j in 0..WINDOW_END * REFINEMENT {
            add(middle(i), middle(j), 1.0 / (REFINEMENT * REFINEMENT) as f64);
        }
    }
    sums
}

/// A Fourier mode with the wave vector along `(cos, sin)`.
struct FourierMode {
    /// Wave number \[1/m\].
    number: f64,
    /// Cosine of the angle between wave vector and x.
    cos: f64,
    /// Sine of that angle.
    sin: f64,
}

impl FourierMode {
    /// Mode of column `i` and row `j`; `None` for the mean and for Nyquist modes, which have no unique
    /// direction.
    fn new(grid: &Grid, [nx, ny]: [usize; 2], [i, j]: [usize; 2]) -> Option<Self> {
        if i + j == 0 || 2 * i == nx || 2 * j == ny {
            return None;
        }
        let turned = if 2 * j > ny { j as f64 - ny as f64 } else { j as f64 };
        let x = 2.0 * PI * i as f64 / (nx as f64 * grid.dx());
        let y = 2.0 * PI * turned / (ny as f64 * grid.dy());
        Some(Self::of(x, y))
    }

    /// Mode of the non-zero wave vector `(x, y)`.
    fn of(x: f64, y: f64) -> Self {
        let number = x.hypot(y);
        Self { number, cos: x / number, sin: y / number }
    }

    /// Amplitudes of the stress correction, in the order of [`StressField`].
    fn stresses(
        &self,
        correction: &LayerCorrection,
        [pressure, traction]: &[Complex64; 2],
        poisson: f64,
    ) -> [Complex64; 6] {
        let Self { cos, sin, .. } = *self;
        let (xx, yy, xy) = (cos * cos, sin * sin, cos * sin);
        let i = Complex64::i();
        let (shear, across) = (-i * traction * cos, -traction * sin);
        let f = |k: usize| pressure * correction.pressure[k] + shear * correction.shear[k];
        let (ll, zz, lz) = (f(2), -f(0), -i * f(1));
        let tt = poisson * (ll + zz);
        let (lt, tz) = (i * across * correction.across[0], across * correction.across[1]);
        [
            ll * xx + tt * yy - 2.0 * lt * xy,
            ll * yy + tt * xx + 2.0 * lt * xy,
            zz,
            (ll - tt) * xy + lt * (xx - yy),
            lz * cos - tz * sin,
            lz * sin + tz * cos,
        ]
    }
}
