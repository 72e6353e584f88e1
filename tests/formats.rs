//! Files of measured surfaces as heights with a mask. Their readers are tested in `surface-formats/tests`.

use std::path::{Path, PathBuf};

use stribeck::Grid;
use stribeck::sim::Scene;
use stribeck::sim::scene::Roughness;
use stribeck::surface::{
    FileError, Heights, LengthUnit, ReadOptions, SurfaceError, read, read_bytes, read_with, write_npy,
    write_text, write_x3p,
};

/// The folder with the small files (`tests/data/surfaces/README.md`).
fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/surfaces").join(name)
}

fn text(content: &str) -> Result<Heights, SurfaceError> {
    read_bytes(content.as_bytes(), "heights.txt")
}

#[test]
fn undefined_points_of_files_are_in_the_mask() {
    let surface = text("# unit: um\n1 NaN 3\n--- 5 inf\n").unwrap();
    assert_eq!(surface.defined().unwrap(), [true, false, true, false, true, false]);
    assert_eq!(surface.undefined(), 3);
    let heights = [1.0, 0.0, 3.0, 0.0, 5.0, 0.0].map(|z| z * 1e-6);
    assert_eq!(surface.heights(), heights);
    let shown = surface.heights_or_nan();
    assert!(shown[1].is_nan() && shown[3].is_nan() && shown[5].is_nan());
    assert_eq!(surface.defined_heights(), [heights[0], heights[2], heights[4]]);
    let cut = read(data("cut.sur")).unwrap();
    assert_eq!((cut.undefined(), cut.unit()), (16, Some(LengthUnit::Millimetre)));
    // operations leave them undefined
    let mut filtered = cut.clone();
    filtered.remove_plane().unwrap();
    assert_eq!((filtered.undefined(), filtered.rotated_90().undefined()), (16, 16));
}

#[test]
fn doubts_of_the_reader_stay_with_the_surface() {
    let surface = text("# Kanaal: Z\n1 2\n3 5\n").unwrap();
    assert_eq!((surface.unit(), surface.warnings().len()), (None, 2));
    assert!(surface.warnings()[0].contains("\"Kanaal\""), "{:?}", surface.warnings());
    assert!(surface.warnings()[1].contains("unit of the heights is not known"), "{:?}", surface.warnings());
    assert_eq!(surface.rotated_90().warnings(), surface.warnings());
    assert!(read(data("cut.x3p")).unwrap().warnings().is_empty());
}

#[test]
fn written_files_read_back_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let mut heights: Vec<f64> = (0..35).map(|k| 1e-7 * (1.0 + f64::from(k)).ln() / 3.0).collect();
    (heights[3], heights[4], heights[5]) = (-0.0, 5e-324, -f64::MAX);
    let mut mask = vec![true; 35];
    (mask[7], mask[34]) = (false, false);
    let surface =
        Heights::new(7, 5, Some([1.276_565_098_373_46e-7, 1e-6 / 3.0]), heights, Some(mask)).unwrap();
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    let paths = ["a", "b", "c"].map(|name| folder.path().join(name));
    write_x3p(&paths[0], &surface).unwrap();
    write_text(&paths[1], &surface).unwrap();
    write_npy(&paths[2], 7, 5, &surface.heights_or_nan()).unwrap();
    for path in &paths {
        let back = read(path).unwrap();
        assert_eq!(bits(back.heights()), bits(surface.heights()));
        assert_eq!(back.defined(), surface.defined());
    }
    assert_eq!(read(&paths[1]).unwrap().dy(), surface.dy());
    let without = Heights::new(1, 1, None, vec![0.0], None).unwrap();
    assert!(matches!(write_x3p(&paths[0], &without), Err(SurfaceError::NoSpacing)));
    let nowhere = folder.path().join("missing/a");
    let error = write_text(&nowhere, &surface).unwrap_err();
    assert!(matches!(error, SurfaceError::File { error: FileError::Io { .. } }));
}

#[test]
fn files_without_a_reader_come_with_the_line_that_converts_them() {
    let error = read_bytes(b"VK4_\0", "scan.vk4").unwrap_err().to_string();
    assert!(error.starts_with("scan.vk4: a file of the format Keyence vk4"), "{error}");
    assert!(
        error.ends_with("python -c \"import stribeck; stribeck.surface.read('scan.vk4').write('scan.x3p')\""),
        "{error}"
    );
}

/// A scene with the file at `path` as its disc.
fn scene_of(path: &Path) -> Scene {
    let mut scene = Scene::azam_2019(8);
    scene.roughness.disc =
        Roughness::File(stribeck::sim::scene::FileRoughness { path: path.to_owned(), rq: None });
    scene
}

/// Undefined points of a file without spacing were zero metres deep.
#[test]
fn undefined_nodes_of_a_scene_are_filled() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("nodes.npy");
    let mut heights = vec![1e-6; 64];
    heights[20] = f64::NAN;
    write_npy(&path, 8, 8, &heights).unwrap();
    let grid = Grid::centred(8, 8, 1e-6, 1e-6).unwrap();
    let found = scene_of(&path).roughness.disc.heights(&grid).unwrap();
    assert!(found.iter().all(|z| (z - 1e-6).abs() < 1e-18), "{found:?}");
}

#[test]
fn options_name_units_and_channels() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.txt");
    std::fs::write(&path, "# Channel: a\n1 2\n3 5\n# Channel: b\n5 6\n7 9\n").unwrap();
    let options = ReadOptions::new().with_channel(2).with_unit(LengthUnit::Nanometre);
    let surface = read_with(&path, &options).unwrap();
    assert_eq!((surface.heights()[0], surface.unit()), (5e-9, Some(LengthUnit::Nanometre)));
    let error = read(&path).unwrap_err();
    assert!(matches!(error, SurfaceError::File { error: FileError::Several { .. } }), "{error}");
}
