//! Fields written for the Visualization Toolkit, read back by another implementation of its format.

use stribeck::Grid;
use stribeck::sim::write_vtk;
use vtkio::model::{Attribute, DataSet, Piece, RectilinearGridPiece};
use vtkio::{IOBuffer, Vtk};

fn read(path: &std::path::Path) -> RectilinearGridPiece {
    let DataSet::RectilinearGrid { mut pieces, .. } = Vtk::import(path).unwrap().data else {
        panic!("no rectilinear grid");
    };
    let Piece::Inline(piece) = pieces.remove(0) else { panic!("no inline data") };
    *piece
}

#[test]
fn fields_come_back_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.vtk");
    let grid = Grid::from_edges(7, 5, [-3e-4, 4e-4], [-2.5e-4, 2.5e-4]).unwrap();
    let film: Vec<f64> = (0..35).map(|k| 1e-9 * (f64::from(k) + 0.1).sqrt()).collect();
    let pressure: Vec<f64> = (0..35).map(|k| 3e9 / f64::from(k + 3)).collect();
    write_vtk(&path, &grid, &[("film", &film), ("pressure", &pressure)]).unwrap();
    let piece = read(&path);
    let axis = |buffer: IOBuffer| match buffer {
        IOBuffer::F64(values) => values,
        other => panic!("{other:?}"),
    };
    assert_eq!(axis(piece.coords.x), (0..7).map(|i| grid.x(i)).collect::<Vec<_>>());
    assert_eq!(axis(piece.coords.y), (0..5).map(|j| grid.y(j)).collect::<Vec<_>>());
    assert_eq!(axis(piece.coords.z), [0.0]);
    let fields: Vec<(String, Vec<f64>)> = piece
        .data
        .point
        .into_iter()
        .map(|attribute| match attribute {
            Attribute::DataArray(array) => match array.data {
                IOBuffer::F64(values) => (array.name, values),
                other => panic!("{other:?}"),
            },
            Attribute::Field { .. } => panic!("a field array"),
        })
        .collect();
    assert_eq!(fields, [("film".to_owned(), film), ("pressure".to_owned(), pressure)]);
}

#[test]
fn names_and_shapes_that_do_not_fit_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.vtk");
    let grid = Grid::centred(2, 2, 1.0, 1.0).unwrap();
    for name in ["", "a b", "a\n"] {
        assert!(write_vtk(&path, &grid, &[(name, &[0.0; 4])]).is_err(), "{name:?}");
    }
    assert!(write_vtk(&path, &grid, &[("a", &[0.0; 4]), ("a", &[0.0; 4])]).is_err());
    let error = write_vtk(&path, &grid, &[("a", &[0.0; 3])]).unwrap_err();
    assert_eq!(error.to_string(), "a has 3 values, expected 4");
    assert!(!path.exists());
}
