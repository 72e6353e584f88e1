//! Moments of surfaces and small archives.
#![allow(dead_code, reason = "each program of tests uses a part")]

use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use surface_formats::{LengthUnit, Surface};
use zip::write::{SimpleFileOptions, ZipWriter};

/// The small files (`tests/data/surfaces/README.md` of the repository).
pub(crate) fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/surfaces").join(name)
}

/// Moments of the defined heights about their mean.
pub(crate) struct Moments {
    pub(crate) sa: f64,
    pub(crate) sq: f64,
    pub(crate) ssk: f64,
    pub(crate) sku: f64,
    pub(crate) lowest: f64,
    pub(crate) highest: f64,
}

pub(crate) fn moments(surface: &Surface) -> Moments {
    let z: Vec<f64> = surface.heights.iter().copied().filter(|z| !z.is_nan()).collect();
    let count = z.len() as f64;
    let mean = z.iter().sum::<f64>() / count;
    let moment = |power: i32| z.iter().map(|z| (z - mean).powi(power)).sum::<f64>() / count;
    let sq = moment(2).sqrt();
    let scaled = |power: i32| z.iter().map(|z| ((z - mean) / sq).powi(power)).sum::<f64>() / count;
    Moments {
        sa: z.iter().map(|z| (z - mean).abs()).sum::<f64>() / count,
        sq,
        ssk: scaled(3),
        sku: scaled(4),
        lowest: z.iter().copied().fold(f64::INFINITY, f64::min),
        highest: z.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    }
}

/// Compares points, size \[m\], unit, undefined count, Sa and Sq \[m\].
#[expect(clippy::too_many_arguments, reason = "a row of a table")]
pub(crate) fn check(
    name: &str,
    surface: &Surface,
    points: [usize; 2],
    size: Option<[f64; 2]>,
    unit: Option<LengthUnit>,
    undefined: usize,
    sa: f64,
    sq: f64,
) {
    assert_eq!([surface.nx, surface.ny], points, "{name}");
    assert_eq!(surface.unit, unit, "{name}");
    assert_eq!(surface.undefined(), undefined, "{name}");
    let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-6 * expected;
    let found = surface.spacing.map(|[dx, dy]| [dx * surface.nx as f64, dy * surface.ny as f64]);
    assert_eq!(found.is_some(), size.is_some(), "{name}: {found:?}");
    for (found, expected) in found.into_iter().flatten().zip(size.into_iter().flatten()) {
        assert!(close(found, expected), "{name}: size {found}, expected {expected}");
    }
    let z = moments(surface);
    assert!(close(z.sa, sa), "{name}: Sa {}, expected {sa}", z.sa);
    assert!(close(z.sq, sq), "{name}: Sq {}, expected {sq}", z.sq);
}

/// A zip archive of the parts with these names and contents.
pub(crate) fn archive(parts: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in parts {
        writer.start_file(*name, SimpleFileOptions::default()).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap().into_inner()
}
