//! Direction of a face.

/// Direction of a face relative to the flow.
#[derive(Debug, Clone, Copy)]
pub(super) enum Direction {
    /// Along +x: the film of the face over that of the first node, and the inlet factor.
    Along(f64, f64),
    /// Along x without entrainment: the mobility is that of a face across.
    AlongWithoutEntrainment,
    /// Between rows.
    Across,
}
