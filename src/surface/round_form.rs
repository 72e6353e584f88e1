//! Removal of round forms: least-squares sphere or cylinder.

use faer::Mat;

use super::error::SurfaceError;
use super::form_removal::{centred, least_squares};
use super::measured::Heights;
use crate::error::InputError;

/// Most steps of a fit.
const STEPS: usize = 50;
/// Most halvings of a step whose form has no height at some point.
const HALVINGS: usize = 30;
/// Change of the parameters, in units of half the surface length, at which a fit ends.
const CONVERGED: f64 = 1e-13;
/// Change at which a cylinder fit counts as converged if rounding prevents [`CONVERGED`].
const ROUNDED: f64 = 1e-8;

/// Points of a surface: indices, positions and heights in units of half its length.
struct Points {
    points: Vec<(usize, [f64; 3])>,
    /// Half of the longer side \[m\].
    unit: f64,
}

impl Heights {
    /// Subtracts the least-squares sphere (vertical distances) through the defined points and returns its radius \[m\]:
    /// positive for a ball, negative for a socket, very large for a flat.
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`]; [`SurfaceError::Input`] if no sphere is found (the surface extends beyond its
    /// equator); the errors of [`Heights::remove_plane`].
    ///
    /// ```
    /// # use stribeck::{Grid, surface::Heights};
    /// let grid = Grid::centred(40, 30, 10e-6, 10e-6)?;
    /// let ball = grid.nodes().map(|(x, y)| (9.525e-3_f64.powi(2) - x * x - y * y).sqrt()).collect();
    /// let mut surface = Heights::new(40, 30, Some([10e-6, 10e-6]), ball, None)?;
    /// assert!((surface.remove_sphere()? / 9.525e-3 - 1.0).abs() < 1e-9);
    /// assert!(surface.heights().iter().all(|z| z.abs() < 1e-15));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn remove_sphere(&mut self) -> Result<f64, SurfaceError> {
        let Points { points, unit } = self.points()?;
        let sphere = SphereFit::fit(&points)?;
        for (k, [x, y, z]) in points {
            let (sphere, _) = sphere.at(x, y).ok_or_else(no_sphere)?;
            self.heights[k] = (z - sphere) * unit;
        }
        Ok(-unit / sphere.0[3])
    }

    /// Subtracts the least-squares cylinder (vertical distances) through the defined points, with its axis in any direction,
    /// and returns its radius \[m\]: positive for a roller, negative for a groove, very large for a flat.
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`]; [`SurfaceError::Input`] if no cylinder is found (the surface extends beyond its
    /// widest part); the errors of [`Heights::remove_plane`].
    ///
    /// ```
    /// use stribeck::{Grid, surface::Heights};
    /// let grid = Grid::centred(40, 30, 10e-6, 10e-6)?;
    /// // the axis at 30 degrees to x
    /// let across = |x: f64, y: f64| 0.75_f64.sqrt() * y - 0.5 * x;
    /// let roller = grid.nodes().map(|(x, y)| (4e-3_f64.powi(2) - across(x, y).powi(2)).sqrt()).collect();
    /// let mut surface = Heights::new(40, 30, Some([10e-6, 10e-6]), roller, None)?;
    /// assert!((surface.remove_cylinder()? / 4e-3 - 1.0).abs() < 1e-6);
    /// assert!(surface.heights().iter().all(|z| z.abs() < 1e-12));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn remove_cylinder(&mut self) -> Result<f64, SurfaceError> {
        let Points { points, unit } = self.points()?;
        let cylinder = Cylinder::fit(&points)?;
        for (k, [x, y, z]) in points {
            let (height, _) = cylinder.at(x, y).ok_or_else(no_cylinder)?;
            self.heights[k] = (z - height) * unit;
        }
        Ok(-unit / cylinder.0[3])
    }

    /// The defined points relative to their mean.
    fn points(&self) -> Result<Points, SurfaceError> {
        let [dx, dy] = self.spacing.ok_or(SurfaceError::NoSpacing)?;
        let mean = self.mean()?;
        let unit = 0.5 * (dx * self.nx as f64).max(dy * self.ny as f64);
        let (width, length) = (0.5 * dx * self.nx as f64 / unit, 0.5 * dy * self.ny as f64 / unit);
        let points = (0..self.heights.len())
            .filter(|&k| self.is_defined(k))
            .map(|k| {
                let (u, v) = (centred(k % self.nx, self.nx), centred(k / self.nx, self.ny));
                (k, [u * width, v * length, (self.heights[k] - mean) / unit])
            })
            .collect();
        Ok(Points { points, unit })
    }
}

