//! Random deviates and phases of surfaces.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use num_complex::Complex64;

/// A value of the same phase on the unit circle; 1 for zero.
pub(super) fn phase(value: Complex64) -> Complex64 {
    let size = value.norm_sqr().sqrt();
    if size > 0.0 { value / size } else { Complex64::new(1.0, 0.0) }
}

/// The random generator of the deviates.
pub(super) fn cipher(seed: u64) -> ChaCha8Rng {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    ChaCha8Rng::from_seed(bytes)
}
