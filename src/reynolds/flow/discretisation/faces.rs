//! Flow through faces: neighbours, films, densities and mobilities.
//!
//! An update stores the quantities of the faces of changed nodes; derivatives are computed on demand. A face has the
//! index of its first node: the one east of `k` is between `k` and `k + 1`, the one north of `k` between `k` and
//! `k + nx`, or the node of the first row north of the last one on a [strip](crate::Grid::strip).

use std::mem::take;

use super::super::direction::Direction;
use super::super::entrainment::{DensityRise, FaceFilm};
use super::super::face_mobility::{FaceFlow, FaceMobility};
use super::super::inlet::Inlet;
use super::{Discretisation, Scheme};
use crate::numerics::{FieldLines, for_each_range};

/// Without an [`EdgePressure`](crate::reynolds::EdgePressure) the pressure is ambient at the edge of the box, half a
/// cell outside the outermost nodes, but these nodes have ambient pressure too. The pressure differences next to them
/// are reduced by this factor.
const EDGE_SHARE: f64 = 2.0 / 3.0;

impl Discretisation {
    /// Sets `c` of the faces between columns and between rows.
    pub(super) fn set_coefficients(&mut self, along: f64, across: f64) {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        // The faces next to the edges of the box.
        let at_edge = |i: usize, n: usize| i == 0 || i + 2 == n;
        let edge = if self.edge_pressure.is_empty() { EDGE_SHARE } else { 1.0 };
        let share = |i: usize, n: usize| if at_edge(i, n) { edge } else { 1.0 };
        let has_sides = self.grid.has_side_edges();
        for (j, row) in self.coefficients.chunks_exact_mut(nx).enumerate() {
            // The rows of a strip have no edge.
            let north = if has_sides { share(j, ny) * across } else { across };
            for (i, c) in row.iter_mut().enumerate() {
                *c = [share(i, nx) * along, north];
            }
        }
    }

