//! Tridiagonal systems.
//!
//! Elimination costs `O(n)` and needs no extra storage.

/// Solves `below[i] x[i - 1] + diagonal[i] x[i] + above[i] x[i + 1] = rhs[i]` by elimination without pivoting
/// (Thomas algorithm), which is stable for M-matrices. The solution replaces `rhs`; `above` is overwritten.
pub(crate) fn solve_tridiagonal(below: &[f64], diagonal: &[f64], above: &mut [f64], rhs: &mut [f64]) {
    // forward elimination
    let mut before = (0.0, 0.0);
    let rows = below.iter().zip(diagonal).zip(&mut *above).zip(&mut *rhs);
    for (((below, diagonal), above), rhs) in rows {
        let pivot = diagonal - below * before.0;
        *above /= pivot;
        *rhs = (*rhs - below * before.1) / pivot;
        before = (*above, *rhs);
    }
    // back substitution
    let mut next = 0.0;
    for (rhs, above) in rhs.iter_mut().zip(above.iter()).rev() {
        *rhs -= above * next;
        next = *rhs;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_small_system() {
        let (below, diagonal) = ([0.0, -1.0, -0.5, -2.0], [2.0, 3.0, 2.5, 4.0]);
        let above = [-1.0, -0.5, -1.0, 0.0];
        let exact = [1.0, -2.0, 3.0, 0.5];
        let at = |i: usize| if i < 4 { exact[i] } else { 0.0 };
        let mut x: Vec<f64> = (0..4)
            .map(|i| below[i] * at(i.wrapping_sub(1)) + diagonal[i] * at(i) + above[i] * at(i + 1))
            .collect();
        solve_tridiagonal(&below, &diagonal, &mut above.clone(), &mut x);
        assert!(x.iter().zip(exact).all(|(x, exact)| (x - exact).abs() < 1e-14));
    }
}
