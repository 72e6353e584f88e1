//! Quantities as they were written.

/// A quantity as it was written, and in SI units.
#[derive(Debug, Clone)]
pub(super) struct Quantity {
    pub(super) text: String,
    pub(super) value: f64,
}

impl Quantity {
    /// The value of a key in a scene file.
    pub(super) fn entry(&self) -> String {
        if self.text.trim().parse::<f64>().is_ok() {
            format!("{:?}", self.value)
        } else {
            format!("{:?}", self.text.trim())
        }
    }
}
