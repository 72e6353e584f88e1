//! Waves that roll through line and point contacts, beside the amplitudes of Venner and Lubrecht, and waves of a surface that
//! slides, beside Greenwood and Morales-Espejel.

use rayon::prelude::*;

use crate::report::{Effort, Number, Outcome, Row};
use crate::rolling::Rolling;

/// Cells, wave length in half-widths, cells of a step, amplitude over that of the undeformed wave: line, M = 100, L = 11.
const LINE: [(usize, f64, f64, f64); 5] = [
    (512, 0.5, 1.0, 0.394),
    (512, 4.0, 8.0, 0.030),
    (512, 2.0, 4.0, 0.073),
    (512, 1.0, 2.0, 0.183),
    (1024, 0.25, 1.0, 0.660),
];

/// M, wave length in half-widths, cells of a step: a ball, L = 10.
const BALL: [(f64, f64, f64); 5] =
    [(5.0, 0.75, 1.0), (20.0, 1.0, 1.0), (100.0, 1.0, 1.0), (100.0, 2.0, 2.0), (100.0, 3.0, 3.0)];

/// Wave length in half-widths, speed of the surface over that of entrainment: line, M = 100, L = 11.
const SLIDING: [(f64, f64); 4] = [(0.5, 0.5), (0.5, 0.75), (0.5, 1.5), (1.0, 0.5)];

/// Waves of a film between a smooth surface and one with waves that slides.
fn sliding((wave, ratio): (f64, f64)) -> Outcome<[Number; 2]> {
    let found = Rolling::line(512)?.sliding(wave, ratio)?;
    let case = format!("{wave} half-widths; surface at {ratio} of the entrainment; 512 cells");
    let length = "sliding line: length of the inlet's wave over the surface's";
    let amplitude = "sliding line: amplitude that moves with the surface";
    Ok([
        Number::relative(length, case.clone(), "", 1.0 / ratio, found.carried_length, 0.02),
        Number::absolute(
            amplitude,
            format!("{case}; inlet's wave {:.3}", found.carried),
            "",
            found.stiff_oil,
            found.surface,
            0.01,
        ),
    ])
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let lines = if effort.is_full() { &LINE[..] } else { &LINE[..3] };
    let balls = if effort.is_full() { &BALL[..] } else { &[] };
    let line = lines.par_iter().map(|(nx, wave, cells, known)| {
        let found = Rolling::line(*nx)?.amplitude(*wave, *cells, true)?;
        let case = format!("{wave} half-widths; {nx} cells");
        Ok(Number::absolute("line: amplitude over the undeformed one", case, "", *known, found, 0.01))
    });
    let ball = balls.par_iter().map(|(moes_load, wave, cells)| {
        let n = wave * (moes_load / 10.0).sqrt();
        let curve = 1.0 / (1.0 + 0.15 * n + 0.015 * n * n);
        let found = Rolling::ball(*moes_load, 128)?.amplitude(*wave, *cells, true)?;
        let case = format!("M {moes_load}; {wave} half-widths; 128 x 128 cells");
        Ok(Number::absolute("ball: amplitude over the undeformed one", case, "", curve, found, 0.06))
    });
    let mut numbers = line.chain(ball).collect::<Outcome<Vec<_>>>()?;
    let slides = if effort.is_full() { &SLIDING[..] } else { &SLIDING[..1] };
    let pairs = slides.par_iter().map(|case| sliding(*case)).collect::<Outcome<Vec<_>>>()?;
    numbers.extend(pairs.into_iter().flatten());
    Ok(Row {
        name: "waves",
        quantity: "Waves in rolling and sliding",
        reference: "independent computation: Venner and Lubrecht (2000); theory: Greenwood and Morales-Espejel (1994)",
        range: "line M 100, L 11, 1/4 to 4 half-widths; balls M 5 to 100, L 10, 0.75 to 3 half-widths",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}
