//! `describe FILE...`: size, unit, undefined points, mean deviation and warnings of surface files.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

fn main() {
    for path in std::env::args().skip(1) {
        match surface_formats::read(&path) {
            Ok(surface) => {
                let defined: Vec<f64> = surface.heights.iter().copied().filter(|z| !z.is_nan()).collect();
                let count = defined.len() as f64;
                let mean = defined.iter().sum::<f64>() / count;
                let sa = defined.iter().map(|z| (z - mean).abs()).sum::<f64>() / count;
                let sq = (defined.iter().map(|z| (z - mean) * (z - mean)).sum::<f64>() / count).sqrt();
                let size = surface.spacing.map(|[dx, dy]| [dx * surface.nx as f64, dy * surface.ny as f64]);
                let unit = surface.unit.map(|unit| unit.to_string());
                println!("{path}: {} x {} points, size {size:?} m, unit {unit:?}", surface.nx, surface.ny);
                println!("  {} undefined, Sa {sa:e} m, Sq {sq:e} m", surface.undefined());
                for warning in &surface.warnings {
                    println!("  warning: {warning}");
                }
            }
            Err(error) => println!("{error}"),
        }
    }
}
