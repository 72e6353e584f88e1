//! Mean and scatter of a number over random surfaces.

/// Mean of a sample and its scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sample {
    pub(crate) mean: f64,
    /// Sample standard deviation; `None` for a single value. It estimates the spread of single surfaces for any number
    /// of them, while the range from minimum to maximum widens with each further surface.
    pub(crate) deviation: Option<f64>,
}

impl Sample {
    /// That of `values`; `None` without values.
    pub(crate) fn of(values: &[f64]) -> Option<Self> {
        let mean = mean(values)?;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt());
        Some(Self { mean, deviation })
    }
}

/// Mean of `values`; `None` without values.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}