/// The error of points that no sphere fits.
fn no_sphere() -> SurfaceError {
    InputError::Conflict { field: "heights".to_owned(), reason: "no sphere fits them".to_owned() }.into()
}

/// A sphere by height, slopes and curvature at the origin; a flat has zero curvature. Its equation is
/// `curvature (w^2 + r^2) - 2 (w - p x - q y) / m = 0` with `w` the height above the origin and
/// `m^2 = 1 + p^2 + q^2`.
#[derive(Clone, Copy)]
struct SphereFit([f64; 4]);

impl SphereFit {
    fn fit(points: &[(usize, [f64; 3])]) -> Result<Self, SurfaceError> {
        let mut sphere = Self([0.0; 4]);
        let mut normal = sphere.normal_equations(points).ok_or_else(no_sphere)?;
        for _ in 0..STEPS {
            let step = least_squares(&normal.0, &normal.1)?;
            let mut share = 1.0;
            let mut next = None;
            for _ in 0..HALVINGS {
                let mut moved = sphere;
                moved.0.iter_mut().zip(&step).for_each(|(value, change)| *value += share * change);
                next = moved.normal_equations(points).map(|normal| (moved, normal));
                if next.is_some() {
                    break;
                }
                share *= 0.5;
            }
            (sphere, normal) = next.ok_or_else(no_sphere)?;
            if step.iter().all(|change| change.abs() < CONVERGED) {
                return Ok(sphere);
            }
        }
        Err(no_sphere())
    }

    /// Height and its derivatives by the four parameters, `None` beyond the equator.
    fn at(&self, x: f64, y: f64) -> Option<(f64, [f64; 4])> {
        let [height, p, q, curvature] = self.0;
        let m = (1.0 + p * p + q * q).sqrt();
        let (plane, square) = (p * x + q * y, x * x + y * y);
        let gap = curvature * square + 2.0 * plane / m;
        let under = 1.0 / (m * m) - curvature * gap;
        if under.is_nan() || under <= 0.0 {
            return None;
        }
        let root = under.sqrt();
        let w = gap / (1.0 / m + root);
        let tilt = (w - plane) / (m * m * m);
        let slope = |along: f64, coordinate: f64| (coordinate / m + along * tilt) / root;
        Some((height + w, [1.0, slope(p, x), slope(q, y), 0.5 * (w * w + square) / root]))
    }

    fn normal_equations(&self, points: &[(usize, [f64; 3])]) -> Option<(Mat<f64>, [f64; 4])> {
        let (mut matrix, mut right) = (Mat::<f64>::zeros(4, 4), [0.0; 4]);
        let share = 1.0 / points.len() as f64;
        for (_, [x, y, z]) in points {
            let (sphere, derivatives) = self.at(*x, *y)?;
            for (row, a) in derivatives.iter().enumerate() {
                right[row] += share * a * (z - sphere);
                for (column, b) in derivatives.iter().enumerate() {
                    matrix[(row, column)] += share * a * b;
                }
            }
        }
        Some((matrix, right))
    }
}

/// The error of points that no cylinder fits.
fn no_cylinder() -> SurfaceError {
    InputError::Conflict { field: "heights".to_owned(), reason: "no cylinder fits them".to_owned() }.into()
}

/// A cylinder by height at the origin, slope s along its axis, slope and curvature across it, and the angle of the axis
/// to x. With u along and v across the axis the height is `h + s u + sqrt(1 + s^2) w(v)`, where `w(v)` is the circle of
/// [`SphereFit`] in one dimension.
#[derive(Clone, Copy)]
struct Cylinder([f64; 5]);

