//! The nodes that an update of the flow computes anew.

use crate::numerics::{FieldLines, for_each_range};

/// Pressures and films of the last update, and the nodes at which those of the present one differ from them.
///
/// The quantities of a node and of its faces depend on pressures and films alone, so those of unchanged nodes keep
/// their values to the last bit. About every third evaluation of a Newton step differs from the one before it in
/// the films of contact nodes only.
#[derive(Debug, Clone)]
pub(super) struct Changes {
    pressure: Vec<f64>,
    film: Vec<f64>,
    has_changed: Vec<bool>,
    /// Whether the quantities belong to these pressures and films, with the present settings.
    is_valid: bool,
}

impl Changes {
    pub(super) fn new(n: usize) -> Self {
        Self { pressure: vec![0.0; n], film: vec![0.0; n], has_changed: vec![true; n], is_valid: false }
    }

    /// All nodes count as changed at the next update: settings have changed.
    pub(super) fn forget(&mut self) {
        self.is_valid = false;
    }

    /// Compares with the last update, whose pressures and films these become.
    pub(super) fn compare(&mut self, pressure: &[f64], film: &[f64]) {
        let n = self.has_changed.len();
        let fields = (
            FieldLines::new(&mut self.has_changed, 1),
            FieldLines::new(&mut self.pressure, 1),
            FieldLines::new(&mut self.film, 1),
        );
        let is_valid = std::mem::replace(&mut self.is_valid, true);
        for_each_range(fields, n, n, |nodes, (has_changed, last_pressure, last_film)| {
            let (pressure, film) = (&pressure[nodes.clone()], &film[nodes]);
            if is_valid {
                let last = last_pressure.values.iter().zip(&*last_film.values);
                let now = pressure.iter().zip(film);
                for (changed, (now, last)) in has_changed.values.iter_mut().zip(now.zip(last)) {
                    *changed = now != last;
                }
            } else {
                has_changed.values.fill(true);
            }
            last_pressure.values.copy_from_slice(pressure);
            last_film.values.copy_from_slice(film);
        });
    }

    /// Whether node `k` has changed.
    #[inline]
    pub(super) fn at(&self, k: usize) -> bool {
        self.has_changed[k]
    }

    /// Whether one of the nodes from `first` to `last` has changed.
    #[inline]
    pub(super) fn between(&self, first: usize, last: usize) -> bool {
        self.has_changed[first..=last].iter().any(|changed| *changed)
    }
}