    /// Updates entrainment corrections, inlets and pressure flow of the faces east of the changed nodes, of their
    /// upstream neighbors and of the next nodes.
    pub(super) fn update_east_faces(&mut self) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (mut beyond, mut face_films) = (take(&mut self.beyond), take(&mut self.face_films));
        let mut inlets = take(&mut self.inlets);
        let (mut east, mut east_flow) = (take(&mut self.east), take(&mut self.east_flow));
        let fields = (
            (FieldLines::new(&mut beyond, nx), FieldLines::new(&mut face_films, nx)),
            FieldLines::new(&mut inlets, nx),
            (FieldLines::new(&mut east, nx), FieldLines::new(&mut east_flow, nx)),
        );
        let this = &*self;
        for_each_range(
            fields,
            self.grid.ny(),
            n,
            |rows, ((beyond, face_films), inlets, (east, east_flow))| {
                let first = rows.start * nx;
                for i in 0..beyond.values.len() {
                    let (k, column) = (first + i, i % nx);
                    // Entrainment through a face depends on both of its nodes and on the next one upstream.
                    let (up, next) = (k - column.min(1), if column + 1 < nx { k + 1 } else { k });
                    if !this.changes.between(up, next) {
                        continue;
                    }
                    let film = this.face_film(k, column);
                    inlets.values[i] = this.inlet(k, column);
                    face_films.values[i] =
                        if film.beyond == 0.0 { 1.0 } else { 1.0 + film.beyond / this.nodes[k].film };
                    beyond.values[i] = this.flux_beyond(k, column, &film);
                    if column + 1 < nx {
                        // Pressure flow: mobility times the drop of the potential.
                        let direction = this.along(face_films.values[i], &inlets.values[i]);
                        east.values[i] = this.face_flow(k, k + 1, direction).mobility;
                        let drop = this.nodes[k].potential - this.nodes[k + 1].potential;
                        east_flow.values[i] = this.coefficients[k][0] * east.values[i] * drop;
                    }
                }
            },
        );
        (self.beyond, self.face_films, self.inlets) = (beyond, face_films, inlets);
        (self.east, self.east_flow) = (east, east_flow);
    }

    /// Updates the pressure flow of the faces between two rows if one of the two nodes has changed.
    pub(super) fn update_north_faces(&mut self) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (mut north, mut north_flow) = (take(&mut self.north), take(&mut self.north_flow));
        let fields = (FieldLines::new(&mut north, nx), FieldLines::new(&mut north_flow, nx));
        let this = &*self;
        for_each_range(fields, self.grid.ny(), n, |rows, (north, north_flow)| {
            let faces = north.values.iter_mut().zip(north_flow.values);
            for ((north, flow), k) in faces.zip(rows.start * nx..) {
                // There is no face north of the last row, except on a strip.
                let Some(other) = this.grid.north_of(k) else { break };
                if this.changes.at(k) || this.changes.at(other) {
                    *north = this.face_flow(k, other, Direction::Across).mobility;
                    let drop = this.nodes[k].potential - this.nodes[other].potential;
                    *flow = this.coefficients[k][1] * *north * drop;
                }
            }
        });
        (self.north, self.north_flow) = (north, north_flow);
    }

    /// Flux entrained through the face east of node `k` in `column` beyond that of the node, with the `film` of the face.
    #[inline]
    fn flux_beyond(&self, k: usize, column: usize, film: &FaceFilm) -> f64 {
        let own = &self.nodes[k];
        match self.scheme {
            Scheme::FirstOrder => 0.0,
            Scheme::Limited => {
                let rise = self.density_rise(k, column).rise;
                own.density * film.beyond + rise * (self.masses[k] / own.density + film.beyond)
            }
            Scheme::SecondOrder if column == 0 => own.density * film.beyond,
            Scheme::SecondOrder => 0.5 * (self.masses[k] - self.masses[k - 1]),
        }
    }

    /// Density of the face east of node `k` in `column` minus that of the node, extrapolated from the nodes
    /// upstream.
    #[inline]
    pub(super) fn density_rise(&self, k: usize, column: usize) -> DensityRise {
        if column == 0 {
            return DensityRise::default();
        }
        let (own, up) = (&self.nodes[k], &self.nodes[k - 1]);
        let up_film = if self.face_mobility == FaceMobility::Inlet { up.film } else { own.film };
        DensityRise::new((own.density, own.film), (up.density, up_film))
    }

    /// The film of the face east of node `k` in `column`; at first order that of the node.
    #[inline]
    pub(super) fn face_film(&self, k: usize, column: usize) -> FaceFilm {
        if self.scheme == Scheme::FirstOrder || column + 1 == self.grid.nx() {
            return FaceFilm::default();
        }
        let (own, next) = (self.nodes[k].film, self.nodes[k + 1].film);
        if column == 0 {
            FaceFilm::central(own, next)
        } else {
            FaceFilm::limited(self.nodes[k - 1].film, own, next)
        }
    }

    /// The inlet at the face east of node `k` in `column`.
    #[inline]
    fn inlet(&self, k: usize, column: usize) -> Inlet {
        if self.face_mobility != FaceMobility::Inlet || column == 0 || column + 1 == self.grid.nx() {
            return Inlet::NONE;
        }
        Inlet::new(self.nodes[k - 1].film, self.nodes[k].film, self.nodes[k + 1].film, self.alignments[k])
    }

    /// The direction of the face east of node `k`.
    #[inline]
    pub(super) fn along_at(&self, k: usize) -> Direction {
        self.along(self.face_films[k], &self.inlets[k])
    }

    /// The direction of a face along x with this ratio of its film to that of its first node, and this inlet.
    #[inline]
    fn along(&self, face_film: f64, inlet: &Inlet) -> Direction {
        if self.wedge > 0.0 {
            Direction::Along(face_film, inlet.factor)
        } else {
            Direction::AlongWithoutEntrainment
        }
    }

    /// Mobility of the face between the nodes `a` and `b`.
    #[inline(always)] // Callers that only use the mobility drop the derivatives.
    pub(super) fn face_flow(&self, a: usize, b: usize, direction: Direction) -> FaceFlow {
        let flow = self.face_mobility.of(self.fluidity, &self.nodes[a], &self.nodes[b], direction);
        if self.ratios.is_empty() {
            return flow;
        }
        flow.thinned(self.ratios[a].of(direction), self.ratios[b].of(direction))
    }

    /// Neighbors of node `k` (east, west, north, south) with coefficients and mobilities of the faces. Across an edge
    /// the node is its own neighbor, with a coefficient or mobility of zero.
    #[inline]
    pub(super) fn neighbours(&self, k: usize) -> [(usize, f64, f64); 4] {
        let ([east, north], [west, _]) = (self.coefficients[k], self.coefficients[k - 1]);
        let north_of = self.grid.north_of(k).unwrap_or(k);
        let south = match self.grid.south_of(k) {
            Some(o) => (o, self.coefficients[o][1], self.north[o]),
            None => (k, 0.0, 0.0),
        };
        [
            (k + 1, east, self.east[k]),
            (k - 1, west, self.east[k - 1]),
            (north_of, north, self.north[k]),
            south,
        ]
    }
}
