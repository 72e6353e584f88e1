//! Stresses in a bonded layer and below it.
//!
//! Loads become amplitudes of waves by one transform; each depth asks [`Layer::added`](super::Layer) for what
//! the bond adds to every wave, and one inverse transform for each of the six components sums it. The
//! half-space below is summed in closed forms by `subsurface_stress`, so that what is cut off at short waves
//! is only the smooth part. `mean` corrects the wave of number zero for the images of the periodic sum.

use std::f64::consts::PI;

use num_complex::Complex64;
use rustfft::FftDirection;

use super::Layer;
use super::waves::{Added, Body};
use crate::elastic::subsurface::extremes::{largest, orthogonal, over, require_increasing};
use crate::elastic::{Extreme, StressExtremes, StressField, subsurface_stress};
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Fft2, RealFft2, fast_length, map_lines};

/// Stresses \[Pa\] in a [`Layer`] that is bonded to a half-space, and in that substrate, under a pressure and
/// a traction along +x on the surface, both constant in each cell of a grid.
///
/// They are the stresses of a half-space ([`subsurface_stress`]) with Poisson's ratio of layer or substrate,
/// plus what the bond adds, wave by wave. For a layer of the material of the substrate that is nothing, and
/// loads at the surface and the equality of `zz`, `xz` and `yz` on both sides of the bond are exact. What the
/// bond adds is that of the loads repeated at twice the length of the grid (a row: eight times), less what
/// the images add below the middle of a load. Waves shorter than two cells are left out of it, which reach
/// the bond of a layer of thickness `h` with `exp(-pi h/dx)`. A grid of one row is in plane strain.
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
/// // Twice as stiff as the substrate: the bottom of the layer is stretched where the substrate is pressed.
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
    /// Numbers of cells that the waves have.
    padded: [usize; 2],
    /// Amplitudes of pressure and traction, columns of waves along y.
    loads: Vec<[Complex64; 2]>,
}

/// The largest stresses in a layer and at its bond.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LayerStressExtremes {
    /// Largest stress of von Mises in the layer.
    pub von_mises: Extreme,
    /// Largest shear stress at the bond, `sqrt(xz^2 + yz^2)`: what it has to hold against sliding.
    pub bond_shear: Extreme,
    /// Largest tension `zz` at the bond, which pulls the layer off; zero where there is none.
    pub bond_tension: Extreme,
}

/// The largest stresses in a layer and in the substrate below it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LayeredStressExtremes {
    /// Those of the layer.
    pub layer: LayerStressExtremes,
    /// Those of the substrate.
    pub substrate: StressExtremes,
}

impl LayeredStress {
    /// Under `pressure` and `traction` \[Pa\] on the cells of `grid`; `None` for no traction.
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
        let padded = if grid.ny() == 1 {
            [fast_length(LINE_LENGTHS * grid.nx()), 1]
        } else {
            [fast_length(2 * grid.nx() - 1), fast_length(2 * grid.ny() - 1)]
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

    /// The largest stresses under the nodes at `depths` \[m\], which increase, and on both sides of the bond.
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
        let [bond_shear, bond_tension] = at_bond.map(|value| over(grid, &[bond], &[value]));
        Ok(LayeredStressExtremes {
            layer: LayerStressExtremes {
                von_mises: over(grid, &within, &in_layer),
                bond_shear,
                bond_tension,
            },
            substrate: StressExtremes {
                von_mises: over(grid, &below, &mises),
                orthogonal_shear: over(grid, &below, &shear),
            },
        })
    }

    /// Stresses at `depth` \[m\] of `body`: those of a half-space and what the bond adds.
    fn at(&self, depth: f64, body: Body) -> Result<StressField, InputError> {
        let poisson = self.layer.poissons[if body == Body::Layer { 0 } else { 1 }];
        let traction = self.traction.as_deref();
        let mut stress = subsurface_stress(&self.grid, poisson, depth, &self.pressure, traction)?;
        let [nx, ny] = self.padded;
        let mut waves = vec![[Complex64::default(); 6]; self.loads.len()];
        let response = |wave: &Wave, loads: &[Complex64; 2]| {
            wave.stresses(&self.layer.added(wave.number, depth, body), loads, poisson)
        };
        map_lines(&mut waves, ny, |i, column| {
            for (j, (stresses, loads)) in column.iter_mut().zip(&self.loads[i * ny..]).enumerate() {
                if let Some(wave) = Wave::new(&self.grid, self.padded, [i, j]) {
                    *stresses = response(&wave, loads);
                }
            }
        });
        let [under_pressure, under_traction] = mean(&self.grid, self.padded, response);
        let [pressure, traction] = self.loads[0];
        waves[0] = std::array::from_fn(|c| pressure * under_pressure[c] + traction * under_traction[c]);
        let transform = RealFft2::new(nx, ny);
        for (component, out) in stress.components().into_iter().enumerate() {
            let added = transform.synthesise([self.grid.nx(), self.grid.ny()], |i, column| {
                for (value, wave) in column.iter_mut().zip(&waves[i * ny..]) {
                    *value = wave[component];
                }
                true
            });
            out.iter_mut().zip(added).for_each(|(sum, part)| *sum += part);
        }
        Ok(stress)
    }
}

