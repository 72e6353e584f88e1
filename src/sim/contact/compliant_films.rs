//! Deflection of compliant tribofilms in a contact.

use crate::elastic::WithLocalCompliance;
use crate::error::InputError;
use crate::sim::contact::interrupt::Interruptible;
use crate::sim::scene::Scene;

/// Tribofilms with elastic constants.
#[derive(Debug, Clone)]
pub(in crate::sim) struct CompliantFilms {
    /// Deflection per pressure and thickness of the films of ball and disc \[1/Pa\].
    per_thickness: [f64; 2],
    /// Deflection of both films per pressure \[m/Pa\].
    compliance: Vec<f64>,
}

impl CompliantFilms {
    /// The films of `scene` on `n` nodes; `None` if they have no elastic constants.
    pub(in crate::sim) fn of(scene: &Scene, n: usize) -> Result<Option<Self>, InputError> {
        let films = scene.bonded_films()?;
        Ok(films.map(|films| Self {
            per_thickness: films.map(|film| film.compliance()),
            compliance: vec![0.0; n],
        }))
    }

    /// Adds the deflection of films of thickness `films` \[m\] to `bodies`.
    pub(in crate::sim) fn add_to(
        &mut self,
        bodies: &mut WithLocalCompliance<Interruptible>,
        [ball, disc]: &[Vec<f64>; 2],
    ) -> Result<(), InputError> {
        let [of_ball, of_disc] = self.per_thickness;
        for (c, (ball, disc)) in self.compliance.iter_mut().zip(ball.iter().zip(disc)) {
            *c = of_ball * ball + of_disc * disc;
        }
        bodies.set_compliance(&self.compliance)
    }
}