impl Cylinder {
    /// Gauss-Newton iteration from the least-squares quadratic polynomial, whose principal axes are those of the cylinder.
    fn fit(points: &[(usize, [f64; 3])]) -> Result<Self, SurfaceError> {
        let mut cylinder = Self::start(points)?;
        let mut normal = cylinder.normal_equations(points).ok_or_else(no_cylinder)?;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let step = least_squares(&normal.0, &normal.1)?;
            let mut share = 1.0;
            let mut next = None;
            for _ in 0..HALVINGS {
                let mut moved = cylinder;
                moved.0.iter_mut().zip(&step).for_each(|(value, change)| *value += share * change);
                next = moved.normal_equations(points).map(|normal| (moved, normal));
                if next.is_some() {
                    break;
                }
                share *= 0.5;
            }
            (cylinder, normal) = next.ok_or_else(no_cylinder)?;
            let change = step.iter().fold(0.0_f64, |most, change| most.max(change.abs()));
            if change < CONVERGED || (change < ROUNDED && change >= last) {
                return Ok(cylinder);
            }
            last = change;
        }
        Err(no_cylinder())
    }

    /// The cylinder of the least-squares quadratic polynomial.
    fn start(points: &[(usize, [f64; 3])]) -> Result<Self, SurfaceError> {
        let (mut matrix, mut right) = (Mat::<f64>::zeros(6, 6), [0.0; 6]);
        let share = 1.0 / points.len() as f64;
        for (_, [x, y, z]) in points {
            let terms = [1.0, *x, *y, 0.5 * x * x, x * y, 0.5 * y * y];
            for (row, a) in terms.iter().enumerate() {
                right[row] += share * a * z;
                for (column, b) in terms.iter().enumerate() {
                    matrix[(row, column)] += share * a * b;
                }
            }
        }
        let fit = least_squares(&matrix, &right)?;
        let [height, p, q, xx, xy, yy] = [fit[0], fit[1], fit[2], fit[3], fit[4], fit[5]];
        // principal curvatures: the larger one is across the axis
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let curvature = if mean < 0.0 { mean - half } else { mean + half };
        let across =
            0.5 * (2.0 * xy).atan2(xx - yy) + if mean < 0.0 { std::f64::consts::FRAC_PI_2 } else { 0.0 };
        let angle = across - std::f64::consts::FRAC_PI_2;
        let (sin, cos) = angle.sin_cos();
        Ok(Self([height, p * cos + q * sin, q * cos - p * sin, curvature, angle]))
    }

    /// Height and its derivatives by the five parameters, `None` beyond the widest part.
    fn at(&self, x: f64, y: f64) -> Option<(f64, [f64; 5])> {
        let [height, s, q, curvature, angle] = self.0;
        let (sin, cos) = angle.sin_cos();
        let (u, v) = (x * cos + y * sin, y * cos - x * sin);
        let (w, [_, _, by_q, by_curvature]) = SphereFit([0.0, 0.0, q, curvature]).at(0.0, v)?;
        let length = (1.0 + s * s).sqrt();
        // slope of the circle across the axis
        let m = (1.0 + q * q).sqrt();
        let across = (q / m + curvature * v) / (1.0 / m - curvature * w);
        let by_angle = s * v - length * across * u;
        Some((
            height + s * u + length * w,
            [1.0, u + s / length * w, length * by_q, length * by_curvature, by_angle],
        ))
    }

    fn normal_equations(&self, points: &[(usize, [f64; 3])]) -> Option<(Mat<f64>, [f64; 5])> {
        let (mut matrix, mut right) = (Mat::<f64>::zeros(5, 5), [0.0; 5]);
        let share = 1.0 / points.len() as f64;
        for (_, [x, y, z]) in points {
            let (height, derivatives) = self.at(*x, *y)?;
            for (row, a) in derivatives.iter().enumerate() {
                right[row] += share * a * (z - height);
                for (column, b) in derivatives.iter().enumerate() {
                    matrix[(row, column)] += share * a * b;
                }
            }
        }
        Some((matrix, right))
    }
}
