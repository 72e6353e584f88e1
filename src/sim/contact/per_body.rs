//! A law for each body, or one for both.

use std::sync::Arc;

use crate::error::InputError;

/// The laws of ball and disc.
#[derive(Debug)]
pub(in crate::sim) struct PerBody<T: ?Sized> {
    /// The law of the ball.
    ball: Arc<T>,
    /// `None` if it is that of the ball.
    disc: Option<Arc<T>>,
}

impl<T: ?Sized> Clone for PerBody<T> {
    /// Shares the laws.
    fn clone(&self) -> Self {
        Self { ball: Arc::clone(&self.ball), disc: self.disc.clone() }
    }
}

impl<T: ?Sized> PerBody<T> {
    /// One law for both bodies.
    pub(in crate::sim) fn same(law: Arc<T>) -> Self {
        Self { ball: law, disc: None }
    }

    /// The laws made from the `values` of ball and disc; a single one if these are equal.
    pub(in crate::sim) fn by(
        values: [f64; 2],
        make: impl Fn(f64) -> Result<Box<T>, InputError>,
    ) -> Result<Self, InputError> {
        let [ball, disc] = values;
        let other = ball.to_bits() != disc.to_bits();
        Ok(Self { ball: make(ball)?.into(), disc: if other { Some(make(disc)?.into()) } else { None } })
    }

    /// The law of both bodies; `None` if they differ.
    pub(in crate::sim) fn common(&self) -> Option<&T> {
        self.disc.is_none().then_some(self.ball.as_ref())
    }

    /// Laws of ball and disc.
    pub(in crate::sim) fn each(&self) -> [&T; 2] {
        [self.ball.as_ref(), self.disc.as_deref().unwrap_or(self.ball.as_ref())]
    }
}
