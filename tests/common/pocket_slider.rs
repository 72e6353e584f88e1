//! A slider with a pocket and its exact solution. Shared by tests and the study `validation`.

use stribeck::lubricant::Lubricant;
use stribeck::reynolds::{FilmThickness, GivenFilm, SideEdges};
use stribeck::{Grid, InputError};

/// Viscosity \[Pa s\].
pub(crate) const ETA: f64 = 0.01;

/// A slider of 10 mm with a pocket from 2 to 5 mm, infinitely wide.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PocketSlider {
    inlet: f64,
    outlet: f64,
    depth: f64,
    speed: f64,
}

/// Published values: pressures at the ends of the pocket, load, place of reformation, flow.
#[derive(Debug)]
pub(crate) struct Exact {
    pub(crate) pressures: [f64; 2],
    pub(crate) load: f64,
    pub(crate) reformation: Option<f64>,
    pub(crate) flow: f64,
}

impl PocketSlider {
    pub(crate) const LENGTH: f64 = 10e-3;
    pub(crate) const POCKET: [f64; 2] = [2e-3, 5e-3];
    const AMBIENT: f64 = 1e5;

    pub(crate) fn fowell(speed: f64) -> Self {
        Self { inlet: 1.05e-6, outlet: 1e-6, depth: 1e-6, speed }
    }

    pub(crate) fn giacopini() -> Self {
        Self { inlet: 1e-6, outlet: 1e-6, depth: 5e-6, speed: 1.0 }
    }

    fn pad(&self, x: f64) -> f64 {
        self.inlet + (self.outlet - self.inlet) * x / Self::LENGTH
    }

    pub(crate) fn film(&self, x: f64) -> f64 {
        let in_pocket = x > Self::POCKET[0] && x < Self::POCKET[1];
        self.pad(x) + if in_pocket { self.depth } else { 0.0 }
    }

    /// The film on `cells` of a row.
    pub(crate) fn film_on(&self, cells: usize) -> Result<FilmThickness, InputError> {
        let grid = Grid::from_edges(cells, 1, [0.0, Self::LENGTH], [0.0, 1.0])?;
        let slider = *self;
        FilmThickness::from_function(grid, move |x, _| slider.film(x))
    }

    pub(crate) fn problem<'a>(&self, film: &'a FilmThickness, oil: &'a Lubricant) -> GivenFilm<'a> {
        GivenFilm::new(film, oil, [self.speed, 0.0])
            .with_ambient_pressure(Self::AMBIENT)
            .with_sides(SideEdges::Closed)
    }

    /// Integrals of `1/h^2` and `1/h^3`; films are straight on each part.
    fn moments(&self, from: f64, to: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let parts =
            [(0.0, Self::POCKET[0], 0.0), (Self::POCKET[0], Self::POCKET[1], self.depth), (5e-3, 1e-2, 0.0)];
        for (start, end, depth) in parts {
            let (start, end) = (from.max(start), to.min(end));
            if end > start {
                let (a, b) = (self.pad(start) + depth, self.pad(end) + depth);
                sums[0] += (end - start) / (a * b);
                sums[1] += (end - start) * (a + b) / (2.0 * a * a * b * b);
            }
        }
        sums
    }

    /// `dp/dx = 12 eta (u/h^2 - q/h^3)`, integrated; the film ruptures where the pocket begins if it ruptures
    /// at all.
    pub(crate) fn exact(&self) -> Exact {
        let u = 0.5 * self.speed;
        let [start, end] = Self::POCKET;
        let rise = |flow: f64, from: f64, to: f64| {
            let [squares, cubes] = self.moments(from, to);
            12.0 * ETA * (u * squares - flow * cubes)
        };
        let area = |p: &dyn Fn(f64) -> f64, from: f64, to: f64| {
            let n = 2000;
            let step = (to - from) / f64::from(n);
            let at = |i: i32| p(from + step * f64::from(i));
            let inner: f64 = (1..n).map(|i| at(i) * if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
            (at(0) + inner + at(n)) * step / 3.0
        };
        let [squares, cubes] = self.moments(0.0, Self::LENGTH);
        let full = u * squares / cubes;
        let whole = |x: f64| Self::AMBIENT + rise(full, 0.0, x);
        if whole(start) >= 0.0 {
            let load = area(&whole, 0.0, start) + area(&whole, start, end) + area(&whole, end, Self::LENGTH);
            return Exact { pressures: [whole(start), whole(end)], load, reformation: None, flow: full };
        }
        let [squares, cubes] = self.moments(0.0, start);
        let flow = (u * squares + Self::AMBIENT / (12.0 * ETA)) / cubes;
        let before = |x: f64| Self::AMBIENT + rise(flow, 0.0, x);
        let behind = |x: f64| Self::AMBIENT - rise(flow, x, Self::LENGTH);
        let (mut low, mut high) = (start, end);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if behind(middle) > 0.0 { high = middle } else { low = middle }
        }
        let load = area(&before, 0.0, start) + area(&behind, high, end) + area(&behind, end, Self::LENGTH);
        Exact { pressures: [0.0, behind(end)], load, reformation: Some(high), flow }
    }
}
