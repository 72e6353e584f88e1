//! Root of a function of one variable by false position (Illinois).

/// A bracket of a root: positions of both ends with the values there, which have different signs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FalsePosition {
    low: [f64; 2],
    high: [f64; 2],
    last_is_low: Option<bool>,
}

impl FalsePosition {
    /// The bracket between `low` and `high`, of which the newest end, if known, is the low one.
    pub(crate) fn new(low: [f64; 2], high: [f64; 2], last_is_low: Option<bool>) -> Self {
        Self { low, high, last_is_low }
    }

    /// The next position: the zero of the line through both ends, or the middle where that is within the share `least`
    /// of the bracket from the low end.
    pub(crate) fn next(&self, least: f64) -> f64 {
        let share = self.low[1] / (self.low[1] - self.high[1]);
        let share = if share < least { 0.5 } else { share };
        self.low[0] + share * (self.high[0] - self.low[0])
    }

    /// Replaces an end by `position` with its `value`. An end that is kept twice counts half.
    pub(crate) fn add(&mut self, position: f64, value: f64) {
        let is_low = (value > 0.0) == (self.low[1] > 0.0);
        let (end, kept) =
            if is_low { (&mut self.low, &mut self.high) } else { (&mut self.high, &mut self.low) };
        *end = [position, value];
        if self.last_is_low == Some(is_low) {
            kept[1] *= 0.5;
        }
        self.last_is_low = Some(is_low);
    }

    /// Evaluates at the next positions (see [`next`](Self::next)), until the value is below `tolerance` or there were `most`
    /// of them; returns the last result and whether its value is below the tolerance. `evaluate` gives the result at a position and
    /// its value.
    pub(crate) fn find<S, E>(
        mut self,
        [tolerance, least]: [f64; 2],
        most: usize,
        mut evaluate: impl FnMut(f64) -> Result<(S, f64), E>,
    ) -> Result<(S, bool), E> {
        let mut count = 0;
        loop {
            let position = self.next(least);
            let (result, value) = evaluate(position)?;
            count += 1;
            if value.abs() < tolerance || count >= most {
                return Ok((result, value.abs() < tolerance));
            }
            self.add(position, value);
        }
    }

    /// Positions of both ends.
    #[cfg(any(feature = "serde", test))]
    pub(crate) fn ends(&self) -> [f64; 2] {
        [self.low[0], self.high[0]]
    }
}

#[cfg(test)]
mod tests {
    use super::FalsePosition;

    /// `x^9 - 1/2` on 0 to 1.
    fn value(x: f64) -> f64 {
        x.powi(9) - 0.5
    }

    fn bracket() -> FalsePosition {
        FalsePosition::new([0.0, value(0.0)], [1.0, value(1.0)], None)
    }

    #[test]
    fn root_of_a_steep_function_is_found_in_eleven_positions() {
        let mut bracket = bracket();
        let mut position = f64::NAN;
        for _ in 0..11 {
            position = bracket.next(0.0);
            bracket.add(position, value(position));
        }
        assert!((position - 0.5_f64.powf(1.0 / 9.0)).abs() < 1e-14, "{position}");
    }

    #[test]
    fn ends_enclose_the_root_and_halving_narrows_them() {
        let (mut bracket, root) = (bracket(), 0.5_f64.powf(1.0 / 9.0));
        for _ in 0..15 {
            let position = bracket.next(0.01);
            bracket.add(position, value(position));
            let [low, high] = bracket.ends();
            assert!(low <= root && root <= high, "{low} to {high}");
        }
        let [low, high] = bracket.ends();
        assert!(high - low < 1e-5, "{low} to {high}");
    }
}