/// Amplitudes of the waves of pressure and traction, `nx/2 + 1` columns of `ny`.
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
    // Uniform cells in place of points.
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

/// Lengths of a row from load to image: stresses of lines fall as the square of the distance, those of points
/// as the cube.
const LINE_LENGTHS: usize = 8;
/// How much closer the waves of a fine lattice are than those of the period.
const FINE: usize = 8;
/// Width of a window of long waves, and its end, in waves of the period.
const WINDOW: f64 = 4.0;
/// Waves of the period along each axis that the window is summed over.
const END: usize = 22;

/// Amplitudes of the mean stresses under a mean pressure and a mean traction of one that leave the stresses
/// below a load without those of its images: with them the sum over the waves of the period is that over a
/// lattice so fine that the images are far away. A smooth window keeps the long waves, which alone reach the
/// images.
fn mean(
    grid: &Grid,
    [nx, ny]: [usize; 2],
    response: impl Fn(&Wave, &[Complex64; 2]) -> [Complex64; 6],
) -> [[f64; 6]; 2] {
    let steps = [2.0 * PI / (nx as f64 * grid.dx()), 2.0 * PI / (ny as f64 * grid.dy())];
    let (one, none) = (Complex64::ONE, Complex64::ZERO);
    let mut sums = [[0.0; 6]; 2];
    // A wave at `x`, `y` waves of the period, for all that mirror it.
    let mut add = |x: f64, y: f64, weight: f64| {
        let mirrors = if x == 0.0 { 1.0 } else { 2.0 } * if y == 0.0 { 1.0 } else { 2.0 };
        let factor = weight * mirrors * (-(x * x + y * y) / (WINDOW * WINDOW)).exp();
        let wave = Wave::of(x * steps[0], y * steps[1]);
        let [pressed, sheared] = [[one, none], [none, one]].map(|load| response(&wave, &load));
        // The others are odd.
        for (sum, stress, c) in [(0, pressed, 0), (0, pressed, 1), (0, pressed, 2), (1, sheared, 4)] {
            sums[sum][c] += factor * stress[c].re;
        }
    };
    let middle = |k: usize| (k as f64 + 0.5) / FINE as f64;
    let rows = if ny == 1 { 1 } else { END };
    for (i, j) in (0..rows).flat_map(|j| (0..END).map(move |i| (i, j))).skip(1) {
        add(i as f64, j as f64, -1.0);
    }
    for i in 0..END * FINE {
        if ny == 1 {
            add(middle(i), 0.0, 1.0 / FINE as f64);
            continue;
        }
        for j in 0..END * FINE {
            add(middle(i), middle(j), 1.0 / (FINE * FINE) as f64);
        }
    }
    sums
}

/// A wave along the direction `(cos, sin)`.
struct Wave {
    /// Wave number \[1/m\].
    number: f64,
    /// Its direction along x.
    cos: f64,
    /// Its direction along y.
    sin: f64,
}

impl Wave {
    /// That of column `i` and row `j`; none for the mean and for the shortest ones, which have
    /// no direction.
    fn new(grid: &Grid, [nx, ny]: [usize; 2], [i, j]: [usize; 2]) -> Option<Self> {
        if i + j == 0 || 2 * i == nx || 2 * j == ny {
            return None;
        }
        let turned = if 2 * j > ny { j as f64 - ny as f64 } else { j as f64 };
        let x = 2.0 * PI * i as f64 / (nx as f64 * grid.dx());
        let y = 2.0 * PI * turned / (ny as f64 * grid.dy());
        Some(Self::of(x, y))
    }

    /// That of the wave vector `(x, y)`, which is not zero.
    fn of(x: f64, y: f64) -> Self {
        let number = x.hypot(y);
        Self { number, cos: x / number, sin: y / number }
    }

    /// Amplitudes of the stresses, in the order of [`StressField`].
    fn stresses(&self, added: &Added, [pressure, traction]: &[Complex64; 2], poisson: f64) -> [Complex64; 6] {
        let Self { cos, sin, .. } = *self;
        let (xx, yy, xy) = (cos * cos, sin * sin, cos * sin);
        let i = Complex64::i();
        let (shear, across) = (-i * traction * cos, -traction * sin);
        let f = |k: usize| pressure * added.pressure[k] + shear * added.shear[k];
        let (ll, zz, lz) = (f(2), -f(0), -i * f(1));
        let tt = poisson * (ll + zz);
        let (lt, tz) = (i * across * added.across[0], across * added.across[1]);
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
